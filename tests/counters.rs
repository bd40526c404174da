//! Counters: what runs cost, without a clock. A change that makes one of these networks take more
//! steps, evaluations, factors or solves fails here; one that makes it take clearly fewer may lower
//! the ceilings, which stand a tenth above what was counted. `--nocapture` shows the counts.
#![allow(clippy::print_stdout, reason = "the counts")]

use crate::support;

use lptn::prelude::*;
use lptn_network::NodeId;
use lptn_solve::{LinearSolver, Proceed, Progress, Statistics, Watch};
use lptn_study::Candidate;
use support::{StiffLadder, grid, shipped, transient};

/// What is counted, in the order of the ceilings.
const NAMES: [&str; 6] =
    ["steps", "evaluations", "factorisations", "solves", "iterations", "numbers in the factors"];

/// Evaluations are those of heat flows and of the integrands of the books.
fn work(solution: &Solution) -> [u64; 6] {
    counts(solution.statistics())
}

fn counts(done: &Statistics) -> [u64; 6] {
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
        ("motor", of_network("motor.toml"), [338, 6703, 338, 5199, 0, 5]),
        ("thermostat", of_network("thermostat.toml"), [208, 730, 3, 1455, 0, 2]),
        (
            "ladder of 1000",
            of_system(&StiffLadder::new(1000).system),
            [1775, 3668, 107, 1887, 0, 2199],
        ),
        ("grid of 100 x 100", of_system(&grid), [24, 70, 7, 135, 541, 262680]),
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

/// A block that is heated evenly from one side, so that its four corners there get hottest.
const BLOCK: &str = r#"
format = 1
[grid.block]
size = ["0.1 m", "0.1 m", "0.1 m"]
cells = [8, 8, 8]
material = "steel_1010"
T0 = "25 degC"
[boundary]
air = { T = "25 degC" }
[convection]
top = { from = "block.z1", to = "air", h = "20 W/(m^2 K)" }
[source]
heat = { into = "block.z0", P = "PULSE" }
[run]
stop = "1 h"
output = { every = "10 min" }
"#;

/// A rod that melts from its heated end: a front that passes each node. A tolerance of 0.1 K took
/// 11,090 steps, 0.001 K 3,260: speeds that fell and rose again counted as errors that grow.
#[test]
fn a_looser_tolerance_takes_no_more_steps_through_a_front() {
    let mut text = String::from(
        "format = 1\n[material.wax]\ncp = \"2 kJ/(kg K)\"\ndensity = \"900 kg/m^3\"\nk = \"0.2 W/(m K)\"\n\
         solidus = \"50 degC\"\nliquidus = \"52 degC\"\nlatent_heat = \"200 kJ/kg\"\nsource = \"made up\"\n\
         [default]\nT0 = \"20 degC\"\n",
    );
    for i in 0..120 {
        text += &format!("[node.n{i}]\nmaterial = \"wax\"\nmass = \"0.02 kg\"\n");
    }
    for i in 1..120 {
        text += &format!("[resistor.r{i}]\nfrom = \"n{}\"\nto = \"n{i}\"\nG = \"2 W/K\"\n", i - 1);
    }
    text += "[source]\nheat = { into = \"n0\", P = \"60 W\" }\n";
    let (_, system) = support::parsed(&text);
    let steps = [1.0, 0.1, 0.01, 0.001].map(|tolerance| {
        let run = Transient::until(Time(7200.0)).tolerance(tolerance).solve(&system);
        run.unwrap().statistics().steps
    });
    println!("{steps:?}");
    assert!(steps.windows(2).all(|pair| pair[0] <= pair[1]), "{steps:?}");
}

/// A comparison integrates once, as the run does; it looks at each step at the ends and five points
/// between them, and closely at the few cells that may be the hottest.
#[test]
fn comparing_a_grid_takes_little_more_than_running_it() {
    for pulse in ["if(t < 10 [min], 500 [W], 0 [W])", "500 W"] {
        let (netlist, system) = support::parsed(&BLOCK.replace("PULSE", pulse));
        let (mut alone, mut steps) = (0, 0);
        let solution = transient(&netlist).solve_observed(&system, &mut counting(&mut alone));
        let solution = solution.expect("it runs");
        let run = netlist.run.as_ref();
        let found = Candidate::evaluate_observed(&system, run, &mut counting(&mut steps));
        let found = found.expect("it runs");
        let (taken, known) = (counts(&found.statistics), counts(solution.statistics()));
        println!("{pulse}: {taken:?}, {steps} steps, {:?}", found.looks);
        for ((name, taken), known) in NAMES.iter().zip(taken).zip(known) {
            assert!(taken <= known, "{pulse}: {taken} {name}, the run alone takes {known}");
        }
        assert_eq!(steps, alone, "{pulse}: it is run once");
        // and where segments begin
        assert!(found.looks.placed <= 6 * steps + 10, "{pulse}: {:?}", found.looks);
        let nodes = system.network().nodes().len() as u64;
        assert!(found.looks.searched <= nodes * steps / 5, "{pulse}: {:?}", found.looks);
    }
}

/// An observer that counts the steps.
fn counting(steps: &mut u64) -> impl FnMut(Progress) -> Proceed {
    |_| {
        *steps += 1;
        Proceed::Continue
    }
}

/// Only the hottest node is found without those that are never the hottest, in the same place.
#[test]
fn the_hottest_of_all_nodes_is_the_same_alone() {
    for name in ["drive_cycle.toml", "gearbox.toml", "motor.toml", "two_masses.toml"] {
        let (netlist, system) = shipped(name);
        let watch = netlist.network.node_ids().map(|node| Watch { node, level: None }).collect();
        let all = Transient { watch, ..transient(&netlist) };
        let one = Transient { hottest_only: true, ..all.clone() };
        let [all, one] = [all, one].map(|run| hottest(&run.solve(&system).expect("it runs")));
        assert_eq!(all, one, "{name}");
    }
}

/// The node with the highest peak, of equals the first, with its peak in K and the time of it in s.
fn hottest(solution: &Solution) -> (NodeId, (f64, f64)) {
    let peaks = solution.watched().iter().map(|seen| (seen.watch.node, seen.peak));
    let hottest = peaks.reduce(|best, next| if next.1.0 > best.1.0 { next } else { best });
    hottest.expect("a node")
}

/// A point heats a block until it is steady. Smooth errors of an iterative solver would appear as
/// terms of a step that do not shrink, and only short steps would be accepted.
#[test]
fn iterations_take_the_steps_of_exact_factors() {
    let netlist = BLOCK
        .replace("[8, 8, 8]", "[20, 20, 20]")
        .replace("block.z0", "block[10,10,10]")
        .replace("PULSE", "100 W")
        .replace("1 h", "100 h");
    // a huge capacity nearby changes nothing
    let lake = "[node]\nlake = { C = \"1e12 J/K\", T0 = \"25 degC\" }\n[boundary]";
    let shore = "[convection]\nshore = { from = \"block.x0\", to = \"lake\", h = \"5 W/(m^2 K)\" }";
    let beside = netlist.replace("100 h", "1e6 h").replace("[boundary]", lake);
    let beside = beside.replace("[convection]", shore).replace("10 min", "1e5 h");
    for (netlist, tolerance) in [(&netlist, 1e-2), (&netlist, 1e-4), (&beside, 1e-2)] {
        let (netlist, system) = support::parsed(netlist);
        let steps = [LinearSolver::Cholesky, LinearSolver::Pcg].map(|linear_solver| {
            let run = Transient { linear_solver, ..transient(&netlist) }.tolerance(tolerance);
            let solution = run.solve(&system).expect("it runs");
            println!("{linear_solver:?}: {:?}", work(&solution));
            solution.statistics().steps as f64
        });
        assert!(steps[1] < 1.15 * steps[0], "{tolerance}: {steps:?}");
    }
}
