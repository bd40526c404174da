//! `lptn reduce --keep`: what stands between several nodes.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common;

use common::Folder;
use serde_json::Value;

const FRAME: &str = r#"format = 1
[param]
load = "40 W"
[node]
winding = { C = "50 J/K", T0 = "20 degC" }
core = { C = "700 J/K", T0 = "20 degC" }
fin = { C = "30 J/K", T0 = "20 degC" }
joint = { massless = true }
housing = { C = "900 J/K", T0 = "20 degC" }
[boundary]
air = { T = "absolute(293.15 [K] + 0.001 [K/s] * t)" }
base = { T = "30 degC" }
[resistor]
a = { from = "winding", to = "core", R = "0.4 K/W" }
b = { from = "core", to = "joint", R = "0.3 K/W" }
c = { from = "joint", to = "housing", R = "0.2 K/W" }
d = { from = "housing", to = "fin", R = "0.01 K/W" }
e = { from = "fin", to = "air", R = "1.2 K/W" }
f = { from = "joint", to = "base", R = "3 K/W" }
[source]
copper = { into = "winding", P = "load * (1 + t / 1 [h])" }
iron = { into = { core = 0.8, joint = 0.2 }, P = "6 W" }
[run]
stop = "1 h"
"#;

fn number(value: &Value) -> f64 {
    value["value"].as_f64().unwrap_or_else(|| panic!("no number in {value:#}"))
}

#[test]
fn kept_nodes_are_a_network_that_runs() {
    let folder = Folder::with("frame.toml", FRAME);
    let reduce = |more: &[&str]| {
        folder.run(&[&["reduce", "frame.toml", "--keep", "winding,housing"], more].concat())
    };
    let files = ["--write", "kept.toml", "--recover", "all.csv", "--format", "json"];
    let json = reduce(&files).exits(0).says("wrote  all.csv").json();
    assert_eq!(json["keep"], serde_json::json!(["winding", "housing"]));
    assert_eq!(json["verdict"]["holds"], true);
    let nodes = json["nodes"].as_array().unwrap();
    assert!(nodes.len() < 5 && nodes[0]["name"] == "winding" && nodes[1]["asked"] == true);
    assert!(nodes.iter().all(|node| number(&node["C"]) > 0.0));
    let links = json["conductances"].as_array().unwrap();
    assert!(links.iter().all(|link| number(&link["G"]) > 0.0));
    // at rest the modes give the kept nodes their resistance, by hand: 0.7 K/W
    // to the joint, and from there 3 K/W beside 0.2 + 0.01 + 1.2 K/W
    let modes = json["projected"]["modes"].as_array().unwrap();
    let square = |mode: &Value| mode["shape"]["winding"].as_f64().unwrap().powi(2);
    let resistance: f64 = modes.iter().map(square).sum();
    let expected = 0.7 + 1.0 / (1.0 / 3.0 + 1.0 / 1.41);
    assert!((resistance / expected - 1.0).abs() < 1e-9, "{resistance} is not {expected}");
    assert_eq!(modes.len(), nodes.len());
    // the run of the written network misses that of the whole one by what was said
    folder.run(&["check", "kept.toml"]).exits(0);
    let last = |file: &str, name: &str| {
        let json = folder.run(&["run", file, "--no-files", "--format", "json"]).exits(0).json();
        let columns = json["columns"].as_array().unwrap();
        let place = columns.iter().position(|column| column["name"] == name).unwrap();
        let rows = json["rows"].as_array().unwrap();
        rows.iter().map(|row| row[place].as_f64().unwrap()).collect::<Vec<f64>>()
    };
    for (k, name) in ["winding.T", "housing.T"].into_iter().enumerate() {
        let (whole, few) = (last("frame.toml", name), last("kept.toml", name));
        let apart = whole.iter().zip(&few).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        let said = number(&nodes[k]["run"]["max"]);
        assert!(apart <= said + 1e-3 && apart > 0.5 * said, "{name} {apart} {said}");
    }
    let text = folder.read("kept.toml");
    assert!(
        text.contains("copper = { into = \"winding\", P = \"load * (1 + t / 1 [h])\" }"),
        "{text}"
    );
    // every node has a row, a kept one itself alone; shares of temperatures sum to 1
    let recovered = folder.read("all.csv");
    let mut rows = recovered.lines();
    let head: Vec<&str> = rows.next().unwrap().split(',').collect();
    let shares = head.iter().filter(|name| name.ends_with("[-]")).count();
    let mut seen = 0;
    for row in rows {
        let cells: Vec<&str> = row.split(',').collect();
        let values: Vec<f64> = cells[1..].iter().map(|cell| cell.parse().unwrap()).collect();
        assert!((values[..shares].iter().sum::<f64>() - 1.0).abs() < 1e-9, "{row}");
        seen += usize::from(cells[0] == "joint" || cells[0] == "fin");
    }
    assert_eq!((recovered.lines().count(), seen), (6, 2));
    let ran = reduce(&[]).exits(0);
    assert!(ran.out.lines().all(|line| line.chars().count() <= 80), "{}", ran.out);
    let csv = reduce(&["--format", "csv"]).exits(0).out;
    assert!(csv.starts_with("node,asked,C [J/K],run.max [K],"), "{csv}");
    reduce(&["--recover", "all.csv"]).exits(2).says("reduce::exists");
}

#[test]
fn as_many_nodes_are_chosen_as_are_asked_for() {
    let folder = Folder::with("frame.toml", FRAME);
    let reduce = |keep: &str, more: &[&str]| {
        folder.run(&[&["reduce", "frame.toml", "--keep", keep], more].concat())
    };
    let two = reduce("winding,housing", &["--nodes", "2", "--max-error", "0.1%"]).exits(1);
    assert!(two.out.starts_with("2 nodes do not keep `winding` and `housing`: "), "{}", two.out);
    // all that there is: the joint is no capacity and is not chosen
    let all = reduce("winding,housing", &["--nodes", "9"]).exits(0);
    let all = all.prints("4 nodes keep `winding` and `housing` exactly");
    all.prints("there are no more");
    let every = reduce("winding,housing", &["--error", "1%", "--power", "50 W"]).exits(0);
    every.prints("over every load up to 50 W");
    // a massless node can be kept, and one node alone
    reduce("joint, winding, winding", &["--max-error", "90%"])
        .exits(0)
        .prints("`joint` and `winding`");
    reduce("winding", &["--nodes", "1", "--max-error", "90%"]).exits(0).prints("1 node keep");
}

#[test]
fn what_cannot_be_kept_is_told() {
    let folder = Folder::with("frame.toml", FRAME);
    let reduce = |keep: &str, more: &[&str]| {
        folder.run(&[&["reduce", "frame.toml", "--keep", keep], more].concat()).exits(2)
    };
    reduce("winding,hausing", &[]).says("reduce::unknown_port").says("did you mean `housing`?");
    reduce("winding,base", &[]).says("reduce::boundary_port").says("base = { T");
    reduce(",", &[]).says("reduce::nodes");
    reduce("winding,housing", &["--nodes", "1"]).says("reduce::nodes").says("--nodes 1 is less");
    reduce("winding", &["--port", "core"]).says("--port");
    reduce("winding", &["--power", "0 W"]).says("reduce::power");
    folder
        .run(&["reduce", "frame.toml", "--port", "core", "--recover", "x.csv"])
        .exits(2)
        .says("reduce::nodes");
    let island =
        FRAME.replace("[boundary]", "stone = { C = \"5 J/K\", T0 = \"20 degC\" }\n[boundary]");
    folder.write("island.toml", &island);
    let ran = folder.run(&["reduce", "island.toml", "--keep", "winding,stone"]).exits(2);
    ran.says("reduce::no_ground").says("`stone`");
    let streams = FRAME.replace(
        "[source]",
        "[advection]\nin = { from = \"base\", to = \"core\", mcp = \"3 W/K\" }\n\
         on = { from = \"core\", to = \"housing\", mcp = \"3 W/K\" }\n\
         out = { from = \"housing\", to = \"base\", mcp = \"3 W/K\" }\n[source]",
    );
    folder.write("streams.toml", &streams);
    for more in [["--keep", "core,housing"], ["--port", "core"]] {
        let line = [&["reduce", "streams.toml"], &more[..], &["--nodes", "3"]].concat();
        folder.run(&line).exits(2).says("reduce::one_way");
    }
}
