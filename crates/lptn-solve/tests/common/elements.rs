//! Runs of networks of elements that are more than a constant conductance.
#![allow(dead_code, unreachable_pub, clippy::unwrap_used, reason = "each test file uses a part")]

#[path = "../../../lptn-assembly/tests/common/networks.rs"]
mod networks;

use lptn_assembly::ThermalSystem;
use lptn_network::{NodeId, Time};
use lptn_solve::{Solution, Transient};
pub use networks::*;

/// Runs and checks the books.
pub fn run(system: &ThermalSystem, stop: f64, tolerance: f64) -> Solution {
    let solution = Transient::until(Time(stop)).tolerance(tolerance).solve(system).unwrap();
    let ledger = solution.ledger();
    assert!(ledger.closes(), "{ledger:?} {:e} at {tolerance}", ledger.relative_residual().unwrap());
    solution
}

pub fn last(solution: &Solution, node: NodeId) -> f64 {
    *solution.temperature(node).unwrap().last().unwrap()
}

/// The largest difference between a node and a course over time, over all rows.
pub fn error(solution: &Solution, node: NodeId, exact: impl Fn(f64) -> f64) -> f64 {
    let rows = solution.times().iter().zip(solution.temperature(node).unwrap());
    rows.map(|(&t, found)| (found - exact(t)).abs()).fold(0.0, f64::max)
}

/// Holds a node to a course at the tolerances for which ten times as much error is promised.
pub fn holds(system: &ThermalSystem, node: NodeId, stop: f64, exact: impl Fn(f64) -> f64) {
    for tolerance in [1e-3, 1e-4, 1e-5] {
        let found = error(&run(system, stop, tolerance), node, &exact);
        assert!(found <= 10.0 * tolerance, "off by {found:e} K at {tolerance:e} K");
    }
}
