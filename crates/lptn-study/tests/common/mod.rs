//! Networks whose uncertainty has a closed form, and what sizes ask of a netlist.
#![allow(
    dead_code,
    unreachable_pub,
    clippy::unwrap_used,
    reason = "each test file uses a part of it"
)]

use lptn_analysis::RunAnalysis;
use lptn_netlist::{Netlist, parse};
use lptn_solve::{Proceed, available_threads};
use lptn_study::uncertainty::{Estimate, Sobol, Uncertainty, UncertaintyError, UncertaintyTask};
use lptn_study::{Aim, Demand, Moments};

/// What `[size]` of a netlist demands in steady state.
pub fn demand(netlist: &Netlist) -> Demand<'_> {
    Demand {
        network: &netlist.network,
        netlist,
        cases: &[],
        requirements: &netlist.studies.sizes[0].requirements,
        moments: Moments::Steady(0.0),
        doubt: None,
        watcher: &|_| Proceed::Continue,
    }
}

/// What it seeks.
pub fn aim(netlist: &Netlist) -> Aim<'_> {
    let study = &netlist.studies.sizes[0];
    let of_results = study.objective.of_results;
    Aim { value: &study.objective.value, goal: study.goal, of_results }
}

/// 1000 J/K over `R` (0.5 K/W) towards `T_amb`, heated by `P`, for 1000 s: two time constants.
pub const ONE_NODE: &str = "[default]\nT0 = \"T_amb\"\n[node]\nblock = { C = \"1 kJ/K\" \
    }\n[boundary]\n\
    air = { T = \"T_amb\" }\n[resistor]\nskin = { from = \"block\", to = \"air\", R = \"R\" }\n\
    [source]\nloss = { into = \"block\", P = \"P\" }\n[run]\nstop = \"1000 s\"\noutput = { every \
    = \"20 s\" }\n\
    tolerance = \"1e-7 K\"\n";

/// K for each W at its end: 0.5 K/W (1 - exp(-2)).
pub const RISE: f64 = 0.432_332_358_381_693_65;

/// 10 J/K that radiates `P` over `Gr` towards 20 degC until it is settled; its limit is 600 K.
pub const RADIATING: &str = "[node]\nblock = { C = \"10 J/K\", T0 = \"20 degC\" }\n[boundary]\n\
    space = { T = \"20 degC\" }\n[radiation]\nskin = { from = \"block\", to = \"space\", Gr \
    = \"Gr\" }\n\
    [source]\nloss = { into = \"block\", P = \"P\" }\n[limit]\nhot = { of = \"block.T\", below \
    = \"326.85 degC\" }\n\
    [run]\nstop = \"1 h\"\noutput = { every = \"30 min\" }\n";

/// A network with these parameters; R is 0.5 K/W unless they say otherwise.
pub fn parsed(network: &str, param: &str) -> Netlist {
    let r = if network.contains("R = \"R\"") && !param.contains("R =") {
        "R = \"0.5 K/W\"\n"
    } else {
        ""
    };
    let text = format!("format = 1\n[param]\n{r}{param}\n{network}");
    parse("uncertain.toml", &text).unwrap_or_else(|rejected| panic!("{rejected}"))
}

/// The run of the netlist, every node asked for.
pub fn task(netlist: &Netlist) -> UncertaintyTask<'_> {
    let network = &netlist.network;
    let run = RunAnalysis::of(network, netlist.run.as_ref().unwrap());
    UncertaintyTask {
        network,
        parameters: netlist.overrides(),
        run,
        nodes: network.node_ids().collect(),
    }
}

/// Samples on all threads with seed 1.
pub fn sobol(netlist: &Netlist, samples: usize) -> Uncertainty {
    sobol_with(netlist, (samples, 1, available_threads())).unwrap_or_else(|e| panic!("{e}"))
}

pub fn sobol_with(
    netlist: &Netlist,
    how: (usize, u32, usize),
) -> Result<Uncertainty, UncertaintyError> {
    sample(&task(netlist), how)
}

pub fn sample(
    task: &UncertaintyTask<'_>,
    (samples, seed, threads): (usize, u32, usize),
) -> Result<Uncertainty, UncertaintyError> {
    task.sobol(&Sobol { samples, seed, threads, control: &|| Proceed::Continue, finished: &|| {} })
}

#[track_caller]
pub fn near(found: f64, expected: f64, relative: f64) {
    assert!((found - expected).abs() <= relative * expected.abs(), "{found:e} is not {expected:e}");
}

/// Within so many of its own standard errors, and not without one.
#[track_caller]
pub fn within(found: Estimate, expected: f64, errors: f64) {
    let error = found.error.unwrap();
    assert!((found.value - expected).abs() <= errors * error + 1e-9, "{found:?} is not {expected}");
}
