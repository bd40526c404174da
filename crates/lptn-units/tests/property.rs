//! Properties that hold for any input.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking, in its helpers too")]

use std::sync::Arc;

use lptn_units::{
    Dimension, Expression, Interpolation, LookupTable, Outside, Rational, Scope, Symbol, Table1,
    TableSymbol, Type, Unit, format_number, parse_quantity, parse_value, suggest,
};
use proptest::prelude::*;
use proptest::test_runner::{Config, RngSeed};

fn config() -> Config {
    Config {
        cases: 512,
        failure_persistence: None,
        rng_seed: RngSeed::Fixed(20_240_501),
        ..Config::default()
    }
}

struct Nothing;

impl Scope for Nothing {
    fn symbol(&self, name: &str) -> Option<Symbol> {
        (name == "x").then_some(Symbol { slot: 0, ty: Type::SCALAR, in_comparison: None })
    }

    fn names(&self) -> Vec<String> {
        vec!["x".to_owned()]
    }

    fn table(&self, name: &str) -> Option<TableSymbol> {
        let points =
            Table1::new(vec![0.0, 1.0], vec![0.0, 1.0], Interpolation::Linear, Outside::Error)
                .unwrap();
        let table = Arc::new(LookupTable::One(points));
        (name == "loss").then_some(TableSymbol {
            table,
            arguments: vec![Type::SCALAR],
            ty: Type::SCALAR,
            units: Vec::new(),
        })
    }

    fn table_names(&self) -> Vec<String> {
        vec!["loss".to_owned()]
    }
}

fn rational() -> impl Strategy<Value = Rational> {
    (-6_i32..=6, 1_i32..=4).prop_map(|(num, den)| Rational::new(num, den).unwrap())
}

fn dimension() -> impl Strategy<Value = Dimension> {
    let base = [
        Dimension::LENGTH,
        Dimension::MASS,
        Dimension::TIME,
        Dimension::TEMPERATURE,
        Dimension::CURRENT,
        Dimension::ANGLE,
    ];
    proptest::collection::vec(rational(), 6).prop_map(move |exponents| {
        let powers = base.iter().zip(exponents).map(|(d, e)| d.checked_pow(e).unwrap());
        powers.fold(Dimension::NONE, |product, d| product.checked_mul(d).unwrap())
    })
}

/// Text with many of the characters that mean something.
fn soup() -> impl Strategy<Value = String> {
    let piece = prop_oneof![
        Just("W"),
        Just("m^2"),
        Just("K"),
        Just("degC"),
        Just("/"),
        Just("*"),
        Just("("),
        Just(")"),
        Just("["),
        Just("]"),
        Just("^"),
        Just("5/3"),
        Just("1e5"),
        Just("-"),
        Just("+"),
        Just("±"),
        Just("%"),
        Just(" "),
        Just("x"),
        Just("if("),
        Just("loss("),
        Just("loss"),
        Just(","),
        Just("<"),
        Just("µ"),
        Just("²"),
        Just("°"),
        Just("."),
        Just("_"),
        Just("2"),
        Just("max"),
        Just("\u{2212}"),
        Just("nan"),
        Just("a.b[1]"),
    ];
    proptest::collection::vec(piece, 0..14).prop_map(|pieces| pieces.concat())
}

fn read_everything(text: &str) {
    for expected in [None, Some(Type::ABSOLUTE_TEMPERATURE), Some(Type::of(Dimension::POWER))] {
        let spans: Vec<_> = [
            parse_quantity(text, expected).err(),
            parse_value(text, expected, &|name| name == "x").err(),
            Unit::parse(text).err(),
            Expression::parse(text).err(),
        ]
        .into_iter()
        .flatten()
        .chain(compile_errors(text, expected))
        .collect();
        for error in spans {
            assert!(
                text.get(error.span.clone()).is_some(),
                "{text:?}: {:?} is not a part",
                error.span
            );
            assert!(!error.to_string().is_empty() && error.code().starts_with("units::"));
            let _ = error.help();
        }
    }
}

fn compile_errors(text: &str, expected: Option<Type>) -> Vec<lptn_units::UnitError> {
    let Ok(expression) = Expression::parse(text) else { return Vec::new() };
    let _ = (expression.names(), expression.split_comparison());
    match expression.compile(&Nothing, expected) {
        Ok(program) => {
            let _ = (
                program.eval(&[0.5], &mut Vec::new()),
                program.degree_in(0),
                program.kinks(),
                program.table_calls(),
            );
            Vec::new()
        }
        Err(errors) => errors.0,
    }
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn any_text_gives_a_value_or_an_error(text in "\\PC{0,40}") {
        read_everything(&text);
    }

    #[test]
    fn any_meaningful_text_gives_a_value_or_an_error(text in soup()) {
        read_everything(&text);
    }

    #[test]
    fn numbers_are_read_back_to_the_bit(value in proptest::num::f64::NORMAL | proptest::num::f64::ZERO) {
        let quantity = parse_quantity(&format!("{} W", format_number(value)), None).unwrap();
        prop_assert_eq!(quantity.value.to_bits(), value.to_bits());
    }

    #[test]
    fn the_unit_of_a_dimension_reads_back(dimension in dimension()) {
        for text in [dimension.si_unit(), dimension.to_string()] {
            let unit = Unit::parse(&text).unwrap();
            prop_assert_eq!(unit.ty, Type::of(dimension), "{}", text);
            prop_assert!((unit.scale - 1.0).abs() < 1e-15);
        }
    }

    #[test]
    fn dimensions_are_a_group(a in dimension(), b in dimension(), c in dimension(), r in rational()) {
        let product = |x: Dimension, y: Dimension| x.checked_mul(y).unwrap();
        prop_assert_eq!(product(a, b), product(b, a));
        prop_assert_eq!(product(product(a, b), c), product(a, product(b, c)));
        prop_assert_eq!(product(a, Dimension::NONE), a);
        prop_assert_eq!(product(a, b).checked_div(b), Some(a));
        prop_assert_eq!(a.checked_div(a), Some(Dimension::NONE));
        let power = |x: Dimension| x.checked_pow(r).unwrap();
        prop_assert_eq!(power(product(a, b)), product(power(a), power(b)));
    }

    #[test]
    fn a_suggestion_is_one_of_the_candidates(name in "[a-c]{0,6}", others in proptest::collection::vec("[a-c]{0,6}", 0..5)) {
        let found = suggest(&name, others.iter().map(String::as_str));
        prop_assert!(found.is_none_or(|found| others.iter().any(|other| other == found) && found != name));
    }
}
