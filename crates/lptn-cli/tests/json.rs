//! `--format json`: one object on stdout whatever happens, and temperatures in one unit.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod common;
#[cfg(unix)]
#[path = "common/interrupt.rs"]
mod interrupt;

use std::path::{Path, PathBuf};

use common::{Folder, GEARBOX, Ran};
use serde_json::Value;

/// Runs a command with `--format json`, given as its words between blanks.
fn json(folder: &Folder, command: &str) -> Ran {
    let words: Vec<&str> = command.split(' ').chain(["--format", "json"]).collect();
    folder.run(&words)
}

fn list<'a>(value: &'a Value, key: &str) -> &'a [Value] {
    value[key].as_array().unwrap()
}

fn codes(problems: &[Value]) -> Vec<&str> {
    problems.iter().map(|problem| problem["code"].as_str().unwrap()).collect()
}

/// An object without a result, which tells what stderr tells.
#[track_caller]
fn refused(ran: &Ran, exit: i32) -> Value {
    let value = ran.json();
    assert_eq!(ran.code, Some(exit), "{}", ran.err);
    let keys: Vec<&String> = value.as_object().unwrap().keys().collect();
    assert_eq!(keys, ["format", "ok", "exit", "errors", "warnings"]);
    assert_eq!((&value["format"], &value["ok"]), (&1.into(), &false.into()));
    assert_eq!(value["exit"], exit);
    assert!(!list(&value, "errors").is_empty(), "{value}");
    for (key, severity) in [("errors", "error"), ("warnings", "warning")] {
        assert!(list(&value, key).iter().all(|problem| problem["severity"] == severity));
    }
    value
}

#[test]
fn every_failure_is_one_object() {
    let folder = Folder::with_gearbox();
    folder.write("syntax.toml", "format = 1\n[node\n");
    folder.write("wrong.toml", &GEARBOX.replace("into = \"steel\"", "into = \"stel\""));
    folder.write("line.csv", "t [s],a [degC]\n0,20\n1,21\n2,22\n3,23\n4,24\n5,25\n6,26\n7,27\n");
    for (command, exit, code) in [
        ("run missing.toml", 2, "input::cannot_read"),
        ("run syntax.toml", 2, "netlist::not_closed"),
        ("run wrong.toml", 2, "netlist::unknown_node"),
        ("steady wrong.toml", 2, "netlist::unknown_node"),
        ("run gearbox.toml --set T_amb=5", 2, "units::bare_number"),
        ("run gearbox.toml --plot -", 2, "plot::not_here"),
        ("run gearbox.toml --formt", 2, "input::usage"),
        ("run", 2, "input::usage"),
        ("graph gearbox.toml", 2, "input::usage"),
        ("rum gearbox.toml", 2, "input::no_verb"),
        ("gearbox.toml", 2, "input::no_verb"),
        ("modes missing.toml", 2, "input::cannot_read"),
        ("verify missing.toml", 2, "input::cannot_read"),
        ("reduce gearbox.toml --port stel", 2, "reduce::unknown_port"),
        ("size gearbox.toml", 2, "size::no_study"),
        ("fit network gearbox.toml", 2, "fit::no_study"),
        ("fit step line.csv", 3, "fit::no_curvature"),
        ("fit law line.csv", 2, "fit::law_column"),
        ("check missing.toml", 2, "input::cannot_read"),
        ("materials unobtainium", 2, "materials::unknown"),
        ("explain nonsense", 2, "explain::unknown"),
    ] {
        let ran = json(&folder, command);
        let value = refused(&ran, exit);
        assert_eq!(codes(list(&value, "errors"))[0], code, "{command}: {value}");
        // people get it too, the parser's words without a code
        assert!(ran.err.contains(code) || code == "input::usage" && ran.err.starts_with("error: "));
        let other: Vec<&str> = command.split(' ').chain(["--format", "csv"]).collect();
        assert_eq!(folder.run(&other).out, "", "{command}: only JSON has an object");
    }
    // a candidate that cannot be read is a row among others
    let compared = json(&folder, "compare gearbox.toml missing.toml").exits(2).json();
    assert_eq!(
        (compared["rows"][1][2].as_str(), list(&compared, "errors").len()),
        (Some("input::cannot_read"), 1)
    );
    // what is asked for and not a failure
    folder.run(&["run", "--help", "--format", "json"]).exits(0).prints("Usage: lptn run");
}

/// A load that grows until its exponential has no value.
#[test]
fn a_run_that_breaks_off_has_its_rows_and_why() {
    let folder = Folder::with(
        "a.toml",
        &GEARBOX.replace("P = \"P_7000\"", "P = \"P_7000 * sqrt(1 - t / 5 [min])\""),
    );
    let ran = json(&folder, "run a.toml").exits(3);
    let value = ran.json();
    assert!(list(&value, "rows").len() > 50 && value["end"]["status"] == "failed", "{}", ran.err);
    assert_eq!((&value["ok"], &value["exit"]), (&false.into(), &3.into()));
    let error = &value["errors"][0];
    assert_eq!(
        (&error["code"], &error["message"]),
        (&"solve::input".into(), &value["end"]["message"])
    );
    assert!(error["places"][0]["text"].as_str().unwrap().contains("sqrt"), "{error}");
    let whole = json(&Folder::with_gearbox(), "run gearbox.toml --no-files").exits(0).json();
    assert!(whole.get("ok").is_none() && whole.get("errors").is_none());
}

/// Warnings that were printed before Ctrl-C are in the object, with `--quiet` too.
#[cfg(unix)]
#[test]
fn what_is_interrupted_is_one_object() {
    let text = format!("{}\n[template.idle.node]\na = {{}}\n", common::endless());
    let folder = Folder::with("a.toml", &text);
    for quiet in ["-v", "-q"] {
        let line = ["verify", "a.toml", "--format", "json", quiet];
        let value = refused(&interrupt::interrupted(&folder, &line), 130);
        assert_eq!(codes(list(&value, "errors")), ["run::interrupted"]);
        assert_eq!(codes(list(&value, "warnings")), ["netlist::unused_template"]);
    }
    let run = ["run", "a.toml", "--no-files", "--format", "json"];
    let value = interrupt::interrupted(&folder, &run).exits(130).json();
    assert_eq!((&value["ok"], &value["exit"]), (&false.into(), &130.into()));
    assert_eq!(codes(list(&value, "errors")), ["run::interrupted"]);
    assert!(list(&value, "rows").len() > 1 && value["end"]["status"] == "interrupted");
}

fn project() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// The netlists in a folder of the project.
fn netlists(folder: &str) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(project().join(folder)).unwrap();
    let mut found: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    found.retain(|path| path.extension().is_some_and(|ending| ending == "toml"));
    found.sort();
    found
}

/// The text with a fix at its place; `None` where that is another file.
fn mended(text: &str, file: &str, fix: &Value) -> Option<String> {
    let place = &fix["place"];
    let number = |key: &str| usize::try_from(place[key].as_u64().unwrap()).unwrap();
    if place["file"] != file {
        return None;
    }
    let at = |line: &str, column: &str| {
        let lines = text.split_inclusive('\n').take(number(line) - 1).map(|l| l.chars().count());
        lines.sum::<usize>() + number(column) - 1
    };
    let (begin, end) = (at("line", "column"), at("end_line", "end_column"));
    let letters: Vec<char> = text.chars().collect();
    let replaced: String = letters[begin..end].iter().collect();
    assert_eq!(replaced, place["text"].as_str().unwrap());
    let part = |letters: &[char]| letters.iter().collect::<String>();
    Some(part(&letters[..begin]) + fix["text"].as_str().unwrap() + &part(&letters[end..]))
}

/// Each of the wrong netlists: the same problems as on stderr, and fixes that mend when they are
/// put where they say.
#[test]
fn fixes_mend_what_is_wrong() {
    let bad = project().join("crates/lptn-netlist/tests/bad");
    let folder = Folder::empty();
    for entry in std::fs::read_dir(&bad).unwrap() {
        let path = entry.unwrap().path();
        if path.is_file() {
            std::fs::copy(&path, folder.path().join(path.file_name().unwrap())).unwrap();
        }
    }
    let (mut seen, mut fixes) = (0, 0);
    for path in netlists("crates/lptn-netlist/tests/bad") {
        let name = path.file_name().unwrap().to_str().unwrap();
        let Ok(text) = std::fs::read_to_string(&path) else { continue };
        let checked = json(&folder, &format!("check {name}")).json();
        let (errors, warnings) = (list(&checked, "errors"), list(&checked, "warnings"));
        if !errors.is_empty() {
            seen += 1;
            let ran = json(&folder, &format!("run {name}"));
            assert_eq!(refused(&ran, 2)["errors"], checked["errors"], "{name}");
            for code in codes(errors) {
                assert!(ran.err.contains(&format!("error[{code}]")), "{name}: {code}");
            }
        }
        for problem in errors.iter().chain(warnings).filter(|problem| !problem["fix"].is_null()) {
            let Some(mended) = mended(&text, name, &problem["fix"]) else { continue };
            folder.write("mended.toml", &mended);
            let again = json(&folder, "check mended.toml").json();
            let same =
                |other: &&Value| ["code", "message"].iter().all(|key| other[*key] == problem[*key]);
            let count = |value: &Value| {
                let all = list(value, "errors").iter().chain(list(value, "warnings"));
                all.filter(same).count()
            };
            assert!(count(&again) < count(&checked), "{name}: {problem}\n{mended}");
            let syntax = |value: &Value| codes(list(value, "errors")).contains(&"netlist::syntax");
            assert!(!syntax(&again) || syntax(&checked), "{name}: {problem}\n{mended}");
            fixes += 1;
        }
    }
    assert!(seen > 300 && fixes > 50, "{seen} netlists, {fixes} fixes");
}

/// What is a difference of temperatures by its name.
const DIFFERENCES: [&str; 16] = [
    "margin",
    "sd",
    "effect",
    "swing",
    "residual",
    "error",
    "rms",
    "dT",
    "rise",
    "tolerance",
    "drift",
    "bias",
    "sensor",
    "resolution",
    "amplitudes",
    "extrapolated",
];

/// A number in K beside the same in `unit`, degF or degR.
fn is_same(kelvin: &Value, other: &Value, unit: &str) -> bool {
    let (Some(kelvin), Some(other)) = (kelvin.as_f64(), other.as_f64()) else {
        return kelvin == other;
    };
    let expected = 1.8 * kelvin - if unit == "degF" { 459.67 } else { 0.0 };
    (other - expected).abs() <= 1e-9 * expected.abs().max(1.0)
}

/// Compares an object in K with the same in degF, and gives how many temperatures it has.
fn compared(key: &str, kelvin: &Value, other: &Value) -> usize {
    let same_unit = |k: &Value, o: &Value, key: &str| match (k.as_str(), o.as_str()) {
        (Some("K"), Some(unit @ ("degF" | "degR"))) => {
            assert!(unit == "degR" || !DIFFERENCES.contains(&key), "{key}: {other}");
            Some(unit.to_owned())
        }
        (k, o) => {
            assert!(k == o && k != Some("K"), "{key}: {other}");
            None
        }
    };
    match (kelvin, other) {
        (Value::Object(k), Value::Object(o)) if k.contains_key("rows") => {
            compared_rows((&k["columns"], &o["columns"]), (&k["rows"], &o["rows"]), same_unit)
                + compared_members(k, o)
        }
        (Value::Object(k), Value::Object(o)) if k.contains_key("unit") => {
            let Some(unit) = same_unit(&k["unit"], &o["unit"], key) else {
                return compared_members(k, o);
            };
            assert!(is_same(&k["value"], &o["value"], &unit), "{key}: {kelvin} {other}");
            for error in ["standard_error", "naive_standard_error", "systematic_error"] {
                assert!(is_same(&kelvin[error], &other[error], "degR"), "{key}: {kelvin} {other}");
            }
            let ends = |of: &Value| of["interval_95"].as_array().cloned().unwrap_or_default();
            for (k, o) in ends(kelvin).iter().zip(&ends(other)) {
                assert!(is_same(k, o, &unit), "{key}: {kelvin} {other}");
            }
            1
        }
        (Value::Object(k), Value::Object(o)) => compared_members(k, o),
        (Value::Array(k), Value::Array(o)) => {
            assert_eq!(k.len(), o.len(), "{key}");
            k.iter().zip(o).map(|(k, o)| compared(key, k, o)).sum()
        }
        _ => 0,
    }
}

fn compared_members(
    k: &serde_json::Map<String, Value>,
    o: &serde_json::Map<String, Value>,
) -> usize {
    assert!(k.keys().eq(o.keys()), "{:?} {:?}", k.keys(), o.keys());
    let inside = k.iter().filter(|(key, _)| !["rows", "value"].contains(&key.as_str()));
    inside
        .filter(|(key, k)| *key != "columns" || k.is_object())
        .map(|(key, k)| compared(key, k, &o[key]))
        .sum()
}

fn compared_rows(
    columns: (&Value, &Value),
    rows: (&Value, &Value),
    same_unit: impl Fn(&Value, &Value, &str) -> Option<String>,
) -> usize {
    let list = |of: &Value| of.as_array().unwrap().clone();
    let mut found = 0;
    for (i, (k, o)) in list(columns.0).iter().zip(&list(columns.1)).enumerate() {
        assert_eq!(k["name"], o["name"]);
        let Some(unit) = same_unit(&k["unit"], &o["unit"], k["name"].as_str().unwrap()) else {
            continue;
        };
        for (k, o) in list(rows.0).iter().zip(&list(rows.1)) {
            assert!(is_same(&k[i], &o[i], &unit), "{k} {o}");
            found += 1;
        }
    }
    found
}

/// A gearbox with a limit, a window, a report and uncertain parameters.
fn of_everything() -> Folder {
    let text = GEARBOX
        .replace("\"25.5 degC\"", "\"25.5 ± 1 degC\"")
        .replace("\"220.6 W\"", "\"220.6 W ± 5 %\"");
    let run = "[run]\nreport = { rise = \"steel.T - air.T\" }\nselect = [\"*.T\", \"rise\"]\n\
               window = { late = { from = \"20 min\", to = \"25 min\" } }\n";
    let limits = "[limit]\nhot = { of = \"steel.T\", below = \"90 degC\" }\n\
                  rise = { of = \"steel.T - air.T\", below = \"90 K\" }\n";
    let folder = Folder::with("gearbox.toml", &(text.replace("[run]\n", run) + limits));
    let duty = std::fs::read_to_string(project().join("networks/duty_cycle.toml")).unwrap();
    folder.write(
        "duty.toml",
        &(duty + "\n[limit]\nhot = { of = \"body.T\", below = \"90 degC\" }\n"),
    );
    let ring = |t: f64| 92.7 - 67.2 * (-t / 810.0).exp() + 0.05 * (t / 7.0).sin();
    let rows = (0..300).map(|i| 5.0 * f64::from(i)).map(|t| format!("{t},{:.2}\n", ring(t)));
    folder.write("record.csv", &format!("t [s],ring [degC]\n{}", rows.collect::<String>()));
    folder
}

/// Every temperature and every difference goes with the unit that is asked for.
#[test]
fn temperatures_come_in_one_unit() {
    let folder = of_everything();
    for (command, least) in [
        ("run gearbox.toml --no-files", 900),
        ("run gearbox.toml --no-files --uncertainty linear", 1500),
        ("run gearbox.toml --no-files --uncertainty sobol --samples 64", 1500),
        ("steady gearbox.toml", 8),
        ("steady duty.toml --periodic", 10),
        ("compare gearbox.toml duty.toml", 6),
        ("reduce gearbox.toml --port steel --bias", 6),
        ("fit step record.csv --capacity 2659J/K --sensor 1K", 5),
        ("fit step record.csv --model gearbox.toml --port steel", 10),
    ] {
        let [kelvin, fahrenheit] = ["K", "degF"]
            .map(|unit| json(&folder, &format!("{command} --temperature-unit {unit}")).json());
        let found = compared("", &kelvin, &fahrenheit);
        assert!(found >= least, "{command}: {found} temperatures");
        // without the option in the netlist's, which is degC, and no absolute one in K
        let celsius = json(&folder, command).json();
        assert!(celsius.to_string().contains("\"degC\""), "{command}: {celsius}");
    }
}

/// The last row, the window's largest value, the limit's worst and the steady state's are one
/// number, and CSV has it too.
#[test]
fn the_same_temperature_is_the_same_number_in_every_member() {
    let folder = of_everything();
    for unit in ["degC", "K", "degF", "degR"] {
        let run = format!("run gearbox.toml --temperature-unit {unit}");
        let value = json(&folder, &run).json();
        let last = list(&value, "rows").last().unwrap();
        let (headers, rows) = common::csv(&folder.read("out/gearbox/result.csv"));
        let column =
            headers.iter().position(|header| *header == format!("steel.T [{unit}]")).unwrap();
        let steel = last[column].as_f64().unwrap();
        assert_eq!(value["columns"][column]["unit"], unit);
        assert_eq!(rows.last().unwrap()[column].to_bits(), steel.to_bits());
        let same = |found: &Value| {
            assert_eq!(found["unit"], unit, "{found}");
            assert!((found["value"].as_f64().unwrap() - steel).abs() < 1e-9, "{found} {steel}");
        };
        same(&value["windows"]["late"]["columns"]["steel.T"]["max"]);
        same(&value["limits"]["hot"]["worst"]);
        let limit = &value["limits"]["hot"];
        let number = |of: &Value| of["value"].as_f64().unwrap();
        let margin = number(&limit["below"]) - number(&limit["worst"]);
        assert!((number(&limit["margin"]) - margin).abs() < 1e-9, "{limit}");
        // files of results do not follow: they are in K
        let manifest: Value =
            serde_json::from_str(&folder.read("out/gearbox/manifest.json")).unwrap();
        assert_eq!(
            manifest["limits"]["hot"]["below"],
            serde_json::json!({ "value": 363.15, "unit": "K" })
        );
        let steady =
            json(&folder, &format!("steady gearbox.toml --temperature-unit {unit}")).json();
        let settled = &steady["values"]["steel.T"];
        assert_eq!(
            (settled["unit"].as_str(), settled),
            (Some(unit), &steady["limits"]["hot"]["worst"])
        );
    }
}

/// Looks at every number: its unit is a text, and what has none is `null`.
fn units_are_texts(value: &Value) {
    if let Some(members) = value.as_object() {
        if members.contains_key("unit") && members.contains_key("value") {
            assert!(value["unit"].is_string(), "{value}");
            assert!(value["value"].is_number() || value["value"].is_null(), "{value}");
        }
        members.values().for_each(units_are_texts);
    }
    value.as_array().into_iter().flatten().for_each(units_are_texts);
}

/// The name of the first node of a netlist.
fn first_node(text: &str) -> &str {
    let below = text.lines().skip_while(|line| line.trim() != "[node]").skip(1);
    let mut entries = below.filter(|line| line.contains('='));
    entries.next().and_then(|line| line.split('=').next()).unwrap_or("none").trim()
}

/// Whether it has an answer or not: one object that says the exit code where there is no result.
#[test]
fn every_verb_answers_every_network_with_one_object() {
    let (mut results, mut refusals) = (0, 0);
    let folder = Folder::empty();
    let all = [netlists("networks"), netlists("networks/candidates")].concat();
    assert!(all.len() > 35);
    for path in all {
        let (file, text) = (path.to_str().unwrap(), std::fs::read_to_string(&path).unwrap());
        let reduce = format!("reduce --port {}", first_node(&text));
        for verb in [
            "run --no-files",
            "steady",
            "steady --periodic",
            "check",
            "modes",
            "verify",
            "size",
            "compare",
            "fit network",
            &reduce,
        ] {
            let words: Vec<&str> = verb.split(' ').chain([file, "--format", "json"]).collect();
            let ran = folder.run(&words);
            let value: Value = serde_json::from_str(&ran.out)
                .unwrap_or_else(|error| panic!("{verb} {file}: {error}\n{}{}", ran.out, ran.err));
            assert_eq!(value["format"], 1, "{verb} {file}");
            units_are_texts(&value);
            if value.get("columns").is_none() && value["ok"] == false && verb != "check" {
                refusals += 1;
                refused(&ran, ran.code.unwrap());
            } else {
                results += 1;
                assert!(matches!(ran.code, Some(0 | 1)), "{verb} {file}: {:?}", ran.code);
            }
        }
    }
    assert!(results > 190 && refusals > 90, "{results} results, {refusals} refusals");
}
