//! How far a value may be off, and in which way.
//!
//! A `Spread` contains the standard deviation and not the number after `±`. Code that reads
//! deviations is therefore right for rectangular distributions too; only samples need the shape.

crate::words! {
/// How a value that is not certain is distributed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Distribution {
    /// Normal; the number behind `±` is one standard deviation.
    #[default]
    Normal = "normal",
    /// As likely everywhere between two limits, and nowhere else: the number behind `±` is half the
    /// width a, one standard deviation `a / sqrt(3)` (ISO/IEC Guide 98-3, 4.3.7).
    Rectangle = "rectangle",
    /// A factor on the value, which is its median: the logarithm is normal, and its standard
    /// deviation is the number behind `±` over the value.
    Lognormal = "lognormal",
}
/// Its word, as it stands in brackets behind a value.
pub fn word;
}

impl Distribution {
    /// The one of this word.
    pub fn of(word: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|distribution| distribution.word() == word)
    }

    /// What stands behind `±` for a standard deviation of 1.
    pub fn written(self) -> f64 {
        match self {
            Self::Rectangle => 3_f64.sqrt(),
            Self::Normal | Self::Lognormal => 1.0,
        }
    }
}

/// How far a value may be off.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spread {
    /// One standard deviation in SI units, of a lognormal value to first order; zero or positive.
    pub sigma: f64,
    /// How it is distributed.
    pub distribution: Distribution,
}

impl Spread {
    /// A normal one.
    pub const fn normal(sigma: f64) -> Self {
        Self { sigma, distribution: Distribution::Normal }
    }

    /// The standard deviation of the logarithm of a lognormal value around this one.
    pub fn of_logarithm(self, value: f64) -> f64 {
        self.sigma / value
    }

    /// What stands behind the unit, with a space before it; nothing for a normal one.
    pub fn suffix(self) -> String {
        match self.distribution {
            Distribution::Normal => String::new(),
            other => format!(" ({})", other.word()),
        }
    }
}
