//! Mistakes in the numbers of a table.

crate::errors! {
/// Reason why numbers are not a table. Indices are counted from 0.
#[derive(Clone, PartialEq, Eq, Debug)]
#[non_exhaustive]
pub enum TableError {
    /// Fewer than two points.
    TooShort = "units::table_too_short", "a table needs two points or more",
        help "give two points or more; a value that never changes is a parameter";
    /// The lists are not of one length; for a table of two arguments: the values are not as many as
    /// there are pairs of arguments.
    LengthsDiffer = "units::table_lengths", "a table needs as many values as arguments",
        help "give one value for every argument";
    /// An argument is not above the one before it.
    NotIncreasing { index: usize } = "units::table_not_increasing",
        format!("arguments must rise: number {} is not above the one before it", index + 1),
        help "sort the points by their argument, each argument once";
    /// An argument or a value is infinite or not a number: the point, or the value in a table of
    /// two arguments.
    NotFinite { index: usize } = "units::table_not_finite",
        format!("number {} is not finite", index + 1),
        help "leave out points that have no value";
    /// One list of arguments of a table of two is wrong: 0 for `x`, 1 for `y`.
    Argument { argument: usize, error: Box<TableError> } = error.code(),
        format!("{} argument: {error}", if *argument == 0 { "first" } else { "second" }),
        source error.as_ref(), help error.help();
}
}

/// Knots are two or more finite numbers that rise.
pub(super) fn check_knots(knots: &[f64]) -> Result<(), TableError> {
    if knots.len() < 2 {
        return Err(TableError::TooShort);
    }
    check_finite(knots)?;
    let fallen = knots.windows(2).position(|pair| pair[1] <= pair[0]);
    fallen.map_or(Ok(()), |before| Err(TableError::NotIncreasing { index: before + 1 }))
}

pub(super) fn check_finite(numbers: &[f64]) -> Result<(), TableError> {
    let found = numbers.iter().position(|number| !number.is_finite());
    found.map_or(Ok(()), |index| Err(TableError::NotFinite { index }))
}
