//! Biot numbers and diffusion times in `check` and after a run.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common;

use common::{Folder, GEARBOX};

/// A block of which 30 mm are too much for its skin, a bead that is a lump, and nodes that cannot
/// be checked.
const BLOCK: &str = r#"
format = 1

[material.alloy]
density = "8500 kg/m^3"
cp = "400 J/(kg K)"
k = "20 W/(m K)"
source = "round numbers"

[default]
T0 = "25 degC"

[node]
block = { material = "alloy", volume = "1 L", L_char = "30 mm" }
bead = { material = "alloy", volume = "0.2 mm^3", L_char = "0.12 mm" }
oil = { C = "500 J/K", L_char = "1 cm" }
lid = { material = "alloy", mass = "1 kg", L_char = "2 mm" }
rest = { C = "100 J/K" }

[boundary]
air = { T = "25 degC" }

[convection]
skin = { from = "block", to = "air", h = "100 W/(m^2 K)", area = "0.03 m^2" }
film = { from = "bead", to = "air", h = "400 W/(m^2 K)", area = "1.5 mm^2" }
cover = { from = "lid", to = "air", R = "2 K/W" }

[resistor]
bolt = { from = "block", to = "oil", R = "0.5 K/W" }
seal = { from = "oil", to = "rest", R = "0.5 K/W" }

[source]
loss = { into = "block", P = "if(t < 300 [s], 40 [W], 80 [W])" }

[run]
stop = "1 h"
"#;

#[test]
fn check_says_which_nodes_are_no_lumps() {
    let folder = Folder::with("block.toml", BLOCK);
    let ran = folder.run(&["check", "block.toml"]).exits(0);
    let ran = ran.prints(
        "warning[lumping::biot]: node `block` is not a lump: its Biot number is 0.15, above 0.1",
    );
    // 0.03^2 * 8500 * 400 / 20 = 153 s against the 300 s before the step
    let ran = ran.prints(
        "warning[lumping::diffusion_time]: inside node `block` heat takes 2.55 min to spread",
    );
    let ran = ran.prints("L_char = \"30 mm\"").prints("h = 100 W/(m^2 K) at 0 s, k = 20 W/(m K)");
    let ran = ran.prints("\nlumping:   Bi up to 0.15 (block), L^2/alpha up to 2.5 min (block),");
    let ran = ran
        .prints("1 node (no L_char), 1 node (no material),")
        .prints("1 node (surface without area)");
    assert!(!ran.out.contains("`bead`"), "{}", ran.out);
    let verbose = folder.run(&["check", "block.toml", "-v"]).exits(0).prints("no L_char: rest\n");
    let table: Vec<&str> =
        verbose.out.lines().skip_while(|line| !line.starts_with("lump ")).take(5).collect();
    assert!(table[2].starts_with("bead ") && table[2].contains(" 0.0024 "), "{table:?}");
    assert!(table[1].starts_with("block ") && table[1].contains(" 0.15 "), "{table:?}");
    let verbose = verbose.prints("no material: oil\n").prints("surface without area: lid\n");
    let long = |line: &str| {
        !line.contains(" = ") && !line.starts_with("warning") && line.chars().count() > 80
    };
    assert!(!verbose.out.lines().any(long), "{}", verbose.out);
}

#[test]
fn json_holds_every_node_with_a_length() {
    let folder = Folder::with("block.toml", BLOCK);
    for arguments in [
        &["check", "block.toml", "--format", "json"][..],
        &["run", "block.toml", "--format", "json"],
    ] {
        let json = folder.run(arguments).exits(0).json();
        let lumping = &json["lumping"];
        let block = &lumping["nodes"]["block"];
        assert!((block["biot"]["value"].as_f64().unwrap() - 0.15).abs() < 1e-12);
        assert!((block["diffusion_time"]["value"].as_f64().unwrap() - 153.0).abs() < 1e-9);
        assert_eq!(block["h"], serde_json::json!({ "value": 100.0, "unit": "W/(m^2 K)" }));
        assert_eq!(lumping["nodes"]["oil"]["not_checked"]["biot"], "no_material");
        assert_eq!(
            lumping["nodes"]["lid"]["not_checked"],
            serde_json::json!({ "biot": "no_area" })
        );
        assert_eq!(lumping["without_length"], 1);
        assert_eq!(lumping["shortest_stretch"]["to"]["value"], 300.0);
        let codes: Vec<&str> = json["warnings"]
            .as_array()
            .unwrap()
            .iter()
            .map(|w| w["code"].as_str().unwrap())
            .collect();
        assert!(
            codes.contains(&"lumping::biot") && codes.contains(&"lumping::diffusion_time"),
            "{codes:?}"
        );
    }
}

#[test]
fn a_run_says_it_below_its_heat() {
    let folder = Folder::with("block.toml", BLOCK);
    let ran = folder.run(&["run", "block.toml", "--no-files"]).exits(0).says("lumping::biot");
    let ran = ran.prints("\nlumping:           Bi up to 0.15 (block)");
    assert!(ran.out.lines().all(|line| line.chars().count() <= 80), "{}", ran.out);
    let gearbox = Folder::with_gearbox().run(&["run", "gearbox.toml", "--no-files", "-v"]);
    let gearbox = gearbox.exits(0);
    gearbox.prints("\nlumping:           not checked: 2 nodes (no L_char)\n");
}

#[test]
fn a_thousand_nodes_take_a_line() {
    let nodes: String =
        (0..1000).map(|i| format!("n{i} = {{ C = \"1 J/K\", T0 = \"25 degC\" }}\n")).collect();
    let paths: String = (0..1000)
        .map(|i| format!("p{i} = {{ from = \"n{i}\", to = \"steel\", R = \"1 K/W\" }}\n"))
        .collect();
    let text = GEARBOX.replace("[node]\n", &format!("[node]\n{nodes}"));
    let folder =
        Folder::with("many.toml", &text.replace("[resistor]\n", &format!("[resistor]\n{paths}")));
    let ran = folder.run(&["check", "many.toml", "-v"]).exits(0);
    let ran = ran.prints("\nlumping:   not checked: 1002 nodes (no L_char)\n");
    let ran = ran.prints("no L_char: n0 n1 n2 n3 n4 and 997 more\n");
    assert!(ran.out.lines().count() < 10, "{}", ran.out);
    // what says nothing is left out of scripts and logs
    let ran = folder.run(&["check", "many.toml"]).exits(0);
    assert_eq!(ran.out.lines().count(), 1, "{}", ran.out);
    // all of them no lumps: five are named, the others counted
    let thick = BLOCK.replace("[node]\n", "[node]\nCOPIES");
    let copies: String = (0..100)
        .map(|i| {
            format!("b{i} = {{ material = \"alloy\", volume = \"1 L\", L_char = \"40 mm\" }}\n")
        })
        .collect();
    let skins: String = (0..100)
        .map(|i| {
            let film = "h = \"100 W/(m^2 K)\", area = \"0.03 m^2\"";
            format!("s{i} = {{ from = \"b{i}\", to = \"air\", {film} }}\n")
        })
        .collect();
    let text = thick
        .replace("COPIES", &copies)
        .replace("[convection]\n", &format!("[convection]\n{skins}"));
    folder.write("thick.toml", &text);
    let ran = folder
        .run(&["check", "thick.toml"])
        .exits(0)
        .prints("96 nodes more with Biot numbers above 0.1");
    assert_eq!(ran.out.matches("lumping::biot").count(), 6);
}
