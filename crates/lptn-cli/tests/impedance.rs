//! `lptn impedance`, as a user meets it.

mod common;

use common::{Folder, csv};
use serde_json::Value;

/// 100 J/K at 2 K/W: 200 s; another part that nothing grounds.
const BODY: &str = "format = 1\n[default]\nT0 = \"20 degC\"\n[node]\nbody = { C = \"100 J/K\" }\n\
    loose = { C = \"5 J/K\" }\n[boundary]\nair = { T = \"20 degC\" }\n[resistor]\n\
    skin = { from = \"body\", to = \"air\", R = \"2 K/W\" }\n[source]\n\
    heat = { into = \"body\", P = \"1 W\" }\n";

fn scalar(value: &Value) -> f64 {
    value["value"].as_f64().unwrap_or_else(|| panic!("{value}"))
}

#[test]
fn a_step_and_its_pulses_are_one_exponential() {
    let folder = Folder::with("body.toml", BODY);
    let arguments = ["impedance", "body.toml", "--port", "heat", "--time", "20s,200s"];
    let ran = folder.run(&arguments).exits(0);
    ran.prints("`body` rises by 2 K/W of `heat`, settled").prints("63.21 %");
    let with_pulses =
        ["impedance", "body.toml", "--port", "body", "--time=200s", "--duty=0.25", "--format=csv"];
    let (headers, rows) = csv(&folder.run(&with_pulses).exits(0).out);
    assert_eq!(headers, ["time [s]", "rise [K/W]", "duty 0.25 [K/W]"]);
    let rise = -2.0 * (-1.0_f64).exp_m1();
    assert!((rows[0][1] - rise).abs() < 1e-14);
    assert!((rows[0][2] + rise / (-4.0_f64).exp_m1()).abs() < 1e-14);
    let json = folder.json("impedance body.toml --port body").exits(0).json();
    assert!((scalar(&json["settled"]) - 2.0).abs() < 1e-15);
    // three a decade, from a tenth of the time constant to five of them
    let times: Vec<f64> =
        json["points"].as_array().unwrap().iter().map(|point| scalar(&point["time"])).collect();
    assert_eq!((times[0], *times.last().unwrap()), (10.0, 1000.0));
}

#[test]
fn a_swing_is_r_over_one_plus_j_omega_rc() {
    let folder = Folder::with("body.toml", BODY);
    let list = ["impedance", "body.toml", "--port", "air", "--to", "body", "--omega"];
    let ran = folder.run(&[&list[..], &["0 rad/s, 5 mrad/s, 1 Hz", "--format=json"]].concat());
    let points = ran.exits(0).json()["points"].clone();
    for (point, omega) in points.as_array().unwrap().iter().zip([0.0, 5e-3, std::f64::consts::TAU])
    {
        assert!((scalar(&point["omega"]) - omega).abs() < 1e-15);
        let size = 1.0 + (200.0 * omega).powi(2);
        assert!((scalar(&point["re"]) - 1.0 / size).abs() < 1e-14);
        assert!((scalar(&point["im"]) + 200.0 * omega / size).abs() < 1e-14);
    }
    let ran = folder.run(&["impedance", "body.toml", "--port", "body", "--omega"]).exits(0);
    ran.prints("amplitude [K/W]").prints("phase [deg]");
}

/// Equal cells in a stream have one mode for all: `1/mcp P(k, t mcp / C)` by mpmath, as in
/// `crates/lptn-solve/tests/response.rs`.
#[test]
fn a_chain_of_equal_cells_answers_without_modes() {
    let mut text = String::from(
        "format = 1\n[default]\nT0 = \"20 degC\"\n[boundary]\ninlet = { T = \
        \"20 degC\" }\n[node]\n",
    );
    (1..=6).for_each(|i| text += &format!("c{i} = {{ C = \"50 J/K\" }}\n"));
    text += "[advection]\ns1 = { from = \"inlet\", to = \"c1\", mcp = \"20 W/K\" }\n\
        s7 = { from = \"c6\", to = \"inlet\", mcp = \"20 W/K\" }\n";
    let hose = |i| format!("s{i} = {{ from = \"c{}\", to = \"c{i}\", mcp = \"20 W/K\" }}\n", i - 1);
    (2..=6).for_each(|i| text += &hose(i));
    let folder = Folder::with("chain.toml", &text);
    folder.run(&["modes", "chain.toml"]).exits(2).says("modes::defective");
    let words =
        ["impedance", "chain.toml", "--port=c1", "--to=c6", "--time=5s,20s", "--format=csv"];
    let (_, rows) = csv(&folder.run(&words).exits(0).out);
    let expected = [8.281_804_240_307_22e-4, 0.040_438_196_896_018_74];
    for (row, rise) in rows.iter().zip(expected) {
        assert!((row[1] / rise - 1.0).abs() < 1e-12, "{row:?}");
    }
    let pulses = ["impedance", "chain.toml", "--port=c1", "--duty=0.25"];
    folder.run(&pulses).exits(0).prints("D = 0.25");
    folder.run(&["impedance", "chain.toml", "--port=c1", "--omega"]).exits(0);
}

#[test]
fn what_cannot_be_asked_is_said() {
    let folder = Folder::with("body.toml", BODY);
    let refused = |words: &[&str], code: &str| {
        folder.run(&[&["impedance", "body.toml"], words].concat()).exits(2).says(code);
    };
    refused(&[], "impedance::no_port");
    refused(&["--port", "air"], "impedance::no_node");
    refused(&["--port", "bdy"], "did you mean `body`?");
    refused(&["--port", "body", "--to", "air"], "reduce::boundary_port");
    refused(&["--port", "loose"], "response::no_ground");
    refused(&["--port", "body", "--time", "2s,1s"], "impedance::list");
    refused(&["--port", "body", "--time", "0s"], "impedance::list");
    refused(&["--port", "body", "--omega", "3 K"], "--omega");
    refused(&["--port", "body", "--duty", "1.5"], "impedance::duty");
    refused(&["--port", "body", "--to", "loose", "--duty", "0.5"], "impedance::pulses_elsewhere");
    let loose = ["impedance", "body.toml", "--port", "loose", "--omega", "1 rad/s"];
    folder.run(&loose).exits(0).prints("0.2").prints("-90");
}
