//! Proven bounds on errors against exact solutions.

#![allow(unused, 
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "helpers of tests; the measured figures, shown with --nocapture"
)]

use crate::common;

use common::{gearbox, nafems_t3, random, rc_ladder, stiff, two_masses};
use lptn_assembly::ThermalSystem;
use lptn_network::{Network, Time};
use lptn_solve::{ExactSolution, Transient};

/// Bound over error of every node and row, with the error of the exact solution added to the
/// bound.
fn ratios(network: &Network, tolerance: f64, stop: f64) -> Vec<f64> {
    let system = ThermalSystem::assemble(network).unwrap();
    let mut settings = Transient::until(Time(stop)).every(Time(stop / 20.0)).tolerance(tolerance);
    settings.certify = true;
    let solution = settings.solve(&system).unwrap();
    if let Some(Err(reason)) = solution.certificate() {
        println!("{reason}");
        return Vec::new();
    }
    let exact = ExactSolution::solve(network, 0.0, solution.times()).unwrap();
    let own = exact.own_error() + exact.quadrature_error().unwrap_or(0.0);
    let mut ratios = Vec::new();
    for id in network.node_ids() {
        let found = solution.temperature(id).unwrap();
        let bounds = solution.bounds(id).unwrap();
        assert_eq!(bounds.len(), found.len());
        for ((t, right), bound) in found.iter().zip(exact.temperature(id)).zip(bounds) {
            let error = (t - right).abs();
            if error > bound + own { println!("EXCEEDED {error:e} {bound:e} own {own:e}"); }
            if error > 10.0 * own.max(1e-12) {
                ratios.push(bound / error);
            }
        }
    }
    ratios.sort_by(f64::total_cmp);
    ratios
}


pub fn shown() {
    for (name, network, stop) in [("gearbox", gearbox(), 3600.0), ("ladder", rc_ladder(), 300.0), ("stiff", stiff(), 300.0), ("masses", two_masses(), 5.0), ("nafems", nafems_t3(), 32.0)] {
        for tolerance in [1e-3, 1e-5, 1e-7] {
            let r = ratios(&network, tolerance, stop);
            if r.is_empty() { println!("{name} {tolerance:e} none"); continue; }
            println!("{name} {tolerance:e}: least {:.2} median {:.2} 95% {:.2} most {:.1e} of {}", r[0], r[r.len() / 2], r[r.len() * 95 / 100], r[r.len() - 1], r.len());
        }
    }
    for tolerance in [1e-3, 1e-5, 1e-7] {
        let mut all: Vec<f64> = vec![0.0]; all.extend((0..200).flat_map(|seed| ratios(&random(seed), tolerance, 100.0)));
        all.sort_by(f64::total_cmp);
        println!("random {tolerance:e}: least {:.2} median {:.2} 95% {:.2} most {:.1e} of {}", all[0], all[all.len() / 2], all[all.len() * 95 / 100], all[all.len() - 1], all.len());
    }
}
