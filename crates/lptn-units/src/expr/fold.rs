//! Values of constant parts. Failures are left to run time, where they are reported.

use super::function::Function;
use super::tree::Operator;
use crate::rational::Rational;

pub(crate) fn binary(operator: Operator, left: Option<f64>, right: Option<f64>) -> Option<f64> {
    let (a, b) = (left?, right?);
    finite(match operator {
        Operator::Add => a + b,
        Operator::Subtract => a - b,
        Operator::Multiply => a * b,
        Operator::Divide => a / b,
        Operator::Power => a.powf(b),
    })
}

/// The same in exact fractions, for exponents such as `(5/3)` and `-(1/2)`.
pub(crate) fn exact(
    operator: Operator,
    left: Option<Rational>,
    right: Option<Rational>,
) -> Option<Rational> {
    let (a, b) = (left?, right?);
    match operator {
        Operator::Add => a.checked_add(b),
        Operator::Subtract => a.checked_sub(b),
        Operator::Multiply => a.checked_mul(b),
        Operator::Divide => a.checked_div(b),
        Operator::Power => None,
    }
}

pub(crate) fn several(function: Function, values: &[f64]) -> Option<f64> {
    let combine = |best: f64, value: f64| match function {
        Function::Min if value < best => value,
        Function::Max if value > best => value,
        _ => best,
    };
    if function == Function::Mean {
        let count = u32::try_from(values.len()).ok()?;
        return finite(values.iter().sum::<f64>() / f64::from(count));
    }
    if function == Function::Sum {
        return finite(values.iter().sum());
    }
    values.iter().copied().reduce(combine).and_then(finite)
}

pub(crate) fn single(function: Function, value: f64) -> Option<f64> {
    finite(match function {
        Function::Abs => value.abs(),
        Function::Sqrt => value.sqrt(),
        Function::Exp => value.exp(),
        Function::Ln => value.ln(),
        Function::Sin => value.sin(),
        Function::Cos => value.cos(),
        Function::Tanh => value.tanh(),
        Function::Kelvin | Function::Absolute => value,
        _ => return None,
    })
}

fn finite(value: f64) -> Option<f64> {
    value.is_finite().then_some(value)
}
