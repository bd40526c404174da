//! The numbers that the program prints, against the closed form of the gearbox: validation case
//! `gearbox_two_node`.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common;

use common::{Folder, GEARBOX, csv, gearbox_case};

fn an_hour() -> Folder {
    Folder::with("gearbox.toml", &GEARBOX.replace("\"25 min\"", "\"3600 s\""))
}

#[track_caller]
fn assert_closed_form(rows: &[Vec<f64>], tolerance: f64) {
    let mut checked = 0;
    for (column, node) in [(1, "steel"), (2, "alum")] {
        for expected in gearbox_case("T", node).iter().filter(|expected| expected["t"].is_number())
        {
            let (time, exact) =
                (expected["t"].as_f64().unwrap(), expected["value"].as_f64().unwrap());
            let row =
                rows.iter().find(|row| (row[0] - time).abs() < 1e-9).expect("a row at each time");
            assert!(
                (row[column] - exact).abs() < tolerance,
                "{node} at {time} s: {} for {exact}",
                row[column]
            );
            checked += 1;
        }
    }
    assert_eq!(checked, 12);
}

#[test]
fn the_record_is_the_closed_form() {
    let folder = an_hour();
    folder.run(&["run", "gearbox.toml"]).exits(0);
    let (headers, rows) = csv(&folder.read("out/gearbox/result.csv"));
    assert_eq!(headers[..3], ["time [s]", "steel.T [degC]", "aluminium.T [degC]"]);
    assert_eq!(rows.len(), 721);
    // ten times the usual tolerance of 1e-5 K is what lptn promises
    assert_closed_form(&rows, 1e-4);
}

#[test]
fn a_finer_tolerance_is_finer() {
    let folder = an_hour();
    let ran = folder
        .run(&["run", "gearbox.toml", "--no-files", "--format", "csv", "--tolerance", "1e-7K"])
        .exits(0);
    assert_closed_form(&csv(&ran.out).1, 1e-6);
}

#[test]
fn temperatures_in_other_units_are_the_same_temperatures() {
    let folder = an_hour();
    let in_unit = |unit| {
        let arguments =
            ["run", "gearbox.toml", "--no-files", "--format", "csv", "--temperature-unit", unit];
        csv(&folder.run(&arguments).exits(0).out)
    };
    let (headers, kelvin) = in_unit("K");
    assert_eq!(headers[1], "steel.T [K]");
    let (headers, fahrenheit) = in_unit("degF");
    assert_eq!(headers[1], "steel.T [degF]");
    for (k, f) in kelvin.iter().zip(&fahrenheit) {
        assert!((k[1] * 1.8 - 459.67 - f[1]).abs() < 1e-9);
    }
    let celsius =
        kelvin.iter().map(|row| vec![row[0], row[1] - 273.15, row[2] - 273.15]).collect::<Vec<_>>();
    assert_closed_form(&celsius, 1e-4);
}

#[test]
fn the_steady_state_is_that_of_the_paper() {
    let folder = Folder::with_gearbox();
    let values =
        folder.run(&["steady", "gearbox.toml", "--format", "json"]).exits(0).json()["values"]
            .clone();
    let check = |name: &str, unit: &str, expected: f64| {
        assert_eq!(values[name]["unit"], unit, "{name}");
        let value = values[name]["value"].as_f64().unwrap();
        assert!((value - expected).abs() < 1e-6, "{name}: {value} for {expected}");
    };
    check("steel.T", "degC", 92.7);
    check("aluminium.T", "degC", 91.0);
    check("bed.T", "degC", 25.5);
    check("internal.Q", "W", 220.6);
    check("mill_bed.Q", "W", 0.7 * 220.6);
    check("bed.Q", "W", -0.7 * 220.6);
    check("air.Q", "W", -0.3 * 220.6);
    check("P_disp.P", "W", 220.6);
}

#[test]
fn a_parameter_of_the_command_line_counts() {
    let folder = Folder::with_gearbox();
    // five degrees warmer around it is five degrees warmer
    let arguments = ["steady", "gearbox.toml", "--set", "T_amb=30.5degC", "--format", "csv"];
    let (headers, rows) = csv(&folder.run(&arguments).exits(0).out);
    assert_eq!(headers[0], "steel.T [degC]");
    assert!((rows[0][0] - 97.7).abs() < 1e-6);
    assert!((rows[0][1] - 96.0).abs() < 1e-6);
}

#[test]
fn a_new_netlist_runs_and_settles_where_it_must() {
    let folder = Folder::empty();
    folder.run(&["new", "motor", "-v"]).exits(0).says("lptn check motor.toml");
    folder.run(&["run", "motor.toml"]).exits(0);
    // 60 W through 12 W/(m^2 K) x 0.12 m^2 into 20 degC, and through 0.35 K/W
    let (_, rows) = csv(&folder.run(&["steady", "motor.toml", "--format", "csv"]).exits(0).out);
    let housing = 20.0 + 60.0 / 1.44;
    assert!((rows[0][1] - housing).abs() < 1e-6);
    assert!((rows[0][0] - (housing + 21.0)).abs() < 1e-6);
}

#[test]
fn a_peak_between_start_and_stop_is_found() {
    // heat for 600 s only: T = 25 + 0.3 K/W x 100 W (1 - exp(-t/150 s)) up to there, the peak
    let text = "format = 1\n[node]\nblock = { T0 = \"25 degC\", C = \"500 J/K\" }\n[boundary]\n\
                air = { T = \"25 degC\" }\n[resistor]\ncooling = { from = \"block\", to = \"air\", \
                R = \"0.3 K/W\" }\n\
                [source]\nloss = { into = \"block\", P = \"if(t < 600 [s], 100 [W], 0 [W])\" }\n\
                [run]\nstop = \"20 min\"\noutput = { every = \"7 min\" }\n";
    let ran = Folder::with("block.toml", text).run(&["run", "block.toml"]).exits(0);
    let peak = format!("{:.1}", 25.0 + 30.0 * (1.0 - (-4.0_f64).exp()));
    let line = ran.out.lines().find(|line| line.starts_with("block ")).unwrap();
    let cells: Vec<&str> = line.split_whitespace().collect();
    assert_eq!(cells[3..6], [peak.as_str(), "10", "min"], "{line}");
    ran.prints("steady is `-`: the inputs change with time");
}

#[test]
fn the_selection_of_a_run_does_not_narrow_the_steady_state() {
    let text = GEARBOX.replace("[run]", "[run]\nselect = [\"steel.T\"]");
    let folder = Folder::with("gearbox.toml", &text);
    let (headers, _) = csv(&folder.run(&["run", "gearbox.toml", "--format", "csv"]).exits(0).out);
    assert_eq!(headers, ["time [s]", "steel.T [degC]"]);
    let (headers, _) =
        csv(&folder.run(&["steady", "gearbox.toml", "--format", "csv"]).exits(0).out);
    assert_eq!(headers.len(), 10);
    let arguments = ["steady", "gearbox.toml", "--format", "csv", "--select", "*.P"];
    assert_eq!(csv(&folder.run(&arguments).exits(0).out).0, ["P_disp.P [W]"]);
}

#[test]
fn a_network_without_state_shows_its_highest_row() {
    // a junction halfway between 0 degC and 100 degC + 50 K sin(2 pi t / 60 s): 50 degC, and 75
    // degC at 15 s
    let text = "format = 1\n[node]\nmiddle = { massless = true }\n[boundary]\ncold = { T = \"0 \
        degC\" }\n\
                hot = { T = \"100 [degC] + 50 [K] * sin(2 * pi * t / 60 [s])\" }\n[resistor]\n\
                a = { from = \"hot\", to = \"middle\", R = \"1 K/W\" }\n\
                b = { from = \"middle\", to = \"cold\", R = \"1 K/W\" }\n\
                [run]\nstop = \"45 s\"\noutput = { every = \"5 s\" }\n";
    let ran = Folder::with("middle.toml", text).run(&["run", "middle.toml"]).exits(0);
    let line = ran.out.lines().find(|line| line.starts_with("middle ")).unwrap();
    let cells: Vec<&str> = line.split_whitespace().collect();
    assert_eq!(cells[1..6], ["50.0", "25.0", "75.0", "15", "s"], "{line}");
}
