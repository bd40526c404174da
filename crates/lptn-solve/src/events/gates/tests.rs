//! The room of what switches, as a share of the tolerance.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use super::*;
use crate::scripted::workspace;

/// A control, a comparison of a temperature, and one of a hundredth of it.
const SWITCHES: &str = "format = 1\n[node]\nbody = { C = \"1 J/K\", T0 = \"absolute(300 [K])\" }\n\
    [boundary]\nair = { T = \"absolute(300 [K])\" }\n[control]\nfan = { sense = \"body\", \
    on_above = \"500 degC\", off_below = \"400 degC\" }\n[resistor]\nskin = { from = \"body\", \
    to = \"air\", G = \"1 [W/K] * (1 + fan)\" }\n[source]\nheat = { into = \"body\", \
    P = \"if(T > absolute(310 [K]), 1 [W], 0 [W]) + \
    if(0.01 * (T - absolute(0 [K])) > 3.2 [K], 1 [W], 0 [W])\" }\n[run]\nstop = \"1 s\"\n";

#[test]
fn a_hundredth_of_the_tolerance_is_the_room_of_what_switches() {
    let netlist = lptn_netlist::parse("gates.toml", SWITCHES).unwrap_or_else(|r| panic!("{r}"));
    let system = ThermalSystem::assemble(&netlist.network).unwrap();
    let mut work = workspace(&system);
    system.place(&mut work, &[300.0]);
    let mut gates = Gates::new(&system);
    assert_eq!((gates.count(), gates.rooms()), (3, vec![0.0; 3]));
    for tolerance in [1e-3, 1e-5] {
        gates.set_margins(&system, &mut work, tolerance).unwrap();
        let exact = [1e-2, 1e-2, 1e-4].map(|share| share * tolerance);
        for (found, exact) in gates.rooms().iter().zip(exact) {
            assert!((found / exact - 1.0).abs() < 1e-9, "{found} {exact}");
        }
    }
}
