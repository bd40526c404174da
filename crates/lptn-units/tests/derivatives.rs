//! Derivatives by dual numbers against central differences and hand values.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking, in its helpers too")]

use lptn_units::{Dual, Expression, Program, Scalar, Scope, Symbol, Type};

struct Names;

impl Scope for Names {
    fn symbol(&self, name: &str) -> Option<Symbol> {
        let slot = ["a", "b"].iter().position(|known| *known == name)?;
        Some(Symbol { slot: u32::try_from(slot).ok()?, ty: Type::SCALAR, in_comparison: None })
    }

    fn names(&self) -> Vec<String> {
        vec!["a".to_owned(), "b".to_owned()]
    }
}

fn program(text: &str) -> Program {
    Expression::parse(text).unwrap().compile(&Names, None).unwrap()
}

fn value(program: &Program, a: f64, b: f64) -> f64 {
    program.eval(&[a, b], &mut Vec::new()).unwrap()
}

fn dual(text: &str, a: f64, b: f64) -> Dual<2> {
    let slots = [Dual::variable(a, 0), Dual::variable(b, 1)];
    program(text).eval(&slots, &mut Vec::new()).unwrap()
}

/// Numbers between `low` and `high`, the same in every run (linear congruence of Knuth's MMIX).
fn random(state: &mut u64, low: f64, high: f64) -> f64 {
    *state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    let unit = f64::from(u32::try_from(*state >> 32).unwrap()) / f64::from(u32::MAX);
    low + (high - low) * unit
}

#[test]
fn derivatives_agree_with_central_differences() {
    let laws = [
        "a + b - 2 * a * b",
        "(a - b) / (a + b)",
        "a^3 - b^-2",
        "a^(5/3) * b^0.25",
        "a^b",
        "2^a - a^1.25",
        "sqrt(a * b)",
        "exp(-a / b)",
        "ln(a + b^2)",
        "sin(a) * cos(b)",
        "tanh(a - b)",
        "abs(a - b)^1.25",
        "min(a, b, a * b)",
        "max(a, b) * mean(a, b, 3)",
        "if(a < b, a^2, b^3)",
        "0.000087*a^(5/3) + (1.2+0.01*b)*1.32*abs(b-a)^1.25 + exp(-b/300)*b",
        "-(a / 2) - -b",
        "1 / (1 / a + 1 / b)",
    ];
    let mut state = 1;
    for text in laws {
        let program = program(text);
        for _ in 0..200 {
            let (a, b) = (random(&mut state, 0.3, 4.0), random(&mut state, 0.3, 4.0));
            if (a - b).abs() < 1e-3 || (a - 1.0).abs() < 1e-3 || (b - 1.0).abs() < 1e-3 {
                continue; // kinks have a test of their own
            }
            let step = 1e-5;
            let in_a = (value(&program, a + step, b) - value(&program, a - step, b)) / (2.0 * step);
            let in_b = (value(&program, a, b + step) - value(&program, a, b - step)) / (2.0 * step);
            let found = dual(text, a, b);
            for (exact, difference) in found.derivatives.into_iter().zip([in_a, in_b]) {
                let error = (exact - difference).abs();
                assert!(
                    error < 1e-6 * (1.0 + exact.abs()),
                    "{text} at {a}, {b}: {exact} and {difference}"
                );
            }
            assert!((found.value - value(&program, a, b)).abs() <= 1e-14 * found.value.abs());
        }
    }
}

#[test]
fn derivatives_at_kinks_are_finite_and_one_sided() {
    let table = [
        ("abs(a)", 0.0, 1.0, [1.0, 0.0]),
        ("min(a, 2 * b)", 2.0, 1.0, [1.0, 0.0]),
        ("max(a, 2 * b)", 2.0, 1.0, [1.0, 0.0]),
        ("a^(5/3)", 0.0, 1.0, [0.0, 0.0]),
        ("abs(a - b)^1.25", 1.0, 1.0, [0.0, 0.0]),
        ("abs(a - b)^0.25", 1.0, 1.0, [0.0, 0.0]),
        ("b * sqrt(a)", 0.0, 3.0, [0.0, 0.0]),
        ("a^1", 0.0, 1.0, [1.0, 0.0]),
        ("a^2", 0.0, 1.0, [0.0, 0.0]),
        ("a^b", 0.0, 2.0, [0.0, 0.0]),
        ("a^b", 0.0, 1.0, [1.0, 0.0]),
        ("a^0", 0.0, 1.0, [0.0, 0.0]),
        ("a^3", -2.0, 1.0, [12.0, 0.0]),
    ];
    for (text, a, b, expected) in table {
        let found = dual(text, a, b).derivatives;
        for (exact, hand) in found.into_iter().zip(expected) {
            assert!((exact - hand).abs() < 1e-12, "{text} at {a}, {b}: {found:?}");
        }
    }
}

/// The product rule, to the bit of a sign: a derivative of 0 is +0 times any factor, and 0 where a
/// factor is infinite. Printed, -0 would look like a small negative number.
#[test]
fn a_derivative_of_zero_stays_zero() {
    let x = |value: f64| Dual::<4>::variable(value, 1);
    let bits = |dual: Dual<4>| dual.derivatives.map(f64::to_bits);
    let only = |slope: f64| [0.0, slope, 0.0, 0.0].map(f64::to_bits);
    for factor in [-3.0, 3.0, 1e300, -f64::MIN_POSITIVE] {
        assert_eq!(bits(x(-2.0) * Dual::constant(factor)), only(factor));
        assert_eq!(bits(x(-2.0).chain(1.0, factor)), only(factor));
        assert_eq!(bits(x(2.0) / Dual::constant(factor)), only(1.0 / factor));
    }
    let infinite = x(2.0) * Dual::constant(f64::INFINITY);
    assert_eq!(bits(infinite), only(f64::INFINITY));
    assert_eq!(bits(x(2.0).chain(0.0, f64::NEG_INFINITY)), only(f64::NEG_INFINITY));
}

#[test]
fn a_derivative_that_is_not_finite_is_an_error() {
    let slots = [Dual::<2>::variable(0.0, 0), Dual::variable(1.0, 1)];
    assert!(program("b / a").eval(&slots, &mut Vec::new()).is_err());
}

/// Where the power overflows, vanishes or is 1, and of small and large bases, by logarithms:
/// `ln (a x^(a - 1)) = ln a + (a - 1) ln x`.
#[test]
fn slopes_of_powers_are_right_far_away() {
    let slope = |base: f64, exponent: f64| dual(&format!("a^{exponent}"), base, 1.0).derivatives[0];
    for base in [1e-200, 1e-30, 0.3, 1.0, 7.0, 1e30, 1e200] {
        for exponent in [0.25, 0.8, 1.25, 5.0 / 3.0, -0.5] {
            let size = (exponent - 1.0) * f64::ln(base);
            if f64::max((exponent * f64::ln(base)).abs(), size.abs()) > 700.0 {
                continue; // the power or its slope is not a number of 64 bits
            }
            let (found, exact) = (slope(base, exponent), exponent * size.exp());
            // a rounding of the logarithm counts as often as it is large
            let error = (found / exact - 1.0).abs();
            assert!(error < 1e-15 * (4.0 + size.abs()), "{base}^{exponent}: {found} {exact}");
        }
    }
    // the power vanishes, its slope does not
    let found = slope(1e-200, 1.8);
    assert!((found / 1.8e-160 - 1.0).abs() < 1e-12, "{found}");
    let ends = dual("a^1.5", 0.0, 1.0).derivatives[0];
    assert_eq!(ends.to_bits(), 0.0_f64.to_bits());
}
