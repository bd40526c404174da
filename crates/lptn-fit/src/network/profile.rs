//! Intervals of parameters that the records bound on one side only.
//!
//! A standard error is a slope at the minimum. If a positive parameter is known to no better than
//! its own size, the sum of squares is not a parabola over the interval, and value ± error contains
//! impossible numbers. Here the parameter is fixed, the others are fitted again, and the interval
//! ends when the sum of squares S has risen by `q^2` of its own curvature at the minimum
//!
//! ```text
//! S(p) - S_min = (q error)^2 / [(J^T J)^-1]_pp
//! ```
//!
//! (profile likelihood: D. M. Bates, D. G. Watts, Nonlinear Regression Analysis and Its
//! Applications, Wiley 1988, section 6.1). `error` is the standard error with the correlation of
//! the residuals in it and `q` the quantile of Student's t, so that for a linear model the interval
//! is value ± q error exactly.
//!
//! Only values whose ± half interval contains impossible numbers are profiled, because each end
//! costs some ten fits. The rise of the sum of squares is scaled by the sandwich over `(J^T J)^-1`,
//! so that correlation of residuals counts.

use crate::least_squares::{Residuals, Settings, minimise};
use crate::network::coordinates::Coordinates;
use crate::network::holding::Holding;
use crate::network::model::Model;
use crate::network::unknown::Unknown;

/// Logarithm of the largest factor by which a value is followed.
const FAR: f64 = 12.0;

/// A value below this part of half its interval is followed upwards from 0 in units of that half:
/// no factor of it gives the end of the interval.
const NOTHING: f64 = 1e-3;

/// Accuracy of the sum of squares at the end of the interval, in parts of its rise.
const NEAR: f64 = 1e-4;

/// The ends of a 95 % interval, in SI units; `None` if the records, and the bounds, leave it open.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Profile {
    /// The least value that the records leave possible.
    pub low: Option<f64>,
    /// The greatest.
    pub high: Option<f64>,
}

/// True if value ± half contains impossible values: numbers beyond a bound, or below 0 for a
/// positive parameter.
pub(crate) fn misleads(unknown: &Unknown, value: f64, half: f64) -> bool {
    let least = unknown.bounds.0.max(0.0);
    !unknown.is_shift()
        && value > 0.0
        && (value - half <= least || value + half >= unknown.bounds.1)
}

/// End of the search, in its coordinates.
pub(crate) struct End<'e> {
    pub(crate) coordinates: &'e Coordinates,
    pub(crate) unknowns: &'e [Unknown],
    pub(crate) parameters: &'e [f64],
    pub(crate) values: &'e [f64],
    pub(crate) squares: f64,
}

/// Rise of the sum of squares at the ends of an interval.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rise {
    /// The rise.
    pub(crate) of: f64,
    /// Half the interval if the sum of squares were the parabola of its minimum.
    pub(crate) half: f64,
}

/// The interval of one parameter, within which the sum of squares rises by `rise`.
pub(crate) fn profile(
    model: &mut Model<'_>,
    end: &End<'_>,
    (place, rise): (usize, Rise),
) -> Profile {
    let mut side = |sign: f64| Walk::new(model, end, (place, rise)).end(sign);
    Profile { low: side(-1.0), high: side(1.0) }
}

/// One way from the minimum along a parameter.
struct Walk<'w, 'a, 'e> {
    model: &'w mut Model<'a>,
    end: &'w End<'e>,
    place: usize,
    rise: Rise,
    /// Last coordinates of the others.
    others: Vec<f64>,
}

impl<'w, 'a, 'e> Walk<'w, 'a, 'e> {
    fn new(model: &'w mut Model<'a>, end: &'w End<'e>, (place, rise): (usize, Rise)) -> Self {
        let mut others = end.parameters.to_vec();
        others.remove(place);
        Self { model, end, place, rise, others }
    }

    /// The value at which the sum of squares has risen, in steps that double and then by false
    /// position (the Illinois rule). `None` if a bound or [`FAR`] comes first, or without a run.
    fn end(mut self, sign: f64) -> Option<f64> {
        let most = self.most(sign)?;
        let mut inside = (0.0, -1.0);
        let mut step: f64 = 0.125;
        let mut outside = loop {
            let at = (inside.0 + step).min(most);
            let excess = self.excess(self.at(sign * at))?;
            if excess > 0.0 {
                break (at, excess);
            }
            if at >= most {
                return None;
            }
            (inside, step) = ((at, excess), 2.0 * step);
        };
        for _ in 0..40 {
            let at = (inside.0 * outside.1 - outside.0 * inside.1) / (outside.1 - inside.1);
            let excess = self.excess(self.at(sign * at))?;
            if excess.abs() < NEAR || outside.0 - inside.0 < 1e-9 {
                return Some(self.at(sign * at));
            }
            if excess > 0.0 {
                outside = (at, excess);
                inside.1 *= 0.5;
            } else {
                inside = (at, excess);
                outside.1 *= 0.5;
            }
        }
        Some(self.at(sign * outside.0))
    }

    /// Distance to a bound, at most [`FAR`]; `None` if the value is at the bound.
    fn most(&self, sign: f64) -> Option<f64> {
        let (low, high) = self.end.unknowns[self.place].bounds;
        let bound = if sign < 0.0 { low } else { high };
        let value = self.end.values[self.place];
        if self.is_nothing() {
            return (sign > 0.0).then(|| ((bound - value) / self.rise.half).ln_1p().min(FAR));
        }
        Some(if bound > 0.0 { (bound / value).ln().abs().min(FAR) } else { FAR })
    }

    /// The value at a distance: the logarithm of a factor, or of a number of halves plus one.
    fn at(&self, along: f64) -> f64 {
        let value = self.end.values[self.place];
        match self.is_nothing() {
            true => value + self.rise.half * along.exp_m1(),
            false => value * along.exp(),
        }
    }

    fn is_nothing(&self) -> bool {
        let least = self.end.unknowns[self.place].bounds.0;
        least <= 0.0 && self.end.values[self.place] < NOTHING * self.rise.half
    }

    /// Rise of the sum of squares beyond `rise`, in units of it, with the parameter fixed.
    fn excess(&mut self, value: f64) -> Option<f64> {
        let mut bounds = self.end.coordinates.bounds();
        bounds.remove(self.place);
        let settings = Settings {
            bounds,
            gradient: 1e-6,
            step: 1e-9,
            error: self.model.error(),
            iterations: 100,
            ..Settings::default()
        };
        let at = self.end.coordinates.one(self.place, value);
        let mut held = Holding { model: &mut *self.model, held: vec![(self.place, at)] };
        let squares = if self.others.is_empty() {
            held.evaluate(&[], false).ok()?.0.iter().map(|r| r * r).sum()
        } else {
            let found = minimise(&mut held, &self.others, &settings).ok()?;
            self.others = found.parameters;
            found.squares
        };
        let excess = (squares - self.end.squares) / self.rise.of - 1.0;
        excess.is_finite().then_some(excess)
    }
}
