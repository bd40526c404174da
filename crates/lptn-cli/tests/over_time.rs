//! Numbers over time: one functional has the same value in `run`, `size`, `sweep` and `compare`, and
//! limits are judged in sweeps. A body with one time constant has a closed form for each.

use serde_json::Value;

use crate::common;

use common::Folder;

/// T(t) = 20 degC + P/G (1 - exp(-t G/C)).
const BODY: &str = r#"
format = 1
[param]
G = "2 W/K"
[node]
body = { C = "500 J/K", T0 = "20 degC" }
[boundary]
air = { T = "20 degC" }
[resistor]
film = { from = "body", to = "air", G = "G" }
[source]
loss = { into = "body", P = "100 W" }
[run]
stop = "500 s"
tolerance = "1e-8 K"
window = { late = { from = "250 s", to = "500 s" } }
[run.report]
usual = "mean(body.T)"
most = "max(body.T)"
least = "min(body.T)"
at_end = "last(body.T)"
hot = "time_over(body.T, 50 [degC])"
cool = "time_under(body.T, 50 [degC])"
given = "integral(film.Q)"
lasts = "life(body.T, 1000 [h], 80 [degC], 1 [eV])"
rise = "body.T - air.T"
[sweep.film]
method = "list"
over = "run"
axes = { G = ["2 W/K", "4 W/K"] }
[sweep.film.report]
usual = "mean(body.T)"
most = "max(body.T)"
least = "min(body.T)"
at_end = "last(body.T)"
hot = "time_over(body.T, 50 [degC])"
cool = "time_under(body.T, 50 [degC])"
given = "integral(film.Q)"
lasts = "life(body.T, 1000 [h], 80 [degC], 1 [eV])"
[size.film]
minimise = "G"
over = "run"
vary = { G = { from = "1 W/K", to = "10 W/K" } }
require = ["mean(body.T) <= 40 [degC]", "integral(film.Q) >= 20 [kJ]"]
"#;

const NAMES: [&str; 8] = ["usual", "most", "least", "at_end", "hot", "cool", "given", "lasts"];

fn at(g: f64, t: f64) -> f64 {
    20.0 - 100.0 / g * (-t * g / 500.0).exp_m1()
}

/// The mean from `a` to `b`.
fn mean(g: f64, (a, b): (f64, f64)) -> f64 {
    let tau = 500.0 / g;
    20.0 + 100.0 / g * (1.0 - tau / (b - a) * ((-a / tau).exp() - (-b / tau).exp()))
}

/// The numbers of `NAMES`: closed forms, and Simpson's rule for the rate of ageing.
fn exact(g: f64, (a, b): (f64, f64)) -> [f64; 8] {
    let crosses = -500.0 / g * (1.0 - 30.0 * g / 100.0).ln();
    let hot = if crosses.is_nan() { 0.0 } else { (b - crosses.max(a)).max(0.0) };
    let kelvin = |t: f64| at(g, t) + 273.15;
    let k = 1.380_649e-23 / 1.602_176_634e-19;
    let rate = |t: f64| (1.0 / k * (1.0 / 353.15 - 1.0 / kelvin(t))).exp();
    let n = 2000;
    let h = (b - a) / f64::from(n);
    let weight = |i: i32| if i == 0 || i == n { 1.0 } else { f64::from(2 + 2 * (i % 2)) };
    let sum: f64 = (0..=n).map(|i| weight(i) * rate(a + f64::from(i) * h)).sum();
    let life = 3.6e6 * (b - a) / (sum * h / 3.0);
    let mean = mean(g, (a, b));
    [mean, at(g, b), at(g, a), at(g, b), hot, b - a - hot, g * (mean - 20.0) * (b - a), life]
}

fn agrees(found: f64, exact: f64, what: &str) {
    assert!((found - exact).abs() <= 1e-6 * exact.abs().max(1.0), "{what}: {found}, not {exact}");
}

fn checked(of: &Value, exact: [f64; 8], what: &str) {
    for (name, exact) in NAMES.iter().zip(exact) {
        let found = of[name]["value"].as_f64().unwrap_or_else(|| panic!("{what}: {of}"));
        agrees(found, exact, &format!("{what}: {name}"));
    }
}

/// The cells of CSV by their heading, one map a row.
fn table(csv: &str) -> Vec<std::collections::BTreeMap<String, String>> {
    let mut lines = csv.lines();
    let heading: Vec<&str> = lines.next().unwrap().split(',').collect();
    let row = |line: &str| {
        let cells = heading.iter().zip(line.split(','));
        cells.map(|(name, cell)| ((*name).to_owned(), cell.to_owned())).collect()
    };
    lines.map(row).collect()
}

fn unit(name: &str) -> &str {
    match name {
        "hot" | "cool" | "lasts" => "s",
        "given" => "J",
        _ => "degC",
    }
}

#[test]
fn one_number_in_every_verb() {
    let folder = Folder::with("a.toml", BODY);
    let whole = (0.0, 500.0);
    let run = folder.run(&["run", "a.toml", "--no-files", "--format", "json"]).exits(0).json();
    checked(&run["reports"], exact(2.0, whole), "run");
    checked(&run["windows"]["late"]["reports"], exact(2.0, (250.0, 500.0)), "window");
    assert!(run["reports"]["rise"].is_null(), "a column is not a number");
    // the flat netlist
    let flat = folder.run(&["check", "a.toml", "--expand"]).exits(0).out;
    folder.write("flat.toml", &flat);
    let of_flat = folder.run(&["run", "flat.toml", "--no-files", "--format", "json"]).json();
    assert_eq!(of_flat["reports"], run["reports"]);
    // candidates of a comparison and of a sweep
    let compare =
        ["compare", "a.toml", "--set", "G=2W/K,4W/K", "--sort", "given", "--format", "csv"];
    let compared = table(&folder.run(&compare).exits(0).out);
    let swept = folder.run(&["sweep", "a.toml", "--no-files", "--format", "csv"]).exits(0);
    let swept = table(&swept.out);
    for (i, g) in [2.0, 4.0].into_iter().enumerate() {
        let row = |g: &str| compared.iter().find(|row| row["file"].contains(g)).unwrap();
        let compared = row(["G=2", "G=4"][i]);
        for (name, exact) in NAMES.iter().zip(exact(g, whole)) {
            let cell = |row: &std::collections::BTreeMap<String, String>, name: &str| -> f64 {
                row.get(name).unwrap_or_else(|| panic!("{name}: {row:?}")).parse().unwrap()
            };
            let unit = unit(name);
            agrees(cell(compared, &format!("{name}.report [{unit}]")), exact, "compare");
            agrees(cell(&swept[i], &format!("{name} [{unit}]")), exact, "sweep");
        }
    }
    // the size at which the mean is 40 degC, by bisection of the closed form
    let (mut low, mut high) = (1.0, 10.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if mean(middle, whole) > 40.0 { low = middle } else { high = middle }
    }
    let size = folder.run(&["size", "a.toml", "--format", "json"]).exits(0).json();
    let g = size["values"]["G"]["value"].as_f64().unwrap();
    agrees(g, low, "size");
    let set = format!("G={g} W/K");
    let run = ["run", "a.toml", "--no-files", "--format", "json", "--set", &set];
    checked(&folder.run(&run).exits(0).json()["reports"], exact(g, whole), "run at the size");
}

#[test]
fn numbers_are_printed_and_written() {
    let folder = Folder::with("a.toml", BODY);
    folder
        .run(&["run", "a.toml"])
        .exits(0)
        .prints("usual   mean(body.T)")
        .prints("48.383 degC")
        .says("reports.csv");
    let csv = folder.read("out/a/reports.csv");
    let mut lines = csv.lines();
    assert_eq!(lines.next(), Some("report,of,window,from [s],to [s],value,unit"));
    assert!(lines.next().unwrap().starts_with("usual,mean(body.T),,0,500,48.3833"), "{csv}");
    assert_eq!(csv.lines().filter(|line| line.contains(",late,250,500,")).count(), 8, "{csv}");
    // the file of an earlier run does not stay
    folder.write(
        "a.toml",
        "format = 1\n[node]\na = { T0 = \"1 degC\", C = \"1 J/K\" }\n[run]\nstop = \"1 s\"\n",
    );
    folder.run(&["run", "a.toml"]).exits(0);
    assert!(!folder.path().join("out/a/reports.csv").exists());
}

/// In steady state a mean is the value, and an integral grows without end.
#[test]
fn a_steady_state_has_the_numbers_that_last() {
    let folder = Folder::with("a.toml", BODY);
    let json = folder.run(&["steady", "a.toml", "--format", "json"]).exits(0).json();
    for name in ["usual", "most", "least", "at_end"] {
        agrees(json["values"][name]["value"].as_f64().unwrap(), 70.0, name);
    }
    let ageing: f64 = 1.602_176_634e-19 / 1.380_649e-23 * (1.0 / 353.15 - 1.0 / 343.15);
    agrees(json["values"]["lasts"]["value"].as_f64().unwrap(), 3.6e6 / ageing.exp(), "life");
    for name in ["hot", "cool", "given"] {
        assert!(json["values"][name]["value"].is_null(), "{name}: {json}");
    }
    folder.run(&["steady", "a.toml"]).exits(0).prints("given [J]   ");
}

/// 100 W for 100 s of 400 s: the mean rise is that of 25 W, whatever the capacity.
#[test]
fn a_cycle_has_its_own_numbers() {
    let signal = "[signal]\nload = { t = [\"0 s\", \"100 s\"], v = [\"100 W\", \"0 W\"], interp = \
                  \"previous\", after_end = \"repeat\", period = \"400 s\" }\n[run]";
    let text = BODY.replace("P = \"100 W\"", "P = \"load\"").replacen("[run]", signal, 1);
    let folder = Folder::with("a.toml", &text);
    let steady = ["steady", "a.toml", "--periodic", "--format", "json"];
    let json = folder.run(&steady).exits(0).json();
    let number = |name: &str| json["reports"][name]["value"].as_f64().unwrap();
    agrees(number("usual"), 20.0 + 25.0 / 2.0, "mean");
    agrees(number("given"), 25.0 * 400.0, "integral");
    // the peak at the end of a pulse: P/G (1 - a) / (1 - b)
    let tau = 250.0_f64;
    let rise = 50.0 * (-100.0 / tau).exp_m1() / (-400.0 / tau).exp_m1();
    agrees(number("most"), 20.0 + rise, "max");
    folder.run(&["steady", "a.toml", "--periodic"]).exits(0).prints("over the cycle");
}

/// Limits of the body: 60 degC at every moment, 45 degC in the mean (a warning), 25 kJ.
const LIMITS: &str = r#"
[limit]
top = { of = "body.T", below = "60 degC" }
usual = { of = "mean(body.T)", below = "45 degC", severity = "warning" }
heat = { of = "integral(film.Q)", above = "25 kJ" }
[sweep.sink]
method = "list"
over = "run"
axes = { G = ["1 W/K", "2 W/K", "2.3 W/K", "4 W/K", "-1 W/K"] }
report = { cost = "G", T_max = "max(body.T)" }
front = ["cost", "T_max"]
"#;

fn limited(more: (&str, &str)) -> Folder {
    Folder::with("a.toml", &(BODY.to_owned() + LIMITS).replace(more.0, more.1))
}

/// The margins in K and J, the standing and the worst limit by the closed form.
fn margins(g: f64) -> (f64, f64, &'static str, &'static str) {
    let [mean, most, _, _, _, _, heat, _] = exact(g, (0.0, 500.0));
    let (top, usual, heat) = (60.0 - most, 45.0 - mean, heat - 25e3);
    let standing = match (top < 0.0 || heat < 0.0, usual < 0.0) {
        (true, _) => "broken",
        (false, true) => "warning",
        _ => "kept",
    };
    // broken ones first, errors before warnings
    let worst = match (top < 0.0, heat < 0.0, usual < 0.0) {
        (true, ..) => "top",
        (_, true, _) => "heat",
        (.., true) => "usual",
        _ => "top",
    };
    let kelvin = if top < 0.0 || usual >= 0.0 { top } else { usual };
    (kelvin, heat, standing, worst)
}

/// The rows of the closed form, and of integrations.
#[test]
fn every_candidate_is_judged_by_the_limits() {
    for more in [("", ""), ("[run]\n", "[run]\nintegrator = \"cvode\"\n")] {
        let folder = limited(more);
        let sweep = ["sweep", "a.toml", "sink", "--no-files", "--format", "csv"];
        let csv = folder.run(&sweep).exits(0).out;
        let rows = table(&csv);
        for (row, g) in rows.iter().zip([1.0, 2.0, 2.3, 4.0]) {
            let (kelvin, heat, standing, worst) = margins(g);
            agrees(row["limit_margin [K]"].parse().unwrap(), kelvin, &format!("{g} in K: {csv}"));
            agrees(row["limit_margin [J]"].parse().unwrap(), heat, &format!("{g} in J: {csv}"));
            assert_eq!((&*row["limits"], &*row["worst_limit"]), (standing, worst), "{csv}");
        }
        // a negative conductance has no results
        assert_eq!((&*rows[4]["limits"], &*rows[4]["limit_margin [K]"]), ("", ""), "{csv}");
        assert!(!rows[4]["failed"].is_empty(), "{csv}");
        let standings: Vec<&str> = rows.iter().map(|row| &*row["limits"]).collect();
        assert_eq!(standings, ["broken", "broken", "warning", "kept", ""]);
        // the margin of `run` is the same number
        let run = ["run", "a.toml", "--no-files", "--format", "json", "--set", "G=4 W/K"];
        let json = folder.run(&run).exits(0).json();
        let margin = json["limits"]["top"]["margin"]["value"].as_f64().unwrap();
        agrees(rows[3]["limit_margin [K]"].parse().unwrap(), margin, "run");
    }
}

/// Of G = 1, 2, 2.3 and 4 W/K each is on the front of cost and temperature, but two break limits.
#[test]
fn a_front_is_of_those_that_keep_the_limits() {
    let folder = limited(("", ""));
    let json = folder.run(&["sweep", "a.toml", "sink", "--format", "json"]).exits(0).json();
    assert_eq!(json["front"], serde_json::json!([3, 4]), "{json}");
    let counts = serde_json::json!({ "broken": 2, "kept": 1, "warning": 1 });
    assert_eq!(json["limits"], counts);
    folder
        .run(&["sweep", "a.toml", "sink"])
        .exits(0)
        .prints("2 of 4 candidates keep all limits of severity \"error\", 2 break one: the");
    // rows that were written are read again
    let again = ["sweep", "a.toml", "sink", "--resume", "--format", "json"];
    let again = folder.run(&again).exits(0).json();
    assert_eq!((&again["front"], &again["limits"]), (&json["front"], &counts));
    assert_eq!(again["rows"], json["rows"]);
}

/// In steady state only limits that last are judged: 60 - (20 + 100/G).
#[test]
fn a_steady_sweep_judges_the_limits_that_last() {
    let steady = LIMITS.replace("over = \"run\"", "over = \"steady\"");
    let text = BODY.to_owned() + &steady.replace("max(body.T)", "body.T");
    let folder = Folder::with("a.toml", &text);
    let sweep = ["sweep", "a.toml", "sink", "--no-files", "--format", "csv"];
    let csv = folder.run(&sweep).exits(0).out;
    let rows = table(&csv);
    for (row, g) in rows.iter().zip([1.0, 2.0, 2.3, 4.0]) {
        let top: f64 = 40.0 - 100.0 / g;
        // the limit of the mean is 15 K lower and a warning
        let kelvin = if (0.0..15.0).contains(&top) { top - 15.0 } else { top };
        agrees(row["limit_margin [K]"].parse().unwrap(), kelvin, &format!("{g}: {csv}"));
        assert_eq!(row["limit_margin [J]"], "", "{csv}");
    }
    let standings: Vec<&str> = rows.iter().map(|row| &*row["limits"]).collect();
    assert_eq!(standings, ["broken", "broken", "broken", "not judged", ""], "{csv}");
}
