//! Ctrl-C, and the progress of what takes long enough to press it.

#![cfg(unix)]
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common;
use crate::interrupt_helper as interrupt;

use std::io::{Read as _, Write as _};
use std::process::{Command, Stdio};

use common::{Folder, GEARBOX, endless};
use interrupt::interrupted;

/// A finished candidate and one that would take minutes.
fn two() -> Folder {
    let folder = Folder::with_gearbox();
    folder.write("slow.toml", &endless());
    folder
}

#[test]
fn a_run_keeps_its_rows() {
    let folder = Folder::with("gearbox.toml", &endless());
    let ran = interrupted(&folder, &["run", "gearbox.toml"]).exits(130).says("interrupted at");
    assert!(ran.out.contains("heat over"));
    let manifest: serde_json::Value =
        serde_json::from_str(&folder.read("out/gearbox/manifest.json")).unwrap();
    assert_eq!(manifest["end"]["status"], "interrupted");
    assert!(folder.read("out/gearbox/result.csv").starts_with("time [s],steel.T [degC]"));
    assert_eq!(folder.files().len(), 5, "no temporary file is left");
}

#[test]
fn a_picture_of_a_run_that_was_interrupted_is_not_drawn() {
    let folder = Folder::with("gearbox.toml", &endless());
    let ran = interrupted(&folder, &["graph", "gearbox.toml", "--at", "0s", "-o", "x.svg"]);
    ran.exits(130).says("error[run::interrupted]: the run was interrupted at");
    assert_eq!(folder.files(), ["gearbox.toml"]);
}

#[test]
fn a_comparison_prints_what_is_finished_and_names_the_rest() {
    let ran =
        interrupted(&two(), &["compare", "slow.toml", "gearbox.toml", "--threads", "2"]).exits(130);
    let lines: Vec<&str> = ran.out.lines().skip(3).take(2).collect();
    assert!(lines[0].starts_with("gearbox ") && !lines[0].contains("not finished"), "{}", ran.out);
    assert!(lines[1].starts_with("slow ") && lines[1].ends_with("not finished"), "{}", ran.out);
    assert_eq!(ran.err, "interrupted: not finished: slow\n");
}

#[test]
fn candidates_that_were_not_begun_are_missing_too() {
    let folder = two();
    folder.write("third.toml", GEARBOX);
    let line = [
        "compare",
        "gearbox.toml",
        "slow.toml",
        "third.toml",
        "--threads",
        "1",
        "--format",
        "json",
    ];
    let ran = interrupted(&folder, &line).exits(130).says("interrupted: not finished: slow, third");
    let json = ran.json();
    let status: Vec<&str> =
        json["rows"].as_array().unwrap().iter().map(|r| r[2].as_str().unwrap()).collect();
    assert_eq!(status, ["none", "run::interrupted", "run::interrupted"]);
    assert_eq!(json["errors"].as_array().map(Vec::len), Some(2));
}

/// A fit of seconds: many starts, and a heat that swings.
fn long_fit() -> Folder {
    let text = GEARBOX.replace("P = \"P_7000\"", "P = \"P_7000 * (1 + 0.5 * sin(t / 10 [s]))\"");
    let fit = "[fit.heating]\ndata = \"record.csv\"\ncolumn = { ring = \"steel.T\" }\n\
               vary = { bed_share = { from = 0.1, to = 0.9 }, T_amb = { from = \"0 degC\", to \
               = \"50 degC\" } }\n";
    let folder = Folder::with("gearbox.toml", &format!("{text}\n{fit}"));
    let rows: String =
        (0..150).map(|i| format!("{},{}\n", 10 * i, 25.0 + 0.4 * f64::from(i))).collect();
    folder.write("record.csv", &format!("t [s],ring [degC]\n{rows}"));
    folder
}

/// It went on, or ended without a word.
#[test]
fn a_fit_of_a_network_shows_the_best_values_so_far() {
    let line = ["fit", "network", "gearbox.toml", "--starts", "200"];
    let ran = interrupted(&long_fit(), &line).exits(130).says("interrupted in search ");
    let ran =
        ran.says("these values are not a result").says("lptn fit network gearbox.toml --set ");
    assert!(ran.out.starts_with("parameter  best until then  unit"), "{}", ran.out);
    assert!(ran.out.contains("bed_share") && ran.out.contains("T_amb"), "{}", ran.out);
    let json = interrupted(&long_fit(), &[&line[..], &["--format", "json"]].concat()).exits(130);
    let members = json.json();
    assert_eq!(members["errors"][0]["code"], "run::interrupted");
    assert!(members.get("parameters").is_none(), "a part of a fit is no result for a program");
}

#[test]
fn a_verification_says_that_there_is_none() {
    let folder = Folder::with("slow.toml", &endless());
    let ran = interrupted(&folder, &["verify", "slow.toml"]).exits(130);
    assert_eq!((ran.out.as_str(), ran.err.as_str()), ("", "interrupted: nothing is verified\n"));
}

/// Whether `script` of util-linux can play a terminal here.
fn terminal() -> bool {
    let probe =
        Command::new("script").args(["-qec", "true", "/dev/null"]).stdin(Stdio::null()).output();
    let opens = probe.is_ok_and(|output| output.status.success());
    assert!(opens || std::env::var_os("LPTN_REQUIRE_ORACLES").is_none(), "{SKIPPED}");
    opens
}

const SKIPPED: &str =
    "SKIPPED: `script` is missing or opens no terminal; apt-get install bsdutils, mount /dev/pts";

/// What a terminal gets until `awaited` stands on it, Ctrl-C is pressed there and the program has
/// ended.
fn on_terminal(folder: &Folder, arguments: &str, awaited: &str) -> String {
    let line = format!("'{}' {arguments}", env!("CARGO_BIN_EXE_lptn"));
    let mut command = Command::new("script");
    command.args(["-qec", &line, "/dev/null"]).current_dir(folder.path());
    let mut child = command.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().unwrap();
    let (mut keys, mut screen) = (child.stdin.take(), child.stdout.take().unwrap());
    let (mut seen, mut bytes) = (String::new(), [0; 256]);
    loop {
        let count = screen.read(&mut bytes).unwrap_or(0);
        seen += std::str::from_utf8(&bytes[..count]).unwrap();
        if count == 0 {
            break;
        }
        if seen.contains(awaited)
            && let Some(mut keys) = keys.take()
        {
            keys.write_all(b"\x03").unwrap();
        }
    }
    child.wait().unwrap();
    seen
}

#[test]
fn a_terminal_sees_progress() {
    if !terminal() {
        eprintln!("{SKIPPED}");
        return;
    }
    let folder = two();
    let compare = on_terminal(&folder, "compare gearbox.toml slow.toml", " of 2 candidates");
    assert!(compare.contains(" %  1 of 2 candidates"), "{compare}");
    let verify = on_terminal(&folder, "verify slow.toml", " of 500 d");
    assert!(verify.contains("\rat 1e-5 K: ") && verify.contains(" of 500 d"), "{verify}");
    let fit = on_terminal(&long_fit(), "fit network gearbox.toml --starts 200", ", round ");
    assert!(fit.contains("\rsearch ") && fit.contains(" of 201, round "), "{fit}");
}

/// Three seconds are three times as long as the program waits before it shows how far it is.
#[test]
fn a_quiet_program_shows_no_progress() {
    if !terminal() {
        eprintln!("{SKIPPED}");
        return;
    }
    let line = format!(
        "timeout --foreground -s INT 3 '{}' --quiet compare slow.toml; true",
        env!("CARGO_BIN_EXE_lptn")
    );
    let (folder, mut command) = (two(), Command::new("script"));
    command.args(["-qec", &line, "/dev/null"]).current_dir(folder.path()).stdin(Stdio::null());
    let quiet = String::from_utf8(command.output().unwrap().stdout).unwrap();
    assert!(!quiet.contains(" %  "), "{quiet}");
}
