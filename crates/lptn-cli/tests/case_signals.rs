//! Load cases that set signals: three drive cycles in one file. With a conductance alone, or with
//! one time constant, each has a closed form.

use serde_json::Value;

use crate::common;

use common::Folder;

/// The loss follows the speed. A body of 500 J/K, 2 W/K.
const CYCLES: &str = r#"
format = 1
[param]
G = "2 W/K"
t_stop = "400 s"
[signal]
speed = { t = ["0 s", "400 s"], v = ["1000 rpm", "1000 rpm"] }
[node]
body = { C = "500 J/K", T0 = "20 degC" }
[boundary]
air = { T = "20 degC" }
[resistor]
film = { from = "body", to = "air", G = "G" }
[source]
loss = { into = "body", P = "0.1 [W/rpm] * speed" }
[limit]
hot = { of = "body.T", below = "60 degC" }
[run]
stop = "t_stop"
tolerance = "1e-8 K"
report = { usual = "mean(body.T)", most = "max(body.T)", given = "integral(loss.P)" }
[case.city.signal]
speed = { csv = "city.csv", time = "t", value = "speed", interp = "previous", after_end = "hold" }
[case.hill.signal]
speed = { t = ["0 s", "400 s"], v = ["0 rpm", "1600 rpm"] }
[case.motorway]
set = { t_stop = "600 s" }
signal = { speed = "1500 rpm" }
[size.film]
minimise = "G"
over = "run"
vary = { G = { from = "0.5 W/K", to = "10 W/K" } }
require = ["max(body.T) <= 50 [degC]"]
[sweep.film]
method = "list"
over = "run"
axes = { G = ["2 W/K", "4 W/K"] }
report = { usual = "mean(body.T)", most = "max(body.T)", given = "integral(loss.P)" }
"#;

/// 2000 rpm for 100 s, 500 rpm for 200 s, 1200 rpm from then on.
const CITY: &str = "t [s],speed [rpm]\n0,2000\n100,500\n300,1200\n";

/// The mean, the largest temperature in degC, and the heat in J of each case, by steps of the exact
/// solution of C dT/dt = P - G T: for a constant power P/G + (T - P/G) exp(-G t/C), for a power that
/// rises as s t the particular solution s/G (t - C/G).
fn exact(case: &str, g: f64) -> [f64; 3] {
    let tau = 500.0 / g;
    match case {
        "hill" => {
            let slope = 160.0 / 400.0;
            let rise = |t: f64| slope / g * (t - tau + tau * (-t / tau).exp());
            let t = 400.0_f64;
            let area = slope / g * (t * t / 2.0 - tau * t - tau * tau * (-t / tau).exp_m1());
            [20.0 + area / t, 20.0 + rise(t), slope * t * t / 2.0]
        }
        _ => {
            let parts: &[(f64, f64)] = match case {
                "city" => &[(200.0, 100.0), (50.0, 200.0), (120.0, 100.0)],
                "motorway" => &[(150.0, 600.0)],
                _ => &[(100.0, 400.0)],
            };
            let (mut rise, mut most, mut area, mut heat, mut all) =
                (0.0_f64, 0.0_f64, 0.0, 0.0, 0.0);
            for &(power, length) in parts {
                let level = power / g;
                area += level * length - (rise - level) * tau * (-length / tau).exp_m1();
                rise = level + (rise - level) * (-length / tau).exp();
                most = most.max(rise);
                heat += power * length;
                all += length;
            }
            [20.0 + area / all, 20.0 + most, heat]
        }
    }
}

const REPORTS: [&str; 3] = ["usual", "most", "given"];

fn agrees(found: f64, exact: f64, what: &str) {
    assert!((found - exact).abs() <= 1e-6 * exact.abs().max(1.0), "{what}: {found}, not {exact}");
}

fn folder() -> Folder {
    let folder = Folder::with("a.toml", CYCLES);
    folder.write("city.csv", CITY);
    folder
}

fn reports(json: &Value, exact: [f64; 3], what: &str) {
    for (name, exact) in REPORTS.iter().zip(exact) {
        let found = json["reports"][name]["value"].as_f64().unwrap_or_else(|| panic!("{json}"));
        agrees(found, exact, &format!("{what}: {name}"));
    }
}

const CASES: [&str; 3] = ["city", "hill", "motorway"];

#[test]
fn each_cycle_is_run_compared_and_swept() {
    let folder = folder();
    folder.run(&["check", "a.toml"]).exits(0);
    let run = |more: &[&str]| {
        let arguments = [&["run", "a.toml", "--no-files", "--format", "json"], more].concat();
        folder.run(&arguments)
    };
    reports(&run(&[]).exits(0).json(), exact("", 2.0), "no case");
    for case in CASES {
        let code = if exact(case, 2.0)[1] > 60.0 { 1 } else { 0 };
        reports(&run(&["--case", case]).exits(code).json(), exact(case, 2.0), case);
        let set = ["--case", case, "--set", "G=4 W/K"];
        reports(&run(&set).json(), exact(case, 4.0), "with --set");
        // candidates of a sweep
        let sweep = ["sweep", "a.toml", "--case", case, "--no-files", "--format", "json"];
        let json = folder.run(&sweep).exits(0).json();
        for (row, g) in json["rows"].as_array().unwrap().iter().zip([2.0, 4.0]) {
            let found = [2, 3, 4].map(|place| row[place].as_f64().unwrap());
            for (found, exact) in found.into_iter().zip(exact(case, g)) {
                agrees(found, exact, &format!("sweep of {case}"));
            }
        }
    }
    // the flat netlist has the same cases, and that of a case its signal
    for case in CASES {
        let flat = folder.run(&["check", "a.toml", "--expand"]).exits(0).out;
        folder.write("flat.toml", &flat);
        let flat = ["run", "flat.toml", "--no-files", "--format", "json", "--case", case];
        reports(&folder.run(&flat).json(), exact(case, 2.0), "flat");
    }
    let csv = folder.run(&["compare", "a.toml", "--cases", "--format", "csv"]).exits(1).out;
    let mut lines = csv.lines();
    let heading: Vec<&str> = lines.next().unwrap().split(',').collect();
    let rows: Vec<Vec<&str>> = lines.map(|line| line.split(',').collect()).collect();
    assert_eq!(rows.len(), 3, "{csv}");
    for case in CASES {
        let row = rows.iter().find(|row| row[0].contains(case)).unwrap();
        let names = ["usual.report [degC]", "most.report [degC]", "given.report [J]"];
        for (name, exact) in names.iter().zip(exact(case, 2.0)) {
            let place = heading.iter().position(|own| own == name).unwrap();
            agrees(row[place].parse().unwrap(), exact, &format!("compare {case}: {name}"));
        }
    }
}

/// The least G with which the worst cycle stays below 50 degC, by bisection of the closed forms.
#[test]
fn a_size_is_kept_in_every_cycle() {
    let folder = folder();
    let (mut low, mut high) = (0.5, 10.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        let most = CASES.map(|case| exact(case, middle)[1]);
        if most.iter().any(|most| *most > 50.0) { low = middle } else { high = middle }
    }
    let json = folder.run(&["size", "a.toml", "--format", "json"]).exits(0).json();
    agrees(json["values"]["G"]["value"].as_f64().unwrap(), high, "size");
    for (place, case) in CASES.iter().enumerate() {
        let own = &json["requirements"][place];
        assert_eq!(own["case"], *case);
        let margin = own["margin"]["value"].as_f64().unwrap();
        assert!((margin - (50.0 - exact(case, high)[1])).abs() < 1e-6, "{case}: {own}");
    }
}

/// A constant in the file and a cycle in a case: a size in steady state refuses the case.
#[test]
fn a_steady_size_refuses_a_cycle() {
    let constant = "speed = \"1000 rpm\"";
    let text = CYCLES
        .replace("speed = { t = [\"0 s\", \"400 s\"], v = [\"1000 rpm\", \"1000 rpm\"] }", constant)
        .replace("minimise = \"G\"\nover = \"run\"", "minimise = \"G\"")
        .replace("max(body.T) <= 50", "body.T <= 50");
    let folder = Folder::with("a.toml", &text);
    folder.write("city.csv", CITY);
    folder.run(&["size", "a.toml"]).exits(2).says("size::");
}

/// A case that ends before the run is an error of the netlist, not of the run.
#[test]
fn a_cycle_lasts_as_long_as_the_run() {
    let folder = Folder::with("a.toml", &CYCLES.replace(", after_end = \"hold\"", ""));
    folder.write("city.csv", CITY);
    folder
        .run(&["check", "a.toml"])
        .exits(1)
        .prints("netlist::signal_too_short")
        .prints("case `city`: signal `speed` ends at 300 s, but the run at 400 s");
}

/// Rows of one case are not continued with those of another.
#[test]
fn a_sweep_of_another_case_is_not_resumed() {
    let folder = folder();
    let sweep = |case| ["sweep", "a.toml", "--case", case, "-o", "out", "--resume", "--quiet"];
    folder.run(&sweep("city")).exits(0);
    folder.run(&sweep("hill")).exits(2);
}
