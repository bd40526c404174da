//! `lptn compare`: order, exit codes, numbers, formats.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common;

use common::Folder;

/// One node: 2000 J/K, R to air of 20 degC, 100 W, 1 h. The time constant is 2000 R.
fn candidate(resistance: &str, limits: &str) -> String {
    format!(
        "format = 1\ntitle = \"R {resistance}\"\n[param]\nP = \"100 W\"\n[node]\nblock = {{ T0 \
         = \"20 degC\", C = \"2000 J/K\" }}\n\
         [boundary]\nair = {{ T = \"20 degC\" }}\nbed = {{ T = \"20 degC\" }}\n[resistor]\n\
         to_air = {{ from = \"block\", to = \"air\", R = \"4 / 3 * {resistance} [K/W]\" }}\n\
         to_bed = {{ from = \"block\", to = \"bed\", R = \"4 * {resistance} [K/W]\" }}\n\
         [source]\nloss = {{ into = \"block\", P = \"P\" }}\n{limits}\n[run]\nstop = \"1 h\"\n"
    )
}

const LIMIT: &str = "[limit]\nhot = { of = \"block.T\", below = \"70 degC\" }";

/// Steady rises of 60, 40 and 48 K: the limit of 50 K is broken by the first.
fn three() -> Folder {
    let folder = Folder::empty();
    for (name, resistance) in [("a", "0.6"), ("b", "0.4"), ("c", "0.48")] {
        folder.write(&format!("{name}.toml"), &candidate(resistance, LIMIT));
    }
    folder
}

#[track_caller]
fn near(found: f64, expected: f64, tolerance: f64) {
    assert!((found - expected).abs() <= tolerance, "{found} is not {expected}");
}

/// The rows of a comparison as CSV, each cell by its header.
fn rows(text: &str) -> Vec<Vec<(String, String)>> {
    let mut reader = ::csv::Reader::from_reader(text.as_bytes());
    let headers: Vec<String> = reader.headers().unwrap().iter().map(str::to_owned).collect();
    let row = |row: ::csv::StringRecord| {
        headers.iter().cloned().zip(row.iter().map(str::to_owned)).collect()
    };
    reader.records().map(|record| row(record.unwrap())).collect()
}

fn number(row: &[(String, String)], name: &str) -> f64 {
    let cell = row
        .iter()
        .find(|(header, _)| header == name)
        .unwrap_or_else(|| panic!("no {name} in {row:?}"));
    cell.1.parse().unwrap()
}

#[test]
fn the_best_margin_comes_first_and_a_broken_limit_ends_with_1() {
    let ran = three().run(&["compare", "a.toml", "b.toml", "c.toml"]).exits(1);
    let lines: Vec<&str> =
        ran.out.lines().skip_while(|line| !line.starts_with("T [degC]")).collect();
    assert!(
        lines[1].starts_with("b ") && lines[2].starts_with("c ") && lines[3].starts_with("a "),
        "{}",
        ran.out
    );
    assert_eq!(ran.err.lines().last(), Some("limit broken: a breaks hot"));
    assert!(ran.out.lines().all(|line| line.chars().count() <= 80), "{}", ran.out);
}

#[test]
fn numbers_are_those_of_the_closed_form() {
    let folder = three();
    let ran = folder.run(&["compare", ".", "--format", "csv"]).exits(1);
    for (row, resistance) in rows(&ran.out).iter().zip([0.4, 0.48, 0.6]) {
        let (rise, tau) = (100.0 * resistance, 2000.0 * resistance);
        let peak = rise * (1.0 - f64::exp(-3600.0 / tau));
        // the tolerance of the runs is 1e-5 K, and their error at most ten times that
        near(number(row, "peak [degC]"), 20.0 + peak, 1e-4);
        near(number(row, "worst_margin [K]"), 50.0 - peak, 1e-4);
        near(number(row, "hot.margin [K]"), 50.0 - peak, 1e-4);
        near(number(row, "peak_at [s]"), 3600.0, 0.0);
        near(number(row, "steady [degC]"), 20.0 + rise, 1e-9);
        near(number(row, "time_to_95 [s]"), tau * f64::ln(20.0), 0.1);
        near(number(row, "capacity [J/K]"), 2000.0, 0.0);
        // of 360 kJ what 2000 J/K keep; the rest through 4/3 R and 4 R in parallel
        let stored = 2000.0 * peak / 360e3;
        near(number(row, "heat [J]"), 360e3, 1e-3);
        near(number(row, "stored [-]"), stored, 1e-6);
        near(number(row, "air.share [-]"), 0.75 * (1.0 - stored), 1e-6);
        near(number(row, "bed.share [-]"), 0.25 * (1.0 - stored), 1e-6);
        let broken = number(row, "hot.broken_at [s]");
        if rise > 50.0 {
            near(broken, -tau * f64::ln(1.0 - 50.0 / rise), 0.05);
        } else {
            assert!(broken.is_nan());
        }
    }
}

#[test]
fn json_has_the_columns_and_rows_of_the_csv() {
    let folder = three();
    let text = folder.run(&["compare", ".", "--format", "csv"]).out;
    let json = folder.run(&["compare", ".", "--format", "json"]).exits(1).json();
    let columns = json["columns"].as_array().unwrap().iter().map(|column| {
        let name = column["name"].as_str().unwrap();
        column["unit"].as_str().map_or(name.to_owned(), |unit| format!("{name} [{unit}]"))
    });
    let headers: Vec<String> = columns.collect();
    for (row, object) in rows(&text).iter().zip(json["rows"].as_array().unwrap()) {
        assert_eq!(row.iter().map(|(header, _)| header.clone()).collect::<Vec<_>>(), headers);
        for ((_, cell), value) in row.iter().zip(object.as_array().unwrap()) {
            match value {
                serde_json::Value::String(text) => assert_eq!(cell, text),
                serde_json::Value::Null => assert_eq!(cell, "NaN"),
                value => {
                    assert_eq!(
                        cell.parse::<f64>().unwrap().to_bits(),
                        value.as_f64().unwrap().to_bits()
                    )
                }
            }
        }
    }
    assert_eq!(rows(&text).len(), 3);
}

#[test]
fn the_number_of_threads_changes_no_byte() {
    let folder = Folder::empty();
    for i in 0..9 {
        folder.write(&format!("n{i}.toml"), &candidate(&format!("0.{}", 1 + i), LIMIT));
    }
    folder.write("broken.toml", "format = 1\n[nod]\n");
    for format in ["table", "csv", "json"] {
        let of = |threads: &str| {
            folder.run(&["compare", ".", "--format", format, "--threads", threads]).exits(2)
        };
        let (one, four) = (of("1"), of("4"));
        assert_eq!(one.out, four.out);
        assert_eq!(one.err, four.err);
    }
}

#[test]
fn a_broken_candidate_is_named_and_stops_no_other() {
    let folder = three();
    folder.write("d.toml", &candidate("0.4", LIMIT).replace("to = \"bed\"", "to = \"bde\""));
    let ran = folder.run(&["compare", "a.toml", "d.toml", "missing.toml", "b.toml"]).exits(2);
    let ran = ran.says("netlist::unknown_node").says("cannot read missing.toml").prints("not read");
    assert_eq!(ran.err.lines().last(), Some("not read: d, missing"));
    let table = folder.run(&["compare", "d.toml", "b.toml", "--format", "csv"]).exits(2).out;
    assert_eq!(rows(&table)[0][0].1, "b.toml");
    assert_eq!(rows(&table)[1][2], ("status".into(), "netlist::unknown_node".into()));
    // numbers that fail come after input that is wrong, and before limits
    let fails = "P = \"100 [W] * (2 - t / 500 [s])^0.5\"";
    folder.write("e.toml", &candidate("0.4", "").replace("P = \"P\"", fails));
    let ran = folder.run(&["compare", "a.toml", "e.toml"]).exits(3);
    assert_eq!(ran.err.lines().last(), Some("failed: e"));
    folder.run(&["compare", "a.toml", "e.toml", "d.toml"]).exits(2);
}

#[test]
fn a_warning_changes_no_exit_code() {
    let folder = three();
    folder.write(
        "a.toml",
        &candidate("0.6", &LIMIT.replace("degC\" }", "degC\", severity = \"warning\" }")),
    );
    folder
        .run(&["compare", "."])
        .exits(0)
        .prints("warning")
        .says("all candidates keep their limits");
}

#[test]
fn without_limits_the_coolest_comes_first() {
    let folder = Folder::empty();
    for (name, resistance) in [("a", "0.6"), ("b", "0.4"), ("c", "0.48")] {
        folder.write(&format!("{name}.toml"), &candidate(resistance, ""));
    }
    let files = |arguments: &[&str]| {
        let ran = folder.run(&[&["compare", ".", "--format", "csv"], arguments].concat()).exits(0);
        rows(&ran.out).iter().map(|row| row[0].1.clone()).collect::<String>()
    };
    assert_eq!(files(&[]), "./b.toml./c.toml./a.toml");
    assert_eq!(files(&["--sort", "given"]), "./a.toml./b.toml./c.toml");
    assert_eq!(files(&["--sort", "time"]), "./a.toml./c.toml./b.toml");
}

#[test]
fn every_order_has_its_name() {
    let folder = three();
    for key in ["margin", "peak", "steady", "time", "capacity", "given"] {
        folder.run(&["compare", ".", "--sort", key]).exits(1);
    }
    folder
        .run(&["compare", ".", "--sort", "beauty"])
        .exits(2)
        .says("possible values: margin, peak");
}

#[test]
fn without_a_run_candidates_are_compared_in_steady_state() {
    let folder = Folder::empty();
    let steady = candidate("0.6", LIMIT).replace("[run]\nstop = \"1 h\"\n", "");
    folder.write("s.toml", &steady);
    let ran = folder.run(&["compare", "s.toml", "--format", "csv"]).exits(1);
    let row = &rows(&ran.out)[0];
    near(number(row, "peak [degC]"), 80.0, 1e-9);
    near(number(row, "hot.margin [K]"), -10.0, 1e-9);
    assert!(number(row, "peak_at [s]").is_nan());
}

#[test]
fn set_reaches_every_candidate_that_has_the_parameter() {
    let folder = three();
    folder.write(
        "c.toml",
        &candidate("0.48", LIMIT)
            .replace("[param]\nP = \"100 W\"\n", "")
            .replace("\"P\"", "\"100 W\""),
    );
    let ran = folder.run(&["compare", ".", "--set", "P=50 W", "--format", "csv"]).exits(0);
    let (headers, all) =
        (rows(&ran.out), [("./b.toml", 40.0), ("./a.toml", 50.0), ("./c.toml", 68.0)]);
    for (row, (file, steady)) in headers.iter().zip(all) {
        assert_eq!(row[0].1, file);
        near(number(row, "steady [degC]"), steady, 1e-9);
    }
    folder
        .run(&["compare", ".", "--set", "Q=50 W"])
        .exits(2)
        .says("no candidate has a parameter `Q`");
    folder.run(&["compare", ".", "--set", "P=50 K"]).exits(2).says("units::dimension");
}

#[test]
fn a_folder_without_netlists_is_a_mistake() {
    Folder::empty().run(&["compare", "."]).exits(2).says("there is no netlist in the folder .");
    Folder::empty().run(&["compare"]).exits(2);
}

#[test]
fn twenty_candidates_fit_the_terminal() {
    let folder = Folder::empty();
    for i in 0..20 {
        let boundaries = "gearbox_side_plate_upper = { T = \"20 degC\" }\nbed";
        let text =
            candidate(&format!("0.{}", 20 + i), LIMIT).replace("\nbed", &format!("\n{boundaries}"));
        folder.write(&format!("candidate_with_a_long_name_number_{i}.toml"), &text);
    }
    let ran = folder.run(&["compare", "."]).exits(0);
    assert!(ran.out.lines().all(|line| line.chars().count() <= 80), "{}", ran.out);
}

#[test]
fn the_mass_is_shown_where_every_material_is_known() {
    let folder = three();
    let without = folder.run(&["compare", ".", "--format", "csv"]).out;
    assert!(!without.contains("mass"));
    let steel = candidate("0.4", LIMIT)
        .replace("C = \"2000 J/K\"", "material = \"steel_8620\", mass = \"4 kg\"");
    folder.write("b.toml", &steel);
    let ran = folder.run(&["compare", ".", "--format", "csv"]).exits(1);
    let all = rows(&ran.out);
    near(number(&all[0], "mass [kg]"), 4.0, 1e-12);
    // 475 J/(kg K), as the seed paper has it
    near(number(&all[0], "capacity [J/K]"), 1900.0, 1e-9);
    assert!(number(&all[1], "mass [kg]").is_nan());
    folder.run(&["compare", "."]).exits(1).prints("m [kg]");
}

/// 100 W into a block that a stream of 4 W/K and a path of 1 W/K cool to 20 degC: it stands at
/// 40 degC, and 80 W leave with the stream. Over an hour the block keeps 2 kJ of 360 kJ, and as its
/// time constant is 20 s the rest leaves as it would in 3580 s.
#[test]
fn regression_what_streams_carry_away_is_a_share_of_the_heat() {
    let open = "format = 1\n[node]\nblock = { T0 = '20 degC', C = '100 J/K' }\n[boundary]\n\
                air = { T = '20 degC' }\ntap = { T = '20 degC' }\n[resistor]\n\
                skin = { from = 'block', to = 'air', G = '1 W/K' }\n[advection]\n\
                feed = { from = 'tap', to = 'block', mcp = '4 W/K' }\n[source]\n\
                loss = { into = 'block', P = '100 W' }\n";
    let run = format!("{open}[run]\nstop = '1 h'\n");
    let closed =
        open.replace("[source]", "back = { from = 'block', to = 'tap', mcp = '4 W/K' }\n[source]");
    let folder = Folder::empty();
    for (name, text) in [("a", open), ("b", &run), ("c", &closed)] {
        folder.write(&format!("{name}.toml"), text);
    }
    let ran = folder.run(&["compare", "a.toml", "b.toml", "c.toml", "--format", "csv"]).exits(0);
    let found = rows(&ran.out);
    let part = 358.0 / 360.0;
    for (file, shares) in [
        ("a.toml", [0.2, 0.0, 0.8]),
        ("b.toml", [0.2 * part, 0.0, 0.8 * part]),
        ("c.toml", [0.2, 0.8, f64::NAN]),
    ] {
        let row = found.iter().find(|row| row[0].1 == file).unwrap();
        for (name, share) in ["air", "tap", "streams"].into_iter().zip(shares) {
            let found = row.iter().find(|(header, _)| *header == format!("{name}.share [-]"));
            let found = found.and_then(|(_, cell)| cell.parse().ok()).unwrap_or(f64::NAN);
            assert!((found - share).abs() < 1e-6 || (found.is_nan() && share.is_nan()));
        }
    }
    assert!(folder.run(&["compare", "a.toml"]).exits(0).out.contains("streams"));
}
