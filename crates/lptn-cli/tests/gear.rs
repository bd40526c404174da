//! Command line: `lptn gear`. Numbers are those of printed formulas: 7.69e-6 d^2 n W of a shaft seal
//! (ISO/TR 14179-2), and ratios of teeth.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common;

use common::Folder;
use serde_json::Value;

const TRAIN: &str = r#"
format = 1
[node]
box = { C = "1 kJ/K", T0 = "20 degC" }
[boundary]
air = { T = "20 degC" }
[resistor]
skin = { from = "box", to = "air", R = "0.1 K/W" }
[gearbox.first]
teeth = { sun = 18, planet = 42, ring = 102 }
planets = 3
speed = "3000 rpm"
into = "box"
seal = { lip = { on = "sun", model = "shaft", d = "50 mm" } }
[gearbox.second]
teeth = { pinion = 20, wheel = 60 }
driven_by = "first"
into = "box"
seal = { lip = { on = "wheel", model = "shaft", d = "50 mm" } }
"#;

/// W for each rpm.
const SEAL: f64 = 7.69e-6 * 2500.0;

#[track_caller]
fn near(found: &Value, expected: f64) {
    let number = found.as_f64().or_else(|| found["value"].as_f64()).unwrap();
    assert!((number - expected).abs() <= 1e-9 * expected.abs(), "{number} is not {expected}");
}

#[test]
fn a_train_is_told_to_programs() {
    let folder = Folder::with("train.toml", TRAIN);
    let json = folder.run(&["gear", "train.toml", "--speed", "1000rpm", "--format", "json"]);
    let json = json.exits(0).json();
    near(&json["ratio"], -20.0);
    let point = &json["points"][0];
    near(&point["losses"][0]["heat"], SEAL * 1000.0);
    near(&point["losses"][1]["heat"], SEAL * 1000.0 / 20.0);
    near(&point["loss"], SEAL * 1050.0);
    near(&point["drag"], SEAL * 1050.0 / (1000.0 * std::f64::consts::PI / 30.0));
    near(&point["temperatures"]["box"], 20.0 + 0.1 * SEAL * 1050.0);
    assert!((point["exponent"].as_f64().unwrap() - 1.0).abs() < 1e-6);
    assert!((point["exponent_settled"].as_f64().unwrap() - 1.0).abs() < 1e-6);
    assert_eq!(point["efficiency"], Value::Null);
}

#[test]
fn a_spreadsheet_has_a_row_for_each_speed_and_temperature() {
    let folder = Folder::with("train.toml", TRAIN);
    let arguments = ["gear", "train.toml", "--temperature", "20degC,80degC", "--format", "csv"];
    let ran = folder.run(&arguments).exits(0);
    let lines: Vec<&str> = ran.out.lines().collect();
    assert_eq!(lines.len(), 11, "{}", ran.out);
    let columns: Vec<&str> = lines[0].split(',').collect();
    let at = |name: &str| columns.iter().position(|column| *column == name).unwrap();
    let last: Vec<&str> = lines[10].split(',').collect();
    assert_eq!(last[at("warmest node [degC]")], "80");
    let loss: f64 = last[at("loss [W]")].parse().unwrap();
    near(&loss.into(), SEAL * 3150.0);
    assert_eq!(last[at("exponent settled [-]")], "");
}

#[test]
fn the_stage_that_is_driven_can_be_looked_at_by_itself() {
    let folder = Folder::with("train.toml", TRAIN);
    folder.run(&["gear", "train.toml", "second"]).exits(0).prints("ratio -3").prints("450 rpm");
}

#[test]
fn what_cannot_be_told_is_told_why() {
    let folder = Folder::with("train.toml", TRAIN);
    folder.write("none.toml", &TRAIN[..TRAIN.find("[gearbox").unwrap()]);
    folder.write("still.toml", &TRAIN.replace("3000 rpm", "0 rpm"));
    folder.write("two.toml", &TRAIN.replace("driven_by = \"first\"", "speed = \"100 rpm\""));
    for (words, code) in [
        (vec!["none.toml"], "gear::no_gearbox"),
        (vec!["train.toml", "secnd"], "did you mean `second`?"),
        (vec!["still.toml"], "gear::at_rest"),
        (vec!["two.toml"], "gear::which_gearbox"),
        (vec!["train.toml", "--torque", "3 N m"], "gear::no_torque"),
        (vec!["train.toml", "--speed", "3Hz"], "--speed"),
        (vec!["train.toml", "--temperature", "40K,-300degC"], "-300degC"),
    ] {
        folder.run(&[&["gear"][..], &words].concat()).exits(2).says(code);
    }
}

/// Regression: a value that follows from the teeth was taken, and the stage came apart.
#[test]
fn what_follows_from_the_teeth_cannot_be_set() {
    let folder = Folder::with("train.toml", TRAIN);
    for name in ["first.carrier.speed", "first.ring.speed", "second.pinion.speed"] {
        let set = format!("{name}=100rpm");
        folder.run(&["gear", "train.toml", "--set", &set]).exits(2).says("netlist::gear_follows");
    }
    let set = ["gear", "train.toml", "--set", "first.sun.speed=100rpm"];
    folder.run(&set).exits(0).prints("100 rpm");
}

/// Regression: a torque that follows from the speed was held where the speed was changed.
#[test]
fn a_torque_that_follows_from_the_speed_follows_it() {
    let sizes = "torque = \"300 [N m] * 3000 [rpm] / first.sun.speed\"\nmodule = \"3 mm\"\nwidth = \
        \"12 mm\"\nRa = \"0.5 um\"\nlubricant = \"iso_vg_220\"\n";
    let text = TRAIN.replacen("planets = 3\n", &format!("planets = 3\n{sizes}"), 1);
    let first = &text[..text.find("[gearbox.second]").unwrap()];
    let folder = Folder::with("power.toml", first);
    let json = folder.run(&["gear", "power.toml", "--speed", "1000rpm", "--format", "json"]);
    near(&json.exits(0).json()["points"][0]["torque"], 900.0);
}

#[test]
fn a_picture_and_a_report_show_every_part() {
    let folder = Folder::with("train.toml", TRAIN);
    let words = ["gear", "train.toml", "--plot", "x.svg", "--report=x.html"];
    folder.run(&words).exits(0);
    for file in ["x.svg", "x.html"] {
        let text = folder.read(file);
        assert!(text.contains("first.lip") && text.contains("second.lip"), "{file}");
    }
}

/// A mesh that may scuff, with a torque over time.
fn flanks(torque: &str) -> Folder {
    let text = format!(
        "format = 1\n[node]\ngears = {{ C = \"1 kJ/K\", T0 = \"60 degC\" }}\n[boundary]\n\
         air = {{ T = \"20 degC\" }}\n[resistor]\nskin = {{ from = \"gears\", to = \"air\", G = \"20 W/K\" }}\n\
         [signal]\nload = {{ t = [\"0 s\", \"60 s\"], v = {torque}, after_end = \"hold\" }}\n[mesh.pair]\n\
         into = \"gears\"\nmodel = \"external\"\nspeed = \"1500 rpm\"\ntorque = \"load\"\nz1 = 20\nz2 = 60\n\
         module = \"3 mm\"\nwidth = \"30 mm\"\nRa = \"0.5 um\"\nnu = \"60 mm^2/s\"\ndensity = \"860 kg/m^3\"\n\
         scuffing = \"200 degC\"\n[limit]\nflanks = {{ of = \"pair.margin\", above = \"20 K\" }}\n[run]\n\
         stop = \"60 s\"\n"
    );
    Folder::with("flanks.toml", &text)
}

/// Without load nothing scuffs, however hot it is: that is not a limit that is kept.
#[test]
fn a_limit_of_flanks_without_load_is_not_judged() {
    let idle = flanks("[\"0 N m\", \"0 N m\"]");
    for words in [["run", "--no-files"], ["steady", "--quiet"]] {
        let ran = idle.run(&[words[0], "flanks.toml", words[1]]).exits(0);
        let ran = ran.prints("not judged");
        assert!(!ran.out.contains("kept"), "{}", ran.out);
    }
    let json = idle.run(&["run", "flanks.toml", "--no-files", "--format", "json"]).exits(0).json();
    assert!(json["limits"][0]["margin"].is_null(), "{}", json["limits"]);
    idle.run(&["compare", "flanks.toml"]).exits(0).prints("not judged");
    let loaded = flanks("[\"0 N m\", \"50 N m\"]");
    loaded.run(&["run", "flanks.toml", "--no-files"]).exits(0).prints("kept");
}

/// Addenda that contain a shift are warned of, unless the shift is given. Twelve percent of the torque
/// of these gears would be lost at the wrong centre distance.
#[test]
fn shifted_profiles_are_warned_of() {
    let pair = |addenda: [f64; 2], more: &str| {
        let text = format!(
            "format = 1\n[node]\ngears = {{ massless = true }}\n[boundary]\noil = {{ T = \"60 degC\" }}\n\
             [resistor]\nspray = {{ from = \"gears\", to = \"oil\", G = \"1000 W/K\" }}\n[mesh.pair]\n\
             into = \"gears\"\nmodel = {more}\nspeed = \"1500 rpm\"\ntorque = \"200 N m\"\nz1 = 20\nz2 = 60\n\
             module = \"4.5 mm\"\nwidth = \"14 mm\"\naddendum_1 = {}\naddendum_2 = {}\nRa = \"0.355 um\"\n\
             nu = \"15.12 mm^2/s\"\ndensity = \"878 kg/m^3\"\n",
            addenda[0], addenda[1]
        );
        Folder::with("pair.toml", &text).run(&["steady", "pair.toml"]).exits(0).err
    };
    let warns = |addenda, model| pair(addenda, model).contains("netlist::profile_shift");
    let [external, internal] = ["\"external\"", "\"internal\""];
    assert!(warns([1.1817, 1.1715], external) && warns([0.9, 0.95], external));
    assert!(!warns([1.3, 0.7], external) && !warns([1.0, 1.0], external));
    assert!(!warns([1.1817, 1.1715], "\"external\"\nx_1 = 0.1817\nx_2 = 0.1715"));
    // shorter teeth of a ring are common, and no shift
    assert!(warns([1.2, 0.9], internal) && !warns([1.0, 0.7], internal));
}

/// A sweep over torques begins at 0, where flanks are not judged.
#[test]
fn a_stage_that_may_scuff_runs_without_load() {
    let text = TRAIN.replace(
        "[gearbox.second]",
        "[limit]\ncold = { of = \"first.sun_planet[1].margin\", above \
        = \"20 K\" }\n[gearbox.second]",
    );
    let text = text.replacen(
        "planets = 3\n",
        "planets = 3\ntorque = \"0 N m\"\nmodule = \"3 mm\"\nwidth = \"12 mm\"\nRa = \"0.5 um\"\nlubricant = \
         \"iso_vg_220\"\nscuffing = \"mineral\"\n",
        1,
    );
    let text = &text[..text.find("[gearbox.second]").unwrap()];
    let folder = Folder::with("idle.toml", text);
    folder
        .run(&["steady", "idle.toml"])
        .exits(0)
        .prints("not judged")
        .says("netlist::scuffing_idle");
    folder.run(&["gear", "idle.toml", "--torque", "0 N m,5 N m"]).exits(0);
}

/// Gears H501 of GEARpie's report, with its shorter tips, k = x1 + x2 - (a - a0)/m: a 91.5 mm, eps_alpha 1.46, eps_beta 0.54, H_V 0.1639. The working
/// pressure angle follows from the printed T1T2 = a sin(alpha_w) = 34.45 mm.
const H501: &str = r#"
format = 1
[node]
box = { C = "1 kJ/K", T0 = "20 degC" }
[boundary]
air = { T = "20 degC" }
[resistor]
skin = { from = "box", to = "air", R = "0.01 K/W" }
[gearbox.pair]
teeth = { pinion = 20, wheel = 30 }
speed = "1500 rpm"
torque = "100 N m"
module = "3.5 mm"
width = "23 mm"
helix_angle = "15 deg"
shift = { pinion = 0.1809, wheel = 0.0891 }
tip_shortening = 0.0091
Ra = "0.4 um"
lubricant = "pao_vg_220"
into = "box"
"#;

#[test]
fn the_teeth_of_a_mesh_are_as_printed() {
    let folder = Folder::with("h501.toml", H501);
    let json = folder.json("gear h501.toml --speed 1500rpm").exits(0).json();
    let mesh = &json["meshes"][0];
    let is = |found: &Value, printed: f64, last: f64| {
        let found = found.as_f64().or_else(|| found["value"].as_f64()).unwrap();
        assert!((found - printed).abs() <= last, "{found}, printed {printed}");
    };
    is(&mesh["centre_distance"], 0.0915, 1e-6);
    is(&mesh["pressure_angle"], (34.45_f64 / 91.5).asin(), 2e-4);
    is(&mesh["transverse_contact_ratio"], 1.46, 0.01);
    is(&mesh["overlap_ratio"], 0.54, 0.01);
    is(&mesh["loss_factor"], 0.1639, 1e-3);
    folder.run(&["gear", "h501.toml"]).exits(0).prints("alpha_w [deg]").prints("H_V");
}

#[test]
fn efficiency_is_a_map_over_speed_and_torque() {
    let folder = Folder::with("h501.toml", H501);
    let ask = [
        "gear",
        "h501.toml",
        "--speed=100rpm,500rpm,1500rpm,3000rpm",
        "--torque=10 N \
        m,50 N m,200 N m",
        "--temperature=60degC",
        "--plot=map.svg",
    ];
    folder.run(&ask).exits(0);
    let map = folder.files().into_iter().find(|file| file.contains("svg")).unwrap();
    let drawn: String =
        folder.files().iter().filter(|f| f.ends_with(".svg")).map(|f| folder.read(f)).collect();
    assert!(drawn.contains("torque") && drawn.contains("99 %"), "{map}");
}
