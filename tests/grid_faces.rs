//! What ends at the faces of grids, what is shown of them, and that their heat is conserved.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::support;

use lptn::prelude::*;
use lptn_netlist::Netlist;
use lptn_network::{ConductorFlow, ConductorId, GridValue, Node};
use support::{close, column, parsed, settled};

/// A plate with everything that may end at a face.
const PLATE: &str = r#"
format = 1
[default]
T0 = "20 degC"
[grid.plate]
size = ["0.2 m", "0.1 m", "10 mm"]
cells = [6, 4, 2]
material = "aluminium_6061"
[boundary]
air = { T = "20 degC" }
sky = { T = "0 degC" }
[convection]
skin = { from = "plate.z1", to = "air", h = "10 W/(m^2 K) " }
[radiation]
glow = { from = "plate.z1", to = "sky", emissivity = 0.9 }
[resistor]
foot = { from = "plate.x0", to = "air", G = "0.4 W/K" }
[source]
heater = { into = { "plate.z0" = 0.75, "plate" = 0.25 }, P = "if(t < 600 [s], 40 [W], 10 [W])" }
spot = { into = "plate[1,1,1]", P = "5 W" }
[limit]
hot = { of = "plate.max - plate.z1.T", below = "50 K" }
[run]
stop = "1 h"
output = { every = "10 min" }
"#;

#[test]
fn heat_is_conserved_over_every_face_and_the_whole_is_the_sum_of_its_parts() {
    let (netlist, system) = parsed(PLATE);
    let run = support::transient(&netlist).tolerance(1e-7).solve(&system).unwrap();
    let ledger = run.ledger();
    assert!(ledger.closes() && ledger.relative_residual().unwrap().abs() < 1e-8, "{ledger:?}");
    let network = &netlist.network;
    let table = Table::of_solution(&run, &Selection::all(network), &netlist.temperature_unit);
    for joint in network.face_paths() {
        let all = column(&table, &format!("{}.Q", joint.name));
        let parts: Vec<Vec<f64>> =
            joint.conductors().map(|id| run.conductor_heat(id).unwrap()).collect();
        assert!(parts.len() > 1);
        for (row, whole) in all.iter().enumerate() {
            close(*whole, parts.iter().map(|part| part[row]).sum(), 1e-12 * whole.abs());
        }
    }
    // what the boundaries take is what the paths to them bring
    let sum = |names: &[&str], row: usize| {
        names.iter().map(|name| column(&table, name)[row]).sum::<f64>()
    };
    for row in 0..table.rows() {
        close(sum(&["skin.Q", "foot.Q"], row), -sum(&["air.Q"], row), 1e-9);
        close(sum(&["glow.Q"], row), -sum(&["sky.Q"], row), 1e-9);
    }
}

#[test]
fn the_balance_of_a_boundary_counts_a_path_to_a_face_as_one() {
    let (netlist, steady) = settled(PLATE);
    let air = netlist.network.boundary_ids().next().unwrap();
    let balance = steady.balance(&netlist.network, air.into());
    let names: Vec<_> =
        balance.terms.iter().map(|term| netlist.network.name_of(term.item)).collect();
    assert_eq!(names, ["foot", "skin"]);
    close(balance.power(), -steady.boundary_heat[0], 1e-9);
    // over a run each is one running integral
    let (netlist, system) = parsed(PLATE);
    let mut transient = support::transient(&netlist);
    transient.balance = Some(air.into());
    let run = transient.solve(&system).unwrap();
    let balance = run.balance().unwrap();
    assert_eq!(balance.terms.len(), 2);
    close(balance.heat().unwrap(), balance.stored.unwrap(), 1e-6);
}

#[test]
fn a_run_of_a_grid_repeats_to_the_bit() {
    let run = || {
        let (netlist, system) = parsed(PLATE);
        let run = support::transient(&netlist).solve(&system).unwrap();
        (0..run.times().len())
            .flat_map(|row| run.row(row).to_vec())
            .map(f64::to_bits)
            .collect::<Vec<_>>()
    };
    assert_eq!(run(), run());
}

/// A plate of one material with one path to a face, in this form.
fn plate(path: &str) -> (Netlist, SteadyState) {
    let text = format!(
        r#"
format = 1
[grid.plate]
size = ["0.2 m", "0.1 m", "10 mm"]
cells = [4, 5, 2]
k = "0.5 W/(m K)"
density = "1000 kg/m^3"
cp = "1000 J/(kg K)"
T0 = "20 degC"
[boundary]
air = {{ T = "20 degC" }}
[source]
spot = {{ into = "plate[1,1,1]", P = "3 W" }}
{path}
"#
    );
    settled(&text)
}

#[test]
fn every_form_of_a_path_is_shared_by_area() {
    let (_, film) =
        plate("[convection]\np = { from = \"plate.z1\", to = \"air\", h = \"10 W/(m^2 K)\" }");
    let forms = [
        "[convection]\np = { from = \"plate.z1\", to = \"air\", h = \"10 W/(m^2 K)\", area = \"200 \
         cm^2\" }",
        "[convection]\np = { from = \"plate.z1\", to = \"air\", R = \"5 K/W\" }",
        "[resistor]\np = { from = \"plate.z1\", to = \"air\", G = \"0.2 W/K\" }",
        "[contact]\np = { from = \"air\", to = \"plate.z1\", h = \"10 W/(m^2 K)\" }",
        "[conduction]\np = { from = \"plate.z1\", to = \"air\", k = \"0.1 W/(m K)\", shape \
         = \"slab\", thickness = \"10 mm\" }",
        // ln(2) / (2 pi L k) = 5 K/W
        "[conduction]\np = { from = \"plate.z1\", to = \"air\", k = \"0.2 * ln(2) / (2 * pi) * 1 \
         [W/(m K)]\", shape = \"cylinder\", r_in = \"1 m\", r_out = \"2 m\", length = \"1 m\" }",
        "[conduction]\np = { from = \"plate.z1\", to = \"air\", k = \"0.2 / (4 * pi) * 0.5 * 1 \
         [W/(m K)]\", shape = \"sphere\", r_in = \"1 m\", r_out = \"2 m\" }",
    ];
    for form in forms {
        let (_, other) = plate(form);
        let far = support::distance(&film.temperatures, &other.temperatures);
        assert!(far < 1e-9, "{far:e} {form}");
    }
}

#[test]
fn radiation_of_a_face_is_that_of_its_area() {
    let grey = "[radiation]\np = { from = \"plate.z1\", to = \"air\", emissivity = [0.8, 0.5] }";
    let (_, grey) = plate(grey);
    // 1 / (1/0.8 + 1/0.5 - 1) of 200 cm^2
    let exchange = 0.02 / (1.0 / 0.8 + 1.0 / 0.5 - 1.0);
    let (_, area) = plate(&format!(
        "[radiation]\np = {{ from = \"plate.z1\", to = \"air\", Gr = \"{exchange} m^2\" }}"
    ));
    assert!(support::distance(&grey.temperatures, &area.temperatures) < 1e-7);
}

#[test]
fn the_columns_of_a_grid_are_few_and_the_others_can_be_had() {
    let (netlist, _) = parsed(PLATE);
    let names = Selection::names(&netlist.network);
    let expected = "plate.mean plate.min plate.max plate.x0.T plate.z0.T plate.z1.T air.T sky.T \
        skin.Q glow.Q foot.Q heater.P spot.P air.Q sky.Q";
    let sorted = |names: &[&str]| {
        let mut names: Vec<String> = names.iter().map(|name| (*name).to_owned()).collect();
        names.sort();
        names
    };
    let found: Vec<&str> = names.iter().map(String::as_str).collect();
    assert_eq!(sorted(&found), sorted(&expected.split_whitespace().collect::<Vec<_>>()));
    let (_, steady) = settled(PLATE);
    let chosen = |pattern: &str| {
        let selection = Selection::matching(&netlist.network, &[pattern.to_owned()]).unwrap();
        let table =
            Table::of_steady(&netlist.network, &steady, &selection, &netlist.temperature_unit)
                .unwrap();
        table.columns().iter().map(|column| column.name.clone()).collect::<Vec<_>>()
    };
    assert_eq!(chosen("plate[2,*,1].T").len(), 4);
    assert_eq!(chosen("plate[*].T").len(), 48);
    assert_eq!(chosen("plate.z1[1,*].T").len(), 4);
    assert_eq!(chosen("plate.x[1,1,1].Q"), ["plate.x[1,1,1].Q"]);
    assert_eq!(chosen("skin[6,4].Q"), ["skin[6,4].Q"]);
    assert_eq!(chosen("plate.y0.T"), ["plate.y0.T"]);
    assert_eq!(chosen("*.T").len(), 5);
}

#[test]
fn a_parameter_changes_the_size_of_a_grid_and_what_contradicts_it_is_told() {
    let text = r#"
format = 1
[param]
depth = "0.2 m"
[grid.wall]
size = ["depth", "1 m", "0.5 m"]
cells = [10, 2]
k = "1 W/(m K)"
density = "2000 kg/m^3"
cp = "1000 J/(kg K)"
T0 = "20 degC"
[boundary]
air = { T = "20 degC" }
[convection]
skin = { from = "wall.x1", to = "air", h = "10 W/(m^2 K)" }
top = { from = "wall.z1", to = "air", h = "10 W/(m^2 K)", area = "0.2 m^2" }
"#;
    let (mut netlist, _) = parsed(text);
    let cell = netlist.network.node("wall[1,1]").unwrap();
    close(netlist.network.capacity(cell), 0.2 * 0.5 * 2e6 / 20.0, 1e-9);
    let rejected = netlist.set(&["depth=0.4m".to_owned()]).unwrap_err();
    let codes: Vec<&str> = rejected.diagnostics.iter().map(|problem| problem.code).collect();
    assert_eq!(codes, ["network::face_area"]);
    assert!(rejected.to_string().contains("0.2 m^2") && rejected.to_string().contains("0.4 m^2"));
    let (mut free, _) = parsed(&text.replace(", area = \"0.2 m^2\"", ""));
    free.set(&["depth=0.4m".to_owned()]).unwrap();
    close(free.network.capacity(cell), 0.4 * 0.5 * 2e6 / 20.0, 1e-9);
}

#[test]
fn a_grid_that_melts_takes_up_its_latent_heat() {
    // 1 kg of wax from 50 degC, melting from 55 to 57 degC: 10 K of 2 kJ/(kg K) and 200 kJ/kg are
    // 220 kJ
    let text = r#"
format = 1
[material]
wax = { density = "800 kg/m^3", cp = "2000 J/(kg K)", k = "0.2 W/(m K)", solidus = "55 degC", liquidus = "57 degC", latent_heat = "200 kJ/kg" }
[grid.pack]
size = ["0.05 m", "0.5 m", "0.05 m"]
cells = [3, 4, 2]
material = "wax"
T0 = "50 degC"
[source]
heat = { into = "pack", P = "220 W" }
[run]
stop = "1000 s"
"#;
    let (netlist, system) = parsed(text);
    let run = support::transient(&netlist).tolerance(1e-6).solve(&system).unwrap();
    let selection = Selection::matching(&netlist.network, &["pack.*".to_owned()]).unwrap();
    let table = Table::of_solution(&run, &selection, &netlist.temperature_unit);
    for name in ["pack.mean", "pack.min", "pack.max"] {
        close(*column(&table, name).last().unwrap(), 60.0, 1e-3);
    }
    assert!(run.ledger().closes());
}

#[test]
fn sixty_four_thousand_cells_share_one_law_and_one_capacity() {
    let text = r#"
format = 1
[grid.block]
size = ["0.2 m", "0.2 m", "0.2 m"]
cells = [40, 40, 40]
material = "steel_8620"
T0 = "20 degC"
[boundary]
air = { T = "20 degC" }
[convection]
skin = { from = "block.z1", to = "air", h = "50 W/(m^2 K)" }
"#;
    let network = parsed(text).0.network;
    let massless = |node: &&Node| node.massless;
    assert_eq!(network.nodes().len() - network.nodes().iter().filter(massless).count(), 64_000);
    // 3 x 39 x 40 x 40 between cells, 1600 to the surface, 1600 to the air
    assert_eq!(network.conductors().len(), 187_200 + 3200);
    let conductance = |id: ConductorId| match network.flow(id) {
        ConductorFlow::Conductance(g) => g,
        other => panic!("{other:?}"),
    };
    let first = network.conductor_ids().next().unwrap();
    let k = network.materials()[0].k.as_ref().unwrap().at(&mut network.evaluation()).unwrap();
    close(conductance(first), k * 0.005, 1e-14 * k);
    let mean = GridValue::Mean(network.grid_ids().next().unwrap());
    let start: Vec<f64> = network.node_ids().map(|id| network.initial(id)).collect();
    close(network.grid_value(mean, &start), 293.15, 1e-9);
}
