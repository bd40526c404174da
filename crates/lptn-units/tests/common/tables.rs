//! The names and tables that the tests of calls use.

#![allow(dead_code, reason = "each test uses a part of this")]
#![allow(clippy::unwrap_used, reason = "a test fails by panicking, in its helpers too")]

use std::sync::Arc;

use lptn_units::{
    Dimension, EvalError, Expression, Interpolation, LookupTable, Outside, Problems, Program,
    Scope, Symbol, Table1, Table2, TableSymbol, Type, UnitError,
};

pub(crate) const SPEED: Type = Type::of(Dimension::ANGULAR_VELOCITY);
pub(crate) const TORQUE: Type = Type::of(Dimension::ENERGY);
pub(crate) const POWER: Type = Type::of(Dimension::POWER);
pub(crate) const ABSOLUTE: Type = Type::ABSOLUTE_TEMPERATURE;

const NAMES: [(&str, Type, Option<u32>); 6] = [
    ("speed", SPEED, None),
    ("torque", TORQUE, None),
    ("T", ABSOLUTE, Some(6)),
    ("x", Type::SCALAR, None),
    ("y", Type::SCALAR, None),
    ("P", POWER, None),
];

/// `speed`, `torque`, `T`, `x`, `y`, `P` and the frozen `T`.
pub(crate) const SLOTS: [f64; 7] = [50.0, 1.0, 320.0, 0.25, 2.5, 7.0, 410.0];

/// `loss(speed)`: 0 to 100 rad/s, 0 to 200 W; `map(speed, torque)`: 2 speed + 10 torque in W up to
/// 100 rad/s and 2 N m; `cp(T)`: 300 to 400 K held, plain numbers 1 to 2; `f(x)`, `g(x, y)`: the
/// property's own.
pub(crate) struct Names {
    pub(crate) plain: Arc<LookupTable>,
    pub(crate) pair: Arc<LookupTable>,
}

pub(crate) fn one(
    x: &[f64],
    y: &[f64],
    interpolation: Interpolation,
    outside: Outside,
) -> Arc<LookupTable> {
    Arc::new(LookupTable::One(Table1::new(x.to_vec(), y.to_vec(), interpolation, outside).unwrap()))
}

pub(crate) fn two(x: &[f64], y: &[f64], z: &[f64], outside: Outside) -> Arc<LookupTable> {
    Arc::new(LookupTable::Two(Table2::new(x.to_vec(), y.to_vec(), z.to_vec(), outside).unwrap()))
}

impl Default for Names {
    fn default() -> Self {
        Self {
            plain: one(&[0.0, 1.0], &[0.0, 1.0], Interpolation::Linear, Outside::Hold),
            pair: two(&[0.0, 1.0], &[0.0, 1.0], &[0.0; 4], Outside::Hold),
        }
    }
}

impl Scope for Names {
    fn symbol(&self, name: &str) -> Option<Symbol> {
        let slot = NAMES.iter().position(|(known, ..)| *known == name)?;
        let (_, ty, in_comparison) = NAMES[slot];
        Some(Symbol { slot: u32::try_from(slot).unwrap(), ty, in_comparison })
    }

    fn names(&self) -> Vec<String> {
        NAMES.iter().map(|(name, ..)| (*name).to_owned()).collect()
    }

    fn table(&self, name: &str) -> Option<TableSymbol> {
        let linear = Interpolation::Linear;
        let (table, arguments, ty) = match name {
            "loss" => {
                (one(&[0.0, 100.0], &[0.0, 200.0], linear, Outside::Error), vec![SPEED], POWER)
            }
            "map" => {
                let z = [0.0, 20.0, 200.0, 220.0];
                (two(&[0.0, 100.0], &[0.0, 2.0], &z, Outside::Error), vec![SPEED, TORQUE], POWER)
            }
            "cp" => (
                one(&[300.0, 400.0], &[1.0, 2.0], linear, Outside::Hold),
                vec![ABSOLUTE],
                Type::SCALAR,
            ),
            "f" => (Arc::clone(&self.plain), vec![Type::SCALAR], Type::SCALAR),
            "g" => (Arc::clone(&self.pair), vec![Type::SCALAR; 2], Type::SCALAR),
            "tempo" => (Arc::clone(&self.plain), vec![Type::of(Dimension::TIME)], Type::SCALAR),
            _ => return None,
        };
        Some(TableSymbol { table, arguments, ty, units: Vec::new() })
    }

    fn table_names(&self) -> Vec<String> {
        ["loss", "map", "cp", "f", "g", "tempo"].map(str::to_owned).to_vec()
    }
}

pub(crate) fn compile(text: &str) -> Result<Program, Problems<UnitError>> {
    Expression::parse(text)?.compile(&Names::default(), None)
}

pub(crate) fn program(text: &str) -> Program {
    compile(text).unwrap_or_else(|errors| panic!("{text}: {errors:?}"))
}

pub(crate) fn run(program: &Program) -> Result<f64, EvalError> {
    program.eval(&SLOTS, &mut Vec::new())
}
