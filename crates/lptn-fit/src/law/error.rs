//! Errors in fits of laws.

use lptn_units::{Problem, Problems, Type, UnitError};

/// Largest number of coefficients of one law.
pub(crate) const MOST: usize = 8;

lptn_units::errors! {
/// Points or a law that cannot be used. Rows are counted from 0 here and from 1 in messages; laws
/// are quoted as written.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum LawError {
    /// There are no points.
    NoPoints = "fit::law_no_points", "there are no points";
    /// Lists that belong together differ in length.
    Lengths { speeds: usize, others: usize } = "fit::law_lengths",
        format!("there are {speeds} speeds, and {others} values of another quantity");
    /// A speed in rad/s that is not above 0, or not a number.
    Speed { point: usize, value: f64 } = "fit::law_speed",
        format!("the speed of point {} is {value} rad/s, which is not above 0", point + 1),
        help "leave out points at rest, and give speeds as positive numbers";
    /// A power, rise or time constant that is not a number, or not above 0 if its logarithm is
    /// needed.
    Power { point: usize } = "fit::law_power",
        format!("a value of point {} is out of range", point + 1);
    /// A standard error in W that is not above 0, or not a number.
    Deviation { point: usize, value: f64 } = "fit::law_deviation",
        format!("the standard error of point {} is {value} W, which is not above 0", point + 1),
        help "leave the column out for a fit without weights";
    /// A law that cannot be read, or whose units do not fit.
    Units { law: String, errors: Problems<UnitError> } = Problem::code(errors), errors,
        source errors,
        help Problem::help(errors);
    /// A law without a coefficient.
    NoCoefficient { law: String } = "fit::law_no_coefficient",
        format!("`{law}` has no coefficient that could be fitted"),
        help "names that are not columns are coefficients: \"a * omega\"";
    /// A law with too many coefficients.
    ManyCoefficients { law: String, count: usize } = "fit::law_many_coefficients",
        format!("`{law}` has {count} coefficients; at most {MOST} can be fitted");
    /// A coefficient whose unit the law leaves open.
    OpenUnit { law: String, name: String } = "fit::law_open_unit",
        format!("`{law}` leaves the unit of `{name}` open"),
        help format!(
            "give it a start value with its unit, for example --start \"{name} = 20 mW/rpm\""
        );
    /// A start value for a name that is not a coefficient of any law.
    Start { name: String } = "fit::law_start", format!("no law has a coefficient `{name}`");
    /// A law whose dimension is not the required one over a power of the speed.
    NotALaw { of: &'static str, found: Type } = "fit::law_dimension",
        format!("the law of {of} is {}, not {of} over a power of the speed", found.with_article()),
        help match *of {
            "dT" => "write for example \"0.0084 ± 0.0011 K/rpm\", or \"0.0084 [K/rpm] * omega\"",
            "t_RC" => "write for example \"18.6 ± 3.8 min\", or \"20 [min] - 0.5 [s/rpm] * omega\"",
            _ => "write for example \"87 ± 15 uW/rpm^(5/3)\", or \
                \"87 [uW/rpm^(5/3)] * omega^(5/3)\"",
        };
    /// A law that has no positive value at a speed, in rad/s, of the range.
    NotPositive { of: &'static str, speed: f64 } = "fit::law_not_positive",
        format!("the law of {of} is not above 0 at {speed} rad/s");
    /// A range of speeds that does not rise from above 0.
    Range = "fit::law_range", "the speeds do not span a range above 0",
        help "give two positive speeds, for example --over \"1000 rpm to 7000 rpm\"";
    /// Too few points for a comparison of laws.
    TooFew { needed: usize, points: usize } = "fit::law_too_few",
        format!("{points} points are too few to compare laws: {needed} are needed");
}
}
