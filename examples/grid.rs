//! A heated plate of 100 x 100 cells: 10 000 nodes, 200 output times, checked against the exact
//! series. `cargo run --release --example grid`
#![allow(clippy::print_stdout)]

use std::f64::consts::PI;

use lptn::NodeId;
use lptn::prelude::*;
const N: usize = 100;
const SOURCE: (usize, usize) = (30, 60);
const PROBE: (usize, usize) = (35, 50);

fn main() -> Result<(), lptn::Error> {
    let (network, probe) = plate()?;
    let system = ThermalSystem::assemble(&network)?;
    let run = Transient::until(Time(2e4)).every(Time(100.0)).tolerance(1e-4).record(&[probe]);
    let solution = run.solve(&system)?;
    let found = solution.series(probe)?;
    let error = |(t, found): (&f64, &f64)| (found - 273.15 - exact(*t)).abs();
    // the series takes longer than the run, so only some rows are compared
    let worst = solution.times().iter().zip(&found).step_by(25).map(error).fold(0.0, f64::max);
    let (statistics, balance) = (solution.statistics(), solution.ledger().relative_residual());
    println!("{} nodes, {} rows", network.nodes().len(), solution.times().len());
    println!("{} steps, {} factorizations", statistics.steps, statistics.factorizations);
    println!(
        "rise at the end {:.4} K, largest error {worst:.1e} K",
        found[found.len() - 1] - 273.15
    );
    println!("balance {:.1e} of the heat exchanged", balance.unwrap_or(0.0));
    Ok(())
}

/// Cells of 1 J/K joined by 1 W/K, an edge at 0 degC all around, 100 W into one cell.
fn plate() -> Result<(Network, NodeId), lptn::Error> {
    let mut b = NetworkBuilder::new();
    let (zero, joint) = (Temperature::celsius(0.0), Conductance(1.0));
    let edge = b.boundary("edge", zero);
    let cells: Vec<NodeId> =
        (0..N * N).map(|k| b.node(&format!("c{k}"), HeatCapacity(1.0), zero)).collect();
    for (k, &cell) in cells.iter().enumerate() {
        let (i, j) = (k / N, k % N);
        for (there, to) in [(j + 1 < N, k + 1), (i + 1 < N, k + N)] {
            there.then(|| b.resistor(&format!("r{k}_{to}"), cell, cells[to], joint));
        }
        for side in 0..[i == 0, i + 1 == N, j == 0, j + 1 == N].iter().filter(|&&s| s).count() {
            b.resistor(&format!("e{k}_{side}"), cell, edge, joint);
        }
    }
    b.source("heater", cells[SOURCE.0 * N + SOURCE.1], HeatFlow(100.0));
    Ok((b.build()?, cells[PROBE.0 * N + PROBE.1]))
}

/// The rise of the probe in K: products of sines with the rates `4 - 2 cos(a) - 2 cos(b)`.
fn exact(t: f64) -> f64 {
    let angle = |i: usize| i as f64 * PI / (N as f64 + 1.0);
    let shape =
        |i: usize, at: (usize, usize)| [at.0, at.1].map(|x| (angle(i) * (x as f64 + 1.0)).sin());
    let term = |i: usize, j: usize| {
        let rate = 4.0 - 2.0 * angle(i).cos() - 2.0 * angle(j).cos();
        let place =
            shape(i, SOURCE)[0] * shape(j, SOURCE)[1] * shape(i, PROBE)[0] * shape(j, PROBE)[1];
        place * -f64::exp_m1(-rate * t) / rate
    };
    let sum: f64 =
        (1..=N).flat_map(|i| (1..=N).map(move |j| (i, j))).map(|(i, j)| term(i, j)).sum();
    400.0 * sum / ((N as f64 + 1.0) * (N as f64 + 1.0))
}
