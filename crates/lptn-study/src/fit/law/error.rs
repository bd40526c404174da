//! What cannot be fitted.

use std::fmt;

use lptn_units::{Type, UnitError};

/// Points or a law that cannot be used. Rows are counted from 0 here and from 1 in messages.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum LawError {
    /// There are no points.
    NoPoints,
    /// Lists that belong together differ in length.
    Lengths {
        /// Number of speeds.
        speeds: usize,
        /// Number of what else was given.
        others: usize,
    },
    /// A speed that is not above 0, or no number.
    Speed {
        /// Which point.
        point: usize,
        /// The speed in rad/s.
        value: f64,
    },
    /// A power, rise or time constant that is no number, or not above 0 where its logarithm is needed.
    Power {
        /// Which point.
        point: usize,
    },
    /// A standard error that is not above 0, or no number.
    Deviation {
        /// Which point.
        point: usize,
        /// The standard error in W.
        value: f64,
    },
    /// A law that cannot be read, or whose units do not fit.
    Units {
        /// The law as written.
        law: String,
        /// What is wrong with it.
        errors: Vec<UnitError>,
    },
    /// A law without a coefficient.
    NoCoefficient {
        /// The law as written.
        law: String,
    },
    /// A law with more coefficients than there may be.
    ManyCoefficients {
        /// The law as written.
        law: String,
        /// How many it has.
        count: usize,
    },
    /// A coefficient whose unit the law leaves open.
    OpenUnit {
        /// The law as written.
        law: String,
        /// The coefficient.
        name: String,
    },
    /// A start value for a name that is no coefficient of any law.
    Start {
        /// The name.
        name: String,
    },
    /// A law of speed that is not of the dimension it has to be, times a power of the speed.
    NotALaw {
        /// What it is a law of.
        of: &'static str,
        /// What was found.
        found: Type,
    },
    /// A law that has no positive value somewhere in the range.
    NotPositive {
        /// What it is a law of.
        of: &'static str,
        /// Where, in rad/s.
        speed: f64,
    },
    /// A range of speeds that is none.
    Range,
    /// Too few points for a comparison of laws.
    TooFew {
        /// How many are needed.
        needed: usize,
        /// How many there are.
        points: usize,
    },
}

impl LawError {
    /// The stable code.
    pub fn code(&self) -> &'static str {
        match self {
            Self::NoPoints => "fit::law_no_points",
            Self::Lengths { .. } => "fit::law_lengths",
            Self::Speed { .. } => "fit::law_speed",
            Self::Power { .. } => "fit::law_power",
            Self::Deviation { .. } => "fit::law_deviation",
            Self::Units { errors, .. } => errors.first().map_or("fit::law_units", UnitError::code),
            Self::NoCoefficient { .. } => "fit::law_no_coefficient",
            Self::ManyCoefficients { .. } => "fit::law_many_coefficients",
            Self::OpenUnit { .. } => "fit::law_open_unit",
            Self::Start { .. } => "fit::law_start",
            Self::NotALaw { .. } => "fit::law_dimension",
            Self::NotPositive { .. } => "fit::law_not_positive",
            Self::Range => "fit::law_range",
            Self::TooFew { .. } => "fit::law_too_few",
        }
    }

    /// What to do.
    pub fn help(&self) -> Option<String> {
        let text = match self {
            Self::Speed { .. } => "leave out points at rest, and give speeds as positive numbers".to_owned(),
            Self::Deviation { .. } => "leave the column out for a fit without weights".to_owned(),
            Self::Units { errors, .. } => return errors.first().and_then(UnitError::help),
            Self::NoCoefficient { .. } => {
                "names that are no column are coefficients: \"a * omega\"".to_owned()
            }
            Self::OpenUnit { name, .. } => {
                format!("give it a start value with its unit, for example --start \"{name} = 20 mW/rpm\"")
            }
            Self::NotALaw { of, .. } => match *of {
                "dT" => "write for example \"0.0084 ± 0.0011 K/rpm\", or \"0.0084 [K/rpm] * omega\"",
                "t_RC" => "write for example \"18.6 ± 3.8 min\", or \"20 [min] - 0.5 [s/rpm] * omega\"",
                _ => "write for example \"87 ± 15 uW/rpm^(5/3)\", or \"87 [uW/rpm^(5/3)] * omega^(5/3)\"",
            }
            .to_owned(),
            Self::Range => "give two positive speeds, for example --over \"1000 rpm to 7000 rpm\"".to_owned(),
            _ => return None,
        };
        Some(text)
    }
}

impl fmt::Display for LawError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoPoints => f.write_str("there are no points"),
            Self::Lengths { speeds, others } => {
                write!(f, "there are {speeds} speeds, and {others} values of another quantity")
            }
            Self::Speed { point, value } => {
                write!(f, "the speed of point {} is {value} rad/s, which is not above 0", point + 1)
            }
            Self::Power { point } => write!(f, "a value of point {} is out of range", point + 1),
            Self::Deviation { point, value } => {
                write!(f, "the standard error of point {} is {value} W, which is not above 0", point + 1)
            }
            Self::Units { errors, .. } => match errors.first() {
                Some(error) => error.fmt(f),
                None => f.write_str("the units do not fit"),
            },
            Self::NoCoefficient { law } => write!(f, "`{law}` has no coefficient that could be fitted"),
            Self::ManyCoefficients { law, count } => {
                write!(f, "`{law}` has {count} coefficients; at most {} can be fitted", super::written::MOST)
            }
            Self::OpenUnit { law, name } => write!(f, "`{law}` leaves the unit of `{name}` open"),
            Self::Start { name } => write!(f, "no law has a coefficient `{name}`"),
            Self::NotALaw { of, found } => {
                write!(f, "the law of {of} is {}, not {of} over a power of the speed", found.with_article())
            }
            Self::NotPositive { of, speed } => {
                write!(f, "the law of {of} is not above 0 at {speed} rad/s")
            }
            Self::Range => f.write_str("the range of speeds is none"),
            Self::TooFew { needed, points } => {
                write!(f, "{points} points are too few to compare laws: {needed} are needed")
            }
        }
    }
}

impl std::error::Error for LawError {}
