//! Bodies that meet in part, with numbers of NumPy: dense matrices of cells and surfaces, whose
//! common areas are found by comparing every cell of the one face with every cell of the other.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::support;

use lptn::prelude::*;
use lptn_network::ParameterId;
use lptn_solve::sensitive_run;
use support::{celsius, close, parsed, settled, transient};

/// A die of 10 x 10 mm on a copper spreader of 30 x 30 mm.
const DIE: &str = r#"
format = 1
[param]
x = "7 mm"
[default]
T0 = "40 degC"
[grid.die]
size = ["10 mm", "10 mm", "0.5 mm"]
cells = [5, 5]
k = "120 W/(m K)"
density = "2330 kg/m^3"
cp = "700 J/(kg K)"
[grid.spreader]
size = ["30 mm", "30 mm", "2 mm"]
cells = [15, 15]
k = "390 W/(m K)"
density = "8900 kg/m^3"
cp = "385 J/(kg K)"
[boundary]
water = { T = "40 degC" }
[contact]
solder = { from = "die.z0", to = "spreader.z1", offset = ["x", "3 mm"], h = "50 kW/(m^2 K)" }
[convection]
cold = { from = "spreader.z0", to = "water", h = "20 kW/(m^2 K)" }
[source]
loss = { into = "die.z1", P = "200 W" }
[run]
stop = "100 ms"
output = { every = "10 ms" }
"#;

fn centred() -> String {
    DIE.replace(" offset = [\"x\", \"3 mm\"],", "").replace("[param]\nx = \"7 mm\"\n", "")
}

#[test]
fn a_die_on_a_spreader() {
    let (netlist, steady) = settled(&centred());
    close(celsius(&netlist, &steady, "die[3,3]"), 124.800964, 1e-6);
    let (netlist, system) = parsed(&centred());
    let run = transient(&netlist).tolerance(1e-7).solve(&system).unwrap();
    let node = netlist.network.node("die[3,3]").unwrap();
    close(run.temperature(node).unwrap().last().unwrap() - 273.15, 101.195211, 1e-5);
    assert!(run.ledger().closes());
}

/// At 7 mm the die cuts cells, at 15 mm half of it overhangs.
#[test]
fn a_parameter_moves_the_die() {
    let (mut netlist, _) = parsed(DIE);
    for (x, coldest, hottest) in [
        ("0 mm", 114.67115659538625, 123.81576348273086),
        ("7 mm", 114.00948555188991, 125.2988061911084),
        ("11 mm", 119.29947429965289, 168.90328294334125),
        ("15 mm", 146.27058938855652, 702.1381071478191),
    ] {
        netlist.set(&[format!("x={x}")]).unwrap();
        let codes: Vec<&str> = netlist.warnings.iter().map(|warning| warning.code).collect();
        let overhangs = x.len() == 5;
        assert_eq!(codes.contains(&"network::overhang"), overhangs, "{codes:?}");
        let system = ThermalSystem::assemble(&netlist.network).unwrap();
        let steady = SteadyState::solve(&system, 0.0).unwrap();
        let cells = netlist.network.grids()[0].nodes();
        let all: Vec<f64> = cells.map(|id| steady.temperatures[id.index()] - 273.15).collect();
        close(all.iter().copied().fold(f64::INFINITY, f64::min), coldest, 1e-8);
        close(all.iter().copied().fold(0.0, f64::max), hottest, 1e-8);
    }
}

/// The common area confirms that the die overhangs.
#[test]
fn the_common_area_is_an_answer_to_the_warning() {
    let given = |area: &str| {
        let text = DIE.replace("7 mm", "15 mm");
        lptn::parse("die", &text.replace("h = \"50", &format!("area = \"{area}\", h = \"50")))
    };
    let netlist = given("50 mm^2").unwrap();
    assert!(netlist.warnings.iter().all(|warning| warning.code != "network::overhang"));
    let rejected = given("100 mm^2").unwrap_err();
    assert_eq!(rejected.diagnostics[0].code, "network::face_area");
    assert!(rejected.to_string().contains("overlap of `die.z0` and `spreader.z1`, 5e-5 m^2"));
}

/// Slopes in K/m by the matrices, moved by 1 um to both sides.
#[test]
fn slopes_over_the_place_of_a_face() {
    let (netlist, _) = parsed(&DIE.replace("100 ms", "3 s"));
    let ids: Vec<ParameterId> = netlist.network.parameter_ids().collect();
    let settings = transient(&netlist).tolerance(1e-7);
    let run = sensitive_run(&netlist.network, &settings, &ids).unwrap_or_else(|e| panic!("{e}"));
    for (node, slope) in
        [("die[1,1]", 355.62794), ("die[5,3]", 2217.27564), ("spreader[13,10]", 3360.27360)]
    {
        let node = netlist.network.node(node).unwrap();
        let found = *run.sensitivity(ids[0], node).unwrap().last().unwrap();
        close(found, slope, 1e-3 * slope);
    }
}

/// A die of 12 x 10 mm and 4 x 6 cells that is turned by a right angle; one cell is heated.
#[test]
fn a_turned_die() {
    let text = centred()
        .replace("size = [\"10 mm\", \"10 mm\"", "size = [\"12 mm\", \"10 mm\"")
        .replace("[5, 5]", "[4, 6]")
        .replace("[15, 15]", "[7, 9]")
        .replace(
            "spreader.z1\",",
            "spreader.z1\", offset = [\"7.1 mm\", \"-3.3 mm\"], axes = [\"-y\", \"x\"],",
        )
        .replace("into = \"die.z1\"", "into = \"die[4,2]\"");
    let (netlist, steady) = settled(&text);
    for (node, exact) in [
        ("die[4,2]", 590.5720569090358),
        ("die[1,2]", 58.109342365052285),
        ("die[4,6]", 69.1257302756678),
    ] {
        close(celsius(&netlist, &steady, node), exact, 1e-7);
    }
}
