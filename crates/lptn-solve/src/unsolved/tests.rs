//! Balances that could not be solved name their node, and the elements that read it.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use lptn_network::{Field, InputProblem, NetworkBuilder, Temperature};

use super::*;
use crate::scripted::bodies;

fn input(name: &str) -> InputError {
    let boundary = NetworkBuilder::new().boundary(name, Temperature(300.0));
    let problem = InputProblem::OutsideFluid { temperature: 200.0, range: (300.0, 400.0) };
    let (item, field, name) = (Item::Boundary(boundary), Field::Temperature, name.to_owned());
    InputError { item, field, name, problem }
}

#[test]
fn the_node_at_which_a_search_failed_is_named() {
    let network = bodies(&[(1.0, "1 [W]"), (1.0, "1 [W]")], None);
    let system = ThermalSystem::assemble(&network).unwrap();
    let name = |error| Unsolved::new(&system, error).node().to_owned();
    assert_eq!(name(NewtonError::Unstable { unknown: 1, swings: true }), "n1");
    assert_eq!(name(NewtonError::Fold { unknown: 0 }), "n0");
    assert_eq!(name(NewtonError::Stalled { unknown: 1, change: 2.0 }), "n1");
    assert_eq!(name(NewtonError::Singular { unknown: 0 }), "n0");
    assert_eq!(name(NewtonError::Input(input("air"))), "air");
    // empty if it is not known
    assert_eq!(name(NewtonError::Factorization(FactorError::Singular { index: 0 })), "");
    assert_eq!(name(NewtonError::Fold { unknown: 7 }), "");
}

#[test]
fn a_value_that_failed_is_handed_over_where_it_is_the_reason() {
    let network = bodies(&[(1.0, "1 [W]")], None);
    let system = ThermalSystem::assemble(&network).unwrap();
    let failed = Unsolved::new(&system, NewtonError::Input(input("air")));
    assert_eq!(failed.input().unwrap().name, "air");
    assert!(Unsolved::new(&system, NewtonError::Fold { unknown: 0 }).input().is_none());
}

/// A source into the node itself, or a path that ends there, is connected to it.
#[test]
fn what_reads_a_node_without_being_connected_to_it_is_named() {
    let reads = |node: &str| format!("1 [W/K] * ({node}.T - absolute(300 [K]))");
    let (own, other) = (reads("n0"), reads("n0"));
    let heats = [(1.0, &own[..]), (1.0, &other[..]), (1.0, "1 [W]")];
    let system = ThermalSystem::assemble(&bodies(&heats, None)).unwrap();
    assert_eq!(reader(&system, 0).as_deref(), Some("q1"));
    assert_eq!([1, 2, 9].map(|unknown| reader(&system, unknown)), [None, None, None]);
    let heats = [(1.0, "1 [W]"); 3];
    let far = "1 [W/K] + 0.1 [W/K^2] * (n2.T - absolute(300 [K]))";
    let system = ThermalSystem::assemble(&bodies(&heats, Some(far))).unwrap();
    assert_eq!(reader(&system, 2).as_deref(), Some("joined"));
    assert_eq!(reader(&system, 0), None);
    let near = "1 [W/K] + 0.1 [W/K^2] * (T_mean - absolute(300 [K]))";
    let system = ThermalSystem::assemble(&bodies(&heats, Some(near))).unwrap();
    assert_eq!([0, 1].map(|unknown| reader(&system, unknown)), [None, None]);
}
