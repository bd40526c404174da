//! `lptn fit law FOLDER`
#![allow(clippy::unwrap_used, reason = "a test fails by panicking, in its helpers too")]

use crate::common;

use common::Folder;

const SHIPPED: &str =
    concat!(env!("CARGO_MANIFEST_DIR"), "/../../networks/records/synthetic_gearbox");

/// A record of one exponential with rise 20 K x (rpm / 1000)^2 and t_RC 100 s, and a ripple that no
/// fit can follow.
fn record(comment: &str, rpm: f64) -> String {
    let mut text = format!("{comment}t [s],ring [degC],bed [degC]\n");
    for i in 0..400 {
        let t = f64::from(i);
        let ripple = 0.05 * f64::from(i * 37 % 11 - 5);
        let rise = 20.0 * (rpm / 1000.0).powi(2) * (1.0 - f64::exp(-t / 100.0));
        text += &format!("{t},{:.4},{:.4}\n", 25.0 + rise + ripple, 25.0 + 0.1 * rise - ripple);
    }
    text
}

fn folder(names: &[(&str, &str, f64)]) -> Folder {
    let folder = Folder::empty();
    std::fs::create_dir(folder.path().join("records")).unwrap();
    for (name, comment, rpm) in names {
        folder.write(&format!("records/{name}"), &record(comment, *rpm));
    }
    folder
}

const RUN: [&str; 5] = ["fit", "law", "records", "--capacity", "1 kJ/K ± 2 %"];

/// Seven speeds, found in names, comments and a sheet.
fn whole() -> Folder {
    let folder = folder(&[
        ("1000rpm.csv", "", 1000.0),
        ("b.csv", "# omega = 2000 rpm\n", 2000.0),
        ("c.csv", "", 3000.0),
        ("d_4000_rpm.csv", "", 4000.0),
        ("e.csv", "# speed: 5000 rpm\n# first try\n", 5000.0),
        ("f.csv", "", 6000.0),
        ("g.csv", "", 7000.0),
    ]);
    folder.write("records/runs.csv", "file,omega [rpm]\nc.csv,3000\nf.csv,6000\ng.csv,7000\n");
    folder
}

#[test]
fn records_become_points_and_files() {
    let folder = whole();
    let ran = folder.run(&RUN).exits(0).says("figure_9_power.csv");
    let wrote = ran.err.lines().skip_while(|line| !line.starts_with("wrote"));
    for line in ran.out.lines().chain(wrote) {
        assert!(line.chars().count() <= 80, "{line}");
    }
    let names = [
        "figure_7_rise.csv",
        "figure_8_time_constant.csv",
        "figure_9_power.csv",
        "laws.csv",
        "manifest.json",
        "slopes.csv",
    ];
    let written: Vec<String> =
        folder.files().into_iter().filter(|name| name.starts_with("out/")).collect();
    assert_eq!(written, names.map(|name| format!("out/records/{name}")));
    let manifest: serde_json::Value =
        serde_json::from_str(&folder.read("out/records/manifest.json")).unwrap();
    assert_eq!(manifest["inputs"].as_array().unwrap().len(), 8);
    assert_eq!(manifest["results"].as_array().unwrap().len(), 5);
    let power = folder.read("out/records/figure_9_power.csv");
    let head = power.lines().next().unwrap();
    assert!(
        head.starts_with("run,omega [rpm],dT [K],t_RC [min],P [W],P_sd [W],P_systematic [W],"),
        "{head}"
    );
    assert_eq!(power.lines().count(), 8);
    // P = C dT / t_RC = 1000 J/K x 20 K x 1 / 100 s at 1000 rpm, and 2 % of C are 2 % of P
    let first: Vec<&str> = power.lines().nth(1).unwrap().split(',').collect();
    assert_eq!(first[0], "1000rpm.csv");
    let number = |i: usize| first[i].parse::<f64>().unwrap();
    assert!((number(4) - 200.0).abs() < 2.0, "{}", number(4));
    assert!((number(6) / number(4) - 0.02).abs() < 1e-9);
}

#[test]
fn the_exponent_of_the_records_is_found() {
    let json = whole()
        .run(&[&RUN[..], &["--column", "ring", "--format", "json", "--no-files"]].concat())
        .exits(0)
        .json();
    let laws = json["laws"].as_array().unwrap();
    let free = laws.iter().find(|law| law["law"] == "omega^n").unwrap();
    assert!((free["coefficients"][1]["value"].as_f64().unwrap() - 2.0).abs() < 0.01);
    assert_eq!(json["consistency"]["derived"], true);
    assert_eq!(json["runs"].as_array().unwrap().len(), 7);
    let ring = &json["runs"][6]["columns"]["ring"];
    assert!((ring["dT"]["value"].as_f64().unwrap() - 980.0).abs() < 1.0);
    assert!((ring["t_RC"]["value"].as_f64().unwrap() - 100.0).abs() < 0.5);
    let systematic = json["systematic"].as_object().unwrap();
    assert!(systematic.values().all(|error| error["offset"].as_f64().unwrap() == 0.0));
}

#[test]
fn the_bed_as_reference_lowers_the_rise() {
    let reference = ["--reference", "bed", "--sensor", "3 K", "--no-files", "--format", "json"];
    let json = whole().run(&[&RUN[..], &reference].concat()).exits(0).json();
    // the bed's mean is 2 K x 49 x (1 - (1 - e^-3.99) 100 / 399) above its start
    let bed = 98.0 * (1.0 - (1.0 - f64::exp(-3.99)) / 3.99);
    let ring = &json["runs"][6]["columns"]["ring"];
    assert!((ring["dT"]["value"].as_f64().unwrap() - (980.0 - bed)).abs() < 1.0);
    assert_eq!(ring["reference"], "bed");
    assert!(json["runs"][6]["columns"]["bed"].is_null());
    let systematic = json["systematic"].as_object().unwrap();
    assert!(systematic.values().next().unwrap()["offset"].as_f64().unwrap() > 0.0);
}

/// dT = 20 K n^2, so that the line through the origin has 20 K sum n^3 / sum n^2 = 112 K in 1000 rpm,
/// a tenth of it for the bed; the time constant is 100 s at all speeds.
#[test]
fn lines_over_the_speed_have_intervals() {
    let words = [&RUN[..], &["--column", "ring", "--column", "bed", "--no-files"]].concat();
    let json = whole().run(&[&words[..], &["--format", "json"]].concat()).exits(0).json();
    let near = |found: &serde_json::Value, expected: f64, tolerance: f64| {
        let found = found.as_f64().unwrap();
        assert!((found - expected).abs() < tolerance, "{found} {expected}");
    };
    let rpm = std::f64::consts::TAU / 60.0;
    let [ring, bed] = ["ring", "bed"].map(|name| &json["slopes"]["columns"][name]);
    near(&ring["dT"]["value"], 0.112 / rpm, 2e-3);
    near(&bed["dT"]["value"], 0.0112 / rpm, 2e-3);
    assert_eq!(ring["dT"]["unit"], "K s/rad");
    near(&ring["dT_exponent"]["value"], 2.0, 0.01);
    near(&ring["t_RC"]["value"], 100.0, 0.5);
    assert!(ring["t_RC_slope"]["half_width_95"].as_f64().unwrap() > 0.0);
    let difference = &json["slopes"]["differences"][0];
    assert_eq!((&difference["of"], &difference["less"]), (&"ring".into(), &"bed".into()));
    near(&difference["dT"]["value"], 0.9 * 0.112 / rpm, 2e-3);
    let ran = whole().run(&words).exits(0);
    ran.prints("dT / omega [K/rpm]")
        .prints("differ ring less bed: dT 0.10")
        .prints("line   dT of ring");
}

#[test]
fn two_runs_have_a_mean_and_no_slope() {
    let folder = folder(&[("1000rpm.csv", "", 1000.0), ("2000rpm.csv", "", 2000.0)]);
    let words = [&RUN[..], &["--no-files", "--format", "json"]].concat();
    let json = folder.run(&words).exits(0).json();
    let ring = &json["slopes"]["columns"]["ring"];
    assert!(ring["dT"].is_null() && ring["t_RC_slope"].is_null() && ring["dT_exponent"].is_null());
    assert!((ring["t_RC"]["value"].as_f64().unwrap() - 100.0).abs() < 1.0);
}

#[test]
fn what_is_missing_is_said() {
    let folder = whole();
    folder.run(&["fit", "law", "records"]).exits(2).says("fit::law_capacity").says("--capacity");
    let with = |more: &[&str]| folder.run(&[&RUN[..], more, &["--no-files"]].concat()).exits(2);
    with(&["--column", "rign"]).says("did you mean `ring`?");
    with(&["--reference", "bde"]).says("did you mean `bed`?");
    with(&["--sensor", "3 W"]).says("units::dimension");
    let unknown = self::folder(&[("a.csv", "", 1000.0)]);
    unknown.run(&RUN).exits(2).says("fit::law_no_speed").says("# omega = 1000 rpm");
    let two = self::folder(&[("1000rpm.csv", "# omega = 2000 rpm\n", 1000.0)]);
    two.run(&RUN).exits(2).says("fit::law_two_speeds");
    self::folder(&[]).run(&RUN).exits(2).says("fit::law_no_records");
    let sheet = self::folder(&[("a.csv", "", 1000.0)]);
    sheet.write("records/runs.csv", "file,P [W]\na.csv,3\n");
    sheet.run(&RUN).exits(2).says("fit::law_runs");
}

/// The shipped records: the truth is stated in their README, and the study is judged in
/// `tests/synthetic_records.rs`.
#[test]
fn regression_a_speed_that_cannot_be_read_is_not_passed_over() {
    let hertz = folder(&[("1000rpm.csv", "# omega = 50 Hz\n", 1000.0)]);
    hertz.run(&RUN).exits(2).says("fit::law_comment").says("`# omega = 1000 rpm`");
    let bare = folder(&[("1000rpm.csv", "# omega = 1000\n", 1000.0)]);
    bare.run(&RUN).exits(2).says("fit::law_comment");
    let sheet = whole();
    sheet.write("records/runs.csv", "file,omega [rpm]\nc.csv,3000\nff.csv,6000\n");
    sheet.run(&RUN).exits(2).says("fit::law_runs").says("did you mean `f.csv`?");
    let two = folder(&[("1000rpm.csv", "# omega = 2000 rpm\n", 1000.0)]);
    two.run(&RUN).exits(2).says("2000 rpm, 1000 rpm");
}

#[test]
fn the_shipped_records_choose_their_law() {
    let ran =
        Folder::empty().run(&["fit", "law", SHIPPED, "--capacity", "2659 J/K ± 5 %", "--no-files"]);
    let ran = ran.exits(0).says("column `mill_bed` is left out");
    ran.prints("omega^(5/3) is best")
        .prints("proportional to the speed")
        .prints("systematic: capacity 4.3");
}

/// The step begins 60 s after the first row of two of seven records: one exponential from the first
/// row on has another time constant than 100 s, as in `lptn fit step`. A bed that follows the ring
/// by a tenth changes by a tenth of dT.
#[test]
fn a_folder_warns_of_what_one_record_warns() {
    let folder = whole();
    let warns = |ran: &common::Ran, code: &str| ran.err.contains(code);
    let plain = folder.run(&RUN).exits(0);
    assert!(!warns(&plain, "fit::late_start") && !warns(&plain, "fit::drift"), "{}", plain.err);
    let on_bed = folder.run(&[&RUN[..], &["--reference", "bed"]].concat());
    on_bed.exits(0).says("fit::drift").says("column `ring`").says("in 7 of 7 records");
    for (name, rpm) in [("1000rpm.csv", 1000.0), ("c.csv", 3000.0)] {
        let text = record("", rpm);
        let (head, rows) = text.split_once('\n').unwrap();
        // noise that is less than 2 % of the rise: a constant is the end of an instrument's range
        let noise = |t: i32| 0.05 * f64::from(t % 3);
        let still = (0..60).map(|t| format!("{t},{},{}\n", 24.75 + noise(t), 25.25 + noise(t)));
        let moved = rows.lines().map(|line| {
            let (time, values) = line.split_once(',').unwrap();
            format!("{},{values}\n", time.parse::<f64>().unwrap() + 60.0)
        });
        let text: String = still.chain(moved).collect();
        folder.write(&format!("records/{name}"), &format!("{head}\n{text}"));
    }
    let late = folder.run(&RUN).exits(0);
    late.says("fit::late_start").says("column `ring`").says("2 of 7 records").says("until 6");
    folder.run(&["fit", "step", "records/c.csv", "--column", "ring"]).says("fit::late_start");
}
