//! Expansions: a network read from its flat netlist gives the same results to the last digit.

use crate::support;

use lptn::prelude::*;
use support::{networks, shipped, transient};

fn files() -> Vec<String> {
    let entries = std::fs::read_dir(networks()).expect("the folder of networks");
    let names =
        entries.map(|entry| entry.expect("an entry").file_name().into_string().expect("UTF-8"));
    let mut names: Vec<String> = names.filter(|name| name.ends_with(".toml")).collect();
    names.sort();
    names
}

/// The network as it is read from its expansion; CSV files are looked for beside the original.
fn expanded(name: &str, text: &str) -> (lptn_netlist::Netlist, ThermalSystem) {
    let path = networks().join(name);
    let netlist =
        lptn_netlist::parse_file(&path, text.as_bytes()).unwrap_or_else(|e| panic!("{name}: {e}"));
    let system = ThermalSystem::assemble(&netlist.network).expect("it assembles");
    (netlist, system)
}

fn bits(values: &[f64]) -> Vec<u64> {
    values.iter().map(|value| value.to_bits()).collect()
}

/// Property, over every network that is shipped.
#[test]
fn steady_states_and_runs_are_the_same_to_the_last_digit() {
    for name in files() {
        let (netlist, system) = shipped(&name);
        if netlist.not_flat().is_some() {
            assert!(!netlist.network.grids().is_empty(), "{name}");
            continue;
        }
        let (again, flat) = expanded(&name, &netlist.expanded());
        assert_eq!(again.expanded(), netlist.expanded(), "{name}");
        if let Err(error) = lptn_netlist::prove(
            &netlist.expanded(),
            &networks().join(&name),
            &netlist.network,
            (0.0, 3600.0),
        ) {
            panic!("{name}: {error}");
        }
        let steady = |system: &ThermalSystem| {
            SteadyState::solve(system, 0.0)
                .map(|s| bits(&s.temperatures))
                .map_err(|error| error.code())
        };
        assert_eq!(steady(&flat), steady(&system), "{name}");
        let run = |netlist: &lptn_netlist::Netlist, system: &ThermalSystem| {
            let solution = transient(netlist).solve(system).expect("it runs");
            (bits(solution.times()), bits(solution.row(solution.times().len() - 1)))
        };
        assert_eq!(run(&again, &flat), run(&netlist, &system), "{name}");
    }
}
