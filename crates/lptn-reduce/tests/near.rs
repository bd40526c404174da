//! Networks near one of their states as one node, against closed forms.

#![allow(clippy::unwrap_used, reason = "helpers of tests")]

use crate::networks;

use lptn_assembly::ThermalSystem;
use lptn_network::{Conductance, HeatCapacity, HeatFlow, NetworkBuilder, Temperature, Time};
use lptn_reduce::{Definition, ReduceError, Reduction, ReductionOptions};
use lptn_solve::{Linearised, Snapshot, SteadyState, Transient};
use networks::{quantity, radiation, stream, system};

const SIGMA: f64 = 5.670_374_419e-8;

fn near(system: &ThermalSystem, port: &str, state: &Snapshot) -> Reduction {
    let port = system.network().node(port).unwrap();
    let linear = Linearised::of(system, Some(state)).unwrap();
    Reduction::near(system, port, (&linear, state), &ReductionOptions::default()).unwrap()
}

#[track_caller]
fn same(found: f64, expected: f64, relative: f64) {
    assert!((found / expected - 1.0).abs() <= relative, "{found}, expected {expected}");
}

/// `P = sigma A (T^4 - T_s^4)`: `R = 1 / (4 sigma A T^3)`, and the surroundings weigh `(T_s / T)^3`.
#[test]
fn a_glowing_ball_is_one_node_near_its_steady_state() {
    let mut b = NetworkBuilder::new();
    let ball = b.node("ball", HeatCapacity(500.0), Temperature(900.0));
    let space = b.boundary("space", Temperature(600.0));
    radiation(&mut b, "glow", (ball, space), "0.05 m^2");
    b.source("heater", ball, HeatFlow(1000.0));
    let system = system(b);
    let refused = Reduction::new(&system, ball, &ReductionOptions::default()).unwrap_err();
    assert!(matches!(refused, ReduceError::NotLinear { .. }), "{refused}");
    let steady = SteadyState::solve(&system, 0.0).unwrap();
    let found = near(&system, "ball", &steady);
    let hot = (600.0_f64.powi(4) + 1000.0 / (SIGMA * 0.05)).powf(0.25);
    let resistance = 1.0 / (4.0 * SIGMA * 0.05 * hot.powi(3));
    same(found.norton.resistance, resistance, 1e-9);
    same(found.norton.boundary_weights[0], (600.0 / hot).powi(3), 1e-8);
    same(found.inputs.heat, 1000.0, 1e-12);
    same(found.inputs.reference, hot - resistance * 1000.0, 1e-9);
    let dynamics = found.dynamics.unwrap();
    assert_eq!(dynamics.pairs.len(), 4);
    for pair in &dynamics.pairs {
        same(pair.capacity, 500.0, 1e-9);
        assert!(pair.step.unwrap().relative.unwrap() < 1e-9, "{pair:?}");
    }
}

/// In a run the ball stores what it does not give away; the equivalent gives it the same heat there:
/// `C dT/dt = Q_N - (T - T_ref) / R`.
#[test]
fn a_state_of_a_run_stores_what_it_stores() {
    let mut b = NetworkBuilder::new();
    let ball = b.node("ball", HeatCapacity(500.0), Temperature(400.0));
    let space = b.boundary("space", Temperature(300.0));
    radiation(&mut b, "glow", (ball, space), "0.05 m^2");
    b.source("heater", ball, HeatFlow(1000.0));
    let system = system(b);
    let run = Transient::until(Time(60.0)).every(Time(20.0)).solve(&system).unwrap();
    let state = run.snapshot(1).unwrap();
    let found = near(&system, "ball", &state);
    let at = state.temperatures[ball.index()];
    let stored = 1000.0 - SIGMA * 0.05 * (at.powi(4) - 300.0_f64.powi(4));
    let heat = found.inputs.heat - (at - found.inputs.reference) / found.norton.resistance;
    same(heat, stored, 1e-9);
}

/// Two nodes in a row: `R = 1/G1 + 1/G2`, the first moment `(R^2 C1 + C2 / G2^2) / R^2`.
#[test]
fn a_linear_network_is_what_it_is_everywhere() {
    let mut b = NetworkBuilder::new();
    let start = Temperature::celsius(25.5);
    let steel = b.node("steel", HeatCapacity(1235.0), start);
    let housing = b.node("housing", HeatCapacity(1424.0), start);
    let air = b.boundary("air", start);
    b.resistor("inner", steel, housing, Conductance(130.0));
    b.resistor("outer", housing, air, Conductance(3.4));
    b.source("loss", steel, HeatFlow(220.6));
    let system = system(b);
    let run = Transient::until(Time(600.0)).solve(&system).unwrap();
    let found = near(&system, "steel", &run.snapshot(10).unwrap());
    let resistance = 1.0 / 130.0 + 1.0 / 3.4;
    same(found.norton.resistance, resistance, 1e-12);
    same(found.norton.boundary_weights[0], 1.0, 1e-12);
    same(found.inputs.reference, 298.65, 1e-12);
    let dynamics = found.dynamics.unwrap();
    let capacity = |definition| dynamics.pair(definition).unwrap().capacity;
    same(capacity(Definition::Sum), 2659.0, 1e-12);
    let moment = 1235.0 + 1424.0 / (3.4 * resistance).powi(2);
    same(capacity(Definition::FirstMoment), moment, 1e-12);
}

/// A chain of equal cells: modes coincide, so there is no error of a step, and all else is.
#[test]
fn a_chain_of_equal_cells_has_two_capacities() {
    let mut b = NetworkBuilder::new();
    let inlet = b.boundary("inlet", Temperature::celsius(20.0));
    let mut last: lptn_network::End = inlet.into();
    for i in 1..=3 {
        let cell = b.node(&format!("c{i}"), HeatCapacity(50.0), Temperature::celsius(20.0));
        stream(&mut b, &format!("s{i}"), (last, cell), quantity("20 W/K"));
        last = cell.into();
    }
    stream(&mut b, "s4", (last, inlet), quantity("20 W/K"));
    let system = system(b);
    let steady = SteadyState::solve(&system, 0.0).unwrap();
    let found = near(&system, "c3", &steady);
    same(found.norton.resistance, 0.05, 1e-12);
    assert!(found.norton.influence.iter().all(|r| (r - 0.05).abs() < 1e-14));
    let dynamics = found.dynamics.unwrap();
    assert!(dynamics.step.is_none() && dynamics.pairs.len() == 2);
    same(dynamics.pairs[0].capacity, 50.0, 1e-12);
    same(dynamics.pairs[1].capacity, 50.0, 1e-12);
}
