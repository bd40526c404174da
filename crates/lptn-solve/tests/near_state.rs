//! The linear network near a state beside the full one, against closed forms.

#![allow(
    clippy::unwrap_used,
    clippy::float_cmp,
    reason = "helpers of tests; numbers that are given"
)]

use crate::elements_helper as elements;

use elements::{power, quantity, radiation, stream, system};
use lptn_assembly::ThermalSystem;
use lptn_network::{Conductance, HeatCapacity, NetworkBuilder, Temperature, Time};
use lptn_solve::{DisturbanceShape, NearState, Snapshot, SteadyState, Transient};

const C: f64 = 500.0;
const LOSS: f64 = 2.0;
const CURVE: f64 = 0.05;

/// A body whose heat is a square of its temperature: 40 W - 2 W/K (T - T_air) - 0.05 W/K^2 (T - 40
/// degC)^2 in air of 20 degC.
fn square(start: f64) -> ThermalSystem {
    let mut b = NetworkBuilder::new();
    let air = b.boundary("air", Temperature::celsius(20.0));
    let body = b.node("body", HeatCapacity(C), Temperature::celsius(start));
    b.resistor("skin", body, air, Conductance(LOSS));
    let heat = power(&b, "40 [W] - 0.05 [W/K^2] * (body.T - 40 [degC])^2");
    b.source("heater", body, heat);
    system(b)
}

/// What `dx/dt = -a x - b x^2` (Bernoulli's equation) is away from `x0 exp(-a t)`.
fn missed((a, b): (f64, f64), x0: f64, time: f64) -> f64 {
    let left = (-a * time).exp();
    x0 * left * (1.0 / (1.0 + b * x0 / a * (1.0 - left)) - 1.0)
}

/// Holds every disturbance near a state to the closed form with the slope `a` there, in 1/s.
fn holds(system: &ThermalSystem, state: &Snapshot, a: f64) {
    let near = NearState::of(system, state).unwrap();
    assert!((near.span * a / 5.0 - 1.0).abs() < 1e-9, "{}", near.span);
    assert_eq!(near.disturbances.len(), 3);
    for disturbance in &near.disturbances {
        let exact = |time: f64| {
            let side = |x0: f64| missed((a, CURVE / C), x0, time).abs();
            side(disturbance.size).max(side(-disturbance.size))
        };
        let found = &disturbance.difference;
        assert!((found.largest - exact(found.time)).abs() < 2.0 * disturbance.allowed);
        let most = (1..=100_000).map(|i| exact(near.span * f64::from(i) / 1e5)).fold(0.0, f64::max);
        // the moments that are looked at stand 17 % apart
        assert!(found.largest < most * 1.001 + disturbance.allowed);
        assert!(found.largest > most * 0.98 - disturbance.allowed, "{} {most}", found.largest);
    }
    assert!(near.failing().is_none() && !near.is_linear());
}

#[test]
fn a_steady_state_of_a_square_law_misses_what_bernoulli_says() {
    let system = square(40.0);
    let steady = SteadyState::solve(&system, 0.0).unwrap();
    holds(&system, &steady.state, LOSS / C);
}

#[test]
fn a_state_on_the_way_is_held_where_it_is() {
    let system = square(60.0);
    let run = Transient::until(Time(100.0)).solve(&system).unwrap();
    let state = run.snapshot(0).unwrap();
    assert!(state.stored(system.network())[0].abs() > 30.0);
    holds(&system, &state, (LOSS + 2.0 * CURVE * 20.0) / C);
}

#[test]
fn streams_and_paths_of_constants_are_linear() {
    let mut b = NetworkBuilder::new();
    let inlet = b.boundary("inlet", Temperature::celsius(20.0));
    let start = Temperature::celsius(20.0);
    let wall = b.node("wall", HeatCapacity(900.0), start);
    let oil = b.node("oil", HeatCapacity(120.0), start);
    stream(&mut b, "in", (inlet, oil), quantity("30 W/K"));
    stream(&mut b, "out", (oil, inlet), quantity("30 W/K"));
    b.resistor("film", wall, oil, Conductance(12.0));
    b.source("loss", wall, quantity("200 W"));
    let system = system(b);
    let steady = SteadyState::solve(&system, 0.0).unwrap();
    let near = NearState::of(&system, &steady.state).unwrap();
    assert_eq!(near.modes, 2);
    assert_eq!(near.disturbances.len(), 6);
    assert!(near.is_linear() && near.failing().is_none(), "{near:?}");
}

#[test]
fn what_radiates_misses_a_tenth_of_the_share_for_a_tenth_of_the_size() {
    let mut b = NetworkBuilder::new();
    let hall = b.boundary("hall", Temperature::celsius(20.0));
    let start = Temperature::celsius(20.0);
    let core = b.node("core", HeatCapacity(900.0), start);
    let shell = b.node("shell", HeatCapacity(300.0), start);
    let skin = b.massless("skin");
    b.resistor("fit", core, shell, Conductance(8.0));
    b.resistor("wall", shell, skin, Conductance(20.0));
    radiation(&mut b, "glow", (skin, hall), "0.08 m^2");
    b.source("loss", core, quantity("300 W"));
    let system = system(b);
    let steady = SteadyState::solve(&system, 0.0).unwrap();
    let near = NearState::of(&system, &steady.state).unwrap();
    for sizes in near.disturbances.chunks(3) {
        for pair in sizes.windows(2) {
            let ratio = pair[0].share() / pair[1].share();
            assert!(ratio > 7.0 && ratio < 13.0, "{ratio} {sizes:?}");
        }
    }
    assert_eq!(near.disturbances[3].shape, DisturbanceShape::InTurn);
    assert!(near.failing().is_none());
    assert!(near.tried.is_some_and(|tried| tried.heat > 0.0));
}

#[test]
fn a_law_without_a_slope_is_not_verified() {
    let mut b = NetworkBuilder::new();
    let air = b.boundary("air", Temperature::celsius(20.0));
    let body = b.node("body", HeatCapacity(C), Temperature::celsius(20.0));
    b.resistor("skin", body, air, Conductance(0.05));
    // free convection, h ~ dT^(1/4): at rest it has a slope of 0
    let rise = "(body.T - 20 [degC])";
    let heat = format!("-3 [W/K] * {rise} * (abs{rise} / 1 [K])^0.25");
    let heat = power(&b, &heat);
    b.source("film", body, heat);
    let system = system(b);
    let run = Transient::until(Time(1.0)).solve(&system).unwrap();
    let near = NearState::of(&system, &run.snapshot(0).unwrap()).unwrap();
    assert!(near.failing().is_some_and(|failing| failing.size == 0.1 && failing.share() > 0.5));
}
