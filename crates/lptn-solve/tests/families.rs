//! Families of instances: chains by a rule, and one value of all.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking, in its helpers too")]

use lptn_assembly::ThermalSystem;
use lptn_network::Network;
use lptn_solve::SteadyState;

/// 24 cells of 8 W along a coolant channel, each joined to the next; NumPy solves the same balances.
const PACK: &str = r#"
format = 1
[param]
mcp = "16.72 W/K"
[default]
T0 = "25 degC"
[boundary]
supply = { T = "25 degC" }
[template.cell]
port = ["before"]
node = { body = { C = "1050 J/K" }, out = { massless = true } }
advection = { stream = { from = "before", to = "out", mcp = "mcp" } }
cooler = { plate = { from = "out", to = "body", form = "one_stream_from_is_outlet", UA = "1.8 W/K", mcp = "mcp" } }
source = { heat = { into = "body", P = "8 W" } }
[use.cell]
template = "cell"
count = 24
connect = { before = ["supply", "cell[*-1].out"] }
[resistor]
side = { from = "cell[*-1].body", to = "cell[*].body", G = "0.25 W/K" }
[advection]
back = { from = "cell[24].out", to = "supply", mcp = "mcp" }
[limit]
spread = { of = "max(cell[*].body.T) - min(cell[*].body.T)", below = "8 K" }
average = { of = "mean(cell[*].body.T)", below = "40 degC" }
heat = { of = "sum(cell[*].heat.P)", below = "200 W" }
hot = { of = "cell[*].body.T", below = "45 degC" }
"#;

fn margins(network: &Network) -> Vec<(String, f64)> {
    let system = ThermalSystem::assemble(network).unwrap();
    let steady = SteadyState::solve(&system, 0.0).unwrap();
    let margins = steady.limit_margins(network, 0.0).unwrap();
    network.limits().iter().map(|limit| limit.name.clone()).zip(margins).collect()
}

#[test]
fn a_pack_of_cells_is_that_of_its_balances() {
    let netlist = lptn_netlist::parse("pack.toml", PACK).unwrap_or_else(|e| panic!("{e}"));
    let network = &netlist.network;
    assert!(network.item("side[2]").is_ok() && network.item("side[1]").is_err());
    let found = margins(network);
    let margin = |name: &str| found.iter().find(|(known, _)| known == name).unwrap().1;
    for (name, right) in [
        ("spread", 8.0 - 10.886_352_259),
        ("average", 40.0 - 35.197_145_161),
        ("heat", 200.0 - 192.0),
        ("hot[24]", 45.0 - 40.637_116_093),
    ] {
        assert!((margin(name) - right).abs() < 1e-8, "{name}: {} {right}", margin(name));
    }
    // a limit of all is one, a limit of each is 24
    assert_eq!(found.len(), 3 + 24);
    // the flat text has every instance by its name
    let flat = netlist.expanded();
    let again = lptn_netlist::parse("flat.toml", &flat).unwrap_or_else(|e| panic!("{e}\n{flat}"));
    assert_eq!(margins(&again.network), found);
}
