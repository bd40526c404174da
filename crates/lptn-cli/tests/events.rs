//! Controls and comparisons from the netlist to the command line. Switching times have closed
//! forms: between two switches one node of capacity C joined to places at given temperatures is an
//! exponential.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common;

use common::{Folder, csv};

/// The shipped heater: 600 J/K, 3 W/K to 20 degC, 240 W.
const THERMOSTAT: &str = include_str!("../../../networks/thermostat.toml");

/// One row of `events.csv`.
#[derive(Clone, Debug, PartialEq)]
struct Row {
    time: f64,
    kind: String,
    name: String,
    before: u8,
    after: u8,
}

fn events(text: &str) -> Vec<Row> {
    let mut lines = text.lines();
    assert_eq!(lines.next(), Some("time [s],kind,name,before,after"));
    let row = |line: &str| {
        let fields: Vec<&str> = line.split(',').collect();
        let [time, kind, name, before, after] = fields[..] else { panic!("{line}") };
        Row {
            time: time.parse().unwrap(),
            kind: kind.into(),
            name: name.into(),
            before: before.parse().unwrap(),
            after: after.parse().unwrap(),
        }
    };
    lines.map(row).collect()
}

/// Times, names and states of the controls that a run of `netlist` switches.
fn switches(netlist: &str, arguments: &[&str]) -> Vec<(f64, String, u8)> {
    let folder = Folder::with("net.toml", netlist);
    folder.run(&[&["run", "net.toml"], arguments].concat()).exits(0);
    let rows = events(&folder.read("out/net/events.csv"));
    assert!(rows.iter().all(|row| row.before + row.after == 1));
    let controls = rows.into_iter().filter(|row| row.kind == "control");
    controls.map(|row| (row.time, row.name, row.after)).collect()
}

#[track_caller]
fn assert_switches(found: &[(f64, String, u8)], expected: &[(f64, &str, u8)], tolerance: f64) {
    let told = format!("{found:?}, not {expected:?}");
    assert_eq!(found.len(), expected.len(), "{told}");
    for (found, expected) in found.iter().zip(expected) {
        assert!(
            (found.0 - expected.0).abs() <= tolerance,
            "{} differs from {}: {told}",
            found.0,
            expected.0
        );
        assert_eq!((found.1.as_str(), found.2), (expected.1, expected.2), "{told}");
    }
}

/// A control of the exact solution: on and off in degC by the states of all, cooling or heating.
struct Exact<'a> {
    name: &'static str,
    cooling: bool,
    thresholds: &'a dyn Fn(&[bool]) -> (f64, f64),
}

impl Exact<'_> {
    /// The temperature at which it leaves the state it has, and whether that lies above.
    fn leaves(&self, own: bool, states: &[bool]) -> (f64, bool) {
        let (on, off) = (self.thresholds)(states);
        if own { (off, !self.cooling) } else { (on, self.cooling) }
    }
}

/// The switches up to `stop` of one node whose steady temperature in degC and time constant in s
/// follow from the states.
fn exact(
    controls: &[Exact<'_>],
    (mut states, mut at): (Vec<bool>, f64),
    network: &dyn Fn(&[bool]) -> (f64, f64),
    stop: f64,
) -> Vec<(f64, &'static str, u8)> {
    let (mut now, mut events) = (0.0, Vec::new());
    loop {
        let (end, tau) = network(&states);
        let due = controls.iter().enumerate().filter_map(|(i, control)| {
            let (level, above) = control.leaves(states[i], &states);
            let beyond = if above { at >= level } else { at <= level };
            if beyond {
                return Some((0.0, i));
            }
            let reaches = if above { end > level } else { end < level };
            reaches.then(|| (tau * ((end - at) / (end - level)).ln(), i))
        });
        let Some((after, i)) = due.min_by(|a, b| a.0.total_cmp(&b.0)) else { return events };
        now += after;
        if now > stop {
            return events;
        }
        at = end + (at - end) * (-after / tau).exp();
        if after > 0.0 {
            at = controls[i].leaves(states[i], &states).0; // to the last digit
        }
        states[i] = !states[i];
        events.push((now, controls[i].name, u8::from(states[i])));
    }
}

fn heater(stop: f64) -> Vec<(f64, &'static str, u8)> {
    let thresholds = |_: &[bool]| (58.0, 62.0);
    let control = Exact { name: "heater", cooling: false, thresholds: &thresholds };
    let network = |on: &[bool]| (if on[0] { 100.0 } else { 20.0 }, 200.0);
    exact(&[control], (vec![true], 20.0), &network, stop)
}

#[test]
fn switching_times_are_those_of_the_closed_form_at_every_tolerance() {
    let expected = heater(2000.0);
    assert_eq!(expected.len(), 93);
    for (tolerance, seconds) in
        [("1e-3 K", 1.0), ("1e-4 K", 0.1), ("1e-5 K", 1e-2), ("1e-6 K", 1e-3), ("1e-7 K", 1e-4)]
    {
        // an error of one switch moves all that follow: 93 of them, each a few tolerances at 0.2
        // K/s
        assert_switches(&switches(THERMOSTAT, &["--tolerance", tolerance]), &expected, seconds);
    }
}

#[test]
fn the_rows_that_are_asked_for_change_no_event() {
    let every = |text: &str| switches(&THERMOSTAT.replace("every = \"5 s\"", text), &[]);
    let usual = every("every = \"5 s\"");
    assert_eq!(usual, every("every = \"100 s\""));
    assert_eq!(usual, every("every = \"0.7 s\""));
}

#[test]
fn json_and_csv_and_the_manifest_tell_of_the_same_events() {
    let folder = Folder::with("net.toml", THERMOSTAT);
    let json = folder.run(&["run", "net.toml", "--format", "json"]).exits(0).json();
    let rows = events(&folder.read("out/net/events.csv"));
    let list = json["events"].as_array().unwrap();
    assert_eq!((list.len(), rows.len()), (93, 93));
    for (event, row) in list.iter().zip(&rows) {
        assert!((event["time"]["value"].as_f64().unwrap() - row.time).abs() < 1e-9);
        assert_eq!(event["time"]["unit"], "s");
        assert_eq!(
            (event["kind"].as_str(), event["name"].as_str()),
            (Some("control"), Some("heater"))
        );
        assert_eq!(event["before"], serde_json::json!({ "value": row.before, "unit": "1" }));
        assert_eq!(event["after"], serde_json::json!({ "value": row.after, "unit": "1" }));
    }
    let manifest: serde_json::Value =
        serde_json::from_str(&folder.read("out/net/manifest.json")).unwrap();
    assert_eq!(manifest["statistics"]["events"], serde_json::json!({ "value": 93, "unit": "1" }));
    assert_eq!(json["statistics"]["events"]["value"], 93);
    let hashed = manifest["results"].as_array().unwrap().iter();
    assert_eq!(hashed.filter(|file| file["name"] == "events.csv").count(), 1);
}

#[test]
fn a_network_that_never_switches_has_a_heading_only() {
    let folder = Folder::with_gearbox();
    let ran = folder.run(&["run", "gearbox.toml"]).exits(0);
    assert!(!ran.out.contains("events:"), "{}", ran.out);
    assert_eq!(folder.read("out/gearbox/events.csv"), "time [s],kind,name,before,after\n");
}

#[test]
fn a_limit_that_breaks_is_an_event() {
    let text = format!("{THERMOSTAT}\n[limit]\nhot = {{ of = \"body.T\", below = \"61 degC\" }}\n");
    let folder = Folder::with("net.toml", &text);
    folder.run(&["run", "net.toml"]).exits(1);
    let rows = events(&folder.read("out/net/events.csv"));
    // 41 K of 80 K
    let broken = 200.0 * (80.0_f64 / 39.0).ln();
    assert!((rows[0].time - broken).abs() < 1e-3, "{:?}", rows[0]);
    assert_eq!((rows[0].kind.as_str(), rows[0].name.as_str(), rows[0].after), ("limit", "hot", 1));
    assert_eq!(rows.len(), 94);
}

#[test]
fn the_table_counts_starts_and_says_how_long_it_is_on() {
    let folder = Folder::with("net.toml", THERMOSTAT);
    let ran = folder.run(&["run", "net.toml"]).exits(0);
    let expected = heater(2000.0);
    let (mut on, mut since) = (0.0, 0.0);
    for (time, _, after) in &expected {
        on += if *after == 0 { time - since } else { 0.0 };
        since = *time;
    }
    let starts: Vec<f64> = expected.iter().filter(|e| e.2 == 1).map(|e| e.0).collect();
    let period = (starts[starts.len() - 1] - starts[0]) / (starts.len() - 1) as f64;
    let line = ran.out.lines().find(|line| line.starts_with("heater ")).unwrap();
    let words: Vec<&str> = line.split_whitespace().collect();
    let duty = format!("{:.1}", 100.0 * on / 2000.0);
    assert_eq!(words, ["heater", "46", "47", &format!("{period:.2}"), "s", &duty, "%", "off"]);
    assert!(
        ran.out.contains("events: heater off at 2.481 min, heater on at 2.815 min,"),
        "{}",
        ran.out
    );
    assert!(ran.out.contains("and 87 more"), "{}", ran.out);
    assert!(ran.out.lines().all(|line| line.chars().count() <= 80), "{}", ran.out);
}

#[test]
fn a_control_is_a_column_of_zero_and_one() {
    let folder = Folder::with("net.toml", THERMOSTAT);
    let ran = folder
        .run(&["run", "net.toml", "--format", "csv", "--select", "heater", "--select", "body.T"]);
    let (headers, rows) = csv(&ran.exits(0).out);
    assert_eq!(headers, ["time [s]", "body.T [degC]", "heater [-]"]);
    let expected = heater(2000.0);
    for row in rows {
        let last = expected.iter().rev().find(|event| event.0 <= row[0]);
        let expected = last.map_or(1.0, |event| f64::from(event.2));
        assert!((row[2] - expected).abs() < 0.5, "at {} s", row[0]);
    }
}

/// A body at 20 degC with what `extra` adds; `P` is the heat in W.
fn body(extra: &str) -> String {
    format!(
        "format = 1\ntitle = \"test\"\n[node]\nbody = {{ T0 = \"T_0\", C = \"600 J/K\" \
         }}\n[boundary]\n\
         amb = {{ T = \"20 degC\" }}\n[run]\nstop = \"1000 s\"\n{extra}"
    )
}

#[test]
fn two_controls_that_hang_on_each_other() {
    let text = body(
        "[param]\nT_0 = \"20 degC\"\n[resistor]\nskin = { from = \"body\", to = \"amb\", G = \"3 \
         W/K\" }\n\
         [control]\nbase = { sense = \"body\", on_below = \"50 degC\", off_above = \"62 [degC] - 3 \
         [K] * boost\" }\n\
         boost = { sense = \"body\", on_below = \"45 [degC] + 6 [K] * base\", off_above = \"58.6 \
         degC\", start = \"on\" }\n\
         [source]\nheat = { into = \"body\", P = \"240 [W] * base + 90 [W] * boost\" }\n",
    );
    let of_base = |on: &[bool]| (50.0, if on[1] { 59.0 } else { 62.0 });
    let of_boost = |on: &[bool]| (if on[0] { 51.0 } else { 45.0 }, 58.6);
    let controls = [
        Exact { name: "base", cooling: false, thresholds: &of_base },
        Exact { name: "boost", cooling: false, thresholds: &of_boost },
    ];
    let heat = |on: &[bool]| if on[0] { 80.0 } else { 0.0 } + if on[1] { 30.0 } else { 0.0 };
    let network = |on: &[bool]| (20.0 + heat(on), 200.0);
    let expected = exact(&controls, (vec![false, true], 20.0), &network, 1000.0);
    assert!(expected.len() > 4 && expected.iter().any(|event| event.1 == "boost"), "{expected:?}");
    assert_switches(&switches(&text, &["--tolerance", "1e-7 K"]), &expected, 1e-4);
}

#[test]
fn the_sensor_is_a_boundary_with_a_signal() {
    let text = body(
        "[param]\nT_0 = \"20 degC\"\n[signal]\nweather = { t = [\"0 s\", \"500 s\", \"1000 s\"], \
         v = [\"0 degC\", \"20 degC\", \"0 degC\"] }\n[boundary.outside]\nT \
         = \"weather\"\n[resistor]\n\
         skin = { from = \"body\", to = \"outside\", G = \"3 W/K + 1 [W/K] * 0\" }\n\
         [control]\nheating = { sense = \"outside\", on_below = \"5 degC\", off_above = \"15 \
         degC\" }\n\
         [source]\nheat = { into = \"body\", P = \"200 [W] * heating\" }\n",
    )
    .replace("3 W/K + 1 [W/K] * 0", "3 W/K");
    // it begins at 0 degC, beyond its threshold
    let expected = [(0.0, "heating", 1), (375.0, "heating", 0), (875.0, "heating", 1)];
    assert_switches(&switches(&text, &[]), &expected, 1e-6);
}

#[test]
fn a_control_switches_a_stream() {
    let text = body(
        "[param]\nT_0 = \"20 degC\"\n[boundary.inlet]\nT = \"30 degC\"\n[boundary.outlet]\nT \
         = \"30 degC\"\n\
         [resistor]\nskin = { from = \"body\", to = \"amb\", G = \"3 W/K\" }\n\
         [advection]\nfeed = { from = \"inlet\", to = \"body\", mcp = \"9 [W/K] * pump\" }\n\
         drain = { from = \"body\", to = \"outlet\", mcp = \"9 [W/K] * pump\" }\n\
         [control]\npump = { sense = \"body\", on_above = \"70 degC\", off_below = \"60 degC\" }\n\
         [source]\nheat = { into = \"body\", P = \"240 W\" }\n",
    );
    let thresholds = |_: &[bool]| (70.0, 60.0);
    let control = Exact { name: "pump", cooling: true, thresholds: &thresholds };
    // 240 W = 3 (T - 20) + 9 (T - 30)
    let network =
        |on: &[bool]| if on[0] { ((240.0 + 60.0 + 270.0) / 12.0, 50.0) } else { (100.0, 200.0) };
    let expected = exact(&[control], (vec![false], 20.0), &network, 1000.0);
    assert!(expected.len() > 8);
    assert_switches(&switches(&text, &["--tolerance", "1e-7 K"]), &expected, 1e-4);
}

#[test]
fn a_control_switches_a_boundary() {
    let text = body(
        "[param]\nT_0 = \"60 degC\"\n[boundary.bath]\nT = \"80 [degC] - 70 [K] * chiller\"\n\
         [resistor]\nskin = { from = \"body\", to = \"bath\", G = \"3 W/K\" }\n\
         [control]\nchiller = { sense = \"body\", on_above = \"65 degC\", off_below = \"50 degC\" \
         }\n",
    );
    let thresholds = |_: &[bool]| (65.0, 50.0);
    let control = Exact { name: "chiller", cooling: true, thresholds: &thresholds };
    let network = |on: &[bool]| (if on[0] { 10.0 } else { 80.0 }, 200.0);
    let expected = exact(&[control], (vec![false], 60.0), &network, 1000.0);
    assert!(expected.len() > 8);
    assert_switches(&switches(&text, &["--tolerance", "1e-7 K"]), &expected, 1e-4);
}

/// The heater with thresholds and start that parameters give.
fn adjustable() -> String {
    let text =
        THERMOSTAT.replace("\"58 degC\"", "\"T_on\"").replace("\"62 degC\"", "\"T_on + band\"");
    text.replace("[node]", "[param]\nT_on = \"58 degC\"\nband = \"4 K\"\nT_0 = \"20 degC\"\n[node]")
        .replace("T0 = \"20 degC\"", "T0 = \"T_0\"")
}

#[test]
fn thresholds_can_be_set() {
    let found = switches(
        &adjustable(),
        &["--set", "T_on=38degC", "--set", "band=2K", "--tolerance", "1e-7 K"],
    );
    let thresholds = |_: &[bool]| (38.0, 40.0);
    let control = Exact { name: "heater", cooling: false, thresholds: &thresholds };
    let network = |on: &[bool]| (if on[0] { 100.0 } else { 20.0 }, 200.0);
    assert_switches(&found, &exact(&[control], (vec![true], 20.0), &network, 2000.0), 1e-4);
    let folder = Folder::with("net.toml", &adjustable());
    let ran = folder
        .run(&["run", "net.toml", "--set", "band=-1K"])
        .exits(2)
        .says("network::thresholds_crossed");
    ran.says(
        "`on_below` and `off_above` of control `heater` are crossed over: on at 58 degC, off at 57 \
         degC",
    );
}

#[test]
fn a_start_beyond_the_thresholds_switches_at_once() {
    let found = switches(&adjustable(), &["--set", "T_0=80degC", "--tolerance", "1e-7 K"]);
    let cools = 200.0 * (60.0_f64 / 38.0).ln();
    assert_switches(&found[..2], &[(0.0, "heater", 0), (cools, "heater", 1)], 1e-4);
}

#[test]
fn a_dwell_that_swallows_a_crossing_is_caught_up() {
    let text = THERMOSTAT.replace("start = \"on\"", "start = \"on\", min_dwell = \"0.5 min\"");
    let found = switches(&text, &["--tolerance", "1e-7 K"]);
    let first = 200.0 * (80.0_f64 / 38.0).ln();
    let expected = [(first, "heater", 0), (first + 30.0, "heater", 1), (first + 60.0, "heater", 0)];
    assert_switches(&found[..3], &expected, 1e-4);
}

#[test]
fn the_mean_of_a_control_over_a_window_is_its_duty() {
    let window = "window = { last = { from = \"1000 s\", to = \"2000 s\" } }\n";
    let folder = Folder::with("net.toml", &format!("{THERMOSTAT}{window}"));
    let json = folder.run(&["run", "net.toml", "--no-files", "--format", "json"]).exits(0).json();
    let expected = heater(2000.0);
    let state =
        |time: f64| expected.iter().rev().find(|e| e.0 <= time).map_or(1.0, |e| f64::from(e.2));
    let inside =
        expected.iter().map(|event| event.0).filter(|time| (1000.0..2000.0).contains(time));
    let times: Vec<f64> = [1000.0].into_iter().chain(inside).chain([2000.0]).collect();
    let on: f64 = times.windows(2).map(|pair| (pair[1] - pair[0]) * state(pair[0])).sum();
    let mean = json["windows"]["last"]["columns"]["heater"]["mean"]["value"].as_f64().unwrap();
    assert!((mean - on / 1000.0).abs() < 1e-6, "{mean} is not {}", on / 1000.0);
}

#[test]
fn a_comparison_of_a_control_is_the_control() {
    let compared = THERMOSTAT.replace("240 [W] * heater", "if(heater > 0.5, 240 [W], 0 [W])");
    assert_eq!(switches(&compared, &[]), switches(THERMOSTAT, &[]));
}

#[test]
fn a_control_inside_a_template_is_one_of_each_instance() {
    let text = "format = 1\n[template.room]\nport = [\"out\"]\n[template.room.param]\nT_on = \"58 \
        degC\"\n\
                [template.room.node]\nbody = { T0 = \"20 degC\", C = \"600 J/K\" }\n\
                [template.room.resistor]\nskin = { from = \"body\", to = \"out\", G = \"3 W/K\" }\n\
                [template.room.control]\nheater = { sense = \"body\", on_below = \"T_on\", \
                off_above = \"T_on + 4 [K]\", start = \"on\" }\n\
                [template.room.source]\nelement = { into = \"body\", P = \"240 [W] * heater\" }\n\
                [boundary]\namb = { T = \"20 degC\" }\n\
                [use.room]\ntemplate = \"room\"\ncount = 2\nconnect = { out = \"amb\" }\n\
                set = { T_on = [\"58 degC\", \"38 degC\"] }\n[run]\nstop = \"300 s\"\ntolerance \
                = \"1e-7 K\"\n\
                [limit]\nidle = { of = \"room[2].heater\", below = 2 }\n";
    let found = switches(text, &[]);
    for (name, low) in [("room[1].heater", 58.0), ("room[2].heater", 38.0)] {
        let thresholds = |_: &[bool]| (low, low + 4.0);
        let control = Exact { name, cooling: false, thresholds: &thresholds };
        let network = |on: &[bool]| (if on[0] { 100.0 } else { 20.0 }, 200.0);
        let expected = exact(&[control], (vec![true], 20.0), &network, 300.0);
        let own: Vec<_> = found.iter().filter(|event| event.1 == name).cloned().collect();
        assert!(expected.len() > 4);
        assert_switches(&own, &expected, 1e-4);
    }
}

#[test]
fn an_expanded_netlist_switches_at_the_same_times() {
    let text = adjustable().replace("start = \"on\"", "start = \"on\", min_dwell = \"5 s\"");
    let folder = Folder::with("net.toml", &text);
    let flat = folder.run(&["check", "net.toml", "--expand", "--set", "band=2K"]).exits(0).out;
    assert!(flat.contains("[control]\nheater = { sense = \"body\", on_below = \"T_on\""), "{flat}");
    assert_eq!(switches(&flat, &[]), switches(&text, &["--set", "band=2K"]));
}
