//! Command line: networks from CSV files.

use crate::common;

use common::{Folder, csv};

const NETLIST: &str = "format = 1\n[import]\nnodes = \"n.csv\"\nconductors = \"c.csv\"\nsources \
    = \"s.csv\"\n\
                       [node]\nhousing = { C = \"1 kJ/K\", T0 = \"20 degC\" }\n[boundary]\nair = { \
                       T = \"20 degC\" }\n\
                       [resistor]\nskin = { from = \"housing\", to = \"air\", R = \"0.5 K/W\" }\n\
                       [run]\nstop = \"1 h\"\n";

/// A chain of 40 nodes whose first is heated with 10 W and whose last leads to the housing; 1 W/K
/// each.
fn chain() -> Folder {
    let folder = Folder::with("net.toml", NETLIST);
    let nodes: String = (1..=40).map(|i| format!("n{i},5,20\n")).collect();
    let paths: String = (1..40).map(|i| format!("n{i},n{},1\n", i + 1)).collect();
    folder.write("n.csv", &format!("name,C [J/K],T0 [degC]\n{nodes}"));
    folder.write("c.csv", &format!("from,to,G [W/K]\n{paths}n40,housing,1\n"));
    folder.write("s.csv", "into,P [W]\nn1,10\n");
    folder
}

#[test]
fn imported_elements_have_columns_where_they_are_selected() {
    let folder = chain();
    let ran = folder.run(&["steady", "net.toml", "--format", "csv"]).exits(0);
    let (headers, rows) = csv(&ran.out);
    assert_eq!(headers, ["housing.T [degC]", "air.T [degC]", "skin.Q [W]", "air.Q [W]"]);
    assert!((rows[0][0] - 25.0).abs() < 1e-9);
    ran.says("hidden 40 nodes, 40 paths, 1 source imported: columns by --select 'NAME.T'");
    let chosen = [
        "--select",
        "n1.T",
        "--select",
        "import.conductor[40].Q",
        "--select",
        "import.source[1].P",
    ];
    let ran =
        folder.run(&[&["steady", "net.toml", "--format", "csv"], &chosen[..]].concat()).exits(0);
    let (headers, rows) = csv(&ran.out);
    assert_eq!(headers, ["n1.T [degC]", "import.conductor[40].Q [W]", "import.source[1].P [W]"]);
    // 10 W over 40 paths of 1 W/K and 0.5 K/W to 20 degC
    let expected = [20.0 + 10.0 * (40.0 + 0.5), 10.0, 10.0];
    assert!(
        rows[0].iter().zip(expected).all(|(found, expected)| (found - expected).abs() < 1e-8),
        "{rows:?}"
    );
    assert!(!ran.err.contains("hidden"));
    let (headers, _) =
        csv(&folder.run(&["steady", "net.toml", "--format", "csv", "--select", "*"]).exits(0).out);
    assert_eq!(headers.len(), 40 + 2 + 41 + 1 + 1);
}

#[test]
fn tables_show_the_hottest_of_all() {
    let folder = chain();
    let ran = folder
        .run(&["steady", "net.toml"])
        .exits(0)
        .prints("n1 ")
        .prints("30 of 42 are shown, the hottest first");
    assert!(ran.out.lines().all(|line| line.chars().count() <= 80), "{}", ran.out);
    folder.run(&["run", "net.toml", "--no-files"]).exits(0).prints("n1 ").says("hidden 40 nodes");
}

#[test]
fn the_manifest_lists_the_files() {
    let folder = chain();
    folder.run(&["run", "net.toml"]).exits(0);
    let manifest: serde_json::Value =
        serde_json::from_str(&folder.read("out/net/manifest.json")).unwrap();
    let inputs = manifest["inputs"].as_array().unwrap();
    let names: Vec<&str> = inputs.iter().map(|input| input["name"].as_str().unwrap()).collect();
    assert_eq!(names, ["net.toml", "n.csv", "c.csv", "s.csv"]);
}

#[test]
fn wrong_cells_are_shown_with_their_lines() {
    let folder = chain();
    folder.write("c.csv", "from,to,G [W/K]\nn1,n2,1\nn2,nn3,1\nn1,air,-1\n");
    let ran = folder.run(&["check", "net.toml"]).exits(1);
    ran.prints("c.csv:3:4")
        .prints("no node or boundary named `nn3`")
        .prints("n2,nn3,1")
        .prints("not ok");
    // a long file is shown by its lines, which are counted all the same
    let rows = "n1,n2,1\n".repeat(40_000);
    folder.write("c.csv", &format!("from,to,G [W/K]\n{rows}n1,air,-1\n"));
    let ran = folder.run(&["check", "net.toml"]).exits(1);
    ran.prints("c.csv:40002:8").prints("40002 | n1,air,-1").prints("import.conductor[40001]");
}
