//! The error of a transient against closed forms, for one tolerance in kelvin from 1e-3 to 1e-5 K.

#![allow(clippy::print_stdout, reason = "the measured figures, shown with --nocapture")]

use crate::support;

use lptn::prelude::*;
use support::{StiffLadder, gearbox_rise, gearbox_with_idle, grid, grid_rise};

const TOLERANCES: [f64; 3] = [1e-3, 1e-4, 1e-5];

/// The largest error may be ten times the tolerance.
const FACTOR: f64 = 10.0;

fn check(what: &str, error: impl Fn(f64) -> f64) {
    for tolerance in TOLERANCES {
        let error = error(tolerance);
        println!(
            "{what}: tolerance {tolerance:e} K, error {error:.2e} K ({:.2} x)",
            error / tolerance
        );
        assert!(error <= FACTOR * tolerance, "{what} at {tolerance:e} K: error {error:e} K");
        // an error of nothing would mean that the comparison is empty
        assert!(
            error > 1e-4 * tolerance,
            "{what} at {tolerance:e} K: error {error:e} K is too good"
        );
    }
}

fn gearbox_error(idle: usize, tolerance: f64) -> (f64, u64) {
    let (system, steel, aluminium) = gearbox_with_idle(idle);
    let run = Transient::until(Time(3600.0))
        .every(Time(2.0))
        .tolerance(tolerance)
        .record(&[steel, aluminium]);
    let solution = run.solve(&system).expect("it runs");
    let error = (0..solution.times().len())
        .flat_map(|row| {
            let exact = gearbox_rise(solution.times()[row]);
            [0, 1].map(|i| (solution.row(row)[i] - 298.65 - exact[i]).abs())
        })
        .fold(0.0, f64::max);
    (error, solution.statistics().steps)
}

#[test]
fn gearbox_errs_by_less_than_ten_tolerances() {
    check("gearbox", |tolerance| gearbox_error(0, tolerance).0);
}

#[test]
fn stiff_ladder_with_a_sine_source_errs_by_less_than_ten_tolerances() {
    let ladder = StiffLadder::new(60);
    check("stiff ladder of 60 nodes", |tolerance| {
        let run = Transient::until(Time(600.0)).every(Time(3.0)).tolerance(tolerance);
        let solution = run.solve(&ladder.system).expect("it runs");
        (1..solution.times().len())
            .map(|row| {
                let exact: Vec<f64> =
                    ladder.rise(solution.times()[row]).iter().map(|rise| rise + 273.15).collect();
                support::distance(solution.row(row), &exact)
            })
            .fold(0.0, f64::max)
    });
}

#[test]
fn grid_errs_by_less_than_ten_tolerances() {
    let (n, heat, source) = (24, 40.0, (7, 10));
    let system = grid(n, heat, source);
    let times = [0.3, 1.0, 4.0, 15.0, 60.0, 240.0];
    check("grid of 24 x 24", |tolerance| {
        let run = Transient::until(Time(240.0)).at(&times).tolerance(tolerance);
        let solution = run.solve(&system).expect("it runs");
        let mut worst = 0.0_f64;
        for row in 1..solution.times().len() {
            for cell in [(7, 10), (7, 11), (1, 1), (12, 12), (24, 5), (8, 9)] {
                let exact = grid_rise(n, heat, source, cell, solution.times()[row]);
                let found = solution.row(row)[(cell.0 - 1) * n + cell.1 - 1] - 273.15;
                worst = worst.max((found - exact).abs());
            }
        }
        worst
    });
}

/// CVODE's own norm is a mean over the nodes: idle nodes would dilute the tolerance by the root of
/// their number.
#[test]
fn idle_nodes_change_neither_steps_nor_error() {
    let (error, steps) = gearbox_error(0, 1e-5);
    for idle in [100, 10_000] {
        let (idle_error, idle_steps) = gearbox_error(idle, 1e-5);
        assert_eq!(idle_steps, steps, "{idle} idle nodes");
        assert!(
            (idle_error - error).abs() <= 0.01 * error,
            "{idle} idle nodes: {idle_error:e} K, {error:e} K"
        );
    }
}

/// A node that remembers a hundred periods of what drives it: errors add up over them.
/// One that remembers a thousand makes no such promise, and says so: `regression.rs`.
#[test]
fn slow_nodes_under_fast_sines_err_by_less_than_ten_tolerances() {
    for (tau, period, stop) in [
        (300.0_f64, 100.0, 4e3),
        (2e3, 100.0, 1e4),
        (5e3, 100.0, 2e4),
        (8e3, 100.0, 4e4),
        (2.6e6, 86_400.0, 3e7),
    ] {
        let (amplitude, c) = (50.0, 1000.0_f64);
        let mut b = NetworkBuilder::new();
        let node = b.node("slow", HeatCapacity(c), Temperature(300.0));
        let air = b.boundary("air", Temperature(300.0));
        b.resistor("path", node, air, Conductance(c / tau));
        // a heat that would swing the node by `amplitude` K if it had no path
        let omega = 2.0 * std::f64::consts::PI / period;
        let text = format!("{} [W] * sin(2 * pi * t / {period} [s])", amplitude * c * omega);
        let heat = b.expression(&text, None).expect("it compiles");
        b.source("heat", node, heat);
        let system = support::assembled(b);
        check(&format!("tau {tau} s, period {period} s"), |tolerance| {
            let run = Transient::until(Time(stop)).every(Time(stop / 1000.0)).tolerance(tolerance);
            let solution = run.solve(&system).expect("it runs");
            assert!(solution.error_is_bounded());
            let exact = |t: f64| {
                let (rate, power) = (1.0 / tau, amplitude * omega);
                let forced = rate * (omega * t).sin() - omega * (omega * t).cos();
                power * (forced + omega * (-rate * t).exp()) / (rate * rate + omega * omega)
            };
            let rows = solution.times().iter().enumerate();
            rows.map(|(row, &t)| (solution.row(row)[0] - 300.0 - exact(t)).abs())
                .fold(0.0, f64::max)
        });
    }
}
