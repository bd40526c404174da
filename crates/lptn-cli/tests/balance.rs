//! An energy balance that does not close ends every verb that runs a network with `run::ledger`.
//!
//! No number of a run closes its balance to 1e-30 of the heat turned over: rounding alone is 1e-16.

use crate::common;

use std::fmt::Write as _;

use common::Folder;

/// A network of one node and one slow path, a record of it, and a study of every kind.
const OPEN: &str = r#"format = 1
[param]
R = "1 ± 0.01 K/W"
P = "100 W"
Q = "0 W"
[signal]
L = "0 W"
[node]
steel = { C = "1 kJ/K", T0 = "20 degC" }
[boundary]
air = { T = "20 degC" }
[resistor]
out = { from = "steel", to = "air", R = "R" }
[source]
loss = { into = "steel", P = "P + Q + L" }
[limit]
hot = { of = "steel.T", below = "5000 degC" }
[run]
stop = "1 h"
balance_error = 1e-30
[case.one]
set = { Q = "1 W" }
[size.s]
maximise = "R"
vary = { R = { from = "0.5 K/W", to = "2 K/W" } }
require = ["steel.T <= 110 [degC]"]
over = "run"
[sweep.s]
method = "grid"
axes = { R = ["1 K/W", "2 K/W"] }
over = "run"
report = { top = "max(steel.T)" }
[fit.f]
vary = { P = {} }
data = "record.csv"
column = { thermo = "steel.T" }
[infer.i]
data = "record.csv"
column = { thermo = "steel.T" }
sigma = "0.1 K"
find = ["L"]
[plan.p]
know = { P = "5 %" }
place = { thermo = { of = "steel.T", noise = "0.1 K" } }
every = "60 s"
duration = "1 h"
run = { hot = {} }
"#;

/// Each way to ask a network for a run. Verbs without one here are in [`NO_RUN`].
const RUNS: [&str; 19] = [
    "run a.toml --no-files",
    "run a.toml --no-files --case one",
    "run a.toml --no-files --uncertainty linear",
    "run a.toml --no-files --uncertainty sobol --samples 64",
    "plot a.toml -o a.svg",
    "compare a.toml b.toml",
    "compare a.toml b.toml --uncertainty",
    "compare cycle.toml --periodic",
    "size a.toml",
    "rank a.toml --over run",
    "fit network a.toml",
    "fit compare a.toml b.toml",
    "infer a.toml",
    "plan a.toml",
    "reduce a.toml --port steel",
    "verify a.toml",
    "steady a.toml --periodic --period 10min",
    "sweep a.toml",
    "sweep periodic.toml",
];

/// The verbs that ask for no run, or read one that is done.
const NO_RUN: &str = "report modes impedance gear graph check explain new units materials schema \
                      setup help";

fn folder() -> Folder {
    let folder = Folder::with("a.toml", OPEN);
    folder.write("b.toml", &OPEN.replace("1 ± 0.01 K/W", "1.2 ± 0.01 K/W"));
    let cycle = "over = \"periodic\"\nperiod = \"10 min\"\nreport";
    folder.write("periodic.toml", &OPEN.replace("over = \"run\"\nreport", cycle));
    let swing = "L = { t = [\"0 s\", \"5 min\", \"10 min\"], v = [\"0 W\", \"9 W\", \"0 W\"], \
                 after_end = \"repeat\" }";
    folder.write("cycle.toml", &OPEN.replace("L = \"0 W\"", swing));
    let mut record = "t [s],thermo [degC]\n".to_owned();
    for k in 0..61 {
        let (t, noise) = (60.0 * f64::from(k), 0.1 * ((f64::from(k) * 0.618).fract() - 0.5));
        writeln!(record, "{t},{:.3}", 20.0 - 100.0 * f64::exp_m1(-t / 1000.0) + noise).unwrap();
    }
    folder.write("record.csv", &record);
    folder
}

#[test]
fn an_open_balance_ends_every_verb() {
    let folder = folder();
    for line in RUNS {
        let words: Vec<&str> = line.split(' ').collect();
        let ran = folder.run(&words).exits(3);
        let text = format!("{}{}", ran.out, ran.err);
        assert!(text.contains("run::ledger"), "{line}: {text}");
        assert!(!text.contains("panicked"), "{line}: {text}");
    }
}

/// Whatever is added to the program is in one of the lists.
#[test]
fn every_verb_is_asked() {
    let help = Folder::empty().run(&["help"]).exits(0).out;
    let listed = help.split_once("Start here:").unwrap().1.split_once("Options:").unwrap().0;
    let starts = listed.lines().filter(|line| line.starts_with("  ") && !line.starts_with("   "));
    for verb in starts.map(|line| line.split_whitespace().next().unwrap()) {
        let asked = RUNS.iter().any(|line| line.split(' ').next() == Some(verb));
        let exempt = NO_RUN.split_whitespace().any(|other| other == verb);
        assert!(asked != exempt, "`{verb}` has to be in one of RUNS and NO_RUN");
    }
}

/// The same network at the usual share, and at a share that rounding allows.
#[test]
fn a_balance_is_held_to_the_share_that_is_written() {
    let folder = folder();
    for (share, exit) in [("balance_error = 1e-12\n", 0), ("", 0), ("balance_error = -1\n", 2)] {
        folder.write("a.toml", &OPEN.replace("balance_error = 1e-30\n", share));
        folder.run(&["run", "a.toml", "--no-files"]).exits(exit);
    }
    folder.write("a.toml", &OPEN.replace("1e-30", "1e-12"));
    let ran = folder.run(&["run", "a.toml", "--no-files"]).exits(0);
    assert!(ran.out.contains("(allowed: 1e-12)"), "{}", ran.out);
    // written back, it is still held
    let flat = folder.run(&["check", "a.toml", "--expand"]).exits(0).out;
    assert!(flat.contains("balance_error = 1e-12"), "{flat}");
}
