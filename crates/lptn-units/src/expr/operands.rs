//! The rules of types for operators and functions.

use super::fix::Source;
use super::function::Function;
use super::tree::{Id, Operator};
use crate::dimension::Dimension;
use crate::error::{UnitError, UnitErrorKind as Kind};
use crate::rational::Rational;
use crate::types::Type;

type Operand = (Id, Type);
type Typed = Result<Type, UnitError>;

const DIFFERENCE: Type = Type::of(Dimension::TEMPERATURE);

/// One type for two values that are added, compared or chosen from.
pub(crate) fn common(
    source: &Source<'_>,
    operation: &'static str,
    a: Operand,
    b: Operand,
) -> Typed {
    if a.1.conforms_to(b.1) {
        Ok(b.1.of_either(a.1))
    } else if b.1.conforms_to(a.1) {
        Ok(a.1.of_either(b.1))
    } else {
        Err(source.unlike(operation, a, b))
    }
}

/// absolute - absolute = difference; absolute ± difference = absolute; everything else of one kind.
pub(crate) fn sum(source: &Source<'_>, operator: Operator, a: Operand, b: Operand) -> Typed {
    let subtract = operator == Operator::Subtract;
    let symbol = if subtract { "`-`" } else { "`+`" };
    match (a.1.absolute, b.1.absolute) {
        (false, false) => common(source, symbol, a, b),
        (true, true) if subtract => Ok(Type::of(Dimension::TEMPERATURE)),
        (true, true) => Err(sum_of_absolutes(source, a.0, b.0)),
        (true, false) if b.1.conforms_to(DIFFERENCE) => Ok(a.1),
        (false, true) if a.1.conforms_to(DIFFERENCE) && !subtract => Ok(b.1),
        (false, true) if a.1.conforms_to(DIFFERENCE) => {
            Err(source.subtracted_from_difference(a.0, b.0))
        }
        _ => Err(source.unlike(symbol, a, b)),
    }
}

/// `T + 5 [degC]` was meant to be `T + 5 [K]`.
fn sum_of_absolutes(source: &Source<'_>, a: Id, b: Id) -> UnitError {
    let operation = "added to another one";
    if let Some(fix) = source.as_difference(b).or_else(|| source.as_difference(a)) {
        let kind = Kind::AbsoluteOperand { operation, fix, celsius: None };
        return UnitError::new(kind, source.tree.span(b));
    }
    if let Some(fix) = source.as_mean(a, b) {
        let kind = Kind::AbsoluteOperand { operation, fix, celsius: None };
        return UnitError::new(kind, source.tree.span(b));
    }
    source.with_zeros(b, operation, (&[a, b], &[b]))
}

pub(crate) fn product(source: &Source<'_>, operator: Operator, a: Operand, b: Operand) -> Typed {
    let divide = operator == Operator::Divide;
    for (id, ty) in [a, b] {
        if ty.absolute {
            return Err(source.absolute(
                id,
                if divide { "part of a quotient" } else { "multiplied" },
                false,
            ));
        }
    }
    let (left, right) = (a.1.dimension, b.1.dimension);
    let dimension = if divide { left.checked_div(right) } else { left.checked_mul(right) };
    dimension.map(Type::of).ok_or_else(|| overflow(source, a.0, b.0))
}

/// A base with a dimension needs an exponent that is known exactly.
pub(crate) fn power(
    source: &Source<'_>,
    base: Operand,
    exponent: Operand,
    exact: Option<Rational>,
) -> Typed {
    if base.1.absolute {
        return Err(source.absolute(base.0, "raised to a power", false));
    }
    if !exponent.1.is_scalar() {
        let kind = Kind::ExponentDimension { found: exponent.1 };
        return Err(UnitError::new(kind, source.tree.span(exponent.0)));
    }
    if base.1.is_scalar() {
        return Ok(base.1);
    }
    let Some(exact) = exact else { return Err(variable_exponent(source, base, exponent.0)) };
    base.1
        .dimension
        .checked_pow(exact)
        .map(Type::of)
        .ok_or_else(|| overflow(source, base.0, exponent.0))
}

fn variable_exponent(source: &Source<'_>, base: Operand, exponent: Id) -> UnitError {
    let plain = format!("({} / 1 [{}])", source.text_of(base.0), base.1.dimension.si_unit());
    let kind = Kind::VariableExponent { base: base.1, fix: source.replace(base.0, &plain) };
    UnitError::new(kind, source.tree.span(exponent))
}

fn overflow(source: &Source<'_>, a: Id, b: Id) -> UnitError {
    let span = source.tree.span(a).start..source.tree.span(b).end;
    let text = source.text.get(span.clone()).unwrap_or_default().to_owned();
    UnitError::new(Kind::Exponent { text }, span)
}

/// Type of a function of one argument.
pub(crate) fn argument(source: &Source<'_>, function: Function, given: Operand) -> Typed {
    let (id, ty) = given;
    let wrong = |wanted| {
        let scaled = !matches!(function, Function::Kelvin | Function::Absolute);
        let example = scaled.then(|| source.divided(id, ty));
        let kind =
            Kind::Argument { function: function.name(), wanted, found: Box::new(ty), example };
        Err(UnitError::new(kind, source.tree.span(id)))
    };
    match function {
        Function::Kelvin if ty.absolute => Ok(Type::of(Dimension::TEMPERATURE)),
        Function::Kelvin => wrong("an absolute temperature"),
        Function::Absolute if !ty.absolute && ty.is_temperature() => Ok(Type::ABSOLUTE_TEMPERATURE),
        Function::Absolute => {
            wrong("a temperature above 0 K as a plain quantity, `absolute(300 [K])`")
        }
        _ if ty.absolute => Err(source.absolute(id, "the argument of this function", false)),
        Function::Abs => Ok(ty),
        Function::Sqrt => ty
            .dimension
            .checked_pow(Rational::HALF)
            .map(Type::of)
            .ok_or_else(|| overflow(source, id, id)),
        Function::Sin | Function::Cos => {
            if ty.conforms_to(Type::SCALAR) {
                Ok(Type::SCALAR)
            } else {
                wrong("an angle or a plain number")
            }
        }
        _ if ty.is_scalar() => Ok(ty),
        _ => wrong("a plain number"),
    }
}
