//! Stretches of runs in which the time history of a heat is given.
#![allow(clippy::float_cmp, reason = "numbers that are given")]

use super::*;
use crate::scripted::bodies;

/// The stretches of segments of a run of 300 s with a heat: its steps are 1 s to begin with.
fn of(heat: &str, ends: &[f64], gap: f64) -> Vec<Stretch> {
    let network = bodies(&[(1.0, heat)], None);
    let curves = network.curves();
    let pairs = ends.windows(2).map(|pair| Segment { from: pair[0], to: pair[1] });
    let found = stretches(&network, &curves, &pairs.collect::<Vec<_>>(), gap);
    assert!(found[0].from == ends[0] && found[found.len() - 1].to == ends[ends.len() - 1]);
    assert!(found.windows(2).all(|pair| pair[0].to == pair[1].from));
    found
}

fn at(found: &[Stretch], time: f64) -> Stretch {
    found[found.partition_point(|stretch| stretch.to <= time)]
}

const RUN: [f64; 2] = [0.0, 300.0];

/// At least six steps in a period.
#[test]
fn steps_are_halved_until_six_are_in_a_period() {
    for (period, step) in [(10.0, 1.0), (7.0, 1.0), (4.0, 0.5), (2.0, 0.25), (0.12, 0.015_625)] {
        let found = of(&format!("5 [W] * sin(2 * pi * t / {period} [s])"), &RUN, f64::INFINITY);
        assert_eq!(at(&found, 150.0).step, step, "{period}");
    }
    // seven halvings at most, and no step longer than the gap
    let found = of("5 [W] * sin(2 * pi * t / 0.01 [s])", &RUN, f64::INFINITY);
    assert_eq!(at(&found, 150.0).step, 1.0 / 128.0);
    let found = of("5 [W] * sin(2 * pi * t / 10 [s])", &RUN, 0.3);
    assert!(found.iter().all(|stretch| stretch.step <= 0.3));
    let found = of("5 [W] * sin(2 * pi * t / 10 [s])", &RUN, 2.0);
    assert_eq!(found, [Stretch { from: 0.0, to: 300.0, step: 1.0 }]);
}

/// A bell in the middle of a step is seen with the three steps to both sides; in steps of half a
/// second it is at the end of two, and with their neighbours predicts four falsely.
#[test]
fn steps_around_values_that_are_not_predicted_are_halved() {
    let found = of("1 [W] * exp(-((t - 150.5 [s]) / 0.08 [s])^2)", &RUN, f64::INFINITY);
    let finer = |step: f64| {
        let fine: Vec<&Stretch> = found.iter().filter(|stretch| stretch.step < step).collect();
        (fine[0].from, fine[fine.len() - 1].to)
    };
    assert_eq!(finer(1.0), (147.0, 154.0));
    assert_eq!(finer(0.5), (148.0, 153.0));
    assert!(at(&found, 150.5).step <= 0.125 && at(&found, 155.0).step == 1.0);
    assert_eq!((at(&found, 3.0).from, at(&found, 299.0).to), (0.0, 300.0));
}

/// A bell of a height in W on a million W: its sixteen samples a step sum up to 2.27 of it, and the
/// rounding of seven steps is a part in 1e10 of each sample of the million.
#[test]
fn what_is_rounding_beside_the_largest_value_is_not_looked_into() {
    let sees = |height: f64| {
        let bell = format!("{height:?} [W] * exp(-((t - 150.5 [s]) / 0.08 [s])^2)");
        of(&format!("1e6 [W] + {bell}"), &RUN, f64::INFINITY).len() > 1
    };
    assert_eq!([1e-4, 3e-3, 4.5e-3, 5.5e-3, 0.1].map(sees), [false, false, false, true, true]);
}

/// A segment as short as a sixteenth of a step is left alone.
#[test]
fn a_short_segment_is_not_looked_into() {
    let last = |begin: f64| {
        let found = of("5 [W] * sin(2 * pi * t / 0.01 [s])", &[0.0, begin, 300.0], f64::INFINITY);
        found[found.len() - 1].step
    };
    assert_eq!([299.95, 299.9375].map(last), [1.0; 2]);
    assert!(last(299.93) < 0.01);
}

/// At the ends and in the middle of steps: 4 s long from 2 to 10 s.
#[test]
fn the_largest_value_is_that_at_ends_and_middles_of_steps() {
    let largest = |heat: &str, ends: &[f64], step: f64| {
        let network = bodies(&[(1.0, heat)], None);
        let curves = network.curves();
        let pairs = ends.windows(2).map(|pair| Segment { from: pair[0], to: pair[1] });
        let segments: Vec<Segment> = pairs.collect();
        super::largest((&network, &curves), &segments, step, &mut network.evaluation())[0]
    };
    let near = |found: f64, exact: f64| assert!((found - exact).abs() < 1e-9, "{found} {exact}");
    near(largest("5 [W] * cos(2 * pi * t / 8 [s])", &[2.0, 10.0], 4.0), 5.0);
    near(largest("-5 [W] * cos(2 * pi * t / 8 [s])", &[2.0, 10.0], 4.0), 5.0);
    near(largest("5 [W] * sin(2 * pi * t / 2 [s])", &[2.0, 10.0], 4.0), 0.0);
    near(largest("1 [W/s^2] * t * t", &[2.0, 10.0], 4.0), 100.0);
    near(largest("1 [W/s^2] * (t - 20 [s])^2", &[2.0, 10.0], 4.0), 324.0);
    near(largest("1 [W/s^2] * t * t", &[2.0, 10.0, 11.0], 4.0), 121.0);
}
