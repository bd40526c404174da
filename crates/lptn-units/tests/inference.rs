//! Names of unknown dimension take the one that the rest of an expression leaves them.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking, in its helpers too")]

use lptn_units::{Dimension, Expression, Scope, Symbol, Type, Unit};

/// A rotation `omega` and nothing else.
struct Speed;

impl Scope for Speed {
    fn symbol(&self, name: &str) -> Option<Symbol> {
        let ty = Type::of(Dimension::ANGULAR_VELOCITY);
        (name == "omega").then_some(Symbol { slot: 0, ty, in_comparison: None })
    }

    fn names(&self) -> Vec<String> {
        vec!["omega".to_owned()]
    }
}

/// The unknown names of a power with the unit each must have, `?` where it is open.
fn units(text: &str) -> Vec<(String, String)> {
    let found = Expression::parse(text).unwrap().unknown_names(&Speed, Type::of(Dimension::POWER));
    let unit = |dimension: Option<Dimension>| dimension.map_or("?".to_owned(), |d| d.si_unit());
    found.into_iter().map(|(name, dimension)| (name, unit(dimension))).collect()
}

#[track_caller]
fn check(text: &str, expected: &[(&str, &str)]) {
    let found = units(text);
    assert_eq!(found.len(), expected.len(), "{text}: {found:?}");
    for ((name, unit), (wanted_name, wanted)) in found.iter().zip(expected) {
        assert_eq!(name, wanted_name, "{text}");
        let same =
            *wanted == "?" || Unit::parse(unit).unwrap().ty == Unit::parse(wanted).unwrap().ty;
        assert!(
            same && (unit == "?") == (*wanted == "?"),
            "{text}: {name} is {unit}, not {wanted}"
        );
    }
}

#[test]
fn coefficients_of_sums_and_products() {
    check("a * omega + b * omega^3", &[("a", "W/rpm"), ("b", "W/rpm^3")]);
    check("alpha * omega^(5/3)", &[("alpha", "W/rpm^(5/3)")]);
    check("-(P0 - omega * a)", &[("P0", "W"), ("a", "W/rpm")]);
    check("P0 / (1 + omega / w0)", &[("P0", "W"), ("w0", "rpm")]);
    check("omega^2 / c", &[("c", "rpm^2/W")]);
    check("3 [W/K] * dT0", &[("dT0", "K")]);
}

#[test]
fn exponents_and_arguments_are_plain_numbers() {
    check("a * (omega / 1 [rpm])^n", &[("a", "W"), ("n", "1")]);
    check("a * exp(-omega / w0)", &[("a", "W"), ("w0", "rpm")]);
    check("sqrt(a * omega)", &[("a", "W^2/rpm")]);
    check("(a * omega)^(5/3)", &[("a", "W^(3/5)/rpm")]);
    check("if(omega > w0, a, b * omega)", &[("w0", "rpm"), ("a", "W"), ("b", "W/rpm")]);
    check("max(a, omega * b) + abs(c)", &[("a", "W"), ("b", "W/rpm"), ("c", "W")]);
}

#[test]
fn what_one_term_settles_helps_the_next() {
    check("a + b * omega * (1 + a / c)", &[("a", "W"), ("b", "W/rpm"), ("c", "W")]);
}

#[test]
fn what_is_open_stays_open() {
    check("a * b", &[("a", "?"), ("b", "?")]);
    check("a * omega^n", &[("a", "?"), ("n", "1")]);
}

#[test]
fn known_names_and_pi_are_not_among_them() {
    check("2 * pi * omega * 1 [N m]", &[]);
}
