//! Solution of a massless node at 2 + 2 + 1 W/K, and its matrix.
#![allow(
    clippy::unwrap_used,
    clippy::float_cmp,
    reason = "a test that cannot go on has failed; numbers that are given"
)]

use lptn_assembly::ThermalSystem;

use super::*;
use crate::balance::Books;
use crate::heat::Heat;
use crate::scripted::{bodies, workspace};

fn system() -> ThermalSystem {
    let own = "-1 [W/K] * (T - absolute(300 [K]))";
    let network = bodies(&[(100.0, "1 [W]"), (0.0, own)], Some("2 [W/K]"));
    ThermalSystem::assemble(&network).unwrap()
}

#[test]
fn a_massless_node_is_apart_by_more_than_a_millionth_of_a_kelvin() {
    let system = system();
    let mut unfold = Unfold::new(&system).unwrap_or_else(|_| panic!("none"));
    unfold.seed(&[310.0]);
    let apart = [0.0, 0.9e-6, -0.9e-6, 1.1e-6, -1.1e-6].map(|by| unfold.is_apart(&[310.0 + by]));
    assert_eq!(apart, [false, false, false, true, true]);
}

/// The body at 305 K draws it to 302 K.
#[test]
fn looks_lean_on_the_matrix_of_the_massless_nodes() {
    let system = system();
    let mut unfold = Unfold::new(&system).unwrap_or_else(|_| panic!("none"));
    let mut work = workspace(&system);
    assert!(unfold.matrix().is_empty());
    let found = unfold.temperatures(&mut work, &[305.0]).unwrap_or_else(|_| panic!("none"));
    assert!((found[1] - 302.0).abs() < 1e-9, "{found:?}");
    let own = unfold.matrix().to_vec();
    assert!(own.len() == 1 && own[0].abs() == 5.0, "{own:?}");
    let base = |unfold: &Unfold<'_>| {
        let newton = unfold.algebraic.as_ref().unwrap();
        (newton.base.clone(), newton.leans)
    };
    unfold.lean_on(&[9.0]);
    assert_eq!(base(&unfold), (vec![9.0], false));
    unfold.lean();
    assert_eq!(base(&unfold), (vec![9.0], true));
    unfold.algebraic.as_mut().unwrap().leans = false;
    unfold.lean_on_itself();
    assert_eq!(base(&unfold), (own.clone(), true));
    // the same in a system as the integrator sees it
    let heat = Heat::new(&system, 0.0, Books::new(system.network(), None));
    let mut heat = heat.unwrap_or_else(|_| panic!("none"));
    assert!(heat.matrix().is_empty());
    heat.look(0.0, &[305.0]).unwrap();
    assert_eq!(heat.matrix(), own);
    assert!((heat.algebraic()[0] - 302.0).abs() < 1e-9);
}
