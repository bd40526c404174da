//! Regression: one test for each fault found where templates, grids, imports, states and controls
//! meet.

use crate::common;

use common::{Folder, csv};

const PLATE: &str = "size = [\"0.1 m\", \"0.1 m\", \"10 mm\"]\ncells = [4, 3]\nk = \"20 W/(m K)\"\n\
    density = \"8000 kg/m^3\"\ncp = \"500 J/(kg K)\"\nT0 = \"20 degC\"\n";

/// The last row of `select`, without its time.
fn last(folder: &Folder, file: &str, select: &str) -> Vec<f64> {
    let mut args = vec!["run", file, "--format", "csv", "--tolerance", "1e-6K"];
    select.split(';').for_each(|pattern| args.extend(["--select", pattern]));
    let ran = folder.run(&args);
    csv(&ran.exits(0).out).1.pop().expect("a row").split_off(1)
}

#[track_caller]
fn close(a: &[f64], b: &[f64], allowed: f64) {
    assert!(!a.is_empty() && a.len() == b.len(), "{a:?} {b:?}");
    assert!(a.iter().zip(b).all(|(a, b)| (a - b).abs() <= allowed), "{a:?} {b:?}");
}

/// Two plates with a fan each. Paths of a template could not end at faces of its grids, nor sources
/// heat them; where the file had a grid of the same name outside, they took that one without a
/// word.
#[test]
fn grids_of_templates_have_faces() {
    let paths = "joint = { from = \"HUB\", to = \"GRID.x0\", h = \"800 W/(m^2 K)\" }";
    let film =
        "film = { from = \"GRID.x1\", to = \"air\", h = \"(20 + 180 * FAN) * 1 [W/(m^2 K)]\" }";
    let heat = "heat = { into = \"GRID\", P = \"5 W\" }\nface = { into = { \"GRID.y0\" = \
        0.75, \"GRID.y1\" = 0.25 }, P = \"4 W\" }";
    let fan = "FAN = { sense = \"HUB\", on_above = \"30 degC\", off_below = \"25 degC\" }";
    let around = "[boundary]\nair = { T = \"20 degC\" }\n[node]\nhub = { C = \"50 J/K\", T0 = \"20 \
        degC\" }\n\
                  [source]\ndrive = { into = \"hub\", P = \"40 W\" }\n";
    let run = "[run]\nstop = \"10 min\"\n";
    let inside =
        |text: &str| text.replace("GRID", "plate").replace("HUB", "left").replace("FAN", "fan");
    let template = format!(
        "format = 1\n{around}[grid.plate]\n{PLATE}[convection]\nother = {{ from = \"plate.x1\", to \
         = \"air\", \
         h = \"1 W/(m^2 K)\" }}\n[template.slab]\nport = \
         [\"left\", \"air\"]\n[template.slab.grid.plate]\n{PLATE}\
         [template.slab.contact]\n{}\n[template.slab.convection]\n{}\n[template.slab.source]\n{}\n\
         [template.slab.control]\n{}\n[use.s]\ntemplate = \"slab\"\ncount = 2\n\
         connect = {{ left = \"hub\", air = \"air\" }}\n{run}",
        inside(paths),
        inside(film),
        inside(heat),
        inside(fan)
    );
    let twice = |text: &str| {
        let one = |n: &str| {
            let mut text = text.replace("GRID", &format!("plate{n}")).replace("HUB", "hub");
            for name in ["joint", "film", "heat", "face"] {
                text = text.replace(&format!("{name} ="), &format!("{name}{n} ="));
            }
            text.replace("FAN", &format!("fan{n}"))
        };
        format!("{}\n{}\n", one("1"), one("2"))
    };
    let source = twice(heat);
    let flat = format!(
        "format = 1\n{around}{source}[grid.plate1]\n{PLATE}[grid.plate2]\n{PLATE}[contact]\n{}[convection]\n{}\
         [control]\n{}{run}",
        twice(paths),
        twice(film),
        twice(fan)
    );
    let folder = Folder::with("template.toml", &template);
    folder.write("flat.toml", &flat);
    let parts = last(&folder, "template.toml", "hub.T;s[*].plate.mean;s[*].plate.x1.T");
    let whole = last(&folder, "flat.toml", "hub.T;plate?.mean;plate?.x1.T");
    close(&parts, &whole, 1e-4);
    assert!(whole[0] > 25.0, "{whole:?}");
}

/// A template reached into a grid of the file that is none of its ports.
#[test]
fn templates_do_not_reach_faces_outside() {
    let text = format!(
        "format = 1\n[boundary]\nair = {{ T = \"20 degC\" \
         }}\n[grid.plate]\n{PLATE}[template.skin]\nport = [\"amb\"]\n\
         [template.skin.convection]\nfilm = {{ from = \"plate.x1\", to = \"amb\", h = \"5 W/(m^2 \
         K)\" }}\n\
         [use.s]\ntemplate = \"skin\"\nconnect = {{ amb = \"air\" }}\n[run]\nstop = \"1 s\"\n"
    );
    Folder::with("skin.toml", &text)
        .run(&["run", "skin.toml"])
        .exits(2)
        .says("template `skin` has no");
}

/// `run` ended with exit code 2 and not a word, `check` with "0 errors".
#[test]
fn a_control_at_a_face_without_paths_says_so() {
    let text = format!(
        "format = 1\n[boundary]\nair = {{ T = \"20 degC\" }}\n[grid.plate]\n{PLATE}[convection]\n\
         film = {{ from = \"plate.x0\", to = \"air\", h = \"10 W/(m^2 K)\" }}\n[control]\n\
         fan = {{ sense = \"plate.x1[1]\", on_above = \"40 degC\", off_below = \"35 degC\" }}\n\
         [source]\nheat = {{ into = \"plate\", P = \"50 [W] * fan\" }}\n[run]\nstop = \"1 min\"\n"
    );
    let folder = Folder::with("plate.toml", &text);
    folder.run(&["run", "plate.toml"]).exits(2).says("nothing is attached to face `plate.x1`");
}

/// Imported nodes began at their `T0` in place of the state, without a word; a network with a grid
/// could not go on.
#[test]
fn imported_nodes_and_grids_go_on_from_a_state() {
    let text = |run: &str| {
        format!(
            "format = 1\n[import]\nnodes = \"nodes.csv\"\n[boundary]\nair = {{ T = \"20 degC\" }}\n\
             [grid.plate]\n{PLATE}[convection]\nfilm = {{ from = \"plate.x0\", to = \"air\", h \
             = \"10 W/(m^2 K)\" }}\n\
             [resistor]\na = {{ from = \"n1\", to = \"n2\", R = \"0.5 K/W\" }}\n\
             b = {{ from = \"n2\", to = \"plate[2,2]\", R = \"1 K/W\" }}\n\
             [source]\nheat = {{ into = \"n1\", P = \"30 W\" }}\n[run]\n{run}\n"
        )
    };
    let folder = Folder::with("whole.toml", &text("stop = \"25 min\""));
    folder.write("nodes.csv", "name,C [J/K],T0 [degC]\nn1,50,20\nn2,,\n");
    folder.write("first.toml", &text("stop = \"10 min\""));
    folder.write("second.toml", &text("stop = \"15 min\"\ninitial = \"out/first/state.json\""));
    let select = "n1.T;n2.T;plate.*;plate[*].T";
    let whole = last(&folder, "whole.toml", select);
    last(&folder, "first.toml", select);
    close(&last(&folder, "second.toml", select), &whole, 1e-5);
    folder.write("nodes.csv", "name,C [J/K],T0 [degC]\nn1,50,20\nn2,,\nn3,1,20\n");
    let lacking = text("stop = \"15 min\"\ninitial = \"out/first/state.json\"");
    folder.write(
        "third.toml",
        &lacking
            .replace("[resistor]", "[resistor]\nc = { from = \"n3\", to = \"n1\", R = \"1 K/W\" }"),
    );
    folder.run(&["run", "third.toml"]).exits(2).says("netlist::state_missing_node").says("`n3`");
}

/// What was written of a grid could not be read again; nameless rows of an import neither; `L_char`
/// was left out.
#[test]
fn expansions_are_the_same_network_or_refused() {
    let grid = format!(
        "format = 1\n[boundary]\nair = {{ T = \"20 degC\" }}\n[grid.plate]\n{PLATE}[convection]\n\
         film = {{ from = \"plate.x0\", to = \"air\", h = \"10 W/(m^2 K)\" }}\n[run]\nstop = \"1 \
         min\"\n"
    );
    let folder = Folder::with("grid.toml", &grid);
    let ran = folder.run(&["check", "grid.toml", "--expand"]).exits(1).says("netlist::not_flat");
    assert!(ran.out.is_empty(), "{}", ran.out);
    folder.write(
        "import.toml",
        "format = 1\n[import]\nconductors = \"c.csv\"\n[boundary]\nair = { T = \"20 degC\" \
         }\n[node]\n\
         a = { C = \"5 J/K\", T0 = \"50 degC\", L_char = \"2 mm\" }\n[run]\nstop = \"1 min\"\n",
    );
    folder.write("c.csv", "from,to,G [W/K]\na,air,2\n");
    folder.run(&["check", "import.toml", "--expand"]).exits(1).says("`import.conductor[1]`");
    folder.write("c.csv", "from,to,G [W/K],name\na,air,2,skin\n");
    folder.run(&["check", "import.toml", "--expand"]).exits(0).prints("L_char = \"0.002 m\"");
}

/// The end of a rod was taken for a node: its area had to be given, and a wrong one was not
/// noticed.
#[test]
fn the_end_of_a_rod_is_a_face() {
    let rod = |area: &str| {
        format!(
            "format = 1\n[boundary]\nair = {{ T = \"20 degC\" }}\n[grid.rod]\n{}[convection]\n\
             film = {{ from = \"rod.x1\", to = \"air\", h = \"100 W/(m^2 K)\"{area} }}\n\
             [source]\nheat = {{ into = \"rod.x0\", P = \"20 W\" }}\n[run]\nstop = \"1 min\"\n",
            PLATE.replace("[4, 3]", "[4]")
        )
    };
    let folder = Folder::with("rod.toml", &rod(""));
    let ran =
        folder.run(&["steady", "rod.toml", "--format", "csv", "--select", "rod.x1.T"]).exits(0);
    // the face is 0.1 m by 10 mm: 20 W / (100 W/(m^2 K) * 0.001 m^2) = 200 K above the air
    close(&csv(&ran.out).1[0], &[220.0], 1e-6);
    let control = "[control]\nfan = { sense = \"rod.x1\", on_above = \"40 degC\", off_below = \"30 \
        degC\" }\n[run]";
    folder.write(
        "control.toml",
        &rod("").replace("[run]", control).replace("100 W/(m^2 K)", "100 [W/(m^2 K)] * fan"),
    );
    folder.run(&["check", "control.toml"]).exits(0);
    folder.write("wrong.toml", &rod(", area = \"1 m^2\""));
    folder.run(&["run", "wrong.toml"]).exits(2).says("area");
}

/// A wire that is connected after 400 s gives its node no reading for the start: the record and the
/// time are named. From 400 s on every node has one.
#[test]
fn a_node_that_begins_at_a_later_reading_is_named() {
    let text = "format = 1\n[param]\nR = '0.3 K/W'\n[node]\n\
        a = { C = '2 kJ/K', T0 = '20 degC' }\nb = { C = '2 kJ/K', T0 = '20 degC' }\n\
        [boundary]\nroom = { T = '20 degC' }\n[resistor]\n\
        ra = { from = 'a', to = 'room', R = 'R' }\nrb = { from = 'b', to = 'room', R = 'R' }\n\
        [fit.cooling]\ndata = 'r.csv'\ncolumn = { a = 'a.T', b = 'b.T' }\nvary = ['R']\n\
        initial = 'record'\n";
    let folder = Folder::with("x.toml", text);
    let row = |from: f64, t: f64| {
        let left = f64::exp(-t / 800.0);
        let b = if t < 400.0 { String::new() } else { (20.0 + 70.0 * left).to_string() };
        let late = t >= from;
        if late { format!("{t},{},{b}\n", 20.0 + 50.0 * left) } else { String::new() }
    };
    let write = |from: f64| {
        let rows: String = (0..200).map(|k| row(from, 10.0 * f64::from(k))).collect();
        folder.write("r.csv", &format!("t [s],a [degC],b [degC]\n{rows}"));
        folder.run(&["fit", "network", "x.toml"]).exits(0)
    };
    let ran =
        write(0.0).says("fit::late_reading").says("`b` begins at 0 s with a reading of 400 s");
    assert_eq!(ran.err.matches("fit::late_reading").count(), 1, "{}", ran.err);
    let ran = write(400.0);
    assert!(!ran.err.contains("fit::late_reading") && ran.out.contains("0.4"), "{}", ran.out);
}
