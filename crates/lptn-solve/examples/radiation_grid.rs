//! A plate of 50 x 50 cells that radiates to the sky and between far cells, under 300 sources that
//! step and ramp.
//!
//! `cargo run --release -p lptn-solve --example radiation_grid [TOLERANCE [IN OUT]]`
//!
//! The tolerance is in K. `IN` is a network in the binary form of the benchmark generator, in place
//! of the plate made here; the temperatures of its probes in degC are then written to `OUT`, row by
//! row, as little-endian doubles.
#![allow(clippy::print_stdout, clippy::many_single_char_names)]

use std::error::Error;
use std::time::Instant;

use lptn_assembly::ThermalSystem;
use lptn_network::{
    AfterEnd, Area, Conductance, ConductorKind, Course, End, HeatCapacity, Network, NetworkBuilder,
    NodeId, Path, Temperature, Time, ZERO_CELSIUS,
};
use lptn_solve::{Solution, Transient};
use lptn_units::{Dimension, Interpolation, Outside, Table1, Type};

#[path = "radiation_grid/plate.rs"]
mod plate;
use plate::Plate;

type Outcome<T> = Result<T, Box<dyn Error>>;

fn main() -> Outcome<()> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let tolerance = arguments.first().map_or(Ok(0.02), |text| text.parse())?;
    let plate = match arguments.get(1) {
        Some(file) => Plate::read(&std::fs::read(file)?),
        None => Plate::make(50),
    };
    let begin = Instant::now();
    let (network, probes) = network(&plate)?;
    let system = ThermalSystem::assemble(&network)?;
    let assembled = begin.elapsed().as_secs_f64();
    let run = Transient::until(Time(plate.stop)).at(&plate.rows).record(&probes);
    let solution = run.clone().tolerance(tolerance).solve(&system)?;
    let seconds = begin.elapsed().as_secs_f64() - assembled;
    let found = temperatures(&solution, &probes, plate.rows.len());
    let (s, balance) =
        (solution.statistics(), solution.ledger().relative_residual().unwrap_or(0.0));
    println!("assembly {assembled:.3} s, run {seconds:.3} s");
    println!("{} steps, {} factorizations, {} solves", s.steps, s.factorizations, s.linear_solves);
    println!("balance {balance:.1e} of the heat exchanged");
    if let Some(file) = arguments.get(2) {
        std::fs::write(file, found.iter().flat_map(|t| t.to_le_bytes()).collect::<Vec<u8>>())?;
    } else {
        let exact = temperatures(
            &run.tolerance(1e-3 * tolerance).solve(&system)?,
            &probes,
            plate.rows.len(),
        );
        let error = found.iter().zip(&exact).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        let hottest = exact.iter().copied().fold(0.0, f64::max);
        println!(
            "hottest {hottest:.3} degC, largest difference to a thousandth of the tolerance \
             {error:.1e} K"
        );
    }
    Ok(())
}

/// Temperatures of the probes in degC at the last `rows` rows, row by row.
fn temperatures(solution: &Solution, probes: &[NodeId], rows: usize) -> Vec<f64> {
    let columns: Vec<Vec<f64>> = probes.iter().filter_map(|&id| solution.temperature(id)).collect();
    let first = solution.times().len() - rows; // the generator has no row at the start
    let row = |k: usize| columns.iter().map(move |column| column[first + k] - ZERO_CELSIUS);
    (0..rows).flat_map(row).collect()
}

fn network(plate: &Plate) -> Outcome<(Network, Vec<NodeId>)> {
    let mut b = NetworkBuilder::new();
    let kelvin = |celsius: &f64| Temperature::celsius(*celsius);
    let cells = plate.capacity.iter().zip(&plate.start).enumerate();
    let cells: Vec<NodeId> =
        cells.map(|(i, (c, t))| b.node(&format!("n{i}"), HeatCapacity(*c), kelvin(t))).collect();
    let given = plate.given.iter().enumerate();
    let given: Vec<_> = given.map(|(i, t)| b.boundary(&format!("b{i}"), kelvin(t))).collect();
    let end = |i: usize| {
        cells.get(i).map_or_else(|| End::Boundary(given[i - cells.len()]), |&n| End::Node(n))
    };
    for (k, &(i, j, g)) in plate.links.iter().enumerate() {
        b.resistor(&format!("r{k}"), end(i), end(j), Conductance(g));
    }
    for (k, &(i, j, area)) in plate.radiation.iter().enumerate() {
        let path = Path::radiation(Area(area));
        b.conductor(&format!("q{k}"), ConductorKind::Radiation, (end(i), end(j)), path);
    }
    for (k, (cell, points)) in plate.sources.iter().enumerate() {
        let signal = format!("p{k}");
        b.signal(&signal, Type::of(Dimension::POWER), course(points)?);
        let power = b.expression(&signal, None)?;
        b.source(&format!("s{k}"), cells[*cell], power);
    }
    let probes = plate.probes.iter().map(|&i| cells[i]).collect();
    Ok((b.build()?, probes))
}

/// Straight lines through the points; steps if a time repeats.
fn course(points: &[(f64, f64)]) -> Outcome<Course> {
    let after = AfterEnd::Hold;
    let mut kept = points.to_vec();
    kept.reverse(); // of two points at one time the last stays
    kept.dedup_by_key(|point| point.0);
    kept.reverse();
    let jumps = kept.len() < points.len();
    let (times, values) = kept.into_iter().unzip();
    Ok(if jumps {
        Course::Steps { times, values, after }
    } else {
        let points = Table1::new(times, values, Interpolation::Linear, Outside::Hold)?;
        Course::Curve { points, after }
    })
}
