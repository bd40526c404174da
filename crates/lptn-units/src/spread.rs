//! The uncertainty of a value: its size and its distribution.
//!
//! A `Spread` contains the standard deviation and not the number after `±`. Code that reads
//! deviations is therefore right for rectangular distributions too; only samples need the shape.

crate::words! {
/// The distribution of an uncertain value.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Distribution {
    /// Normal; the number after `±` is one standard deviation.
    #[default]
    Normal = "normal",
    /// Uniform between two limits: the number after `±` is half the width a, one standard deviation
    /// `a / sqrt(3)` (ISO/IEC Guide 98-3, 4.3.7).
    Rectangle = "rectangle",
    /// A factor on the value, which is its median: the logarithm is normal, and its standard
    /// deviation is the number after `±` over the value.
    Lognormal = "lognormal",
}
/// Its word, as in brackets after a value.
pub fn word;
}

impl Distribution {
    /// The distribution with this word.
    pub fn of(word: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|distribution| distribution.word() == word)
    }

    /// The number after `±` for a standard deviation of 1.
    pub fn written(self) -> f64 {
        match self {
            Self::Rectangle => 3_f64.sqrt(),
            Self::Normal | Self::Lognormal => 1.0,
        }
    }
}

/// The uncertainty of a value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spread {
    /// One standard deviation in SI units, zero or positive; to first order for a lognormal value.
    pub sigma: f64,
    /// Its distribution.
    pub distribution: Distribution,
}

impl Spread {
    /// A normal distribution with this standard deviation.
    pub const fn normal(sigma: f64) -> Self {
        Self { sigma, distribution: Distribution::Normal }
    }

    /// The standard deviation of the logarithm of a lognormal value around this one.
    pub fn of_logarithm(self, value: f64) -> f64 {
        self.sigma / value
    }

    /// The text after the unit, with a space before it; empty for a normal distribution.
    pub fn suffix(self) -> String {
        match self.distribution {
            Distribution::Normal => String::new(),
            other => format!(" ({})", other.word()),
        }
    }
}
