#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use super::{Content, Entering, Leaving};
use crate::interval::{NODES, POINTS};

/// Fluid that enters while the amount passed goes from one value to another, its temperature a
/// function of that amount.
fn fluid(from: f64, to: f64, of: impl Fn(f64) -> f64) -> Entering {
    let passed = NODES.map(|x| from + 0.5 * (x + 1.0) * (to - from));
    Entering { passed, temperatures: passed.map(of) }
}

fn near(found: Option<f64>, right: f64) {
    assert!((found.unwrap() - right).abs() < 1e-9, "{found:?} {right}");
}

#[test]
fn fluid_leaves_in_the_order_in_which_it_entered() {
    let mut content = Content::new(10.0, 0.0, 300.0);
    content.enter(fluid(0.0, 4.0, |x| 350.0 + x), (1e-6, true));
    near(content.leaving(4.0, false), 300.0);
    near(content.leaving(8.0, false), 300.0);
    assert!((content.next_edge(false).unwrap().passed - 10.0).abs() < 1e-12);
    content.enter(fluid(4.0, 9.0, |x| 354.0 - 2.0 * (x - 4.0)), (1e-6, true));
    // the jump stops the fluid that leaves until it has come
    near(content.leaving(12.0, false), 300.0);
    content.enter(fluid(9.0, 10.0, |_| 340.0), (1e-6, true));
    near(content.leaving(10.0, false), 350.0);
    near(content.leaving(13.0, false), 353.0);
    // the bend at 4 stops it too
    assert!((content.next_edge(false).unwrap().passed - 14.0).abs() < 1e-12);
    assert!(!content.next_edge(false).unwrap().jumps);
    assert!(content.leaving(25.0, false).is_some(), "the bend is in front of it");
}

#[test]
fn reversed_fluid_leaves_at_the_other_end() {
    let mut content = Content::new(10.0, 0.0, 300.0);
    content.enter(fluid(0.0, 6.0, |x| 350.0 + x), (1e-6, true));
    near(content.leaving(6.0, true), 356.0);
    content.enter(fluid(6.0, 2.0, |_| 280.0), (1e-6, true));
    near(content.leaving(2.0, true), 352.0);
    near(content.leaving(1.0, true), 351.0);
    // 4 of the fluid at 280 K, 4 of that at the start, 2 of that which entered first
    let sum = 4.0 * 280.0 + 4.0 * 300.0 + 2.0 * 351.0;
    assert!((content.integral(&|t| t) - sum).abs() < 1e-9);
    // it flows forwards again: first that which entered last
    content.enter(fluid(2.0, 3.0, |_| 290.0), (1e-6, true));
    near(content.leaving(3.0, false), 280.0);
}

#[test]
fn a_flow_that_is_not_even_does_not_move_marks() {
    let mut content = Content::new(1.0, 0.0, 300.0);
    let passed = NODES.map(|x| (0.5 * (x + 1.0)).powi(3));
    content.enter(Entering { passed, temperatures: passed.map(f64::cbrt) }, (1e-6, true));
    for mark in [0.001, 0.1, 0.343, 0.7, 0.99] {
        near(content.leaving(1.0 + mark, false), mark.cbrt());
    }
}

/// A step that begins a rounding after the content: fluid before the jump leaves up to it.
#[test]
fn a_jump_is_at_the_end_of_the_fluid_before_it() {
    for rounding in [-1e-13, 0.0, 1e-13] {
        let mut content = Content::new(2.0, 300.0, 340.0);
        let mut passed = NODES.map(|x| 300.5 + 0.5 * x);
        passed[0] += rounding;
        content.enter(Entering { passed, temperatures: [300.0; POINTS] }, (1e-7, true));
        assert_eq!(content.leaving(302.0 + 1e-9, false), Some(340.0));
        assert_eq!(content.next_edge(false), Some(Leaving { passed: 302.0, jumps: true }));
    }
}

/// The first step of a run may be so short that the fluid of it is thinner than marks that are the
/// same: it stays in the pipe, and the fluid before it leaves up to the jump, whichever way it flows.
#[test]
fn a_first_step_of_almost_no_fluid_keeps_the_jump() {
    for thin in [1e-13, 0.5e-10, 0.95e-10, 1.05e-10, 1.5e-10, 1.9e-10, 2.1e-10, 1e-9] {
        for sign in [1.0, -1.0] {
            let (size, reversed) = (10.0, sign < 0.0);
            let mut content = Content::new(size, 0.0, 340.0);
            for (from, to) in [(0.0, thin), (thin, 4.0), (4.0, 9.0)] {
                content.enter(fluid(sign * from, sign * to, |_| 300.0), (1e-7, true));
            }
            let edge = content.next_edge(reversed).unwrap();
            assert!((edge.passed - sign * size).abs() < 1e-12, "{thin}: {edge:?}");
            for behind in [-1.0, -1e-9, 0.0, 0.5e-10, 1e-9, 1.0] {
                let leaving = content.leaving(sign * (size + behind), reversed);
                assert_eq!(leaving, Some(340.0), "{thin} {behind}");
            }
            content.enter(fluid(sign * 9.0, sign * (size + 1e-10), |_| 300.0), (1e-7, true));
            assert_eq!(content.leaving(sign * (size + 0.01), reversed), Some(300.0), "{thin}");
        }
    }
}
