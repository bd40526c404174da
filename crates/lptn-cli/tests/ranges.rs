//! Analytic: laws outside the ranges in which they are known, told with the times that follow by
//! hand: Re = rho u D / mu rises with the speed.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common;

use common::Folder;
use serde_json::Value;

/// Re = 2750 t/s: below 0.4 until 0.000 145 s, above 4e5 from 145.45 s on.
const ROD: &str = r#"
format = 1
[boundary]
room = { T = "20 degC" }
[node]
rod = { T0 = "80 degC", C = "100 J/K" }
[convection.skin]
from = "rod"
to = "room"
correlation = "cylinder_in_cross_flow_hilpert"
k = "0.0277 W/(m K)"
density = "1.1 kg/m^3"
cp = "1007 J/(kg K)"
viscosity = "20 uPa s"
speed = "1 [m/s^2] * t"
diameter = "50 mm"
area = "0.02 m^2"
[run]
stop = "200 s"
output = { every = "50 s" }
"#;

#[track_caller]
fn near(found: &Value, expected: f64, relative: f64) {
    let found = found.as_f64().unwrap();
    assert!((found - expected).abs() <= relative * expected, "{found} is not {expected}");
}

fn warned(json: &Value) -> Option<String> {
    let warnings = json["warnings"].as_array().unwrap();
    let found = warnings.iter().find(|w| w["code"] == "run::out_of_range")?;
    Some(found["message"].as_str().unwrap().to_owned())
}

#[test]
fn a_run_tells_from_when_to_when_a_law_is_outside_its_range() {
    let folder = Folder::with("rod.toml", ROD);
    let json = folder.run(&["run", "rod.toml", "--format", "json"]).exits(0).json();
    let outside = json["out_of_range"].as_array().unwrap();
    assert_eq!(outside.len(), 1, "{outside:?}");
    let of = &outside[0];
    assert_eq!([&of["path"], &of["group"]], ["skin", "Re"]);
    assert_eq!(of["law"], "cylinder_in_cross_flow_hilpert");
    let stretches = of["stretches"].as_array().unwrap();
    assert_eq!(stretches.len(), 2);
    near(&stretches[0][1]["value"], 0.4 / 2750.0, 1e-9);
    near(&stretches[1][0]["value"], 4e5 / 2750.0, 1e-9);
    near(&stretches[1][1]["value"], 200.0, 1e-12);
    let message = warned(&json).unwrap();
    assert!(message.contains("in 2 stretches from 0 s to 3.333 min, 54.5 s in all"), "{message}");
    let manifest: Value = serde_json::from_str(&folder.read("out/rod/manifest.json")).unwrap();
    assert_eq!(manifest["out_of_range"], json["out_of_range"]);
}

#[test]
fn a_law_that_stays_in_its_range_is_not_spoken_of() {
    let steady = ROD.replace("1 [m/s^2] * t", "3 m/s");
    for verb in ["run", "steady"] {
        let folder = Folder::with("rod.toml", &steady);
        let mut arguments = vec![verb, "rod.toml", "--format", "json"];
        arguments.extend((verb == "run").then_some("--no-files"));
        let json = folder.run(&arguments).exits(0).json();
        assert!(json["out_of_range"].is_null() && warned(&json).is_none(), "{json}");
    }
}

#[test]
fn a_steady_state_tells_it_without_times() {
    let fast = ROD.replace("1 [m/s^2] * t", "200 m/s");
    let folder = Folder::with("rod.toml", &fast);
    let json = folder.run(&["steady", "rod.toml", "--format", "json"]).exits(0).json();
    let of = &json["out_of_range"][0];
    near(&of["value"], 200.0 * 2750.0, 1e-12);
    assert!(of["at"].is_null() && of["stretches"].is_null(), "{of}");
    let message = warned(&json).unwrap();
    let said = "Re of `skin` is 550000, but `cylinder_in_cross_flow_hilpert` is known for a Reynolds \
        number from 0.4 to 400000";
    assert_eq!(message, said);
}

#[test]
fn a_report_says_whether_laws_were_known_and_whose_constants_are_not_verified() {
    let shaft = r#"
format = 1
[boundary]
room = { T = "20 degC" }
[node]
a = { T0 = "80 degC", C = "100 J/K" }
[convection]
shaft = { from = "a", to = "room", correlation = "rotating_shaft", fluid = "air", rotation = "3000 rpm", diameter = "40 mm", area = "0.1 m^2" }
[run]
stop = "10 s"
"#;
    let folder = Folder::with("x.toml", shaft);
    folder.run(&["steady", "x.toml", "--report=page.html"]).exits(0);
    let page = folder.read("page.html");
    assert!(page.contains("no law, fluid or capacity left its range"), "{page}");
    assert!(page.contains("unverified constants: <code>shaft</code>"), "{page}");
    folder.write("y.toml", &shaft.replace("3000 rpm", "300000 rpm"));
    folder.run(&["steady", "y.toml", "--report=page.html"]).exits(0);
    assert!(
        folder.read("page.html").contains("a law left its range, see the messages: Re_w of shaft")
    );
}

/// The pitch line velocity is 3 m/s² t: below 2 m/s until 0.667 s, above 25 m/s from 8.33 s on.
#[test]
fn a_loss_is_watched_like_a_path() {
    let gears = r#"
format = 1
[boundary]
room = { T = "20 degC" }
[node]
wheel = { T0 = "20 degC", C = "1 kJ/K" }
[resistor]
foot = { from = "wheel", to = "room", G = "5 W/K" }
[mesh.teeth]
into = "wheel"
model = "external"
speed = "100 [rad/s^2] * t"
torque = "50 N m"
z1 = 20
z2 = 60
module = "3 mm"
width = "30 mm"
Ra = "0.5 um"
nu = "60 mm^2/s"
density = "860 kg/m^3"
[run]
stop = "10 s"
"#;
    let folder = Folder::with("gears.toml", gears);
    let json = folder.run(&["run", "gears.toml", "--format", "json"]).exits(0).json();
    // the law bends the straight line of the speed, which the one-step method must not take
    let asked = ["run", "gears.toml", "--no-files", "-v"];
    assert!(folder.run(&asked).out.contains("CVODE"));
    let of = &json["out_of_range"][0];
    assert_eq!([&of["source"], &of["group"], &of["law"]], ["teeth", "v", "external"]);
    let stretches = of["stretches"].as_array().unwrap();
    assert_eq!(stretches.len(), 2, "{of}");
    near(&stretches[0][1]["value"], 2.0 / 3.0, 1e-9);
    near(&stretches[1][0]["value"], 25.0 / 3.0, 1e-9);
    let message = warned(&json).unwrap();
    let said = "but `external` is known for a pitch line velocity in m/s from 2 to 25";
    assert!(message.contains(said), "{message}");
}

/// A seal by a formula whose constants were not read, 2.429e-3 N m/mm x 50 mm x 104.72 rad/s =
/// 12.718 W; every verb that tells a result of it says so.
const UNSURE: &str = "format = 1
[param]
G = '2 W/K'
[node]
cover = { C = '200 J/K', T0 = '20 degC' }
[boundary]
air = { T = '20 degC' }
[resistor]
skin = { from = 'cover', to = 'air', G = 'G' }
[seal]
lip = { into = 'cover', speed = '1000 rpm', d = '50 mm', model = 'nbr' }
[run]
stop = '10 min'
[size.skin]
minimise = 'G'
vary = { G = { from = '0.1 W/K', to = '10 W/K' } }
require = ['cover.T <= 30 [degC]']
[fit.warm]
data = 'record.csv'
column = { cover = 'cover.T' }
sigma = '0.1 K'
vary = { G = { from = '0.1 W/K', to = '10 W/K' } }
";

#[test]
fn every_result_says_which_constants_are_unverified() {
    let folder = Folder::with("net.toml", UNSURE);
    let rise = |t: f64| 20.0 + 12.718 / 2.0 * (1.0 - (-t / 100.0).exp());
    let rows: Vec<String> =
        (0..=60).map(|i| f64::from(i) * 10.0).map(|t| format!("{t},{}", rise(t))).collect();
    folder.write("record.csv", &format!("t [s],cover [degC]\n{}\n", rows.join("\n")));
    for words in [
        &["run", "net.toml"][..],
        &["steady", "net.toml"],
        &["modes", "net.toml"],
        &["reduce", "net.toml", "--port", "cover"],
        &["size", "net.toml"],
        &["fit", "network", "net.toml"],
        &["compare", "net.toml"],
    ] {
        let ran = folder.run(words);
        let said = format!("{}{}", ran.out, ran.err);
        assert!(said.contains("unverified constants: `lip`"), "{words:?}: {said}");
    }
}

/// Oil in a bath that warms by 0.5 K/s from 60 degC on, with 8 mm^2/s at 40 and 2.5 at 100 degC.
const THIN: &str = "format = 1
[param]
G = '2 W/K'
[lubricant.thin]
viscosity = [['40 degC', '8 mm^2/s'], ['100 degC', '2.5 mm^2/s']]
source = 'made up'
[boundary]
room = { T = '20 degC' }
bath = { T = '60 [degC] + 0.5 [K/s] * t' }
[node]
box = { C = '100 J/K', T0 = '20 degC' }
[resistor]
skin = { from = 'box', to = 'room', G = 'G' }
[bearing.front]
into = 'box'
speed = '1500 rpm'
model = 'no_load'
d_m = '60 mm'
f0 = 2
lubricant = 'thin'
at = 'bath'
[size.skin]
minimise = 'G'
vary = { G = { from = '1 W/K', to = '10 W/K' } }
require = ['box.T <= 40 [degC]']
[run]
stop = '200 s'
output = { every = '20 s' }
";

/// ASTM D341 through the two points: nu in mm^2/s at a temperature in K, and back.
fn thin(kelvin: f64) -> f64 {
    let level = |nu: f64| (nu + 0.7).ln().ln();
    let slope = (level(8.0) - level(2.5)) / (373.15_f64 / 313.15).ln();
    (level(8.0) - slope * (kelvin / 313.15).ln()).exp().exp() - 0.7
}

#[test]
fn oil_thinner_than_its_curve_is_known_for_is_told() {
    let folder = Folder::with("oil.toml", THIN);
    let run = folder.run(&["run", "oil.toml", "--format", "json"]).exits(0).json();
    let of = &run["out_of_range"][0];
    assert_eq!([&of["source"], &of["group"], &of["law"]], ["front", "nu", "no_load"]);
    near(&of["value"], thin(273.15 + 160.0), 1e-9);
    // where it is 2 mm^2/s, as near as the steps of the run are to each other
    let (mut low, mut high) = (333.15, 433.15);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        (low, high) = if thin(middle) > 2.0 { (middle, high) } else { (low, middle) };
    }
    near(&of["stretches"][0][0]["value"], (low - 333.15) / 0.5, 0.05);
    assert!(warned(&run).unwrap().contains("viscosity of the lubricant in mm^2/s at least 2"));
    // at the start it is thick enough
    let steady = folder.run(&["steady", "oil.toml", "--format", "json"]).exits(0).json();
    assert!(steady["out_of_range"].is_null(), "{steady}");
    folder.write("hot.toml", &THIN.replace("60 [degC] + 0.5 [K/s] * t", "149.5 degC"));
    let steady = folder.run(&["steady", "hot.toml", "--format", "json"]).exits(0).json();
    near(&steady["out_of_range"][0]["value"], thin(273.15 + 149.5), 1e-9);
    let sized = folder.run(&["size", "hot.toml", "--format", "json"]).exits(0).json();
    near(&sized["out_of_range"][0]["value"], thin(273.15 + 149.5), 1e-9);
    folder.run(&["size", "hot.toml"]).exits(0).prints("nu of `front` is 1.41");
}
