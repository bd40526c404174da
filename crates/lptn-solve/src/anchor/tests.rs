//! Starting points of evaluations.
#![allow(
    clippy::unwrap_used,
    clippy::float_cmp,
    reason = "a test that cannot go on has failed; numbers that are given"
)]

use lptn_assembly::ThermalSystem;

use super::*;
use crate::scripted::{bodies, workspace};

/// Keeps a massless node among the unknowns: constant conductances alone are reduced.
const OWN: &str = "-1 [W/K] * (T - absolute(300 [K]))";

/// A body of 100 J/K joined to a massless node by 2 W/K.
fn with<T>(heat: &str, then: impl FnOnce(&ThermalSystem) -> T) -> T {
    let network = bodies(&[(100.0, "1 [W]"), (0.0, heat)], Some("2 [W/K]"));
    then(&ThermalSystem::assemble(&network).unwrap())
}

#[test]
fn a_look_begins_on_the_line_between_what_is_known_before_and_after() {
    with(OWN, |system| {
        let mut unfold = Unfold::new(system).unwrap_or_else(|_| panic!("no balances"));
        let mut anchor = Anchor::default();
        let mut begins = |anchor: &Anchor, time: f64| {
            unfold.seed(&[-1.0]);
            anchor.begin(time, &mut unfold);
            unfold.algebraic()[0]
        };
        assert_eq!(begins(&anchor, 1.0), -1.0);
        anchor.stand(1.0, &[300.0]);
        anchor.add(3.0, &[310.0]);
        anchor.add(7.0, &[306.0]);
        let found = [0.0, 1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 7.0, 9.0].map(|time| begins(&anchor, time));
        assert_eq!(found, [300.0, 300.0, 302.5, 305.0, 310.0, 309.0, 307.0, 306.0, 306.0]);
        anchor.go_on(8.0);
        anchor.add(10.0, &[308.0]);
        assert_eq!([6.0, 8.0, 9.0].map(|time| begins(&anchor, time)), [306.0, 306.0, 307.0]);
        anchor.stand(8.0, &[320.0]);
        assert_eq!([7.0, 9.0].map(|time| begins(&anchor, time)), [320.0, 320.0]);
    });
}

/// With several solutions between two it begins at the one before.
#[test]
fn a_look_at_one_of_several_solutions_begins_at_the_one_before() {
    with("100 [W] * tanh((T - absolute(340 [K])) / 2 [K])", |system| {
        let mut unfold = Unfold::new(system).unwrap_or_else(|_| panic!("no balances"));
        assert!(unfold.is_guarded());
        let mut anchor = Anchor::default();
        anchor.stand(1.0, &[300.0]);
        anchor.add(3.0, &[310.0]);
        let found = [1.5, 2.9, 3.0].map(|time| {
            anchor.begin(time, &mut unfold);
            unfold.algebraic()[0]
        });
        assert_eq!(found, [300.0, 300.0, 310.0]);
    });
}

/// The massless node is balanced by 2 + 2 + 1 W/K. A correction from 320 K next to 300 K uses
/// factors of this matrix, or of twice as much.
#[test]
fn a_look_leans_on_the_matrix_that_it_was_given() {
    with(OWN, |system| {
        let mut newton = Newton::new(system, vec![1]).unwrap_or_else(|_| panic!("no balances"));
        let mut work = workspace(system);
        assert!(newton.matrix().is_empty());
        newton.factorize(&mut work, &[300.0, 320.0], 0.0).unwrap_or_else(|_| panic!("singular"));
        let own = newton.matrix().to_vec();
        assert_eq!(own.iter().map(|value| value.abs()).collect::<Vec<f64>>(), [5.0]);
        let moved = |newton: &mut Newton<'_>| {
            let found = newton.correction(&mut workspace(system), &[300.0, 320.0]);
            found.unwrap_or_else(|_| panic!("no residual"))[0]
        };
        assert!((moved(&mut newton) + 20.0).abs() < 1e-9);
        newton.lean_on(&[2.0 * own[0]]);
        assert!((moved(&mut newton) + 20.0).abs() < 1e-9, "only a look leans");
        newton.lean();
        assert!(newton.ready && (moved(&mut newton) + 10.0).abs() < 1e-9);
        // the same again changes nothing
        newton.lean_on(&[2.0 * own[0]]);
        assert!(newton.leans);
        newton.lean_on_itself();
        assert_eq!(newton.base, [2.0 * own[0]]);
        // after it has solved on its own way
        newton.factorize(&mut work, &[300.0, 320.0], 0.0).unwrap_or_else(|_| panic!("singular"));
        newton.leans = false;
        newton.lean_on_itself();
        assert!(newton.leans && newton.base == own);
        // nothing to lean on
        newton.lean_on(&[]);
        assert!(!newton.leans);
        newton.lean();
        assert!(!newton.ready && newton.matrix().is_empty() && newton.leans);
        // and a matrix that cannot be factorised counts as none
        newton.lean_on(&[0.0]);
        newton.lean();
        assert!(!newton.ready);
    });
}
