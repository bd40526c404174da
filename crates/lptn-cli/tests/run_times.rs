//! Kind: command line. `--stop` and `--every`: other times for a run, held to what the file is; the
//! width of help, and manual pages.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common;

use common::{Folder, csv};

/// One lump of 1000 J/K that 100 W heat and 10 W/K cool, with a window over its first minute.
const LUMP: &str = "format = 1
[node]
lump = { C = '1000 J/K', T0 = '25 degC' }
[boundary]
air = { T = '25 degC' }
[resistor]
skin = { from = 'lump', to = 'air', G = '10 W/K' }
[source]
heat = { into = 'lump', P = '100 W' }
[run]
stop = '300 s'
output = { at = ['0 s', '10 s'] }
window = { first = { from = '0 s', to = '1 min' } }
";

#[test]
fn rows_come_at_the_times_that_were_asked_for() {
    let folder = Folder::with("lump.toml", LUMP);
    let ran = folder.run(&[
        "run",
        "lump.toml",
        "--no-files",
        "--format",
        "csv",
        "--select",
        "lump.T",
        "--stop",
        "10 min",
        "--every",
        "5min",
    ]);
    let (_, rows) = csv(&ran.exits(0).out);
    assert_eq!(rows.len(), 3);
    for (row, time) in rows.iter().zip([0.0, 300.0, 600.0_f64]) {
        let expected = 25.0 + 10.0 * (1.0 - (-time / 100.0).exp());
        assert!((row[0] - time).abs() < 1e-9 && (row[1] - expected).abs() < 1e-4, "{row:?}");
    }
}

#[test]
fn times_that_do_not_fit_are_refused_by_their_option() {
    let folder = Folder::with("lump.toml", LUMP);
    let cases = [
        (["--stop", "0 s"], "netlist::run_stop", " --> --stop:1:1"),
        (["--stop", "30 s"], "netlist::", "lump.toml:13"),
        (["--stop", "2 K"], "units::dimension", " --> --stop:1:1"),
        (["--every", "1 us"], "netlist::too_many_rows", " --> --every:1:1"),
    ];
    for (option, code, place) in cases {
        let arguments = [&["run", "lump.toml", "--no-files"], &option[..]].concat();
        folder.run(&arguments).exits(2).says(code).says(place);
    }
}

/// The former words do what they did, and name the new ones.
#[test]
fn former_words_of_set_up_work() {
    let folder = Folder::empty();
    let now = folder.run(&["setup", "completions", "bash"]).exits(0);
    let before = folder.run(&["completions", "bash"]).exits(0).says("`lptn setup completions` now");
    assert_eq!(before.out, now.out);
    folder.run(&["man", "pages"]).exits(0).says("`lptn setup man` now");
    assert!(folder.read("pages/lptn-setup-man.1").contains("manual pages"));
    assert!(!folder.run(&["help"]).out.contains("  man "), "the help names one word");
}

/// Every verb that the help names has a page with its options.
#[test]
fn every_verb_has_a_manual_page() {
    let folder = Folder::empty();
    folder.run(&["setup", "man", "pages"]).exits(0).says("wrote  ");
    let help = folder.run(&["help"]).out;
    let verbs = help.split_once("Start here:").unwrap().1.split_once("Options:").unwrap().0;
    let names = verbs.lines().filter_map(|line| line.strip_prefix("  ")?.split(' ').next());
    let names: Vec<&str> = names.filter(|name| !name.is_empty() && *name != "help").collect();
    assert!(names.len() > 15, "{names:?}");
    for name in names {
        let page = folder.read(&format!("pages/lptn-{name}.1"));
        assert!(page.contains(".SH OPTIONS") && page.contains("quiet"), "{name}: {page}");
    }
}

#[test]
fn help_keeps_to_the_width_of_the_terminal() {
    let folder = Folder::empty();
    for (columns, widest) in [("60", 60), ("80", 80), ("200", 100)] {
        for verb in ["run", "plot", "fit", "size"] {
            let mut command = folder.command(&["help", verb]);
            let ran = common::Ran::of(command.env("COLUMNS", columns).output().unwrap()).exits(0);
            let longest = ran.out.lines().map(|line| line.chars().count()).max().unwrap();
            assert!(longest <= widest, "{verb} at {columns}: {longest}");
        }
    }
}

/// Times of rows, tables and verdicts in one unit; the picture and the other files stay as they are.
#[test]
fn times_are_shown_in_the_unit_that_is_asked_for() {
    let folder = Folder::with_gearbox();
    let seconds = folder.run(&["run", "gearbox.toml", "--format", "csv", "--no-files"]).exits(0);
    let asked = ["run", "gearbox.toml", "--format", "csv", "--time-unit", "min"];
    let minutes = folder.run(&asked).exits(0);
    let (headers, rows) = csv(&minutes.out);
    let (_, in_seconds) = csv(&seconds.out);
    assert_eq!(headers[0], "time [min]");
    assert!((rows.last().unwrap()[0] - 25.0).abs() < 1e-12);
    for (row, other) in rows.iter().zip(&in_seconds) {
        assert!((60.0 * row[0] - other[0]).abs() < 1e-9 && row[1..] == other[1..]);
    }
    assert_eq!(folder.read("out/gearbox/result.csv"), minutes.out);
    // a picture of the rows knows their unit
    folder.run(&["plot", "out/gearbox", "-o", "x.svg"]).exits(0);
    let asked = ["run", "gearbox.toml", "--time-unit", "h", "--no-files"];
    let table = folder.run(&asked).exits(0);
    table.prints("  0.4167 h  peak").prints("heat over 0.4167 h:");
    folder.run(&["run", "gearbox.toml", "--time-unit", "week"]).exits(2).says("s, min, h, d");
}
