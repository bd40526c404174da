//! What closing the books costs: plates of cells, 200 outputs, for several settings of Newton's
//! method. Run with `cargo bench -p lptn-cvodes`; it prints tables for Markdown.
#![allow(clippy::print_stdout, clippy::unwrap_used, reason = "a program that is run by hand")]

#[path = "../tests/common/mod.rs"]
mod common;
#[path = "../tests/common/radiation.rs"]
mod radiation;

use std::time::Instant;

use common::{equal_times, plate};
use lptn_cvodes::{Cvodes, linked};
use lptn_integrate::{Integrator, OdeSystem, Options, Statistics};
use radiation::Radiating;

/// A system, where it starts, how long it runs, and the factor from its quadratures to the heat
/// that went in.
struct Case<S> {
    name: &'static str,
    system: fn() -> S,
    start: f64,
    end: f64,
    heat_in: fn(&[f64]) -> f64,
    turnover: fn(f64, &[f64]) -> f64,
}

struct Outcome {
    samples: Vec<f64>,
    books: f64,
    statistics: Statistics,
    seconds: f64,
}

fn run<S: OdeSystem>(case: &Case<S>, options: &Options) -> Outcome {
    let system = (case.system)();
    let size = system.size();
    let begin = Instant::now();
    let mut integrator = Cvodes::new(system, 0.0, &vec![case.start; size], options).unwrap();
    integrator.set_stop(case.end);
    let (mut samples, mut y, mut books) = (Vec::new(), vec![0.0; size], 0.0_f64);
    for (k, t) in equal_times(case.end, 200).into_iter().enumerate() {
        while integrator.time() < t {
            integrator.step().unwrap();
        }
        integrator.interpolate(t, &mut y).unwrap();
        samples.extend(y.iter().step_by(1 + size / 100));
        if k % 10 == 9 {
            let stored: f64 = integrator
                .state()
                .iter()
                .zip(integrator.system().mass())
                .map(|(y, m)| (y - case.start) * m)
                .sum();
            let time = integrator.time();
            let booked = integrator.quadratures().unwrap();
            books =
                books.max((stored - (case.heat_in)(booked)).abs() / (case.turnover)(time, booked));
        }
    }
    Outcome {
        samples,
        books,
        statistics: integrator.statistics(),
        seconds: begin.elapsed().as_secs_f64(),
    }
}

fn table<S: OdeSystem>(case: &Case<S>) {
    let reference = run(case, &Options { tolerance: 1e-8, ..Options::default() }).samples;
    println!("\n{}\n", case.name);
    println!(
        "| tolerance | Newton | steps | factorisations | solves | flows | s | error | books |"
    );
    println!("|---|---|---|---|---|---|---|---|---|");
    for tolerance in [1e-3, 1e-5] {
        for newton_coefficient in [Some(1e-1), Some(1e-2), Some(1e-3), Some(1e-4), None] {
            row(case, &Options { tolerance, newton_coefficient, ..Options::default() }, &reference);
        }
    }
}

fn row<S: OdeSystem>(case: &Case<S>, options: &Options, reference: &[f64]) {
    let outcome = run(case, options);
    let seconds = (0..2).map(|_| run(case, options).seconds).fold(outcome.seconds, f64::min);
    let error =
        outcome.samples.iter().zip(reference).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    let s = outcome.statistics;
    println!(
        "| {:e} | {} | {} | {} | {} | {} | {:.4} | {:.1e} | {:.1e} |",
        options.tolerance,
        options.newton_coefficient.map_or("default".to_owned(), |c| format!("{c:e}")),
        s.steps,
        s.factorizations,
        s.linear_solves,
        s.flow_evaluations,
        seconds,
        error,
        outcome.books,
    );
}

fn plate_with_books() -> common::Linear {
    let mut plate = plate(100, 300.0);
    plate.books = true;
    plate
}

fn main() {
    println!("SUNDIALS {:?}", linked());
    table(&Case {
        name: "100 by 100 cells, linear",
        system: plate_with_books,
        start: 20.0,
        end: 2e4,
        heat_in: |q| q[0],
        turnover: |t, _| 300.0 * t,
    });
    let radiating = |name, system| Case {
        name,
        system,
        start: 293.15,
        end: 200.0,
        heat_in: |q| q[0] + q[1],
        turnover: |_, q| q[0] + q[2],
    };
    table(&radiating("60 by 60 cells with radiation", || Radiating::plate(60, 60, 20_000.0, 5e-9)));
    table(&radiating("200 cells in a row with radiation", || {
        Radiating::plate(1, 200, 2_000.0, 5e-9)
    }));
    table(&radiating("6 cells with radiation", || Radiating::plate(2, 3, 500.0, 5e-9)));
}
