//! The room of everything that switches, as a share of the tolerance.
#![allow(
    clippy::unwrap_used,
    clippy::float_cmp,
    reason = "a test that cannot go on has failed; numbers that are given"
)]

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

/// A fan and a heater, each with its own body.
fn thermostats(more: &str) -> ThermalSystem {
    let text = format!(
        "format = 1\n[node]\nengine = {{ C = \"1 J/K\", T0 = \"320 K\" }}\ncabin = {{ C = \"2 J/K\", \
         T0 = \"290 K\" }}\nskin = {{ massless = true }}\n[boundary]\nair = {{ T = \"absolute(300 [K])\" }}\n\
         [resistor]\na = {{ from = \"engine\", to = \"air\", G = \"1 [W/K] * (1 + fan)\" }}\n\
         b = {{ from = \"cabin\", to = \"skin\", G = \"1 W/K\" }}\n\
         c = {{ from = \"skin\", to = \"air\", G = \"1 W/K\" }}\n\
         [source]\nheat = {{ into = \"cabin\", P = \"5 [W] * heater\" }}\n[control]\n\
         fan = {{ sense = \"engine\", on_above = \"350 K\", off_below = \"340 K\" }}\n\
         heater = {{ sense = \"cabin\", on_below = \"285 K\", off_above = \"295 K\" }}\n{more}\
         [run]\nstop = \"1 s\"\n"
    );
    let netlist = lptn_netlist::parse("gates.toml", &text).unwrap_or_else(|r| panic!("{r}"));
    ThermalSystem::assemble(&netlist.network).unwrap()
}

/// The temperatures of the states give the same as the network does, on and off, armed or waiting.
#[test]
fn plain_thermostats_are_read_from_the_states() {
    let system = thermostats("");
    let mut gates = Gates::new(&system);
    assert!(gates.are_plain());
    for on in [[false, false], [true, false], [false, true], [true, true]] {
        for armed in [[true, true], [false, true], [true, false]] {
            gates.armed = armed.to_vec();
            let mut work = workspace(&system);
            let positions = Positions { controls: on.to_vec(), switches: Vec::new() };
            work.set_positions(&positions);
            for y in [[330.0, 280.0], [345.0, 290.0], [360.0, 300.0]] {
                let (mut plain, mut asked) = ([f64::NAN; 2], [f64::NAN; 2]);
                gates.plain_excess(&positions, &y, &mut plain);
                system.read_inputs(&mut work, 0.0, 0.0).unwrap();
                system.place(&mut work, &y);
                gates.excess(&system, &mut work, &mut asked).unwrap();
                assert_eq!(plain, asked, "{on:?} {armed:?} {y:?}");
            }
        }
    }
    // by hand: a fan that is off 10 K below its threshold, a heater that is on 5 K below its own
    gates.armed = vec![true; 2];
    let mut excess = [f64::NAN; 2];
    let positions = Positions { controls: vec![false, true], switches: Vec::new() };
    gates.plain_excess(&positions, &[340.0, 290.0], &mut excess);
    assert_eq!(excess, [-10.0, -5.0]);
}

#[test]
fn thresholds_that_vary_massless_senses_and_comparisons_are_not_plain() {
    let third = |sense: &str, on: &str| {
        format!("third = {{ sense = \"{sense}\", on_above = \"{on}\", off_below = \"310 K\" }}\n")
    };
    let plain = |more: &str| Gates::new(&thermostats(more)).are_plain();
    assert!(plain(&third("engine", "400 K")));
    assert!(!plain(&third("skin", "400 K")), "a massless node");
    assert!(!plain(&third("air", "400 K")), "a boundary");
    assert!(!plain(&third("engine", "absolute(400 [K]) + 1 [K/s] * t")), "a threshold that moves");
    let compared = "[source.more]\ninto = \"engine\"\nP = \"if(T > 330 [K], 1 [W], 2 [W])\"\n";
    let compared = compared.replace("330 [K]", "absolute(330 [K])");
    assert!(!plain(&compared), "a comparison of temperatures");
}
