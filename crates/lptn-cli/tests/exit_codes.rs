//! Every way a command can end.

use crate::common;

use common::{Folder, GEARBOX, Ran};

const TWO_MASSES: &str = "format = 1\n[node]\nhot = { T0 = \"100 degC\", C = \"15 J/K\" }\n\
                          cold = { T0 = \"0 degC\", C = \"15 J/K\" }\n[resistor]\n\
                          bar = { from = \"hot\", to = \"cold\", R = \"0.1 K/W\" }\n[run]\nstop \
                          = \"10 s\"\n";

fn with(from: &str, to: &str) -> Folder {
    assert!(GEARBOX.contains(from));
    Folder::with("gearbox.toml", &GEARBOX.replace(from, to))
}

#[test]
fn what_works_ends_with_0() {
    let folder = Folder::with_gearbox();
    for verb in ["run", "steady", "check"] {
        folder.run(&[verb, "gearbox.toml"]).exits(0);
    }
    folder
        .run(&["check", "gearbox.toml"])
        .exits(0)
        .prints("ok: gearbox.toml has 2 nodes, 2 boundaries");
    folder.run(&["units"]).exits(0).prints("thermal resistance");
    folder.run(&["units", "3 L/min"]).exits(0).prints("5e-5 m^3/s");
    folder.run(&["--version"]).exits(0).prints("lptn ").prints("SUNDIALS ");
    folder.run(&["--help"]).exits(0).prints("Examples:\n  lptn new");
    folder.run(&["run", "--help"]).exits(0);
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        folder.run(&["setup", "completions", shell]).exits(0).prints("lptn");
    }
}

#[test]
fn check_ends_with_1_where_it_finds_errors_and_says_so_last() {
    let folder = with("to = \"bed\"", "to = \"bde\"");
    let ran = folder.run(&["check", "gearbox.toml"]).exits(1).prints("netlist::unknown_node");
    assert_eq!(ran.out.lines().last(), Some("not ok: gearbox.toml has 1 error, 0 warnings"));
    with("1.7 [K]", "1.7 [W]").run(&["check", "gearbox.toml"]).exits(1).prints("units::dimension");
}

#[test]
fn wrong_netlists_end_with_2_for_other_verbs() {
    let folder = with("to = \"bed\"", "to = \"bde\"");
    folder
        .run(&["run", "gearbox.toml"])
        .exits(2)
        .says("netlist::unknown_node")
        .says("did you mean `bed`?");
    folder.run(&["steady", "gearbox.toml"]).exits(2).says("netlist::unknown_node");
    assert_eq!(folder.files(), ["gearbox.toml"]);
}

#[test]
fn broken_toml_ends_with_2_everywhere() {
    let folder = with("[boundary]", "[boundary");
    for verb in ["run", "steady", "check"] {
        folder.run(&[verb, "gearbox.toml"]).exits(2);
    }
}

#[test]
fn missing_files_end_with_2_and_a_suggestion() {
    let folder = Folder::with_gearbox();
    for verb in ["run", "steady", "check"] {
        folder.run(&[verb, "gearbx.toml"]).exits(2).says("cannot read gearbx.toml: no such file");
    }
    folder.run(&["run", "gearbox"]).exits(2).says("did you mean gearbox.toml?");
    folder.run(&["run", "."]).exits(2).says("input::cannot_read");
}

#[test]
fn usage_ends_with_2() {
    let folder = Folder::with_gearbox();
    let wrong: [&[&str]; 8] = [
        &[],
        &["bake"],
        &["run"],
        &["run", "gearbox.toml", "--fromat", "csv"],
        &["run", "gearbox.toml", "--format", "xml"],
        &["run", "gearbox.toml", "-o", "x", "--no-files"],
        &["run", "gearbox.toml", "--quiet", "-v"],
        &["setup", "completions", "dos"],
    ];
    for arguments in wrong {
        let ran = folder.run(arguments).exits(2);
        assert!(ran.out.is_empty() && !ran.err.is_empty(), "{arguments:?}");
    }
}

#[test]
fn wrong_options_are_shown_with_carets() {
    let folder = Folder::with_gearbox();
    let run =
        |option: &str, value: &str| folder.run(&["run", "gearbox.toml", option, value]).exits(2);
    run("--set", "P_700=300W").says("netlist::unknown_parameter").says("did you mean `P_7000`?");
    run("--set", "P_7000=300K").says("units::dimension").says("^");
    run("--set", "P_7000").says("netlist::bad_assignment");
    run("--set", "bed_share=-1");
    run("--tolerance", "1e-7").says("write \"1e-7 K\"").says("^");
    run("--tolerance", "-1K");
    run("--temperature-unit", "W").says("degC");
    run("--temperature-unit", "grad").says("units::unknown_unit");
    run("--select", "steel").says("select::no_match").says("did you mean `steel.T`?");
    folder.run(&["units", "12 W/m2K"]).exits(2).says("12 W/(m^2 K)").says("^");
    assert_eq!(folder.files(), ["gearbox.toml"]);
}

#[test]
fn a_pattern_of_the_file_that_matches_nothing_is_shown_there() {
    let folder = with("[run]", "[run]\nselect = [\"iron.T\"]");
    folder
        .run(&["run", "gearbox.toml"])
        .exits(2)
        .says("select::no_match")
        .says("select = [\"iron.T\"]");
    folder.run(&["check", "gearbox.toml"]).exits(1).prints("select::no_match");
}

#[test]
fn a_netlist_without_run_says_what_to_add() {
    let folder = with("[run]\nstop = \"25 min\"\noutput = { every = \"5 s\" }", "");
    folder.run(&["run", "gearbox.toml"]).exits(2).says("run::no_run").says("stop = \"25 min\"");
    folder.run(&["steady", "gearbox.toml"]).exits(0);
}

#[test]
fn without_a_boundary_the_energy_at_the_start_leads_to_rest() {
    let folder = Folder::with("two.toml", TWO_MASSES);
    let steady = folder.run(&["steady", "two.toml"]).exits(0).prints("`hot` and `cold`");
    assert!(!steady.out.contains("NaN"), "{}", steady.out);
    let ran =
        folder.run(&["run", "two.toml"]).exits(0).prints("error not bounded by the tolerance");
    let hot = ran.out.lines().find(|line| line.starts_with("hot")).unwrap();
    // both end at the mean, which is where they come to rest
    assert_eq!(
        hot.split_whitespace().collect::<Vec<_>>()[1..6],
        ["100.0", "50.0", "100.0", "0", "s"]
    );
    let heated =
        TWO_MASSES.replace("[run]", "[source]\nheater = { into = \"hot\", P = \"1 W\" }\n\n[run]");
    let folder = Folder::with("heated.toml", &heated);
    folder
        .run(&["steady", "heated.toml"])
        .exits(2)
        .says("steady::no_boundary")
        .says("1 W cannot leave");
}

#[test]
fn a_run_that_breaks_off_ends_with_3_and_keeps_its_rows() {
    // defined up to 300 s
    let folder = with("P = \"P_7000\"", "P = \"P_7000 * sqrt(1 - t / 300 [s])\"");
    let ran = folder.run(&["run", "gearbox.toml"]).exits(3);
    assert!(!ran.out.contains("heat over"));
    ran.says("stopped at").says("P_disp").says("the rows up to then are whole");
    let manifest: serde_json::Value =
        serde_json::from_str(&folder.read("out/gearbox/manifest.json")).unwrap();
    assert_eq!(manifest["end"]["status"], "failed");
    assert_eq!(manifest["ledger"]["closes"], true);
    assert!(manifest["end"]["message"].as_str().unwrap().contains("P_disp"));
    let reached = manifest["end"]["time"]["value"].as_f64().unwrap();
    assert!(reached > 250.0 && reached <= 300.0, "{reached}");
    let (_, rows) = common::csv(&folder.read("out/gearbox/result.csv"));
    assert!(rows.len() > 50 && rows.last().unwrap()[0] <= reached);
    let json = folder.run(&["run", "gearbox.toml", "--format", "json"]).exits(3).json();
    assert_eq!(json["end"]["status"], "failed");
}

#[test]
fn new_never_writes_over_a_file() {
    let folder = Folder::empty();
    folder.run(&["new", "motor"]).exits(0);
    folder.write("motor.toml", "mine");
    folder.run(&["new", "motor"]).exits(2).says("new::exists");
    folder.run(&["new", "motor.toml"]).exits(2);
    assert_eq!(folder.read("motor.toml"), "mine");
    folder.run(&["new", "a\"b"]).exits(2).says("new::bad_name");
    folder.run(&["new", "no/such/folder/x"]).exits(2).says("output::cannot_create");
    folder.run(&["new", "my motor", "-v"]).exits(0).says("lptn check 'my motor.toml'");
    folder.run(&["check", "my motor.toml"]).exits(0);
}

#[cfg(unix)]
mod unix {
    use std::io::{BufRead as _, BufReader, Read as _};
    use std::process::Stdio;

    use super::{Folder, GEARBOX, Ran};

    #[test]
    fn a_reader_that_goes_away_is_no_error() {
        let folder = Folder::with("gearbox.toml", &GEARBOX.replace("\"5 s\"", "\"0.01 s\""));
        let mut command = folder.command(&["run", "gearbox.toml", "--no-files", "--format", "csv"]);
        let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        let mut first = String::new();
        BufReader::new(child.stdout.take().unwrap()).read_line(&mut first).unwrap();
        assert!(first.starts_with("time [s]"));
        let mut messages = String::new();
        child.stderr.take().unwrap().read_to_string(&mut messages).unwrap();
        assert_eq!((child.wait().unwrap().code(), messages.as_str()), (Some(0), ""));
    }

    #[test]
    fn a_full_stdout_ends_with_3() {
        let folder = Folder::with_gearbox();
        let Ok(full) = std::fs::File::options().write(true).open("/dev/full") else { return };
        let mut command = folder.command(&["run", "gearbox.toml", "--no-files"]);
        let output = command.stdout(full).stderr(Stdio::piped()).output().unwrap();
        Ran::of(output).exits(3).says("output::stdout");
    }
}
