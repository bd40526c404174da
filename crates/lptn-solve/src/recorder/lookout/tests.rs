//! Watched nodes over steps in which their temperatures are closed forms.
#![allow(
    clippy::unwrap_used,
    clippy::float_cmp,
    reason = "a test that cannot go on has failed; numbers that are given"
)]

use lptn_network::Time;

use super::*;
use crate::interval::NODES;
use crate::scripted::bodies;

/// Watches three bodies, each with a level or none.
fn lookout(levels: [Option<f64>; 3], hottest_only: bool) -> Lookout {
    let network = bodies(&[(1.0, "1 [W]"), (1.0, "1 [W]"), (1.0, "1 [W]")], None);
    let watch = network.node_ids().zip(levels).map(|(node, level)| Watch { node, level });
    let watch = watch.collect();
    Lookout::new(&Transient { watch, hottest_only, ..Transient::until(Time(1.0)) })
}

/// Takes a step in which the bodies have these temperatures in K at a place from -1 to 1.
fn step(
    lookout: &mut Lookout,
    ends: (f64, f64),
    curves: impl Fn(f64) -> [f64; 3],
) -> Vec<(usize, (f64, f64))> {
    (1..POINTS).for_each(|point| lookout.take(point, &curves(NODES[point])));
    lookout.tops(ends)
}

#[test]
fn a_curve_reaches_as_far_beyond_its_highest_point_as_its_points_are_apart() {
    assert_eq!(range(&[3.0, 5.0, 4.0, 2.0, 2.5, 3.0, 4.5]), (2.0, 8.0));
    assert_eq!(range(&[5.0, 5.0, 5.0, 5.0, 5.0, 5.0, 7.0]), (5.0, 9.0));
    assert_eq!(range(&[5.0, 5.0, 5.0, 5.0, 5.0, 5.0, 1.0]), (1.0, 9.0));
    assert_eq!(range(&[-5.0; POINTS]), (-5.0, -5.0));
}

/// One with a top between its points, one constant, one that falls.
#[test]
fn tops_are_searched_where_a_curve_may_be_higher_than_it_was() {
    let mut watched = lookout([None; 3], false);
    assert!(!watched.is_empty());
    let curves = |x: f64| [310.0 - (x - 0.2) * (x - 0.2), 301.0, 300.0 - 2.0 * x];
    watched.start(2.0, &curves(-1.0));
    let tops = step(&mut watched, (2.0, 12.0), curves);
    assert_eq!((tops.len(), tops[0].0, watched.searched()), (1, 0, 2));
    let (height, time) = tops[0].1;
    assert!((height - 310.0).abs() < 1e-9 && (time - 8.0).abs() < 1e-6, "{height} {time}");
    watched.peak_at(0, (time, height));
    // all fall: only the second may be higher than it was
    let falls =
        |x: f64| [309.3 - 0.1 * (x + 1.0), 301.0 - 0.1 * (x + 1.0), 298.0 - 0.1 * (x + 1.0)];
    assert!(step(&mut watched, (12.0, 20.0), falls).is_empty());
    assert_eq!(watched.searched(), 3);
    let seen = watched.into_seen();
    assert_eq!(seen.len(), 3);
    let peaks = [seen[0].peak.0, seen[1].peak.0, seen[2].peak.0];
    assert!((peaks[0] - 310.0).abs() < 1e-9 && peaks[1..] == [301.0, 302.0], "{peaks:?}");
    let last = [seen[0].last(), seen[1].last(), seen[2].last()];
    assert_eq!(last, falls(1.0));
    assert_eq!([seen[0].first(), seen[1].first(), seen[2].first()], curves(-1.0));
    assert!(lookout([None; 3], false).into_seen().is_empty());
    let none = Lookout::new(&Transient::until(Time(1.0)));
    assert!(none.is_empty());
}

/// A level is searched for if it may be crossed, however far below its peak a node is.
#[test]
fn a_level_is_searched_where_it_may_be_crossed() {
    let mut watched = lookout([Some(305.0), None, Some(280.0)], false);
    watched.start(0.0, &[400.0; 3]);
    watched.start(0.0, &[320.0; 3]);
    let line = |from: f64, to: f64| move |x: f64| [from + 0.5 * (to - from) * (x + 1.0); 3];
    step(&mut watched, (0.0, 10.0), line(320.0, 311.0));
    assert_eq!(watched.searched(), 0);
    step(&mut watched, (10.0, 20.0), line(311.0, 301.0));
    assert_eq!(watched.searched(), 1);
    step(&mut watched, (20.0, 30.0), line(301.0, 299.0));
    assert_eq!(watched.searched(), 1);
    let seen = watched.into_seen();
    assert!((seen[0].crossed.unwrap() - 16.0).abs() < 1e-9, "{:?}", seen[0]);
    assert_eq!((seen[1].crossed, seen[2].crossed), (None, None));
}

/// If only the hottest counts, one that another has exceeded is skipped.
#[test]
fn only_what_may_be_the_hottest_is_searched() {
    let rising = |x: f64| [300.0 + 5.0 * (x + 1.0), 340.0, 335.0 + (x + 1.0)];
    for (hottest_only, searched) in [(false, 2), (true, 1)] {
        let mut watched = lookout([None; 3], hottest_only);
        watched.start(0.0, &rising(-1.0));
        step(&mut watched, (0.0, 10.0), rising);
        // the first reaches up to 320 K, the third to 339 K
        assert_eq!(watched.searched(), if hottest_only { 0 } else { searched });
        step(&mut watched, (10.0, 20.0), |x| [310.0, 340.0, 337.0 + 2.0 * (x + 1.0)]);
        let more = if hottest_only { 1 } else { searched + 1 };
        assert_eq!(watched.searched(), more, "up to 345 K");
        assert!((watched.into_seen()[2].peak.0 - 341.0).abs() < 1e-12);
    }
    // below the hottest by more than rounding
    let floor =
        |highest: f64| Lookout { highest: Some(highest), ..lookout([None; 3], true) }.floor();
    assert_eq!(floor(300.0).to_bits(), (300.0 - 300.0 * 64.0 * f64::EPSILON).to_bits());
    assert!(floor(-2.0) < -2.0 && lookout([None; 3], false).floor() == f64::NEG_INFINITY);
}

/// A massless node jumps from its temperature at the end of the last step.
#[test]
fn a_jump_goes_on_from_where_the_last_step_ended() {
    let mut watched = lookout([Some(305.0), None, None], false);
    watched.start(0.0, &[300.0, 300.0, 300.0]);
    step(&mut watched, (0.0, 10.0), |x| [300.0 + (x + 1.0), 300.0, 300.0]);
    watched.start(14.0, &[310.0, 299.0, 301.0]);
    let seen = watched.into_seen();
    // from 302 K at 10 s on a line to 310 K at 14 s
    assert!((seen[0].crossed.unwrap() - 11.5).abs() < 1e-12, "{:?}", seen[0]);
    assert_eq!(
        [seen[0].peak, seen[1].peak, seen[2].peak],
        [(310.0, 14.0), (300.0, 0.0), (301.0, 14.0)]
    );
    assert_eq!([seen[0].last(), seen[1].last()], [310.0, 299.0]);
}
