//! Snapshots: the state at a row of a run, from the closed form of one node.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use lptn_assembly::ThermalSystem;
use lptn_network::{
    Acts, Conductance, Context, HeatCapacity, HeatFlow, NetworkBuilder, Path, Temperature,
    Thermostat, Time,
};
use lptn_solve::{Solution, SteadyState, Transient};

const AMBIENT: f64 = 293.15;

fn close(found: f64, expected: f64) {
    assert!((found - expected).abs() < 1e-3, "{found} {expected}");
}

/// 10 W on 0.5 W/K and 100 J/K: 20 K (1 - exp(-t / 200 s)) above the ambient, and 10 W exp(-t / 200
/// s) are stored.
fn warming() -> NetworkBuilder {
    let mut b = NetworkBuilder::new();
    let body = b.node("body", HeatCapacity(100.0), Temperature(AMBIENT));
    let air = b.boundary("air", Temperature(AMBIENT));
    b.resistor("skin", body, air, Conductance(0.5));
    b.source("loss", body, HeatFlow(10.0));
    b
}

fn run(b: NetworkBuilder, stop: f64, every: f64) -> Solution {
    let system = ThermalSystem::assemble(&b.build().unwrap()).unwrap();
    let run = Transient::until(Time(stop)).every(Time(every)).tolerance(1e-6);
    run.solve(&system).unwrap()
}

#[test]
fn what_comes_in_is_stored_or_goes_out() {
    let solution = run(warming(), 400.0, 100.0);
    for row in 0..5 {
        let at = solution.snapshot(row).unwrap();
        let left = (-at.time / 200.0).exp();
        close(at.time, 100.0 * row as f64);
        close(at.temperatures[0], AMBIENT + 20.0 * (1.0 - left));
        close(at.received[0][1], 10.0 * (1.0 - left));
        close(at.stored(solution.network())[0], 10.0 * left);
        close(at.boundary_heat[0], -10.0 * (1.0 - left));
        close(at.boundary_temperatures[0], AMBIENT);
        close(at.source_heat[0], 10.0);
        assert!(!at.settled);
    }
}

#[test]
fn a_steady_state_stores_nothing() {
    let system = ThermalSystem::assemble(&warming().build().unwrap()).unwrap();
    let steady = SteadyState::solve(&system, 0.0).unwrap();
    close(steady.stored(system.network())[0], 0.0);
    assert!(steady.settled);
}

/// 240 W on 3 W/K, with the fan on 12 W/K: it switches between 40 K and 25 K above the ambient,
/// again and again.
#[test]
fn each_row_stands_as_its_controls_stood() {
    let mut b = NetworkBuilder::new();
    let fan = b.control("fan");
    let body = b.node("body", HeatCapacity(600.0), Temperature(AMBIENT));
    let air = b.boundary("air", Temperature(AMBIENT));
    let g = b.expression_in(Context::Link, "3 [W/K] + 9 [W/K] * fan", None).unwrap();
    b.resistor("skin", body, air, Path::conductance(g));
    b.source("loss", body, HeatFlow(240.0));
    let above = |k: f64| Temperature(AMBIENT + k).into();
    let (on, off, min_dwell) = (above(40.0), above(25.0), Time(1.0).into());
    let (sense, acts) = (body.into(), Acts::Cooling);
    b.thermostat(fan, Thermostat { sense, acts, on, off, start: false, min_dwell });
    let solution = run(b, 900.0, 20.0);
    let mut seen = [0, 0];
    for row in 0..solution.times().len() {
        let at = solution.snapshot(row).unwrap();
        let runs = at.positions.controls[0];
        let heat = if runs { 12.0 } else { 3.0 } * (at.temperatures[0] - AMBIENT);
        close(at.received[0][1], heat);
        close(at.stored(solution.network())[0], 240.0 - heat);
        seen[usize::from(runs)] += 1;
    }
    assert!(seen[0] > 10 && seen[1] > 10, "{seen:?}");
}

#[test]
fn a_time_finds_the_row_at_or_before_it() {
    let solution = run(warming(), 400.0, 100.0);
    let found = [0.0, 99.0, 100.0, 100.0 - 1e-12, 399.0, 400.0].map(|t| solution.row_at(t));
    assert_eq!(found, [0, 0, 1, 1, 3, 4].map(Some));
    assert_eq!([-1.0, 400.1, f64::NAN].map(|t| solution.row_at(t)), [None; 3]);
}

#[test]
fn heat_flows_need_every_node() {
    let mut b = warming();
    let free = b.node("free", HeatCapacity(1.0), Temperature(AMBIENT));
    let system = ThermalSystem::assemble(&b.build().unwrap()).unwrap();
    let solution = Transient::until(Time(1.0)).record(&[free]).solve(&system).unwrap();
    assert!(solution.snapshot(0).is_none());
}
