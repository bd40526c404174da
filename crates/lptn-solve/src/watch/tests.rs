//! Peaks and crossings of curves that are closed forms.
#![allow(
    clippy::unwrap_used,
    clippy::float_cmp,
    reason = "a test that cannot go on has failed; numbers that are given"
)]

use super::*;

#[test]
fn the_top_of_a_parabola_is_found_exactly() {
    let y = |t: f64| 5.0 - (t - 1.25) * (t - 1.25);
    let found = top([(0.0, y(0.0)), (1.0, y(1.0)), (3.0, y(3.0))]).unwrap();
    assert!((found.0 - 5.0).abs() < 1e-14 && (found.1 - 1.25).abs() < 1e-14, "{found:?}");
}

/// Between points that are an eighth of a time constant apart.
#[test]
fn a_level_is_reached_on_the_curve_and_not_on_the_chord() {
    let points: Vec<(f64, f64)> =
        (0..=8).map(|k| f64::from(k) / 8.0).map(|t| (t, -(-t).exp_m1())).collect();
    for level in [0.05, 0.3, 0.6] {
        let after = points.iter().position(|point| point.1 > level).unwrap();
        let (found, exact) = (on_the_curve(&points, after, level), -(1.0_f64 - level).ln());
        assert!((found - exact).abs() < 2e-5, "{level}: {found}");
    }
}

fn watched(level: Option<f64>, first: f64) -> Watched {
    let mut b = lptn_network::NetworkBuilder::new();
    let node = b.node("body", lptn_network::HeatCapacity(1.0), lptn_network::Temperature(300.0));
    Watched::new(Watch { node, level }, 0.0, first)
}

#[test]
fn an_extreme_is_at_an_end_from_which_it_cannot_be_told() {
    let ends = [(300.0, 1.0), (310.0, 9.0)];
    let there = |value: f64, margin: f64| first_there((value, 5.0), ends, margin);
    assert_eq!([there(300.5, 0.5), there(299.5, 0.5), there(300.6, 0.5)], [1.0, 1.0, 5.0]);
    assert_eq!([there(310.5, 0.5), there(309.5, 0.5), there(309.4, 0.5)], [9.0, 9.0, 5.0]);
    // a value that is the last one to rounding has lasted
    assert_eq!([there(310.0, 0.5), there(310.0 + 1e-12, 0.5)], [5.0, 5.0]);
    assert_eq!([there(310.0 + 2e-12, 0.5), there(310.0 - 2e-12, 0.5)], [9.0, 9.0]);
}

#[test]
fn a_peak_is_higher_than_what_was_by_more_than_rounding() {
    let mut seen = watched(None, 300.0);
    seen.peak_at((1.0, 300.0 + 5e-13));
    assert_eq!(seen.peak, (300.0, 0.0));
    seen.peak_at((2.0, 300.0 + 3e-12));
    assert_eq!(seen.peak, (300.0 + 3e-12, 2.0));
    assert!(seen.is_above(300.0) && seen.is_above(seen.peak.0) && !seen.is_above(300.1));
}

#[test]
fn a_level_may_be_reached_within_a_range_and_once() {
    let mut seen = watched(Some(310.0), 300.0);
    let may = |seen: &Watched| {
        [(300.0, 309.9), (310.0, 311.0), (309.0, 310.0), (310.1, 320.0), (305.0, 315.0)]
            .map(|(low, high)| seen.may_cross(low, high))
    };
    assert_eq!(may(&seen), [false, true, true, false, true]);
    seen.crossed = Some(1.0);
    assert_eq!(may(&seen), [false; 5]);
    assert_eq!(may(&watched(None, 300.0)), [false; 5]);
}

/// On the line to a point at which a step begins or to which it jumps, on the curve otherwise.
#[test]
fn a_level_is_reached_from_either_side_once() {
    for sign in [1.0, -1.0] {
        let level = 300.0 + sign * 5.0;
        let mut seen = watched(Some(level), 300.0);
        seen.jump(0.0, 300.0 + sign * 4.0);
        assert_eq!(seen.crossed, None);
        seen.look(&[(0.0, 300.0 + sign * 4.0), (2.0, 300.0 + sign * 4.5)]);
        assert_eq!((seen.crossed, seen.last()), (None, 300.0 + sign * 4.5));
        let mut leaps = seen;
        leaps.go_to((6.0, 300.0 + sign * 4.5));
        leaps.jump(8.0, 300.0 + sign * 6.5);
        assert_eq!(leaps.crossed, Some(6.5));
        leaps.jump(9.0, 300.0);
        assert_eq!((leaps.crossed, leaps.first(), leaps.last()), (Some(6.5), 300.0, 300.0));
        let mut begins = seen;
        begins.look(&[(4.0, 300.0 + sign * 5.5)]);
        assert_eq!(begins.crossed, Some(3.0));
        let mut steps = seen;
        steps.look(&[(2.0, 300.0 + sign * 4.5), (4.0, 300.0 + sign * 5.5)]);
        assert!((steps.crossed.unwrap() - 3.0).abs() < 1e-12);
        let mut reaches = seen;
        reaches.jump(3.0, level);
        assert_eq!(reaches.crossed, Some(3.0));
    }
}

/// By a parabola through the highest point and its neighbours, if it is above the peak up to now.
#[test]
fn a_top_is_promising_above_the_peak_so_far() {
    let points = |at: f64, height: f64| -> Vec<(f64, f64)> {
        (0..7).map(f64::from).map(|t| (t, height - (t - at) * (t - at))).collect()
    };
    let promises =
        |peak: f64, at: f64, height: f64| watched(None, peak).promising(&points(at, height));
    for at in [0.3, 0.7, 1.4, 3.4, 4.6, 5.2, 5.7] {
        assert!((promises(299.0, at, 300.0).unwrap() - at).abs() < 1e-9, "{at}");
        assert!((promises(299.9, at, 300.0).unwrap() - at).abs() < 1e-9, "{at}");
        assert_eq!(promises(300.1, at, 300.0), None);
    }
    // known already
    assert_eq!(promises(299.0, 3.0, 300.0), None);
    // the higher of two, and none if the range does not reach
    let mut two = points(1.4, 300.0);
    two.extend(points(2.4, 301.0).iter().map(|(t, value)| (t + 7.0, *value)));
    assert!((watched(None, 290.0).promising(&two).unwrap() - 9.4).abs() < 1e-9);
    let flat = [(0.0, 299.0), (1.0, 300.0), (2.0, 299.4)];
    assert_eq!(watched(None, 301.0).promising(&flat), None);
    assert!((watched(None, 300.0).promising(&flat).unwrap() - 1.125).abs() < 1e-9);
}

/// The highest value of a polynomial between the points of a step.
#[test]
fn the_top_of_a_step_is_that_of_its_polynomial() {
    use crate::interval::{NODES, time_of};
    let step = (2.0, 12.0);
    // 305 - 40 (x - 0.2)^2 (1 + x / 2) for x from -1 to 1: its top is 305 at 0.2
    let curve = |x: f64| 305.0 - 40.0 * (x - 0.2) * (x - 0.2) * (1.0 + 0.5 * x);
    let values = NODES.map(curve);
    let points: Vec<(f64, f64)> =
        (0..POINTS).map(|point| (time_of(step, point), values[point])).collect();
    let (height, time) = watched(None, 290.0).top(step, &values, &points).unwrap();
    assert!((height - 305.0).abs() < 1e-5 && (time - 8.0).abs() < 2e-3, "{height} {time}");
    assert_eq!(watched(None, 305.1).top(step, &values, &points), None);
    // a promise that is not kept
    let parabola = NODES.map(|x| 300.0 - x.abs());
    let points: Vec<(f64, f64)> =
        (0..POINTS).map(|point| (time_of(step, point), parabola[point])).collect();
    assert_eq!(watched(None, 300.0).top(step, &parabola, &points), None);
}

#[test]
fn times_are_one_if_rounding_cannot_tell_them_apart() {
    // the less of 1e-12 of the time and 1e-9 of the interval
    let same = |apart: f64, ends: (f64, f64)| is_same(1e3 + apart, 1e3, ends);
    for sign in [1.0, -1.0] {
        let long = (0.0, 2e3);
        assert!(same(sign * 0.8e-9, long) && !same(sign * 1.2e-9, long));
        let short = (999.9, 1000.1);
        assert!(same(sign * 1e-10, short) && !same(sign * 3e-10, short));
        assert!(is_same(-1e3 - sign * 0.8e-9, -1e3, (-2e3, 0.0)));
    }
    assert!(is_same(5.0, 5.0, (0.0, 10.0)) && !is_same(0.0, 1e-30, (0.0, 10.0)));
}

#[test]
fn a_point_comes_where_its_time_is() {
    let mut points = vec![(1.0, 7.0), (3.0, 8.0)];
    [(2.0, 4.0), (0.0, 5.0), (4.0, 6.0)].into_iter().for_each(|point| put_in(&mut points, point));
    assert_eq!(points, [(0.0, 5.0), (1.0, 7.0), (2.0, 4.0), (3.0, 8.0), (4.0, 6.0)]);
}

#[test]
fn a_monotonic_curve_has_no_inner_top() {
    assert_eq!(top([(0.0, 0.0), (1.0, 1.0), (2.0, 2.0)]), None);
    // a bottom, and tops before the first and after the last point or at it
    let parabola =
        |at: f64, sign: f64| top([1.0, 2.0, 3.0].map(|t: f64| (t, -sign * (t - at) * (t - at))));
    assert!(parabola(2.5, 1.0).is_some() && parabola(2.5, -1.0).is_none());
    assert_eq!([0.5, 1.0, 3.0, 3.5].map(|at| parabola(at, 1.0)), [None; 4]);
}
