//! One test for each fixed mistake of the command line.

mod common;

use common::{Folder, GEARBOX};

const OVEN: &str = "format = 1\n[node]\nwinding = { C = \"150 J/K\", T0 = \"20 degC\" }\n\
    [source]\nloss = { into = \"winding\", P = \"60 W\" }\n[run]\nstop = \"10 min\"\n";

/// A file named `...toml` has the stem `..`: its results were written over files of the present folder.
#[test]
fn results_stay_inside_the_output_folder() {
    let folder = Folder::with("...toml", GEARBOX);
    folder.run(&["run", "./...toml"]).exits(0);
    assert!(folder.path().join("out/netlist/result.csv").exists());
    assert!(!folder.path().join("result.csv").exists());
}

/// A heated node that nothing ties to the rest was "ok, 0 warnings".
#[test]
fn check_warns_of_nodes_that_lead_nowhere() {
    let ran = Folder::with("oven.toml", OVEN).run(&["check", "oven.toml"]).exits(0);
    assert!(ran.out.contains("no path leads to a boundary from `winding`"), "{}", ran.out);
}

/// The table said that the error is not bounded, JSON had no warnings.
#[test]
fn json_holds_the_warnings_of_the_table() {
    let folder = Folder::with("oven.toml", OVEN);
    let ran = folder.run(&["run", "oven.toml", "--format", "json", "--no-files"]).exits(0);
    let json: serde_json::Value = serde_json::from_str(&ran.out).unwrap();
    let codes: Vec<&str> =
        json["warnings"].as_array().unwrap().iter().map(|w| w["code"].as_str().unwrap()).collect();
    assert_eq!(codes, ["network::no_boundary", "run::error_not_bounded"]);
    let ran = folder.run(&["run", "oven.toml", "--format", "csv", "--no-files"]).exits(0);
    assert!(ran.err.contains("error not bounded by the tolerance"), "{}", ran.err);
}

/// `mK` and `K^1` were copied into the header as if they were scales.
#[test]
fn temperature_units_are_scales() {
    let folder = Folder::with_gearbox();
    folder.run(&["steady", "gearbox.toml", "--temperature-unit", "mK"]).exits(2);
    let ran = folder.run(&["steady", "gearbox.toml", "--temperature-unit", "\u{b0}C", "--format", "csv"]);
    assert!(ran.exits(0).out.starts_with("steel.T [degC]"));
}

/// Results below 0 K were printed as if they were temperatures.
#[test]
fn steady_states_below_absolute_zero_fail() {
    let text = GEARBOX.replace(
        "P_disp = { into = \"steel\", P = \"P_7000\" }",
        "cold = { into = \"steel\", P = \"-2 kW\" }",
    );
    let folder = Folder::with("cold.toml", &text);
    let ran = folder.run(&["steady", "cold.toml"]).exits(3);
    assert!(ran.err.contains("solve::below_absolute_zero"), "{}", ran.err);
    folder.run(&["run", "cold.toml", "--no-files", "--tolerance", "1e-3K"]).exits(3);
}

/// A node below 0 K was named, but not shown.
#[test]
fn failures_at_a_node_show_its_line() {
    let text = GEARBOX.replace("P = \"P_7000\" }", "P = \"-2 kW\" }");
    let folder = Folder::with("cold.toml", &text);
    for verb in ["run", "steady"] {
        folder.run(&[verb, "cold.toml"]).exits(3).says("steel = {}");
    }
}

/// A network at rest was shown with nine decimals and in microwatts, all of them rounding.
#[test]
fn a_steady_state_at_rest_is_shown_as_zeros() {
    let text = "format = 1\n[node]\nstill = { C = \"800 J/K\", T0 = \"100 degC\" }\n\
                [boundary]\nroom = { T = \"20 degC\" }\n[convection]\n\
                wall = { from = \"still\", to = \"room\", h = \"2 [W/(m^2 K)] * (abs(dT) / 1 [K])^(1/4)\", \
                area = \"0.1 m^2\" }\n";
    let ran = Folder::with("still.toml", text).run(&["steady", "still.toml"]).exits(0);
    assert!(ran.out.contains("Q [W]") && !ran.out.contains("00000"), "{}", ran.out);
}

/// A run at rest showed nine decimals, the noise of the integrator. A cell that 10 W keep 10 K over the air.
#[test]
fn a_run_at_rest_shows_no_noise() {
    let text = "format = 1\n[node]\ncell = { C = \"100 J/K\", T0 = \"30 degC\" }\n[boundary]\n\
                air = { T = \"20 degC\" }\n[resistor]\nskin = { from = \"cell\", to = \"air\", G = \"1 W/K\" }\n\
                [source]\nheat = { into = \"cell\", P = \"9.99999 W\" }\n[run]\nstop = \"1 min\"\n";
    let folder = Folder::with("cell.toml", text);
    folder.run(&["run", "cell.toml"]).exits(0).prints("cell       30.0  30.0  30.0");
}

/// Streams that hand on to each other what they carry were listed one by one: only their sum is heat of the network.
#[test]
fn the_heat_of_streams_is_one_sum() {
    let text = "format = 1\n[node]\nsump = { C = \"100 J/K\", T0 = \"20 degC\" }\n[boundary]\n\
                tank = { T = \"20 degC\" }\n[advection]\nfeed = { from = \"tank\", to = \"sump\", mcp = \"5 W/K\" }\n\
                drain = { from = \"sump\", to = \"tank\", mcp = \"5 W/K\" }\n\
                [source]\nheat = { into = \"sump\", P = \"100 W\" }\n[run]\nstop = \"10 min\"\n";
    let folder = Folder::with("oil.toml", text);
    // sump rises by 20 K (1 - exp(-t / 20 s)): 2 kJ stored, the rest of 60 kJ leaves with the oil
    folder.run(&["run", "oil.toml"]).exits(0).prints("in 60.00 kJ = stored 2.00 + tank 58.00 kJ");
}

/// A report without a value in some row was NaN without a word.
#[test]
fn a_report_without_a_value_is_a_warning() {
    let text = GEARBOX.replace("[run]\n", "[run]\nreport = { odd = \"sqrt(600 - t / 1 [s])\" }\n");
    let folder = Folder::with("gearbox.toml", &text);
    let ran = folder.run(&["run", "gearbox.toml", "--format", "json"]).exits(0);
    ran.says("run::report_without_value").says("has no value at 605 s").says("sqrt(600 - t / 1 [s])");
    folder.run(&["run", "gearbox.toml"]).exits(0).says("run::report_without_value");
}
