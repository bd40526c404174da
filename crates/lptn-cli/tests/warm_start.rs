//! `state.json`, and runs that start from one.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common;

use common::{Folder, GEARBOX, csv};
use serde_json::Value;

/// Ten times the tolerance of the runs: what the design allows a run to be off.
const ALLOWED: f64 = 10.0 * 1e-5;

/// A heated block whose capacity and whose heat depend on temperature and time, and a junction.
const IRON: &str = r#"
format = 1

[node]
iron = { T0 = "25 degC", C = "500 [J/K] * (1 + 0.002 [1/K] * (T - 25 [degC]))" }
fin = { T0 = "25 degC", C = "120 J/K" }
root = { massless = true }

[boundary]
air = { T = "25 degC" }

[resistor]
bolt = { from = "iron", to = "root", R = "0.2 K/W" }
blade = { from = "root", to = "fin", R = "0.1 K/W" }
skin = { from = "fin", to = "air", G = "0.8 [W/K] * (1 + 0.003 [1/K] * dT)" }

[source]
loss = { into = "iron", P = "100 [W] * (1 + 0.3 * sin(t / 200 [s]))" }

[run]
stop = "25 min"
"#;

/// 50 W into 0.2 kg of wax: 12 kJ up to 55 degC, 40 kJ to melt it, 400 J/K after that.
const WAX: &str = r#"
format = 1

[material.wax]
cp = "2 kJ/(kg K)"
solidus = "55 degC"
liquidus = "55 degC"
latent_heat = "200 kJ/kg"
source = "round numbers"

[node]
wax = { T0 = "25 degC", material = "wax", mass = "0.2 kg" }

[source]
heater = { into = "wax", P = "50 W" }

[run]
stop = "25 min"
"#;

/// The text with another stop, and with what follows it.
fn with_stop(text: &str, stop: &str) -> String {
    text.replace("stop = \"25 min\"", stop)
}

/// Temperatures of the last row.
fn last(folder: &Folder, file: &str) -> Vec<f64> {
    let out = folder.run(&["run", file, "--select", "*.T", "--format", "csv"]).exits(0).out;
    csv(&out).1.pop().unwrap()
}

fn state(folder: &Folder, name: &str) -> Value {
    serde_json::from_str(&folder.read(&format!("out/{name}/state.json"))).unwrap()
}

/// A run of 25 min, and one of 10 min with another of 15 min from its state.
fn whole_and_parts(text: &str, second: &str) -> (Folder, Vec<f64>, Vec<f64>) {
    let folder = Folder::with("whole.toml", text);
    folder.write("first.toml", &with_stop(text, "stop = \"10 min\""));
    folder.write("second.toml", &with_stop(text, second));
    let whole = last(&folder, "whole.toml");
    last(&folder, "first.toml");
    let parts = last(&folder, "second.toml");
    (folder, whole, parts)
}

#[track_caller]
fn same(whole: &[f64], parts: &[f64]) {
    assert_eq!(whole.len(), parts.len());
    for (a, b) in whole.iter().zip(parts).skip(1) {
        assert!((a - b).abs() <= ALLOWED, "{whole:?} {parts:?}");
    }
}

#[test]
fn a_gearbox_in_two_parts_ends_where_the_whole_does() {
    let second = "stop = \"15 min\"\ninitial = \"out/first/state.json\"";
    let (folder, whole, parts) = whole_and_parts(GEARBOX, second);
    same(&whole, &parts);
    let state = state(&folder, "first");
    assert_eq!((&state["format"], &state["end"]), (&Value::from(1), &Value::from("reached")));
    assert_eq!(state["network"], "first");
    assert_eq!(state["time"], serde_json::json!({ "value": 600.0, "unit": "s" }));
    assert_eq!(state["controls"], serde_json::json!({}));
    // the last row is rounded to no digit: steel.T of the CSV is that of the state in degC
    let steel = state["temperatures"]["values"]["steel"].as_f64().unwrap();
    let row = csv(&folder.read("out/first/result.csv")).1.pop().unwrap();
    assert!((steel - 273.15 - row[1]).abs() < 1e-12 * steel);
}

#[test]
fn a_changing_capacity_and_inputs_over_time_go_on_where_they_were() {
    let second = "start = \"10 min\"\nstop = \"25 min\"\ninitial = \"out/first/state.json\"";
    let (folder, whole, parts) = whole_and_parts(IRON, second);
    same(&whole, &parts);
    let names =
        state(&folder, "first")["temperatures"]["values"].as_object().unwrap().keys().count();
    assert_eq!(names, 3, "the junction is there too");
}

/// An oven under a PI controller, and the energy that it took.
const OVEN: &str = r#"
format = 1

[node]
oven = { C = "2 kJ/K", T0 = "20 degC" }

[boundary]
room = { T = "20 degC" }

[resistor]
wall = { from = "oven", to = "room", G = "1 W/K" }

[controller]
heat = { sense = "oven", setpoint = "180 degC", K_p = "20 W/K", K_i = "0.05 W/(K s)", min = "0 W", max = "800 W" }

[state]
used = { rate = "heat", start = "0 kJ", size = "1 MJ" }

[source]
element = { into = "oven", P = "heat" }

[run]
stop = "25 min"
"#;

#[test]
fn states_go_on_where_they_were() {
    let second = "stop = \"15 min\"\ninitial = \"out/first/state.json\"";
    let (folder, whole, parts) = whole_and_parts(OVEN, second);
    same(&whole, &parts);
    let states = state(&folder, "first")["states"].as_object().unwrap().clone();
    assert_eq!(states.keys().collect::<Vec<_>>(), ["used", "heat.integral"]);
    let used = |file: &str| {
        let run = ["run", file, "--select", "used", "--format", "csv"];
        csv(&folder.run(&run).exits(0).out).1.pop().unwrap()[1]
    };
    let (whole, parts) = (used("whole.toml"), used("second.toml"));
    assert!((whole - parts).abs() < 1e-6 * whole, "{whole} {parts} kJ");
    // written out, they begin where they were
    let flat = folder.run(&["check", "--expand", "second.toml"]).exits(0).out;
    folder.write("flat.toml", &flat);
    let flat = used("flat.toml");
    assert!((flat - parts).abs() < 1e-6 * parts, "{flat} {parts} kJ");
    let bare = OVEN.replace(
        "used = { rate = \"heat\", start = \"0 kJ\", size = \"1 MJ\" }",
        "lost = { rate = \"heat\", start = \"1 J\" }",
    );
    folder.write("bare.toml", &with_stop(&bare, second));
    let refused = folder.run(&["run", "bare.toml"]).exits(2);
    refused.says("netlist::state_missing_state").says("netlist::state_unknown_name");
}

#[test]
fn wax_goes_on_melting_where_it_was() {
    let second = "stop = \"15 min\"\ninitial = \"out/first/state.json\"";
    let (folder, whole, parts) = whole_and_parts(WAX, second);
    same(&whole, &parts);
    // 1500 s x 50 W - 12 kJ - 40 kJ = 23 kJ over 55 degC
    assert!((parts[1] - (55.0 + 23e3 / 400.0)).abs() < ALLOWED, "{parts:?}");
    // 600 s x 50 W - 12 kJ = 18 kJ of 40 kJ
    let melted = state(&folder, "first")["melted"]["wax"].as_f64().unwrap();
    assert!((melted - 18.0 / 40.0).abs() < 1e-6, "{melted}");
    let melts_elsewhere = folder.read("second.toml").replace("55 degC", "56 degC");
    folder.write("elsewhere.toml", &melts_elsewhere);
    folder
        .run(&["run", "elsewhere.toml"])
        .exits(2)
        .says("network::not_melting")
        .says("state.json:");
}

#[test]
fn the_state_takes_the_place_of_every_start() {
    let folder = Folder::with("first.toml", GEARBOX);
    last(&folder, "first.toml");
    // neither the default nor `--set` of what it depends on has a say any more
    let warm = GEARBOX.replace("T0 = \"T_amb\"", "temperature_unit = \"K\"");
    let warm = with_stop(&warm, "stop = \"1 s\"\ninitial = \"out/first/state.json\"");
    folder.write("warm.toml", &warm);
    let out = folder.run(&[
        "run",
        "warm.toml",
        "--set",
        "T_amb=40degC",
        "--format",
        "csv",
        "--select",
        "steel.T",
    ]);
    let row = csv(&out.exits(0).out).1.remove(0);
    let steel = state(&folder, "first")["temperatures"]["values"]["steel"].clone();
    assert_eq!(row[1].to_string(), steel.to_string());
    let ran = folder.run(&["run", "warm.toml"]).exits(0);
    let ran = ran.prints("\nstarts from out/first/state.json, the state at 25 min\n");
    assert!(ran.out.lines().all(|line| line.chars().count() <= 80), "{}", ran.out);
    // what was read is in the manifest, with its hash
    let manifest: Value = serde_json::from_str(&folder.read("out/warm/manifest.json")).unwrap();
    assert_eq!(manifest["inputs"][1]["name"], "out/first/state.json");
    assert_eq!(manifest["results"][1]["name"], "state.json");
    // other verbs start from it too
    folder.run(&["compare", "warm.toml"]).exits(0);
    folder.run(&["verify", "warm.toml"]).exits(0);
}

#[test]
fn times_that_do_not_follow_are_said() {
    let folder = Folder::with("first.toml", &with_stop(IRON, "stop = \"10 min\""));
    last(&folder, "first.toml");
    let run = |name: &str, settings: &str| {
        folder.write(
            name,
            &with_stop(IRON, &format!("{settings}\ninitial = \"out/first/state.json\"")),
        );
        folder.run(&["run", name, "--no-files"]).exits(0).err
    };
    assert!(run("a.toml", "stop = \"1 min\"").contains("netlist::initial_time"));
    let apart = run("b.toml", "start = \"9 min\"\nstop = \"20 min\"");
    assert!(apart.contains("the run starts at 540 s, from a state at 600 s"), "{apart}");
    assert!(apart.contains("start = \"600 s\""), "{apart}");
    assert!(!run("c.toml", "start = \"10 min\"\nstop = \"20 min\"").contains("warning"));
}

#[test]
fn a_run_that_broke_off_leaves_its_last_whole_state() {
    let broken = GEARBOX.replace("P = \"P_7000\"", "P = \"P_7000 * sqrt(1 - t / 300 [s])\"");
    let folder = Folder::with("broken.toml", &broken);
    folder.run(&["run", "broken.toml"]).exits(3);
    let state = state(&folder, "broken");
    assert_eq!(state["end"], "failed");
    let time = state["time"]["value"].as_f64().unwrap();
    assert!(time > 250.0 && time <= 300.0, "{time}");
    let on = with_stop(GEARBOX, "stop = \"25 min\"\ninitial = \"out/broken/state.json\"");
    folder.write("on.toml", &on);
    folder.run(&["run", "on.toml"]).exits(0).says("netlist::initial_unfinished").says("failed at");
}

#[test]
fn stdin_has_no_folder_to_look_in() {
    let text = with_stop(GEARBOX, "stop = \"25 min\"\ninitial = \"state.json\"");
    Folder::empty().run_with(&["run", "-"], &text).exits(2).says("netlist::state_without_folder");
}

/// The shipped heater: 600 J/K, 3 W/K to 20 degC, 240 W, on below 58 degC and off above 62 degC.
const HEATER: &str = include_str!("../../../networks/thermostat.toml");

/// When the heater goes off for the first time: 42 K of 80 K, with a time constant of 200 s.
fn first_off() -> f64 {
    200.0 * (80.0_f64 / 38.0).ln()
}

/// The heater with this dwell as a whole of 400 s, and in two parts.
fn heater_in_parts(dwell: &str, parting: &str) -> Folder {
    let text = HEATER.replace("start = \"on\"", &format!("start = \"on\"{dwell}"));
    let with = |run: &str| text.replace("stop = \"2000 s\"", run);
    let folder = Folder::with("whole.toml", &with("stop = \"400 s\""));
    folder.write("first.toml", &with(&format!("stop = \"{parting}\"")));
    let initial = "initial = \"out/first/state.json\"";
    folder.write(
        "second.toml",
        &with(&format!("start = \"{parting}\"\nstop = \"400 s\"\n{initial}")),
    );
    for name in ["whole", "first", "second"] {
        folder.run(&["run", &format!("{name}.toml")]).exits(0);
    }
    folder
}

/// Times of the switches of a run, and what the heater is after each.
fn switches(folder: &Folder, name: &str) -> Vec<(f64, u8)> {
    let text = folder.read(&format!("out/{name}/events.csv"));
    let row = |line: &str| {
        let fields: Vec<&str> = line.split(',').collect();
        (fields[0].parse().unwrap(), fields[4].parse().unwrap())
    };
    text.lines().skip(1).map(row).collect()
}

#[test]
fn a_thermostat_in_two_parts_switches_when_the_whole_does() {
    // 42 K to 38 K down, and the same up; a dwell of 30 s is longer than each, so that it alone
    // decides
    let band = 200.0 * (42.0_f64 / 38.0).ln();
    let cases = [
        ("", "160 s", band), // off amid its dead band, though `start` says on
        ("", "170 s", band), // just on
        (", min_dwell = \"30 s\"", "170 s", 30.0), // too cold, and kept off for 9 s more
    ];
    for (dwell, parting, every) in cases {
        let folder = heater_in_parts(dwell, parting);
        let count = ((400.0 - first_off()) / every).floor() as u32 + 1;
        let expected: Vec<(f64, u8)> = (0..count)
            .map(|i| (first_off() + f64::from(i) * every, u8::from(i % 2 == 1)))
            .collect();
        let parts = [switches(&folder, "first"), switches(&folder, "second")].concat();
        for found in [switches(&folder, "whole"), parts] {
            assert_eq!(found.len(), expected.len(), "{parting}: {found:?}, not {expected:?}");
            for (found, expected) in found.iter().zip(&expected) {
                assert!(
                    (found.0 - expected.0).abs() <= 1e-3,
                    "{parting}: {found:?}, not {expected:?}"
                );
                assert_eq!(found.1, expected.1, "{parting}: at {} s", found.0);
            }
        }
    }
}

#[test]
fn the_state_says_how_every_control_stands_and_for_how_long() {
    let folder = heater_in_parts(", min_dwell = \"30 s\"", "170 s");
    let heater = state(&folder, "first")["controls"]["heater"].clone();
    assert_eq!((&heater["on"], &heater["held"]["unit"]), (&Value::from(false), &Value::from("s")));
    let held = heater["held"]["value"].as_f64().unwrap();
    assert!((held - (170.0 - first_off())).abs() < 1e-3, "{held}");
    // one that never switched was held for no known time
    folder.write("early.toml", &HEATER.replace("2000 s", "100 s"));
    folder.run(&["run", "early.toml"]).exits(0);
    assert_eq!(
        state(&folder, "early")["controls"],
        serde_json::json!({ "heater": { "on": true } })
    );
    // the dwell counts from the switch, wherever `t` begins
    let again = folder
        .read("second.toml")
        .replace("start = \"170 s\"\nstop = \"400 s\"", "stop = \"20 s\"");
    folder.write("again.toml", &again);
    folder.run(&["run", "again.toml"]).exits(0);
    let [(on, 1)] = switches(&folder, "again")[..] else {
        panic!("{:?}", switches(&folder, "again"))
    };
    assert!((on - (first_off() + 30.0 - 170.0)).abs() < 1e-3, "{on}");
}

#[test]
fn every_verb_that_runs_keeps_the_controls_of_the_state() {
    let folder = heater_in_parts(", min_dwell = \"30 s\"", "170 s");
    // off all the time, for the dwell lasts to 178.9 s: the body is hottest at the start
    let text = folder.read("second.toml").replace("400 s", "178 s");
    folder.write("short.toml", &text);
    let text = folder.run(&["compare", "short.toml", "--format", "csv"]).exits(0).out;
    let mut rows = text.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let (headers, row) = (rows.next().unwrap(), rows.next().unwrap());
    let peak_at = headers.iter().position(|header| *header == "peak_at [s]").unwrap();
    assert_eq!(row[peak_at].parse(), Ok(170.0), "{text}");
    folder.run(&["verify", "short.toml"]).exits(0);
    folder.run(&["reduce", "short.toml", "--port", "body"]).exits(0).prints("`heater` off");
}

/// A plate of cells between two films, and two imported nodes beside it.
const CELLS: &str = r#"
format = 1

[import]
nodes = "n.csv"
conductors = "c.csv"

[grid.plate]
size = ["20 mm", "0.1 m", "0.1 m"]
cells = [6]
k = "15 W/(m K)"
density = "7900 kg/m^3"
cp = "500 J/(kg K)"
T0 = "25 degC"

[boundary]
air = { T = "25 degC" }

[convection]
cool = { from = "plate.x1", to = "air", h = "40 W/(m^2 K)" }

[resistor]
foot = { from = "a", to = "plate.x0", G = "3 W/K" }

[source]
loss = { into = "b", P = "60 W" }

[run]
stop = "25 min"
select = ["a.T", "b.T", "plate[1].T", "plate[6].T"]
"#;

#[test]
fn cells_of_grids_and_imported_nodes_start_from_a_state_too() {
    let folder = Folder::empty();
    folder.write("n.csv", "name,C [J/K],T0 [degC]\na,400,25\nb,300,25\n");
    folder.write("c.csv", "from,to,G [W/K]\na,b,2\n");
    folder.write("whole.toml", CELLS);
    folder.write("first.toml", &with_stop(CELLS, "stop = \"10 min\""));
    let second = with_stop(CELLS, "stop = \"15 min\"") + "initial = \"out/first/state.json\"\n";
    folder.write("second.toml", &second);
    for name in ["whole", "first", "second"] {
        folder.run(&["run", &format!("{name}.toml")]).exits(0);
    }
    let last = |name: &str| csv(&folder.read(&format!("out/{name}/result.csv"))).1.pop().unwrap();
    let (whole, parts) = (last("whole"), last("second"));
    assert_eq!(whole.len(), 5);
    for (a, b) in whole.iter().zip(&parts).skip(1) {
        assert!((a - b).abs() < ALLOWED, "{whole:?} {parts:?}");
        assert!(*a > 40.0, "{whole:?}");
    }
    // a state of another network is refused, not passed over
    folder.write("n.csv", "name,C [J/K],T0 [degC]\na,400,25\nb,300,25\nd,100,25\n");
    folder.write("c.csv", "from,to,G [W/K]\na,b,2\na,d,1\n");
    folder.run(&["run", "second.toml"]).exits(2).says("the state has no temperature of node `d`");
}
