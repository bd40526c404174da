//! Netlists that lptn writes are the networks that they were written for. Expected temperatures are
//! closed forms.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common;

use common::{Folder, csv};

/// The last row of a run, under this header.
#[track_caller]
fn last(folder: &Folder, file: &str, header: &str) -> f64 {
    let ran = folder
        .run(&["run", file, "--no-files", "--format", "csv", "--tolerance", "1e-7K"])
        .exits(0);
    let (headers, rows) = csv(&ran.out);
    let column =
        headers.iter().position(|name| name == header).unwrap_or_else(|| panic!("{headers:?}"));
    rows.last().unwrap()[column]
}

#[track_caller]
fn near(found: f64, expected: f64) {
    assert!((found - expected).abs() < 1e-5, "{found} is not {expected}");
}

/// A block of 640 J/K behind 1 K/W, so that its time constant is 640 s.
fn block(more: &str, air: &str) -> String {
    format!(
        "format = 1\n{more}[boundary]\nair = {{ T = \"{air}\" }}\n[node]\ncore = {{ C = \"640 \
         J/K\", T0 = \"60 degC\" }}\n\
         [resistor]\nskin = {{ from = \"core\", to = \"air\", R = \"1 K/W\" }}\n"
    )
}

const TAU: f64 = 640.0;
const RUN: &str = "[run]\nstop = \"2 min\"\n";

/// The name of a node in a template was written without quotes, which is another network to TOML.
#[test]
fn regression_a_reduced_network_keeps_the_name_of_a_node_in_a_template() {
    let part = "format = 1\n[boundary]\nair = { T = \"20 degC\" }\n[template.part]\nparam = { R = \
        { unit = \"K/W\" } }\n\
        port = [\"to\"]\n[template.part.node]\ncore = { C = \"640 J/K\", T0 = \"60 degC\" \
        }\n[template.part.resistor]\n\
        skin = { from = \"core\", to = \"to\", R = \"R\" }\n[use.part]\ntemplate \
        = \"part\"\nconnect = { to = \"air\" }\n\
        set = { R = \"1 K/W\" }\n";
    let folder = Folder::with("whole.toml", &format!("{part}{RUN}"));
    folder.run(&["reduce", "whole.toml", "--port", "part.core", "--write", "one.toml"]).exits(0);
    assert!(
        folder.read("one.toml").contains("\"part.core\" = { C = "),
        "{}",
        folder.read("one.toml")
    );
    near(last(&folder, "one.toml", "part.core.T [degC]"), 20.0 + 40.0 * f64::exp(-120.0 / TAU));
    let again = ["reduce", "one.toml", "--port", "part.core", "--format", "toml"];
    folder.run(&again).exits(0).prints("\"part.core\"");
}

/// The points of a temperature signal were written in K, which is a difference there.
#[test]
fn regression_a_reduced_network_keeps_temperatures_that_change() {
    let day = "[signal]\nday = { t = [\"0 s\", \"2 min\"], v = [\"20 degC\", \"30 degC\"] }\n";
    let folder = Folder::with("whole.toml", &(block(day, "day") + RUN));
    folder.run(&["reduce", "whole.toml", "--port", "core", "--write", "one.toml"]).exits(0);
    // the air rises by r: T = air - r tau, and what is left of the start
    let r = 10.0 / 120.0;
    near(
        last(&folder, "one.toml", "core.T [degC]"),
        30.0 - r * TAU + (40.0 + r * TAU) * f64::exp(-120.0 / TAU),
    );
    let table = "[table]\nof_time = { x = [\"0 s\", \"2 min\"], y = [\"20 degC\", \"30 degC\"] }\n";
    let other = Folder::with("whole.toml", &(block(table, "of_time(t)") + RUN));
    other.run(&["reduce", "whole.toml", "--port", "core", "--write", "one.toml"]).exits(0);
    near(last(&other, "one.toml", "core.T [degC]"), last(&folder, "one.toml", "core.T [degC]"));
}

const MAP: &str =
    "speed [rpm],torque [N m],loss [W]\n1000,10,10\n1000,20,30\n2000,10,25\n2000,20,75\n";

/// A table of two arguments became a comment, and the source that calls it an error; its file is
/// named from where the new netlist stands.
#[test]
fn regression_a_reduced_network_keeps_tables_of_two_arguments() {
    let map = "[table]\nmap = { csv = \"map.csv\", x = \"speed\", y = \"torque\", value = \"loss\" \
        }\n[signal]\n\
        n = { t = [\"0 s\", \"2 min\"], v = [\"1000 rpm\", \"2000 rpm\"] }\n";
    let source = "[source]\nq = { into = \"core\", P = \"map(n, 15 [N m])\" }\n";
    let folder = Folder::with("whole.toml", &(block(map, "20 degC") + source + RUN));
    folder.write("map.csv", MAP);
    std::fs::create_dir_all(folder.path().join("reduced/here")).unwrap();
    // P rises from 20 W by 30 W, T - 20 degC = -140 K + t/4 K/s + what is left
    let expected = 20.0 - 140.0 + 30.0 + 180.0 * f64::exp(-120.0 / TAU);
    for file in ["one.toml", "reduced/here/one.toml"] {
        folder.run(&["reduce", "whole.toml", "--port", "core", "--write", file]).exits(0);
        near(last(&folder, file, "core.T [degC]"), expected);
    }
    assert!(folder.read("reduced/here/one.toml").contains("csv = \"../../map.csv\""));
    let printed =
        folder.run(&["reduce", "whole.toml", "--port", "core", "--format", "toml"]).exits(0).out;
    folder.write("printed.toml", &printed);
    near(last(&folder, "printed.toml", "core.T [degC]"), expected);
}

/// A map of a file that is included from another folder is named from the netlist.
#[test]
fn regression_an_expansion_names_files_from_where_it_stands() {
    let whole = block("", "20 degC").replacen(
        "format = 1\n",
        "format = 1\ninclude = [\"parts/map.toml\"]\n",
        1,
    );
    let folder = Folder::with("whole.toml", &(whole + RUN));
    std::fs::create_dir(folder.path().join("parts")).unwrap();
    folder.write(
        "parts/map.toml",
        "format = 1\n[table]\nmap = { csv = \"map.csv\", x = \"speed\", y = \"torque\", value \
         = \"loss\" }\n\
         [source]\nq = { into = \"core\", P = \"map(1500 [rpm], 15 [N m])\" }\n",
    );
    folder.write("parts/map.csv", MAP);
    let flat =
        folder.run(&["check", "whole.toml", "--expand"]).exits(0).prints("parts/map.csv").out;
    folder.write("flat.toml", &flat);
    assert_eq!(folder.run(&["check", "flat.toml", "--expand"]).exits(0).out, flat);
}

/// A node inside a grid, and one of an import, keep their names.
#[test]
fn a_port_of_a_grid_or_an_import_is_written_or_refused_but_never_another() {
    let grid = "format = 1\n[grid.bar]\nsize = [\"0.1 m\", \"0.1 m\", \"0.1 m\"]\ncells = [2, 1, \
        1]\n\
        material = \"aluminium_6061\"\nT0 = \"60 degC\"\n[boundary]\nair = { T = \"20 degC\" \
        }\n[convection]\n\
        skin = { from = \"bar.x1\", to = \"air\", h = \"10 W/(m^2 K)\" }\n[run]\nstop = \"1 \
        min\"\n";
    let folder = Folder::with("whole.toml", grid);
    folder.run(&["reduce", "whole.toml", "--port", "bar[1,1,1]", "--write", "one.toml"]).exits(1);
    folder.run(&["check", "one.toml"]).exits(0);
    assert!(folder.read("one.toml").contains("\"bar[1,1,1]\" = {"));
}

/// Values that are written back replace numbers and nothing else.
#[test]
fn numbers_that_are_written_back_are_those_that_were_found() {
    let study = "[param]\nR = \"300 mK/W\"  # of the skin\nP = \"50 W\"\n[size.skin]\nmaximise \
        = \"R\"\n\
        vary = { R = { from = \"1 mK/W\", to = \"10 K/W\" } }\nrequire = [\"core.T <= 80 \
        [degC]\"]\n\
        [source]\nq = { into = \"core\", P = \"P\" }\n";
    let text = block(study, "20 degC").replace("R = \"1 K/W\" }", "R = \"R\" }");
    let folder = Folder::with("whole.toml", &text);
    folder.run(&["size", "whole.toml", "--write"]).exits(0);
    // 60 K / 50 W
    let written = folder.read("whole.toml");
    assert!(written.contains("R = \"1200 mK/W\"  # of the skin\nP = \"50 W\""), "{written}");
}
