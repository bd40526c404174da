//! Exact sensitivities against the closed form of one node, and where there is nothing to
//! differentiate.

#![allow(clippy::unwrap_used, reason = "what fails here fails the test")]

use crate::support;

use lptn::prelude::*;
use lptn_network::ParameterId;
use support::{parsed, transient};

#[test]
fn regression_a_network_without_nodes_has_no_sensitivities_and_no_fault() {
    let (netlist, system) = support::shipped("hot_pipe.toml");
    let ids: Vec<ParameterId> = netlist.network.parameter_ids().collect();
    let run = Transient::until(Time(60.0)).sensitivities(&ids).solve(&system).unwrap();
    assert!(run.recorded().is_empty());
}

/// One node: T = T_a + P R (1 - exp(-t / (R C))) + (T_0 - T_a) exp(-t / (R C)).
#[test]
fn one_node_by_its_closed_form() {
    let text = "format = 1
[param]
P = \"220.6 W\"
R = \"0.3046 K/W\"
C = \"2659 J/K\"
T_a = \"25.5 degC\"
T_0 = \"30 degC\"
[boundary]
air = { T = \"T_a\" }
[node]
box = { T0 = \"T_0\", C = \"C\" }
[resistor]
out = { from = \"box\", to = \"air\", R = \"R\" }
[source]
heat = { into = \"box\", P = \"P\" }
[run]
stop = \"25 min\"
output = { every = \"1 min\" }
";
    let (netlist, system) = parsed(text);
    let ids: Vec<ParameterId> = netlist.network.parameter_ids().collect();
    let solution = transient(&netlist).tolerance(1e-7).sensitivities(&ids).solve(&system).unwrap();
    let (p, r, c, start) = (220.6, 0.3046, 2659.0, 4.5);
    let node = netlist.network.node("box").unwrap();
    let found: Vec<Vec<f64>> =
        ids.iter().map(|&id| solution.sensitivity(id, node).unwrap()).collect();
    for (row, &t) in solution.times().iter().enumerate() {
        let x = t / (r * c);
        let e = (-x).exp();
        let exact = [
            r * (1.0 - e),
            p * (1.0 - e) - p * r * e * x / r + start * e * x / r,
            -p * r * e * x / c + start * e * x / c,
            1.0 - e,
            e,
        ];
        let sizes = [p, r, c, 10.0, 10.0];
        for k in 0..5 {
            let error = (found[k][row] - exact[k]).abs() * sizes[k];
            assert!(
                error < 1e-6,
                "parameter {k}, row {row}: {} is not {}",
                found[k][row],
                exact[k]
            );
        }
    }
}
