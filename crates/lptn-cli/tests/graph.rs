//! `lptn graph`: numbers on pictures, what is written where, and what is refused.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common;

use common::Folder;

/// 10 W leave through 2 K/W and 3 K/W side by side: 1.2 K/W together, so 12 K above the air; 6 W
/// and 4 W. The second path is written from the cold end to the hot one.
const PARALLEL: &str = "\
format = 1
title = \"Two paths\"
[node]
hot = { C = \"100 J/K\", T0 = \"20 degC\" }
[boundary]
air = { T = \"20 degC\" }
[resistor]
near = { from = \"hot\", to = \"air\", R = \"2 K/W\" }
far = { from = \"air\", to = \"hot\", R = \"3 K/W\" }
[source]
loss = { into = \"hot\", P = \"10 W\" }
";

/// 300 rows, one every 2 s.
const RUN: &str = "[run]\nstop = \"10 min\"\n";

/// 10 W through a rod of 10 W/(m K) and 0.01 m^2: 100 K/m. Its cold end is 10 K above the air,
/// 10 W / (100 W/(m^2 K) 0.01 m^2), so the middles of its cells are at 65, 55, 45 and 35 degC.
const ROD: &str = "\
format = 1
[grid.rod]
size = [\"0.4 m\", \"0.1 m\", \"0.1 m\"]
cells = [4, 1, 1]
k = \"10 W/(m K)\"
density = \"1000 kg/m^3\"
cp = \"1000 J/(kg K)\"
T0 = \"20 degC\"
[boundary]
air = { T = \"20 degC\" }
[convection]
end = { from = \"rod.x1\", to = \"air\", h = \"100 W/(m^2 K)\" }
[source]
heater = { into = \"rod.x0\", P = \"10 W\" }
";

fn numbers(texts: impl Iterator<Item = String>) -> Vec<f64> {
    texts.map(|text| text.parse().unwrap()).collect()
}

fn close(found: &[f64], expected: &[f64]) {
    assert_eq!(found.len(), expected.len(), "{found:?}");
    assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-9), "{found:?}");
}

#[test]
fn temperatures_and_heat_flows_are_those_of_the_closed_form() {
    let folder = Folder::with("two.toml", PARALLEL);
    let ran = folder.run(&["graph", "two.toml", "--steady", "-o", "two.svg"]);
    assert_eq!((ran.code, ran.err.as_str()), (Some(0), "wrote  two.svg\n"), "{}", ran.out);
    let text = folder.read("two.svg");
    for shown in ["hot", "32.0 °C", "20.0 °C", "6.00 W", "4.00 W", "2 K/W", "3 K/W", "100 J/K"] {
        assert!(text.contains(&format!(">{shown}</text>")), "{shown}:\n{text}");
    }
    let ran = folder.run(&["graph", "two.toml", "--steady", "--format", "mermaid"]);
    // heat goes from the node to the air on both paths
    assert!(ran.out.contains("n1 -->|\"near<br/>2 K/W<br/>6.00 W\"| n2"), "{}", ran.out);
    assert!(ran.out.contains("n1 -->|\"far<br/>3 K/W<br/>4.00 W\"| n2"), "{}", ran.out);
}

/// 2 W/K flow from the inlet into the pot, written as a negative rate from the pot, and on to the
/// drain. 2 W/K (60 degC - T) = (T - 20 degC) / 0.5 K/W: T is 40 degC, and each stream brings 40 W.
#[test]
fn a_stream_is_drawn_the_way_it_flows() {
    let text = "format = 1\n[node]\npot = { C = \"100 J/K\", T0 = \"20 degC\" }\n[boundary]\n\
                inlet = { T = \"60 degC\" }\nair = { T = \"20 degC\" }\ndrain = { T = \"20 degC\" \
                }\n[advection]\nfeed = { from = \"pot\", to = \"inlet\", mcp = \"-2 W/K\" }\n\
                waste = { from = \"pot\", to = \"drain\", mcp = \"2 W/K\" }\n[resistor]\nskin = { \
                from = \"pot\", to = \"air\", R = \"0.5 K/W\" }\n";
    let folder = Folder::with("pot.toml", text);
    let ran = folder.run(&["graph", "pot.toml", "--steady", "--format", "mermaid"]);
    assert!(
        ran.out.contains("n2 ==>|\"feed<br/>2 W/K<br/>40.00 W\"| n1"),
        "{}{}",
        ran.out,
        ran.err
    );
    assert!(ran.out.contains("n1 ==>|\"waste<br/>2 W/K<br/>40.00 W\"| n4"), "{}", ran.out);
}

/// 100 J/K on 1.2 K/W: after 2 min the rise is 12 K (1 - 1/e), and 10 W / e are stored.
#[test]
fn a_time_of_the_run_is_drawn() {
    let folder = Folder::with("two.toml", &(PARALLEL.to_owned() + RUN));
    let ran = folder.run(&["graph", "two.toml", "--at", "2min", "-o", "two.svg"]);
    assert_eq!((ran.code, ran.err.as_str()), (Some(0), "wrote  two.svg\n"), "{}", ran.out);
    let text = folder.read("two.svg");
    for shown in ["27.59 °C", "stores 3.68 W", "3.79 W", "2.53 W", "at 2 min"] {
        assert!(text.contains(&format!(">{shown}</text>")), "{shown}:\n{text}");
    }
    let ran = folder.run(&["graph", "two.toml", "--at", "121s", "--format", "mermaid"]);
    assert_eq!(ran.err, "at     2 min, the row before 2.01667 min\n");
    assert!(
        ran.out.contains("n1(\"hot<br/>100 J/K<br/>27.59 °C<br/>stores 3.68 W\")"),
        "{}",
        ran.out
    );
}

#[test]
fn bands_are_as_wide_as_heat_flows() {
    let folder = Folder::with("two.toml", &(PARALLEL.to_owned() + RUN));
    let ran = folder.run(&["graph", "two.toml", "--sankey"]);
    assert_eq!(
        (ran.code, ran.err.as_str()),
        (Some(0), "wrote  out/two/sankey.svg\n"),
        "{}",
        ran.out
    );
    let text = folder.read("out/two/sankey.svg");
    for shown in ["10.00 W, 32.0 °C", "10.00 W, 20.0 °C", "near 6.00 W", "steady state"] {
        assert!(text.contains(&format!(">{shown}</text>")), "{shown}:\n{text}");
    }
    for tip in ["near 6.00 W", "far 4.00 W", "loss 10.00 W", "hot 10.00 W, 32.0 °C"] {
        assert!(text.contains(&format!("<title>{tip}</title>")), "{tip}:\n{text}");
    }
    let ran = folder.run(&["graph", "two.toml", "--sankey", "--at", "2min", "-o", "-"]);
    for tip in ["near 3.79 W", "far 2.53 W", "stored in hot 3.68 W"] {
        assert!(ran.out.contains(&format!("<title>{tip}</title>")), "{tip}:\n{}", ran.out);
    }
    let cold = PARALLEL.replace("10 W", "0 W");
    folder.write("cold.toml", &cold);
    let ran = folder.run(&["graph", "cold.toml", "--sankey"]);
    assert_eq!(ran.code, Some(2), "{}", ran.err);
    assert!(ran.err.contains("graph::no_heat"), "{}", ran.err);
}

#[test]
fn a_slice_is_drawn_at_a_time_of_the_run() {
    let folder = Folder::with("rod.toml", &(ROD.to_owned() + RUN));
    let ran = folder.run(&["graph", "rod.toml", "--slice", "z=1", "--at", "0s", "-o", "-"]);
    assert!(ran.out.contains("<title>rod[3,1,1]: 20.0 °C</title>"), "{}{}", ran.out, ran.err);
    assert!(ran.out.contains(">at 0 s; hottest here: 20.0 °C at rod[1,1,1]</text>"), "{}", ran.out);
}

#[test]
fn a_run_that_breaks_off_is_not_drawn() {
    // 1 / 0 W after a minute
    let text = PARALLEL.replace("P = \"10 W\"", "P = \"10 [W] / (1 - t / 60 [s])\"") + RUN;
    let folder = Folder::with("two.toml", &text);
    let ran = folder.run(&["graph", "two.toml", "--at", "30s", "-o", "two.svg"]);
    assert_eq!(ran.code, Some(3), "{}", ran.err);
    assert_eq!(folder.files(), ["two.toml"]);
}

#[test]
fn without_steady_no_temperature_is_computed() {
    let folder = Folder::with("two.toml", PARALLEL);
    let ran = folder.run(&["graph", "two.toml", "--format", "mermaid"]);
    assert!(ran.out.contains("n1(\"hot<br/>100 J/K\")"), "{}", ran.out);
    assert!(ran.out.contains("n1 ---|\"near<br/>2 K/W\"| n2"), "{}", ran.out);
}

#[test]
fn the_ending_decides_and_a_picture_stands_among_the_results() {
    let folder = Folder::with("two.toml", PARALLEL);
    let said = "wrote  out/two/graph.svg\nnext   lptn graph two.toml --steady\n";
    assert_eq!(folder.run(&["graph", "two.toml", "-v"]).err, said);
    for name in ["a.svg", "a.png", "a.dot", "a.gv", "a.mmd"] {
        let ran = folder.run(&["graph", "two.toml", "-q", "-o", name]);
        assert_eq!((ran.code, ran.err.as_str()), (Some(0), ""), "{name}");
    }
    assert!(std::fs::read(folder.path().join("a.png")).unwrap().starts_with(b"\x89PNG"));
    assert_eq!(folder.read("a.dot"), folder.read("a.gv"));
    let piped = folder.run_with(&["graph", "-", "-o", "-"], PARALLEL);
    assert_eq!(piped.out, folder.read("a.svg"));
    let files = ["a.dot", "a.gv", "a.mmd", "a.png", "a.svg", "out/two/graph.svg"];
    assert_eq!(folder.files(), [&files[..], &["two.toml"]].concat());
}

#[test]
fn a_title_cannot_become_code() {
    let title = r#"title = "\"] --> </title><script>alert(1)</script> %%{init}%% \\ end""#;
    let folder = Folder::with("evil.toml", &PARALLEL.replace("title = \"Two paths\"", title));
    for arguments in [&["-o", "-"][..], &["--format", "dot"], &["--format", "mermaid"]] {
        let ran = folder.run(&[&["graph", "evil.toml"], arguments].concat());
        assert_eq!(ran.code, Some(0), "{}", ran.err);
        let code = match arguments[1] {
            "dot" => "label=\"\"]", // the quote of the title ends no string
            "mermaid" => "%%{",
            _ => "<script",
        };
        assert!(!ran.out.contains(code), "{}", ran.out);
    }
}

#[test]
fn a_control_says_what_it_switches() {
    let heater = "[control]\nguard = { sense = \"hot\", on_below = \"25 degC\", off_above = \"30 \
                  degC\" }\n";
    let text = PARALLEL.replace("P = \"10 W\"", "P = \"10 [W] * guard\"") + heater;
    let folder = Folder::with("two.toml", &text);
    let ran = folder.run(&["graph", "two.toml", "-o", "-"]);
    let said = "control guard switches loss: on below 25 °C, off above 30 °C, sensed at hot";
    assert!(ran.out.contains(said), "{}", ran.out);
    let ran = folder.run(&["graph", "two.toml", "--format", "dot"]);
    assert!(ran.out.contains("n1 -> c1") && ran.out.contains("c1 -> s1"), "{}", ran.out);
}

#[test]
fn inputs_that_change_are_said_in_the_picture_too() {
    let text = PARALLEL.replace("P = \"10 W\"", "P = \"10 [W] * (1 + t / 1 [h])\"")
        + "[run]\nstop = \"1 h\"\n";
    let folder = Folder::with("two.toml", &text);
    let ran = folder.run(&["graph", "two.toml", "--steady", "-o", "-"]);
    assert!(ran.err.contains("warning[steady::inputs_vary]"), "{}", ran.err);
    assert!(ran.out.contains("steady state for the inputs at 0 s"), "{}", ran.out);
}

#[test]
fn a_grid_is_written_for_paraview() {
    let folder = Folder::with("rod.toml", ROD);
    let ran = folder.run(&["graph", "rod.toml", "--format", "vtk"]);
    assert_eq!((ran.code, ran.err.as_str()), (Some(0), "wrote  out/rod/rod.vtk\n"), "{}", ran.out);
    let text = folder.read("out/rod/rod.vtk");
    let mut lines = text.lines();
    assert_eq!(lines.next(), Some("# vtk DataFile Version 3.0"));
    let after = |word: &str| {
        let line = text.lines().find_map(|line| line.strip_prefix(word)).unwrap();
        numbers(line.split_whitespace().map(str::to_owned))
    };
    close(&after("DIMENSIONS "), &[5.0, 2.0, 2.0]);
    close(&after("SPACING "), &[0.1, 0.1, 0.1]);
    close(&after("CELL_DATA "), &[4.0]);
    assert!(text.contains("SCALARS T_degC double 1\nLOOKUP_TABLE default\n"), "{text}");
    let (_, values) = text.split_once("default\n").unwrap();
    close(&numbers(values.lines().map(str::to_owned)), &[65.0, 55.0, 45.0, 35.0]);
}

#[test]
fn a_grid_is_written_with_the_places_of_its_cells() {
    let folder = Folder::with("rod.toml", ROD);
    let ran = folder.run(&["graph", "rod.toml", "--format", "csv", "--temperature-unit", "K"]);
    let mut reader = csv::Reader::from_reader(ran.out.as_bytes());
    assert_eq!(reader.headers().unwrap(), &["cell", "x [m]", "y [m]", "z [m]", "T [K]"][..]);
    let rows: Vec<csv::StringRecord> = reader.records().map(Result::unwrap).collect();
    let column = |i: usize| numbers(rows.iter().map(|row| row[i].to_owned()));
    close(&column(1), &[0.05, 0.15, 0.25, 0.35]);
    close(&column(2), &[0.05; 4]);
    close(&column(4), &[338.15, 328.15, 318.15, 308.15]);
    let names: Vec<&str> = rows.iter().map(|row| &row[0]).collect();
    assert_eq!(names, ["rod[1,1,1]", "rod[2,1,1]", "rod[3,1,1]", "rod[4,1,1]"]);
}

#[test]
fn a_slice_is_drawn_with_its_hottest_cell() {
    let folder = Folder::with("rod.toml", ROD);
    let ran = folder.run(&["graph", "rod.toml", "--slice", "z=5 cm"]);
    assert_eq!(ran.err, "wrote  out/rod/rod_z1.svg\n");
    let text = folder.read("out/rod/rod_z1.svg");
    assert!(text.contains("hottest here: 65.0 °C at rod[1,1,1]"), "{text}");
    assert!(text.contains("<title>rod[3,1,1]: 45.0 °C</title>"), "{text}");
}

#[test]
fn what_cannot_be_drawn_is_said_before_anything_is_computed() {
    let folder = Folder::with("rod.toml", ROD);
    folder.write("two.toml", PARALLEL);
    folder.write("run.toml", &(PARALLEL.to_owned() + RUN));
    folder.write("file", "");
    for (arguments, code) in [
        (&["rod.toml", "--slice", "z=2"][..], "graph::slice"),
        (&["rod.toml", "--slice", "x=41 cm"], "graph::slice"),
        (&["rod.toml", "--slice", "w=1"], "graph::slice"),
        (&["rod.toml", "--slice", "x=1 s"], "units::dimension"),
        (&["rod.toml", "--grid", "rod"], "graph::slice"),
        (&["rod.toml", "--grid", "rot", "--slice", "x=1"], "graph::grid"),
        (&["two.toml", "--slice", "x=1"], "graph::grid"),
        (&["two.toml", "--format", "vtk"], "graph::grid"),
        (&["rod.toml", "--format", "vtk", "--slice", "x=1"], "graph::format"),
        (&["two.toml", "-o", "two.jpg"], "graph::format"),
        (&["two.toml", "-o", "two.svg", "--format", "png"], "graph::format"),
        (&["two.toml", "--plot", "two.svg"], "graph::format"),
        (&["two.toml", "--sankey", "--format", "dot"], "a Sankey diagram is a picture"),
        (&["two.toml", "--sankey", "-o", "two.mmd"], "leave --sankey out, or write svg or png"),
        (&["two.toml", "--sankey", "--format", "vtk"], "graph::format"),
        (&["rod.toml", "--sankey", "--slice", "x=1"], "cannot be used with"),
        (&["two.toml", "--at", "1min"], "run::no_run"),
        (&["run.toml", "--at", "11min"], "outside of the run, which goes from 0 s to 10 min"),
        (&["run.toml", "--at", "3K"], "units::dimension"),
        (&["run.toml", "--at", "soon"], "--at"),
        (&["run.toml", "--at", "1min", "--steady"], "cannot be used with"),
        (&["two.toml", "--format", "jpg"], "possible values"),
        (&["two.toml", "--group", "--no-group"], "cannot be used with"),
    ] {
        let ran = folder.run(&[&["graph"], arguments].concat());
        assert_eq!((ran.code, ran.out.as_str()), (Some(2), ""), "{arguments:?}: {}", ran.err);
        assert!(ran.err.contains(code), "{arguments:?}: {}", ran.err);
    }
    let ran = folder.run(&["graph", "two.toml", "-o", "file/two.svg"]);
    assert_eq!((ran.code, ran.out.as_str()), (Some(3), ""), "{}", ran.err);
    assert!(ran.err.contains("output::cannot_write") && ran.err.contains("-o FILE"), "{}", ran.err);
    assert_eq!(folder.files(), ["file", "rod.toml", "run.toml", "two.toml"]);
}

const PIPE: &str = r#"
format = 1
[grid.pipe]
shape = "cylinder"
r_in = "20 mm"
r_out = "40 mm"
length = "0.1 m"
cells = [2, 4, 3]
material = "aluminium_6061"
T0 = "20 degC"
[boundary]
hot = { T = "80 degC" }
cold = { T = "20 degC" }
[convection]
inside = { from = "hot", to = "pipe.inner", h = "100 W/(m^2 K)" }
outside = { from = "pipe.outer", to = "cold", h = "100 W/(m^2 K)" }
"#;

/// A layer along the axis, around it and across it, and all cells with the positions of their nodes.
#[test]
fn a_cylinder_is_drawn_in_three_directions() {
    let folder = Folder::with("pipe.toml", PIPE);
    for (slice, file, said) in [
        ("z=50 mm", "pipe_z2.svg", "pipe at z = 50 mm, layer 2 of 3"),
        ("phi=100 deg", "pipe_phi2.svg", "pipe at phi = 135 deg, layer 2 of 4"),
        ("r=2", "pipe_r2.svg", "pipe at r = 35 mm, layer 2 of 2"),
    ] {
        let ran = folder.run(&["graph", "pipe.toml", "--slice", slice]);
        assert_eq!(ran.code, Some(0), "{}", ran.err);
        let picture = folder.read(&format!("out/pipe/{file}"));
        assert!(picture.contains(said), "{slice}: {picture}");
        assert!(picture.contains("pipe[2,1,2]: ") || picture.contains("pipe[2,2,1]: "), "{slice}");
    }
    let ran = folder.run(&["graph", "pipe.toml", "--slice", "r=1 mm"]);
    assert!(ran.err.contains("it reaches from 20 mm to 40 mm along r"), "{}", ran.err);
    let ran = folder.run(&["graph", "pipe.toml", "--slice", "x=1"]);
    assert!(ran.err.contains("graph::slice"), "{}", ran.err);
    let table = folder.run(&["graph", "pipe.toml", "--format", "csv"]).out;
    let mut lines = table.lines();
    assert_eq!(lines.next(), Some("cell,r [m],phi [deg],z [m],T [degC]"));
    let first: Vec<&str> = lines.next().unwrap().split(',').collect();
    let numbers: Vec<f64> = first[3..6].iter().map(|text| text.parse().unwrap()).collect();
    for (found, exact) in numbers.iter().zip([0.025, 45.0, 0.1 / 6.0]) {
        assert!((found - exact).abs() < 1e-12, "{numbers:?}");
    }
}
