//! Switches along given time histories.
#![allow(
    clippy::unwrap_used,
    clippy::float_cmp,
    reason = "a test that cannot go on has failed; numbers that are given"
)]

use lptn_assembly::ThermalSystem;

use super::*;
use crate::scripted::{Scripted, bodies};

/// A heat that is switched on above 310 K.
const ABOVE: &str = "if(T > absolute(310 [K]), 1 [W], 0 [W])";

/// The same below 290 K.
const BELOW: &str = "if(T < absolute(290 [K]), 1 [W], 0 [W])";

/// Positions that switch in a step from 0 to 8 s in which bodies exceed 310 K by `course`, and the
/// times at which the step was read for that.
fn found<const N: usize>(
    heats: [&str; N],
    course: impl Fn(f64) -> [f64; N],
    (margin, roots): (f64, Option<[i32; N]>),
) -> ((Vec<usize>, f64), Vec<f64>) {
    let network = bodies(&heats.map(|heat| (100.0, heat)), None);
    let system = ThermalSystem::assemble(&network).unwrap();
    let course = move |time: f64| course(time).map(|over| 310.0 + over).to_vec();
    let mut integrator = Scripted::new(&system, 0.0, course);
    integrator.system_mut().gates.margins = vec![margin; N];
    let mut step = integrator.goes_to(8.0);
    step.roots = roots.is_some();
    integrator.directions = roots.map_or(vec![0; N], |roots| roots.to_vec());
    let found = find(&mut integrator, &step);
    let found = found.unwrap_or_else(|_| panic!("the step can be read"));
    let due = (found.due, found.time);
    (due, integrator.looks)
}

fn alone(course: impl Fn(f64) -> f64) -> ((Vec<usize>, f64), Vec<f64>) {
    found([ABOVE], |time| [course(time)], (0.0, None))
}

#[test]
fn a_step_without_an_event_is_read_at_five_times() {
    let (due, looks) = alone(|t| -1.0 - t);
    assert_eq!((due, looks), ((vec![], 8.0), vec![0.0, 2.0, 4.0, 6.0, 8.0]));
    // a bend that does not reach: an eighth of the second difference at most
    let (due, looks) = alone(|t| -0.6 - 0.03 * (t - 4.0) * (t - 4.0));
    assert_eq!((due, looks.len()), ((vec![], 8.0), 5));
}

#[test]
fn the_first_moment_is_found_to_rounding() {
    for at in [0.7, 3.0, 4.5, 7.9] {
        let ((due, time), looks) = alone(|t| t - at);
        assert_eq!(due, [0]);
        assert!(time >= at && time - at < 1e-12, "{time} for {at}");
        // up to the part that contains it, where a straight line is met and its rounding closed in
        let before = if at < 4.0 { 3 } else { 5 };
        assert!(looks.len() <= before + 16, "{at}: {}", looks.len());
        assert!(looks.iter().all(|look| *look <= if at < 4.0 { 4.0 } else { 8.0 }));
    }
}

/// A bend that may rise above zero between two reads is read more closely.
#[test]
fn what_comes_and_goes_between_two_reads_is_found() {
    // the reads as measured; these histories use only sums and products
    for (middle, most, without) in [
        (0.9, [36, 50, 70], 59),
        (2.7, [29, 40, 74], 65),
        (5.1, [40, 52, 74], 63),
        (7.3, [41, 80, 74], 59),
    ] {
        for (half, most) in [0.5, 0.05, 1e-3].into_iter().zip(most) {
            let ((due, time), looks) = alone(|t| half * half - (t - middle) * (t - middle));
            assert_eq!(due, [0], "{middle} {half}");
            assert!((time - middle + half).abs() < 1e-9, "{middle} {half}: {time}");
            assert!(looks.len() <= most, "{middle} {half}: {} reads", looks.len());
        }
        let ((due, _), looks) = alone(|t| -1e-6 - (t - middle) * (t - middle));
        assert_eq!((due.len(), looks.len()), (0, without), "{middle}");
    }
}

/// Forty halvings and 400 reads are the most: here a bend touches zero.
#[test]
fn what_only_touches_is_given_up() {
    let ((due, time), looks) = alone(|t| -(t - 3.3) * (t - 3.3));
    assert_eq!((due, time), (vec![], 8.0));
    assert_eq!(looks.len(), 189);
    let noise = |t: f64| -1.0 - (1e9 * t).sin();
    let ((_, _), looks) = alone(noise);
    assert!(looks.len() >= 400 && looks.len() < 470, "{} reads, 425 measured", looks.len());
}

/// A bend within the room of a comparison is not followed.
#[test]
fn a_bend_within_the_room_of_a_comparison_is_not_followed() {
    // 0.001 K below the room, with a second difference of 0.008 K
    let looks = |margin: f64| {
        let course = |t: f64| [margin - 1e-3 - 1e-3 * (t - 1.0) * (t - 1.0)];
        let (due, looks) = found([ABOVE], course, (margin, None));
        assert!(due.0.is_empty());
        looks.len()
    };
    assert_eq!([looks(0.01), looks(0.0081)], [5, 5]);
    assert!(looks(0.0079) > 5 && looks(1e-3) > 5);
}

#[test]
fn all_that_is_due_at_that_moment_is_told() {
    let jumps = |t: f64| if t < 2.0 { [-9.0, -19.0, -1.0] } else { [-9.0, -21.0, 1.0] };
    let ((due, time), _) = found([ABOVE, BELOW, ABOVE], jumps, (0.0, None));
    assert_eq!(due, [1, 2]);
    assert!((time - 2.0).abs() < 1e-12);
    let ((due, time), _) = found([ABOVE, BELOW], |t| [t - 5.0, -18.0 - t], (0.0, None));
    assert_eq!(due, [1]);
    assert!((time - 2.0).abs() < 1e-12);
}

/// At a root at its end the integrator reports what rises there.
#[test]
fn at_a_root_the_integrator_tells_what_is_due() {
    let course = |t: f64| [t - 8.0 + 1e-9, -1.0, -10.0, -1.0];
    let heats = [ABOVE, ABOVE, BELOW, ABOVE];
    let (due, looks) = found(heats, course, (0.0, Some([1, 0, -1, 1])));
    assert_eq!((due, looks.len()), ((vec![0, 3], 8.0), 5));
    // anything due before is found nevertheless
    let early = |t: f64| [t - 5.0, -1.0];
    let ((due, time), _) = found([ABOVE, ABOVE], early, (0.0, Some([0, 1])));
    assert!(due == [0] && (time - 5.0).abs() < 1e-12);
    // without a root its end counts
    let ((due, time), _) = found(heats, course, (0.0, None));
    assert!(due.contains(&0) && time < 8.0);
}
