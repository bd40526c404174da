//! Signals and tables are shown in the units that people give them in.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common;

use common::{Folder, csv};

const MAP: &str =
    "speed [rpm],torque [N m],loss [W]\n1000,10,10\n1000,20,30\n2000,10,25\n2000,20,75\n";

fn motor(last: &str) -> Folder {
    let text = format!(
        "format = 1\n[table]\nmap = {{ csv = \"map.csv\", x = \"speed\", y = \"torque\", value \
         = \"loss\" }}\n[signal]\n\
         n = {{ t = [\"0 s\", \"2 min\"], v = [\"1000 rpm\", \"{last}\"] }}\n\
         torque = {{ t = [0, 2], v = [10, 20], t_unit = \"min\", v_unit = \"N m\" }}\n\
         duty = {{ t = [0, 2], v = [0.5, 1], t_unit = \"min\" }}\nday = {{ t = [0, 2], v = [20, \
         30], t_unit = \"min\", v_unit = \"degC\" }}\n\
         twice = \"2 * n\"\n[boundary]\nair = {{ T = \"day\" }}\n\
         [node]\ncore = {{ C = \"640 J/K\", T0 = \"60 degC\" }}\n\
         [resistor]\nskin = {{ from = \"core\", to = \"air\", R = \"1 K/W\" }}\n\
         [source]\nq = {{ into = \"core\", P = \"duty * map(n, torque)\" }}\n\
         [run]\nstop = \"2 min\"\noutput = {{ every = \"1 min\" }}\nwindow = {{ end = {{ from \
         = \"1 min\", to = \"2 min\" }} }}\n"
    );
    let folder = Folder::with("motor.toml", &text);
    folder.write("map.csv", MAP);
    folder
}

/// A torque was a column in J, a speed one in rad/s.
#[test]
fn regression_columns_of_signals_have_their_own_units() {
    let folder = motor("2000 rpm");
    let ran = folder.run(&["run", "motor.toml", "--format", "csv", "--no-files"]).exits(0);
    let (headers, rows) = csv(&ran.out);
    let middle = |header: &str| {
        let column = headers.iter().position(|name| name == header);
        rows[1][column.unwrap_or_else(|| panic!("no {header} in {headers:?}"))]
    };
    let near =
        |found: f64, expected: f64| assert!((found - expected).abs() < 1e-9, "{found} {expected}");
    near(middle("n [rpm]"), 1500.0);
    near(middle("torque [N m]"), 15.0);
    near(middle("duty [-]"), 0.75);
    near(middle("day [degC]"), 25.0);
    // an expression has the unit of its type: 3000 rpm are 50 turns of 2 pi in a second
    near(middle("twice [rad/s]"), 100.0 * std::f64::consts::PI);
    let kelvin = ["run", "motor.toml", "--format", "csv", "--no-files", "--temperature-unit", "K"];
    assert!(folder.run(&kelvin).exits(0).out.lines().next().unwrap().contains("day [K]"));
}

/// A map from 1000 to 2000 rpm was left "at 209.43951451277678".
#[test]
fn regression_a_table_is_left_in_its_own_unit() {
    let ran = motor("2100 rpm").run(&["run", "motor.toml", "--no-files"]).exits(3);
    ran.says("reaches from 1000 rpm to 2000 rpm in its first argument, got 2000.00").says(" rpm");
    let folder = motor("2000 rpm");
    let text = folder.read("motor.toml").replace("v = [10, 20]", "v = [10, 25]");
    folder.write("motor.toml", &text);
    folder
        .run(&["run", "motor.toml", "--no-files"])
        .exits(3)
        .says("from 10 N m to 20 N m in its second argument");
}

#[test]
fn the_expansion_keeps_the_units_of_points() {
    let folder = motor("2000 rpm");
    let flat = folder.run(&["check", "motor.toml", "--expand"]).exits(0);
    let flat = flat
        .prints("v = [1000, 2000], v_unit = \"rpm\"")
        .prints("v = [10, 20], v_unit = \"N m\"")
        .out;
    folder.write("flat.toml", &flat);
    let results =
        |file: &str| folder.run(&["run", file, "--format", "csv", "--no-files"]).exits(0).out;
    assert_eq!(results("flat.toml"), results("motor.toml"));
    let one = folder.run(&["reduce", "motor.toml", "--port", "core", "--format", "toml"]).exits(0);
    one.prints("v = [1000, 2000], v_unit = \"rpm\"");
}
