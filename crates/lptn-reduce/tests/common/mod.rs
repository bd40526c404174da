//! Networks with known answers.
#![allow(
    dead_code,
    unreachable_pub,
    clippy::unwrap_used,
    reason = "each test file uses a part of it"
)]

use lptn_assembly::ThermalSystem;
use lptn_network::{
    Conductance, HeatCapacity, HeatFlow, NetworkBuilder, NodeId, Resistance, Temperature,
};

pub fn assembled(builder: NetworkBuilder) -> ThermalSystem {
    ThermalSystem::assemble(&builder.build().unwrap()).unwrap()
}

/// Steel that is heated, aluminium around it, ambient at 25.5 degC.
pub fn two_nodes(c: [f64; 2], r_int: f64, r_amb: f64, heat: f64) -> (ThermalSystem, [NodeId; 2]) {
    let ambient = Temperature::celsius(25.5);
    let mut b = NetworkBuilder::new();
    let steel = b.node("steel", HeatCapacity(c[0]), ambient);
    let aluminium = b.node("aluminium", HeatCapacity(c[1]), ambient);
    let bed = b.boundary("bed", ambient);
    b.resistor("internal", steel, aluminium, Resistance(r_int));
    b.resistor("outer", aluminium, bed, Resistance(r_amb));
    b.source("P_disp", steel, HeatFlow(heat));
    (assembled(b), [steel, aluminium])
}

/// `n` cells between a boundary before the first one and the last one, which is the port.
pub fn chain(capacity: &[f64], conductance: &[f64]) -> (ThermalSystem, Vec<NodeId>) {
    let zero = Temperature::celsius(0.0);
    let mut b = NetworkBuilder::new();
    let nodes: Vec<NodeId> = capacity
        .iter()
        .enumerate()
        .map(|(i, &c)| b.node(&format!("n{i}"), HeatCapacity(c), zero))
        .collect();
    let end = b.boundary("end", zero);
    b.resistor("g0", end, nodes[0], Conductance(conductance[0]));
    for i in 1..nodes.len() {
        b.resistor(&format!("g{i}"), nodes[i - 1], nodes[i], Conductance(conductance[i]));
    }
    (assembled(b), nodes)
}

#[track_caller]
pub fn near(found: f64, expected: f64, relative: f64) {
    assert!((found - expected).abs() <= relative * expected.abs(), "{found:?} is not {expected:?}");
}
