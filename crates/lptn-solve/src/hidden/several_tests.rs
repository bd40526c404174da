//! Features between the points, in results of several temperatures.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use lptn_assembly::ThermalSystem;
use lptn_network::Item;

use super::*;
use crate::interval::NODES;
use crate::reading::Reading;

/// Hidden share in an interval in which two temperatures move by `halves` in K to both sides of 400
/// K, after two other curves; the eighth powers of both are reported.
fn wanting(halves: [f64; 2]) -> f64 {
    let power = |node: &str| format!("(kelvin({node}.T) / 1 [K])^8");
    let text = format!(
        "format = 1\n[node]\na = {{ C = \"1 J/K\", T0 = \"absolute(400 [K])\" }}\nb = {{ C = \"1 \
         J/K\", T0 = \
         \"absolute(400 [K])\" }}\n[boundary]\nair = {{ T = \"absolute(300 [K])\" \
         }}\n[resistor]\nskin = {{ from = \
         \"a\", to = \"air\", R = \"1 K/W\" }}\nlead = {{ from = \"a\", to = \"b\", R = \"1 \
         K/W\" }}\n[run]\nstop = \"1 \
         s\"\nreport = {{ first = \"{}\", second = \"{}\" }}\n",
        power("a"),
        power("b")
    );
    let netlist = lptn_netlist::parse("several.toml", &text).unwrap_or_else(|r| panic!("{r}"));
    let network = &netlist.network;
    let bends = network.bends(network.report_ids().map(Item::Report));
    let system = ThermalSystem::assemble(network).unwrap();
    let mut reading = Reading::new(&system);
    reading.place(&mut system.workspace(), (0.0, 0.0)).unwrap();
    let slots = bends.slots(&mut reading.scope);
    assert_eq!((bends.moved(), bends.levels().len()), (2, 0));
    let values =
        NODES.map(|x| vec![7e5 * x.powi(3), 9.0, 400.0 + halves[0] * x, 400.0 + halves[1] * x]);
    Hidden::new((&bends, &slots), 2).wanting(&Interval { from: 0.0, to: 1.0, values })
}

/// `8 (400 + b) b^7` over seven points of the size `(400 + b)^8`.
#[test]
fn the_temperature_that_moves_furthest_tells_what_may_be_missed() {
    let exact = |b: f64| 0.05 * 8.0 * b.powi(7) / (1e-7 * (400.0 + b).powi(7));
    for (halves, most) in [([100.0, 1.0], 100.0), ([1.0, 80.0], 80.0), ([90.0, 120.0], 120.0)] {
        let found = wanting(halves);
        assert!((found / exact(most) - 1.0).abs() < 1e-6, "{halves:?}: {found} {}", exact(most));
    }
    assert!(wanting([1.0, 1.0]) <= 0.0);
}
