//! Property: every law of the crate, its derivatives by dual numbers against central differences at
//! random states, and value and derivatives finite where laws usually break.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking, in its helpers too")]

use crate::table;

use lptn_laws::{FieldDeclaration, Formula};
use lptn_units::{Dual, Scalar, parse_quantity};
use table::{INPUTS, KELVIN, Law, laws};

/// Numbers between `low` and `high`, the same in every run (linear congruence of Knuth's MMIX).
fn random(state: &mut u64, (low, high): (f64, f64)) -> f64 {
    *state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    let unit = f64::from(u32::try_from(*state >> 32).unwrap()) / f64::from(u32::MAX);
    low + (high - low) * unit
}

fn dual(law: &Law, inputs: &[f64]) -> Dual<INPUTS> {
    let variables: Vec<_> = inputs.iter().enumerate().map(|(i, &x)| Dual::variable(x, i)).collect();
    (law.dual)(&variables)
}

/// The central difference in one input, and what rounding of the law's values can have done to it.
fn difference(law: &Law, inputs: &[f64], index: usize) -> (f64, f64) {
    let at = |x: f64| {
        let mut moved = inputs.to_vec();
        moved[index] = x;
        (law.value)(&moved)
    };
    let step = 1e-5 * inputs[index].abs();
    let (low, high) = (inputs[index] - step, inputs[index] + step);
    let rounding = 8.0 * f64::EPSILON * at(high).abs() / step;
    ((at(high) - at(low)) / (high - low), rounding)
}

#[test]
fn derivatives_agree_with_central_differences() {
    let mut state = 4;
    for law in laws() {
        for regime in law.regimes {
            for _ in 0..200 {
                let inputs: Vec<_> =
                    regime.iter().map(|&range| random(&mut state, range)).collect();
                let found = dual(&law, &inputs);
                let same = (found.value - (law.value)(&inputs)).abs() <= 1e-14 * found.value.abs();
                assert!(same, "{} has two values at {inputs:?}", law.name);
                for (index, exact) in found.derivatives.into_iter().enumerate().take(inputs.len()) {
                    let (expected, rounding) = difference(&law, &inputs, index);
                    let error = (exact - expected).abs();
                    assert!(
                        error <= 1e-6 * exact.abs() + rounding,
                        "{} in input {index} at {inputs:?}: {exact} and {expected}",
                        law.name
                    );
                }
            }
        }
    }
}

#[test]
fn value_and_derivatives_are_finite_where_laws_usually_break() {
    for law in laws() {
        assert!(!law.edges.is_empty(), "{} has no edges", law.name);
        for inputs in law.edges {
            let found = dual(&law, inputs);
            assert!(found.is_finite(), "{} at {inputs:?}: {found:?}", law.name);
            let same = (found.value - (law.value)(inputs)).abs() <= 1e-14 * found.value.abs();
            assert!(same, "{} has two values at {inputs:?}", law.name);
        }
    }
}

/// Each law as it is declared, near the examples of its fields.
#[test]
fn declared_laws_have_their_derivatives() {
    let mut state = 1;
    for law in Formula::ALL {
        let fields = law.declaration().fields;
        let number = |field: &FieldDeclaration| {
            parse_quantity(field.example.trim_matches('"'), Some(field.ty)).unwrap().value
        };
        let mut left = 100;
        for _ in 0..400 {
            let inputs: Vec<f64> = fields
                .iter()
                .map(|field| number(field) * random(&mut state, (0.95, 1.05)))
                .collect();
            let ends = [random(&mut state, KELVIN), random(&mut state, KELVIN)];
            let duals: Vec<Dual<{ Formula::MOST_FIELDS }>> =
                inputs.iter().enumerate().map(|(i, x)| Dual::variable(*x, i)).collect();
            let found = law.value(&duals, ends.map(Dual::constant));
            // gears whose base circles nearly overlap curve too much, and nearer have no value
            let near = |i: usize| {
                let mut moved = inputs.clone();
                moved[i] *= 0.95;
                law.value(&moved, ends).is_nan()
            };
            if (0..inputs.len()).any(near) {
                continue;
            }
            for (i, x) in inputs.iter().enumerate() {
                let at = |factor: f64| {
                    let mut moved = inputs.clone();
                    moved[i] *= factor;
                    law.value(&moved, ends)
                };
                let by = |step: f64| (at(1.0 + step) - at(1.0 - step)) / (2.0 * step * x);
                let slope = by(1e-5);
                let error = (found.derivatives[i] - slope).abs();
                // what rounding does to a part that hardly counts in the whole, as of `difference`
                let rounding = 8.0 * f64::EPSILON * found.value.abs() / (1e-5 * x.abs());
                // the error of the difference is a third of the change by a doubled step
                let curved = (by(2e-5) - slope).abs();
                assert!(
                    error <= 1e-7 * slope.abs().max(1e-9) + rounding + curved,
                    "{} by {}",
                    law.declaration().name,
                    fields[i].key
                );
            }
            left -= 1;
            if left == 0 {
                break;
            }
        }
        assert!(left == 0, "{} has no value near its examples", law.declaration().name);
    }
}
