//! What can be wrong with the numbers of a table.

use std::fmt;

/// Why numbers do not make a table.
#[derive(Clone, PartialEq, Eq, Debug)]
#[non_exhaustive]
pub enum TableError {
    /// Fewer than two points.
    TooShort,
    /// The lists are not of one length; for a table of two arguments: the values are not as many as there are
    /// pairs of arguments.
    LengthsDiffer,
    /// An argument is not above the one before it.
    NotIncreasing {
        /// Its index, counted from 0.
        index: usize,
    },
    /// An argument or a value is infinite or not a number.
    NotFinite {
        /// The index of the point, or of the value in a table of two arguments, counted from 0.
        index: usize,
    },
    /// One list of arguments of a table of two is wrong.
    Argument {
        /// Which: 0 for `x`, 1 for `y`.
        argument: usize,
        /// What is wrong with it.
        error: Box<TableError>,
    },
}

impl TableError {
    /// The stable code, as diagnostics print it.
    pub fn code(&self) -> &'static str {
        match self {
            Self::TooShort => "units::table_too_short",
            Self::LengthsDiffer => "units::table_lengths",
            Self::NotIncreasing { .. } => "units::table_not_increasing",
            Self::NotFinite { .. } => "units::table_not_finite",
            Self::Argument { error, .. } => error.code(),
        }
    }

    /// What to write instead.
    pub fn help(&self) -> Option<&'static str> {
        match self {
            Self::TooShort => Some("give two points or more; a value that never changes is a parameter"),
            Self::LengthsDiffer => Some("give one value for every argument"),
            Self::NotIncreasing { .. } => Some("sort the points by their argument, each argument once"),
            Self::NotFinite { .. } => Some("leave out points that have no value"),
            Self::Argument { error, .. } => error.help(),
        }
    }
}

impl fmt::Display for TableError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooShort => f.write_str("a table needs two points or more"),
            Self::LengthsDiffer => f.write_str("a table needs as many values as arguments"),
            Self::NotIncreasing { index } => {
                write!(f, "arguments must rise: number {} is not above the one before it", index + 1)
            }
            Self::NotFinite { index } => write!(f, "number {} is not finite", index + 1),
            Self::Argument { argument, error } => {
                write!(f, "{} argument: {error}", if *argument == 0 { "first" } else { "second" })
            }
        }
    }
}

impl std::error::Error for TableError {}

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
