//! `--format json`: one object on stdout whatever happens, with what was wrong and how to mend it.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common;
use crate::interrupt_helper as interrupt;

use std::path::{Path, PathBuf};

use common::{Folder, GEARBOX, Ran};
use serde_json::Value;

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
        ("run gearbox.toml --formt", 2, "input::no_option"),
        ("run", 2, "input::usage"),
        ("graph gearbox.toml", 2, "input::usage"),
        ("rum gearbox.toml", 2, "input::no_verb"),
        ("gearbox.toml", 2, "input::no_verb"),
        ("modes missing.toml", 2, "input::cannot_read"),
        ("verify missing.toml", 2, "input::cannot_read"),
        ("reduce gearbox.toml --port stel", 2, "reduce::unknown_port"),
        ("size gearbox.toml", 2, "size::no_study"),
        ("fit network gearbox.toml", 2, "fit::no_study"),
        ("fit compare gearbox.toml", 2, "fit::no_study"),
        ("fit step line.csv", 3, "fit::no_curvature"),
        ("fit law line.csv", 2, "fit::law_column"),
        ("check missing.toml", 2, "input::cannot_read"),
        ("materials unobtainium", 2, "materials::unknown"),
        ("explain nonsense", 2, "explain::unknown"),
    ] {
        let ran = folder.json(command);
        let value = refused(&ran, exit);
        assert_eq!(codes(list(&value, "errors"))[0], code, "{command}: {value}");
        assert!(ran.err.contains(code), "people get it too: {}", ran.err);
        let other: Vec<&str> = command.split(' ').chain(["--format", "csv"]).collect();
        assert_eq!(folder.run(&other).out, "", "{command}: only JSON has an object");
    }
    // a candidate that cannot be read is a row among others
    let compared = folder.json("compare gearbox.toml missing.toml").exits(2).json();
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
    let ran = folder.json("run a.toml").exits(3);
    let value = ran.json();
    assert!(list(&value, "rows").len() > 50 && value["end"]["status"] == "failed", "{}", ran.err);
    assert_eq!((&value["ok"], &value["exit"]), (&false.into(), &3.into()));
    let error = &value["errors"][0];
    assert_eq!(
        (&error["code"], &error["message"]),
        (&"solve::input".into(), &value["end"]["message"])
    );
    assert!(error["places"][0]["text"].as_str().unwrap().contains("sqrt"), "{error}");
    let whole = Folder::with_gearbox().json("run gearbox.toml --no-files").exits(0).json();
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
    // on a busy machine Ctrl-C may come before the second row
    let has_rows = (1..=10).any(|more| {
        let ran = interrupt::interrupted_after(50 * more, &folder, &run);
        let value = ran.exits(130).json();
        assert_eq!((&value["ok"], &value["exit"]), (&false.into(), &130.into()));
        assert_eq!(codes(list(&value, "errors")), ["run::interrupted"]);
        assert_eq!(value["end"]["status"], "interrupted");
        list(&value, "rows").len() > 1
    });
    assert!(has_rows);
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
        let checked = folder.json(&format!("check {name}")).json();
        let (errors, warnings) = (list(&checked, "errors"), list(&checked, "warnings"));
        if !errors.is_empty() {
            seen += 1;
            let ran = folder.json(&format!("run {name}"));
            assert_eq!(refused(&ran, 2)["errors"], checked["errors"], "{name}");
            for code in codes(errors) {
                assert!(ran.err.contains(&format!("error[{code}]")), "{name}: {code}");
            }
        }
        for problem in errors.iter().chain(warnings).filter(|problem| !problem["fix"].is_null()) {
            let Some(mended) = mended(&text, name, &problem["fix"]) else { continue };
            folder.write("mended.toml", &mended);
            let again = folder.json("check mended.toml").json();
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
