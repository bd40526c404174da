//! Command line: `lptn run --uncertainty`.

use crate::common;

use common::{Folder, csv};

const BED: &str = include_str!("../../../networks/paper_bed.toml");

fn folder() -> Folder {
    Folder::with("bed.toml", BED)
}

const LINEAR: [&str; 4] = ["run", "bed.toml", "--uncertainty", "linear"];

fn sobol<'a>(more: &[&'a str]) -> Vec<&'a str> {
    [&["run", "bed.toml", "--uncertainty", "sobol", "--samples", "64"], more].concat()
}

#[test]
fn the_table_has_bands_probabilities_and_what_matters() {
    let folder = folder();
    let linear = folder.run(&LINEAR).exits(0).prints("11 parameters with ±").prints("97.5 %");
    let linear = linear.prints("P(broken)").prints("parameter  ");
    let sampled = folder
        .run(&sobol(&[]))
        .exits(0)
        .prints("64 Sobol points, seed 1, 833 runs")
        .prints("in all");
    for ran in [linear, sampled] {
        assert!(ran.out.lines().all(|line| line.chars().count() <= 80), "{}", ran.out);
        // 17 % of 222.9 W matter most for the steel
        let first = ran.out.lines().skip_while(|line| !line.starts_with("parameter  ")).nth(1);
        assert!(first.unwrap().starts_with("alpha       17 %"), "{}", ran.out);
    }
}

#[test]
fn files_hold_the_bands_and_result_csv_is_as_ever() {
    let folder = folder();
    folder.run(&["run", "bed.toml"]).exits(0);
    let plain = folder.read("out/bed/result.csv");
    assert!(!folder.files().contains(&"out/bed/uncertainty.csv".to_owned()));
    folder.run(&sobol(&["--seed", "7"])).exits(0).says("uncertainty.csv");
    assert_eq!(folder.read("out/bed/result.csv"), plain);
    let (headers, rows) = csv(&folder.read("out/bed/uncertainty.csv"));
    let expected = [
        "time [s]",
        "steel.T [degC]",
        "steel.T.sd [K]",
        "steel.T.low [degC]",
        "steel.T.median [degC]",
    ];
    assert_eq!(headers[..5], expected);
    assert_eq!((headers.len(), rows.len()), (16, 301));
    assert!(rows.iter().all(|row| row[3] < row[4] && row[4] < row[5]), "low, median, high");
    let ranking = folder.read("out/bed/ranking.csv");
    assert!(
        ranking
            .starts_with("result,unit,parameter,effect [SI],share [-],share_error [-],total [-]")
    );
    assert_eq!(ranking.lines().count(), 1 + 7 * 11);
    let manifest: serde_json::Value =
        serde_json::from_str(&folder.read("out/bed/manifest.json")).unwrap();
    let how = &manifest["uncertainty"];
    assert_eq!((how["method"].as_str(), how["seed"].as_u64()), (Some("sobol"), Some(7)));
    assert_eq!(how["parameters"]["R_skin"]["sd"]["unit"], "K/W");
    let sd = how["parameters"]["R_skin"]["sd"]["value"].as_f64().unwrap();
    assert!((sd - 0.073).abs() < 1e-12, "20 % of 0.365 K/W");
    let names: Vec<&str> = manifest["results"]
        .as_array()
        .unwrap()
        .iter()
        .map(|r| r["name"].as_str().unwrap())
        .collect();
    assert!(names.contains(&"uncertainty.csv") && names.contains(&"ranking.csv"), "{names:?}");
    // what is no longer true is taken away
    folder.run(&["run", "bed.toml"]).exits(0);
    assert!(
        !folder.files().iter().any(|file| file.contains("uncertainty") || file.contains("ranking"))
    );
}

#[test]
fn determinism_threads_change_no_byte() {
    let bands = |threads: &str| {
        let folder = folder();
        folder.run(&sobol(&["--threads", threads])).exits(0);
        folder.read("out/bed/uncertainty.csv") + &folder.read("out/bed/ranking.csv")
    };
    assert_eq!(bands("1"), bands("3"));
}

#[test]
fn json_has_every_answer_with_its_ranking() {
    let folder = folder();
    let json = |arguments: &[&str]| {
        folder.run(&[arguments, &["--no-files", "--format", "json"]].concat()).exits(0).json()["uncertainty"]
            .clone()
    };
    let value = |of: &serde_json::Value| of["value"].as_f64().unwrap();
    let linear = json(&LINEAR);
    assert_eq!(
        (linear["method"].as_str(), linear["exact"].as_bool()),
        (Some("linear"), Some(true))
    );
    let end = &linear["results"]["steel.T"]["end"];
    assert_eq!(end["ranking"].as_array().unwrap().len(), 11);
    let shares: f64 =
        end["ranking"].as_array().unwrap().iter().map(|part| value(&part["share"])).sum();
    assert!((shares - 1.0).abs() < 1e-12);
    assert!(
        (value(&end["high"]) - value(&end["value"]) - 1.959_963_985 * value(&end["sd"])).abs()
            < 1e-6
    );
    assert_eq!((&end["high"]["unit"], &end["sd"]["unit"]), (&"degC".into(), &"K".into()));
    assert_eq!(linear["bands"]["rows"].as_array().unwrap().len(), 301);
    let sampled = json(&sobol(&[]));
    let margin = &sampled["results"]["seals"]["margin"];
    assert!(margin["probability_broken"]["standard_error"].as_f64().unwrap() > 0.0);
    assert!(sampled["not_linear"].is_array() && sampled["lost"].is_array());
}

#[test]
fn csv_on_stdout_is_the_bands_of_what_is_selected() {
    let folder = folder();
    let more = ["--no-files", "--format", "csv", "--select", "bed.T", "--temperature-unit", "degF"];
    let ran = folder.run(&[&LINEAR[..], &more].concat()).exits(0);
    let (headers, rows) = csv(&ran.out);
    let expected =
        ["time [s]", "bed.T [degF]", "bed.T.sd [degR]", "bed.T.low [degF]", "bed.T.high [degF]"];
    assert_eq!(headers, expected);
    // T_amb alone is uncertain at the start: 1.7 K are 3.06 degR
    assert!((rows[0][2] - 3.06).abs() < 1e-9, "{:?}", rows[0]);
}

#[test]
fn nothing_uncertain_is_an_error_with_the_line_that_helps() {
    let folder = Folder::with_gearbox();
    let ran = folder.run(&["run", "gearbox.toml", "--uncertainty", "linear"]).exits(2);
    let ran = ran.says("uncertainty::no_deviation");
    assert_eq!(folder.files(), ["gearbox.toml"]);
    // a `±` of an element does not count, and is shown
    let element = "format = 1\n[param]\nP = \"50 W\"\n[node]\nbox = { C = \"1 kJ/K\", T0 = \"20 degC\" }\n\
        [boundary]\nair = { T = \"20 degC\" }\n[resistor]\nskin = { from = \"box\", to = \"air\", R = \
        \"0.3 K/W ± 5 %\" }\n[source]\nheat = { into = \"box\", P = \"P\" }\n[run]\nstop = \"1 h\"\n";
    Folder::with("element.toml", element)
        .run(&["run", "element.toml", "--uncertainty", "linear"])
        .exits(2)
        .says("uncertainty::no_deviation")
        .says("not in [param]: it is not counted");
    // the line is one of the file, and right there
    let (_, line) = ran.err.split_once("deviation: `").unwrap();
    let line = line.split('`').next().unwrap();
    let name = line.split(" = ").next().unwrap();
    let own = |old: &str| {
        if old.starts_with(&format!("{name} = ")) { line.to_owned() } else { old.into() }
    };
    let lines: Vec<String> = folder.read("gearbox.toml").lines().map(own).collect();
    folder.write("sure.toml", &lines.join("\n"));
    folder.run(&["run", "sure.toml", "--uncertainty", "linear", "--no-files"]).exits(0);
    let folder = self::folder();
    folder.run(&["run", "bed.toml", "--samples", "64"]).exits(2).says("--uncertainty");
    folder
        .run(&["run", "bed.toml", "--uncertainty", "sobol", "--samples", "7"])
        .exits(2)
        .says("64..=65536");
    folder.run(&["run", "bed.toml", "--uncertainty", "guess"]).exits(2);
}

/// The limit is broken with every parameter at its value: that is still the answer.
#[test]
fn a_broken_limit_exits_1_as_ever() {
    let folder = Folder::with("hot.toml", &BED.replace("100 degC", "80 degC"));
    folder
        .run(&["run", "hot.toml", "--uncertainty", "linear", "--no-files"])
        .exits(1)
        .says("limit broken");
}

#[test]
fn what_is_refused_is_told() {
    let folder = Folder::with("wide.toml", &BED.replace("2.16 K/W ± 30 %", "2.16 K/W ± 50 %"));
    let ran = folder
        .run(&["run", "wide.toml", "--uncertainty", "sobol", "--samples", "64", "--no-files"])
        .exits(0);
    ran.prints("runs refused (").prints("mill").prints("the distribution ends there");
}

#[test]
fn a_deviation_that_nothing_varies_is_told_with_its_place() {
    let text = BED.replace("room = { T = \"T_amb\" }", "room = { T = \"25.5 ± 1 degC\" }");
    let folder = Folder::with("bed.toml", &text);
    let ran = folder.run(&LINEAR).exits(0).prints("11 parameters with ±");
    ran.says("uncertainty::no_parameter").says("25.5 ± 1 degC").says("[param]");
    let json =
        folder.run(&[&LINEAR[..], &["--format", "json", "--no-files"]].concat()).exits(0).json();
    assert_eq!(json["warnings"].as_array().unwrap().len(), 1);
    assert!(!folder.run(&["run", "bed.toml"]).exits(0).err.contains("no_parameter"));
}
