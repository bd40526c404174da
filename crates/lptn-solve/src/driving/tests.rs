//! The largest of inputs that are closed forms of the time.
#![allow(
    clippy::unwrap_used,
    clippy::float_cmp,
    reason = "a test that cannot go on has failed; numbers that are given"
)]

use std::cell::Cell;
use std::f64::consts::PI;

use super::*;
use crate::scripted::bodies;

/// The largest value from 2 to 12 s, and how often the curve was evaluated.
fn of(curve: impl Fn(f64) -> f64) -> (f64, usize) {
    let mut calls = 0;
    let mut at = |time: f64| {
        calls += 1;
        Ok::<f64, ()>(curve(time))
    };
    (highest((2.0, 12.0), &mut at).unwrap(), calls)
}

#[test]
fn the_highest_of_a_curve_is_at_the_top_of_a_parabola() {
    for at in [3.1, 7.4, 11.8] {
        let (found, calls) = of(|t| 5.0 - (t - at) * (t - at));
        assert!((found - 5.0).abs() < 1e-12);
        assert_eq!(calls, POINTS + 1, "{at}");
    }
    assert_eq!(of(|t| t), (12.0, POINTS));
    assert_eq!(of(|t| -t), (-2.0, POINTS));
    assert_eq!(of(|t| (t - 7.0) * (t - 7.0)), (25.0, POINTS));
    assert_eq!(of(|_| 3.0), (3.0, POINTS));
    // a top at a point is known
    assert_eq!(of(|t| 5.0 - (t - 7.0) * (t - 7.0)), (5.0, POINTS));
    // the higher of two
    let two = |t: f64| 3.0 - (t - 4.0) * (t - 4.0) * (t - 10.0) * (t - 10.0) * 1e-2 + 0.1 * t;
    let (found, calls) = of(two);
    let exact = (900..1100).map(|k| two(f64::from(k) * 0.01)).fold(0.0, f64::max);
    assert!(
        (found - exact).abs() < 1e-4 && calls <= POINTS + REFINEMENTS,
        "{found} {exact} {calls}"
    );
    let (found, _) = of(|t| (0.45 * t).sin() + 0.01 * t);
    let exact =
        (0..100_000).map(|k| 2.0 + f64::from(k) * 1e-4).map(|t| (0.45 * t).sin() + 0.01 * t);
    assert!((found - exact.fold(0.0, f64::max)).abs() < 1e-7, "{found}");
}

/// The largest heat of a source over times, and how often it was read.
fn largest(heat: &str, span: (f64, f64)) -> (f64, usize) {
    let system = ThermalSystem::assemble(&bodies(&[(1.0, heat)], None)).unwrap();
    let reads = Cell::new(0);
    let found = largest_of_inputs(&system, span, &|system, work| {
        reads.set(reads.get() + 1);
        system.source_powers(work)[0]
    });
    (found.unwrap(), reads.get())
}

#[test]
fn the_largest_input_is_found_between_the_ends_of_a_run() {
    assert_eq!(largest("7 [W]", (0.0, 10.0)), (7.0, 1));
    let wave = "5 [W] + 3 [W] * sin(2 * pi * t / 40 [s])";
    let near = |found: (f64, usize), expected: f64| {
        assert!((found.0 - expected).abs() < 1e-6, "{found:?} for {expected}");
        assert!(found.1 > POINTS, "{found:?}");
    };
    near(largest(wave, (0.0, 40.0)), 8.0);
    near(largest(wave, (12.0, 28.0)), 5.0 + 3.0 * (2.0 * PI * 0.3).sin());
    near(largest(wave, (31.0, 37.0)), 5.0 - 3.0 * (2.0 * PI * 3.0 / 40.0).sin());
    assert_eq!(largest(wave, (10.0, 10.0)), (8.0, 1));
    // a jump belongs to the segment after it, a ramp to its ends
    assert_eq!(largest("if(t < 5 [s], 9 [W], 2 [W])", (0.0, 10.0)).0, 9.0);
    assert_eq!(largest("if(t < 5 [s], 9 [W], 2 [W])", (5.0, 10.0)).0, 2.0);
    assert_eq!(largest("2 [W/s] * t", (3.0, 10.0)).0, 20.0);
}

/// If nothing curves and the balances are linear, a segment is one part. With straight inputs to
/// balances that bend there are eight.
#[test]
fn segments_are_parted_where_what_follows_may_curve() {
    let parts = |heat: &str, air: Option<&str>| {
        let network = bodies(&[(1.0, heat), (1.0, "1 [W]")], air);
        let system = ThermalSystem::assemble(&network).unwrap();
        let all = [Segment { from: 0.0, to: 8.0 }, Segment { from: 8.0, to: 12.0 }];
        parts_of(&system, &all)
    };
    let whole = vec![vec![(0.0, 8.0)], vec![(8.0, 12.0)]];
    assert_eq!(parts("1 [W]", None), whole);
    assert_eq!(parts("2 [W/s] * t", None), whole);
    let eighths = |from: f64, part: f64| -> Vec<(f64, f64)> {
        (0..8).map(|k| (from + part * f64::from(k), from + part * f64::from(k + 1))).collect()
    };
    let bent = "1 [W/K] * (1 + (T_mean - absolute(300 [K])) / 100 [K])";
    assert_eq!(parts("2 [W/s] * t", Some(bent)), [eighths(0.0, 1.0), eighths(8.0, 0.5)]);
    // a curved input has its own parts, with the ends of segments among them
    let curved = parts("5 [W] * sin(2 * pi * t / 7 [s])", None);
    assert_eq!(curved.len(), 2);
    for (parts, ends) in curved.iter().zip([(0.0, 8.0), (8.0, 12.0)]) {
        assert!(parts.len() > 1 && parts[0].0 == ends.0 && parts[parts.len() - 1].1 == ends.1);
        assert!(parts.iter().all(|part| part.0 < part.1));
        assert!(parts.windows(2).all(|pair| pair[0].1 == pair[1].0));
    }
}
