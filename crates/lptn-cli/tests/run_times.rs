//! Kind: command line. `--stop` and `--every`: other times for a run, held to what the file is; the
//! width of help, and manual pages.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common;

use common::{Folder, csv};

/// One lump of 1000 J/K that 100 W heat and 10 W/K cool, with a window over its first minute.
const LUMP: &str = "format = 1
[node]
lump = { C = '1000 J/K', T0 = '25 degC' }
[boundary]
air = { T = '25 degC' }
[resistor]
skin = { from = 'lump', to = 'air', G = '10 W/K' }
[source]
heat = { into = 'lump', P = '100 W' }
[run]
stop = '300 s'
output = { at = ['0 s', '10 s'] }
window = { first = { from = '0 s', to = '1 min' } }
";

#[test]
fn rows_come_at_the_times_that_were_asked_for() {
    let folder = Folder::with("lump.toml", LUMP);
    let ran = folder.run(&[
        "run",
        "lump.toml",
        "--no-files",
        "--format",
        "csv",
        "--select",
        "lump.T",
        "--stop",
        "10 min",
        "--every",
        "5min",
    ]);
    let (_, rows) = csv(&ran.exits(0).out);
    assert_eq!(rows.len(), 3);
    for (row, time) in rows.iter().zip([0.0, 300.0, 600.0_f64]) {
        let expected = 25.0 + 10.0 * (1.0 - (-time / 100.0).exp());
        assert!((row[0] - time).abs() < 1e-9 && (row[1] - expected).abs() < 1e-4, "{row:?}");
    }
}

#[test]
fn times_that_do_not_fit_are_refused_by_their_option() {
    let folder = Folder::with("lump.toml", LUMP);
    let cases = [
        (["--stop", "0 s"], "netlist::run_stop", " --> --stop:1:1"),
        (["--stop", "30 s"], "netlist::", "lump.toml:13"),
        (["--stop", "2 K"], "units::dimension", " --> --stop:1:1"),
        (["--every", "1 us"], "netlist::too_many_rows", " --> --every:1:1"),
    ];
    for (option, code, place) in cases {
        let arguments = [&["run", "lump.toml", "--no-files"], &option[..]].concat();
        folder.run(&arguments).exits(2).says(code).says(place);
    }
}

/// Times of the command line replace those of the file before anything is checked: 600 d in rows of
/// 5 s are 10 368 000 rows, and in rows of 1 h they are 14 400 and the first.
#[test]
fn what_an_option_replaces_is_not_checked() {
    let text = LUMP.split("[run]").next().unwrap().replacen("\n", "\n[param]\nend = '300 s'\n", 1);
    let folder = Folder::with(
        "lump.toml",
        &format!("{text}[run]\nstop = 'end'\noutput = {{ every = '5 s' }}\n"),
    );
    let given = ["run", "lump.toml", "--no-files", "--format", "csv", "--select", "lump.T"];
    for long in [["--stop", "600 d"], ["--set", "end=600 d"]] {
        let refused = folder.run(&[&given[..], &long[..]].concat()).exits(2);
        refused.says("netlist::too_many_rows").says("10368000 rows");
        let ran = folder.run(&[&given[..], &long[..], &["--every", "1 h"]].concat()).exits(0);
        assert_eq!(csv(&ran.out).1.len(), 14_401);
    }
}

/// An option of other commands is named with them; one that is nearly right is corrected. Every
/// error of usage has its code.
#[test]
fn an_option_that_a_command_does_not_have_is_explained() {
    let folder = Folder::with("lump.toml", LUMP);
    let cases: [(&[&str], &str, &str); 9] = [
        (
            &["steady", "lump.toml", "--uncertainty"],
            "input::no_option",
            "belongs to `lptn run`, `lptn compare`",
        ),
        (&["steady", "lump.toml", "--stop", "5min"], "input::no_option", "belongs to `lptn run`"),
        (&["rank", "lump.toml", "--every", "5s"], "input::no_option", "belongs to `lptn run`"),
        (
            &["run", "lump.toml", "--toleranc", "1K"],
            "input::no_option",
            "did you mean `--tolerance`?",
        ),
        (&["run", "lump.toml", "--qiet"], "input::no_option", "did you mean `--quiet`?"),
        (&["wat"], "input::no_verb", "`lptn --help` lists the commands"),
        (&["size", "--power", "223W"], "input::usage", "--limit <T>"),
        (&["run"], "input::usage", "`lptn run --help` lists its options"),
        (
            &["run", "lump.toml", "--format", "xml"],
            "input::usage",
            "possible values: table, csv, json",
        ),
    ];
    for (words, code, help) in cases {
        let ran = folder.run(words).exits(2).says(&format!("error[{code}]"));
        let err = ran.err.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(err.contains(help), "{words:?}: {err}");
    }
}

/// A word too many is explained by its likely meaning, with the words to write instead.
#[test]
fn a_word_without_a_place_is_explained() {
    let folder = Folder::with("lump.toml", LUMP);
    let cases: [(&[&str], &str); 12] = [
        (&["run", "lump.toml", "--stop", "2", "h"], "write --stop \"2 h\""),
        (&["units", "3", "m", "2"], "write lptn units \"3 m 2\""),
        (&["steady", "lump.toml", "R=3K/W"], "write --set 'R=3K/W'"),
        (&["run", "lump.toml", "--set", "R", "3K/W"], "write --set 'R=3K/W'"),
        (&["reduce", "lump.toml", "lump"], "a port is named by --port lump"),
        (&["steady", "lump.toml", "now"], "`lptn steady --help` lists its options"),
        (&["run", "lump.toml", "-set", "R=3K/W"], "did you mean `--set`?"),
        (&["run", "lump.toml", "-quiet"], "did you mean `--quiet`?"),
        (&["size", "lump.toml", "--limit", "90degC"], "`--limit` cannot be used with a netlist"),
        (
            &["run", "lump.toml", "--no-files", "-o", "x"],
            "`--no-files` cannot be used with `--output`",
        ),
        (&["reduce", "lump.toml", "--port", "lump", "--max-error", "5"], "--max-error 5%"),
        (&["run", "lump.toml", "--stop", "7200"], "`--stop` must be a time (s)"),
    ];
    for (words, help) in cases {
        let ran = folder.run(words).exits(2);
        let err = ran.err.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(err.contains(help), "{words:?}: {err}");
    }
}

/// The former words do what they did, and name the new ones.
#[test]
fn former_words_of_set_up_work() {
    let folder = Folder::empty();
    let now = folder.run(&["setup", "completions", "bash"]).exits(0);
    let before = folder.run(&["completions", "bash"]).exits(0).says("`lptn setup completions` now");
    assert_eq!(before.out, now.out);
    folder.run(&["man", "pages"]).exits(0).says("`lptn setup man` now");
    assert!(folder.read("pages/lptn-setup-man.1").contains("manual pages"));
    assert!(!folder.run(&["help"]).out.contains("  man "), "the help names one word");
}

/// Every verb that the help names has a page with its options.
#[test]
fn every_verb_has_a_manual_page() {
    let folder = Folder::empty();
    folder.run(&["setup", "man", "pages"]).exits(0).says("wrote  ");
    let help = folder.run(&["help"]).out;
    let verbs = help.split_once("Start here:").unwrap().1.split_once("Options:").unwrap().0;
    let names = verbs.lines().filter_map(|line| line.strip_prefix("  ")?.split(' ').next());
    let names: Vec<&str> = names.filter(|name| !name.is_empty() && *name != "help").collect();
    assert!(names.len() > 15, "{names:?}");
    for name in names {
        let page = folder.read(&format!("pages/lptn-{name}.1"));
        assert!(page.contains(".SH OPTIONS") && page.contains("quiet"), "{name}: {page}");
    }
}

#[test]
fn help_keeps_to_the_width_of_the_terminal() {
    let folder = Folder::empty();
    for (columns, widest) in [("60", 60), ("80", 80), ("200", 100)] {
        for verb in ["run", "plot", "fit", "size"] {
            let mut command = folder.command(&["help", verb]);
            let ran = common::Ran::of(command.env("COLUMNS", columns).output().unwrap()).exits(0);
            let longest = ran.out.lines().map(|line| line.chars().count()).max().unwrap();
            assert!(longest <= widest, "{verb} at {columns}: {longest}");
        }
    }
}

/// Times of rows, tables and verdicts in one unit; the picture and the other files stay as they are.
#[test]
fn times_are_shown_in_the_unit_that_is_asked_for() {
    let folder = Folder::with_gearbox();
    let seconds = folder.run(&["run", "gearbox.toml", "--format", "csv", "--no-files"]).exits(0);
    let asked = ["run", "gearbox.toml", "--format", "csv", "--time-unit", "min"];
    let minutes = folder.run(&asked).exits(0);
    let (headers, rows) = csv(&minutes.out);
    let (_, in_seconds) = csv(&seconds.out);
    assert_eq!(headers[0], "time [min]");
    assert!((rows.last().unwrap()[0] - 25.0).abs() < 1e-12);
    for (row, other) in rows.iter().zip(&in_seconds) {
        assert!((60.0 * row[0] - other[0]).abs() < 1e-9 && row[1..] == other[1..]);
    }
    assert_eq!(folder.read("out/gearbox/result.csv"), minutes.out);
    // a picture of the rows knows their unit
    folder.run(&["plot", "out/gearbox", "-o", "x.svg"]).exits(0);
    let asked = ["run", "gearbox.toml", "--time-unit", "h", "--no-files"];
    let table = folder.run(&asked).exits(0);
    table.prints("  0.4167 h  peak").prints("heat over 0.4167 h:");
    folder.run(&["run", "gearbox.toml", "--time-unit", "week"]).exits(2).says("s, min, h, d");
}

/// A number without a unit gets the unit of the netlist, not that of SI.
#[test]
fn a_bare_number_gets_the_unit_of_its_parameter() {
    let text =
        LUMP.to_owned() + "\n[param]\nspeed = \"7000 rpm\"\nshare = 0.5\nflow = \"3 l/min\"\n";
    let folder = Folder::with("lump.toml", &text);
    for (set, help) in [("speed=3000", "write \"3000 rpm\""), ("flow= 2", "write \"2 l/min\"")] {
        folder.run(&["run", "lump.toml", "--set", set]).exits(2).says(help);
    }
}
