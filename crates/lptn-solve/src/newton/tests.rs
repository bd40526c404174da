//! A massless node that follows a body on one of two branches.
#![allow(
    clippy::unwrap_used,
    clippy::float_cmp,
    reason = "a test that cannot go on has failed; numbers that are given"
)]

use lptn_assembly::ThermalSystem;
use lptn_network::{Context, HeatCapacity, HeatFlow, NetworkBuilder, Path, Temperature};

use super::*;
use crate::scripted::{bodies, workspace};

/// `10 W tanh((T - 340 K) / 2 K) = 2 W/K (T - 300 K) + 2 W/K (T - T_body)` has three solutions if
/// the body is between 379.7 and 380.3 K, else one.
const STEP: &str = "10 [W] * tanh((T - absolute(340 [K])) / 2 [K])";

/// The temperature of the body in K for a massless node at rest at a temperature in K.
fn body(massless: f64) -> f64 {
    massless - 0.5 * (10.0 * ((massless - 340.0) / 2.0).tanh() - 2.0 * (massless - 300.0))
}

/// New temperature in K of the massless node from an old one, with the body at another.
fn follows(guarded: bool, (body, from): (f64, f64)) -> Result<f64, NewtonError> {
    let system =
        ThermalSystem::assemble(&bodies(&[(100.0, "1 [W]"), (0.0, STEP)], Some("2 [W/K]")));
    let system = system.unwrap();
    let mut newton = Newton::new(&system, vec![1])?;
    newton.guarded = guarded;
    let mut temperatures = [body, from];
    let found = newton.follow(&mut workspace(&system), &mut temperatures);
    match found {
        Ok(()) => Ok(temperatures[1]),
        Err(error) => {
            assert_eq!(temperatures, [body, from], "where it was");
            Err(error)
        }
    }
}

#[test]
fn a_massless_node_stays_on_its_branch_and_ends_with_it() {
    for (massless, from) in
        [(320.0, 319.0), (338.0, 337.5), (338.9, 338.8), (345.0, 344.0), (341.2, 341.4)]
    {
        for guarded in [true, false] {
            let found = follows(guarded, (body(massless), from)).unwrap_or_else(|_| panic!("ends"));
            assert!((found - massless).abs() < 1e-7, "{massless}: {found}");
        }
    }
    // beyond the end of the lower and of the upper branch
    for (at, from) in [(381.0, 338.9), (379.0, 341.1)] {
        let found = follows(true, (at, from));
        assert!(matches!(found, Err(NewtonError::Fold { unknown: 1 })), "{at}");
        let found = follows(false, (at, from)).unwrap_or_else(|_| panic!("there is one"));
        assert!((body(found) - at).abs() < 1e-6, "{at}: {found}");
    }
}

/// With its present factors it goes on in corrections alone, as long as they shrink.
#[test]
fn a_massless_node_follows_with_the_factors_at_hand() {
    let system =
        ThermalSystem::assemble(&bodies(&[(100.0, "1 [W]"), (0.0, STEP)], Some("2 [W/K]")));
    let system = system.unwrap();
    for guarded in [true, false] {
        let mut newton = Newton::new(&system, vec![1]).unwrap_or_else(|_| panic!("none"));
        let mut work = workspace(&system);
        newton.guarded = guarded;
        let mut temperatures = [body(320.0), 319.0];
        let follow = |newton: &mut Newton<'_>, work: &mut Workspace, at: &mut [f64]| {
            newton.follow(work, at).unwrap_or_else(|_| panic!("it ends"));
        };
        follow(&mut newton, &mut work, &mut temperatures);
        assert!(newton.ready);
        let known = newton.matrix().to_vec();
        temperatures[0] = body(321.0);
        follow(&mut newton, &mut work, &mut temperatures);
        assert!((temperatures[1] - 321.0).abs() < 1e-7, "{temperatures:?}");
        assert_eq!(newton.matrix(), known, "no new factors");
    }
}

#[test]
fn the_largest_move_of_a_free_unknown_counts() {
    let heats = [(100.0, "1 [W]"), (0.0, STEP), (0.0, STEP)];
    let system = ThermalSystem::assemble(&bodies(&heats, Some("2 [W/K]"))).unwrap();
    let newton = Newton::new(&system, vec![1, 2]).unwrap_or_else(|_| panic!("none"));
    let moved = |to: [f64; 3]| newton.moved(&[300.0, 310.0, 320.0], &to);
    assert_eq!(moved([400.0, 313.0, 321.0]), 3.0);
    assert_eq!(moved([400.0, 309.0, 316.0]), 4.0);
    assert_eq!(moved([400.0, 310.0, 320.0]), 0.0);
}

/// `5 W = 0.4 W/K (|dT| / 1 K)^(1/4) dT` at `dT = 12.5^(4/5) K`. At the temperature of the air the film
/// has no slope; from there Newton's method cannot begin.
#[test]
fn a_film_without_a_slope_is_left_from_warmer_temperatures() {
    let mut b = NetworkBuilder::new();
    let node = b.node("body", HeatCapacity(1.0), Temperature(300.0));
    let air = b.boundary("air", Temperature(300.0));
    let film = "0.4 [W/K] * (abs(dT) / 1 [K])^(1/4)";
    let film = b.expression_in(Context::Link, film, None).unwrap();
    b.resistor("film", node, air, Path::conductance(film));
    b.source("heat", node, HeatFlow(5.0));
    let system = ThermalSystem::assemble(&b.build().unwrap()).unwrap();
    let mut newton = Newton::new(&system, vec![0]).unwrap_or_else(|_| panic!("none"));
    let mut work = workspace(&system);
    let mut temperatures = [300.0];
    assert!(newton.damped(&mut work, &mut temperatures).is_err());
    temperatures = [300.0];
    assert!(newton.warmed(&mut work, &mut temperatures));
    let rise = 12.5_f64.powf(0.8);
    assert!((temperatures[0] - 300.0 - rise).abs() < 1e-8, "{temperatures:?} {rise}");
}

/// If there are several solutions, a warmer start may find another one.
#[test]
fn several_solutions_are_not_searched_from_warmer_temperatures() {
    let system =
        ThermalSystem::assemble(&bodies(&[(100.0, "1 [W]"), (0.0, STEP)], Some("2 [W/K]")));
    let system = system.unwrap();
    let mut newton = Newton::new(&system, vec![1]).unwrap_or_else(|_| panic!("none"));
    let mut temperatures = [380.0, 300.0];
    assert!(!newton.warmed(&mut workspace(&system), &mut temperatures));
    assert_eq!(temperatures, [380.0, 300.0]);
}

/// With factors that are too large by a fiftieth each correction leaves a part in 51 of the error.
/// The one that predicts less than 1e-10 K, four times over, is the last.
#[test]
fn corrections_end_if_the_next_one_is_predicted_to_be_small() {
    let own = "-1 [W/K] * (T - absolute(300 [K]))";
    let network = bodies(&[(100.0, "1 [W]"), (0.0, own)], Some("2 [W/K]"));
    let system = ThermalSystem::assemble(&network).unwrap();
    let mut newton = Newton::new(&system, vec![1]).unwrap_or_else(|_| panic!("none"));
    let mut work = workspace(&system);
    newton.factorize(&mut work, &[300.0, 310.0], 0.0).unwrap_or_else(|_| panic!("singular"));
    let matrix: Vec<f64> = newton.matrix().iter().map(|value| 1.02 * value).collect();
    for start in [1e-3, 1e-5, 1e-7, 3e-9] {
        newton.lean_on(&matrix);
        newton.lean();
        let mut temperatures = [300.0, 300.0 + start];
        assert_eq!(newton.contract(&mut work, &mut temperatures), Some(true), "{start}");
        let (mut left, mut last) = (start, f64::INFINITY);
        loop {
            let size = left / 1.02;
            let next = if last < f64::INFINITY { 4.0 * size * size / last } else { size };
            left -= size;
            if size.min(next) <= 1e-10 {
                break;
            }
            last = size;
        }
        let found = temperatures[1] - 300.0;
        assert!((found - left).abs() < 0.02 * left + 3e-13, "{start}: {found:e} for {left:e}");
        newton.lean_on(&[]);
    }
}

/// A move of more than a kelvin may have led to another solution, a smaller one has not: the
/// factors stay.
#[test]
fn factors_are_renewed_if_a_massless_node_of_several_solutions_moves_far() {
    let system =
        ThermalSystem::assemble(&bodies(&[(100.0, "1 [W]"), (0.0, STEP)], Some("2 [W/K]")));
    let system = system.unwrap();
    for (to, guarded, stay) in [(310.9, true, true), (311.2, true, false), (311.2, false, true)] {
        let mut newton = Newton::new(&system, vec![1]).unwrap_or_else(|_| panic!("none"));
        let mut work = workspace(&system);
        newton.factorize(&mut work, &[body(310.0), 310.0], 0.0).unwrap_or_else(|_| panic!("none"));
        newton.guarded = guarded;
        let known = newton.matrix().to_vec();
        let mut temperatures = [body(to), 310.0];
        newton.follow(&mut work, &mut temperatures).unwrap_or_else(|_| panic!("it ends"));
        assert!((temperatures[1] - to).abs() < 1e-7, "{temperatures:?}");
        assert_eq!(newton.matrix() == known, stay, "{to} {guarded}");
    }
}
