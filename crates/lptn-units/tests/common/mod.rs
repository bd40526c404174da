//! The names that the tests of expressions use.

#![allow(dead_code, reason = "each test uses a part of this")]
#![allow(clippy::unwrap_used, reason = "a test fails by panicking, in its helpers too")]

use lptn_units::{
    Dimension, EvalError, Expression, Problems, Program, Scope, Symbol, Type, UnitError,
};

/// Name, type, value in SI, slot for comparisons.
const NAMES: [(&str, Type, f64, Option<u32>); 10] = [
    ("x", Type::SCALAR, 2.0, None),
    ("n", Type::SCALAR, 3.0, None),
    ("fan", Type::SCALAR, 0.25, None),
    ("omega", Type::of(Dimension::ANGULAR_VELOCITY), 100.0, None),
    ("torque", Type::of(Dimension::TORQUE), 5.0, None),
    ("P", Type::of(Dimension::POWER), 220.0, None),
    ("T", Type::ABSOLUTE_TEMPERATURE, 350.0, Some(10)),
    ("T_amb", Type::ABSOLUTE_TEMPERATURE, 300.0, None),
    ("steel.T", Type::ABSOLUTE_TEMPERATURE, 320.0, None),
    ("planet[1].gear.T", Type::ABSOLUTE_TEMPERATURE, 330.0, None),
];

pub(crate) struct Names;

impl Scope for Names {
    fn symbol(&self, name: &str) -> Option<Symbol> {
        let slot = NAMES.iter().position(|(known, ..)| *known == name)?;
        let (_, ty, _, in_comparison) = NAMES[slot];
        Some(Symbol { slot: u32::try_from(slot).unwrap(), ty, in_comparison })
    }

    fn names(&self) -> Vec<String> {
        NAMES.iter().map(|(name, ..)| (*name).to_owned()).collect()
    }
}

pub(crate) fn values() -> Vec<f64> {
    let mut values: Vec<f64> = NAMES.iter().map(|(_, _, value, _)| *value).collect();
    values.push(values[6]); // the frozen T
    values
}

pub(crate) fn compile(text: &str, expected: Option<Type>) -> Result<Program, Problems<UnitError>> {
    Expression::parse(text)?.compile(&Names, expected)
}

pub(crate) fn program(text: &str) -> Program {
    compile(text, None).unwrap_or_else(|errors| panic!("{text}: {errors:?}"))
}

pub(crate) fn run(text: &str) -> Result<f64, EvalError> {
    program(text).eval(&values(), &mut Vec::new())
}
