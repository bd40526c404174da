//! What is narrow over temperature is seen wherever a temperature may be read: random networks
//! against small steps with the formulas of this test.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking, in its helpers too")]
#![allow(clippy::print_stdout, reason = "the measured figures, shown with --nocapture")]

mod case;
mod known;
mod laws;
mod oracle;
mod text;

use crate::features::{Dice, ZERO, seeds};
use case::Case;
use lptn_assembly::ThermalSystem;
use lptn_network::Time;
use lptn_solve::{Solution, Transient, TransientError};
use oracle::Oracle;

/// Errors beyond so many tolerances have to be told.
const FACTOR: f64 = 10.0;

/// How many random networks are tried; `LPTN_GUARD_CASES` gives another number.
const CASES: u64 = 60;

/// Rows of a run.
const ROWS: u32 = 100;

fn solved(case: &Case) -> Result<Solution, TransientError> {
    let text = case.text();
    let netlist = lptn_netlist::parse("net.toml", &text).unwrap_or_else(|e| panic!("{e}\n{text}"));
    let system = ThermalSystem::assemble(&netlist.network).unwrap();
    let run = Transient::until(Time(case.stop)).every(Time(case.stop / f64::from(ROWS)));
    run.tolerance(case.tolerance).solve(&system)
}

/// Temperatures in degC of all vertices in every row; `None` if a massless node may have had
/// several.
fn right(case: &Case) -> Option<Vec<Vec<f64>>> {
    let mut oracle = Oracle::new(case);
    let rows = (0..=ROWS).map(|row| {
        oracle.to(case.stop * f64::from(row) / f64::from(ROWS));
        oracle.celsius()
    });
    let rows = rows.collect();
    (!oracle.is_doubtful()).then_some(rows)
}

/// The largest error over the tolerance.
fn error_of(case: &Case, solution: &Solution, right: &[Vec<f64>]) -> f64 {
    let mut error = 0.0_f64;
    for i in 0..case.nodes.len() {
        let id = solution.network().node(&format!("n{i}")).unwrap();
        let found = solution.temperature(id).unwrap();
        // an event has a row of its own
        for (row, celsius) in right.iter().enumerate() {
            let time = case.stop * row as f64 / f64::from(ROWS);
            let near = |t: &f64| (t - time).abs() < 1e-9 * case.stop;
            let place = solution.times().iter().rposition(near).unwrap();
            error = error.max((found[place] - ZERO - celsius[i]).abs() / case.tolerance);
        }
    }
    error
}

#[test]
fn nothing_narrow_is_passed_unseen_wherever_it_is_read() {
    let mut failed = Vec::new();
    let (mut worst, mut told, mut doubtful, mut steps) = (0.0_f64, 0, 0, 0);
    for seed in seeds(CASES) {
        let case = Case::random(&mut Dice::new(seed.wrapping_mul(0xD134_2543_DE82_EF95)));
        let Some(right) = right(&case) else {
            doubtful += 1;
            continue;
        };
        let solution = match solved(&case) {
            Ok(solution) => solution,
            Err(error) => {
                failed.push(seed);
                println!("seed {seed}: {error}\n{}", case.text());
                continue;
            }
        };
        steps += solution.statistics().steps;
        let error = error_of(&case, &solution, &right);
        match solution.why_unbounded() {
            None => worst = worst.max(error),
            Some(_) => told += 1,
        }
        if error > FACTOR && solution.error_is_bounded() {
            failed.push(seed);
            println!(
                "seed {seed}: {error:.1} tolerances of {:e} K, grown {:.2}\n{}",
                case.tolerance,
                solution.growth(),
                case.text()
            );
        }
    }
    println!("worst {worst:.2} tolerances, {told} told, {doubtful} left out, {steps} steps");
    assert!(failed.is_empty(), "{failed:?}");
}

#[test]
fn errors_that_a_faster_node_hides_are_made_up_for() {
    let known = [known::beside_a_faster_one(), known::magnified(), known::of_falling_capacity()];
    for case in &known {
        let solution = solved(case).unwrap();
        let error = error_of(case, &solution, &right(case).unwrap());
        println!("{error:.2} tolerances, grown {:.2}", solution.growth());
        assert!(error < 0.5 * FACTOR && solution.error_is_bounded(), "{error}\n{}", case.text());
    }
}
