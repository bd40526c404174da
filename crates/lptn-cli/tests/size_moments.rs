//! `lptn size` over a run and over a settled cycle.

use crate::common;

use common::Folder;

/// Gears and housing with radiation and natural convection on a cycle of four minutes.
const GEARS: &str = "format = 1
[param]
omega_top = \"7000 rpm\"
h_forced = \"10 W/(m^2 K)\"
[signal]
cycle = { t=[0, 60, 120, 200, 240], v=[0, 1, 0.6, 1, 0], t_unit=\"s\", v_unit=\"1\", after_end=\"repeat\" }
[default]
T0 = \"35 degC\"
[node]
gears = { material = \"steel_8620\", mass = \"2.6 kg\" }
housing = { material = \"aluminium_6061\", mass = \"1.6 kg\" }
[boundary]
air = { T = \"35 degC\" }
[resistor]
fit = { from=\"gears\", to=\"housing\", R=\"20 mK/W\" }
[convection]
nat = { from=\"housing\", to=\"air\", h=\"1.6 [W/(m^2 K)]*(abs(dT)/1 [K])^0.25 + h_forced\", area=\"0.1 m^2\" }
[radiation]
glow = { from=\"housing\", to=\"air\", emissivity=0.85, area=\"0.1 m^2\" }
[source]
loss = { into = { gears=0.8, housing=0.2 }, P=\"87 [uW/rpm^(5/3)]*(omega_top*cycle)^(5/3)\" }
[run]
stop = \"10 min\"
[size.fan]
minimise = \"h_forced\"
vary = { h_forced = { from=\"0 W/(m^2 K)\", to=\"100 W/(m^2 K)\" } }
require = [\"gears.T <= 90 [degC]\"]
";

fn over(word: &str) -> String {
    format!("{GEARS}over = \"{word}\"\n")
}

/// It took the load at the start of the cycle, 0 W, and found that no fan is needed. The value is
/// that of a fourth-order Runge-Kutta method with steps of 0.25 s, on its way from 12.77196484 with
/// 0.5 s and 12.77196380 with 1 s.
#[test]
fn the_settled_cycle_is_sized() {
    let folder = Folder::with("a.toml", &over("periodic"));
    let json = folder.run(&["size", "a.toml", "--format", "json"]).exits(0).json();
    let found = json["values"]["h_forced"]["value"].as_f64().unwrap_or(0.0);
    assert!((found / 12.771_965_4 - 1.0).abs() < 1e-7, "{found}");
    assert_eq!(json["over"], "periodic");
    let at = json["requirements"][0]["worst_at"]["value"].as_f64().unwrap_or(0.0);
    assert!((200.0..240.0).contains(&at), "{at}");
    let error = json["error"]["value"].as_f64().unwrap_or(1.0);
    assert!(error > 0.0 && error < 1e-7, "{error}");
    folder
        .run(&["size", "a.toml"])
        .exits(0)
        .prints("at every moment of the periodic steady state of 4 min")
        .prints("h_forced = 12.772 W/(m^2 K) keeps every requirement");
}

/// In ten minutes from cold nothing has to be done.
#[test]
fn a_short_run_needs_no_fan_and_can_be_written() {
    let folder = Folder::with("a.toml", &over("run"));
    folder
        .run(&["size", "a.toml"])
        .exits(0)
        .prints("at every moment of the run of 10 min")
        .prints("h_forced = 0 W/(m^2 K), the least of the range, keeps every requirement");
    let hotter = over("run").replace("<= 90", "<= 60");
    folder.write("b.toml", &hotter);
    folder.run(&["size", "b.toml", "--write"]).exits(0);
    let text = folder.read("b.toml");
    assert!(!text.contains("h_forced = \"10 W"), "{text}");
    // what was written keeps the limit in a run of its own
    let limited = text + "[limit]\nhot = { of = \"gears.T\", below = \"60 degC\" }\n";
    folder.write("c.toml", &limited);
    folder.run(&["run", "c.toml", "--no-files"]).exits(0);
}

#[test]
fn a_cycle_without_a_period_is_refused_before_anything_is_computed() {
    let held = over("periodic").replace("after_end=\"repeat\"", "after_end=\"hold\"");
    let folder = Folder::with("a.toml", &held);
    folder.run(&["size", "a.toml"]).exits(2).says("periodic::no_period").says("`period = ");
    folder.write("b.toml", &(held + "period = \"4 min\"\n"));
    folder.run(&["size", "b.toml"]).exits(2).says("periodic::not_periodic").says("h_forced = 0");
    let constant = over("periodic").replace("omega_top*cycle", "omega_top");
    folder.write("c.toml", &constant);
    folder.run(&["size", "c.toml"]).exits(2).says("nothing changes with time");
}

#[test]
fn what_cannot_be_run_says_with_which_value() {
    let text = over("run").replace("stop = \"10 min\"", "stop = \"h_forced * 1 [m^2 K s/W]\"");
    let folder = Folder::with("a.toml", &text);
    folder.run(&["size", "a.toml"]).exits(2).says("size::run").says("with h_forced = 0 W/(m^2 K)");
}
