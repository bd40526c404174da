//! Pairs of bodies that act on each other, against the trace and determinant of their matrix.
#![allow(
    clippy::unwrap_used,
    clippy::float_cmp,
    reason = "a test that cannot go on has failed; numbers that are given"
)]

use lptn_assembly::ThermalSystem;

use super::*;
use crate::scripted::{bodies, workspace};

/// Pairs of bodies: the first gains 1 W/K net by itself, the second loses 3 W/K; the first cools by
/// `b` W/K as the second gets warmer, and heats it by as much. The second of each has a capacity in
/// J/K (0: massless), the first 100 J/K. Returns the node that grows, and if it oscillates.
fn pairs(b: f64, capacities: &[f64]) -> (Option<usize>, bool) {
    let heats: Vec<(f64, String)> = (capacities.iter().enumerate())
        .flat_map(|(i, capacity)| {
            let (first, second) = (2 * i, 2 * i + 1);
            let own = |gain: f64| format!("{gain:?} [W/K] * (T - absolute(300 [K]))");
            let by = |sign: &str, other: usize| {
                format!(" {sign} {b:?} [W/K] * (n{other}.T - absolute(300 [K]))")
            };
            [(100.0, own(3.0) + &by("-", second)), (*capacity, own(-1.0) + &by("+", first))]
        })
        .collect();
    let heats: Vec<(f64, &str)> = heats.iter().map(|(c, heat)| (*c, &heat[..])).collect();
    judged(&heats)
}

fn judged(heats: &[(f64, &str)]) -> (Option<usize>, bool) {
    let system = ThermalSystem::assemble(&bodies(heats, None)).unwrap();
    let size = system.unknowns().len();
    let mut newton = Newton::new(&system, (0..size).collect()).unwrap_or_else(|_| panic!("none"));
    let (mut work, at) = (workspace(&system), vec![300.0; size]);
    let unstable = newton.unstable(&mut work, &at).unwrap_or_else(|_| panic!("singular"));
    let swings = newton.swings(&mut work, &at).unwrap_or_else(|_| panic!("no slopes"));
    // in the order of the nodes
    (unstable.map(|unknown| system.unknowns()[unknown].index()), swings)
}

/// The trace is 1 / 100 - 3 / C, the determinant of the slopes b^2 - 3.
#[test]
fn the_capacities_of_two_bodies_decide_whether_they_swing_up() {
    for capacity in [10.0, 100.0, 250.0, 299.0] {
        assert_eq!(pairs(2.0, &[capacity]).0, None, "{capacity}");
    }
    for capacity in [301.0, 350.0, 1000.0, 1e5] {
        let (place, swings) = pairs(2.0, &[capacity]);
        assert!(place.is_some() && swings, "{capacity}");
    }
    // with a negative determinant one disturbance grows by itself, whatever the capacities are
    for capacity in [1.0, 100.0, 1e4] {
        let (place, swings) = pairs(1.5, &[capacity]);
        assert!(place.is_some() && !swings, "{capacity}");
    }
    assert_eq!(pairs(1.8, &[150.0]).0, None);
}

/// A massless one follows at once: the first loses b^2 / 3 - 1 W/K net.
#[test]
fn a_massless_node_follows_at_once() {
    assert_eq!(pairs(2.0, &[0.0]).0, None);
    assert_eq!(pairs(1.5, &[0.0]).0, Some(0));
    assert_eq!(pairs(1.75, &[0.0]).0, None);
    assert_eq!(pairs(1.71, &[0.0]).0, Some(0));
    // one that heats itself by more than it loses does not rest
    let own = "2.5 [W/K] * (T - absolute(300 [K]))";
    let cooled = "-9 [W/K] * (n1.T - absolute(300 [K]))";
    assert_eq!(judged(&[(100.0, cooled), (0.0, own)]).0, Some(1));
    let own = "1.5 [W/K] * (T - absolute(300 [K]))";
    assert_eq!(judged(&[(100.0, cooled), (0.0, own)]).0, None);
}

/// Bodies that rest or grow by themselves.
#[test]
fn bodies_that_do_not_cool_each_other_are_judged_by_their_slopes() {
    let gains = |gain: f64| format!("{gain:?} [W/K] * (T - absolute(300 [K]))");
    let (small, large) = (gains(1.9), gains(2.1));
    assert_eq!(judged(&[(100.0, &small), (1.0, &small)]), (None, false));
    assert_eq!(judged(&[(100.0, &small), (1.0, &large)]), (Some(1), false));
    assert_eq!(judged(&[(100.0, &large), (1.0, &large)]), (Some(0), false));
}

/// Beyond 100 unknowns a disturbance is followed in steps of many lengths.
#[test]
fn one_of_many_pairs_that_swings_up_is_found() {
    let mut capacities = vec![100.0; 55];
    assert_eq!(pairs(2.0, &capacities).0, None);
    for capacity in [360.0, 2e3] {
        capacities[23] = capacity;
        let (place, swings) = pairs(2.0, &capacities);
        assert!(matches!(place, Some(46 | 47)), "{place:?}");
        assert!(!swings, "of many it is not told");
    }
    capacities[23] = 0.0;
    assert_eq!(pairs(2.0, &capacities).0, None);
    capacities[23] = 1e-3;
    capacities[40] = 5e4;
    assert!(matches!(pairs(2.0, &capacities).0, Some(80 | 81)));
}

/// The first gains 1 W/K net and feels nothing of the second, which it cools: that moves by `-b /
/// (C / 100 s + 3 W/K)` of the first. It counts by the root of its capacity, or of its heat in a
/// step if it has none.
#[test]
fn what_grows_is_where_most_heat_moves() {
    let place = |b: f64, capacity: f64| {
        let first = "3 [W/K] * (T - absolute(300 [K]))";
        let second = format!(
            "-1 [W/K] * (T - absolute(300 [K])) - {b:?} [W/K] * (n0.T - absolute(300 [K]))"
        );
        judged(&[(100.0, first), (capacity, &second)]).0
    };
    // 100 times as much heat, moved by 0.29 and 0.029 of the first
    assert_eq!([place(30.0, 1e4), place(3.0, 1e4)], [Some(1), Some(0)]);
    // as much, moved by 1.25 and 0.75
    assert_eq!([place(5.0, 100.0), place(3.0, 100.0)], [Some(1), Some(0)]);
    // a hundredth, moved by 16 and 8
    assert_eq!([place(48.16, 1.0), place(24.08, 1.0)], [Some(1), Some(0)]);
}

/// Joined bodies warm each other: any growth runs away, even if the determinant is positive.
#[test]
fn what_warms_each_other_does_not_swing() {
    let gains = |gain: f64| format!("{gain:?} [W/K] * (T - absolute(300 [K]))");
    for (gain, unstable) in [(1.0, false), (9.0, true)] {
        let heat = gains(gain);
        let network = bodies(&[(100.0, &heat), (100.0, &heat)], Some("1 [W/K]"));
        let system = ThermalSystem::assemble(&network).unwrap();
        let mut newton = Newton::new(&system, vec![0, 1]).unwrap_or_else(|_| panic!("none"));
        let (mut work, at) = (workspace(&system), [300.0; 2]);
        let found = newton.unstable(&mut work, &at).unwrap_or_else(|_| panic!("singular"));
        assert_eq!(found.is_some(), unstable);
        assert!(!newton.swings(&mut work, &at).unwrap_or_else(|_| panic!("no slopes")));
    }
}
