//! What is written, and what is not.

use crate::common;

use common::{Folder, GEARBOX, csv};
use serde_json::Value;
use sha2::{Digest as _, Sha256};

fn sha256(text: &str) -> String {
    Sha256::digest(text).iter().map(|byte| format!("{byte:02x}")).collect()
}

fn manifest(folder: &Folder, name: &str) -> Value {
    serde_json::from_str(&folder.read(name)).expect("the manifest is JSON")
}

#[test]
fn a_run_writes_four_files_and_nothing_else() {
    let folder = Folder::with_gearbox();
    folder.run(&["run", "gearbox.toml"]).exits(0).says("wrote  out/gearbox/result.csv");
    let written = ["events.csv", "manifest.json", "result.csv", "state.json"];
    let written = written.map(|name| format!("out/gearbox/{name}"));
    assert_eq!(folder.files(), [&["gearbox.toml".to_owned()][..], &written].concat());
    folder.run(&["run", "gearbox.toml", "-o", "elsewhere/deep"]).exits(0);
    assert!(folder.files().contains(&"elsewhere/deep/result.csv".to_owned()));
}

#[test]
fn no_files_means_none() {
    let folder = Folder::with_gearbox();
    folder.run(&["run", "gearbox.toml", "--no-files"]).exits(0);
    folder.run(&["steady", "gearbox.toml"]).exits(0);
    folder.run(&["check", "gearbox.toml"]).exits(0);
    assert_eq!(folder.files(), ["gearbox.toml"]);
}

#[test]
fn stdin_has_a_folder_of_its_own() {
    let folder = Folder::empty();
    folder.run_with(&["run", "-"], GEARBOX).exits(0);
    let written = ["events.csv", "manifest.json", "result.csv", "state.json"];
    assert_eq!(folder.files(), written.map(|name| format!("out/stdin/{name}")));
    assert_eq!(manifest(&folder, "out/stdin/manifest.json")["inputs"][0]["name"], "<stdin>");
}

#[test]
fn stdout_and_file_hold_the_same_csv_and_it_reads_back() {
    let folder = Folder::with_gearbox();
    let ran = folder.run(&["run", "gearbox.toml", "--format", "csv"]).exits(0);
    assert_eq!(ran.out, folder.read("out/gearbox/result.csv"));
    let (_, rows) = csv(&ran.out);
    assert_eq!(rows.len(), 301);
    assert!(rows.windows(2).all(|pair| pair[0][0] < pair[1][0]), "times increase");
    // read by the standard library: serde_json rounds the last digit
    let json = folder.run(&["run", "gearbox.toml", "--no-files", "--format", "json"]).exits(0).out;
    let lines = json.lines().skip_while(|line| !line.contains("\"rows\"")).skip(1);
    for (row, line) in rows.iter().zip(lines) {
        let values: Vec<f64> = line
            .trim()
            .trim_matches(|c| "[],".contains(c))
            .split(", ")
            .map(|v| v.parse().unwrap())
            .collect();
        assert_eq!(*row, values);
    }
}

#[test]
fn the_manifest_names_what_made_the_result() {
    let folder = Folder::with_gearbox();
    folder.run(&["run", "gearbox.toml", "--set", "T_amb=30degC", "--tolerance", "1 mK"]).exits(0);
    let manifest = manifest(&folder, "out/gearbox/manifest.json");
    assert_eq!(manifest["format"], 1);
    assert_eq!(manifest["inputs"][0]["name"], "gearbox.toml");
    assert_eq!(manifest["inputs"][0]["sha256"], sha256(GEARBOX));
    assert_eq!(manifest["results"][0]["name"], "result.csv");
    assert_eq!(manifest["results"][0]["sha256"], sha256(&folder.read("out/gearbox/result.csv")));
    assert_eq!(manifest["arguments"][0], "run");
    assert_eq!(manifest["parameters"]["T_amb"]["set"], "30degC");
    assert!((manifest["parameters"]["T_amb"]["value"].as_f64().unwrap() - 303.15).abs() < 1e-9);
    assert_eq!(
        manifest["parameters"]["P_7000"],
        serde_json::json!({ "value": 220.6, "unit": "W" })
    );
    assert!((manifest["tolerance"]["value"].as_f64().unwrap() - 1e-3).abs() < 1e-15);
    assert_eq!(manifest["stop"]["value"], 1500.0);
    assert_eq!(manifest["end"]["status"], "reached");
    assert_eq!(manifest["ledger"]["closes"], true);
    assert!(manifest["statistics"]["steps"]["value"].as_u64().unwrap() > 0);
    assert!(
        ["6", "7"].iter().any(|v| manifest["sundials"]["version"].as_str().unwrap().starts_with(v))
    );
    assert!(["system", "bundled"].contains(&manifest["sundials"]["linkage"].as_str().unwrap()));
    assert!(manifest["environment"]["written"].as_str().unwrap().ends_with('Z'));
}

#[test]
fn two_runs_give_the_same_bytes() {
    let folder = Folder::with_gearbox();
    let one = || {
        let ran = folder.run(&["run", "gearbox.toml"]).exits(0);
        let manifest = folder.read("out/gearbox/manifest.json");
        let fixed = manifest.split("\"environment\"").next().unwrap().to_owned();
        (ran.out, folder.read("out/gearbox/result.csv"), fixed)
    };
    assert_eq!(one(), one());
    let json = || folder.run(&["run", "gearbox.toml", "--format", "json"]).exits(0).out;
    assert_eq!(json(), json());
}

#[test]
fn a_folder_that_cannot_be_written_is_said_before_the_run() {
    let folder = Folder::with_gearbox();
    folder.write("out", "a file where the folder should be");
    folder.run(&["run", "gearbox.toml"]).exits(2).says("output::cannot_create").says("--no-files");
    folder
        .run(&["run", "gearbox.toml", "-o", "gearbox.toml/sub"])
        .exits(2)
        .says("output::cannot_create");
    assert_eq!(folder.files(), ["gearbox.toml", "out"]);
}

/// A full disk, played by a limit on the size of files.
#[test]
fn a_full_disk_leaves_no_half_file() {
    let folder = Folder::with_gearbox();
    let script = "trap '' XFSZ; ulimit -f 1; exec \"$0\" run gearbox.toml";
    let mut command = std::process::Command::new("sh");
    command.args(["-c", script, env!("CARGO_BIN_EXE_lptn")]).current_dir(folder.path());
    common::Ran::of(command.output().unwrap()).exits(3).says("output::cannot_write");
    assert_eq!(folder.files(), ["gearbox.toml"]);
}

#[test]
fn selected_columns_are_the_only_ones() {
    let folder = Folder::with_gearbox();
    let headers = |patterns: &[&str]| {
        let mut arguments = vec!["run", "gearbox.toml", "--no-files", "--format", "csv"];
        patterns.iter().for_each(|pattern| arguments.extend(["--select", pattern]));
        csv(&folder.run(&arguments).exits(0).out).0
    };
    assert_eq!(headers(&["st*.T"]), ["time [s]", "steel.T [degC]"]);
    assert_eq!(headers(&["bed.?"]), ["time [s]", "bed.T [degC]", "bed.Q [W]"]);
    assert_eq!(headers(&["*.P", "steel.T"]), ["time [s]", "steel.T [degC]", "P_disp.P [W]"]);
}
