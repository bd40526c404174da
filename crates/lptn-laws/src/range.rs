//! The numbers that a field may be.

/// The numbers that a field may be. During a run, if it may depend on time and temperatures, 0 is
/// allowed as well.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Range {
    /// Any.
    Finite,
    /// Above 0.
    Positive,
    /// At least 0.
    NotNegative,
    /// Above 0, at most 1.
    Fraction,
    /// An absolute temperature, at least 0 K.
    Temperature,
    /// An angle above the first and below the second number of degrees.
    Degrees(i16, i16),
    /// A count: whole, at least 1.
    Count,
}

impl Range {
    /// True if an angle in rad is inside, or if the range is not one of angles.
    pub fn has_angle(self, radians: f64) -> bool {
        match self {
            Self::Degrees(from, to) => {
                radians.to_degrees() > f64::from(from) && radians.to_degrees() < f64::from(to)
            }
            _ => true,
        }
    }
}
