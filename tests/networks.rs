//! Every shipped network: it parses without a warning, runs, and closes its books.

#![allow(clippy::print_stdout, reason = "the measured figures, shown with --nocapture")]

use crate::support;

use lptn::prelude::*;
use lptn_solve::{Column, RecordedNodes};
use support::{networks, shipped, transient};

fn files() -> Vec<String> {
    let mut names: Vec<String> = std::fs::read_dir(networks())
        .expect("the folder of networks")
        .map(|entry| entry.expect("an entry").file_name().into_string().expect("a name in UTF-8"))
        .filter(|name| name.ends_with(".toml"))
        .collect();
    names.sort();
    assert!(names.len() >= 7, "only {names:?}");
    names
}

#[test]
fn every_network_parses_without_a_warning() {
    for name in files() {
        let (netlist, _) = shipped(&name);
        // two are about bodies that nothing around takes part in
        let alone = ["melting.toml", "two_masses.toml"].contains(&name.as_str());
        let odd = netlist.warnings.iter().filter(|w| !(alone && w.code == "network::no_boundary"));
        let warnings: Vec<String> = odd.map(ToString::to_string).collect();
        assert!(warnings.is_empty(), "{name}: {warnings:?}");
        assert!(netlist.network.title().is_some(), "{name} has no title");
    }
}

#[test]
fn every_ledger_closes_to_1e_8_of_the_heat_turned_over() {
    for name in files() {
        let (netlist, system) = shipped(&name);
        for tolerance in [1e-5, 1e-6, 1e-7] {
            let solution =
                transient(&netlist).tolerance(tolerance).solve(&system).expect("it runs");
            let ledger = solution.ledger();
            let residual = ledger.relative_residual().expect("heat is turned over").abs();
            println!("{name} at {tolerance:e} K: {residual:.1e} of {:.3e} J", ledger.turned_over);
            assert!(residual <= 1e-8, "{name} at {tolerance:e} K: {residual:e}");
            assert!(ledger.closes());
        }
    }
}

#[test]
fn at_coarse_tolerances_the_ledger_keeps_its_stated_bound() {
    for name in files() {
        let (netlist, system) = shipped(&name);
        for tolerance in [1e-3, 1e-4] {
            let solution =
                transient(&netlist).tolerance(tolerance).solve(&system).expect("it runs");
            assert!(
                solution.ledger().closes(),
                "{name} at {tolerance:e} K: {:?}",
                solution.ledger()
            );
        }
    }
}

/// Networks without a steady state at the start of their run, and what is said of them.
const RESTLESS: [(&str, &str); 4] = [
    ("coolant_reversal.toml", "solve::undetermined"), // the coolant stands still at the start
    ("gearbox_fan.toml", "steady::cycles"),           // too hot without the fan, too cold with it
    ("melting.toml", "steady::no_boundary"),          // heated, and nothing takes the heat away
    ("thermostat.toml", "steady::cycles"),
];

#[test]
fn steady_states_are_in_balance() {
    for name in files() {
        let (_, system) = shipped(&name);
        let said = SteadyState::solve(&system, 0.0).map(|steady| {
            // where nothing heats a network, what Newton's method leaves is all the heat there is
            let rest = if system.is_linear() { 0.0 } else { 1e-12 };
            assert!(steady.imbalance().abs() <= 1e-10 * steady.turned_over() + rest, "{name}");
        });
        let expected =
            RESTLESS.into_iter().find(|(restless, _)| *restless == name).map(|(_, code)| code);
        assert_eq!(said.err().map(|error| error.code()), expected, "{name}");
    }
}

#[test]
fn a_run_ends_on_its_stop_and_its_rows_increase() {
    for name in files() {
        let (netlist, system) = shipped(&name);
        let solution = transient(&netlist).solve(&system).expect("it runs");
        let (times, run) = (solution.times(), netlist.run.as_ref().expect("it has [run]"));
        assert_eq!(
            (times[0].to_bits(), times[times.len() - 1].to_bits()),
            (run.start.to_bits(), run.stop.to_bits())
        );
        assert!(times.windows(2).all(|pair| pair[0] < pair[1]), "{name}");
    }
}

/// Heat flows that are read while a run comes to its rows are, to the bit, those of a run that kept
/// every temperature.
#[test]
fn columns_do_not_depend_on_what_is_kept() {
    for name in files() {
        let (netlist, system) = shipped(&name);
        let asked = Selection::all(&netlist.network);
        let table = |record| {
            let transient = Transient { record, ..transient(&netlist) };
            let solution = transient.solve(&system).expect("it runs");
            let table = Table::of_solution(&solution, &asked, &netlist.temperature_unit);
            let bits = |column: &Column| -> Vec<u64> {
                column.values.iter().map(|value| value.to_bits()).collect()
            };
            table.columns().iter().map(|column| (column.name.clone(), bits(column))).collect()
        };
        let [all, read]: [Vec<_>; 2] = [RecordedNodes::All, asked.record()].map(table);
        assert_eq!(all, read, "{name}");
    }
    let (netlist, _) = shipped("gearbox.toml");
    let heats = Selection::matching(&netlist.network, &["*.Q".into()]).expect("heat flows");
    assert!(matches!(heats.record(), RecordedNodes::Columns { nodes, .. } if nodes.is_empty()));
}
