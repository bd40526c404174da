//! Temperatures outside of tables.
#![allow(
    clippy::unwrap_used,
    clippy::float_cmp,
    reason = "a test that cannot go on has failed; numbers that are given"
)]

use lptn_assembly::ThermalSystem;
use lptn_network::{Field, NetworkBuilder};

use super::*;
use crate::scripted::workspace;

/// A massless node with 2 W/K to air at 300 K and a source by a table from 20 to 120 degC of another
/// temperature, given by an expression of `T`.
fn system(of: &str) -> ThermalSystem {
    system_of(of, "1 [W/K]")
}

/// The same with a path from the joint to the body, whose table is valid from 300 to 900 K.
fn system_of(of: &str, path: &str) -> ThermalSystem {
    let text = format!(
        "format = 1\n[node]\nbody = {{ C = \"1 J/K\", T0 = \"300 K\" }}\njoint = {{ massless = true }}\n[boundary]\nair = {{ T = \
         \"300 K\" }}\n[table]\nheat = {{ x = [20, 120], x_unit = \"degC\", y = [\"5 W\", \"5 W\"] }}\ng = {{ x = [300, 900], x_unit = \"K\", y = [\"1 W/K\", \"1 W/K\"] }}\n[resistor]\npath = {{ from = \"joint\", to = \"air\", G = \"{path}\" }}\nskin = \
         {{ from = \"joint\", to = \"air\", R = \"0.5 K/W\" }}\nother = {{ from = \"body\", to = \"air\", R = \"1 K/W\" \
         }}\n[source]\nheater = {{ into = \"joint\", P = \"heat({of})\" }}\n[run]\nstop = \"1 s\"\n"
    );
    let netlist = lptn_netlist::parse("inside.toml", &text).unwrap_or_else(|r| panic!("{r}"));
    ThermalSystem::assemble(&netlist.network).unwrap()
}

#[test]
fn a_value_lacks_what_brings_it_a_twentieth_inside_its_range() {
    let fluid = |temperature: f64| {
        let item = NetworkBuilder::new().boundary("air", lptn_network::Temperature(300.0));
        lacks(&InputError {
            item: Item::Boundary(item),
            field: Field::Temperature,
            name: "air".to_owned(),
            problem: InputProblem::OutsideFluid { temperature, range: (300.0, 400.0) },
        })
    };
    let near = |found: Option<f64>, expected: f64| {
        assert!((found.unwrap() - expected).abs() < 1e-9, "{found:?} {expected}");
    };
    near(fluid(250.0), 55.0);
    near(fluid(301.0), 4.0);
    near(fluid(350.0), 0.0);
    near(fluid(450.0), -55.0);
}

/// The table is valid from 293.15 to 393.15 K; the search begins five kelvin inside.
#[test]
fn temperatures_are_brought_into_the_range_of_a_table() {
    let brought = |of: &str, from: f64| {
        let system = system(of);
        let mut newton = Newton::new(&system, vec![1]).unwrap_or_else(|_| panic!("no balances"));
        let mut temperatures = [300.0, from];
        let found = newton.bring_inside(&mut workspace(&system), &mut temperatures);
        assert!((temperatures[0] - 300.0).abs() < 1e-12, "the body is not free");
        (found, temperatures[1])
    };
    let near = |(found, at): (bool, f64), expected: f64| {
        assert!(found && (at - expected).abs() < 1e-9, "{found} {at} {expected}");
    };
    near(brought("T", 250.0), 298.15);
    near(brought("T", 450.0), 388.15);
    near(brought("T", 350.0), 350.0);
    // half as far: the first move does not suffice, then 5 K times 1.5 and so on
    let (found, at) = brought("absolute(150 [K]) + 0.5 * (T - absolute(0 [K]))", 250.0);
    assert!(found && at > 286.3 && at < 330.0, "{at}");
    // a value that moves the other way is never brought there
    assert!(!brought("absolute(0 [K]) + (absolute(600 [K]) - T) * 2", 150.0).0);
    // nor one that depends on nothing that is free
    assert!(!brought("body.T - 100 [K]", 250.0).0);
}

/// A conductance by a table moves the node at its end: 5 K, and half as much again from move to move.
#[test]
fn a_path_moves_the_node_that_it_depends_on() {
    let system = system_of("absolute(300 [K])", "g(T_mean - absolute(0 [K]))");
    let mut newton = Newton::new(&system, vec![1]).unwrap_or_else(|_| panic!("no balances"));
    let mut temperatures = [300.0, 200.0];
    assert!(newton.bring_inside(&mut workspace(&system), &mut temperatures));
    // the mean with air at 300 K lacks 50 + 30 K; that moves the mean by 40 K, to 290 K
    assert!(temperatures[1] >= 300.0 - 1e-9 && temperatures[1] < 330.0, "{temperatures:?}");
}
