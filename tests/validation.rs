//! The validation set, whose answers nobody computed with lptn: textbooks, standards, closed forms,
//! result files of other tools, measured records. `tests/validation/README.md` is its format; every
//! `case.json` says where its numbers come from. `LPTN_VALIDATION_DIR` names another folder of the
//! same format.
//!
//! The table of the cases shows classes of error, not digits, because machines and versions of
//! SUNDIALS differ in digits. A row fails if its error leaves its class upwards, or is thirty times
//! smaller.

#![allow(clippy::print_stdout, reason = "the table of results, shown with --nocapture")]

use crate::validation_helper as validation;

use std::path::{Path, PathBuf};

use lptn_solve::{available_threads, in_parallel};
use serde_json::{Value, json};
use validation::{Report, cases, judge, own_folder};

/// Runs every case of a folder; prints the table.
fn reports(folder: &Path) -> Vec<Report> {
    let names = cases(folder);
    let run = |id: &String| judge(id, &validation::json(folder, id));
    let reports = in_parallel(&names, available_threads(), run);
    println!("{}", Report::heading());
    reports.iter().for_each(|report| print!("{report}"));
    let sum = |i: usize| reports.iter().map(|report| report.counts()[i]).sum::<usize>();
    println!("{} cases: {} values right, {} wrong", names.len(), sum(0), sum(1));
    reports
}

fn complain(reports: &[Report]) {
    let complaints: Vec<&str> =
        reports.iter().flat_map(Report::complaints).map(String::as_str).collect();
    assert!(complaints.is_empty(), "\n{}", complaints.join("\n"));
}

#[test]
fn every_case_is_answered() {
    let folder = own_folder();
    let reports = reports(&folder);
    complain(&reports);
    assert!(reports.len() >= 34, "only {} cases", reports.len());
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/validation.md");
    validation::page::keep(&page, &reports, |id| validation::json(&folder, id));
}

#[test]
fn another_folder_is_answered() {
    let Some(folder) = std::env::var_os("LPTN_VALIDATION_DIR").map(PathBuf::from) else {
        println!("LPTN_VALIDATION_DIR names no other folder");
        return;
    };
    let reports = reports(&folder);
    assert!(!reports.is_empty(), "{} has no cases", folder.display());
    complain(&reports);
}

/// The values of a case moved by ten times what is allowed.
fn moved(mut case: Value) -> Value {
    for expected in case["expected"].as_array_mut().expect("a list") {
        let of = |key: &str| expected[key].as_f64().unwrap_or(0.0);
        let value = of("value");
        let allowed = of("tol_abs").max(of("tol_rel") * value.abs());
        expected["value"] = json!(value + 10.0 * allowed);
    }
    case
}

#[test]
fn a_wrong_value_is_found() {
    for id in [
        "bridge_steady",
        "duty_cycle_one_node",
        "gearbox_two_node",
        "incropera_1_2_pipe",
        "rc_ladder",
    ] {
        let right = validation::json(&own_folder(), id);
        let wrong = judge(id, &moved(right.clone()));
        let count = right["expected"].as_array().expect("a list").len();
        assert_eq!(wrong.counts(), [0, count], "{id}: {:?}", wrong.complaints());
        // temperatures also contradict their proven errors
        let proven = wrong.complaints().iter().filter(|text| text.contains("K off, proven"));
        assert_eq!(wrong.complaints().len(), count + proven.count());
    }
}

fn complaint_of(id: &str, change: impl Fn(&mut Value)) -> String {
    let mut case = validation::json(&own_folder(), id);
    change(&mut case);
    judge(id, &case).complaints().join("\n")
}

#[test]
fn what_the_format_does_not_know_is_an_error() {
    let said = |change: &dyn Fn(&mut Value)| complaint_of("incropera_1_2_pipe", change);
    assert_eq!(said(&|_| ()), "");
    assert!(
        said(&|case| case["format"] = json!("lptn-validation-2")).contains("lptn-validation-2")
    );
    assert!(said(&|case| case["surprise"] = json!(1)).contains("surprise"));
    assert!(said(&|case| case["requires"] = json!(["magic"])).contains("magic"));
    assert!(said(&|case| case["id"] = json!("other")).contains("other"));
    assert!(said(&|case| case["expected"] = json!([])).contains("nothing is expected"));
    assert!(said(&|case| case["nodes"][0]["type"] = json!("cloud")).contains("cloud"));
    assert!(said(&|case| case["nodes"][0]["C"] = json!(1.0)).contains('C'));
    assert!(said(&|case| case["nodes"][0]["T"] = json!({ "kind": "noise" })).contains("noise"));
    assert!(said(&|case| case["edges"][0]["type"] = json!("wormhole")).contains("wormhole"));
    assert!(said(&|case| case["edges"][0]["tilt"] = json!(1)).contains("tilt"));
    assert!(said(&|case| case["expected"][0]["quantity"] = json!("entropy")).contains("entropy"));
    assert!(said(&|case| case["expected"][0]["colour"] = json!(1)).contains("colour"));
    assert!(said(&|case| case["expected"][0]["tol_abs"] = json!("much")).contains("much"));
    let untold = |case: &mut Value| {
        drop(case["expected"][0].as_object_mut().expect("a value").remove("tol_abs"))
    };
    assert!(said(&untold).contains("no tolerance"));
}

/// What the format has and no case of the set uses, with closed forms. A body (100 J/K, 20 K above
/// the surroundings) cools through a junction that halves its rise, with a time constant of 50 s.
/// The heat of a second junction jumps at 10 s. In `warm` the capacity grows with temperature, in
/// `coil` the resistance: both need `x + x^2/200 = 10.5` for a rise of x = 10 K.
fn unusual() -> Value {
    let rise = 20.0 / std::f64::consts::E;
    let given = (2000.0 - 100.0 * rise) / 50.0;
    let value = |quantity: Value, value: f64, tolerance: f64| {
        let mut expected = quantity;
        expected["value"] = json!(value);
        expected["tol_abs"] = json!(tolerance);
        expected
    };
    json!({
        "format": "lptn-validation-1", "id": "unusual", "title": "", "kinds": [], "provenance": "closed form",
        "source": "", "proves": "", "temperature_unit": "C", "celsius_zero_K": 273.15,
        "requires": ["temperature-dependent capacitance"], "solver_hint": "nonstiff", "max_step": 5.0, "t_end": 250.0,
        "nodes": [
            { "id": "t", "type": "capacitance", "C": 100.0, "T0": 40.0 },
            { "id": "half way", "type": "massless" },
            { "id": "joint", "type": "massless", "T_guess": null },
            { "id": "warm", "type": "capacitance", "C": 100.0, "T0": 20.0,
              "C_of_T": { "kind": "linear", "beta": 0.01, "Tref": 20.0 } },
            { "id": "coil", "type": "capacitance", "C": 100.0, "T0": 20.0 },
            { "id": "air", "type": "boundary", "T": 20.0 },
        ],
        "edges": [
            { "id": "t", "type": "conductance", "a": "t", "b": "half way", "G": 4.0 },
            { "id": "1", "type": "conductance_linear_T", "a": "half way", "b": "air", "G0": 4.0, "beta": 0.0, "Tref": 0.0, "at": "a" },
            { "id": "2", "type": "conductance", "a": "joint", "b": "air", "G": 2.0 },
        ],
        "sources": [
            { "id": "step", "node": "joint", "kind": "heat",
              "Q": { "kind": "table", "t": [5.0, 10.0], "v": [2.0, 6.0], "interp": "previous" } },
            { "id": "warmer", "node": "warm", "kind": "heat", "Q": 50.0 },
            { "id": "coil", "node": "coil", "kind": "resistor", "V": 10.0, "R": 20.0, "alpha": 0.01, "Tref": 20.0 },
        ],
        "expected": [
            value(json!({ "quantity": "T", "node": "t", "minus": "air", "t": 50.0 }), rise, 1e-5),
            value(json!({ "quantity": "T", "combine": { "t": 0.5, "half way": 0.5 }, "t": 50.0 }), 20.0 + 0.75 * rise, 1e-5),
            value(json!({ "quantity": "T", "node": "joint", "t": 10.0 }), 21.0, 1e-9),
            value(json!({ "quantity": "T", "node": "joint", "t": 10.0, "side": "left" }), 21.0, 1e-9),
            value(json!({ "quantity": "T", "node": "joint", "t": 10.0, "side": "right" }), 23.0, 1e-9),
            value(json!({ "quantity": "Q_edge", "edge": "2", "t": 10.0, "side": "right" }), 6.0, 1e-9),
            value(json!({ "quantity": "Q_boundary", "node": "air", "t": 50.0 }), -6.0 - 2.0 * rise, 1e-5),
            value(json!({ "quantity": "Q_boundary_mean", "node": "air", "t0": 0.0, "t1": 50.0 }), -given - 5.2, 1e-5),
            value(json!({ "quantity": "T_mean", "node": "joint", "t0": 0.0, "t1": 50.0 }), 22.6, 1e-9),
            value(json!({ "quantity": "T", "node": "warm", "t": 21.0 }), 30.0, 1e-5),
            value(json!({ "quantity": "T", "node": "coil", "t": 210.0 }), 30.0, 1e-5),
            value(json!({ "quantity": "crossing_time", "node": "t", "level": 30.0, "direction": "falling", "t_end": 200.0 }),
                  50.0 * std::f64::consts::LN_2, 1e-5),
            value(json!({ "quantity": "crossing_time", "node": "warm", "level": 30.0, "after": 20.0 }), 21.0, 1e-5),
        ],
    })
}

#[test]
fn the_whole_format_is_understood() {
    let report = judge("unusual", &unusual());
    assert_eq!(report.counts(), [13, 0], "{report}\n{}", report.complaints().join("\n"));
}

/// A body with an island beside it that keeps its heat: the mean of the island is a mode that never
/// dies.
#[test]
fn modes_that_never_die_may_be_skipped_and_sources_sized() {
    let case = json!({
        "format": "lptn-validation-1", "id": "island", "title": "", "kinds": [], "provenance": "closed form",
        "source": "", "proves": "", "temperature_unit": "K",
        "nodes": [
            { "id": "island", "type": "capacitance", "C": 7.0, "T0": 300.0 },
            { "id": "body", "type": "capacitance", "C": 100.0, "T0": 280.0 },
            { "id": "air", "type": "boundary", "T": 280.0 },
        ],
        "edges": [{ "id": "path", "type": "convection", "a": "body", "b": "air", "h": 4.0, "A": 0.5 }],
        "sources": [{ "id": "heat", "node": "body", "kind": "heat", "Q": 1.0 }],
        "expected": [
            { "quantity": "time_constant", "index": 0, "skip_zero": true, "value": 50.0, "tol_rel": 1e-12 },
            { "quantity": "size", "source": "heat", "field": "Q", "node": "body", "limit": 330.0, "lo": 1.0,
              "hi": 1000.0, "value": 100.0, "tol_rel": 1e-10 },
        ],
    });
    let report = judge("island", &case);
    assert_eq!(report.counts(), [2, 0], "{report}\n{}", report.complaints().join("\n"));
}

/// A body of 50 s that starts at 50 degC in air of 20 degC: both are found from its record.
#[test]
fn starts_and_boundaries_are_calibrated() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let data = folder.join("cooling.csv");
    let row = |t: u32| format!("{t},{}\n", 20.0 + 30.0 * (-f64::from(t) / 50.0).exp());
    let rows: String = (0..40).map(|k| row(5 * k)).collect();
    std::fs::write(&data, format!("t,T\n{rows}")).expect("a folder of the tests");
    let target = |id: &str, field: &str| json!([{ "list": "nodes", "id": id, "field": field }]);
    let case = json!({
        "format": "lptn-validation-1", "id": "cooling", "title": "", "kinds": [], "provenance": "closed form",
        "source": "", "proves": "", "temperature_unit": "C", "celsius_zero_K": 273.15,
        "nodes": [
            { "id": "body", "type": "capacitance", "C": 100.0, "T0": 40.0 },
            { "id": "air", "type": "boundary", "T": 15.0 },
        ],
        "edges": [{ "id": "path", "type": "conductance", "a": "body", "b": "air", "G": 2.0 }],
        "sources": [],
        "calibration": {
            "data": data, "time_column": "t", "objective": "least squares",
            "observations": [{ "node": "body", "column": "T" }],
            "parameters": [
                { "name": "start", "initial": 40.0, "targets": target("body", "T0") },
                { "name": "air", "initial": 15.0, "targets": target("air", "T") },
            ],
        },
        "expected": [
            { "quantity": "calibrated", "param": "start", "label": "a comment", "value": 50.0, "tol_abs": 1e-4 },
            { "quantity": "calibrated", "param": "air", "value": 20.0, "tol_abs": 1e-4 },
        ],
    });
    let report = judge("cooling", &case);
    assert_eq!(report.counts(), [2, 0], "{report}\n{}", report.complaints().join("\n"));
}
