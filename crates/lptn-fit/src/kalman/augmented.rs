//! Estimates from all readings if parts of the first state are nearly unknown.
//!
//! A wide prior in a covariance costs digits: at the first moments the smoother removes nearly all
//! of it again. Here these parts are unknowns outside the covariance. The filter and the smoother
//! take them as 0. All prediction errors are linear in them, so least squares by QR determines them
//! (P. de Jong, The diffuse Kalman filter, Ann. Stat. 19 (1991) 1073). Variances are sums of
//! squares, and nothing cancels.

use faer::{Mat, MatRef};
use lptn_integrate::dense;
use lptn_integrate::vectors::{dot, norm};

use super::smoother::{Moved, Smoother, Told};
use super::{Weights, weighed};

/// A smoother that takes unknowns as 0, and the effect of each unknown.
#[derive(Clone, Debug)]
pub struct Augmented {
    known: Smoother,
    moves: Vec<Moved>,
    /// Triangle of the prediction errors: their change by each unknown, then the errors.
    felt: Mat<f64>,
    own: Unknowns,
}

/// Distribution of the unknowns, updated by all readings.
#[derive(Clone, Debug)]
pub struct Unknowns {
    /// Prior standard deviation of each, in its own standard deviations.
    factors: Vec<f64>,
    /// Triangle of the least squares with the priors, and the right side after it.
    triangle: Mat<f64>,
}

/// A sum of states at a moment: its distribution if all unknowns are 0, and its change by one
/// standard deviation of each.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    mean: f64,
    deviation: f64,
    by: Vec<f64>,
}

impl Augmented {
    /// `known` is a smoother with all unknowns at 0, and each of `roots` the change of the first
    /// state by one standard deviation of an unknown.
    pub fn new<'a>(known: Smoother, roots: impl IntoIterator<Item = &'a [f64]>) -> Self {
        let moves: Vec<Moved> = roots.into_iter().map(|root| known.moved(root)).collect();
        let deviations = known.deviations();
        let mut columns: Vec<f64> = Vec::with_capacity((moves.len() + 1) * deviations.len());
        for moved in &moves {
            // an unknown lowers the residual of a reading whose prediction it raises
            let all = moved.residuals.iter().flatten().zip(&deviations);
            columns.extend(all.map(|(residual, deviation)| -residual / deviation));
        }
        columns.extend(known.residuals().zip(&deviations).map(|(r, deviation)| r / deviation));
        let (rows, count) = (deviations.len(), moves.len() + 1);
        let felt = dense::triangle(MatRef::from_column_major_slice(&columns, rows, count));
        let own = Unknowns::of(&felt, vec![1.0; moves.len()]);
        Self { known, moves, felt, own }
    }

    /// The unknowns with prior deviations that are multiplied by factors; one with 0 is exactly 0.
    pub fn unknowns(&self, factors: Vec<f64>) -> Unknowns {
        Unknowns::of(&self.felt, factors)
    }

    /// The unknowns with their own prior deviations.
    pub fn own(&self) -> &Unknowns {
        &self.own
    }

    /// Visits the moments, last to first, with the estimate of each from all readings.
    pub fn backwards(&self, mut visit: impl FnMut(usize, &Estimate<'_>)) {
        let Self { moves, own, .. } = self;
        self.known.way_back(moves, |k, told, pulls| {
            visit(k, &Estimate { told, moves, pulls, k, own });
        });
    }
}

/// Estimate of a moment from all readings.
#[derive(Clone, Copy, Debug)]
pub struct Estimate<'a> {
    told: &'a Told<'a>,
    moves: &'a [Moved],
    pulls: &'a [Vec<f64>],
    k: usize,
    own: &'a Unknowns,
}

impl Estimate<'_> {
    /// The mean of a sum of states and its standard deviation.
    pub fn of(&self, weights: &Weights) -> (f64, f64) {
        self.own.known(&self.part(weights))
    }

    /// A sum of states as a function of the unknowns.
    pub fn part(&self, weights: &Weights) -> Part {
        let (mean, deviation) = self.told.of(weights);
        let spread = self.told.before.spread(weights);
        let both = self.moves.iter().zip(self.pulls);
        let by = both.map(|(m, pull)| weighed(weights, &m.means[self.k]) + dot(&spread, pull));
        Part { mean, deviation, by: by.collect() }
    }
}

impl Unknowns {
    fn of(felt: &Mat<f64>, factors: Vec<f64>) -> Self {
        let n = factors.len();
        let factor = |j: usize| factors.get(j).copied().unwrap_or(1.0);
        let both = Mat::from_fn(n + felt.nrows(), n + 1, |i, j| match i.checked_sub(n) {
            None if i == j => 1.0,
            None => 0.0,
            Some(row) => factor(j) * felt[(row, j)],
        });
        Self { triangle: dense::triangle(both.as_ref()), factors }
    }

    /// The mean of a part and its standard deviation.
    pub fn known(&self, part: &Part) -> (f64, f64) {
        let (share, n) = (self.share(part), self.factors.len());
        let mean: f64 = share.iter().enumerate().map(|(i, s)| s * self.triangle[(i, n)]).sum();
        (part.mean + mean, part.deviation.hypot(norm(&share)))
    }

    /// Movement of each unknown, in its own standard deviations, if a part moves by one standard
    /// deviation that the readings leave open.
    pub fn follow(&self, part: &Part) -> Vec<f64> {
        let (mut x, deviation) = (self.share(part), self.known(part).1);
        for i in (0..x.len()).rev() {
            let later: f64 = (i + 1..x.len()).map(|j| self.triangle[(i, j)] * x[j]).sum();
            x[i] = (x[i] - later) / self.triangle[(i, i)];
        }
        x.iter().zip(&self.factors).map(|(x, factor)| factor * x / deviation).collect()
    }

    /// The part as a sum of independent standard normal numbers.
    fn share(&self, part: &Part) -> Vec<f64> {
        let mut share: Vec<f64> = Vec::with_capacity(self.factors.len());
        for (i, (by, factor)) in part.by.iter().zip(&self.factors).enumerate() {
            let before = share.iter().enumerate();
            let before: f64 = before.map(|(j, s)| self.triangle[(j, i)] * s).sum();
            share.push((by * factor - before) / self.triangle[(i, i)]);
        }
        share
    }
}
