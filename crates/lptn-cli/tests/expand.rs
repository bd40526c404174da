//! `lptn check --expand`: the flat netlist goes to stdout, everything else to stderr.

use crate::common;

use common::Folder;

const STAGE: &str = include_str!("../../../networks/planetary_stage.toml");

#[test]
fn the_expansion_is_a_netlist_with_the_same_results() {
    let folder = Folder::with("stage.toml", STAGE);
    let flat = folder.run(&["check", "stage.toml", "--expand"]).exits(0);
    assert!(flat.err.is_empty(), "{}", flat.err);
    let flat = flat.prints(
        "\"planet[2].gear\" = { material = \"steel_8620\", mass = \"planet[2].m\", T0 = \"T_amb\" \
            }",
    );
    std::fs::create_dir(folder.path().join("flat")).unwrap();
    folder.write("flat/stage.toml", &flat.out);
    let again = folder.run(&["check", "flat/stage.toml", "--expand"]).exits(0);
    assert_eq!(again.out, flat.out);
    let results = |file: &str, out: &str| {
        folder.run(&["run", file, "--output", out]).exits(0);
        folder.read(&format!("{out}/result.csv"))
    };
    assert_eq!(results("stage.toml", "a"), results("flat/stage.toml", "b"));
}

#[test]
fn parameters_of_instances_are_set_and_selected() {
    let folder = Folder::with("stage.toml", STAGE);
    let set = ["check", "stage.toml", "--expand", "--set", "planet[2].m=0.2kg"];
    folder.run(&set).exits(0).prints("\"planet[2].m\" = \"0.2 kg\"");
    let run = ["run", "stage.toml", "--select", "planet[*].gear.T", "--output", "out"];
    folder.run(&run).exits(0);
    let header = folder.read("out/result.csv");
    let header = header.lines().find(|line| line.contains("planet")).unwrap_or_default().to_owned();
    assert_eq!(header.matches("gear").count(), 3, "{header}");
    let wrong = folder.run(&["run", "stage.toml", "--select", "planet[4].gear.T"]).exits(2);
    assert!(wrong.err.contains("`planet` has 3 instances"), "{}", wrong.err);
    let wrong = folder.run(&["run", "stage.toml", "--set", "planet.m=1kg"]).exits(2);
    assert!(wrong.err.contains("say which: `planet[1].m` to `planet[3].m`"), "{}", wrong.err);
}

#[test]
fn what_is_wrong_goes_to_stderr() {
    let folder = Folder::with("stage.toml", &STAGE.replace("R = \"0.08 K/W\"", "R = \"0.08 W\""));
    let ran = folder.run(&["check", "stage.toml", "--expand"]).exits(1);
    assert!(ran.out.is_empty(), "{}", ran.out);
    assert!(ran.err.contains("in `planet[1]` and 2 more, used here"), "{}", ran.err);
    folder.write("broken.toml", "format = 1\n[node\n");
    folder.run(&["check", "broken.toml", "--expand"]).exits(2);
    folder.run(&["check", "stage.toml", "--expand", "--format", "json"]).exits(2);
}

/// Writing a value that stands once for three instances would change all three.
#[test]
fn a_value_of_several_instances_is_not_written_back() {
    let study = "\n[size.bearing]\nmaximise = \"planet[1].m\"\n\
                 vary = { \"planet[1].m\" = { from = \"0.01 kg\", to = \"1 kg\" } }\n\
                 require = [\"sun.T <= 200 [degC]\"]\n";
    let folder = Folder::with("stage.toml", &format!("{STAGE}{study}"));
    let ran = folder.run(&["size", "stage.toml", "--write"]).exits(2);
    assert!(ran.err.contains("size::write_shared"), "{}", ran.err);
    assert_eq!(folder.read("stage.toml"), format!("{STAGE}{study}"));
}
