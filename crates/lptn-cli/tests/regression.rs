//! One test for each fixed mistake of the command line.

use crate::common;

use common::{Folder, GEARBOX};

const OVEN: &str = "format = 1\n[node]\nwinding = { C = \"150 J/K\", T0 = \"20 degC\" }\n\
    [source]\nloss = { into = \"winding\", P = \"60 W\" }\n[run]\nstop = \"10 min\"\n";

/// A file named `...toml` has the stem `..`: its results were written over files of the present
/// folder.
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
    let ran =
        folder.run(&["steady", "gearbox.toml", "--temperature-unit", "\u{b0}C", "--format", "csv"]);
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
                wall = { from = \"still\", to = \"room\", h = \"2 [W/(m^2 K)] * (abs(dT) / 1 \
                [K])^(1/4)\", \
                area = \"0.1 m^2\" }\n";
    let ran = Folder::with("still.toml", text).run(&["steady", "still.toml"]).exits(0);
    assert!(ran.out.contains("Q [W]") && !ran.out.contains("00000"), "{}", ran.out);
}

/// A run at rest showed nine decimals, the noise of the integrator. A cell that 10 W keep 10 K over
/// the air.
#[test]
fn a_run_at_rest_shows_no_noise() {
    let text = "format = 1\n[node]\ncell = { C = \"100 J/K\", T0 = \"30 degC\" }\n[boundary]\n\
                air = { T = \"20 degC\" }\n[resistor]\nskin = { from = \"cell\", to = \"air\", G \
                = \"1 W/K\" }\n\
                [source]\nheat = { into = \"cell\", P = \"9.99999 W\" }\n[run]\nstop = \"1 min\"\n";
    let folder = Folder::with("cell.toml", text);
    folder.run(&["run", "cell.toml"]).exits(0).prints("cell       30.0  30.0  30.0");
}

/// Streams that hand on to each other what they carry were listed one by one: only their sum is
/// heat of the network.
#[test]
fn the_heat_of_streams_is_one_sum() {
    let text = "format = 1\n[node]\nsump = { C = \"100 J/K\", T0 = \"20 degC\" }\n[boundary]\n\
                tank = { T = \"20 degC\" }\n[advection]\nfeed = { from = \"tank\", to = \"sump\", \
                mcp = \"5 W/K\" }\n\
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
    ran.says("run::report_without_value")
        .says("has no value at 605 s")
        .says("sqrt(600 - t / 1 [s])");
    folder.run(&["run", "gearbox.toml"]).exits(0).says("run::report_without_value");
}

/// A pipe across a room: boundaries alone.
const PIPE: &str = "format = 1\n[boundary]\npipe = { T = \"200 degC\" }\nroom = { T = \"25 degC\" \
    }\n\
    [resistor]\nwall = { from = \"pipe\", to = \"room\", R = \"0.5 K/W\" }\n\
    [limit]\nloss = { of = \"wall.Q\", below = \"400 W\" }\n";

/// A network without nodes was a panic, and took the other candidates with it.
#[test]
fn a_network_without_nodes_is_compared_by_what_it_has() {
    let folder = Folder::with("pipe.toml", &format!("{PIPE}[run]\nstop = \"1 min\"\n"));
    folder.write("still.toml", PIPE);
    folder.write("gearbox.toml", GEARBOX);
    for sort in ["margin", "peak", "steady", "time", "capacity", "given"] {
        let arguments = [
            "compare",
            "pipe.toml",
            "still.toml",
            "gearbox.toml",
            "--format",
            "json",
            "--sort",
            sort,
        ];
        let json = folder.run(&arguments).exits(0).json();
        let names: Vec<&str> = json["columns"]
            .as_array()
            .unwrap()
            .iter()
            .map(|c| c["name"].as_str().unwrap())
            .collect();
        let rows = json["rows"].as_array().unwrap();
        let at =
            |row: usize, name: &str| &rows[row][names.iter().position(|own| *own == name).unwrap()];
        assert_eq!(rows.len(), 3);
        for row in (0..3).filter(|&row| at(row, "file") != "gearbox.toml") {
            assert_eq!(
                (at(row, "hottest").as_str(), at(row, "status").as_str()),
                (Some(""), Some("kept"))
            );
            assert!(at(row, "peak").is_null() && at(row, "steady").is_null());
            // 175 K through 0.5 K/W are 350 W
            assert!((at(row, "loss.margin").as_f64().unwrap() - 50.0).abs() < 1e-9);
        }
    }
    folder.run(&["compare", "pipe.toml"]).exits(0).prints("pipe");
    folder.run(&["compare", "pipe.toml", "gearbox.toml"]).exits(0).prints("steel");
}

/// A block at `at` degC behind a path whose conductance has no value there.
fn undefined(conductance: &str, at: f64) -> String {
    format!(
        "format = 1\n[table]\nfilm = {{ x = [\"20 degC\", \"80 degC\"], y = [\"4 W/K\", \"9 W/K\"] \
         }}\n\
         [node]\nblock = {{ C = \"100 J/K\", T0 = \"{at} degC\" }}\ncore = {{ C = \"100 J/K\", T0 \
         = \"{at} degC\" }}\n\
         [boundary]\nroom = {{ T = \"20 degC\" }}\n\
         [resistor]\ngap = {{ from = \"block\", to = \"room\", G = \"{conductance}\" }}\n\
         foot = {{ from = \"core\", to = \"block\", R = \"1 K/W\" }}\n[run]\nstop = \"15 min\"\n"
    )
}

/// A table that is left at the start, a division by 0 and a root of less than 0 there were panics
/// while results were written: half a CSV, half a JSON.
#[test]
fn a_run_that_fails_at_its_first_instant_has_no_rows() {
    for (conductance, at) in [
        ("film(T_from)", 90.0),
        ("1 [W/K] / (dT / 1 [K])", 20.0),
        ("1 [W/K] * (dT / 1 [K])^0.5", 10.0),
    ] {
        let folder = Folder::with("first.toml", &undefined(conductance, at));
        for columns in [&[][..], &["--select", "block.T"], &["--select", "*.Q"]] {
            let run = |more: &[&str]| {
                let ran = folder.run(&[&["run", "first.toml"], more, columns].concat());
                ran.exits(3).says("solve::input").says("gap = ")
            };
            run(&["--no-files"]);
            let (headers, rows) = common::csv(&run(&["--no-files", "--format", "csv"]).out);
            assert!(
                headers[0] == "time [s]" && headers.len() > 1 && rows.is_empty(),
                "{headers:?} {rows:?}"
            );
            let json = run(&["--no-files", "--format", "json"]).json();
            assert_eq!(
                (&json["rows"], &json["end"]["status"]),
                (&serde_json::json!([]), &"failed".into())
            );
            run(&["-o", "out"]);
            assert!(common::csv(&folder.read("out/result.csv")).1.is_empty());
            let manifest: serde_json::Value =
                serde_json::from_str(&folder.read("out/manifest.json")).unwrap();
            assert_eq!(manifest["end"]["status"], "failed");
        }
    }
}

/// An extreme that lasts until the end of a window was said to be first there at the end. Air that
/// jumps from 20 to 30 degC at 60 s and back at 80 s in the second file; a core of 100 J/K behind 1
/// K/W, a skin without capacity halfway to the air.
#[test]
fn an_extreme_that_lasts_is_where_it_begins() {
    let text = |air: &str| {
        format!(
            "format = 1\n[boundary]\nair = {{ T = \"{air}\" }}\nwall = {{ T = \"20 degC\" \
             }}\n[node]\n\
             core = {{ C = \"100 J/K\", T0 = \"20 degC\" }}\nskin = {{ massless = true \
             }}\n[resistor]\n\
             foot = {{ from = \"core\", to = \"air\", R = \"1 K/W\" }}\nin = {{ from = \"air\", to \
             = \"skin\", R = \"1 K/W\" }}\n\
             out = {{ from = \"skin\", to = \"wall\", R = \"1 K/W\" }}\n[run]\nstop = \"2 min\"\n\
             window = {{ all = {{ from = \"10 s\", to = \"100 s\" }} }}\n"
        )
    };
    let folder = Folder::with("up.toml", &text("if(t < 60 [s], 20 [degC], 30 [degC])"));
    folder.write(
        "both.toml",
        &text("if(t < 60 [s], 20 [degC], if(t < 80 [s], 30 [degC], 20 [degC]))"),
    );
    // value in degC or W and time of the least and of the largest value. The core: 10 K (1 -
    // exp(-t/100 s)), then back
    let rise = |time: f64| 20.0 - 10.0 * f64::exp_m1(-time / 100.0);
    let up = [
        ("air.T", (20.0, 10.0), (30.0, 60.0)),
        ("skin.T", (20.0, 10.0), (25.0, 60.0)),
        ("in.Q", (0.0, 10.0), (5.0, 60.0)),
        ("core.T", (20.0, 10.0), (rise(40.0), 100.0)),
        ("foot.Q", (-10.0, 60.0), (0.0, 10.0)),
    ];
    let both =
        [("air.T", (20.0, 10.0), (30.0, 60.0)), ("core.T", (20.0, 10.0), (rise(20.0), 80.0))];
    for (file, expected) in [("up.toml", &up[..]), ("both.toml", &both)] {
        let json = folder.run(&["run", file, "--no-files", "--format", "json"]).exits(0).json();
        for (name, min, max) in expected {
            let column = &json["windows"]["all"]["columns"][name];
            let number = |key: &str| column[key]["value"].as_f64().unwrap();
            for ((value, time), (key, at)) in [(min, ("min", "min_at")), (max, ("max", "max_at"))] {
                assert!((number(key) - value).abs() < 1e-4, "{file} {name} {key}: {}", number(key));
                assert!((number(at) - time).abs() < 1e-6, "{file} {name} {at}: {}", number(at));
            }
        }
    }
    // the peak of a comparison, of a part that nothing delays
    let only =
        text("if(t < 60 [s], 20 [degC], 30 [degC])").replace("C = \"100 J/K\"", "C = \"1e9 J/K\"");
    folder.write("skin.toml", &only);
    let ran = folder.run(&["compare", "skin.toml", "--format", "csv"]).exits(0);
    assert!(ran.out.contains(",skin,,NaN,25,60,"), "{}", ran.out);
}

/// A signal from a file took twenty times the memory of the file: every cell was held with its
/// place. 1.5 million rows of 20 MB, which took 460 MB; the place of a row is still known where
/// something is wrong with it.
#[cfg(unix)]
#[test]
fn a_long_signal_takes_little_more_memory_than_its_numbers() {
    let rows = 1_500_000;
    let mut csv = String::from("t [s],P [W]\n");
    (0..rows).for_each(|i| csv.push_str(&format!("{i}.5,{}.25\n", i % 977)));
    let text = "format = 1\n[signal]\nf = { csv = \"long.csv\", time = \"t\", value = \"P\" \
        }\n[node]\n\
                block = { C = \"100 J/K\", T0 = \"20 degC\" }\n[source]\nheat = { into \
                = \"block\", P = \"f\" }\n\
                [boundary]\nroom = { T = \"20 degC\" }\n[resistor]\n\
                foot = { from = \"block\", to = \"room\", R = \"1 K/W\" }\n";
    let folder = Folder::with("long.toml", text);
    let check = || {
        let mut command = std::process::Command::new("sh");
        let script = "ulimit -v 350000; exec \"$0\" check long.toml";
        command.args(["-c", script, env!("CARGO_BIN_EXE_lptn")]).current_dir(folder.path());
        common::Ran::of(command.output().unwrap())
    };
    folder.write("long.csv", &csv);
    check().exits(0);
    csv.push_str("7.5,1\n");
    folder.write("long.csv", &csv);
    check().exits(1).prints("long.csv:1500002:1").prints("this one is below the one before it");
    // a file without content that is as long as no file may be
    std::fs::File::create(folder.path().join("long.csv")).unwrap().set_len(2_000_000_001).unwrap();
    check().exits(1).prints("netlist::csv_too_long").prints("longer than 2000 MB");
}
