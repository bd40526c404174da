//! `lptn reduce --at`, as a user meets it.

use std::path::Path;

use crate::common;

use common::Folder;
use serde_json::Value;

const GLOWING: &str = "format = 1\n[node]\nball = { C = \"500 J/K\", T0 = \"900 K\" }\n[boundary]\n\
    space = { T = \"300 K\" }\n[radiation]\nglow = { from = \"ball\", to = \"space\", \
    emissivity = 1, area = \"0.05 m^2\" }\n[source]\nheater = { into = \"ball\", P = \"1 kW\" }\n\
    [run]\nstop = \"1 min\"\n";

/// A body that a heater keeps between 55 and 65 degC; 2 K/W to the air.
const SWITCHED: &str = "format = 1\n[node]\nbody = { C = \"100 J/K\", T0 = \"60 degC\" }\n\
    [boundary]\nair = { T = \"20 degC\" }\n[resistor]\nskin = { from = \"body\", to = \"air\", \
    R = \"2 K/W\" }\n[control]\nheats = { sense = \"body\", on_below = \"55 degC\", \
    off_above = \"65 degC\", start = \"on\" }\n[source]\nheat = { into = \"body\", P = \"40 [W] * heats\" }\n\
    [run]\nstop = \"10 s\"\noutput = { every = \"1 s\" }\n";

fn scalar(value: &Value) -> f64 {
    value["value"].as_f64().unwrap_or_else(|| panic!("{value}"))
}

/// `P = sigma A (T^4 - T_s^4)`, so `R = 1 / (4 sigma A T^3)`.
#[test]
fn a_glowing_ball_is_one_node_near_its_steady_state() {
    let folder = Folder::with("glow.toml", GLOWING);
    let refused = folder.run(&["reduce", "glow.toml", "--port", "ball"]).exits(2);
    refused.says("reduce::not_linear").says("--at steady");
    let ran = folder.run(&["reduce", "glow.toml", "--port", "ball", "--at", "steady"]).exits(0);
    let first = ran.out.lines().next();
    assert_eq!(first, Some("near the steady state it collapses to one node, exactly"));
    ran.prints("linearised at the steady state: for ± 10 K");
    let json = folder.json("reduce glow.toml --port ball --at steady").exits(0).json();
    let area = 5.670_374_419e-8 * 0.05;
    let hot = (300.0_f64.powi(4) + 1000.0 / area).powf(0.25);
    let resistance = 1.0 / (4.0 * area * hot.powi(3));
    assert!((scalar(&json["R_eq"]) / resistance - 1.0).abs() < 1e-9, "{}", json["R_eq"]);
    assert!((scalar(&json["Q_N"]) / 1000.0 - 1.0).abs() < 1e-12);
    assert!((scalar(&json["at"]["tried"]["disturbance"]) - 10.0).abs() < 1e-12);
    // what is missed: sigma A ((T + 10)^4 - T^4 - 4 T^3 10)
    let missed = area * ((hot + 10.0).powi(4) - hot.powi(4) - 40.0 * hot.powi(3));
    assert!((scalar(&json["at"]["tried"]["heat"]) / missed - 1.0).abs() < 1e-6);
    let at = folder.run(&["reduce", "glow.toml", "--port", "ball", "--at", "30s"]).exits(0);
    at.prints("near the state at 30 s it collapses to one node");
}

/// Natural convection at rest carries no heat per K: `h` falls to 0 with dT^(1/3), so heat flows
/// have no slope, and both commands have to say so of the same state.
#[test]
fn a_state_without_slopes_is_neither_reduced_nor_verified() {
    let networks = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../networks");
    let file = networks.join("natural_convection.toml");
    let file = file.to_str().unwrap();
    let folder = Folder::empty();
    let reduced = folder.run(&["reduce", file, "--port", "wall", "--at", "steady"]).exits(1);
    assert!(!reduced.out.contains("exactly") && !reduced.out.contains("use R_eq"));
    reduced.prints("near the steady state it does not collapse: heat flows are not linear there");
    let words = ["reduce", file, "--port", "wall", "--at", "steady", "--format", "json"];
    let json = folder.run(&words).exits(1).json();
    assert_eq!(
        (&json["verdict"]["collapses"], &json["verdict"]["error"]),
        (&false.into(), &Value::Null)
    );
    folder.run(&["verify", file, "--at", "steady"]).exits(1).prints("not verified");
    folder.run(&["modes", file, "--at", "steady"]).prints("heat flows are not linear there");
}

#[test]
fn a_network_that_switches_is_held_as_it_is() {
    let folder = Folder::with("switched.toml", SWITCHED);
    let json = folder.json("reduce switched.toml --port body --at 5s").exits(0).json();
    assert!((scalar(&json["R_eq"]) - 2.0).abs() < 1e-12);
    let heat = scalar(&json["Q_N"]);
    assert!(heat.abs() < 1e-12 || (heat - 40.0).abs() < 1e-12, "{heat}");
    assert!((json["T_ref"]["value"].as_f64().unwrap_or(f64::NAN) - 20.0).abs() < 1e-9);
}

#[test]
fn what_is_about_whole_runs_is_refused_near_a_state() {
    let folder = Folder::with("glow.toml", GLOWING);
    for more in [
        &["--write", "one.toml"][..],
        &["--format", "toml"],
        &["--bias"],
        &["--for", "run"],
        &["--max-error", "1K"],
    ] {
        let words = [&["reduce", "glow.toml", "--port", "ball", "--at", "steady"], more].concat();
        folder.run(&words).exits(2).says("reduce::near").says(more[0]);
    }
    folder.run(&["reduce", "glow.toml", "--keep", "ball", "--at", "steady"]).exits(2);
    folder
        .run(&["reduce", "glow.toml", "--port", "ball", "--at", "2min"])
        .exits(2)
        .says("run::time");
    assert_eq!(folder.files(), ["glow.toml"]);
}

/// A body of 100 J/K and 1 W/K with a lid of 10 J/K; two states of no heat capacity.
const WATCHED: &str = "format = 1\n[boundary]\nroom = { T = \"20 degC\" }\n[node]\npot = { C = \"100 \
    J/K\", T0 = \"20 degC\" }\nlid = { C = \"10 J/K\", T0 = \"20 degC\" }\n[resistor]\nloss = { from = \
    \"pot\", to = \"room\", G = \"1 W/K\" }\nseal = { from = \"pot\", to = \"lid\", G = \"1 W/K\" }\n\
    [state]\nfelt = { rate = \"(pot.T - felt) / 5 [s]\", start = \"20 degC\" }\n[source]\ns = { into = \
    \"pot\", P = \"5 W\" }\n[run]\nstop = \"100 s\"\n";

#[test]
fn states_have_no_capacity() {
    let folder = Folder::with("watched.toml", WATCHED);
    let json = folder.json("reduce watched.toml --port pot --at steady").exits(0).json();
    assert!((scalar(&json["C_eq"]["sum"]) - 110.0).abs() < 1e-9, "{}", json["C_eq"]);
    assert!((scalar(&json["R_eq"]) - 1.0).abs() < 1e-9, "{}", json["R_eq"]);
}

/// Under an integral, heat into the body leaves its steady temperature as it is.
#[test]
fn a_port_that_a_controller_keeps_is_refused() {
    let controlled = WATCHED.replace("\"5 W\"", "\"duty\"")
        + "[controller.duty]\nsense = \"lid\"\n\
        setpoint = \"40 degC\"\nK_p = \"1 W/K\"\nK_i = \"0.01 W/(K s)\"\nmin = \"0 W\"\nmax = \"100 W\"\n";
    let folder = Folder::with("controlled.toml", &controlled);
    for port in ["pot", "lid"] {
        let args = ["reduce", "controlled.toml", "--port", port, "--at", "steady"];
        folder.run(&args).exits(2).says("reduce::held").says("choose another port");
    }
}
