//! `lptn compare` over cycles: settled peaks and margins, heat by path, tables of parts.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common;

use common::Folder;

/// 100 W for 100 s of every 300 s into 500 J/K, through 0.5 K/W and 2 K/W to air of 20 degC.
const DUTY: &str = "format = 1\n[param]\nR_skin = '0.5 K/W'\n[signal]\n\
    load = { t = [0, 100], v = [100, 0], t_unit = 's', v_unit = 'W', interp = 'previous', \
    after_end = 'repeat', period = '300 s' }\n[node]\nblock = { C = '500 J/K', T0 = '20 degC' }\n\
    [boundary]\nair = { T = '20 degC' }\n[resistor]\n\
    skin = { from = 'block', to = 'air', R = 'R_skin' }\n\
    feet = { from = 'air', to = 'block', R = '2 K/W' }\n[source]\n\
    heat = { into = 'block', P = 'load' }\n[limit]\nhot = { of = 'block.T', below = '50 degC' }\n";

const RUN: &str = "[run]\nstop = '300 s'\n";

/// In the settled cycle of a duty of two levels the rise peaks where the load ends, at
/// P R (1 - exp(-on / tau)) / (1 - exp(-period / tau)).
fn settled_rise(resistance: f64) -> f64 {
    let tau = 500.0 * resistance;
    100.0 * resistance * (1.0 - f64::exp(-100.0 / tau)) / (1.0 - f64::exp(-300.0 / tau))
}

fn parallel(skin: f64) -> f64 {
    1.0 / (1.0 / skin + 0.5)
}

#[track_caller]
fn near(found: &str, expected: f64, tolerance: f64) {
    let found: f64 = found.parse().unwrap();
    assert!((found - expected).abs() <= tolerance, "{found} is not {expected}");
}

/// The cell of a row by its header.
fn cell(text: &str, row: usize, name: &str) -> String {
    let mut reader = ::csv::Reader::from_reader(text.as_bytes());
    let headers = reader.headers().unwrap().clone();
    let column = headers.iter().position(|header| header == name);
    let column = column.unwrap_or_else(|| panic!("no {name} in {headers:?}"));
    reader.records().nth(row).unwrap().unwrap()[column].to_owned()
}

#[test]
fn the_settled_cycle_stands_beside_the_run() {
    let folder = Folder::empty();
    folder.write("duty.toml", &format!("{DUTY}{RUN}"));
    let csv = folder.run(&["compare", "duty.toml", "--format", "csv"]).exits(0).out;
    let (tau, rise) = (200.0, settled_rise(0.4));
    let first = 40.0 * (1.0 - f64::exp(-100.0 / tau));
    near(&cell(&csv, 0, "peak [degC]"), 20.0 + first, 1e-4);
    near(&cell(&csv, 0, "hot.margin [K]"), 30.0 - first, 1e-4);
    near(&cell(&csv, 0, "settled [degC]"), 20.0 + rise, 1e-4);
    near(&cell(&csv, 0, "settled_at [s]"), 100.0, 1e-6);
    near(&cell(&csv, 0, "period [s]"), 300.0, 0.0);
    near(&cell(&csv, 0, "hot.settled_margin [K]"), 30.0 - rise, 1e-4);
    let table = folder.run(&["compare", "duty.toml"]).exits(0);
    let table = table.prints("settled").prints("settled margin to").out;
    assert!(!table.contains("steady"), "{table}");
}

#[test]
fn without_a_run_the_settled_cycle_is_compared() {
    let folder = Folder::empty();
    folder.write("duty.toml", DUTY);
    let ran = folder.run(&["compare", "duty.toml", "--format", "csv"]).exits(0);
    let rise = settled_rise(0.4);
    near(&cell(&ran.out, 0, "peak [degC]"), 20.0 + rise, 1e-4);
    near(&cell(&ran.out, 0, "peak_at [s]"), 100.0, 1e-6);
    near(&cell(&ran.out, 0, "hot.margin [K]"), 30.0 - rise, 1e-4);
    assert_eq!(cell(&ran.out, 0, "status"), "kept");
    // all heat of a cycle leaves in it: 2.5 W/K of which the skin is 2
    near(&cell(&ran.out, 0, "heat [J]"), 10e3, 1e-3);
    near(&cell(&ran.out, 0, "air.share [-]"), 1.0, 1e-9);
    near(&cell(&ran.out, 0, "skin.share [-]"), 0.8, 1e-6);
    near(&cell(&ran.out, 0, "feet.share [-]"), 0.2, 1e-6);
    assert!(!ran.err.contains("steady::inputs_vary"), "{}", ran.err);
    folder.run(&["compare", "duty.toml"]).exits(0).prints("heat by path");
}

#[test]
fn periodic_leaves_the_run_out() {
    let folder = Folder::empty();
    let tight = DUTY.replace("below = '50 degC'", "below = '40 degC'");
    folder.write("duty.toml", &format!("{tight}[run]\nstop = '60 s'\n"));
    folder.write("steady.toml", &format!("{}{RUN}", DUTY.replace("P = 'load'", "P = '50 W'")));
    let drifts = DUTY.replace("P = 'load'", "P = '50 [W] + 1 [W] * t / 1 [h]'");
    folder.write("drifts.toml", &format!("{drifts}{RUN}"));
    // in a minute nothing gets hot, in the settled cycle it does
    folder.run(&["compare", "duty.toml"]).exits(0);
    let ran = folder.run(&["compare", "duty.toml", "--periodic", "--format", "csv"]).exits(1);
    near(&cell(&ran.out, 0, "peak [degC]"), 20.0 + settled_rise(0.4), 1e-4);
    near(&cell(&ran.out, 0, "hot.margin [K]"), 20.0 - settled_rise(0.4), 1e-4);
    let ran = folder.run(&["compare", "steady.toml", "--periodic", "--format", "csv"]).exits(0);
    near(&cell(&ran.out, 0, "peak [degC]"), 40.0, 1e-9);
    let ran = folder.run(&["compare", "drifts.toml", "duty.toml", "--periodic"]).exits(2);
    ran.says("periodic::no_period");
}

/// What is written from the air counts towards it as what is written to it does, in steady state too.
#[test]
fn heat_by_path_is_towards_the_boundary() {
    let folder = Folder::empty();
    let steady = DUTY.replace("P = 'load'", "P = '50 W'");
    folder.write("steady.toml", &steady);
    let csv = folder.run(&["compare", "steady.toml", "--format", "csv"]).exits(0).out;
    near(&cell(&csv, 0, "skin.share [-]"), 0.8, 1e-12);
    near(&cell(&csv, 0, "feet.share [-]"), 0.2, 1e-12);
    folder.run(&["compare", "steady.toml"]).exits(0).prints("50.00 W").prints("heat out");
}

#[test]
fn a_cycle_that_does_not_repeat_is_told() {
    let folder = Folder::empty();
    let drifts =
        DUTY.replace("air = { T = '20 degC' }", "air = { T = '20 [degC] + t / 1 [h] * 1 [K]' }");
    folder.write("drifts.toml", &format!("{drifts}{RUN}"));
    let ran = folder.run(&["compare", "drifts.toml"]).exits(0);
    let ran = ran.says("the column `settled` is empty").says("periodic::not_periodic");
    assert!(!ran.out.contains("settled"), "{}", ran.out);
}

#[test]
fn every_part_of_a_table_is_a_candidate() {
    let folder = Folder::empty();
    folder.write("duty.toml", DUTY);
    folder.write("parts.csv", "part,R_skin [mK/W],note\nsmall,2000,made up\nlarge,250,made up\n");
    let args = ["compare", "duty.toml", "--parts", "parts.csv"];
    let csv = folder.run(&[&args[..], &["--format", "csv"]].concat()).exits(1).out;
    assert_eq!(cell(&csv, 0, "file"), "duty.toml (large)");
    assert_eq!(cell(&csv, 1, "file"), "duty.toml (small)");
    for (row, skin) in [(0, 0.25), (1, 2.0)] {
        near(&cell(&csv, row, "peak [degC]"), 20.0 + settled_rise(parallel(skin)), 1e-4);
    }
    let ran = folder.run(&args).exits(1).prints("2 candidates of duty.toml");
    assert!(ran.out.lines().any(|line| line.starts_with("large ")), "{}", ran.out);
    assert_eq!(ran.err.lines().last(), Some("limit broken: small breaks hot"));
    let listed = folder.run(&[&args[..], &["--set", "T=1"]].concat()).exits(2);
    listed.says("no candidate has a parameter `T`");
}

#[test]
fn tables_of_parts_are_checked_with_their_lines() {
    let folder = Folder::empty();
    folder.write("duty.toml", DUTY);
    for (table, says) in [
        ("part,R_skim [K/W]\na,1\n", "did you mean `R_skin`?"),
        ("part,R_skin\na,1\n", "parts.csv:1"),
        ("part,R_skin [W/K]\na,1\n", "parts.csv:1"),
        ("name,R_skin [K/W]\na,1\n", "part"),
        ("part,R_skin [K/W]\na,1\na,2\n", "parts.csv:3"),
        ("part,note\na,x\n", "no column of parts.csv is a parameter"),
        ("part,R_skin [K/W]\na,-1\n", "R_skin"),
    ] {
        folder.write("parts.csv", table);
        folder.run(&["compare", "duty.toml", "--parts", "parts.csv"]).exits(2).says(says);
    }
    folder.run(&["compare", "duty.toml", "--parts", "none.csv"]).exits(2).says("none.csv");
}

/// Between two points of the lap the speed is a straight line, so the integral of its power of 5/3 is
/// 3/8 of the difference of the powers of 8/3 over the slope: by mpmath 25 702.143 560 5 J a lap, twenty
/// of which are the run. The settled peaks are those of a fourth-order Runge-Kutta method in Python, with
/// steps of 0.1 s until a lap repeats itself, the same printed correlations and straight lines between
/// the properties of air, where this program has a smooth curve.
#[test]
fn the_alternatives_over_the_lap_turn_over_the_heat_of_the_closed_form() {
    let lap = concat!(env!("CARGO_MANIFEST_DIR"), "/../../networks/lap");
    let (file, parts) = (format!("{lap}/lap.toml"), format!("{lap}/alternatives.csv"));
    let args = ["compare", &file, "--parts", &parts, "--format", "csv"];
    let csv = Folder::empty().run(&args).exits(1).out;
    for row in 0..5 {
        near(&cell(&csv, row, "heat [J]"), 20.0 * 25_702.143_560_5, 2.0);
        near(&cell(&csv, row, "period [s]"), 90.0, 0.0);
        assert_eq!(cell(&csv, row, "status"), if row < 2 { "kept" } else { "broken" });
    }
    assert!(cell(&csv, 1, "file").ends_with("(fins and fan)"));
    near(&cell(&csv, 0, "settled [degC]"), 59.979_621, 1e-4);
    near(&cell(&csv, 1, "settled [degC]"), 108.337_02, 1e-2);
    near(&cell(&csv, 1, "settled_at [s]"), 46.5, 0.1);
}
