//! One program on the slots of several elements at once.
//!
//! Each operation is read once and done for all lanes, with the same arithmetic as in
//! [`Program::eval`], so that the results are the same to the last digit. If one lane has an error,
//! all are abandoned, and the caller evaluates them one by one to find it.

use std::sync::Arc;

use super::function::Function;
use super::program::{Arithmetic, Op, Operand, Program};
use crate::scalar::Scalar;
use crate::table::LookupTable;

/// Number of elements that are evaluated together.
pub const LANES: usize = 8;

/// A number for each of them.
pub type Lanes = [f64; LANES];

impl Program {
    /// True if it has no branch and no table of two arguments, so that all lanes take one path.
    pub fn runs_on_lanes(&self) -> bool {
        let straight = |op: &Op| {
            !matches!(
                op,
                Op::JumpUnless(..) | Op::Jump(_) | Op::JumpUnlessSet(..) | Op::PoppedTable(_)
            )
        };
        self.code.iter().all(straight)
    }

    /// True if it does the same with the same slots, whatever its text.
    pub fn does_the_same(&self, other: &Self) -> bool {
        let tables = || self.tables.iter().zip(other.tables.iter());
        self.code == other.code
            && self.tables.len() == other.tables.len()
            && tables().all(|(own, others)| Arc::ptr_eq(&own.table, &others.table))
    }

    /// The values for the slots that `load` gives, in SI units; `None` if one of them is not finite
    /// or has an error, or the program does not run on lanes.
    pub fn eval_lanes(&self, load: impl Fn(u32) -> Lanes, stack: &mut Vec<Lanes>) -> Option<Lanes> {
        let operand = |operand: Operand| match operand {
            Operand::Constant(value) => [value; LANES],
            Operand::Slot(slot) => load(slot),
        };
        stack.clear();
        let mut lanes = [0.0; LANES];
        for op in &self.code {
            lanes = match *op {
                Op::Load(from) => operand(from),
                Op::Push => {
                    stack.push(lanes);
                    continue;
                }
                Op::Right(arithmetic, with) => apply(arithmetic, lanes, operand(with)),
                Op::Left(arithmetic, with) => apply(arithmetic, operand(with), lanes),
                Op::Popped(arithmetic) => apply(arithmetic, stack.pop()?, lanes),
                Op::Negate => lanes.map(|x| -x),
                Op::WholePower(exponent) => lanes.map(|x| x.powi(exponent)),
                Op::RealPower(exponent) => power(lanes, [exponent; LANES])?,
                Op::PoppedPower => power(stack.pop()?, lanes)?,
                Op::Call(function) => call(function, lanes)?,
                Op::Table(table) => self.table_of_lanes(table, lanes)?,
                Op::PoppedTable(_) | Op::JumpUnless(..) | Op::Jump(_) | Op::JumpUnlessSet(..) => {
                    return None;
                }
            };
        }
        lanes.iter().all(|x| x.is_finite()).then_some(lanes)
    }

    fn table_of_lanes(&self, table: usize, arguments: Lanes) -> Option<Lanes> {
        let table = self.tables.get(table)?.table.as_ref();
        let mut values = arguments;
        for value in &mut values {
            let found = match table {
                LookupTable::One(table) => table.value_and_slope(*value),
                LookupTable::DoubleLog(line) => line.value_and_slope(*value),
                LookupTable::PowerLaw(law) => law.value_and_slope(*value),
                LookupTable::Two(_) => None,
            };
            *value = found?.0;
        }
        Some(values)
    }
}

#[inline(always)]
fn apply(arithmetic: Arithmetic, left: Lanes, right: Lanes) -> Lanes {
    match arithmetic {
        Arithmetic::Add => each(left, right, |a, b| a + b),
        Arithmetic::Subtract => each(left, right, |a, b| a - b),
        Arithmetic::Multiply => each(left, right, |a, b| a * b),
        Arithmetic::Divide => each(left, right, |a, b| a / b),
        Arithmetic::Min => each(left, right, Scalar::min),
        Arithmetic::Max => each(left, right, Scalar::max),
    }
}

#[inline(always)]
fn each(left: Lanes, right: Lanes, of: impl Fn(f64, f64) -> f64) -> Lanes {
    std::array::from_fn(|lane| of(left[lane], right[lane]))
}

fn power(base: Lanes, exponent: Lanes) -> Option<Lanes> {
    let real = |(base, exponent): (&f64, &f64)| *base >= 0.0 || exponent.fract() == 0.0;
    base.iter().zip(&exponent).all(real).then(|| each(base, exponent, f64::powf))
}

fn call(function: Function, lanes: Lanes) -> Option<Lanes> {
    let inside = |x: &f64| match function {
        Function::Sqrt => *x >= 0.0,
        Function::Ln => *x > 0.0,
        _ => true,
    };
    if !lanes.iter().all(inside) {
        return None;
    }
    Some(match function {
        Function::Abs => lanes.map(f64::abs),
        Function::Sqrt => lanes.map(f64::sqrt),
        Function::Exp => lanes.map(f64::exp),
        Function::Ln => lanes.map(f64::ln),
        Function::Sin => lanes.map(f64::sin),
        Function::Cos => lanes.map(f64::cos),
        Function::Tanh => lanes.map(f64::tanh),
        // separate operations, or the value itself in K
        Function::Min
        | Function::Max
        | Function::Mean
        | Function::Sum
        | Function::If
        | Function::Kelvin
        | Function::Absolute => lanes,
    })
}
