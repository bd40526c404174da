//! Errors in the evaluation of an expression.

use std::ops::Range;

use crate::format::rounded;
use crate::unit::Unit;

crate::errors! {
/// Errors at run time; numbers are in SI units, spans are bytes of the expression.
#[derive(Clone, PartialEq, Debug)]
#[non_exhaustive]
pub enum EvalError {
    /// A negative base with an exponent that is not a whole number.
    NegativeBase { base: f64, exponent: f64, span: Range<usize> } = "units::negative_base",
        format!(
            "negative base {base} with the exponent {exponent}, which is not a whole number"
        ),
        help "write \"abs(x)^a\", or \"if(x > 0, x^a, 0)\" with its units";
    /// The square root of a negative number, the logarithm of a number that is not positive.
    Domain { function: &'static str, argument: f64, span: Range<usize> } = "units::domain",
        format!("`{function}` of {argument}"),
        help "keep the argument positive: \"max(x, 1e-9)\" with its unit";
    /// An argument, counted from 0, outside the knots of a table that has no value there; with the
    /// unit in which the table gives this argument, if known.
    OutsideTable {
        table: String, argument: usize, value: f64, from: f64, to: f64, unit: Option<Box<Unit>>,
        span: Range<usize>
    } = "units::outside_table",
        outside(table, *argument, [*from, *to, *value], unit.as_deref()),
        help "stay inside, or give a [table] more points, or its end values with `outside = \"hold\"`";
    /// The result or one of its derivatives is infinite or not a number; with the part of the text
    /// in which this first occurred.
    NotFinite { value: f64, span: Range<usize> } = "units::result_not_finite",
        format!("result {value} or its derivative is not finite"),
        help "keep divisors away from 0: \"max(x, 1e-9)\" with its unit";
    /// Fewer slots than the program loads were given.
    MissingSlot { slot: u32, given: usize } = "units::missing_slot",
        format!("slot {slot} is needed, but only {given} slots are given");
}
}

impl EvalError {
    /// The part of the expression that failed, in bytes; empty for a missing slot.
    pub fn span(&self) -> Range<usize> {
        match self {
            Self::NegativeBase { span, .. }
            | Self::Domain { span, .. }
            | Self::OutsideTable { span, .. }
            | Self::NotFinite { span, .. } => span.clone(),
            Self::MissingSlot { .. } => 0..0,
        }
    }
}

fn outside(table: &str, argument: usize, range: [f64; 3], unit: Option<&Unit>) -> String {
    let which = if argument == 0 { "first" } else { "second" };
    let [first, last, found] = range.map(|si| in_unit(si, unit, 12));
    let is_end = found == first || found == last;
    let found = if is_end { in_unit(range[2], unit, 17) } else { found };
    let si = if unit.is_none() { " (SI units)" } else { "" };
    format!(
        "table `{table}` reaches from {first} to {last} in its {which} argument, got {found}{si}"
    )
}

/// A number with its usual unit.
fn in_unit(si: f64, unit: Option<&Unit>, digits: usize) -> String {
    match unit {
        None => format!("{si}"),
        Some(unit) if unit.text == "1" => rounded(si, digits),
        Some(unit) => format!("{} {}", rounded(unit.from_si(si), digits), unit.text),
    }
}
