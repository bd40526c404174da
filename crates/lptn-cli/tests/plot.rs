//! Kind: command line. Pictures: `lptn plot`, and `--plot` of the other verbs.
//!
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common;
use crate::picture;

use common::{Folder, Ran};
use picture::Picture;

/// One lump of 1000 J/K that 100 W heat and 10 W/K cool: 25 + 10 (1 - exp(-t / 100 s)) degC.
const LUMP: &str = "format = 1
title = 'A lump <script>alert(1)</script>'
[node]
lump = { C = '1000 J/K', T0 = '25 degC' }
[boundary]
air = { T = '25 degC' }
[resistor]
skin = { from = 'lump', to = 'air', G = '10 W/K' }
[source]
heat = { into = 'lump', P = '100 W' }
[limit]
hot = { of = 'lump.T', below = '30 degC', severity = 'warning' }
[run]
stop = '300 s'
output = { every = '1 s' }
";

/// The title of the axis of temperatures.
const TEMPERATURE: &str = "temperature [°C]";

/// The rise of the lump in K.
fn rise(time: f64) -> f64 {
    10.0 * (1.0 - (-time / 100.0).exp())
}

#[test]
fn a_curve_is_where_the_closed_form_is() {
    let folder = Folder::with("lump.toml", LUMP);
    let output = folder.run(&["plot", "lump.toml", "--select", "lump.T", "-o", "lump.svg"]);
    assert_eq!(output.code, Some(0), "{}", output.err);
    let picture = Picture::read(&folder.read("lump.svg"));
    let curve = picture.lines(TEMPERATURE, "series0").remove(0);
    assert!(curve.len() > 100, "{curve:?}");
    // marks and points are rounded to a hundredth of a pixel, of which 10 K take some 270
    for (minutes, celsius) in curve {
        let expected = 25.0 + rise(60.0 * minutes);
        assert!((celsius - expected).abs() < 0.01, "{minutes} min: {celsius}, not {expected}");
    }
    picture.says("time [min]").says("lump.T below 30 °C").says("hot broken");
}

#[test]
fn no_text_of_a_netlist_is_markup() {
    let folder = Folder::with("lump.toml", LUMP);
    folder.run(&["plot", "lump.toml", "-o", "lump.svg"]);
    let svg = folder.read("lump.svg");
    assert!(!svg.contains("<script") && svg.contains("&lt;script&gt;"), "{svg}");
}

#[test]
fn the_same_picture_has_the_same_bytes() {
    let folder = Folder::with("lump.toml", LUMP);
    for ending in ["svg", "png"] {
        let name = |i: usize| format!("{i}.{ending}");
        for i in 0..2 {
            let output = folder.run(&["run", "lump.toml", "--no-files", "--plot", &name(i)]);
            assert_eq!(output.code, Some(0), "{}", output.err);
        }
        let read = |i| std::fs::read(folder.path().join(name(i))).unwrap();
        assert_eq!(read(0), read(1));
    }
    let png = std::fs::read(folder.path().join("0.png")).unwrap();
    assert_eq!(png[..8], *b"\x89PNG\r\n\x1a\n");
}

/// The measured values are those of the closed form and 0.5 K, so that is what is left.
#[test]
fn what_was_measured_stands_over_the_run_and_the_difference_below() {
    let folder = Folder::with("lump.toml", LUMP);
    let mut record = "time [s],lump.T [degC]\n".to_owned();
    for i in 0..30 {
        let time = 10.0 * f64::from(i);
        record += &format!("{time},{}\n", 25.5 + rise(time));
    }
    folder.write("measured.csv", &record);
    let arguments = ["plot", "lump.toml", "measured.csv", "--select", "lump.T", "-o", "both.svg"];
    let output = folder.run(&arguments);
    assert_eq!(output.code, Some(0), "{}", output.err);
    let picture = Picture::read(&folder.read("both.svg"));
    let left = picture.dots("measured \u{2212} run [K]", "series0");
    assert_eq!((left.len(), picture.dots(TEMPERATURE, "series0").len()), (30, 30));
    // the run is right to 1e-4 K, and its curve is straight between rows of 1 s
    assert!(left.iter().all(|(_, kelvin)| (kelvin - 0.5).abs() < 5e-4), "{left:?}");
}

/// The same record in other units: 273.15 K is 0 degC is 32 degF.
#[test]
fn a_record_in_any_unit_of_temperature_lies_over_the_run() {
    let folder = Folder::with("lump.toml", LUMP);
    let same = |celsius: f64| celsius;
    type Convert = fn(f64) -> f64;
    let units: [(&str, Convert); 4] = [
        ("\u{b0}C", same),
        ("\u{2103}", same),
        ("K", |celsius| celsius + 273.15),
        ("degF", |celsius| 1.8 * celsius + 32.0),
    ];
    for (unit, written) in units {
        let mut record = format!("time [s],lump [{unit}]\n");
        for i in 0..30 {
            let time = 10.0 * f64::from(i);
            record += &format!("{time},{}\n", written(25.5 + rise(time)));
        }
        folder.write("measured.csv", &record);
        let arguments = ["plot", "lump.toml", "measured.csv", "--select", "lump.T"];
        folder.run(&[&arguments[..], &["-o", "both.svg"]].concat()).exits(0);
        let picture = Picture::read(&folder.read("both.svg"));
        let left = picture.dots("measured \u{2212} run [K]", "series0");
        assert_eq!((left.len(), picture.dots(TEMPERATURE, "series0").len()), (30, 30), "{unit}");
        assert!(left.iter().all(|(_, kelvin)| (kelvin - 0.5).abs() < 5e-4), "{unit}: {left:?}");
    }
}

/// No pattern could satisfy a run and a record of other names.
#[test]
fn a_pattern_has_to_match_in_one_of_the_files() {
    let folder = Folder::with("lump.toml", LUMP);
    folder.write("measured.csv", "t [s],ring [degC],lid [degC]\n0,30,31\n300,40,41\n");
    let both = ["plot", "lump.toml", "measured.csv", "-o", "both.svg", "--select", "lump.T"];
    folder.run(&[&both[..], &["--select", "ring"]].concat()).exits(0);
    let picture = Picture::read(&folder.read("both.svg"));
    picture.says("ring");
    assert!(!folder.read("both.svg").contains("lid"));
    folder.run(&[&both[..], &["--select", "lamp.T"]].concat()).exits(2).says("matches `lamp.T`");
    folder.run(&both).exits(2).says("no column of measured.csv is selected").says("ring, lid");
}

#[test]
fn a_record_without_a_known_unit_says_so() {
    let folder = Folder::with("tc.csv", "Zeit [min];T [Grad C]\n0;20,00\n1;21,50\n");
    folder
        .run(&["plot", "tc.csv"])
        .exits(2)
        .says("`T [Grad C]`, whose units are unknown")
        .says("tc.csv has no column of numbers with a unit")
        .says("--unit T=degC");
    folder.run(&["plot", "tc.csv", "--unit", "T=degC"]).exits(0);
    folder.write("gap.csv", "t [s],a [mm],b [mm]\n0,1,2\n60,2,3\n");
    folder.run(&["plot", "gap.csv"]).exits(0).prints("\n[mm] over time");
}

#[test]
fn results_are_drawn_as_the_run_that_wrote_them() {
    let folder = Folder::with("lump.toml", LUMP);
    folder.run(&["run", "lump.toml"]);
    folder.run(&["plot", "out/lump", "--select", "lump.T", "-o", "a.svg"]);
    folder.run(&["plot", "lump.toml", "--select", "lump.T", "-o", "b.svg"]);
    let [a, b] = ["a.svg", "b.svg"].map(|name| Picture::read(&folder.read(name)));
    let line = |picture: &Picture| picture.lines(TEMPERATURE, "series0").remove(0);
    // the limit is not among the results, and widens the axis of neither
    let (a_line, b_line) = (line(&a), line(&b));
    assert_eq!(a_line.len(), b_line.len());
    let same = |(a, b): (&(f64, f64), &(f64, f64))| (a.0 - b.0).hypot(a.1 - b.1) < 1e-9;
    assert!(a_line.iter().zip(&b_line).all(same));
    a.says("hot broken");
}

/// Found by random networks: `air.T - lump.T` is -10 K in the end, which is not below absolute zero.
#[test]
fn differences_of_temperatures_are_drawn_as_differences() {
    let text = LUMP.replace("output =", "report = { fall = 'air.T - lump.T' }\noutput =");
    let folder = Folder::with("lump.toml", &text);
    for (unit, asked, axis, size) in [
        ("degC", None, "fall [K]", 1.0),
        ("K", None, "fall [K]", 1.0),
        ("degF", None, "fall [°R]", 1.8),
        ("degF", Some("degC"), "fall [K]", 1.0),
        ("K", Some("degF"), "fall [°R]", 1.8),
    ] {
        folder.run(&["run", "lump.toml", "--temperature-unit", unit]).exits(0);
        folder.run(&["report", "out/lump"]).exits(0);
        let mut plot = vec!["plot", "out/lump", "--select", "fall", "-o", "fall.svg"];
        plot.extend(asked.iter().flat_map(|asked| ["--temperature-unit", asked]));
        folder.run(&plot).exits(0);
        let curve = Picture::read(&folder.read("fall.svg")).lines(axis, "series0").remove(0);
        for (minutes, found) in curve {
            let kelvin = found / size;
            assert!((kelvin + rise(60.0 * minutes)).abs() < 0.02, "{unit}: {kelvin} at {minutes}");
        }
    }
}

/// Found by use: a last number that was cut off, -55.7 to -5, was drawn without a word.
#[test]
fn results_that_were_cut_off_are_not_drawn_in_silence() {
    let folder = Folder::with("lump.toml", LUMP);
    folder.run(&["run", "lump.toml"]).exits(0);
    assert!(!folder.run(&["plot", "out/lump"]).exits(0).err.contains("manifest"));
    let whole = folder.read("out/lump/result.csv");
    folder.write("out/lump/result.csv", &whole[..whole.len() - 3]);
    folder.run(&["plot", "out/lump"]).exits(0).says("plot::not_as_written");
}

/// Found by use: rows of 100 s miss a pulse of 10 s, and with it that the limit was broken.
#[test]
fn a_limit_that_was_broken_between_rows_is_said() {
    let pulse = LUMP
        .replace("P = '100 W'", "P = \"100 [W] * if(t < 40 [s], 1, 0)\"")
        .replace("every = '1 s'", "every = '300 s'")
        .replace("below = '30 degC'", "below = '28 degC'");
    let folder = Folder::with("lump.toml", &pulse);
    // 10 K (1 - exp(-0.4)) = 3.297 K at 40 s, 0.297 K too much
    folder.run(&["plot", "lump.toml"]).exits(0).prints("hot broken by 0.2968 K at 40 s");
}

#[test]
fn designs_of_one_name_are_named_by_their_paths() {
    let folder = Folder::with("lump.toml", LUMP);
    folder.run(&["run", "lump.toml"]);
    let other = ["plot", "lump.toml", "out/lump", "--set", "x=1", "--select", "lump.T"];
    folder.write("lump.toml", &format!("{LUMP}[param]\nx = 1\n").replace("100 W", "50 W"));
    folder.run(&other).exits(0).prints("lump.toml: lump").prints("out/lump: lump");
}

#[test]
fn a_chart_keeps_to_the_width_of_the_terminal() {
    let folder = Folder::with("lump.toml", LUMP);
    for columns in [40, 80, 200] {
        let arguments = ["plot", "lump.toml"];
        let output = Ran::of(
            folder.command(&arguments).env("COLUMNS", columns.to_string()).output().unwrap(),
        );
        let text = output.out;
        let longest = text.lines().skip(1).map(|line| line.chars().count()).max().unwrap();
        assert!(longest <= columns && longest > columns - 15, "{longest}: {text}");
        assert!(!text.contains('\u{1b}'), "{text}");
    }
}

#[test]
fn every_verb_with_a_curve_has_a_picture() {
    let folder = Folder::with_gearbox();
    let size = "\n[size.cooling]\nminimise = \"G_out\"\n\
                vary = { G_out = { from = \"1 W/K\", to = \"10 W/K\" } }\n\
                require = [\"steel.T <= 80 [degC]\"]\n";
    folder.write("size.toml", &format!("{}{size}", common::GEARBOX));
    let verbs: [(&[&str], &str); 5] = [
        (&["modes", "gearbox.toml"], ">time constant [s]<"),
        (&["reduce", "gearbox.toml", "--port", "steel"], ">rise for 1 W [K/W]<"),
        (&["compare", "gearbox.toml", "size.toml"], ">peak<"),
        (&["size", "size.toml"], ">margin [K]<"),
        (&["run", "gearbox.toml", "--no-files"], ">heat flow [W]<"),
    ];
    for (arguments, wanted) in verbs {
        let mut arguments = arguments.to_vec();
        arguments.extend(["--plot", "x.svg"]);
        let output = folder.run(&arguments);
        assert_eq!(output.code, Some(0), "{arguments:?}: {}", output.err);
        assert!(output.err.contains("wrote  x.svg"), "{arguments:?}");
        assert!(folder.read("x.svg").contains(wanted), "{arguments:?}");
    }
}

#[test]
fn what_cannot_be_drawn_is_said() {
    let folder = Folder::with("lump.toml", LUMP);
    std::fs::create_dir(folder.path().join("folder.svg")).unwrap();
    folder.write("record.csv", "time [s],a [degC]\n0,1\n1,2\n");
    let cases: [(&[&str], &str); 9] = [
        (&["plot", "lump.toml", "-o", "x.pdf"], "ends with .svg or .png"),
        (&["plot", "."], "there is no result.csv"),
        (&["plot", "lump.toml", "--select", "lamp.T"], "lump.T"),
        (&["steady", "lump.toml", "--plot", "x.svg"], "there is no picture of this answer"),
        (&["units", "3 W", "--plot", "x.svg"], "there is no picture of this answer"),
        (&["run", "lump.toml", "--no-files", "--format", "csv", "--plot", "-"], "below a table"),
        (&["plot", "record.csv", "--stop", "5s"], "--stop changes a run"),
        (&["plot", "lump.toml", "-o", "folder.svg"], "something there is not a file"),
        (&["plot", "lump.toml", "-o", "nowhere/x.svg"], "cannot write nowhere/x.svg"),
    ];
    for (arguments, wanted) in cases {
        let Ran { code, err: text, .. } = folder.run(arguments);
        assert!(matches!(code, Some(2 | 3)), "{arguments:?}: {text}");
        assert!(text.contains(wanted), "{arguments:?}: {text}");
    }
    assert_eq!(folder.files(), ["lump.toml", "record.csv"]);
}

#[test]
fn a_verb_without_pictures_says_so_before_it_works() {
    let folder = Folder::with("lump.toml", LUMP);
    for verb in ["steady", "verify", "check", "explain", "units"] {
        let arguments: &[&str] = match verb {
            "explain" | "units" => &[verb, "--plot", "x.svg"],
            _ => &[verb, "lump.toml", "--plot", "x.svg"],
        };
        let ran = folder.run(arguments).exits(2).says("plot::nothing");
        assert_eq!(ran.out, "", "{verb} worked all the same");
    }
}
