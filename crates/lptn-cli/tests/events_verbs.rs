//! What every verb says of a network that switches by itself, and how runs of such networks end.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common;
use crate::interrupt_helper as interrupt;

use common::Folder;

/// The shipped heater: 600 J/K, 3 W/K to 20 degC, 240 W.
const THERMOSTAT: &str = include_str!("../../../networks/thermostat.toml");

/// The same with a comparison in place of the control.
fn chattering() -> String {
    let control = "[control]\nheater = { sense = \"body\", on_below = \"58 degC\", off_above \
        = \"62 degC\", \
                   start = \"on\" }\n\n";
    assert!(THERMOSTAT.contains(control));
    THERMOSTAT.replace(control, "").replace("240 [W] * heater", "if(T < 50 [degC], 240 [W], 0 [W])")
}

#[test]
fn a_comparison_that_chatters_ends_with_3_and_keeps_what_was_before() {
    let folder = Folder::with("net.toml", &chattering());
    let ran = folder.run(&["run", "net.toml"]).exits(3);
    let ran = ran
        .says("run::chatter")
        .says("net.toml:18:32")
        .says("`element.P` changed 21 times")
        .says("[control]");
    assert_eq!(
        ran.err.lines().last(),
        Some("failed: the rows up to then are whole, and marked in the manifest")
    );
    let events = folder.read("out/net/events.csv");
    // 30 K of 80 K
    let reached = 200.0 * (80.0_f64 / 50.0).ln();
    let rows: Vec<&str> = events.lines().skip(1).collect();
    assert!(rows.len() >= 20, "{events}");
    for (row, after) in rows.iter().zip([0, 1].iter().cycle()) {
        let fields: Vec<&str> = row.split(',').collect();
        assert!((fields[0].parse::<f64>().unwrap() - reached).abs() < 1e-2, "{row}");
        assert_eq!(
            fields[1..],
            ["comparison", "element.P", &(1 - after).to_string(), &after.to_string()]
        );
    }
    let manifest: serde_json::Value =
        serde_json::from_str(&folder.read("out/net/manifest.json")).unwrap();
    assert_eq!(manifest["end"]["status"], "failed");
    let (_, rows) = common::csv(&folder.read("out/net/result.csv"));
    assert!(
        rows.last().unwrap()[0] <= reached && rows.len() == 19,
        "rows every 5 s up to {reached} s"
    );
}

#[test]
fn thresholds_that_cross_over_in_a_run_are_shown_with_both_places() {
    let text = THERMOSTAT.replace("\"58 degC\"", "\"58 [degC] + 1 [K] * t / 100 [s]\"");
    let folder = Folder::with("net.toml", &text);
    let ran = folder.run(&["run", "net.toml"]).exits(3).says("solve::input");
    // they meet after 400 s; it is found at a switch or at the end of a step
    ran.says("`on_below` of `heater` crosses over the threshold for off: on at 62")
        .says("net.toml:18:39")
        .says("--------- off");
    let folder = Folder::with("net.toml", &text);
    folder.run(&["run", "net.toml", "--set", "x=1"]).exits(2);
}

#[cfg(unix)]
#[test]
fn an_interrupted_run_keeps_its_events_whole() {
    let long = THERMOSTAT.replace("\"2000 s\"", "\"300 d\"").replace("\"5 s\"", "\"1 d\"");
    let folder = Folder::with("net.toml", &long);
    interrupt::interrupted(&folder, &["run", "net.toml"]).exits(130).says("interrupted at");
    let events = folder.read("out/net/events.csv");
    assert!(events.starts_with("time [s],kind,name,before,after\n") && events.ends_with('\n'));
    assert!(events.lines().all(|line| line.split(',').count() == 5));
    let manifest: serde_json::Value =
        serde_json::from_str(&folder.read("out/net/manifest.json")).unwrap();
    let count = manifest["statistics"]["events"]["value"].as_u64().unwrap();
    assert_eq!(count, events.lines().skip(1).count() as u64);
    assert_eq!(manifest["end"]["status"], "interrupted");
}

#[test]
fn verify_does_not_compare_with_modes_that_never_switch() {
    let folder = Folder::with("net.toml", THERMOSTAT);
    let ran = folder.run(&["verify", "net.toml"]).exits(0);
    ran.prints("`heater` switches at").prints("consistent, not verified");
    let json = folder.run(&["verify", "net.toml", "--format", "json"]).exits(0).json();
    assert_eq!(json["reference"]["independent"], false);
}

#[test]
fn modes_say_that_heat_is_switched_and_refuse_paths_that_switch() {
    let folder = Folder::with("net.toml", THERMOSTAT);
    let ran = folder.run(&["modes", "net.toml"]).exits(0).prints("3.3333 min");
    ran.prints("note: `heater` switches heat; these modes are those between two switches");
    folder.write("path.toml", &THERMOSTAT.replace("\"3 W/K\"", "\"3 [W/K] + 2 [W/K] * heater\""));
    folder.run(&["modes", "path.toml"]).exits(2).says("linearised::not_linear").says("`skin`");
}

#[test]
fn reduce_says_how_the_controls_stand_and_compares_no_run() {
    let folder = Folder::with("net.toml", THERMOSTAT);
    let ran = folder.run(&["reduce", "net.toml", "--port", "body"]).exits(0);
    let ran =
        ran.prints("Q_N             240 W").prints("T_ref and Q_N are those with `heater` on");
    assert!(
        !ran.out.contains("run [K]") && !ran.err.contains("--write"),
        "{}\n{}",
        ran.out,
        ran.err
    );
    let json =
        folder.run(&["reduce", "net.toml", "--port", "body", "--format", "json"]).exits(0).json();
    assert!((json["C_eq"]["sum"]["value"].as_f64().unwrap() - 600.0).abs() < 1e-9);
    assert!(json["errors"]["sum"]["run"].is_null());
    assert!(json["notes"][0].as_str().unwrap().contains("`heater` on"));
    for more in [["--write", "one.toml"], ["--max-error", "1 K"], ["--format", "toml"]] {
        let line = [&["reduce", "net.toml", "--port", "body"], &more[..]].concat();
        folder.run(&line).exits(2).says("reduce::switches").says("`heater` switches during a run");
    }
    assert_eq!(folder.files(), ["net.toml"]);
    folder.write("path.toml", &THERMOSTAT.replace("\"3 W/K\"", "\"3 [W/K] + 2 [W/K] * heater\""));
    folder.run(&["reduce", "path.toml", "--port", "body"]).exits(2).says("reduce::not_linear");
}

#[test]
fn compare_runs_networks_that_switch() {
    let folder = Folder::with("a.toml", THERMOSTAT);
    folder.write("b.toml", &THERMOSTAT.replace("62 degC", "70 degC"));
    let json = folder.run(&["compare", "a.toml", "b.toml", "--format", "json"]).exits(0).json();
    let columns: Vec<&str> =
        json["columns"].as_array().unwrap().iter().map(|c| c["name"].as_str().unwrap()).collect();
    let peak = columns.iter().position(|name| name.contains("peak")).unwrap();
    let peaks: Vec<f64> =
        json["rows"].as_array().unwrap().iter().map(|row| row[peak].as_f64().unwrap()).collect();
    let near = |celsius: f64| peaks.iter().any(|peak| (peak - celsius).abs() < 1e-3);
    assert!(near(62.0) && near(70.0), "{columns:?} {peaks:?}");
}

/// A fan that has to hold 100 W at 70 degC: 2 W/K in all, once it is on.
const FAN: &str = "format = 1\n[param]\nG_fan = \"1.5 W/K\"\n[node]\nbody = { T0 = \"20 degC\", C \
    = \"600 J/K\" }\n\
                   [boundary]\namb = { T = \"20 degC\" }\n[resistor]\n\
                   skin = { from = \"body\", to = \"amb\", G = \"1 [W/K] + G_fan * fan\" \
                   }\n[control]\n\
                   fan = { sense = \"body\", on_above = \"80 degC\", off_below = \"50 degC\" \
                   }\n[source]\n\
                   heat = { into = \"body\", P = \"100 W\" }\n[size.fan]\nminimise = \"G_fan\"\n\
                   vary = { G_fan = { from = \"0.1 W/K\", to = \"1.9 W/K\" } }\nrequire = \
                   [\"body.T <= 70 [degC]\"]\n\
                   [run]\nstop = \"1 h\"\n";

#[test]
fn steady_says_which_controls_are_on_or_that_it_cycles() {
    let folder = Folder::with("fan.toml", FAN);
    let ran = folder.run(&["steady", "fan.toml"]).exits(0).prints("60.0");
    assert!(
        ran.out.lines().any(|line| line.split_whitespace().eq(["fan", "[-]", "1"])),
        "{}",
        ran.out
    );
    let json = folder.run(&["steady", "fan.toml", "--format", "json"]).exits(0).json();
    assert_eq!(json["values"]["fan"], serde_json::json!({ "value": 1.0, "unit": "1" }));
    // 100 W over 6 W/K is 36.7 degC with the fan, 120 degC without
    let ran = folder.run(&["steady", "fan.toml", "--set", "G_fan=5 W/K"]).exits(1);
    ran.says("steady::cycles").says("no steady state: in each of").says("`fan`");
}

#[test]
fn size_counts_on_what_the_controls_do() {
    let folder = Folder::with("fan.toml", FAN);
    let json = folder.run(&["size", "fan.toml", "--format", "json"]).exits(0).json();
    assert!((json["values"]["G_fan"]["value"].as_f64().unwrap() - 1.0).abs() < 1e-6, "{json}");
    folder.write("wide.toml", &FAN.replace("1.9 W/K", "6 W/K"));
    let ran = folder.run(&["size", "wide.toml"]).exits(2).says("steady::cycles");
    ran.says("`vary` has to leave this value out");
}

#[test]
fn check_warns_of_a_control_that_nothing_uses_and_of_a_narrow_dead_band() {
    let unused = THERMOSTAT.replace("240 [W] * heater", "240 W");
    let folder = Folder::with("net.toml", &unused);
    folder.run(&["check", "net.toml"]).exits(0).prints("netlist::unused_control");
    let narrow = THERMOSTAT.replace("62 degC", "58.0000009 degC");
    folder.write("net.toml", &narrow);
    let ran = folder.run(&["check", "net.toml"]).exits(0).prints("netlist::narrow_dead_band");
    ran.prints("9e-7 K, is less than 10 times the tolerance of the run, 1e-7 K");
    folder.write("net.toml", &THERMOSTAT.replace("62 degC", "58.000001 degC"));
    let ran = folder.run(&["check", "net.toml"]).exits(0);
    assert!(!ran.out.contains("warning["), "{}", ran.out);
}

#[test]
fn a_control_that_undoes_itself_at_once_is_named() {
    // heat into a node without capacity moves what is felt at the very moment of the switch
    let tip = THERMOSTAT.replace("[boundary]", "tip = { massless = true }\n\n[boundary]");
    let tip = tip.replace(
        "[control]",
        "wire = { from = \"tip\", to = \"body\", G = \"2 W/K\" }\n\n[control]",
    );
    let tip = tip
        .replace("sense = \"body\"", "sense = \"tip\"")
        .replace("into = \"body\"", "into = \"tip\"");
    let folder = Folder::with("net.toml", &tip);
    let ran = folder.run(&["run", "net.toml"]).exits(3).says("run::restless").says("`min_dwell`");
    ran.says("`heater` switches back and forth at this very moment").prints("heater");
    let dwell = tip.replace("start = \"on\"", "start = \"on\", min_dwell = \"10 s\"");
    Folder::with("net.toml", &dwell).run(&["run", "net.toml"]).exits(0);
}

#[test]
fn switching_without_any_capacity_is_a_wrong_question() {
    let text = THERMOSTAT.replace("T0 = \"20 degC\", C = \"600 J/K\"", "massless = true");
    let folder = Folder::with("net.toml", &text);
    let ran = folder.run(&["run", "net.toml"]).exits(2).says("run::no_capacity").says("a capacity");
    assert_eq!(ran.out, "");
}
