//! Streams and the nodes they pass.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common;

use common::{all_near, quantity, time};
use lptn_network::{Conductance, ConductorKind, HeatCapacity, NetworkBuilder, Path, Temperature};

#[test]
fn streams_that_pass_nodes() {
    let mut b = NetworkBuilder::new();
    let [x, y, z] = ["x", "y", "z"].map(|n| b.node(n, HeatCapacity(1.0), Temperature(300.0)));
    let air = b.boundary("air", Temperature(290.0));
    let rate = |text: &str| Path::stream(quantity(text));
    let mut stream = |name: &str, from: lptn_network::End, to: lptn_network::End, path: Path| {
        b.conductor(name, ConductorKind::Advection, (from, to), path);
    };
    stream("in", air.into(), x.into(), rate("5 W/K"));
    stream("on", x.into(), y.into(), rate("5 W/K"));
    stream("back", y.into(), x.into(), rate("-2 W/K"));
    let varying = time(&b, "3 [W/K/s] * t");
    b.conductor("late", ConductorKind::Advection, (y.into(), air.into()), Path::stream(varying));
    b.resistor("r", y, z, Conductance(1.0));
    let network = b.build().unwrap();
    let passing = network.passing_streams(2.0).unwrap();
    let found: Vec<_> = passing.iter().map(|p| (p.node, p.is_balanced())).collect();
    assert_eq!(found, [(x, false), (y, false)]);
    all_near(&[passing[0].inflow, passing[0].outflow], &[5.0, 7.0]);
    all_near(&[passing[1].inflow, passing[1].outflow], &[7.0, 6.0]);
    let passing = network.passing_streams(7.0 / 3.0).unwrap();
    assert!(!passing[0].is_balanced() && passing[1].is_balanced());
    let mut near_by = passing[1];
    near_by.outflow *= 1.0 + 5e-7;
    assert!(near_by.is_balanced());
    near_by.outflow *= 1.0 + 2e-6;
    assert!(!near_by.is_balanced());
}
