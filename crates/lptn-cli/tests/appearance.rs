//! What is printed: text for people, JSON for programs.

use crate::common;

use common::{Folder, GEARBOX};
use serde_json::Value;

#[test]
fn the_gearbox_looks_as_it_was_reviewed() {
    let ran = Folder::with_gearbox().run(&["run", "gearbox.toml"]).exits(0);
    // the residual is noise of rounding, which differs from one SUNDIALS to the next
    let masked: Vec<String> = ran.out.lines().map(mask_residual).collect();
    let reviewed: Vec<&str> = include_str!("gearbox.txt").lines().collect();
    assert_eq!(masked, reviewed, "\n{}", ran.out);
}

fn mask_residual(line: &str) -> String {
    match (line.find("closes to "), line.find(" of the heat exchanged")) {
        (Some(from), Some(to)) => {
            format!("{}RESIDUAL{}", &line[..from + "closes to ".len()], &line[to..])
        }
        _ => line.to_owned(),
    }
}

#[test]
fn every_line_fits_into_80_columns() {
    let folder = Folder::with_gearbox();
    folder.run(&["new", "motor"]).exits(0);
    let arguments: [&[&str]; 18] = [
        &["run", "gearbox.toml", "-v"],
        &["run", "motor.toml", "-v"],
        &["run", "gearbox.toml", "--temperature-unit", "degF"],
        &["steady", "gearbox.toml"],
        &["modes", "gearbox.toml"],
        &["verify", "gearbox.toml"],
        &["check", "gearbox.toml"],
        &["reduce", "gearbox.toml", "--port", "steel", "--bias"],
        &["units"],
        &["units", "3 L/min"],
        &["--help"],
        &["run", "--help"],
        &["steady", "--help"],
        &["modes", "--help"],
        &["verify", "--help"],
        &["reduce", "--help"],
        &["check", "--help"],
        &["--version"],
    ];
    for arguments in arguments {
        let ran = folder.run(arguments).exits(0);
        for line in ran.out.lines().chain(ran.err.lines()) {
            assert!(line.chars().count() <= 80, "{arguments:?}: {line}");
            assert_eq!(line.trim_end(), line, "{arguments:?} leaves blanks at the end of a line");
        }
    }
}

#[test]
fn long_names_are_shortened_before_lines_get_too_long() {
    let name = "first_stage_planet_carrier_needle_bearing_outer_ring";
    let text = GEARBOX.replace("steel", name);
    let folder = Folder::with("gearbox.toml", &text);
    let ran = folder.run(&["run", "gearbox.toml"]).exits(0);
    assert!(ran.out.lines().all(|line| line.chars().count() <= 80), "{}", ran.out);
    ran.prints("outer_ring").prints("92.7");
    for verb in ["modes", "verify"] {
        let ran = folder.run(&[verb, "gearbox.toml"]).exits(0);
        assert!(ran.out.lines().all(|line| line.chars().count() <= 80), "{}", ran.out);
        ran.prints("outer_ring");
    }
}

#[test]
fn a_large_network_shows_its_hottest_nodes() {
    let mut text =
        "format = 1\n[boundary]\nair = { T = \"20 degC\" }\n[run]\nstop = \"1 h\"\n[node]\n"
            .to_owned();
    for i in 0..100 {
        text += &format!("n{i} = {{ T0 = \"20 degC\", C = \"10 J/K\" }}\n");
    }
    text += "[resistor]\n";
    for i in 0..100 {
        text += &format!("r{i} = {{ from = \"n{i}\", to = \"air\", R = \"1 K/W\" }}\n");
    }
    text += "[source]\n";
    for i in 0..100 {
        text += &format!("p{i} = {{ into = \"n{i}\", P = \"{} W\" }}\n", i + 1);
    }
    let folder = Folder::with("many.toml", &text);
    let ran = folder.run(&["run", "many.toml"]).exits(0);
    ran.says("").prints("30 of 100 nodes are shown, those that get hottest");
    let ran = folder.run(&["run", "many.toml"]);
    let names: Vec<&str> = ran.out.lines().filter(|l| l.starts_with('n')).collect();
    assert!(names[0].starts_with("n99 ") && names[29].starts_with("n70 "), "{}", ran.out);
    folder.run(&["run", "many.toml", "--select", "n1.T"]).exits(0).prints("\nn1 ");
    folder.run(&["steady", "many.toml"]).exits(0).prints("30 of 101 are shown");
}

#[test]
fn quiet_is_quiet() {
    let folder = Folder::with_gearbox();
    let loud = folder.run(&["run", "gearbox.toml"]).exits(0).says("wrote  out/gearbox/result.csv");
    let quiet = folder.run(&["run", "gearbox.toml", "--quiet"]).exits(0);
    assert_eq!((quiet.err.as_str(), &quiet.out), ("", &loud.out));
    // a script or a log needs no advice
    assert!(!loud.err.contains("next"), "{}", loud.err);
    let verbose = folder.run(&["run", "gearbox.toml", "-v"]).exits(0);
    verbose.says("next   lptn run gearbox.toml --set");
}

#[test]
fn the_next_command_works() {
    let folder = Folder::with_gearbox();
    let ran = folder.run(&["run", "gearbox.toml", "-v"]).exits(0);
    let next = ran.err.lines().find_map(|line| line.strip_prefix("next   lptn ")).unwrap();
    let script = format!("exec \"$0\" {next}");
    let mut command = std::process::Command::new("sh");
    command.args(["-c", &script, env!("CARGO_BIN_EXE_lptn")]).current_dir(folder.path());
    common::Ran::of(command.output().unwrap()).exits(0);
}

#[test]
fn colours_only_where_they_are_wanted() {
    let folder = Folder::with("gearbox.toml", &GEARBOX.replace("\"bed\"", "\"bde\""));
    let plain = folder.run(&["run", "gearbox.toml"]).exits(2);
    assert!(!plain.err.contains('\u{1b}'));
    let always = folder.run(&["run", "gearbox.toml", "--color", "always"]).exits(2);
    assert!(always.err.contains('\u{1b}'));
    let mut command = folder.command(&["run", "gearbox.toml"]);
    let ran = common::Ran::of(command.env("NO_COLOR", "1").output().unwrap());
    assert!(!ran.err.contains('\u{1b}'));
    let result = Folder::with_gearbox().run(&["run", "gearbox.toml"]).exits(0);
    assert!(
        !result.out.contains('\u{1b}')
            && !result.out.chars().any(|c| ('\u{2500}'..='\u{257f}').contains(&c))
    );
}

/// `NO_COLOR` and `--color` on a real terminal, played by `script` of util-linux.
#[test]
fn a_terminal_gets_colours_unless_it_asks_for_none() {
    let folder = Folder::with_gearbox();
    let on_terminal = |rest: &str, no_color: bool| {
        let line = format!("'{}' run gearbox.toml --no-files {rest}", env!("CARGO_BIN_EXE_lptn"));
        let mut command = std::process::Command::new("script");
        command.args(["-qec", &line, "/dev/null"]).current_dir(folder.path()).env("TERM", "xterm");
        command.env_remove("NO_COLOR");
        if no_color {
            command.env("NO_COLOR", "1");
        }
        let output = command.stdin(std::process::Stdio::null()).output().ok()?;
        output.status.success().then(|| String::from_utf8(output.stdout).unwrap())
    };
    let Some(coloured) = on_terminal("", false) else {
        eprintln!(
            "SKIPPED: `script` is missing or opens no terminal; apt-get install bsdutils, mount \
             /dev/pts"
        );
        assert!(std::env::var_os("LPTN_REQUIRE_ORACLES").is_none());
        return;
    };
    assert!(coloured.contains("\u{1b}[1m"), "{coloured}");
    assert!(!on_terminal("", true).unwrap().contains('\u{1b}'));
    assert!(!on_terminal("--color never", false).unwrap().contains('\u{1b}'));
}

#[test]
fn a_title_cannot_steer_the_terminal() {
    let text = GEARBOX.replace("title = \"Planetary", "title = \"\\u001b]0;x\\u0007Planetary");
    let ran = Folder::with("gearbox.toml", &text).run(&["run", "gearbox.toml"]).exits(0);
    assert!(!ran.out.contains('\u{1b}') && !ran.out.contains('\u{7}'));
}

fn keys(value: &Value) -> Vec<&str> {
    value.as_object().expect("as the schema says").keys().map(String::as_str).collect()
}

/// Every scalar below is an object of value and unit.
fn assert_scalars(value: &Value, units: &[&str]) {
    for (name, member) in value.as_object().expect("as the schema says") {
        match member {
            Value::Object(fields) if fields.contains_key("value") => {
                assert_eq!(keys(member), ["value", "unit"], "{name}");
                assert!(
                    member["value"].is_number()
                        && units.contains(&member["unit"].as_str().expect("as the schema says")),
                    "{name}"
                );
            }
            Value::Object(_) => assert_scalars(member, units),
            other => assert!(other.is_boolean(), "{name}: {other}"),
        }
    }
}

#[test]
fn the_json_of_run_has_its_schema() {
    let folder = Folder::with_gearbox();
    let json = folder.run(&["run", "gearbox.toml", "--format", "json"]).exits(0).json();
    let members = [
        "format",
        "network",
        "warnings",
        "columns",
        "rows",
        "events",
        "ledger",
        "lumping",
        "statistics",
    ];
    assert_eq!(keys(&json), members);
    assert_eq!((&json["format"], &json["network"]), (&Value::from(1), &Value::from("gearbox")));
    assert_eq!(
        (&json["warnings"], &json["events"]),
        (&serde_json::json!([]), &serde_json::json!([]))
    );
    assert_eq!(json["columns"][0], serde_json::json!({ "name": "time", "unit": "s" }));
    let names: Vec<&str> =
        json["columns"].as_array().unwrap().iter().map(|c| c["name"].as_str().unwrap()).collect();
    assert_eq!(names[1..6], ["steel.T", "aluminium.T", "bed.T", "air.T", "internal.Q"]);
    assert_eq!(json["rows"].as_array().unwrap().len(), 301);
    assert_eq!(json["rows"][0].as_array().unwrap().len(), names.len());
    assert_scalars(&json["ledger"], &["J", "1"]);
    assert_scalars(&json["statistics"], &["1"]);
    // 220.6 W for 1500 s
    assert!(
        (json["ledger"]["sources"]["P_disp"]["value"].as_f64().unwrap() - 330_900.0).abs() < 1e-3
    );
}

#[test]
fn the_json_of_steady_has_its_schema() {
    let json =
        Folder::with_gearbox().run(&["steady", "gearbox.toml", "--format", "json"]).exits(0).json();
    assert_eq!(keys(&json), ["format", "network", "warnings", "values"]);
    assert_scalars(&json["values"], &["degC", "W"]);
}

#[test]
fn the_json_of_check_has_its_schema() {
    let folder = Folder::with("gearbox.toml", &GEARBOX.replace("to = \"bed\"", "to = \"bde\""));
    let json = folder.run(&["check", "gearbox.toml", "--format", "json"]).exits(1).json();
    assert_eq!(
        keys(&json),
        ["format", "network", "ok", "errors", "warnings", "stiffness", "lumping"]
    );
    assert_eq!(json["ok"], false);
    let error = &json["errors"][0];
    assert_eq!(keys(error), ["severity", "code", "message", "places", "help", "fix", "notes"]);
    let line = 1 + GEARBOX.lines().position(|line| line.contains("to = \"bed\"")).unwrap();
    assert_eq!(
        (&error["code"], &error["places"][0]["line"]),
        (&"netlist::unknown_node".into(), &line.into())
    );
    let json =
        Folder::with_gearbox().run(&["check", "gearbox.toml", "--format", "json"]).exits(0).json();
    assert_eq!(json["ok"], true);
}

/// Every example of every help text, in the order in which a newcomer meets them.
#[test]
fn the_examples_of_the_help_work() {
    let folder = Folder::with("duty_cycle.toml", include_str!("../../../networks/duty_cycle.toml"));
    let program = std::path::Path::new(env!("CARGO_BIN_EXE_lptn"));
    let path = std::env::join_paths([program.parent().expect("a folder")]).unwrap();
    let mut count = 0;
    for arguments in [
        &["--help"][..],
        &["run", "--help"],
        &["steady", "--help"],
        &["reduce", "--help"],
        &["check", "--help"],
        &["units", "--help"],
        &["rank", "--help"],
    ] {
        let help = folder.run(arguments).exits(0).out;
        for example in help.lines().filter(|line| line.starts_with("  lptn ")) {
            let command = example.trim().split("     ").next().unwrap();
            let mut shell = std::process::Command::new("/bin/sh");
            shell.args(["-c", command]).current_dir(folder.path()).env("PATH", &path);
            common::Ran::of(shell.output().unwrap()).exits(0);
            count += 1;
        }
    }
    assert_eq!(count, 26);
}
