//! The coordinates in which a search moves.

use crate::network::unknown::Unknown;

/// For each unknown, its bounds and true if the search moves in its logarithm.
pub(crate) struct Coordinates {
    logarithmic: Vec<bool>,
    bounds: Vec<(f64, f64)>,
}

impl Coordinates {
    /// Takes logarithms if the bounds are positive: lines of constant products of powers are then
    /// straight. Without a least value the sign of a parameter is open.
    pub(crate) fn new(unknowns: &[Unknown]) -> Self {
        let logarithm = |unknown: &Unknown| !unknown.is_shift() && unknown.bounds.0 > 0.0;
        let logarithmic = unknowns.iter().map(logarithm).collect();
        let bounds = unknowns.iter().map(|unknown| unknown.bounds).collect();
        Self { logarithmic, bounds }
    }

    /// True if the search moves in the logarithm of this one.
    pub(crate) fn is_logarithmic(&self, j: usize) -> bool {
        self.logarithmic[j]
    }

    /// Values in SI units, and their derivatives by the coordinates.
    pub(crate) fn values(&self, p: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let value = |(j, &p): (usize, &f64)| {
            if self.logarithmic[j] { (self.inside(j, p.exp()), p.exp()) } else { (p, 1.0) }
        };
        p.iter().enumerate().map(value).unzip()
    }

    /// Rounding must not lead out of the bounds.
    fn inside(&self, j: usize, value: f64) -> f64 {
        value.max(self.bounds[j].0).min(self.bounds[j].1)
    }

    /// Coordinates of values in SI units.
    pub(crate) fn of(&self, values: &[f64]) -> Vec<f64> {
        values.iter().enumerate().map(|(j, &v)| self.one(j, v)).collect()
    }

    /// The coordinate of one value.
    pub(crate) fn one(&self, j: usize, value: f64) -> f64 {
        if self.logarithmic[j] { value.ln() } else { value }
    }

    /// The bounds of the coordinates.
    pub(crate) fn bounds(&self) -> Vec<(f64, f64)> {
        self.bounds
            .iter()
            .enumerate()
            .map(|(j, &(low, high))| (self.one(j, low), self.one(j, high)))
            .collect()
    }

    /// Values at shares (0 to 1) of the way between the bounds; parameters without both keep `own`.
    pub(crate) fn between(&self, shares: &[f64], own: &[f64]) -> Vec<f64> {
        let place = |(j, (low, high)): (usize, (f64, f64))| {
            if !(low.is_finite() && high.is_finite()) {
                return self.one(j, own[j]);
            }
            low + shares[j] * (high - low)
        };
        let p: Vec<f64> = self.bounds().into_iter().enumerate().map(place).collect();
        self.values(&p).0
    }

    /// True if a parameter has both bounds.
    pub(crate) fn is_bounded(&self, j: usize) -> bool {
        let (low, high) = self.bounds()[j];
        low.is_finite() && high.is_finite()
    }
}
