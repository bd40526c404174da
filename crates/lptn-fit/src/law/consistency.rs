//! Check that laws of temperature rise, time constant and power can be true together.

use lptn_units::statistics;
use lptn_units::statistics::two_sided;

use super::error::LawError;
use super::stated::{Exponent, LawOf, StatedLaw};
use crate::step::Capacity;

/// Laws contradict each other if chance alone explains a difference with less probability.
pub const SIGNIFICANT: f64 = 0.05;

/// Laws without standard errors contradict each other if no common factor brings their powers
/// closer than this.
pub const CLOSE: f64 = 0.05;

/// Values of the laws at one speed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AtSpeed {
    /// The speed in rad/s.
    pub speed: f64,
    /// The law of the rise, in K.
    pub rise: f64,
    /// The law of the time constant, in s.
    pub time_constant: f64,
    /// The power that follows from the two, `C dT / t_RC`, in W.
    pub implied: f64,
    /// The law of the power, in W.
    pub power: f64,
    /// The time constant with which rise and power would both be true, `C dT / P`, in s.
    pub needed: f64,
}

/// A difference over its standard error, and the probability that chance makes it as large.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Significance {
    /// The difference over its standard error.
    pub z: f64,
    /// Probability of a difference as large, in either direction.
    pub probability: f64,
}

/// Implied power over the law's, in the middle of the range. A wrong capacity shows here, a wrong
/// law in the exponents.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Level {
    /// Implied over stated power; 1 if they agree.
    pub ratio: f64,
    /// Its relative standard error.
    pub relative_error: Option<f64>,
    /// Significance of its difference from 1.
    pub significance: Option<Significance>,
}

/// The comparison. With `P = C dT / t_RC` (equations 8 and 11 of the seed paper) the exponent of
/// the power has to be that of the rise less that of the time constant, whatever the capacity.
#[derive(Clone, Debug, PartialEq)]
pub struct Consistency {
    /// The least and the highest speed, in rad/s.
    pub range: (f64, f64),
    /// The exponent of the rise.
    pub rise: Exponent,
    /// The exponent of the time constant.
    pub time_constant: Exponent,
    /// The exponent of the power that follows from them.
    pub implied: Exponent,
    /// The exponent of the law of the power.
    pub power: Exponent,
    /// The implied exponent less that of the power.
    pub difference: Exponent,
    /// Significance of the difference of the exponents, if their errors are known.
    pub exponents: Option<Significance>,
    /// Values at the least speed, the geometric middle and the highest speed.
    pub at: [AtSpeed; 3],
    /// The capacity in J/K: the one given, or the one with which the powers agree in the middle.
    pub capacity: f64,
    /// Implied against stated power; `None` without a capacity.
    pub level: Option<Level>,
    /// True if the power of each point is `C dT / t_RC`, all with one C. It was then computed from
    /// the others and adds no information.
    pub derived: bool,
    /// Points less fitted numbers; `None` for stated laws.
    pub degrees_of_freedom: Option<usize>,
}

/// The three laws.
struct Laws<'a> {
    rise: &'a StatedLaw,
    time_constant: &'a StatedLaw,
    power: &'a StatedLaw,
}

impl Laws<'_> {
    fn at(&self, speed: f64, capacity: f64) -> Result<AtSpeed, LawError> {
        let (rise, tau) = (self.rise.value(speed)?, self.time_constant.value(speed)?);
        let power = self.power.value(speed)?;
        let (implied, needed) = (capacity * rise / tau, capacity * rise / power);
        Ok(AtSpeed { speed, rise, time_constant: tau, implied, power, needed })
    }

    /// The capacity with which the powers agree at a speed.
    fn capacity(&self, speed: f64) -> Result<f64, LawError> {
        Ok(self.power.value(speed)? * self.time_constant.value(speed)? / self.rise.value(speed)?)
    }
}

impl Consistency {
    /// Compares three stated laws over a range of speeds in rad/s.
    ///
    /// # Errors
    /// [`LawError`] for a range that does not rise from above 0, or a law that is not positive in
    /// it.
    pub fn of_laws(
        rise: &StatedLaw,
        time_constant: &StatedLaw,
        power: &StatedLaw,
        capacity: Option<Capacity>,
        range: (f64, f64),
    ) -> Result<Self, LawError> {
        let laws = Laws { rise, time_constant, power };
        let stated = |law: &StatedLaw| -> Result<Exponent, LawError> {
            Ok(Exponent { value: law.exponent(range)?, standard_error: None })
        };
        let exponents = [stated(rise)?, stated(time_constant)?, stated(power)?];
        let mut found = Self::compared(&laws, exponents, capacity, range)?;
        let errors = [rise.relative_error, time_constant.relative_error, power.relative_error];
        let error = quadrature(errors.into_iter().chain([capacity.and_then(relative)]));
        found.level = capacity.map(|_| level(found.at[1].implied / found.at[1].power, error, None));
        Ok(found)
    }

    fn compared(
        laws: &Laws<'_>,
        [rise, time_constant, power]: [Exponent; 3],
        capacity: Option<Capacity>,
        range: (f64, f64),
    ) -> Result<Self, LawError> {
        let (low, high) = range;
        if !(low.is_finite() && high.is_finite() && 0.0 < low && low < high) {
            return Err(LawError::Range);
        }
        let middle = (low * high).sqrt();
        let capacity = capacity.map_or_else(|| laws.capacity(middle), |c| Ok(c.value))?;
        let at = [laws.at(low, capacity)?, laws.at(middle, capacity)?, laws.at(high, capacity)?];
        let less = |a: Exponent, b: Exponent| Exponent {
            value: a.value - b.value,
            standard_error: quadrature([a.standard_error, b.standard_error].into_iter()),
        };
        let implied = less(rise, time_constant);
        let difference = less(implied, power);
        Ok(Self {
            range,
            rise,
            time_constant,
            implied,
            power,
            difference,
            exponents: None,
            at,
            capacity,
            level: None,
            derived: false,
            degrees_of_freedom: None,
        })
    }

    /// Fits a power of the speed to each of three measured quantities, and compares. The fits are
    /// least squares of logarithms. Known relative standard errors are weights and lower bounds of
    /// errors. Speeds are in rad/s, rises in K, time constants in s, powers in W, one of each per
    /// point and all above 0. The standard errors of difference and level come from leaving one
    /// point out at a time (jackknife: B. Efron, R. J. Tibshirani, An Introduction to the
    /// Bootstrap, Chapman & Hall 1993, chapter 11), which counts shared errors. Probabilities are
    /// Student's with two degrees of freedom less than points.
    ///
    /// # Errors
    /// [`LawError`] for fewer than 5 points, one speed alone, or a number out of range.
    pub fn of_points(
        measured: &Measured<'_>,
        capacity: Option<Capacity>,
    ) -> Result<Self, LawError> {
        let logs = Logarithms::new(measured)?;
        let all: Vec<usize> = (0..measured.speed.len()).collect();
        let lines = [1, 2, 3].map(|i| logs.line(i, &all));
        let law = |of: LawOf, fit: Line| {
            StatedLaw::through(of, (fit.centre.exp(), fit.mean.exp()), fit.slope, fit.mean_error)
        };
        let [rise, tau, power] = lines;
        let laws =
            (law(LawOf::Rise, rise), law(LawOf::TimeConstant, tau), law(LawOf::Power, power));
        let exponents =
            lines.map(|fit| Exponent { value: fit.slope, standard_error: Some(fit.slope_error) });
        let ends = |pick: fn(f64, f64) -> f64| {
            measured.speed.iter().copied().reduce(pick).unwrap_or(f64::NAN)
        };
        let range = (ends(f64::min), ends(f64::max));
        let laws = Laws { rise: &laws.0, time_constant: &laws.1, power: &laws.2 };
        let mut found = Self::compared(&laws, exponents, capacity, range)?;
        found.conclude(&logs, capacity);
        Ok(found)
    }

    /// Adds the results that need the single points.
    fn conclude(&mut self, logarithms: &Logarithms, capacity: Option<Capacity>) {
        let logs = &logarithms.values;
        let points = logs[0].len();
        let freedom = Some(points - 2);
        let slope = |of: usize, kept: &[usize]| logarithms.line(of, kept).slope;
        let difference = |kept: &[usize]| slope(1, kept) - slope(2, kept) - slope(3, kept);
        // ln (dT / (t_RC P)) of every point
        let offsets: Vec<f64> = (0..points).map(|i| logs[1][i] - logs[2][i] - logs[3][i]).collect();
        let mean = statistics::mean(&offsets);
        self.derived = offsets.iter().all(|offset| (offset - mean).abs() < ROUNDED);
        self.degrees_of_freedom = freedom;
        if self.derived {
            // the rest is the rounding of the numbers
            self.difference.standard_error = None;
            self.level = capacity.map(|c| level(c.value * mean.exp(), relative(c), None));
            return;
        }
        let error = jackknife(points, &difference);
        self.difference.standard_error = Some(error);
        self.exponents = Some(significance(self.difference.value / error, freedom));
        let kept =
            |kept: &[usize]| kept.iter().map(|&i| offsets[i]).sum::<f64>() / kept.len() as f64;
        let own = Some(jackknife(points, &kept));
        self.level = capacity.map(|c| {
            level(c.value * mean.exp(), quadrature([own, relative(c)].into_iter()), freedom)
        });
    }

    /// The factor between implied and stated power at the ends that no common factor removes, at
    /// least 1.
    pub fn spread(&self) -> f64 {
        let ratio = |at: &AtSpeed| at.implied / at.power;
        let change = ratio(&self.at[2]) / ratio(&self.at[0]);
        change.max(1.0 / change).sqrt()
    }

    /// True if the exponents contradict each other: by more than chance explains, or, if they are
    /// stated without errors, by more than [`CLOSE`] at the ends of the range.
    pub fn exponents_contradict(&self) -> bool {
        match self.exponents {
            Some(found) => found.probability < SIGNIFICANT,
            None => self.spread() > 1.0 + CLOSE,
        }
    }

    /// True if the powers contradict each other in the middle of the range; false without a
    /// capacity.
    pub fn levels_contradict(&self) -> bool {
        self.level.is_some_and(|level| match level.significance {
            Some(found) => found.probability < SIGNIFICANT,
            None => level.ratio.max(1.0 / level.ratio) > 1.0 + CLOSE,
        })
    }

    /// True if the three can be true together.
    pub fn agrees(&self) -> bool {
        !self.exponents_contradict() && !self.levels_contradict()
    }

    /// Significance of the difference between a fitted exponent and a claimed one.
    pub fn claim(&self, found: Exponent, claimed: f64) -> Option<Significance> {
        let error = found.standard_error.filter(|error| *error > 0.0)?;
        Some(significance((found.value - claimed) / error, self.degrees_of_freedom))
    }
}

/// Differences between points up to this part come from rounding in the written numbers.
const ROUNDED: f64 = 2e-3;

/// Three quantities that were measured at the same points.
#[derive(Clone, Copy, Debug)]
pub struct Measured<'a> {
    /// Speeds in rad/s.
    pub speed: &'a [f64],
    /// Temperature rises in K.
    pub rise: &'a [f64],
    /// Time constants in s.
    pub time_constant: &'a [f64],
    /// Powers in W.
    pub power: &'a [f64],
    /// Standard errors of rises, time constants and powers, if all are known.
    pub errors: Option<[&'a [f64]; 3]>,
}

/// Logarithms of speeds, rises, time constants and powers.
struct Logarithms {
    values: [Vec<f64>; 4],
    /// Their standard errors, if they are known; those of the speeds are not used.
    errors: Option<[Vec<f64>; 4]>,
}

impl Logarithms {
    fn new(measured: &Measured<'_>) -> Result<Self, LawError> {
        let lists = [measured.speed, measured.rise, measured.time_constant, measured.power];
        let points = measured.speed.len();
        let errors = measured.errors.into_iter().flatten();
        if let Some(other) = lists.into_iter().chain(errors).find(|list| list.len() != points) {
            return Err(LawError::Lengths { speeds: points, others: other.len() });
        }
        if points < 5 {
            return Err(LawError::TooFew { needed: 5, points });
        }
        for list in lists {
            if let Some(point) = list.iter().position(|x| !(x.is_finite() && *x > 0.0)) {
                return Err(LawError::Power { point });
            }
        }
        let values = lists.map(|list| list.iter().map(|x| x.ln()).collect::<Vec<f64>>());
        // without any one point there still have to be two speeds
        let several = (0..points).all(|out| {
            let left: Vec<f64> = (0..points).filter(|i| *i != out).map(|i| values[0][i]).collect();
            left.iter().any(|x| (x - left[0]).abs() > 1e-9)
        });
        if !several {
            return Err(LawError::Range);
        }
        let relative = |errors: &[f64], of: &[f64]| {
            errors.iter().zip(of).map(|(e, x)| e / x).collect::<Vec<f64>>()
        };
        let errors = measured.errors.map(|[rise, tau, power]| {
            [
                Vec::new(),
                relative(rise, lists[1]),
                relative(tau, lists[2]),
                relative(power, lists[3]),
            ]
        });
        let usable = |e: &[Vec<f64>; 4]| e[1..].iter().flatten().all(|e| e.is_finite() && *e > 0.0);
        Ok(Self { values, errors: errors.filter(usable) })
    }

    /// The line of list `of` over the speeds, through the points `kept`.
    fn line(&self, of: usize, kept: &[usize]) -> Line {
        let (x, y) = (&self.values[0], &self.values[of]);
        let weight = |i: usize| self.errors.as_ref().map_or(1.0, |errors| errors[of][i].powi(-2));
        let sum =
            |term: &dyn Fn(usize) -> f64| kept.iter().map(|&i| weight(i) * term(i)).sum::<f64>();
        let whole = sum(&|_| 1.0);
        let (centre, mean) = (sum(&|i| x[i]) / whole, sum(&|i| y[i]) / whole);
        let square = sum(&|i| (x[i] - centre).powi(2));
        let slope = sum(&|i| (x[i] - centre) * (y[i] - mean)) / square;
        let squares = sum(&|i| (y[i] - mean - slope * (x[i] - centre)).powi(2));
        let shown = squares / (kept.len() as f64 - 2.0);
        let variance = if self.errors.is_some() { shown.max(1.0) } else { shown };
        let (mean_error, slope_error) = ((variance / whole).sqrt(), (variance / square).sqrt());
        Line { centre, mean, mean_error, slope, slope_error }
    }
}

/// A straight line through logarithms.
#[derive(Clone, Copy)]
struct Line {
    /// Mean of the abscissae.
    centre: f64,
    /// Mean of the ordinates: the line's value there.
    mean: f64,
    mean_error: f64,
    slope: f64,
    slope_error: f64,
}

/// The standard error of a number by leaving out one point at a time.
fn jackknife(points: usize, of: &dyn Fn(&[usize]) -> f64) -> f64 {
    let without = |out: usize| of(&(0..points).filter(|i| *i != out).collect::<Vec<_>>());
    let values: Vec<f64> = (0..points).map(without).collect();
    statistics::jackknife(&values)
}

fn significance(z: f64, degrees_of_freedom: Option<usize>) -> Significance {
    let degrees = degrees_of_freedom.map_or(f64::INFINITY, |degrees| degrees as f64);
    Significance { z, probability: two_sided(z, degrees) }
}

fn level(ratio: f64, relative_error: Option<f64>, degrees_of_freedom: Option<usize>) -> Level {
    let error = relative_error.filter(|error| *error > 0.0);
    let significance = error.map(|error| significance(ratio.ln() / error, degrees_of_freedom));
    Level { ratio, relative_error, significance }
}

/// The relative standard error of a capacity, if it is not taken as exact.
fn relative(capacity: Capacity) -> Option<f64> {
    (capacity.deviation > 0.0).then(|| capacity.deviation / capacity.value)
}

/// The root of the sum of the squares of the known errors; `None` if none is known.
fn quadrature(errors: impl Iterator<Item = Option<f64>>) -> Option<f64> {
    let known: Vec<f64> = errors.flatten().collect();
    (!known.is_empty()).then(|| known.iter().map(|e| e * e).sum::<f64>().sqrt())
}
