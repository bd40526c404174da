//! The uncertainty of a value: its size and its distribution.
//!
//! A `Spread` gives the standard deviation and not the number after `±`. Code that reads deviations
//! is therefore right for rectangular distributions too; only samples need the shape. It gives it
//! for a value only, so that no study can keep the deviation of a value that it has changed.

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

/// The uncertainty of a value: a size and a distribution. If the value is changed, a deviation in
/// percent and a factor follow it, and one with a unit stays as it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spread {
    size: Size,
    /// Its distribution.
    pub distribution: Distribution,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Size {
    /// One standard deviation in SI units, zero or positive.
    Absolute(f64),
    /// The number after `±`, in percent of the value. It is kept as written, because percents of
    /// zero are lost.
    Percent(f64),
    /// One standard deviation in SI units if the value is this one, which is above zero.
    Factor { sigma: f64, of: f64 },
}

impl Spread {
    /// One standard deviation in SI units, zero or positive, of this value; to first order for a
    /// lognormal one, which is a factor on every value.
    pub const fn of(value: f64, sigma: f64, distribution: Distribution) -> Self {
        let size = match distribution {
            Distribution::Lognormal if value > 0.0 => Size::Factor { sigma, of: value },
            _ => Size::Absolute(sigma),
        };
        Self { size, distribution }
    }

    /// The number after `±` in percent of the value, zero or positive; the value that was written
    /// is this one.
    pub fn of_percent(value: f64, percent: f64, distribution: Distribution) -> Self {
        let size = Size::Percent(percent);
        match distribution {
            Distribution::Normal | Distribution::Rectangle => Self { size, distribution },
            Distribution::Lognormal => {
                Self::of(value, Self { size, distribution }.sigma(value), distribution)
            }
        }
    }

    /// A normal distribution with this standard deviation, whatever the value.
    pub const fn normal(sigma: f64) -> Self {
        Self { size: Size::Absolute(sigma), distribution: Distribution::Normal }
    }

    /// One standard deviation of this value, in SI units; to first order for a lognormal value.
    pub fn sigma(self, value: f64) -> f64 {
        match self.size {
            Size::Absolute(sigma) => sigma,
            Size::Percent(percent) => value.abs() * percent / 100.0 / self.distribution.written(),
            // exactly the one that was given, for the same value
            Size::Factor { sigma, of } => sigma * (value.abs() / of),
        }
    }

    /// The number after `±` if it is in percent of the value.
    pub fn percent(self) -> Option<f64> {
        match self.size {
            Size::Percent(percent) => Some(percent),
            Size::Absolute(_) | Size::Factor { .. } => None,
        }
    }

    /// True if no value has a deviation.
    pub fn is_certain(self) -> bool {
        let (Size::Absolute(size) | Size::Percent(size) | Size::Factor { sigma: size, .. }) =
            self.size;
        size <= 0.0
    }

    /// The standard deviation of the logarithm of a lognormal value around this one.
    pub fn of_logarithm(self, value: f64) -> f64 {
        match self.size {
            Size::Factor { sigma, of } => sigma / of,
            Size::Absolute(_) | Size::Percent(_) => self.sigma(value) / value,
        }
    }

    /// The text after the unit, with a space before it; empty for a normal distribution.
    pub fn suffix(self) -> String {
        match self.distribution {
            Distribution::Normal => String::new(),
            other => format!(" ({})", other.word()),
        }
    }
}
