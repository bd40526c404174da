//! `lptn reduce` from the outside: what it prints, what it writes, how it ends.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common;

use common::{Folder, gearbox_case, gearbox_values};
use serde_json::Value;

fn number(json: &Value, path: &[&str]) -> f64 {
    let value = path.iter().fold(json, |json, key| &json[*key]);
    value["value"].as_f64().unwrap_or_else(|| panic!("no number at {path:?} in\n{json:#}"))
}

#[track_caller]
fn near(found: f64, expected: f64, relative: f64) {
    assert!((found - expected).abs() <= relative * expected.abs(), "{found} is not {expected}");
}

const DEFINITIONS: [&str; 4] = ["sum", "first_moment", "dominant_pole", "least_squares"];

/// R_int and R_amb follow from 1.7 K and 65.5 K at 220.6 W; tau_1 from validation/gearbox_two_node.
#[test]
fn json_holds_what_the_design_promises() {
    let folder = Folder::with_gearbox();
    let json = folder
        .run(&["reduce", "gearbox.toml", "--port", "steel", "--format", "json"])
        .exits(0)
        .json();
    assert_eq!(
        (&json["format"], &json["network"], &json["port"]),
        (&1.into(), &"gearbox".into(), &"steel".into())
    );
    near(number(&json, &["R_eq"]), 67.2 / 220.6, 1e-12);
    near(number(&json, &["T_ref"]), 25.5, 1e-14);
    near(number(&json, &["Q_N"]), 220.6, 1e-14);
    near(number(&json, &["boundary_weights", "bed"]), 0.7, 1e-12);
    near(number(&json, &["C_eq", "sum"]), 2659.0, 1e-12);
    near(
        number(&json, &["C_eq", "first_moment"]),
        1235.0 + 1424.0 * (65.5_f64 / 67.2).powi(2),
        1e-12,
    );
    let tau = gearbox_values("time_constant", "")[0];
    near(number(&json, &["C_eq", "dominant_pole"]), tau * 220.6 / 67.2, 1e-9);
    for definition in DEFINITIONS {
        for error in ["step", "run"] {
            let share = number(&json, &["errors", definition, error, "relative"]);
            assert!((0.005..0.02).contains(&share), "{definition} {error} {share}");
            assert!(number(&json, &["errors", definition, error, "time"]) > 1.0);
        }
        near(
            number(&json, &["errors", definition, "run", "max"]),
            number(&json, &["errors", definition, "run", "relative"]) * number(&json, &["rise"]),
            1e-12,
        );
    }
    // the port's rise in 25 min, validation/gearbox_two_node
    let end =
        gearbox_case("T", "steel").into_iter().find(|expected| expected["t"] == 1500.0).unwrap();
    near(number(&json, &["rise"]), end["value"].as_f64().unwrap() - 25.5, 1e-6);
    assert_eq!(json["recommended"], "least_squares");
}

/// The rows of the CSV: cells by header.
fn rows(text: &str) -> Vec<std::collections::BTreeMap<String, String>> {
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let headers: Vec<String> = reader.headers().unwrap().iter().map(str::to_owned).collect();
    let row = |row: csv::StringRecord| {
        headers.iter().cloned().zip(row.iter().map(str::to_owned)).collect()
    };
    reader.records().map(|record| row(record.unwrap())).collect()
}

/// Capacities and R_eq as in the test of the JSON; every other cell is that of the JSON.
#[test]
fn csv_has_a_row_a_definition() {
    let folder = Folder::with_gearbox();
    let reduce = |format| {
        folder.run(&["reduce", "gearbox.toml", "--port", "steel", "--format", format]).exits(0)
    };
    let ran = reduce("csv");
    let header = "definition,recommended,within,R_eq [K/W],C_eq [J/K],tau [s],step.max \
        [K],step.relative [-],step.time [s],step.signed [K],step.good_from [s],\
                  run.max [K],run.relative [-],run.time [s],run.signed [K],run.good_from \
                  [s],any_load.max [K]";
    assert_eq!(ran.out.lines().next(), Some(header));
    let (rows, json) = (rows(&ran.out), reduce("json").json());
    assert_eq!(rows.iter().map(|row| row["definition"].as_str()).collect::<Vec<_>>(), DEFINITIONS);
    for row in &rows {
        let (definition, cell) =
            (row["definition"].as_str(), |name: &str| row[name].parse::<f64>().unwrap());
        near(cell("R_eq [K/W]"), 67.2 / 220.6, 1e-12);
        near(cell("tau [s]"), 67.2 / 220.6 * cell("C_eq [J/K]"), 1e-12);
        near(cell("C_eq [J/K]"), number(&json, &["C_eq", definition]), 1e-15);
        let cells =
            [("max", "K"), ("relative", "-"), ("time", "s"), ("signed", "K"), ("good_from", "s")];
        for (name, unit) in cells {
            for judgement in ["step", "run"] {
                let expected = number(&json, &["errors", definition, judgement, name]);
                near(cell(&format!("{judgement}.{name} [{unit}]")), expected, 1e-15);
            }
        }
        assert_eq!(row["recommended"] == "yes", json["recommended"] == definition);
    }
    near(rows[0]["C_eq [J/K]"].parse().unwrap(), 2659.0, 1e-12);
    near(rows[2]["tau [s]"].parse().unwrap(), gearbox_values("time_constant", "")[0], 1e-9);
}

#[test]
fn the_written_network_runs_and_reduces_to_itself() {
    let folder = Folder::with_gearbox();
    for definition in DEFINITIONS {
        let file = format!("{definition}.toml");
        let arguments = [
            "reduce",
            "gearbox.toml",
            "--port",
            "steel",
            "--definition",
            definition,
            "--format",
            "json",
        ];
        let first =
            folder.run(&[&arguments[..], &["--write", &file]].concat()).exits(0).says("wrote");
        folder.run(&["check", &file]).exits(0).prints("0 warnings");
        folder.run(&["run", &file, "--no-files"]).exits(0);
        let again =
            folder.run(&["reduce", &file, "--port", "steel", "--format", "json"]).exits(0).json();
        near(number(&again, &["R_eq"]), number(&first.json(), &["R_eq"]), 1e-15);
        let written = number(&first.json(), &["C_eq", definition]);
        DEFINITIONS.iter().for_each(|other| near(number(&again, &["C_eq", other]), written, 1e-12));
    }
    let text =
        folder.run(&["reduce", "gearbox.toml", "--port", "steel", "--format", "toml"]).exits(0).out;
    assert_eq!(text, folder.read("least_squares.toml"));
    folder
        .run(&["reduce", "gearbox.toml", "--port", "steel", "--write", "sum.toml"])
        .exits(2)
        .says("error[reduce::exists]: sum.toml exists already");
}

const DUTY: &str = r#"format = 1
[param]
P_high = "40 W"
T_out = "20 degC"
unused = 3
[node]
winding = { C = "50 J/K", T0 = "20 degC" }
housing = { C = "900 J/K", T0 = "20 degC" }
[boundary]
air = { T = "T_out + 5 [K] * sin(2 * pi * t / 1 [h])" }
base = { T = "30 degC" }
[resistor]
wall = { from = "winding", to = "housing", R = "0.9 K/W" }
fins = { from = "housing", to = "air", R = "1.2 K/W" }
feet = { from = "housing", to = "base", R = "3 K/W" }
[source]
copper = { into = "winding", P = "if(t < 10 [min], P_high, 5 [W])" }
iron = { into = "housing", P = "3 W" }
[run]
stop = "1 h"
"#;

#[test]
fn inputs_that_change_are_written_as_they_are() {
    let folder = Folder::with("duty.toml", DUTY);
    let write =
        ["reduce", "duty.toml", "--port", "winding", "--definition", "sum", "--write", "one.toml"];
    let ran = folder.run(&write).exits(1).prints("the inputs change with time");
    let ran = ran.prints("does not collapse: one node is 59 % wrong");
    assert!(ran.out.lines().all(|line| line.chars().count() <= 80), "{}", ran.out);
    let text = folder.read("one.toml");
    assert!(
        text.contains(r#"copper = { into = "winding", P = "if(t < 10 [min], P_high, 5 [W])" }"#),
        "{text}"
    );
    assert!(
        text.contains("T_out + 5 [K] * sin(2 * pi * t / 1 [h])") && !text.contains("unused"),
        "{text}"
    );
    let json = |file| {
        let any = "--max-error=90%";
        folder.run(&["reduce", file, "--port", "winding", "--format", "json", any]).exits(0).json()
    };
    let (first, again) = (json("duty.toml"), json("one.toml"));
    for key in ["R_eq", "T_ref", "Q_N"] {
        near(number(&again, &[key]), number(&first, &[key]), 1e-14);
    }
    DEFINITIONS.iter().for_each(|d| near(number(&again, &["C_eq", d]), 950.0, 1e-12));
    assert!(number(&again, &["errors", "sum", "run", "max"]) < 1e-6);
}

#[test]
fn too_large_an_error_ends_with_1_and_says_so_last() {
    let folder = Folder::with_gearbox();
    let reduce = |more: &[&str]| {
        folder.run(&[&["reduce", "gearbox.toml", "--port", "steel"], more].concat())
    };
    reduce(&["--max-error", "2%"]).exits(0);
    reduce(&["--max-error", "0.5K"]).exits(0);
    let ran = reduce(&["--max-error", "0.5 K", "--definition", "sum"]).exits(1);
    let last = ran.err.lines().last().unwrap_or_default();
    assert!(last.starts_with("too large: with C_eq by sum the error reaches 0.70"), "{last}");
    assert!(last.ends_with("0.5 K is allowed"), "{last}");
    reduce(&["--max-error", "0.5%"]).exits(1).says("0.5% is allowed");
    let first = |more: &[&str]| reduce(more).out.lines().next().unwrap_or_default().to_owned();
    assert_eq!(first(&[]), "collapses to one node within 0.78 % (0.447 K)");
    let refused = first(&["--max-error", "0.5%"]);
    let expected = "does not collapse: one node is 0.78 % wrong (0.447 K); 2 nodes are exact";
    assert_eq!(refused, expected);
    reduce(&["--max-error", "2 W"]).exits(2).says("--max-error");
    reduce(&["--max-error", "0 K"]).exits(2).says("reduce::max_error");
    reduce(&["--window", "0 s"]).exits(2).says("reduce::window");
    reduce(&["--window", "2 K"]).exits(2).says("--window");
}

/// The seed's fit reads 1.4 % too much heat from the steel: validation/gearbox_two_node fit_* at
/// the steel node, there with 751 points, here with the 301 of the file.
#[test]
fn the_bias_of_the_method_is_printed() {
    let folder = Folder::with_gearbox();
    let arguments = ["reduce", "gearbox.toml", "--port", "steel", "--bias", "--format", "json"];
    let bias = &folder.run(&arguments).exits(0).json()["bias"];
    let fit = |quantity| gearbox_values(quantity, "steel")[0];
    let expected = (fit("fit_Tf") - fit("fit_Ti")) * 2659.0 / fit("fit_tau");
    near(number(bias, &["P_inferred"]), expected, 2e-3);
    near(number(bias, &["P_true"]), 220.6, 1e-9);
    near(number(bias, &["relative"]), expected / 220.6 - 1.0, 0.1);
    let ran = folder
        .run(&arguments[..5])
        .exits(0)
        .prints("one exponential")
        .prints("bias of the method: +1.4");
    assert!(ran.out.lines().all(|line| line.chars().count() <= 80), "{}", ran.out);
}

#[test]
fn wrong_ports_end_with_2_and_help() {
    let folder = Folder::with_gearbox();
    let at = |port| folder.run(&["reduce", "gearbox.toml", "--port", port]).exits(2);
    at("stel")
        .says("error[reduce::unknown_port]: no node is named `stel`")
        .says("did you mean `steel`?");
    at("bed").says("error[reduce::boundary_port]: `bed` is a boundary").says("bed = { T");
    at("internal").says("reduce::unknown_port");
    let loose = DUTY
        .replace("to = \"air\"", "to = \"winding\"")
        .replace("to = \"base\"", "to = \"winding\"");
    folder.write("loose.toml", &loose);
    let ran = folder.run(&["reduce", "loose.toml", "--port", "winding"]).exits(2);
    ran.says("error[reduce::no_ground]: no path leads to a boundary from `winding` and `housing`");
}

/// The island of `stone` has no boundary; its 5000 J/K are in no C_eq.
#[test]
fn nodes_apart_from_the_port_are_noted() {
    let apart =
        DUTY.replace("[boundary]", "stone = { C = \"5000 J/K\", T0 = \"20 degC\" }\n[boundary]");
    let folder = Folder::with("apart.toml", &apart);
    let ran = folder.run(&["reduce", "apart.toml", "--port", "winding"]).exits(1);
    let ran = ran.prints("C_eq is that of the 2 nodes that heat from the port reaches; 1 apart");
    assert!(ran.out.lines().all(|line| line.chars().count() <= 80), "{}", ran.out);
    let json = folder
        .run(&["reduce", "apart.toml", "--port", "winding", "--format", "json"])
        .exits(1)
        .json();
    near(number(&json, &["C_eq", "sum"]), 950.0, 1e-14);
    folder.run(&["reduce", "apart.toml", "--port", "stone"]).exits(2).says("boundary from `stone`");
}

#[test]
fn without_run_or_capacity_it_says_what_is_missing() {
    let without_run = DUTY.split("[run]").next().unwrap_or_default();
    let folder = Folder::with("duty.toml", without_run);
    let reduce = |more: &[&str]| {
        let begin = ["reduce", "duty.toml", "--port", "winding", "--max-error=90%"];
        folder.run(&[&begin[..], more].concat())
    };
    let json = reduce(&["--format", "json"]).exits(0).json();
    assert!(json["errors"]["sum"]["run"].is_null() && json["rise"].is_null());
    assert_eq!(json["recommended_by"], "step");
    reduce(&[]).exits(0).prints("without [run] no run is compared");
    let csv =
        rows(&reduce(&["--format", "csv"]).exits(0).says("without [run] no run is compared").out);
    assert!(csv.len() == 4 && csv.iter().all(|row| row["run.max [K]"] == "NaN"), "{csv:?}");
    reduce(&["--bias"]).exits(2).says("run::no_run");
    reduce(&["--for", "run"]).exits(2).says("run::no_run");
    let limited = ["reduce", "duty.toml", "--port", "winding", "--max-error", "1K"];
    folder.run(&limited).exits(2).says("run::no_run");
    let massless = DUTY.replace("C = \"50 J/K\", T0 = \"20 degC\"", "massless = true");
    folder.write(
        "massless.toml",
        &massless.replace("C = \"900 J/K\", T0 = \"20 degC\"", "massless = true"),
    );
    let arguments = ["reduce", "massless.toml", "--port", "winding", "--max-error", "1K"];
    let ran = folder.run(&arguments).exits(0).prints("the port sees no capacity");
    assert!(!ran.out.contains("C_eq"), "{}", ran.out);
    let json = folder.run(&[&arguments[..], &["--format", "json"]].concat()).exits(0).json();
    near(number(&json, &["R_eq"]), 0.9 + 1.0 / (1.0 / 1.2 + 1.0 / 3.0), 1e-14);
    assert!(json["C_eq"].is_null() && json["recommended"].is_null());
    let ran = folder.run(&[&arguments[..], &["--format", "csv"]].concat()).exits(0);
    let row = &rows(&ran.says("the port sees no capacity").out)[0];
    near(row["R_eq [K/W]"].parse().unwrap(), 0.9 + 1.0 / (1.0 / 1.2 + 1.0 / 3.0), 1e-14);
    assert!(
        row["definition"].is_empty() && row["C_eq [J/K]"] == "NaN" && row["recommended"] == "no",
        "{row:?}"
    );
    folder.run(&[&arguments[..], &["--write", "one.toml"]].concat()).exits(0);
    folder.run(&["steady", "one.toml"]).exits(0);
}

#[test]
fn a_port_that_answers_at_once_may_have_no_capacity() {
    let text = r#"format = 1
[node]
port = { massless = true }
wall = { C = "1000 J/K", T0 = "0 degC" }
[boundary]
air = { T = "0 degC" }
[resistor]
inner = { from = "port", to = "wall", R = "0.9 K/W" }
outer = { from = "wall", to = "air", R = "0.1 K/W" }
"#;
    let folder = Folder::with("junction.toml", text);
    let reduce = ["reduce", "junction.toml", "--port", "port", "--max-error", "20%"];
    folder
        .run(&reduce)
        .exits(0)
        .prints("with C_eq 0 J/K (least_squares)")
        .prints("90 % of the rise at the port is immediate");
    let json = folder.run(&[&reduce[..], &["--format", "json"]].concat()).exits(0).json();
    assert_eq!(number(&json, &["C_eq", "least_squares"]).to_bits(), 0);
    near(number(&json, &["errors", "least_squares", "step", "max"]), 0.1, 1e-9);
    let written = folder.run(&[&reduce[..], &["--format", "toml"]].concat()).exits(0).out;
    assert!(written.contains("port = { massless = true }"), "{written}");
}

/// A pulse of 1000 W beside 1 W that lasts 2 s between two rows: the loads go up to 1001 W.
#[test]
fn the_largest_load_is_that_of_the_run_and_not_of_its_rows() {
    let net = "format = 1\n[default]\nT0 = \"20 degC\"\n[node]\na = { C = \"100 J/K\" }\nb = { C = \
               \"900 J/K\" }\n[boundary]\nair = { T = \"20 degC\" }\n[resistor]\n\
               ab = { from = \"a\", to = \"b\", R = \"0.1 K/W\" }\n\
               out = { from = \"b\", to = \"air\", R = \"0.3 K/W\" }\n[source]\nloss = { into = \"a\", \
               P = \"1 [W] + 1000 [W] * exp(-((t - 1237 [s]) / 2 [s])^2)\" }\n\
               [run]\nstop = \"1 h\"\n";
    let folder = Folder::with("peak.toml", net);
    for asked in [["--port", "a"], ["--keep", "a,b"]] {
        let all = ["reduce", "peak.toml", "--format", "json", "--max-error", "90%"];
        let ran = folder.run(&[&all[..], &asked[..]].concat());
        let json = ran.json();
        let power = json["any_load"]["power"]["value"].as_f64();
        let power = power.or(json["power"]["value"].as_f64()).unwrap();
        assert!((power - 1001.0).abs() < 1e-9, "{power}");
    }
}
