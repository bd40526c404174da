//! `lptn fit step`: one exponential through each thermocouple of a record.

use crate::common;

use common::{Folder, GEARBOX, csv};

/// The paper's record (Figure 6): 25.5 to 92.7 degC with 13.5 min, over 25 min.
const T_I: f64 = 25.5;
const T_F: f64 = 92.7;
const T_RC: f64 = 810.0;

/// A record of the exact curve and of a bed that warms by 0.2 K, `decimals` as a logger prints
/// them.
fn record(length: f64, decimals: usize) -> String {
    let rows = (0..).map(|i| 5.0 * f64::from(i)).take_while(|t| *t <= length).map(|t| {
        let ring = T_F + (T_I - T_F) * (-t / T_RC).exp();
        let bed = 30.0 + 0.2 * t / length;
        format!("{t},{ring:.decimals$},{bed:.decimals$}\n")
    });
    "# made by a test\nt [s],ring [degC],bed [degC]\n".to_owned() + &rows.collect::<String>()
}

fn exact() -> Folder {
    Folder::with("record.csv", &record(1500.0, 12))
}

#[track_caller]
fn near(value: &serde_json::Value, expected: f64, unit: &str, relative: f64) {
    let found = value["value"].as_f64().unwrap_or_else(|| panic!("{value}"));
    assert!((found - expected).abs() <= relative * expected.abs(), "{found} is not {expected}");
    assert_eq!(value["unit"], unit);
}

#[test]
fn analytic_an_exact_exponential_is_found() {
    let json = exact()
        .run(&["fit", "step", "record.csv", "--column", "ring", "--format", "json"])
        .exits(0)
        .json();
    let ring = &json["columns"]["ring"];
    near(&ring["T_i"], T_I, "degC", 1e-8);
    near(&ring["T_f"], T_F, "degC", 1e-9);
    near(&ring["t_RC"], T_RC, "s", 1e-7);
    for name in ["T_i", "T_f", "t_RC"] {
        assert!(ring[name]["standard_error"].as_f64().unwrap() < 1e-6, "{ring}");
    }
    assert!(ring["rms"]["value"].as_f64().unwrap() < 1e-9 && ring["rms"]["unit"] == "K");
    assert_eq!((&json["format"], &json["network"]), (&1.into(), &serde_json::Value::Null));
    assert_eq!((&json["reference"], &json["record"]), (&"initial".into(), &"record.csv".into()));
    // 301 rows, 1500 s
    assert_eq!(ring["samples"], 301);
    assert!((ring["time_constants"].as_f64().unwrap() - 1500.0 / T_RC).abs() < 1e-6);
}

/// Equations 8 and 11 with the paper's numbers: 810 s / 2659 J/K = 0.3046 K/W, 67.2 K / 0.3046 K/W =
/// 220.6 W.
#[test]
fn analytic_the_papers_arithmetic() {
    let run = |more: &[&str]| {
        let verb =
            ["fit", "step", "record.csv", "--column", "ring", "--format", "json", "--capacity"];
        exact().run(&[&verb[..], more].concat()).exits(0).json()["columns"]["ring"].clone()
    };
    let ring = run(&["2659 J/K"]);
    near(&ring["R_eq"], 0.3046, "K/W", 2e-4);
    near(&ring["P_disp"], 220.6, "W", 2e-4);
    near(&ring["R_eq"], T_RC / 2659.0, "K/W", 1e-7);
    near(&ring["P_disp"], 2659.0 * (T_F - T_I) / T_RC, "W", 1e-7);
    assert_eq!(ring["P_disp"]["systematic_error"], 0.0);
    // P is proportional to the capacity: 5 % of the one are 5 % of the other
    let ring = run(&["2659 J/K ± 5 %"]);
    let systematic = ring["P_disp"]["systematic_error"].as_f64().unwrap();
    assert!((systematic / (0.05 * 220.6) - 1.0).abs() < 1e-3, "{systematic}");
    // the offset of a sensor drops out of a difference to itself, and not out of one to another
    // temperature: a limit of 3 K is a standard deviation of 3 K / sqrt(3)
    let ring = run(&["2659 J/K", "--sensor", "3 K"]);
    assert_eq!(ring["dT"]["systematic_error"], 0.0);
    let ring = run(&["2659 J/K", "--sensor", "3 K", "--reference", "25.5 degC"]);
    let offset = ring["dT"]["systematic_error"].as_f64().unwrap();
    assert!((offset - 3.0 / 3_f64.sqrt()).abs() < 1e-9, "{offset}");
}

#[test]
fn analytic_the_reference_is_what_is_said() {
    let rise = |reference: &str| {
        let verb =
            ["fit", "step", "record.csv", "--column", "ring", "--format", "json", "--reference"];
        let json = exact().run(&[&verb[..], &[reference]].concat()).exits(0).json();
        (json["reference"].clone(), json["columns"]["ring"]["dT"]["value"].as_f64().unwrap())
    };
    let close =
        |found: f64, expected: f64| assert!((found - expected).abs() < 1e-6, "{found} {expected}");
    let (name, found) = rise("initial");
    close(found, T_F - T_I);
    assert_eq!(name, "initial");
    // the mean of a bed that goes from 30.0 to 30.2 degC
    let (name, found) = rise("bed");
    close(found, T_F - 30.1);
    assert_eq!(name, "bed");
    let (name, found) = rise("20 degC");
    close(found, T_F - 20.0);
    assert_eq!(name, "value");
}

#[test]
fn the_table_fits_and_says_what_it_is_made_of() {
    let folder = Folder::with("record.csv", &record(1500.0, 1));
    let options = ["--capacity", "2659 J/K ± 5 %", "--sensor", "3 K", "--reference", "bed"];
    let ran = folder.run(&[&["fit", "step", "record.csv"][..], &options].concat()).exits(0);
    assert!(ran.out.lines().all(|line| line.chars().count() <= 80), "{}", ran.out);
    let ran = ran.prints("record.csv: 301 rows from 0 s to 1500 s").prints("the mean of `bed`");
    let ran =
        ran.prints("R_eq [K/W]").prints("P_disp [W]").prints("± random").prints("± systematic");
    let ran = ran.prints("C = 2659 ± 133 J/K").prints("--model FILE --port NODE");
    // the column that dT is counted from is not fitted
    assert!(!ran.out.lines().any(|line| line.starts_with("bed")), "{}", ran.out);
}

#[test]
fn a_short_record_is_said_to_be_extrapolated() {
    // 1.3 time constants: what is left of the rise is exp(-1.3)
    let folder = Folder::with("record.csv", &record(1.3 * T_RC, 12));
    let ran =
        folder.run(&["fit", "step", "record.csv", "--column", "ring", "--format", "json"]).exits(0);
    let ran = ran.says("fit::short").says("1.3 time constants long");
    let left = &ran.json()["columns"]["ring"]["extrapolated"];
    let last = 5.0 * (1.3_f64 * T_RC / 5.0).floor();
    near(left, 67.2 * (-last / T_RC).exp(), "K", 1e-6);
    let folder = Folder::with("record.csv", &record(4.0 * T_RC, 12));
    let ran =
        folder.run(&["fit", "step", "record.csv", "--column", "ring", "--format", "json"]).exits(0);
    assert_eq!(ran.json()["columns"]["ring"]["extrapolated"], serde_json::Value::Null);
    assert!(!ran.err.contains("fit::short"), "{}", ran.err);
}

#[test]
fn a_window_begins_a_curve_of_its_own() {
    let run = |options: &[&str]| {
        let verb = ["fit", "step", "record.csv", "--column", "ring", "--format", "json"];
        exact().run(&[&verb[..], options].concat()).exits(0).json()
    };
    let json = run(&["--from", "5 min", "--to", "20 min"]);
    let ring = &json["columns"]["ring"];
    // the same curve, its start moved along it
    near(&ring["T_i"], T_F + (T_I - T_F) * (-300.0 / T_RC).exp(), "degC", 1e-9);
    near(&ring["t_RC"], T_RC, "s", 1e-7);
    near(&json["from"], 300.0, "s", 0.0);
    near(&json["to"], 1200.0, "s", 0.0);
    exact().run(&["fit", "step", "record.csv", "--from", "1 h"]).exits(2).says("record::window");
    exact().run(&["fit", "step", "record.csv", "--from", "5 K"]).exits(2).says("units::");
}

#[test]
fn csv_has_a_row_for_each_column() {
    let ran = exact().run(&[
        "fit",
        "step",
        "record.csv",
        "--column",
        "ring",
        "--capacity",
        "2659 J/K",
        "--format",
        "csv",
    ]);
    let ran = ran.exits(0);
    let mut lines = ran.out.lines();
    let head = lines.next().unwrap();
    assert!(head.starts_with("column,T_i [degC],T_i_error [K],T_f [degC],"), "{head}");
    let numbers = ran.out.replace("ring,", "0,");
    let (names, rows) = csv(&numbers);
    let at = |name: &str| rows[0][names.iter().position(|n| n == name).unwrap()];
    assert!((at("T_i [degC]") - T_I).abs() < 1e-6 && (at("t_RC [s]") - T_RC).abs() < 1e-4);
    assert!((at("P_disp [W]") - 2659.0 * 67.2 / 810.0).abs() < 1e-4);
    assert_eq!(rows.len(), 1);
}

#[test]
fn wrong_input_ends_with_2() {
    let folder = exact();
    let step = |options: &[&str]| folder.run(&[&["fit", "step"][..], options].concat()).exits(2);
    step(&[]);
    folder.run(&["fit"]).exits(2);
    step(&["recrod.csv"]).says("input::cannot_read").says("did you mean record.csv?");
    step(&["record.csv", "--column", "rnig"])
        .says("record::no_column")
        .says("did you mean `ring`?");
    step(&["record.csv", "--reference", "bde"]).says("fit::reference").says("did you mean `bed`?");
    step(&["record.csv", "--column", "ring", "--reference", "bde"]).says("did you mean `bed`?");
    step(&["record.csv", "--reference", "20 W"]).says("units::");
    step(&["record.csv", "--capacity", "2659 J/kg"]).says("units::");
    step(&["record.csv", "--capacity", "-2659 J/K"]).says("fit::not_positive");
    step(&["record.csv", "--sensor", "3 degC"]).says("units::");
    step(&["record.csv", "--temperature-unit", "W"]).says("units::dimension");
    step(&["record.csv", "--model", "gearbox.toml"]).says("--port");
    folder.write("three.csv", "t [s],ring [degC]\n0,25\n1,26\n2,26.5\n");
    step(&["three.csv"]).says("fit::too_few_points").says("three.csv");
    folder.write("flat.csv", "t [s],ring [degC]\n0,25\n1,25\n2,25\n3,25\n4,25\n");
    step(&["flat.csv"]).says("record::constant").says("fit::no_column");
    step(&["flat.csv", "--column", "ring"]).says("fit::flat");
    folder.write("unit.csv", "t [s];ring °C;lid in °C\n0;25;20\n1;26;21\n2;27;22\n");
    step(&["unit.csv"])
        .says("fit::no_column")
        .says("--unit \"ring °C=degC\" --unit \"lid in °C=degC\"");
    folder.write("bad.csv", "t [s],ring\n0,25\n");
    step(&["bad.csv"]).says("record::no_unit").says("`ring [degC]`");
}

#[test]
fn what_has_no_time_constant_ends_with_3_and_prints_no_number() {
    let folder = exact();
    // a straight line bends nowhere
    let rows = |i: i32| {
        format!(
            "{i},{},{}\n",
            25.0 + 0.5 * f64::from(i),
            T_F + (T_I - T_F) * (-f64::from(i) / 10.0).exp()
        )
    };
    let text =
        "t [s],line [degC],ring [degC]\n".to_owned() + &(0..40).map(rows).collect::<String>();
    folder.write("line.csv", &text);
    let ran = folder.run(&["fit", "step", "line.csv", "--column", "line"]).exits(3);
    assert!(ran.out.is_empty() && ran.err.contains("fit::"), "{}{}", ran.out, ran.err);
    // what could be fitted is kept
    let ran = folder.run(&["fit", "step", "line.csv", "--format", "json"]).exits(3);
    let json = ran.json();
    assert!(json["columns"]["line"]["error"].as_str().unwrap().starts_with("fit::"), "{json}");
    near(&json["columns"]["ring"]["t_RC"], 10.0, "s", 1e-6);
}

/// A network of one node is its own exponential: no bias. The paper's gearbox has two.
#[test]
fn analytic_the_bias_of_a_model_stands_apart() {
    let folder = exact();
    let one = "format = 1\n[node]\nblock = { T0 = \"25.5 degC\", C = \"2659 J/K\" }\n[boundary]\n\
               air = { T = \"25.5 degC\" }\n[resistor]\nskin = { from = \"block\", to = \"air\", R \
               = \"0.3 K/W\" }\n\
               [source]\nP = { into = \"block\", P = \"220 W\" }\n";
    folder.write("one.toml", one);
    folder.write("gearbox.toml", GEARBOX);
    let run = |file: &str, port: &str| {
        let verb = ["fit", "step", "record.csv", "--column", "ring", "--format", "json"];
        let json =
            folder.run(&[&verb[..], &["--model", file, "--port", port]].concat()).exits(0).json();
        json["model"].clone()
    };
    let model = run("one.toml", "block");
    near(&model["t_RC"]["network"], 2659.0 * 0.3, "s", 1e-12);
    near(&model["t_RC"]["fitted"], 2659.0 * 0.3, "s", 1e-5);
    near(&model["T_f"]["fitted"], 25.5 + 66.0, "degC", 1e-5);
    assert!(model["P"]["bias"]["value"].as_f64().unwrap().abs() < 0.01, "{model}");
    // C_sum R_eq = 2659 J/K (1.7 K + 65.5 K) / 220.6 W = 810.0 s; one exponential through its steel
    // finds less
    let model = run("gearbox.toml", "steel");
    near(&model["t_RC"]["network"], 2659.0 * 67.2 / 220.6, "s", 1e-9);
    let bias = model["t_RC"]["bias"]["value"].as_f64().unwrap();
    assert!((-25.0..-10.0).contains(&bias), "{bias}");
    let verb =
        ["fit", "step", "record.csv", "--column", "ring", "--model", "gearbox.toml", "--port"];
    let ran = folder.run(&[&verb[..], &["steel"]].concat()).exits(0);
    ran.prints("bias of the method on gearbox.toml at `steel`").prints("one exponential");
    folder.run(&[&verb[..], &["stele"]].concat()).exits(2).says("did you mean `steel`?");
    folder.run(&[&verb[..], &["bed"]].concat()).exits(2).says("reduce::boundary_port");
}

#[test]
fn gaps_and_a_sensor_at_its_end_are_said() {
    let text = record(1500.0, 2).replace("\n100,", "\n100,,30.0\n101,");
    let folder = Folder::with("record.csv", &text);
    let ran =
        folder.run(&["fit", "step", "record.csv", "--column", "ring", "--format", "json"]).exits(0);
    let ran = ran.says("record::gaps");
    assert_eq!(ran.json()["columns"]["ring"]["gaps"], 1);
    // an instrument that goes no further than 80 degC
    let text: String = record(2400.0, 1)
        .lines()
        .map(|line| match line.split(',').collect::<Vec<_>>().as_slice() {
            [t, ring, bed] if ring.parse::<f64>().is_ok_and(|ring| ring > 80.0) => {
                format!("{t},80.0,{bed}\n")
            }
            _ => format!("{line}\n"),
        })
        .collect();
    folder.write("saturated.csv", &text);
    let ran =
        folder.run(&["fit", "step", "saturated.csv", "--column", "ring"]).says("record::saturated");
    assert_eq!(ran.code, Some(2), "{}", ran.err);
    ran.says("fit::saturated");
    // before it gets there all is well
    folder.run(&["fit", "step", "saturated.csv", "--column", "ring", "--to", "20 min"]).exits(0);
}

/// A record that heats and then cools was told to be longer, one that begins to heat after five
/// minutes to have a second exponential.
#[test]
fn a_record_that_is_not_one_step_is_told_where_to_cut_it() {
    let heats = |t: f64| 80.0 - 55.0 * (-t / 400.0).exp();
    let write = |value: &dyn Fn(f64) -> f64| {
        let row = |i: u32| {
            let t = 10.0 * f64::from(i);
            let saw = 0.02 * f64::from(i % 3) - 0.02;
            format!("{t},{:.3}\n", value(t) + saw)
        };
        format!("t [s],ring [degC]\n{}", (0..240).map(row).collect::<String>())
    };
    let cools = |t: f64| {
        if t < 1200.0 {
            heats(t)
        } else {
            25.0 + (heats(1200.0) - 25.0) * (-(t - 1200.0) / 400.0).exp()
        }
    };
    let folder = Folder::with("cools.csv", &write(&cools));
    let ran = folder.run(&["fit", "step", "cools.csv", "--column", "ring"]);
    ran.says("it turns back at 1200 s").says("--to \"1200 s\" or --from \"1200 s\"");
    let late = |t: f64| heats((t - 300.0).max(0.0));
    folder.write("late.csv", &write(&late));
    let ran = folder.run(&["fit", "step", "late.csv", "--column", "ring"]);
    ran.says("fit::late_start").says("--from \"300 s\"");
    let ran = folder.run(&["fit", "step", "late.csv", "--column", "ring", "--from", "300 s"]);
    assert!(!ran.err.contains("late_start"), "{}", ran.err);
}

/// scipy.optimize.curve_fit (1.x, Levenberg-Marquardt of MINPACK) on the same rows: T_i 25.39027054
/// degC, T_f 92.718064 degC, t_RC 809.78630586 s, and rms 0.10615620 K.
#[test]
fn reference_the_fit_is_that_of_scipy() {
    let text = include_str!("../../../docs/records/synthetic_ring.csv");
    let folder = Folder::with("record.csv", text);
    let json = folder
        .run(&["fit", "step", "record.csv", "--column", "ring", "--format", "json"])
        .exits(0)
        .json();
    let ring = &json["columns"]["ring"];
    near(&ring["T_i"], 25.390_270_54, "degC", 1e-7);
    near(&ring["T_f"], 92.718_064, "degC", 1e-8);
    near(&ring["t_RC"], 809.786_305_86, "s", 1e-6);
    near(&ring["rms"], 0.106_156_196, "K", 1e-7);
    // the error for independent samples, sqrt(diag(pcov)) of scipy
    for (name, error) in [("T_i", 0.014_092_84), ("T_f", 0.032_967_47), ("t_RC", 0.888_064_54)] {
        let naive = ring[name]["naive_standard_error"].as_f64().unwrap();
        assert!((naive / error - 1.0).abs() < 1e-4, "{name}: {naive}");
        assert!(ring[name]["standard_error"].as_f64().unwrap() > 2.0 * naive);
    }
}

#[test]
fn a_record_from_stdin_is_fitted() {
    let folder = Folder::empty();
    let ran =
        folder.run_with(&["fit", "step", "-", "--column", "ring"], &record(1500.0, 2)).exits(0);
    ran.prints("<stdin>: 301 rows");
}

/// Regression: a jump between two samples was printed as measured, and so was a bump that leads
/// nowhere.
#[test]
fn regression_a_record_that_tells_no_time_constant_ends_with_3() {
    let text = |curve: &dyn Fn(f64) -> f64| {
        let rows = (0..301).map(|i| 5.0 * f64::from(i)).map(|t| format!("{t},{:.3}\n", curve(t)));
        "t [s],a [degC]\n".to_owned() + &rows.collect::<String>()
    };
    let noise = |t: f64| 0.1 * (2.0 * (1e4 * (1.0 + t).sin()).rem_euclid(1.0) - 1.0);
    let folder = Folder::empty();
    // the second sample is 0.2 K short of 80 degC: a time constant of 5 s / ln(60 / 0.2)
    let jump = |t: f64| {
        80.0 - 60.0 * f64::from(u8::from(t < 2.0))
            - 0.2 * f64::from(u8::from((2.0..8.0).contains(&t)))
            + noise(t) / 10.0
    };
    folder.write("jump.csv", &text(&jump));
    folder.write("late.csv", &text(&|t| if t < 750.0 { 20.0 } else { 80.0 } + noise(t)));
    folder.write("noise.csv", &text(&|t| 20.0 + noise(t)));
    // up and down again, which leads nowhere
    folder.write("bump.csv", &text(&|t| 20.0 + 60.0 * (-((t - 750.0) / 250.0).powi(2)).exp()));
    for name in ["jump.csv", "late.csv", "noise.csv", "bump.csv"] {
        let ran = folder.run(&["fit", "step", name, "--capacity", "2659 J/K"]).exits(3);
        assert!(ran.out.is_empty(), "{name}: {}", ran.out);
        assert!(
            ran.err.contains("fit::undetermined") || ran.err.contains("fit::no_curvature"),
            "{}",
            ran.err
        );
    }
    let ran = folder.run(&["fit", "step", "jump.csv"]).exits(3);
    ran.says("fit::undetermined").says("shorter than the distance of the samples");
}

/// Regression: the negative power of a record that cools was printed without a word.
#[test]
fn regression_a_record_that_cools_has_no_dissipation() {
    let rows = (0..301).map(|i| 5.0 * f64::from(i));
    let rows = rows.map(|t| format!("{t},{:.2}\n", 20.0 + 60.0 * (-t / 300.0).exp()));
    let text = "t [s],a [degC]\n".to_owned() + &rows.collect::<String>();
    let folder = Folder::with("cool.csv", &text);
    let run =
        |more: &[&str]| folder.run(&[&["fit", "step", "cool.csv"][..], more].concat()).exits(0);
    run(&["--capacity", "2659 J/K"])
        .says("fit::cooling")
        .says("the record cools")
        .says("is not a dissipation");
    // without a capacity there is no power, and above 10 degC it is one
    for more in [&[][..], &["--capacity", "2659 J/K", "--reference", "10 degC"]] {
        let ran = run(more);
        assert!(!ran.err.contains("fit::cooling"), "{}", ran.err);
    }
    let heated =
        ["fit", "step", "record.csv", "--column", "ring", "--capacity", "2659 J/K", "--reference"];
    let ran = exact().run(&[&heated[..], &["100 degC"]].concat()).exits(0);
    ran.says("fit::cooling").says("T_f is below the reference");
}

/// Regression: numbers that are known to ten digits made tables of 100 letters.
#[test]
fn regression_the_table_of_an_exact_record_fits() {
    let kelvin: String = record(1500.0, 7)
        .replace("[degC]", "[K]")
        .lines()
        .map(|line| match line.split(',').collect::<Vec<_>>().as_slice() {
            [t, ring, bed] if ring.parse::<f64>().is_ok() => {
                let ring: f64 = ring.parse().unwrap_or(f64::NAN);
                format!("{t},{:.7},{bed}\n", ring + 273.15)
            }
            _ => format!("{line}\n"),
        })
        .collect();
    for text in
        [record(1500.0, 12), record(1500.0, 8), record(1500.0, 5), record(1500.0, 2), kelvin]
    {
        let folder = Folder::with("record.csv", &text);
        let ran = folder.run(&[
            "fit",
            "step",
            "record.csv",
            "--column",
            "ring",
            "--capacity",
            "2659 J/K",
        ]);
        let ran = ran.exits(0).prints("length/t_RC").prints("n_eff/n");
        assert!(ran.out.lines().all(|line| line.chars().count() <= 80), "{}", ran.out);
        let ran = ran.says("1.85 time constants long").says("measure for 3 time constants");
        assert!(!ran.err.contains("no interval is taken narrower"), "{}", ran.err);
    }
}

/// Regression: with --from the heat was that of what is left of the step, and the bias that of the
/// network's start. SciPy's fit of the closed form of the gearbox from 900 s on: t_RC 793.9526 s,
/// which is 16.0 s too little, T_f exact.
#[test]
fn regression_a_record_that_is_cut_is_told() {
    let folder =
        Folder::with("record.csv", include_str!("../../../docs/records/synthetic_ring.csv"));
    folder.write("gearbox.toml", GEARBOX);
    let verb = [
        "fit",
        "step",
        "record.csv",
        "--column",
        "ring",
        "--capacity",
        "2659 J/K",
        "--format",
        "json",
    ];
    let run = |more: &[&str]| folder.run(&[&verb[..], more].concat()).exits(0);
    let model = ["--model", "gearbox.toml", "--port", "steel"];
    let ran = run(&[&["--from", "900 s"][..], &model].concat())
        .says("fit::cut")
        .says("--reference \"25.5 degC\"");
    let json = ran.says("P_disp is not the heat").json();
    let bias = |name: &str| json["model"][name]["bias"]["value"].as_f64().unwrap();
    assert!((bias("t_RC") + 16.042).abs() < 0.01, "{}", bias("t_RC"));
    assert!(bias("T_f").abs() < 5e-4, "{}", bias("T_f"));
    assert!(bias("T_i").abs() < 5e-4, "{}", bias("T_i"));
    // all of the step over t_RC: 2659 J/K x 67.2 K / 793.9526 s, less 220.6 W
    assert!((bias("P") - 4.457).abs() < 0.01, "{}", bias("P"));
    for more in [&[][..], &["--from", "0 s"], &["--from", "900 s", "--reference", "25.5 degC"]] {
        let ran = run(more);
        assert!(!ran.err.contains("fit::cut"), "{}", ran.err);
    }
}
