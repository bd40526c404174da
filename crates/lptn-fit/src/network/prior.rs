//! Prior knowledge of unknowns, by the `±` of each and by their correlations.

use lptn_units::{Correlations, Distribution};

use crate::network::unknown::Unknown;

/// Prior knowledge of an unknown: one more measurement.
#[derive(Clone, Copy, Debug)]
struct Prior {
    /// Index of the unknown.
    place: usize,
    known: f64,
    sigma: f64,
    distribution: Distribution,
}

impl Prior {
    /// Prior of an unknown, if it has one.
    fn of((place, unknown): (usize, &Unknown)) -> Option<Self> {
        let distribution = unknown.distribution;
        Some(Self { place, known: unknown.own, sigma: unknown.prior?, distribution })
    }

    /// Distance of a value in standard deviations, and its derivative by the value; for a lognormal
    /// one, of its logarithm.
    fn residual(&self, value: f64) -> (f64, f64) {
        match self.distribution {
            Distribution::Normal | Distribution::Rectangle => {
                ((value - self.known) / self.sigma, 1.0 / self.sigma)
            }
            Distribution::Lognormal => {
                let sigma = self.sigma / self.known;
                ((value / self.known).ln() / sigma, 1.0 / (value * sigma))
            }
        }
    }
}

/// Prior knowledge of all unknowns together. With `r` for the distance of each in standard
/// deviations and `K = L L^T` for their correlations, `L^-1 r` are independent residuals of unit
/// variance: their sum of squares is `r^T K^-1 r`.
#[derive(Clone, Debug)]
pub(crate) struct Priors {
    all: Vec<Prior>,
    /// `L`, row by row.
    factor: Vec<f64>,
}

impl Priors {
    /// Priors of unknowns; the correlations are those of the first ones, the parameters. A fit
    /// refuses impossible ones ([`Correlations::factor`]); here they count as none.
    pub(crate) fn of(unknowns: &[Unknown], known: &Correlations) -> Self {
        let all: Vec<Prior> = unknowns.iter().enumerate().filter_map(Prior::of).collect();
        let together = Self::together(&all, known);
        let factor = together.factor().or_else(|_| Correlations::none(all.len()).factor());
        Self { all, factor: factor.unwrap_or_default() }
    }

    /// The first unknown that cannot have its correlations with those before it.
    pub(crate) fn impossible(unknowns: &[Unknown], known: &Correlations) -> Option<usize> {
        let all: Vec<Prior> = unknowns.iter().enumerate().filter_map(Prior::of).collect();
        Self::together(&all, known).factor().err().map(|row| all[row].place)
    }

    fn together(all: &[Prior], known: &Correlations) -> Correlations {
        let mut together = Correlations::none(all.len());
        for (row, a) in all.iter().enumerate() {
            for (column, b) in all[..row].iter().enumerate() {
                if a.place.max(b.place) < known.count() {
                    together.set(row, column, known.between(a.place, b.place));
                }
            }
        }
        together
    }

    /// Number of priors.
    pub(crate) fn count(&self) -> usize {
        self.all.len()
    }

    /// The independent residuals of these values of the unknowns.
    pub(crate) fn residuals(&self, values: &[f64]) -> Vec<f64> {
        self.independent(|prior| prior.residual(values[prior.place]).0)
    }

    /// Their derivatives by one unknown.
    pub(crate) fn slopes(&self, values: &[f64], unknown: usize) -> Vec<f64> {
        self.independent(|prior| match prior.place == unknown {
            true => prior.residual(values[unknown]).1,
            false => 0.0,
        })
    }

    /// Each residual with its derivatives by all unknowns.
    pub(crate) fn rows(&self, values: &[f64]) -> Vec<Vec<f64>> {
        let slopes: Vec<Vec<f64>> = (0..values.len()).map(|j| self.slopes(values, j)).collect();
        let row = |row: usize| slopes.iter().map(|slopes| slopes[row]).collect();
        (0..self.count()).map(row).collect()
    }

    /// `L^-1 r`, from the top.
    fn independent(&self, r: impl Fn(&Prior) -> f64) -> Vec<f64> {
        let n = self.count();
        let mut found = Vec::with_capacity(n);
        for (i, prior) in self.all.iter().enumerate() {
            let known: f64 = (0..i).map(|j| self.factor[i * n + j] * found[j]).sum();
            found.push((r(prior) - known) / self.factor[i * n + i]);
        }
        found
    }
}
