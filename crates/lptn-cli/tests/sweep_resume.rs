//! A sweep that is stopped goes on as if it had not been: killed, interrupted, torn, in a folder
//! that is taken.

#![cfg(unix)]
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common;

use std::io::Write as _;
use std::process::Stdio;
use std::time::{Duration, Instant};

use common::{Folder, Ran};

/// A nonlinear network: a candidate takes some milliseconds.
fn netlist(points: usize) -> String {
    format!(
        r#"
format = 1

[param]
P = "100 W"
eps = 0.8

[node]
block = {{ T0 = "20 degC", C = "1 kJ/K" }}
shield = {{ T0 = "20 degC", C = "100 J/K" }}

[boundary]
air = {{ T = "20 degC" }}

[resistor]
feet = {{ from = "block", to = "air", R = "2 K/W" }}

[radiation]
inner = {{ from = "block", to = "shield", area = "0.1 m^2", emissivity = "eps" }}
outer = {{ from = "shield", to = "air", area = "0.1 m^2", emissivity = "eps" }}

[source]
loss = {{ into = "block", P = "P * (1 + 0.5 * sin(t / 20 [s]))" }}

[run]
stop = "1 h"

[sweep.shields]
method = "grid"
over = "run"
axes = {{ P = {{ from = "10 W", to = "100 W", points = {points} }}, eps = [0.1, 0.5, 0.9] }}
report = {{ T_block = "max(block.T)", T_shield = "max(shield.T)", hot = "time_over(block.T, 60 [degC])" }}
"#
    )
}

const COMMAND: [&str; 4] = ["sweep", "shield.toml", "-o", "out"];

/// A number from 0 to 1 that is another one each time.
fn chance(state: &mut u64) -> f64 {
    *state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    (*state >> 11) as f64 / (1_u64 << 53) as f64
}

/// Kills a sweep so many times at moments that nobody chose, and compares what it comes to with one
/// that nobody killed.
fn killed(points: usize, times: usize, seed: u64) {
    let folder = Folder::with("shield.toml", &netlist(points));
    let begun = Instant::now();
    folder.run(&["sweep", "shield.toml", "-o", "whole"]).exits(0);
    let whole = begun.elapsed();
    let mut state = seed;
    for _ in 0..times {
        let words = [&COMMAND[..], &["--resume"]].concat();
        let mut child =
            folder.command(&words).stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
        let moment = whole.mul_f64(chance(&mut state) * 1.5 / times as f64);
        std::thread::sleep(moment + Duration::from_millis(5));
        // SIGKILL
        child.kill().unwrap();
        child.wait().unwrap();
    }
    folder.run(&[&COMMAND[..], &["--resume"]].concat()).exits(0);
    assert_eq!(folder.read("out/sweep.csv"), folder.read("whole/sweep.csv"));
    assert!(!folder.path().join("out/sweep.csv.part").exists());
}

#[test]
fn one_that_is_killed_goes_on() {
    killed(40, 5, 7);
}

/// More than ten seconds of work, killed fifty times.
#[test]
#[ignore = "takes a minute"]
fn one_that_is_killed_fifty_times_goes_on() {
    killed(2000, 50, 11);
}

#[test]
fn a_torn_line_is_cut_off() {
    let folder = Folder::with("shield.toml", &netlist(4));
    folder.run(&["sweep", "shield.toml", "-o", "whole"]).exits(0);
    let whole = folder.read("whole/sweep.csv");
    let (mut kept, mut torn) = (0, 0);
    for cut in (0..whole.len()).step_by(37) {
        // as a process leaves it that was killed behind so many bytes
        folder.run(&[&COMMAND[..], &["--resume"]].concat()).exits(0);
        std::fs::remove_file(folder.path().join("out/manifest.json")).unwrap();
        std::fs::rename(folder.path().join("out/sweep.csv"), folder.path().join("rows")).unwrap();
        let begun: serde_json::Value =
            serde_json::from_str(&folder.read("whole/manifest.json")).unwrap();
        folder.write("out/sweep.json", &begun["sweep"].to_string());
        folder.write("out/sweep.csv.part", &whole[..cut]);
        folder.run(&COMMAND).exits(2).says("sweep::unfinished");
        folder.run(&[&COMMAND[..], &["--resume"]].concat()).exits(0);
        assert_eq!(folder.read("out/sweep.csv"), whole, "cut behind {cut} bytes");
        if whole[..cut].ends_with('\n') { kept += 1 } else { torn += 1 }
    }
    assert!(torn > 5, "{torn} {kept}");
}

#[test]
fn rows_of_another_sweep_are_refused() {
    let folder = Folder::with("shield.toml", &netlist(4));
    let resumed = [&COMMAND[..], &["--resume"]].concat();
    folder.run(&COMMAND).exits(0);
    folder.run(&resumed).exits(0).says("is there already, and whole");
    folder.write("shield.toml", &netlist(4).replace("2 K/W", "3 K/W"));
    folder.run(&resumed).exits(2).says("sweep::other_inputs");
    folder.run(&[&resumed[..], &["--set", "P=7W"]].concat()).exits(2);
    // without --resume a sweep that is whole is replaced, as results of runs are
    folder.run(&COMMAND).exits(0);
    let whole = folder.read("out/sweep.csv");
    let manifest: serde_json::Value =
        serde_json::from_str(&folder.read("out/manifest.json")).unwrap();
    folder.write("out/sweep.json", &manifest["sweep"].to_string());
    folder.write("out/sweep.csv.part", &whole.replace("\n3,", "\n4,"));
    folder.run(&resumed).exits(2).says("sweep::damaged");
}

#[test]
fn what_is_finished_is_kept_on_ctrl_c() {
    let folder = Folder::with("shield.toml", &netlist(100_000));
    let child =
        folder.command(&COMMAND).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let rows = folder.path().join("out/sweep.csv.part");
    let begun = Instant::now();
    while std::fs::metadata(&rows).map_or(0, |file| file.len()) < 2000
        && begun.elapsed() < Duration::from_secs(300)
    {
        std::thread::sleep(Duration::from_millis(10));
    }
    let id = child.id().to_string();
    assert!(std::process::Command::new("kill").args(["-INT", &id]).status().unwrap().success());
    let ran = Ran::of(child.wait_with_output().unwrap()).exits(130).says("--resume");
    let kept = folder.read("out/sweep.csv.part");
    let count = kept.lines().count() - 1;
    assert!(kept.ends_with('\n') && ran.err.contains(&format!("after {count} candidates")));
}

#[test]
fn one_folder_is_one_process() {
    let folder = Folder::with("shield.toml", &netlist(100_000));
    let mut child =
        folder.command(&COMMAND).stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
    let begun = Instant::now();
    while !folder.path().join("out/sweep.csv.part").exists() && begun.elapsed().as_secs() < 300 {
        std::thread::sleep(Duration::from_millis(10));
    }
    folder.run(&COMMAND).exits(2).says("output::in_use");
    child.kill().unwrap();
    child.wait().unwrap();
}

/// `/dev/full` takes nothing, as a disk that is full.
#[test]
fn a_full_disk_is_told_and_nothing_is_lost() {
    let folder = Folder::with("shield.toml", &netlist(4));
    folder.run(&COMMAND).exits(0);
    let whole = folder.read("out/sweep.csv");
    let manifest: serde_json::Value =
        serde_json::from_str(&folder.read("out/manifest.json")).unwrap();
    folder.write("out/sweep.json", &manifest["sweep"].to_string());
    std::os::unix::fs::symlink("/dev/full", folder.path().join("out/sweep.csv.part")).unwrap();
    folder.run(&[&COMMAND[..], &["--resume"]].concat()).exits(3).says("output::cannot_write");
    assert_eq!(folder.read("out/sweep.csv"), whole);
    let stdout = std::fs::File::options().write(true).open("/dev/full").unwrap();
    let words = ["sweep", "shield.toml", "--no-files", "--format", "csv"];
    let mut command = folder.command(&words);
    let ran = Ran::of(command.stdout(stdout).stderr(Stdio::piped()).output().unwrap());
    ran.exits(3).says("output::stdout");
    drop(std::io::stdout().flush());
}
