//! Load cases: run, compared and sized together; and variants of one netlist.

use crate::common;

use common::Folder;

/// T = T_amb + P / G.
const BLOCK: &str = "format = 1
[param]
G = \"2 W/K\"
P = \"100 W\"
T_amb = \"20 degC\"
[node]
block = { C = \"1 kJ/K\", T0 = \"T_amb\" }
[boundary]
air = { T = \"T_amb\" }
[resistor]
skin = { from = \"block\", to = \"air\", G = \"G\" }
[source]
loss = { into = \"block\", P = \"P\" }
[limit]
hot = { of = \"block.T\", below = \"90 degC\" }
[run]
stop = \"2 h\"
[case.summer]
set = { T_amb = \"45 degC\" }
[case.overload]
set = { P = \"150 W\", T_amb = \"30 degC\" }
[size.fan]
minimise = \"G\"
vary = { G = { from = \"0.5 W/K\", to = \"50 W/K\" } }
require = [\"block.T <= 80 [degC]\"]
";

fn value(of: &serde_json::Value) -> f64 {
    of["value"].as_f64().unwrap_or_else(|| panic!("{of}"))
}

/// 100 W / 35 K in summer, 150 W / 50 K at overload: the latter is more.
#[test]
fn a_size_is_kept_in_every_case() {
    let folder = Folder::with("a.toml", BLOCK);
    let json = folder.run(&["size", "a.toml", "--format", "json"]).exits(0).json();
    assert!((value(&json["values"]["G"]) - 3.0).abs() < 1e-9, "{json}");
    let cases: Vec<_> =
        json["requirements"].as_array().unwrap().iter().map(|r| r["case"].clone()).collect();
    assert_eq!(cases, ["summer", "overload"]);
    // 80 - 45 - 100 / 3
    assert!((value(&json["requirements"][0]["margin"]) - 5.0 / 3.0).abs() < 1e-9);
    folder
        .run(&["size", "a.toml"])
        .exits(0)
        .prints("in each of the cases summer, overload")
        .prints("overload: block.T <= 80 [degC]");
    // over a run of two hours it is next to that of the steady state
    folder.write("r.toml", &(BLOCK.to_owned() + "over = \"run\"\n"));
    let json = folder.run(&["size", "r.toml", "--format", "json"]).exits(0).json();
    let exact = {
        // 50 G = 150 (1 - exp(-7.2 G)), by fixed-point iteration
        (0..60).fold(3.0_f64, |g, _| 3.0 * -(-7.2 * g).exp_m1())
    };
    assert!((value(&json["values"]["G"]) / exact - 1.0).abs() < 1e-8, "{json}");
    // one case by name
    folder.write("b.toml", &(BLOCK.to_owned() + "cases = [\"summer\"]\n"));
    let json = folder.run(&["size", "b.toml", "--format", "json"]).exits(0).json();
    assert!((value(&json["values"]["G"]) / (100.0 / 35.0) - 1.0).abs() < 1e-9);
    // what is written keeps all of them
    folder.run(&["size", "a.toml", "--write"]).exits(0);
    assert!(folder.read("a.toml").contains("G = \"3 W/K\""), "{}", folder.read("a.toml"));
}

#[test]
fn a_case_is_run_beside_the_others() {
    let folder = Folder::with("a.toml", BLOCK);
    folder.run(&["run", "a.toml"]).exits(0);
    // 30 + 150 / 2 is more than 90
    folder.run(&["run", "a.toml", "--case", "overload"]).exits(1);
    assert!(folder.path().join("out/a/result.csv").is_file());
    assert!(folder.path().join("out/a_overload/result.csv").is_file());
    let steady = |more: &[&str]| {
        let arguments = [&["steady", "a.toml", "--format", "json"], more].concat();
        value(&folder.run(&arguments).json()["values"]["block.T"])
    };
    assert!((steady(&["--case", "summer"]) - steady(&[]) - 25.0).abs() < 1e-9);
    // --set goes before the case
    let set = steady(&["--case", "overload", "--set", "P=50 W"]);
    assert!((set - steady(&[]) - 10.0 + 25.0).abs() < 1e-9, "{set}");
    folder.run(&["check", "a.toml", "--case", "summer"]).exits(0);
    folder
        .run(&["run", "a.toml", "--case", "sumer"])
        .exits(2)
        .says("input::no_case")
        .says("did you mean `summer`?");
}

#[test]
fn variants_and_cases_are_compared() {
    let folder = Folder::with("a.toml", BLOCK);
    let csv = folder
        .run(&["compare", "a.toml", "--set", "G=2W/K,4W/K", "--cases", "--format", "csv"])
        .exits(1);
    let rows: Vec<&str> = csv.out.lines().collect();
    assert_eq!(rows.len(), 5, "{}", csv.out);
    assert!(csv.out.contains("\"a.toml (overload, G=2W/K)\""), "{}", csv.out);
    // the coolest first: 45 + 25 is below 30 + 37.5 .. by margin
    assert!(rows[1].starts_with("\"a.toml (overload, G=4W/K)\""), "{}", csv.out);
    let ran = folder.run(&["compare", "a.toml", "--set", "G=2W/K,4W/K"]).exits(0);
    ran.prints("2 candidates of a.toml").prints("\nG=4W/K");
    let many = format!("G={}", vec!["1W/K"; 1001].join(","));
    folder.run(&["compare", "a.toml", "--set", &many]).exits(2).says("compare::too_many");
}

/// G = (100 W + 1.645 x 5 W) / 60 K for P = 100 ± 5 W, as for the library.
#[test]
fn a_probability_is_kept_and_said() {
    let text = BLOCK.split("[case.summer]").next().unwrap().replace("100 W", "100 ± 5 W")
        + "[size.fan]\nminimise = \"G\"\nvary = { G = { from = \"0.5 W/K\", to = \"50 W/K\" } }\n\
           require = [\"block.T <= 80 [degC]\"]\nprobability = 0.95\n";
    let folder = Folder::with("a.toml", &text);
    folder
        .run(&["size", "a.toml"])
        .exits(0)
        .prints("each with a probability of 95 %")
        .prints("scatter")
        .prints("G = 1.80374 W/K keeps every requirement");
    let json = folder.run(&["size", "a.toml", "--format", "json"]).exits(0).json();
    assert!((value(&json["requirements"][0]["deviation"]) - 5.0 / 1.803_737_8).abs() < 1e-6);
    folder.run(&["size", "a.toml", "--write"]).exits(0);
    // ± from the command line: twice as much, in a file with its own or with none
    let set = ["size", "a.toml", "--set", "P=100 ± 10 W"];
    folder.write("a.toml", &text);
    folder.run(&set).exits(0).prints("G = 1.94081 W/K keeps every requirement");
    folder.write("a.toml", &text.replace("100 ± 5 W", "100 W"));
    folder.run(&set).exits(0).prints("G = 1.94081 W/K keeps every requirement");
    folder.run(&["size", "a.toml"]).exits(2).says("size::no_deviation").says("a.toml:");
}

/// In summer the block is at 45 + 100 / x degC, at overload at 30 + 150 / x, with x = G / (W/K). Below
/// x = 10/3 the latter is hotter, above it the former, and 45 + 100 / x + 2 x is least at x = sqrt(50).
#[test]
fn of_results_that_are_optimised_the_worst_case_counts() {
    let text = BLOCK
        .replace("minimise = \"G\"", "minimise = \"block.T - 20 [degC] + 2 [K^2/W] * G\"")
        .replace("<= 80", "<= 200");
    let folder = Folder::with("a.toml", &text);
    let json = folder.run(&["size", "a.toml", "--format", "json"]).exits(0).json();
    let least = 25.0 + 4.0 * f64::sqrt(50.0);
    assert!((value(&json["objective"]["value"]) - least).abs() < 1e-8 * least, "{json}");
    assert!((value(&json["values"]["G"]) / f64::sqrt(50.0) - 1.0).abs() < 1e-4, "{json}");
}

#[test]
fn a_case_that_a_file_without_cases_lacks_is_shown_with_its_parameters() {
    let folder = Folder::with_gearbox();
    let ran = folder.run(&["run", "gearbox.toml", "--case", "hot"]).exits(2);
    let (_, pasted) = ran.err.split_once("[case.hot]\n").unwrap();
    let line = pasted.lines().find(|line| line.contains("set = ")).unwrap().trim().to_owned();
    let text = folder.read("gearbox.toml");
    folder.write("hot.toml", &format!("{text}\n[case.hot]\n{line}\n"));
    folder.run(&["run", "hot.toml", "--case", "hot", "--no-files"]).exits(0);
}

/// `--set` goes before the cases, which is told for each value that it replaces.
#[test]
fn a_replaced_value_of_a_case_is_told() {
    let text = "format = 1\n[param]\nP = \"10 W\"\nG = \"1 W/K\"\n[node]\na = { C = \"10 J/K\", T0 = \"20 degC\" \
        }\n[boundary]\nair = { T = \"20 degC\" }\n[resistor]\nr = { from = \"a\", to = \"air\", G = \"G\" }\n\
        [source]\ns = { into = \"a\", P = \"P\" }\n[case.hill]\nset = { P = \"30 W\" }\n[run]\nstop = \"60 s\"\n";
    let folder = Folder::with("cases.toml", text);
    let words = |ran: &str| ran.split_whitespace().collect::<Vec<_>>().join(" ");
    for verb in
        [&["steady", "cases.toml", "--case", "hill"][..], &["compare", "cases.toml", "--cases"]]
    {
        let ran = folder.run(&[verb, &["--set", "P=20W"]].concat()).exits(0);
        let told = words(&format!("{}{}", ran.out, ran.err));
        assert!(told.contains("--set P=20W replaces P=30 W of [case.hill]"), "{told}");
        let ran = folder.run(&[verb, &["--set", "G=2W/K"]].concat()).exits(0);
        assert!(!ran.err.contains("case_overridden"), "{}", ran.err);
    }
}
