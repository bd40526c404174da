//! Rates of temperatures at states, by hand.
#![allow(
    clippy::unwrap_used,
    clippy::float_cmp,
    reason = "a test that cannot go on has failed; numbers that are given"
)]

use lptn_assembly::ThermalSystem;

use super::*;
use crate::balance::Books;
use crate::scripted::bodies;

/// A body of 400 J/K at 310 K with 30 W loses 2 W/K to air at 300 K and 3 W/K to one of 50 J/K at
/// 305 K, which loses 2 W/K and has its own 1 W.
#[test]
fn rates_are_heats_over_capacities() {
    let network = bodies(&[(400.0, "30 [W]"), (50.0, "1 [W]")], Some("3 [W/K]"));
    let system = ThermalSystem::assemble(&network).unwrap();
    let mut heat = Heat::new(&system, 0.0, Books::new(system.network(), None))
        .unwrap_or_else(|_| panic!("no heat"));
    let mut rates = [0.0; 3];
    heat.rates(0.0, &[310.0, 305.0], &mut rates);
    let exact = [(30.0 - 20.0 - 15.0) / 400.0, (1.0 - 10.0 + 15.0) / 50.0, 0.0];
    assert!(rates.iter().zip(exact).all(|(a, b)| (a - b).abs() < 1e-12), "{rates:?}");
}

/// If a body carries its heat content, the rate is that of its temperature: 100 J/K at 300 K, half
/// of it at 350 K.
#[test]
fn the_rate_of_a_body_whose_capacity_falls_is_that_of_its_temperature() {
    let text = "format = 1\n[table]\nfactor = { x = [200, 300, 400], x_unit = \"K\", y = [1, 1, \
        0.0001], outside = \
                \"hold\" }\n[node]\nbody = { C = \"100 [J/K] * factor(T - absolute(0 [K]))\", T0 \
                = \"absolute(300 [K])\" }\n[boundary]\nair \
                = { T = \"absolute(300 [K])\" }\n[resistor]\nskin = { from = \"body\", to = \
                \"air\", R = \"0.5 K/W\" \
                }\n[run]\nstop = \"1 s\"\n";
    let netlist = lptn_netlist::parse("falls.toml", text).unwrap_or_else(|r| panic!("{r}"));
    let system = ThermalSystem::assemble(&netlist.network).unwrap();
    let mut heat = Heat::new(&system, 0.0, Books::new(system.network(), None))
        .unwrap_or_else(|_| panic!("no heat"));
    let mut rates = [0.0; 2];
    // 3750 J more than at 300 K, 100 W are lost
    heat.rates(0.0, &[337.5], &mut rates);
    assert!((rates[0] + 2.0).abs() < 5e-3 && rates[1] == 0.0, "{rates:?}");
}
