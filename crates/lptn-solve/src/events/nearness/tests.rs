//! Stays near a threshold along given excesses.
#![allow(
    clippy::unwrap_used,
    clippy::float_cmp,
    reason = "a test that cannot go on has failed; times that are given"
)]

use super::*;
use crate::scripted::bodies;

/// The error of a quantity is ten of these: 1.
const ROOMS: [f64; 1] = [0.1];

/// Stays that end without a switch while one element has this excess over time.
fn stays(nearness: &mut Nearness, looks: &[(f64, f64)]) -> Vec<Stay> {
    let ended = looks.iter().flat_map(|&(time, excess)| nearness.look(time, &[excess], &ROOMS));
    ended.collect()
}

fn stay(from: f64, to: f64, end: StayEnd) -> Stay {
    Stay { position: 0, from, to, end }
}

#[test]
fn a_stay_begins_on_the_straight_line_into_the_error() {
    let mut nearness = Nearness::new(vec![true]);
    // -9 at 2 s and 0 at 5 s: at its error of 1 at 2 + 3 * 8 / 9 s
    assert_eq!(stays(&mut nearness, &[(0.0, -15.0), (2.0, -9.0), (5.0, 0.0)]), []);
    let from = 2.0 + 3.0 * 8.0 / 9.0;
    assert_eq!(nearness.stop(7.0), [stay(from, 7.0, StayEnd::Stop)]);
    assert_eq!(nearness.switch(0, 6.0), Some(stay(from, 6.0, StayEnd::Switch)));
    // a second switch at the same moment has no stay
    assert_eq!(nearness.switch(0, 6.0), None);
}

#[test]
fn a_quantity_that_turns_before_its_threshold_has_a_stay() {
    let mut nearness = Nearness::new(vec![true]);
    let looks = [(0.0, -2.0), (1.0, -0.5), (2.0, -0.1), (3.0, -0.5), (4.0, -2.0), (5.0, -9.0)];
    // from -2 at 0 s to -0.5 at 1 s: at -1 after two thirds
    assert_eq!(stays(&mut nearness, &looks), [stay(2.0 / 3.0, 4.0, StayEnd::Away)]);
    assert_eq!(nearness.stop(9.0), []);
}

#[test]
fn a_quantity_near_its_threshold_at_the_start_or_after_a_switch_leaves_it_without_a_stay() {
    let mut nearness = Nearness::new(vec![true]);
    assert_eq!(stays(&mut nearness, &[(0.0, -0.5), (1.0, -0.9), (2.0, -1.5)]), []);
    assert_eq!(stays(&mut nearness, &[(3.0, 0.0)]).len(), 0);
    assert!(nearness.switch(0, 3.0).is_some());
    assert_eq!(stays(&mut nearness, &[(4.0, -0.2), (5.0, -3.0)]), []);
    assert_eq!(nearness.switch(0, 6.0), None);
}

#[test]
fn elements_with_exact_times_have_no_stay() {
    let mut nearness = Nearness::new(vec![false]);
    let looks = [(0.0, -2.0), (1.0, -0.5), (4.0, -2.0), (5.0, -0.5)];
    assert_eq!(stays(&mut nearness, &looks), []);
    assert_eq!((nearness.stop(9.0), nearness.switch(0, 9.0)), (vec![], None));
}

#[test]
fn a_stay_matters_if_temperatures_could_err_by_many_tolerances() {
    let network = bodies(&[(100.0, "if(T > absolute(310 [K]), 1 [W], 0 [W])")], None);
    let kind = EventKind::switching(&network).next().unwrap();
    // 10 s of 0.1 K/s are 1 K: more than a hundred tolerances of 0.009 K, not of 0.011 K
    for end in [StayEnd::Switch, StayEnd::Stop] {
        let stay = stay(20.0, 30.0, end);
        let switches = end == StayEnd::Switch;
        let found = Undecided { kind, from: 20.0, to: 30.0, switches, error: 1.0 };
        assert_eq!(stay.matters(0.1, (100.0, 0.009), kind), Some(found));
        assert_eq!(stay.matters(0.1, (100.0, 0.011), kind), None);
    }
    // not to switch: 80 s until the stop, ten tolerances
    let stay = stay(20.0, 30.0, StayEnd::Away);
    assert!(stay.matters(0.1, (100.0, 0.79), kind).is_some_and(|found| !found.switches));
    assert_eq!(stay.matters(0.1, (100.0, 0.81), kind), None);
}
