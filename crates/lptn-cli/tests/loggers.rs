//! Files of loggers, from the file to the answer.

use crate::common;

use common::Folder;

/// The paper's record as a German logger writes it: a title, semicolons, decimal commas, dates over
/// midnight. Its fit has the same bytes as that of the record in lptn's own form.
#[test]
fn a_loggers_file_is_fitted_as_its_record() {
    let curve = |t: f64| 92.7 - 67.2 * (-t / 810.0).exp();
    let rows = (0..300).map(|i| 5.0 * f64::from(i));
    let rows: String = rows.map(|t| format!("{t},{:.3},30.1\n", curve(t))).collect();
    let plain = format!("t [s],ring [degC],bed [degC]\n{rows}");
    let date = |time: f64| {
        let second = 86_400 - 600 + time as u32;
        let (day, of_day) = (3 + second / 86_400, second % 86_400);
        let (hour, minute) = (of_day / 3600, of_day / 60 % 60);
        format!("{day:02}.05.2026 {hour:02}:{minute:02}:{:02}", of_day % 60)
    };
    let mut logged = "Erw\u{e4}rmung;;\r\nDatum/Zeit;ring (\u{b0}C);bed (\u{b0}C)\r\n".to_owned();
    for line in plain.lines().skip(1) {
        let (time, values) = line.split_once(',').unwrap();
        let values: Vec<String> = values.split(',').map(|v| v.replace('.', ",")).collect();
        logged += &format!("{};{}\r\n", date(time.parse().unwrap()), values.join(";"));
    }
    let bytes: Vec<u8> = logged.chars().map(|c| u8::try_from(c).unwrap()).collect();
    let folder = Folder::with("record.csv", &plain);
    std::fs::write(folder.path().join("logged.csv"), bytes).unwrap();
    let fit = |name: &str| {
        folder.run(&["fit", "step", name, "--column", "ring", "--format", "json"]).exits(0)
    };
    let [own, foreign] = ["record.csv", "logged.csv"].map(|name| fit(name).json());
    assert_eq!(own["columns"], foreign["columns"]);
    let said = fit("logged.csv").err;
    let note = "`;` between columns, decimal commas, encoding Windows-1252, one line above the \
                header left out, 0 s at 03.05.2026 23:50:00";
    assert_eq!(said.matches(note).count(), 1, "{said}");
}

/// The manifest has the hash of the file as it is on the disk, whatever its encoding. Expected:
/// `sha256sum`.
#[test]
fn the_manifest_has_the_hash_of_the_file() {
    let netlist = r#"
format = 1

[node]
a = { C = "1 J/K", T0 = "20 degC" }

[boundary]
air = { T = "20 degC" }

[signal]
p = { csv = "p.csv", time = "t", value = "Wärme" }

[source]
q = { into = "a", P = "p" }

[resistor]
r = { from = "a", to = "air", R = "1 K/W" }

[run]
stop = "10 s"
"#;
    let folder = Folder::with("a.toml", netlist);
    std::fs::write(folder.path().join("p.csv"), b"t [s];W\xe4rme [W]\n0;1,5\n60;2,5\n").unwrap();
    folder.run(&["run", "a.toml"]).exits(0);
    let sum = "eeae65bd369c1c0568c59abaef5470a6ed4470df46ed08cc06cff56167c0d216";
    let manifest = folder.read("out/a/manifest.json");
    assert!(manifest.contains(sum), "{manifest}");
}

/// A command settles by its options what a file does not show.
#[test]
fn options_say_what_a_file_does_not_show() {
    let rows: String =
        (0..60).map(|i| format!("{:02}/02/2026,{:.3}\n", 1 + i % 12, f64::from(i))).collect();
    let folder = Folder::with("r.csv", &format!("Date,ring (C)\n{}", &rows[..12 * 18]));
    folder.run(&["fit", "step", "r.csv"]).exits(2).says("record::dates").says("`C` is the unit");
    let told = folder.run(&["fit", "step", "r.csv", "--dates", "day first", "--unit", "ring=degC"]);
    told.says("0 s at 01/02/2026");
    folder.run(&["fit", "step", "r.csv", "--unit", "ring"]).exits(2).says("`--unit ring=degC`");
}

/// `2,500` is 2.5 or 2500: the tables of `fit law` and of `compare --parts` are refused, and read with
/// the option that the message names. A column without a unit gets one by `--unit`.
#[test]
fn tables_take_a_decimal_sign_and_units() {
    let points = "omega [rpm];P\n1000;2,500\n2000;7,937\n3000;15,601\n4000;25,198\n5000;36,555\n";
    let folder = Folder::with("points.csv", points);
    let law = ["fit", "law", "points.csv", "--no-files", "--unit", "P=W"];
    let refused = folder.run(&law).exits(2);
    assert!(refused.err.contains("--decimal ,"), "{}", refused.err);
    // P = 2.5 W (omega/1000 rpm)^(5/3)
    let read = folder.run(&[&law[..], &["--decimal", ",", "--format", "json"]].concat()).exits(0);
    let best = &read.json()["laws"][0];
    assert_eq!(best["law"], "omega^(5/3)");
    let alpha = best["coefficients"][0]["value"].as_f64().unwrap();
    let exact = 2.5 / (1000.0 * std::f64::consts::PI / 30.0_f64).powf(5.0 / 3.0);
    assert!((alpha / exact - 1.0).abs() < 1e-3, "{alpha} is not {exact}");

    let netlist = r#"
format = 1
[param]
R_sink = "1 K/W"
[boundary]
air = { T = "20 degC" }
[node]
chip = { C = "10 J/K", T0 = "20 degC" }
[resistor]
sink = { from = "chip", to = "air", R = "R_sink" }
[source]
heat = { into = "chip", P = "20 W" }
[limit]
hot = { of = "chip.T", below = "90 degC" }
[run]
stop = "1 h"
"#;
    folder.write("chip.toml", netlist);
    folder.write("sinks.csv", "part;R_sink\nA;1,500\nB;2,900\n");
    let compare = ["compare", "chip.toml", "--parts", "sinks.csv", "--unit", "R_sink=K/W"];
    folder.run(&compare).exits(2);
    let read = folder.run(&[&compare[..], &["--decimal", ",", "--format", "json"]].concat());
    let peaks: Vec<f64> = read.exits(0).json()["rows"]
        .as_array()
        .unwrap()
        .iter()
        .map(|row| row[6].as_f64().unwrap())
        .collect();
    // 20 degC + 20 W R
    assert!(peaks.iter().any(|peak| (peak - 50.0).abs() < 1e-3), "{peaks:?}");
    assert!(peaks.iter().any(|peak| (peak - 78.0).abs() < 1e-3), "{peaks:?}");
}
