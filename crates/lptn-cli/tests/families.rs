//! Families of equal parts in one row with their worst member, and tables at several widths.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common;

use common::{Folder, Ran};

/// 24 cells on a plate, the last of which gets 9 W instead of 5 W.
fn pack() -> Folder {
    let text = "format = 1\n[default]\nT0 = \"25 degC\"\n[node]\nplate = { C = \"5 kJ/K\" }\n\
        [boundary]\nair = { T = \"25 degC\" }\n\
        [resistor]\nout = { from = \"plate\", to = \"air\", R = \"0.05 K/W\" }\n\
        [template.cell]\nparam = { P = { unit = \"W\" } }\nport = [\"base\"]\n\
        [template.cell.node]\ncore = { C = \"60 J/K\" }\n\
        [template.cell.resistor]\njoint = { from = \"core\", to = \"base\", R = \"2 K/W\" }\n\
        [template.cell.source]\nloss = { into = \"core\", P = \"P\" }\n\
        [use.row]\ntemplate = \"cell\"\ncount = 24\nconnect = { base = \"plate\" }\n\
        set = { P = [POWERS] }\n\
        [limit]\nhot = { of = \"row[*].core.T\", below = \"46 degC\" }\n[run]\nstop = \"30 min\"\n";
    let powers = "\"5 W\", ".repeat(23) + "\"9 W\"";
    Folder::with("pack.toml", &text.replace("POWERS", &powers))
}

fn lines_from(ran: &Ran, start: &str) -> usize {
    ran.out.lines().filter(|line| line.starts_with(start)).count()
}

/// In steady state 124 W through 0.05 K/W and 9 W through 2 K/W: 49.2 degC.
#[test]
fn a_family_is_one_row_with_its_worst_member() {
    let folder = pack();
    let steady = folder.run(&["steady", "pack.toml"]).exits(1);
    let row = "row[*].core  [24] of 24  41.2 to 49.2 ";
    assert_eq!(lines_from(&steady, row), 1, "{}", steady.out);
    assert_eq!(lines_from(&steady, "row[*].loss   [24] of 24  5.0 to 9.0"), 1, "{}", steady.out);
    assert_eq!(lines_from(&steady, "row["), 3, "{}", steady.out);
    let steady =
        steady.prints("\nhot[*]  [24] of 24  row[24].core.T  below 46 degC  -3.2 K  BROKEN\n");
    steady.says("limit broken: `hot[24]`");
    let run = folder.run(&["run", "pack.toml", "--no-files"]).exits(1);
    assert_eq!((lines_from(&run, "row["), lines_from(&run, "hot[")), (1, 1), "{}", run.out);
    run.prints("\nT [degC]     hottest     start").prints("\nrow[*].core  [24] of 24   25.0");
}

/// Parameters of 24 instances that the file gives once are one row of a report, in their range;
/// sources of three families are three bands without the names of their lowest members.
#[test]
fn a_report_has_one_row_and_one_name_for_a_family() {
    let folder = pack();
    let text = folder.read("pack.toml");
    let text = text.replace(
        "param = { P = { unit = \"W\" } }",
        "param = { P = { unit = \"W\" }, R = \"2 [K/W] + 0.01 [K/W] * index\" }",
    );
    let text = text.replace("R = \"2 K/W\"", "R = \"R\"");
    let more = "fan = { into = \"core\", P = \"0.1 [W] * index\" }\nlamp = { into = \"core\", P = \"0.2 [W] * index\" }\n";
    let text = text.replace("P = \"P\" }\n", &format!("P = \"P\" }}\n{more}"));
    folder.write("pack.toml", &text);
    folder.run(&["run", "pack.toml", "--no-files", "--report=page.html"]).exits(1);
    let page = folder.read("page.html");
    let rows = page.split("<h2>Parameters</h2>").nth(1).unwrap();
    let row = rows.split("<tr>").find(|row| row.contains("row[*].R<")).unwrap();
    assert!(row.contains("2.01 K/W to 2.24 K/W"), "{row}");
    assert_eq!(rows.matches("2 [K/W] + 0.01 [K/W] * index").count(), 1, "{rows}");
    for name in ["loss", "fan", "lamp"] {
        assert!(page.contains(&format!("row[24].{name}.P, highest of 24")), "{name}");
        assert!(!page.contains(&format!("{name}.P, lowest of 24")), "{name}");
    }
    assert!(page.contains("coldest of 24"));
}

/// All cells are too hot: 124 W through 0.05 K/W and 5 W through 2 K/W are 41.2 degC.
#[test]
fn a_verdict_names_the_worst_of_a_family_once() {
    let folder = pack();
    let text = folder.read("pack.toml").replace("46 degC", "40 degC");
    folder.write("hot.toml", &text);
    let steady = folder.run(&["steady", "hot.toml"]).exits(1);
    let worst = "limit broken: `hot[24]` (row[24].core.T below 40 degC) by 9.2 K in steady state, and 23 \
                 more of hot[*]\n";
    assert_eq!(steady.err.matches("limit broken").count(), 1, "{}", steady.err);
    steady.says(worst);
    let all = folder.run(&["steady", "hot.toml", "-v"]).exits(1);
    assert_eq!(all.err.matches("limit broken").count(), 24, "{}", all.err);
    folder.write(
        "warm.toml",
        &text.replace("below = \"40 degC\"", "below = \"40 degC\", severity = \"warning\""),
    );
    let warned = folder.run(&["steady", "warm.toml"]).exits(0);
    assert_eq!(warned.err.matches("warning[").count(), 1, "{}", warned.err);
}

/// Without heat capacities every row of a run is the steady state at its time: 124 W and 9 W above;
/// after the step, half of the heat and half of the rise.
#[test]
fn tables_of_a_run_have_one_row_for_a_family() {
    let folder = pack();
    let text = folder.read("pack.toml");
    let text = text
        .replace("C = \"5 kJ/K\"", "massless = true")
        .replace("C = \"60 J/K\"", "massless = true")
        .replace("P = \"P\"", "P = \"P * if(t < 900 [s], 1, 0.5)\"")
        .replace(
            "T0 = \"25 degC\"\n",
            "T0 = \"25 degC\"\n[template.cell.state]\nq = { rate = \"P\", start = \"0 J\", size = \"1 kJ\" }\n",
        )
        .replace(
            "stop = \"30 min\"",
            "stop = \"30 min\"\nwindow = { late = { from = \"20 min\", to = \"30 min\" } }\n",
        );
    folder.write("step.toml", &text);
    let run = folder.run(&["run", "step.toml", "--no-files"]).exits(1);
    let rows: Vec<&str> = run.out.lines().filter(|line| line.starts_with("row[")).collect();
    let has = |parts: &[&str]| {
        let found = |row: &&&str| parts.iter().all(|part| row.contains(part));
        assert_eq!(rows.iter().filter(found).count(), 1, "{parts:?} {}", run.out);
    };
    has(&["row[*].core ", "[24] of 24", "41.2 to 49.2"]);
    has(&["row[*].core.T [degC]", "[24] of 24", "33.10 to 37.10"]);
    // 1800 s of 5 W and of 9 W
    has(&["row[*].q [J]", "[24] of 24", " 0.0  9000.0 to 16200.0"]);
    // 1350 s of 124 W
    run.prints("heat over 30 min:  in 167.4 kJ = air 167.4 kJ");
}

/// `index` in `set` gives cell k a power of 5 W (1 + k/50), known to 2 %: with 2 K/W to the air, the
/// last one reaches 25 + 14.8 = 39.8 degC, known to 0.296 K, and the first one 35.2 degC.
#[test]
fn values_of_the_number_have_their_uncertainty() {
    let folder = Folder::with(
        "row.toml",
        "format = 1\n[param]\nP0 = \"5 ± 0.1 W\"\n[default]\nT0 = \"25 degC\"\n\
         [boundary]\nair = { T = \"25 degC\" }\n\
         [template.cell]\nparam = { P = { unit = \"W\" } }\nport = [\"base\"]\n\
         [template.cell.node]\ncore = { C = \"6 J/K\" }\n\
         [template.cell.resistor]\nout = { from = \"core\", to = \"base\", R = \"2 K/W\" }\n\
         [template.cell.source]\nloss = { into = \"core\", P = \"P\" }\n\
         [use.row]\ntemplate = \"cell\"\ncount = 24\nconnect = { base = \"air\" }\n\
         set = { P = \"P0 * (1 + index / 50)\" }\n\
         [limit]\nhot = { of = \"row[*].core.T\", below = \"41 degC\" }\n[run]\nstop = \"20 min\"\n",
    );
    let steady = folder.run(&["steady", "row.toml"]).exits(0);
    steady.prints("row[*].core  [24] of 24  35.2 to 39.8 ");
    let run = folder.run(&["run", "row.toml", "--no-files", "--uncertainty", "linear"]).exits(0);
    let run = run.prints("39.800").prints("0.296").prints("hot[*]  [24] of 24  1.200 K  0.296 K");
    assert!(!run.out.contains("hot[7]"), "{}", run.out);
    let flat = folder.run(&["check", "row.toml", "--expand"]).exits(0);
    folder.write("flat.toml", &flat.out);
    let [own, flat] = ["row.toml", "flat.toml"]
        .map(|file| folder.run(&["run", file, "--no-files", "--format", "csv"]).exits(0).out);
    assert!(own == flat && own.lines().count() > 2, "{own}");
}

/// In steady state 46 - 49.2 and, with 120 W, 46 - 41 K; with 6 W below 46 degC each.
#[test]
fn a_comparison_has_one_column_for_a_family() {
    let folder = pack();
    let text = folder.read("pack.toml");
    folder.write("steady.toml", text.split("[run]").next().unwrap());
    let compare = ["compare", "steady.toml", "--set", "row[24].P=9W,5W"];
    let some = folder.run(&compare).exits(1);
    let some = some.prints("-3.20 K [24]").prints("hot[*]").prints("5.00 K [1]");
    assert!(!some.out.contains("hot[7]"), "{}", some.out);
    some.says("breaks hot[24]");
    let all = folder.run(&["compare", "steady.toml", "--set", "row[24].P=9W,5W", "-v"]).exits(1);
    assert!(all.out.contains("hot[7]"), "{}", all.out);
    let json = folder.run(&["compare", "steady.toml", "--format", "json"]).json();
    assert!(json.to_string().contains("hot[7].margin"), "{json}");
}

#[test]
fn every_member_is_shown_where_it_is_asked_for() {
    let folder = pack();
    for verb in ["run", "steady"] {
        let all = folder.run(&[verb, "pack.toml", "-v"]);
        assert!(lines_from(&all, "row[7].core ") == 1 && lines_from(&all, "hot[") == 24);
        let some = folder.run(&[verb, "pack.toml", "--select", "row[*].core.T"]);
        assert_eq!(lines_from(&some, "row[7].core "), 1, "{}", some.out);
    }
    let json = folder.run(&["steady", "pack.toml", "--format", "json"]).json();
    assert_eq!(json["limits"].as_object().unwrap().len(), 24);
}

/// Wide terminals have room for the curves, narrow ones lose curves and letters of names only.
#[test]
fn tables_use_the_width_they_have() {
    let folder = pack();
    let at = |columns: &str| {
        let mut command = folder.command(&["run", "pack.toml", "--no-files", "-q"]);
        Ran::of(command.env("COLUMNS", columns).output().unwrap()).out
    };
    let widest = |text: &str| text.lines().map(|line| line.chars().count()).max().unwrap();
    let (narrow, usual, wide) = (at("64"), at("80"), at("200"));
    assert!(widest(&usual) <= 80 && widest(&wide) > 80, "{wide}");
    assert!(wide.contains("0 to 30 min") && !usual.contains("0 to 30 min"), "{usual}");
    for text in [&narrow, &usual, &wide] {
        for number in ["49.1", "-3.12 K", "below 46 degC"] {
            assert!(text.contains(number), "{text}");
        }
    }
}

#[test]
fn verdicts_are_coloured_and_can_be_read_without() {
    let folder = pack();
    let coloured = folder.run(&["steady", "pack.toml", "--color", "always"]);
    coloured.prints("-3.2 K  \u{1b}[1;31mBROKEN\u{1b}[0m\n");
    let kept = ["steady", "pack.toml", "--color", "always", "--set", "row[24].P=5 W"];
    folder.run(&kept).prints("\u{1b}[32mkept\u{1b}[0m\n");
    for format in ["csv", "json"] {
        let ran = folder.run(&["steady", "pack.toml", "--color", "always", "--format", format]);
        assert!(!ran.out.contains('\u{1b}'), "{}", ran.out);
    }
}
