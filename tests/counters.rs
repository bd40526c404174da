//! Counters: what runs cost, without a clock. A change that makes one of these networks take more
//! steps, evaluations, factors or solves fails here; one that makes it take clearly fewer may lower
//! the ceilings, which stand a tenth above what was counted. `--nocapture` shows the counts.
#![allow(clippy::print_stdout, reason = "the counts")]

use crate::support;

use lptn::prelude::*;
use support::{StiffLadder, grid, shipped, transient};

/// What is counted, in the order of the ceilings.
const NAMES: [&str; 6] =
    ["steps", "evaluations", "factorisations", "solves", "iterations", "numbers in the factors"];

/// Evaluations are those of heat flows and of the integrands of the books.
fn work(solution: &Solution) -> [u64; 6] {
    let done = solution.statistics();
    let evaluations = done.flow_evaluations + done.quadrature_evaluations;
    let [solves, iterations] = [done.linear_solves, done.linear_iterations];
    [done.steps, evaluations, done.factorizations, solves, iterations, done.fill]
}

fn of_network(name: &str) -> [u64; 6] {
    let (netlist, system) = shipped(name);
    work(&transient(&netlist).solve(&system).expect("it runs"))
}

/// Ten minutes at a tolerance of 1e-4 K.
fn of_system(system: &ThermalSystem) -> [u64; 6] {
    let run = Transient::until(Time(600.0)).tolerance(1e-4);
    work(&run.solve(system).expect("it runs"))
}

#[test]
fn runs_take_no_more_than_they_did() {
    let grid = grid(100, 30.0, (50, 51));
    let networks = [
        ("gearbox", of_network("gearbox.toml"), [14, 41, 6, 79, 0, 22]),
        ("two nodes that radiate", of_network("into_space.toml"), [415, 1257, 419, 835, 0, 2]),
        ("motor", of_network("motor.toml"), [1139, 3661, 1199, 2364, 0, 5]),
        ("thermostat", of_network("thermostat.toml"), [208, 730, 3, 1455, 0, 2]),
        (
            "ladder of 1000",
            of_system(&StiffLadder::new(1000).system),
            [1775, 3668, 107, 1887, 0, 2199],
        ),
        ("grid of 100 x 100", of_system(&grid), [24, 70, 7, 135, 391, 262680]),
    ];
    let mut more = Vec::new();
    for (network, found, most) in networks {
        println!("{network}: {found:?}");
        for ((name, found), most) in NAMES.iter().zip(found).zip(most) {
            if found > most {
                more.push(format!("{network}: {found} {name}, known are {most}"));
            }
        }
    }
    assert!(more.is_empty(), "{more:#?}");
}
