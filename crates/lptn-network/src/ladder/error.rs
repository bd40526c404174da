//! Why a chain or ladder is refused.

use lptn_units::Class;

lptn_units::errors! {
/// Why a Foster chain or a Cauer ladder is not valid, or cannot be converted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LadderError {
    /// A Foster chain without terms or a Cauer ladder without rungs.
    Empty { form: &'static str, parts: &'static str } = "ladder::empty",
        format!("the {form} has no {parts}"),
        help "give at least one: a resistance alone has no transient";
    /// An element that is not a positive number, in the row with this index from 0.
    NotPositive { what: &'static str, row: usize, value: f64 } = "ladder::not_positive",
        format!("the {what} of row {} must be positive and finite, got {value}", row + 1),
        help "leave out rows of zero; write the immediate part as the direct resistance";
    /// A direct resistance that is negative or not a number.
    Direct(value: f64) = "ladder::direct",
        format!("the direct resistance must be 0 or positive, and finite, got {value}"),
        help "write 0 unless the port has no capacity itself";
    /// Elements of the other form that are too large or too small for a number.
    Range { form: &'static str } = "ladder::range",
        format!("elements of the {form} are too large or too small for a number"),
        help "leave out rows: many time constants close together need elements of 1e300 and more, \
            which no measurement can determine",
        class Class::Numbers;
    /// Time constants so close that their shares cannot be distinguished: the chain would differ
    /// from the ladder by this part.
    Close { error: f64 } = "ladder::close",
        format!(
            "time constants of the ladder are too close to be distinguished: the Foster chain \
             would be wrong by {error:.1e} of its value"
        ),
        help "put rungs together that are joined weakly",
        class Class::Numbers;
}
}

/// A row's element, if it is a positive number.
pub(super) fn positive(what: &'static str, row: usize, value: f64) -> Result<(), LadderError> {
    let fine = value > 0.0 && value.is_finite();
    if fine { Ok(()) } else { Err(LadderError::NotPositive { what, row, value }) }
}

/// A direct resistance, if it is one.
pub(super) fn direct(value: f64) -> Result<(), LadderError> {
    let fine = value >= 0.0 && value.is_finite();
    if fine { Ok(()) } else { Err(LadderError::Direct(value)) }
}
