//! Likelihood of records with the values of a fit, and the test of its residuals for white noise.

use std::f64::consts::TAU;

use lptn_integrate::vectors::dot;

use crate::choice::Judged;
use crate::network::{ColumnMisfit, NetworkFit, NetworkFitTask, Priors};
use crate::noise::{Noise, stretches};

/// Number of lags in the test of whiteness.
pub const LAGS: usize = 10;

/// Minimum number of means of a column for its own noise.
const FEW: usize = 5;

/// Residual of runs that describe a column perfectly, in K (or another SI unit).
const ROUNDING: f64 = 1e-6;

/// Likelihood of the records with the values of a fit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Likely {
    /// Twice the negative logarithm of the likelihood of the means of all columns, with the most
    /// likely noise of each. Prior knowledge adds the squares of its deviations.
    pub misfit: f64,
    /// Number of means.
    pub means: usize,
    /// Number of unknowns.
    pub unknowns: usize,
    /// Numbers that describe the noise: one for each column of each record if it is white, three if
    /// neighbours are correlated.
    pub of_noise: usize,
    /// Akaike's criterion for few values; `None` if there are too few of them.
    pub aicc: Option<f64>,
}

/// Residuals of a column of a record in its SI unit (modelled - measured), with their times.
struct Means {
    column: usize,
    stretch: usize,
    times: Vec<f64>,
    missed: Vec<f64>,
}

impl Likely {
    /// Likelihood of the records with a fit.
    pub(crate) fn of(task: &NetworkFitTask, fit: &NetworkFit) -> Self {
        let all: Vec<Means> = fit.columns.iter().map(|column| Means::of(task, column)).collect();
        let means = all.iter().map(|one| one.count()).sum();
        let (mut misfit, mut of_noise) = (0.0, 0);
        for (own, numbers) in all.iter().filter_map(Means::likely).chain(together(&all)) {
            misfit += own;
            of_noise += numbers;
        }
        let unknowns = task.unknowns();
        let values: Vec<f64> = fit.parameters.iter().map(|fitted| fitted.value).collect();
        let off = Priors::of(&unknowns, &task.correlations).residuals(&values);
        misfit += off.iter().map(|off| off * off).sum::<f64>();
        let unknowns = unknowns.len();
        let aicc = aicc(misfit, means, unknowns + of_noise);
        Self { misfit, means, unknowns, of_noise, aicc }
    }
}

fn aicc(misfit: f64, values: usize, numbers: usize) -> Option<f64> {
    let left = values.checked_sub(numbers + 1).filter(|left| *left > 0)? as f64;
    let k = numbers as f64;
    Some(misfit + 2.0 * k + 2.0 * k * (k + 1.0) / left)
}

impl Means {
    /// Stretches depend on the number of values alone, so they are the same for every network.
    fn of(task: &NetworkFitTask, column: &ColumnMisfit) -> Self {
        let run = &task.runs[column.run];
        let values = &run.columns[column.column].values;
        let rows = run.times.iter().zip(values.iter().zip(&column.modelled));
        let rows = rows.filter(|(_, (value, _))| !value.is_nan());
        let (times, missed): (Vec<f64>, Vec<f64>) =
            rows.map(|(time, (value, modelled))| (*time, modelled - value)).unzip();
        let stretch = stretches::longest(times.len());
        Self { column: column.column, stretch, times, missed }
    }

    fn count(&self) -> usize {
        self.missed.len() / self.stretch
    }

    fn series(&self) -> Vec<f64> {
        stretches::means(&self.missed, self.stretch)
    }

    /// Twice the negative logarithm of its likelihood, and the number of noise parameters.
    fn likely(&self) -> Option<(f64, usize)> {
        let count = self.count();
        if count < FEW {
            return None;
        }
        let noise = Noise::of_stretches(&self.times, &self.missed, &[], self.stretch);
        let numbers = if noise.means.time > 0.0 { 3 } else { 1 };
        // constants of the number of means, so that it is the logarithm itself
        let n = count as f64;
        Some((least(noise.means.misfit, n) + n * (1.0 + (TAU / n).ln()), numbers))
    }
}

/// Sets a floor to a misfit: a perfect fit does not prove an infinite likelihood.
fn least(misfit: f64, n: f64) -> f64 {
    misfit.max(n * (n * ROUNDING * ROUNDING).ln())
}

/// Columns of few values: white noise of one deviation for each column of all records.
fn together(all: &[Means]) -> Vec<(f64, usize)> {
    let few = || all.iter().filter(|one| one.count() < FEW);
    let columns = few().map(|one| one.column).max().map_or(0, |most| most + 1);
    let one = |column: usize| {
        let own = few().filter(|one| one.column == column);
        let missed: Vec<f64> = own.flat_map(Means::series).collect();
        let n = missed.len() as f64;
        let squares: f64 = missed.iter().map(|e| e * e).sum();
        (n > 0.0).then(|| (least(n * squares.ln(), n) + n * (1.0 + (TAU / n).ln()), 1))
    };
    (0..columns).filter_map(one).collect()
}

/// The share of each network in the likelihood of all: exp(-d / 2), with the distance d of its
/// criterion from the least (K. P. Burnham, D. R. Anderson, Model Selection and Multimodel Inference,
/// 2nd edition, Springer 2002, section 2.9).
pub(crate) fn weights(judged: &[Judged]) -> Vec<Option<f64>> {
    let all: Option<Vec<f64>> = judged.iter().map(|one| one.likely.aicc).collect();
    let Some(all) = all else { return vec![None; judged.len()] };
    let least = all.iter().copied().fold(f64::INFINITY, f64::min);
    let shares: Vec<f64> = all.iter().map(|aicc| (-0.5 * (aicc - least)).exp()).collect();
    let sum: f64 = shares.iter().sum();
    shares.iter().map(|share| Some(share / sum)).collect()
}

/// The test of Ljung and Box for autocorrelation of the residuals of a column.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Whiteness {
    /// The sum over its records of n (n + 2) sum of `r_k^2 / (n - k)` over [`LAGS`] lags, with the
    /// autocorrelation `r_k` of the n means of a record.
    pub statistic: f64,
    /// Degrees of freedom: [`LAGS`] for each record.
    pub degrees: usize,
    /// The probability that white noise has a greater statistic (chi-square).
    pub p: f64,
}

/// The test for each column; `None` if no record has twice as many means as lags.
pub(crate) fn whiteness(task: &NetworkFitTask, fit: &NetworkFit) -> Vec<Option<Whiteness>> {
    let all: Vec<Means> = fit.columns.iter().map(|column| Means::of(task, column)).collect();
    let columns = task.runs.first().map_or(0, |run| run.columns.len());
    let of = |column: usize| {
        let own = all.iter().filter(|one| one.column == column && one.count() >= 2 * LAGS);
        let statistics: Vec<f64> = own.map(|one| ljung_box(&one.series())).collect();
        let (statistic, degrees) = (statistics.iter().sum(), LAGS * statistics.len());
        (degrees > 0).then(|| Whiteness { statistic, degrees, p: beyond(statistic, degrees) })
    };
    (0..columns).map(of).collect()
}

fn ljung_box(values: &[f64]) -> f64 {
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    let off: Vec<f64> = values.iter().map(|value| value - mean).collect();
    let product = |lag: usize| dot(&off, &off[lag..]);
    let variance = product(0);
    if variance <= 0.0 {
        return 0.0;
    }
    let term = |lag: usize| (product(lag) / variance).powi(2) / (n - lag as f64);
    n * (n + 2.0) * (1..=LAGS).map(term).sum::<f64>()
}

/// The probability that chi-square with an even number of degrees of freedom is greater: that of
/// fewer than half as many events of Poisson's distribution.
fn beyond(statistic: f64, degrees: usize) -> f64 {
    let half = 0.5 * statistic;
    if half <= 0.0 {
        return 1.0;
    }
    let (mut term, mut sum) = (-half, 0.0);
    for k in 1..=degrees / 2 {
        sum += term.exp();
        term += (half / k as f64).ln();
    }
    sum.min(1.0)
}
