//! Kind: command line. Pages: `lptn report`, and `--report` of the other verbs.
//!
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common;

use common::Folder;
use serde_json::Value;

/// One lump of 1000 J/K that P heats and 10 W/K cool: 25 + P/G (1 - exp(-t / 100 s)) degC. Title,
/// comment and names try to become markup.
const LUMP: &str = "format = 1
title = 'A lump </title><script>alert(1)</script>'
[param]
P = '100 W' # </script><img src=x onerror=alert(2)>
G = '10 W/K ± 1 W/K'
T_air = '25 degC'
[node]
lump = { C = '1000 J/K', T0 = '25 degC' }
[boundary]
air = { T = 'T_air' }
[resistor]
skin = { from = 'lump', to = 'air', G = 'G' }
[source]
heat = { into = 'lump', P = 'P' }
[limit]
hot = { of = 'lump.T', below = '30 degC', severity = 'warning' }
[run]
stop = '300 s'
output = { every = '1 s' }
[size.heat]
maximise = 'P'
vary = { P = { from = '1 W', to = '1 kW' } }
require = ['lump.T <= 60 [degC]']
";

fn lump() -> Folder {
    Folder::with("lump.toml", LUMP)
}

/// The report of a run.
fn page() -> String {
    let folder = lump();
    let ran = folder.run(&["run", "lump.toml", "--report=page.html", "--no-files"]);
    assert_eq!(ran.code, Some(0), "{}", ran.err);
    folder.read("page.html")
}

/// The values of the first figure of a page.
fn values(page: &str) -> Value {
    let begin = "<script type=\"application/json\">";
    let from = page.find(begin).unwrap() + begin.len();
    let to = from + page[from..].find("</script>").unwrap();
    serde_json::from_str(&page[from..to]).unwrap()
}

#[test]
fn the_values_of_a_page_are_those_of_the_closed_form_and_of_the_rows() {
    let folder = lump();
    let ran = folder.run(&["run", "lump.toml", "--select", "lump.T", "--report"]);
    assert_eq!(ran.code, Some(0), "{}", ran.err);
    assert!(ran.err.contains("wrote  out/lump/report.html"), "{}", ran.err);
    let values = values(&folder.read("out/lump/report.html"));
    let curve = &values["panels"][0]["curves"][0];
    let rows = folder.read("out/lump/result.csv");
    let rows: Vec<(f64, f64)> = rows
        .lines()
        .skip(1)
        .map(|line| line.split_once(',').unwrap())
        .map(|(time, value)| (time.parse().unwrap(), value.parse().unwrap()))
        .collect();
    assert_eq!(rows.len(), 301);
    for (i, &(time, value)) in rows.iter().enumerate() {
        let place = values["places"][curve["x"].as_u64().unwrap() as usize][i].as_f64().unwrap();
        let shown = curve["y"][i].as_f64().unwrap();
        assert_eq!((place.to_bits(), shown.to_bits()), (time.to_bits(), value.to_bits()));
        let expected = 25.0 + 10.0 * (1.0 - (-time / 100.0).exp());
        assert!((shown - expected).abs() < 1e-4, "{time} s: {shown}, not {expected}");
    }
}

#[test]
fn no_text_of_a_netlist_is_markup() {
    let page = page();
    assert_eq!(page.matches("<script>").count(), 2, "the two of the page itself");
    for markup in ["<img", "</title><script", "<script>alert"] {
        assert!(!page.contains(markup), "{markup}");
    }
    assert!(page.contains("A lump &lt;/title&gt;&lt;script&gt;alert(1)"));
    assert!(page.contains("&lt;/script&gt;&lt;img src=x onerror=alert(2)&gt;"));
}

/// What a browser would ask a network for.
#[test]
fn a_page_stands_alone() {
    let folder = Folder::with_gearbox();
    folder.run(&["run", "gearbox.toml", "--report=page.html"]);
    let page = folder.read("page.html");
    for outside in [" src=", " href=", "@import", "url(", "<link", "<iframe", "fetch(", "XMLHttp"] {
        assert!(!page.contains(outside), "{outside}");
    }
    assert!(page.contains("default-src 'none'"));
    let of_data = values(&page).to_string().len();
    assert!(page.len() - of_data < 200_000, "{} bytes without data", page.len() - of_data);
}

#[test]
fn the_same_page_has_the_same_bytes() {
    assert_eq!(page(), page());
}

/// T(300 s) = T_air + P/G (1 - exp(-3)): 1 % more of P, 1 K more of T_air, from the same start; of G, x = G t / C,
/// -P/G (1 - exp(-x) - x exp(-x)).
#[test]
fn parameters_stand_with_what_they_do() {
    let page = page();
    let rise = 1.0 - (-3.0_f64).exp();
    let of_conductance = -0.1 * (rise - 3.0 * (-3.0_f64).exp());
    let row = |name: &str| {
        let from = page.find(&format!("<tr><td class=\"short\">{name}</td>")).unwrap();
        page[from..from + page[from..].find("</tr>").unwrap()].to_owned()
    };
    for (name, expected) in [("P", 0.1 * rise), ("G", of_conductance), ("T_air", rise)] {
        let expected = format!("<td class=\"number\">{expected:+.3}</td>");
        assert!(row(name).ends_with(&expected), "{} lacks {expected}", row(name));
    }
    assert!(row("G").contains(">1 W/K<"), "{}", row("G"));
}

#[test]
fn trust_is_told_first() {
    let page = page();
    let from = page.find("<ul class=\"claims\">").unwrap();
    let claims = &page[from..from + page[from..].find("</ul>").unwrap()];
    for claim in [
        "the energy balance closes to",
        "linear: temperatures rise in proportion to heat",
        "no Biot number checked",
        "<li class=\"open\"><b>\u{b7}</b> not verified: errors should be below 1e-4 K",
        "<li class=\"fails\"><b>\u{2717}</b> hot broken by",
    ] {
        assert!(claims.contains(claim), "{claims} lacks {claim}");
    }
}

#[test]
fn the_network_is_drawn_at_the_times_that_are_asked_for() {
    let folder = lump();
    let command = ["run", "lump.toml", "--no-files", "--report=a.html", "--at"];
    let ran = folder.run(&[&command[..], &["100 s", "--at", "3min"]].concat());
    assert_eq!(ran.code, Some(0), "{}", ran.err);
    let page = folder.read("a.html");
    for heading in ["At 100 s", "At 3 min", "Steady state"] {
        assert!(page.contains(&format!("<h2>{heading}</h2>")), "{heading}");
    }
    // 25 + 10 (1 - exp(-1)) = 31.32 degC, 10 W/K times that rise
    assert!(page.contains(">31.32 °C<"));
    assert!(page.contains(">63.2 W<"));
    let ran = folder.run(&[&command[..], &["1h"]].concat());
    assert_eq!(ran.code, Some(2));
    assert!(ran.err.contains("--at 1h is outside of the run, which goes from 0"), "{}", ran.err);
}

#[test]
fn every_verb_that_prints_a_result_has_a_page() {
    let folder = lump();
    for (arguments, says) in [
        (&["steady", "lump.toml"][..], "Steady state"),
        (&["modes", "lump.toml"], "100 s"),
        (&["verify", "lump.toml"], "verified"),
        (&["reduce", "lump.toml", "--port", "lump"], "Results"),
        (&["size", "lump.toml"], "lump.T &lt;= 60 [degC]"),
        (&["compare", "lump.toml", "lump.toml"], "candidate"),
        (&["check", "lump.toml"], "ok: lump.toml"),
        (&["materials"], "aluminium"),
    ] {
        let ran = folder.run(&[arguments, &["--report=page.html"]].concat());
        assert!(matches!(ran.code, Some(0 | 1)), "{arguments:?}: {}", ran.err);
        let page = folder.read("page.html");
        assert!(page.contains(says), "{arguments:?} does not say {says}");
        std::fs::remove_file(folder.path().join("page.html")).unwrap();
    }
    let ran = folder.run(&["new", "motor", "--report"]);
    assert!(ran.code == Some(2) && ran.err.contains("there is no report of this"), "{}", ran.err);
}

#[test]
fn a_page_of_results_says_whether_they_are_what_their_run_gives() {
    let folder = lump();
    folder.run(&["run", "lump.toml"]);
    let claim = |expected: &str, code| {
        let ran = folder.run(&["report", "out/lump"]);
        assert_eq!(ran.code, Some(code), "{}", ran.err);
        let page = folder.read("out/lump/report.html");
        assert!(page.contains(expected), "{expected}");
    };
    claim("\u{2713}</b> run again: result.csv has the same bytes", 0);
    let rows = folder.read("out/lump/result.csv");
    folder.write("out/lump/result.csv", &rows.replacen("25.0", "26.0", 1));
    claim("\u{2717}</b> run again: result.csv has other bytes", 1);
    folder.write("out/lump/result.csv", &rows);
    folder.write("lump.toml", &LUMP.replace("'100 W'", "'90 W'"));
    claim("not run again: lump.toml has changed since", 0);
    std::fs::remove_file(folder.path().join("lump.toml")).unwrap();
    claim("not run again: lump.toml is not here", 0);
}

/// One page is written, into the file that is named by either option.
#[test]
fn a_page_of_results_goes_into_the_file_that_is_named() {
    let folder = lump();
    assert_eq!(folder.run(&["run", "lump.toml"]).code, Some(0));
    let ran = folder.run(&["report", "out/lump", "--report=named.html"]);
    assert_eq!(ran.code, Some(0), "{}", ran.err);
    assert!(folder.read("named.html").starts_with("<!doctype html>"));
    assert!(!folder.files().contains(&"out/lump/report.html".to_owned()));
    for words in [
        &["report", "out/lump", "-o", "a.html", "--report=b.html"][..],
        &["plot", "lump.toml", "-o", "a.svg", "--plot", "b.svg"],
    ] {
        let ran = folder.run(words);
        assert_eq!(ran.code, Some(2), "{}", ran.err);
        assert!(ran.err.contains("input::two_files"), "{}", ran.err);
    }
    assert!(folder.files().iter().all(|file| !file.starts_with("a.") && !file.starts_with("b.")));
}

/// What a parameter does to a run from the start is not what it does to a settled cycle.
#[test]
fn a_settled_cycle_has_no_derivatives_of_another_run() {
    let text = include_str!("../../../networks/duty_cycle.toml");
    let folder = Folder::with("duty.toml", &format!("{text}\n[param]\nspare = \"1 W/K\"\n"));
    let ran = folder.run(&["steady", "duty.toml", "--periodic", "--report=page.html"]);
    assert_eq!(ran.code, Some(0), "{}", ran.err);
    let page = folder.read("page.html");
    assert!(page.contains("<h2>Parameters</h2>") && !page.contains("+1 % changes it"));
}

#[test]
fn regression_a_report_is_never_written_over_a_netlist() {
    let folder = lump();
    for words in [
        &["run", "lump.toml", "--no-files", "--report=lump.toml"][..],
        &["report", "out/lump", "-o", "lump.toml"],
    ] {
        let ran = folder.run(words);
        assert_eq!(ran.code, Some(2), "{}", ran.err);
        assert!(ran.err.contains("write lump.html"), "{}", ran.err);
    }
    assert_eq!(folder.read("lump.toml"), LUMP);
}

#[test]
fn regression_a_report_makes_the_folder_it_goes_into() {
    for words in [
        &["steady", "lump.toml", "--report"][..],
        &["modes", "lump.toml", "--report"],
        &["run", "lump.toml", "--no-files", "--report"],
        &["reduce", "lump.toml", "--port", "lump", "--report"],
    ] {
        let folder = lump();
        let ran = folder.run(words);
        assert_eq!(ran.code, Some(0), "{words:?}: {}", ran.err);
        let name = if words[0] == "run" { "report" } else { words[0] };
        assert!(folder.read(&format!("out/lump/{name}.html")).starts_with("<!doctype html>"));
    }
}

/// Rises under a constant stream are in proportion to the heat; those of a body that glows or whose
/// capacity changes are not.
#[test]
fn regression_a_constant_stream_is_linear() {
    let stream = "[advection]\nfeed = { from = 'air', to = 'lump', mcp = '10 W/K' }\n[source]";
    let glow = "[radiation]\nglow = { from = 'lump', to = 'air', area = '1 m^2', emissivity = 1 }\n\
                [source]";
    let capacity = "C = '1000 [J/K] + 1 [J/K^2] * (T - 25 [degC])'";
    for (old, new, linear) in
        [("[source]", stream, true), ("[source]", glow, false), ("C = '1000 J/K'", capacity, false)]
    {
        let folder = Folder::with("lump.toml", &LUMP.replace(old, new));
        let ran = folder.run(&["steady", "lump.toml", "--report=page.html"]);
        assert_eq!(ran.code, Some(0), "{}", ran.err);
        let page = folder.read("page.html");
        let said = page.contains("linear: temperatures rise in proportion to heat");
        assert_eq!((said, page.contains("not linear:")), (linear, !linear), "{new}");
    }
}

/// Six instances are one box; every node is in a section that opens.
#[test]
fn many_instances_are_one_box_that_opens() {
    let mut text = "format = 1\n[default]\nT0 = '20 degC'\n[template.c.node]\nbody = { C = '10 J/K' }\n\
                    [use]\ncell = { template = 'c', count = 6 }\n[boundary]\nair = { T = '20 degC' }\n\
                    [source]\nheat = { into = 'cell[1].body', P = '1 W' }\n[resistor]\n"
        .to_owned();
    for i in 1..=6 {
        text += &format!("r{i} = {{ from = 'cell[{i}].body', to = 'air', R = '1 K/W' }}\n");
    }
    let folder = Folder::with("cells.toml", &text);
    folder.run(&["steady", "cells.toml", "--report=cells.html"]).exits(0);
    let page = folder.read("cells.html");
    let (whole, every) = page.split_once("every node</summary>").unwrap();
    assert!(whole.contains(">cell[*]<") && whole.contains(">\u{d7} 6<"), "one box");
    assert!(!whole.contains(">cell[3].body</text>") && every.contains(">cell[3].body</text>"));
}
