//! `lptn modes` and `lptn verify`, as a user meets them.

use crate::common;

use std::path::Path;

use common::{Folder, GEARBOX, csv, gearbox_values};
use serde_json::Value;

const MASSLESS: &str = "format = 1\n[node]\nj = { massless = true }\n[boundary]\na = { T = \"20 \
    degC\" }\n\
                        [resistor]\nr = { from = \"j\", to = \"a\", R = \"1 K/W\" }\n[run]\nstop \
                        = \"1 s\"\n";

/// A pulse of one second after a long rest: the steps of an integrator have grown long and go past
/// it.
const PULSE: &str = "format = 1\n[node]\nbody = { C = \"100 J/K\", T0 = \"20 degC\" }\n\
    [boundary]\nair = { T = \"20 degC\" }\n[resistor]\nskin = { from = \"body\", to = \"air\", R \
    = \"1 K/W\" }\n\
    [source]\npulse = { into = \"body\", P = \"1 [kW] * exp(-((t - 700 [s]) / 1 [s])^2)\" }\n\
    [run]\nstop = \"1000 s\"\n";

const TWO_MASSES: &str = include_str!("../../../networks/two_masses.toml");

const JACKET: &str = "format = 1\n[default]\nT0 = \"20 degC\"\n[boundary]\n\
    inlet = { T = \"20 degC\" }\n[node]\nwall = { C = \"2 kJ/K\" }\na = { C = \"50 J/K\" }\n\
    b = { C = \"50 J/K\" }\nc = { C = \"50 J/K\" }\nbody = { C = \"1 kJ/K\" }\n[advection]\n\
    s1 = { from = \"inlet\", to = \"a\", mcp = \"20 W/K\" }\n\
    s2 = { from = \"a\", to = \"b\", mcp = \"20 W/K\" }\n\
    s3 = { from = \"b\", to = \"c\", mcp = \"20 W/K\" }\n\
    s4 = { from = \"c\", to = \"inlet\", mcp = \"20 W/K\" }\n[resistor]\n\
    film = { from = \"wall\", to = \"b\", R = \"0.2 K/W\" }\n\
    skin = { from = \"body\", to = \"inlet\", R = \"0.2 K/W\" }\n[source]\n\
    heat = { into = \"wall\", P = \"100 [W] + 1 [W/s] * t\" }\n\
    loss = { into = \"body\", P = \"10 W\" }\n[run]\nstop = \"10 min\"\n";

/// A row of nodes.
fn row_of(nodes: usize) -> String {
    let mut text = String::from(
        "format = 1\n[default]\nT0 = \"0 degC\"\n[boundary]\nair = { T = \"10 degC\" }\n[node]\n",
    );
    (0..nodes).for_each(|i| text += &format!("n{i} = {{ C = \"1 J/K\" }}\n"));
    text += "[resistor]\nr0 = { from = \"air\", to = \"n0\", R = \"1 K/W\" }\n";
    (1..nodes).for_each(|i| {
        text += &format!("r{i} = {{ from = \"n{}\", to = \"n{i}\", R = \"1 K/W\" }}\n", i - 1)
    });
    text + "[run]\nstop = \"10 s\"\noutput = { every = \"5 s\" }\n"
}

fn scalar(value: &Value) -> f64 {
    value["value"].as_f64().unwrap_or_else(|| panic!("{value}"))
}

/// Whether it is linear, streams of constant capacity rate among its paths, and switches nothing.
fn is_exact(network: &lptn_network::Network, path: &Path) -> bool {
    let streams = ["heated_tube", "through_flow"];
    let streams = path.file_stem().is_some_and(|name| streams.iter().any(|stream| name == *stream));
    let linear = network.first_nonlinear().is_none() || streams;
    linear && !network.has_events()
}

#[test]
fn every_shipped_network_is_verified() {
    let networks = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../networks");
    let folder = Folder::empty();
    let mut found = 0;
    for entry in std::fs::read_dir(networks).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|ending| ending == "toml") {
            let network = lptn_netlist::read(&path).unwrap().network;
            let (exit, expected) = if network.nodes().is_empty() {
                (1, "not verified: there is nothing to compare")
            } else if !is_exact(&network, &path) {
                (0, "consistent, not verified: two tolerances agree within the allowed error")
            } else {
                (0, "verified: every node at every row is within the allowed error")
            };
            let ran = folder.run(&["verify", path.to_str().unwrap()]).exits(exit);
            assert_eq!(ran.out.lines().last(), Some(expected), "{path:?}");
            assert!(ran.out.lines().all(|line| line.chars().count() <= 80), "{}", ran.out);
            found += 1;
        }
    }
    assert!(found >= 7);
    assert!(folder.files().is_empty());
}

/// The pulse holds 1 kW sqrt(pi) s, which heats 100 J/K by 17.7 K; steps once grew past it.
#[test]
fn a_short_pulse_is_met() {
    let folder = Folder::with("pulse.toml", PULSE);
    let ran = folder.run(&["verify", "pulse.toml", "--format", "json"]).exits(0);
    assert_eq!(ran.json()["passes"], true);
    assert_eq!(ran.json()["worst"][0]["node"], "body");
}

#[test]
fn rates_over_fourteen_decades_are_verified_as_far_as_they_can_be() {
    let ladder = [
        ("1e3", "1e3"),
        ("1e-6", "1"),
        ("100", "100"),
        ("1e-3", "0.01"),
        ("10", "10"),
        ("1", "0.5"),
    ];
    let mut nodes = String::from("format = 1\n[boundary]\nn6 = { T = \"0 degC\" }\n[node]\n");
    let mut paths = String::from("[source]\ns = { into = \"n0\", P = \"50 W\" }\n[resistor]\n");
    for (i, (c, g)) in ladder.iter().enumerate() {
        nodes += &format!("n{i} = {{ C = \"{c} J/K\", T0 = \"0 degC\" }}\n");
        paths += &format!("r{i} = {{ from = \"n{i}\", to = \"n{}\", G = \"{g} W/K\" }}\n", i + 1);
    }
    let text = nodes + &paths + "[run]\nstop = \"1e6 s\"\n";
    let folder = Folder::with("stiff.toml", &text);
    folder
        .run(&["verify", "stiff.toml", "--tolerance", "1e-9K"])
        .exits(0)
        .prints("exact solution, 6 modes");
    // over more, and hotter, what rounding leaves is more than a tenth of what is allowed
    let text = text
        .replace("50 W", "500 W")
        .replace("1e-6 J/K", "1e-3 J/K")
        .replace("1e3 W/K", "1e17 W/K");
    let folder = Folder::with("stiffer.toml", &text);
    let ran = folder.run(&["verify", "stiffer.toml", "--tolerance", "1e-9K"]).exits(0);
    ran.prints("no independent solution: time constants differ").prints("consistent, not verified");
}

/// Three equal cells in a stream along a wall; a body that no stream touches goes by its mode.
#[test]
fn streams_of_constant_capacity_rate_are_verified() {
    let folder = Folder::with("jacket.toml", JACKET);
    let ran = folder.run(&["verify", "jacket.toml"]).exits(0);
    ran.prints("exact solution, 1 mode, 4 nodes by matrix exponential")
        .prints("verified: every node at every row is within the allowed error");
    let json = folder.json("verify jacket.toml").exits(0).json();
    let reference = &json["reference"];
    assert_eq!((&reference["modes"], &reference["exponential"]), (&1.into(), &4.into()));
    assert_eq!((&reference["independent"], &json["passes"]), (&true.into(), &true.into()));
    let error = scalar(&reference["own_error"]);
    assert!(error > 0.0 && error < 1e-11, "{error}");
}

#[test]
fn modes_are_listed_slowest_first() {
    let ran = Folder::with_gearbox().run(&["modes", "gearbox.toml"]).exits(0);
    assert!(ran.out.lines().all(|line| line.chars().count() <= 80));
    let ran = ran.prints("   1  13.233 min  aluminium 53.0 %, steel 47.0 %");
    ran.prints("   2    5.0683 s  steel 53.0 %, aluminium 47.0 %");
}

#[test]
fn modes_as_json_follow_the_schema() {
    let json =
        Folder::with_gearbox().run(&["modes", "gearbox.toml", "--format", "json"]).exits(0).json();
    assert_eq!((&json["format"], &json["network"]), (&Value::from(1), &Value::from("gearbox")));
    assert!(json["warnings"].as_array().is_some_and(Vec::is_empty));
    let modes = json["modes"].as_array().unwrap();
    // validation/gearbox_two_node: the same numbers as networks/gearbox.toml
    for (mode, tau) in modes.iter().zip(gearbox_values("time_constant", "")) {
        assert!((scalar(&mode["tau"]) / tau - 1.0).abs() < 1e-12, "{mode}");
        assert_eq!(mode["tau"]["unit"], "s");
        let parts = mode["participation"].as_object().unwrap();
        assert!((parts.values().map(scalar).sum::<f64>() - 1.0).abs() < 1e-14);
        assert!(
            mode["shape"].as_object().unwrap().values().any(|x| (scalar(x) - 1.0).abs() < 1e-15)
        );
    }
    assert_eq!(modes.len(), 2);
}

#[test]
fn what_lasts_for_ever_is_null_and_noted() {
    let folder = Folder::with("two.toml", TWO_MASSES);
    let json = folder.run(&["modes", "two.toml", "--format", "json"]).exits(0).json();
    assert!(json["modes"][0]["tau"]["value"].is_null());
    assert!(
        json["notes"][0].as_str().unwrap().contains("no path leads from its nodes to a boundary")
    );
    assert!((scalar(&json["modes"][1]["tau"]) - 0.75).abs() < 1e-15);
    folder
        .run(&["modes", "two.toml"])
        .exits(0)
        .prints("infinite")
        .prints("note: 1 mode lasts without end");
}

#[test]
fn count_keeps_the_slowest() {
    let folder = Folder::with_gearbox();
    let ran = folder.run(&["modes", "gearbox.toml", "--count", "1"]).exits(0);
    ran.prints("note: the 1 slowest of 2 modes; --count N shows others");
    let (headers, rows) =
        csv(&folder.run(&["modes", "gearbox.toml", "--count", "1", "--format", "csv"]).out);
    assert_eq!(headers[..3], ["tau [s]", "steel.shape [-]", "steel.participation [-]"]);
    assert_eq!(rows.len(), 1);
    folder.run(&["modes", "gearbox.toml", "--count", "0"]).exits(2);
}

#[test]
fn a_network_without_capacity_has_no_modes_and_says_so() {
    let folder = Folder::with("j.toml", MASSLESS);
    folder.run(&["modes", "j.toml"]).exits(0).prints("no node stores heat");
    let json = folder.run(&["modes", "j.toml", "--format", "json"]).exits(0).json();
    assert_eq!(json["modes"], Value::Array(Vec::new()));
}

#[test]
fn large_networks_have_their_slowest_modes_and_no_independent_solution() {
    let folder = Folder::with("row.toml", &row_of(2001));
    folder.run(&["modes", "row.toml"]).exits(0).prints("the 10 slowest of 2001 modes");
    let (_, rows) = csv(&folder.run(&["modes", "row.toml", "-k", "3", "--format", "csv"]).out);
    for (k, row) in (1_u32..).zip(&rows) {
        // held beyond one end, free at the other: 1/tau = 4 sin^2((2k - 1) pi / (4n + 2))
        let angle = f64::from(2 * k - 1) * std::f64::consts::PI / (4.0 * 2001.0 + 2.0);
        let exact = 1.0 / (4.0 * angle.sin().powi(2));
        assert!((row[0] / exact - 1.0).abs() < 1e-9, "{} {exact}", row[0]);
    }
    assert_eq!(rows.len(), 3);
    let ran =
        folder.run(&["verify", "row.toml"]).exits(0).prints("no independent solution: 2001 nodes");
    assert!(
        ran.out
            .ends_with("consistent, not verified: two tolerances agree within the allowed error\n")
    );
    let json = folder.run(&["verify", "row.toml", "--format", "json"]).exits(0).json();
    assert_eq!(
        (&json["reference"]["independent"], &json["passes"]),
        (&Value::from(false), &Value::from(true))
    );
}

#[test]
fn rows_have_the_same_columns_in_csv_and_json() {
    let folder = Folder::with_gearbox();
    let (headers, rows) =
        csv(&folder.run(&["verify", "gearbox.toml", "--format", "csv"]).exits(0).out);
    let json = folder.run(&["verify", "gearbox.toml", "--format", "json"]).exits(0).json();
    let columns = json["columns"].as_array().unwrap().iter();
    let named: Vec<String> = columns
        .map(|c| format!("{} [{}]", c["name"].as_str().unwrap(), c["unit"].as_str().unwrap()))
        .collect();
    assert_eq!(headers, named);
    assert_eq!(
        headers,
        [
            "tolerance [K]",
            "difference [K]",
            "allowed [K]",
            "time [s]",
            "steel.difference [K]",
            "aluminium.difference [K]"
        ]
    );
    let written: Vec<Vec<f64>> = serde_json::from_value(json["rows"].clone()).unwrap();
    assert_eq!((rows.len(), written.len()), (2, 2));
    for (row, written) in rows.iter().zip(&written) {
        // serde_json reads numbers to the last digit but one
        assert!(
            row.iter().zip(written).all(|(a, b)| (a - b).abs() <= 1e-15 * b.abs()),
            "{row:?} {written:?}"
        );
        assert!(row[1] <= row[2] && row[1] > 0.0, "{row:?}");
        assert!((row[1] - row[4].max(row[5])).abs() < 1e-300);
    }
    assert_eq!(json["passes"], true);
}

#[test]
fn tolerances_can_be_chosen() {
    let folder = Folder::with_gearbox();
    for (tolerance, allowed) in [("1e-3K", 1e-2), ("1e-4K", 1e-3), ("1e-6K", 5e-5), ("1e-7K", 5e-6)]
    {
        let arguments = ["verify", "gearbox.toml", "--tolerance", tolerance, "--format", "csv"];
        let (_, rows) = csv(&folder.run(&arguments).exits(0).out);
        assert!((rows[0][2] / allowed - 1.0).abs() < 1e-6, "{tolerance}: {rows:?}");
    }
    folder.run(&["verify", "gearbox.toml", "--tolerance", "1 W"]).exits(2);
}

#[test]
fn a_network_without_a_run_is_not_verified() {
    let text = GEARBOX.split("[run]").next().unwrap();
    Folder::with("gearbox.toml", text)
        .run(&["verify", "gearbox.toml"])
        .exits(2)
        .says("run::no_run");
}

#[test]
fn an_input_that_fails_ends_with_its_place() {
    let text = GEARBOX.replace("P = \"P_7000\"", "P = \"P_7000 * sqrt(1 - t / 60 [s])\"");
    assert_ne!(text, GEARBOX);
    let ran = Folder::with("gearbox.toml", &text).run(&["verify", "gearbox.toml"]).exits(3);
    ran.says("solve::input").says("P_7000 * sqrt");
}

/// A ball that glows into space: d(sigma A T^4)/dT over C is its rate.
#[test]
fn a_network_that_is_not_linear_has_modes_near_a_state() {
    let glowing = "format = 1\n[node]\nball = { C = \"500 J/K\", T0 = \"900 K\" }\n[boundary]\n\
        space = { T = \"300 K\" }\n[radiation]\nglow = { from = \"ball\", to = \"space\", emissivity = 1, \
        area = \"0.05 m^2\" }\n[source]\nheater = { into = \"ball\", P = \"1 kW\" }\n[run]\n\
        stop = \"1 min\"\n";
    let folder = Folder::with("glow.toml", glowing);
    let refused = folder.run(&["modes", "glow.toml"]).exits(2);
    refused.says("linearised::not_linear").says("glow.toml:7:1").says("--at steady");
    let json = folder.run(&["modes", "glow.toml", "--at", "steady", "--format", "json"]);
    let json = json.exits(0).json();
    let hot = (300.0_f64.powi(4) + 1000.0 / (5.670_374_419e-8 * 0.05)).powf(0.25);
    let tau = 500.0 / (4.0 * 5.670_374_419e-8 * 0.05 * hot.powi(3));
    assert!((scalar(&json["modes"][0]["tau"]) / tau - 1.0).abs() < 1e-9);
    assert_eq!(json["at"]["settled"], true);
    assert!((scalar(&json["at"]["tried"]["disturbance"]) - 10.0).abs() < 1e-12);
    let at = folder.run(&["modes", "glow.toml", "--at", "0s"]).exits(0);
    at.prints("linearised at the state at 0 s: for ± 10 K");
    let tau = 500.0 / (4.0 * 5.670_374_419e-8 * 0.05 * 900.0_f64.powi(3));
    let (_, rows) = csv(&folder.run(&["modes", "glow.toml", "--at=0s", "--format=csv"]).out);
    let found = rows[0][0];
    assert!((found / tau - 1.0).abs() < 1e-9, "{found} {tau}");
    folder.run(&["modes", "glow.toml", "--at", "2min"]).exits(2).says("run::time");
    folder.run(&["modes", "glow.toml", "--at", "10 K"]).exits(2);
}

#[test]
fn a_state_is_verified_with_what_its_linear_network_misses() {
    let networks = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../networks");
    let verify = |name: &str, code: i32| {
        let file = networks.join(name);
        let words = ["verify", file.to_str().unwrap(), "--at", "steady"];
        Folder::empty().run(&words).exits(code).out
    };
    let parts = verify("gearbox_parts.toml", 0);
    assert!(parts.contains("in turn by +/- 0.1 K"), "{parts}");
    assert!(parts.trim_end().ends_with("for a disturbance of 10 K, less for smaller ones"));
    let still = verify("natural_convection.toml", 1);
    assert!(still.trim_end().ends_with("% even for a disturbance of 0.1 K"), "{still}");
    let linear = verify("gearbox.toml", 0);
    assert!(linear.trim_end().ends_with("every node is within the allowed error of runs"));
    for page in [parts, still, linear] {
        assert!(page.lines().all(|line| line.chars().count() <= 80), "{page}");
    }
}
