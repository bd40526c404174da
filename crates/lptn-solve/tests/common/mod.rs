//! Networks of the validation set, written out.
#![allow(dead_code, unreachable_pub, clippy::unwrap_used, reason = "each test file uses a part")]

use lptn_network::{
    Conductance, End, HeatCapacity, HeatFlow, Network, NetworkBuilder, NodeId, Temperature,
};

pub const ZERO: f64 = 273.15;

/// gearbox_two_node: the seed paper's gearbox with P = 220.6 W.
pub fn gearbox() -> Network {
    let ambient = Temperature::celsius(25.5);
    let mut b = NetworkBuilder::new();
    let steel = b.node("steel", HeatCapacity(1235.0), ambient);
    let aluminium = b.node("alum", HeatCapacity(1424.0), ambient);
    let bed = b.boundary("bed", ambient);
    b.resistor("internal", steel, aluminium, Conductance(129.764_705_882_352_93));
    b.resistor("external", aluminium, bed, Conductance(3.367_938_931_297_709_7));
    b.source("q0", steel, HeatFlow(220.6));
    b.build().unwrap()
}

/// rc_ladder: eight nodes of 50 J/K joined by 4 W/K, the first to a boundary at 1 degC.
pub fn rc_ladder() -> Network {
    let mut b = NetworkBuilder::new();
    let foot = b.boundary("n0", Temperature::celsius(1.0));
    let mut last = None;
    for i in 1..=8 {
        let node = b.node(&format!("n{i}"), HeatCapacity(50.0), Temperature::celsius(0.0));
        let name = format!("e{}", i - 1);
        match last {
            None => b.resistor(&name, foot, node, Conductance(4.0)),
            Some(last) => b.resistor(&name, last, node, Conductance(4.0)),
        };
        last = Some(node);
    }
    b.build().unwrap()
}

/// msl_two_masses: two masses without a boundary.
pub fn two_masses() -> Network {
    let mut b = NetworkBuilder::new();
    let hot = b.node("mass1", HeatCapacity(15.0), Temperature(373.15));
    let cold = b.node("mass2", HeatCapacity(15.0), Temperature(273.15));
    b.resistor("e0", hot, cold, Conductance(10.0));
    b.build().unwrap()
}

/// nafems_t3: a bar of 100 cells, one end at 0 degC, the other at 100 sin(pi t / 40 s) degC.
pub fn nafems_t3() -> Network {
    let zero = Temperature::celsius(0.0);
    let mut b = NetworkBuilder::new();
    let nodes: Vec<NodeId> =
        (1..100).map(|i| b.node(&format!("n{i}"), HeatCapacity(3171.6), zero)).collect();
    let cold = b.boundary("n0", zero);
    let heat = b.expression("0 [degC] + 100 [K] * sin(pi * t / 40 [s])", None).unwrap();
    let hot = b.boundary("n100", heat);
    b.resistor("e0", cold, nodes[0], Conductance(35_000.0));
    for (i, pair) in nodes.windows(2).enumerate() {
        b.resistor(&format!("e{}", i + 1), pair[0], pair[1], Conductance(35_000.0));
    }
    b.resistor("e99", nodes[98], hot, Conductance(35_000.0));
    b.build().unwrap()
}

/// One node of capacity `c` at 20 degC with 4 W/K to a boundary.
pub fn one_node(c: f64, boundary: &str, power: &str) -> Network {
    let mut b = NetworkBuilder::new();
    let node = b.node("node", HeatCapacity(c), Temperature::celsius(20.0));
    let temperature = b.expression(boundary, None).unwrap();
    let air = b.boundary("air", temperature);
    b.resistor("skin", node, air, Conductance(4.0));
    let power = b.expression(power, None).unwrap();
    b.source("heat", node, power);
    b.build().unwrap()
}

/// Six nodes in a row, capacities over nine decades, conductances over five, 50 W into the first,
/// the last tied to a boundary at 0 degC. Its rates span 1.1e14.
pub fn stiff() -> Network {
    let zero = Temperature::celsius(0.0);
    let mut b = NetworkBuilder::new();
    let capacities = [1e3, 1e-6, 100.0, 1e-3, 10.0, 1.0];
    let conductances = [1e3, 1.0, 100.0, 0.01, 10.0, 0.5];
    let nodes: Vec<NodeId> =
        (0..6).map(|i| b.node(&format!("n{i}"), HeatCapacity(capacities[i]), zero)).collect();
    let foot = b.boundary("foot", zero);
    for (i, pair) in nodes.windows(2).enumerate() {
        b.resistor(&format!("r{i}"), pair[0], pair[1], Conductance(conductances[i]));
    }
    b.resistor("r5", nodes[5], foot, Conductance(conductances[5]));
    b.source("heat", nodes[0], HeatFlow(50.0));
    b.build().unwrap()
}

/// A network of nodes, massless nodes and boundaries as `seed` has it, in one or several parts.
pub fn random(seed: u64) -> Network {
    // the generator of Knuth's MMIX (The Art of Computer Programming 2, 3.3.4, table 1, line 26)
    let mut state = seed;
    let mut next = move |below: f64| {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        below * (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    let mut b = NetworkBuilder::new();
    let count = 2.0 + next(9.0).floor();
    let mut ends: Vec<End> = Vec::new();
    for i in 0..count as usize {
        let (c, t) = (10_f64.powf(next(5.0) - 2.0), Temperature::celsius(next(100.0)));
        ends.push(b.node(&format!("n{i}"), HeatCapacity(c), t).into());
    }
    for i in 0..next(5.0) as usize {
        ends.push(b.massless(&format!("m{i}")).into());
    }
    for i in 0..next(3.0) as usize {
        let ramp =
            b.expression(&format!("{i} [degC] + if(t < 30 [s], 0.2 [K/s], 0.1 [K/s]) * t"), None);
        ends.push(b.boundary(&format!("b{i}"), ramp.unwrap()).into());
    }
    for i in 1..ends.len() {
        // most are joined to one before; massless nodes have to be
        let before = ends[next(i as f64) as usize];
        let g = Conductance(10_f64.powf(next(5.0) - 3.0));
        if i >= count as usize || next(1.0) < 0.8 {
            b.resistor(&format!("r{i}"), ends[i], before, g);
        }
        let (a, c) = (next(ends.len() as f64) as usize, next(ends.len() as f64) as usize);
        if a != c {
            b.resistor(&format!("x{i}"), ends[a], ends[c], g);
        }
        let power = b.expression("if(t < 50 [s], 3 [W], 0.1 [W/s] * t)", None).unwrap();
        b.source(&format!("p{i}"), ends[(i - 1).min(count as usize - 1)], power);
    }
    b.build().unwrap()
}
