//! Sweeps of linear networks, which are solved in closed form: against matrix exponentials of other
//! programs, and against the integrator.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common;

use common::Folder;

/// Three nodes, a source that jumps and grows, air that warms up.
const THREE: &str = r#"
format = 1

[param]
P = "20 W"
G = "3 W/K"

[node]
a = { T0 = "25 degC", C = "100 J/K" }
b = { T0 = "20 degC", C = "400 J/K" }
c = { T0 = "20 degC", C = "2000 J/K" }

[boundary]
air = { T = "20 [degC] + 0.01 [K/s] * t" }

[resistor]
ab = { from = "a", to = "b", R = "0.5 K/W" }
bc = { from = "b", to = "c", G = "4 W/K" }
skin_a = { from = "a", to = "air", G = "0.5 W/K" }
skin_c = { from = "c", to = "air", G = "G" }

[source]
loss = { into = "a", P = "P * if(t < 120 [s], 1.5, 0.2) + 0.1 [W/s] * t" }

[run]
stop = "600 s"
tolerance = "1e-9 K"

[sweep.three]
method = "list"
over = "run"
axes = { G = ["3 W/K", "6 W/K"], P = ["20 W", "60 W"] }

[sweep.three.report]
max_b = "max(b.T)"
max_a = "max(a.T)"
min_a = "min(a.T)"
last_c = "last(c.T)"
mean_b = "mean(b.T)"
heat_c = "integral(skin_c.Q)"
over = "time_over(a.T, 40 [degC])"
given = "integral(air.Q)"
"#;

fn rows(csv: &str) -> Vec<Vec<f64>> {
    let number = |cell: &str| cell.parse().unwrap_or(f64::NAN);
    csv.lines().skip(1).map(|line| line.split(',').map(number).collect()).collect()
}

fn swept(text: &str, name: &str) -> Vec<Vec<f64>> {
    let folder = Folder::with("net.toml", text);
    let out =
        folder.run(&["sweep", "net.toml", name, "--no-files", "--format", "csv"]).exits(0).out;
    rows(&out)
}

/// mpmath 1.3: exponentials of the matrix of states, one and time at 30 digits, tops and crossings
/// by findroot, integrals by quad.
#[test]
fn three_nodes_with_inputs_that_jump_and_grow() {
    let expected = [
        [
            33.434_554_670_509_25,
            54.924_725_079_148_03,
            25.0,
            25.752_303_301_741_25,
            26.526_911_538_774_91,
            -1_302.865_247_324_022,
            242.143_738_841_429_6,
        ],
        [
            36.444_002_224_543_01,
            63.162_388_115_392_69,
            25.0,
            27.290_832_866_519_94,
            30.375_511_371_914_99,
            1_871.736_935_733_654,
            574.839_521_740_235_4,
        ],
    ];
    let found = swept(THREE, "three");
    for (row, expected) in found.iter().zip(expected) {
        for (found, expected) in row[3..].iter().zip(expected) {
            assert!((found - expected).abs() < 1e-12 * expected.abs(), "{found} {expected}");
        }
    }
    // the integrator, with a tolerance of 1e-9 K, follows the same candidates
    let integrated = THREE.replace("tolerance", "integrator = \"cvode\"\ntolerance");
    for (row, other) in found.iter().zip(swept(&integrated, "three")) {
        for (found, other) in row.iter().zip(other).skip(3) {
            assert!(
                found.is_nan() || (found - other).abs() < 2e-9 * other.abs(),
                "{found} {other}"
            );
        }
    }
}

/// A chain of twenty with rates over six decades, swept over all that may depend on parameters:
/// capacities, starts, areas, boundaries.
fn chain(over: &str) -> String {
    let mut text = String::from(
        "format = 1\n[param]\nscale = 1\nT_start = \"20 degC\"\nT_air = \"20 degC\"\n\
         h = \"10 W/(m^2 K)\"\nP = \"50 W * scale\"\n",
    );
    text = text.replace("\"50 W * scale\"", "\"50 [W] * scale\"");
    text += "[node]\n";
    for i in 0..20 {
        let capacity = 10.0_f64.powf(f64::from(i % 7) - 1.0);
        text += &format!("n{i} = {{ T0 = \"T_start\", C = \"{capacity} [J/K] * scale\" }}\n");
    }
    text += "[boundary]\nair = { T = \"T_air\" }\n[conduction]\n";
    for i in 0..19 {
        let k = 10.0_f64.powf(f64::from((i * 5) % 4) - 2.0);
        text += &format!(
            "c{i} = {{ from = \"n{i}\", to = \"n{}\", k = \"{k} W/(m K)\", area = \"1 [m^2] * scale\", shape = \"slab\", thickness = \"1 m\" }}\n",
            i + 1
        );
    }
    text +=
        "[convection]\nskin = { from = \"n19\", to = \"air\", h = \"h\", area = \"0.3 m^2\" }\n";
    text += "side = { from = \"n7\", to = \"air\", h = \"h\", area = \"0.01 m^2\" }\n";
    text += "[source]\nloss = { into = \"n3\", P = \"P * if(t < 100 [s], 1, 0.5)\" }\n";
    text += &format!("[run]\nstop = \"2 h\"\ntolerance = \"1e-8 K\"\n{over}");
    text += "[sweep.all]\nmethod = \"sobol\"\nsamples = 8\n";
    text
}

const AXES: &str = r#"
[sweep.all.axes]
scale = { from = 0.5, to = 2 }
T_start = { from = "0 degC", to = "50 degC" }
T_air = { from = "0 degC", to = "50 degC" }
h = { from = "5 W/(m^2 K)", to = "50 W/(m^2 K)" }

[sweep.all.report]
"#;

#[test]
fn a_chain_whose_every_number_varies() {
    let over = "over = \"run\"\n";
    let report = "a = \"max(n3.T - T_air)\"\nb = \"min(n0.T)\"\nc = \"mean(n7.T)\"\nd = \"last(n19.T)\"\n\
                  e = \"integral(skin.Q)\"\nf = \"time_over(n4.T, T_start + 5 [K])\"\ng = \"max(side.Q)\"\n";
    let closed = swept(&[&chain(""), over, AXES, report].concat(), "all");
    let other = swept(&[&chain("integrator = \"cvode\"\n"), over, AXES, report].concat(), "all");
    assert_eq!(closed.len(), 8);
    for (row, other) in closed.iter().zip(&other) {
        let scale = [1e-6, 1e-6, 1e-6, 1e-6, 1e-1, 1e-4, 1e-6];
        for ((found, other), scale) in row[5..].iter().zip(&other[5..]).zip(scale) {
            assert!((found - other).abs() < scale, "{found} {other}");
        }
    }
}

/// Steady states against those of the sparse solver, which `lptn steady` uses.
#[test]
fn steady_states_are_those_of_the_whole_solver() {
    let text = chain("").replace("P * if(t < 100 [s], 1, 0.5)", "P");
    let report = "a = \"n3.T\"\nb = \"n0.T - n19.T\"\nc = \"skin.Q\"\nd = \"air.Q + loss.P\"\n";
    let found = swept(&[&text, AXES, report].concat(), "all");
    let folder = Folder::with("net.toml", &[&text, AXES, report].concat());
    for row in found.iter().take(3) {
        let set: Vec<String> = ["scale", "T_start", "T_air", "h"]
            .iter()
            .zip(&row[1..])
            .zip(["", "degC", "degC", "W/(m^2 K)"])
            .map(|((name, value), unit)| format!("{name}={value} {unit}"))
            .collect();
        let mut words =
            vec!["steady", "net.toml", "--format", "json", "--temperature-unit", "degC"];
        set.iter().for_each(|set| words.extend(["--set", set.trim()]));
        let json = folder.run(&words).exits(0).json();
        let value = |name: &str| json["values"][name]["value"].as_f64().unwrap();
        let expected = [value("n3.T"), value("n0.T") - value("n19.T"), value("skin.Q"), 0.0];
        for (found, expected) in row[5..].iter().zip(expected) {
            assert!(
                (found - expected).abs() < 1e-9 * expected.abs().max(1.0),
                "{found} {expected}"
            );
        }
    }
}

/// What closed forms are refused for goes the other way, row by row, and fails with the same code.
#[test]
fn candidates_that_no_network_is_made_of_have_their_codes() {
    let text = THREE.replace(
        r#"G = ["3 W/K", "6 W/K"], P = ["20 W", "60 W"]"#,
        r#"G = ["3 W/K", "-1 W/K", "0 W/K"]"#,
    );
    let folder = Folder::with("net.toml", &text);
    let out = folder.run(&["sweep", "net.toml", "--no-files", "--format", "csv"]).exits(0).out;
    let codes: Vec<&str> =
        out.lines().skip(1).map(|line| line.rsplit(',').next().unwrap()).collect();
    assert_eq!(codes, ["", "network::not_positive", "network::not_positive"]);
}
