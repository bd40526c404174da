//! Deviations of values that a study changes: one in percent and a factor follow the value, one
//! with a unit does not.

use crate::common;

use std::fmt::Write as _;

use common::Folder;

/// Every study that reads a `±`, of one body whose power is uncertain.
const STUDIES: [&str; 8] = [
    "run body.toml --uncertainty linear --no-files",
    "run body.toml --uncertainty sobol --samples 128 --no-files",
    "compare body.toml other.toml --uncertainty",
    "size body.toml",
    "fit network body.toml both",
    "fit network body.toml one",
    "infer body.toml",
    "plan body.toml",
];

fn body(power: &str) -> String {
    format!(
        "format = 1\n[param]\nP = \"{power}\"\nR = \"0.3 K/W\"\n[signal]\nQ = \"0 W\"\n[node]\n\
         body = {{ C = \"2659 J/K\", T0 = \"25 degC\" }}\n[boundary]\nroom = {{ T = \"25 degC\" }}\n\
         [resistor]\nskin = {{ from = \"body\", to = \"room\", R = \"R\" }}\n[source]\n\
         heat = {{ into = \"body\", P = \"P + Q\" }}\n[run]\nstop = \"30 min\"\n[limit]\n\
         warm = {{ of = \"body.T\", below = \"90 degC\" }}\n[size.skin]\nmaximise = \"R\"\n\
         vary = {{ R = {{ from = \"0.01 K/W\", to = \"5 K/W\" }} }}\n\
         require = [\"body.T <= 120 [degC]\"]\nprobability = \"95 %\"\n[fit.both]\n\
         data = \"record.csv\"\ncolumn = {{ ring = \"body.T\" }}\nsigma = \"0.1 K\"\n\
         vary = [\"P\", \"R\"]\n[fit.one]\ndata = \"record.csv\"\n\
         column = {{ ring = \"body.T\" }}\nsigma = \"0.1 K\"\nvary = [\"R\"]\n[infer.power]\n\
         data = \"record.csv\"\ncolumn = {{ ring = \"body.T\" }}\nsigma = \"0.1 K\"\nfind = [\"Q\"]\n\
         [plan.power]\nknow = {{ P = \"0.02 %\" }}\n\
         place = {{ ring = {{ of = \"body.T\", noise = \"0.1 K\" }} }}\nevery = \"5 s\"\n\
         duration = \"30 min\"\nrun = {{ hot = {{}} }}\n"
    )
}

fn folder(power: &str) -> Folder {
    let folder = Folder::with("body.toml", &body(power));
    folder.write("other.toml", &body(power));
    let mut record = "t [s],ring [degC]\n".to_owned();
    for k in 0..=60 {
        let t = 30.0 * f64::from(k);
        // noise without a seed: what is left of a golden section
        let noise = 0.05 * ((f64::from(k) * 0.618_034).fract() - 0.5);
        writeln!(record, "{t},{:.4}", 25.0 - 66.0 * f64::exp_m1(-t / 800.0) + noise).unwrap();
    }
    folder.write("record.csv", &record);
    folder
}

/// A value that is set is the same as one that is written, to the last bit. With 5 % of 100 W, every
/// study kept 5 W of another power.
#[test]
fn a_set_value_has_the_deviation_that_the_file_would_give_it() {
    let same = [
        ("100 W ± 5 %", "200 W", "200 W ± 5 %"),
        ("100 ± 5 W", "200 W", "200 ± 5 W"),
        ("100 W ± 5 % (rectangle)", "200 W", "200 W ± 5 % (rectangle)"),
        ("100 ± 5 W (lognormal)", "200 W", "200 ± 10 W (lognormal)"),
        ("100 W ± 5 %", "200 W ± 3 %", "200 W ± 3 %"),
        ("100 ± 5 W", "200 W ± 3 %", "200 W ± 3 %"),
    ];
    for (own, set, written) in same {
        let (set_folder, written_folder) = (folder(own), folder(written));
        for study in STUDIES {
            let json = |folder: &Folder, more: &[&str]| {
                let words: Vec<&str> = study.split(' ').chain(["--format", "json"]).collect();
                let ran = folder.run(&[&words, more].concat());
                assert!(!ran.out.is_empty(), "{study}: {}", ran.err);
                ran.out
            };
            let found = json(&set_folder, &["--set", &format!("P={set}")]);
            assert!(found == json(&written_folder, &[]), "{own}, {set}: {study}");
        }
    }
}

/// Each load case has 5 % of its own power: G = 200 W (1 + 1.644 853 627 x 0.05) / 60 K.
#[test]
fn a_load_case_has_its_own_deviation() {
    let text = "format = 1\n[param]\nP = \"100 W ± 5 %\"\nG = \"1 W/K\"\n[node]\n\
         body = { C = \"1 kJ/K\", T0 = \"20 degC\" }\n[boundary]\nair = { T = \"20 degC\" }\n\
         [resistor]\nskin = { from = \"body\", to = \"air\", G = \"G\" }\n[source]\n\
         heat = { into = \"body\", P = \"P\" }\n[case.usual]\nset = { P = \"100 W\" }\n[case.hot]\nset = { P = \"200 W\" }\n\
         [size.G]\nminimise = \"G\"\nvary = { G = { from = \"0.5 W/K\", to = \"50 W/K\" } }\n\
         require = [\"body.T <= 80 [degC]\"]\nprobability = \"95 %\"\n";
    let folder = Folder::with("cases.toml", text);
    let json = folder.json("size cases.toml").exits(0).json();
    let found = json["values"]["G"]["value"].as_f64().unwrap();
    let expected = 200.0 * (1.0 + 1.644_853_626_951_472_7 * 0.05) / 60.0;
    assert!((found / expected - 1.0).abs() < 1e-9, "{json}");
}

/// A flat netlist has the deviation of its source, also that of `--set`, and is its own flat one.
#[test]
fn a_flat_netlist_keeps_percents() {
    let folder = folder("100 W ± 5 % (rectangle)");
    let flat = |name: &str, more: &[&str]| {
        folder.run(&[&["check", "--expand", name], more].concat()).exits(0).out
    };
    let own = flat("body.toml", &[]);
    assert!(own.contains("P = \"100 W ± 5 % (rectangle)\""), "{own}");
    folder.write("flat.toml", &own);
    assert_eq!(flat("flat.toml", &[]), own);
    let set = flat("body.toml", &["--set", "P=200 W"]);
    assert!(set.contains("P = \"200 W ± 5 % (rectangle)\""), "{set}");
    let set = flat("body.toml", &["--set", "P=200 W ± 3 %"]);
    assert!(set.contains("P = \"200 W ± 3 %\""), "{set}");
    // `2 ± 5 %` would be a number in percent
    folder.write("ratio.toml", &body("100 W").replace("[signal]", "n = \"2 m/m ± 5 %\"\n[signal]"));
    assert!(flat("ratio.toml", &[]).contains("n = \"2 m/m ± 5 %\""));
}

/// The written value keeps the requirements with its own deviation:
/// `120 degC = 25 degC + 0.3 K/W P (1 + 1.644 853 627 x 0.05)` is 292.602 W.
#[test]
fn a_written_answer_keeps_what_it_promises() {
    let sized = body("100 W ± 5 %").replace(
        "R = { from = \"0.01 K/W\", to = \"5 K/W\" }",
        "P = { from = \"1 W\", to = \"5000 W\" }",
    );
    let folder = folder("100 W");
    folder.write("body.toml", &sized.replace("maximise = \"R\"", "maximise = \"P\""));
    folder.run(&["size", "body.toml", "--write"]).exits(0).prints("P = 292.602 W");
    assert!(
        folder.read("body.toml").contains("P = \"292.602 W ± 5 %\""),
        "{}",
        folder.read("body.toml")
    );
}

/// Two cells of a template, P over R into air of 20 degC: a value that a use or `--set` gives keeps
/// the `±` of the template, `sd^2 = (P s_R R)^2 + (s_P P R)^2`.
#[test]
fn a_value_of_a_use_has_the_deviation_of_its_template() {
    let text = "format = 1\n[param]\nR0 = \"0.5 K/W ± 10 %\"\n[template.cell]\nparam = { P = \"50 W ± 20 %\", \
        R = { unit = \"K/W\" } }\nport = [\"base\"]\n[template.cell.node]\nx = { C = \"100 J/K\", T0 = \"20 \
        degC\" }\n[template.cell.resistor]\nr = { from = \"x\", to = \"base\", R = \"R\" }\n\
        [template.cell.source]\ns = { into = \"x\", P = \"P\" }\n[use.a]\ntemplate = \"cell\"\ncount = 3\n\
        connect = { base = \"air\" }\nset = { R = \"R0\", P = [\"100 W\", \"200 W ± 0 W\", \"2 * 50 [W]\"] }\n\
        [boundary]\nair = { T = \"20 degC\" }\n[run]\nstop = \"6000 s\"\n";
    let folder = Folder::with("cells.toml", text);
    let deviation = |more: &[&str], name: &str| {
        let words =
            ["run", "cells.toml", "--uncertainty", "linear", "--no-files", "--format", "json"];
        let json = folder.run(&[&words, more].concat()).json();
        let result = &json["uncertainty"]["results"][format!("{name}.T")];
        result["end"]["sd"]["value"].as_f64().unwrap()
    };
    let both = |power: f64, share: f64| (0.5 * power) * (share * share + 0.01_f64).sqrt();
    for (more, name, expected) in [
        (&[][..], "a[1].x", both(100.0, 0.2)),
        (&[], "a[2].x", both(200.0, 0.0)),
        (&["--set", "a[1].P=300 W"], "a[1].x", both(300.0, 0.2)),
        (&["--set", "a[1].P=300 W ± 0 W"], "a[1].x", both(300.0, 0.0)),
    ] {
        let found = deviation(more, name);
        assert!((found / expected - 1.0).abs() < 1e-3, "{name} {more:?}: {found}, not {expected}");
    }
}

/// 5 % of 0 W is 0 W, and no flat netlist says otherwise.
#[test]
fn a_percent_of_zero_is_told() {
    let text = body("100 W ± 5 %");
    // a plan cannot know 0 W to a part of it
    let folder = Folder::with("body.toml", text.split("[size.skin]").next().unwrap());
    let ran = folder.run(&["steady", "body.toml", "--set", "P=0 W"]).exits(0);
    ran.says("units::relative_deviation").says("`P` is 0, and 5 % of it is 0 too");
    let flat = folder.run(&["check", "--expand", "body.toml", "--set", "P=0 W"]).exits(0).out;
    folder.write("flat.toml", &flat);
    folder.run(&["check", "flat.toml"]).exits(0);
    let ran = folder.run(&["steady", "body.toml", "--set", "P=0 ± 3 W"]).exits(0);
    assert!(!ran.err.contains("units::relative_deviation"), "{}", ran.err);
}
