//! A stream along a face: a cold plate of 10 by 4 cells with a hot spot, with numbers of NumPy
//! (a dense matrix of 40 cells and 10 nodes of water).

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::support;

use support::{celsius, close, parsed, settled, transient};

const PLATE: &str = r#"
format = 1
[param]
mcp = "20.9 W/K"
[default]
T0 = "25 degC"
[boundary]
inlet = { T = "25 degC" }
drain = { T = "25 degC" }
[grid.plate]
size = ["0.1 m", "0.04 m", "3 mm"]
cells = [10, 4]
k = "167 W/(m K)"
density = "2700 kg/m^3"
cp = "896 J/(kg K)"
[source]
chip = { into = { "plate[9,2]" = 0.5, "plate[9,3]" = 0.5 }, P = "200 W" }
[advection]
water = { from = "inlet", to = "drain", along = "plate.z0", direction = "x", mcp = "mcp" }
[convection]
film = { from = "plate.z0", to = "water", h = "4000 W/(m^2 K)" }
[limit]
outlet = { of = "water[10].T", below = "60 degC" }
[run]
stop = "1 min"
output = { every = "10 s" }
"#;

/// The oracle has no resistance between the plate and its film: k across is very large here.
fn thin(text: &str) -> String {
    text.replace("k = \"167 W/(m K)\"", "k = [\"167 W/(m K)\", \"167 W/(m K)\", \"1e9 W/(m K)\"]")
}

/// The water warms by P / mcp in all.
#[test]
fn a_stream_warms_from_row_to_row() {
    let (netlist, steady) = settled(&thin(PLATE));
    for (node, exact) in [
        ("plate[9,2]", 109.20406681675057),
        ("plate[1,1]", 25.1248079438006),
        ("water[5]", 25.283004224042095),
    ] {
        close(celsius(&netlist, &steady, node), exact, 1e-4);
    }
    let outlet = 25.0 + 200.0 / 20.9;
    close(celsius(&netlist, &steady, "water[10]"), outlet, 1e-5);
    assert!(netlist.warnings.iter().all(|warning| !warning.code.contains("stream")));
}

/// Against the axis, with the same numbers from a negative flow between exchanged ends.
#[test]
fn a_stream_against_the_axis() {
    let against = thin(PLATE).replace("direction = \"x\"", "direction = \"-x\"");
    let negative = thin(PLATE)
        .replace("from = \"inlet\", to = \"drain\"", "from = \"drain\", to = \"inlet\"")
        .replace("mcp = \"mcp\"", "mcp = \"-mcp\"");
    for (text, outlet) in [(against, "water[10]"), (negative, "water[1]")] {
        let (netlist, steady) = settled(&text);
        for (node, exact) in
            [("plate[9,2]", 109.20406681675057), ("plate[1,1]", 34.630937117306914)]
        {
            close(celsius(&netlist, &steady, node), exact, 1e-4);
        }
        close(celsius(&netlist, &steady, outlet), 25.0 + 200.0 / 20.9, 1e-5);
    }
}

/// The balance of a run closes, and a parameter of the flow has its slope: the outlet follows
/// P / mcp in steady state.
#[test]
fn the_heat_of_a_run_is_in_the_stream() {
    let (netlist, system) = parsed(&PLATE.replace("1 min", "1 h"));
    let ids: Vec<_> = netlist.network.parameter_ids().collect();
    let run = transient(&netlist).tolerance(1e-7).sensitivities(&ids).solve(&system).unwrap();
    assert!(run.ledger().closes());
    let outlet = netlist.network.node("water[10]").unwrap();
    close(*run.temperature(outlet).unwrap().last().unwrap() - 273.15, 25.0 + 200.0 / 20.9, 1e-5);
    let slope = *run.sensitivity(ids[0], outlet).unwrap().last().unwrap();
    close(slope, -200.0 / 20.9 / 20.9, 1e-4);
}

/// Two plates around one stream, and a pipe whose fluid flows along its hole.
#[test]
fn other_faces_join_the_stream() {
    let second = thin(PLATE)
        .replace("[source]", "[grid.lid]\nsize = [\"0.1 m\", \"0.04 m\", \"1 mm\"]\ncells = [10, 2]\nmaterial = \"copper\"\n[source]\nsun = { into = \"lid\", P = \"50 W\" }")
        .replace("[limit]", "upper = { from = \"lid.z1\", to = \"water\", h = \"4000 W/(m^2 K)\" }\n[limit]");
    let (netlist, steady) = settled(&second);
    close(celsius(&netlist, &steady, "water[10]"), 25.0 + 250.0 / 20.9, 1e-5);
    let pipe = r#"
format = 1
[default]
T0 = "20 degC"
[boundary]
hot = { T = "80 degC" }
[grid.pipe]
shape = "cylinder"
r_in = "10 mm"
r_out = "12 mm"
length = "2 m"
cells = [2, 3, 8]
material = "copper"
[advection]
oil = { from = "hot", to = "hot", along = "pipe.inner", direction = "-z", mcp = "10 W/K" }
[convection]
film = { from = "oil", to = "pipe.inner", h = "100 W/(m^2 K)" }
[source]
loss = { into = "pipe", P = "-40 W" }
"#;
    let (netlist, steady) = settled(pipe);
    close(celsius(&netlist, &steady, "oil[8]"), 80.0 - 40.0 / 10.0, 1e-9);
}
