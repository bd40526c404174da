//! Sum of exponentials through a step response: the R-tau table of a curve of thermal impedance.
//!
//! `y(t) = y_0 + sum of A_i (1 - exp(-t / tau_i))`, all `A_i` of one sign, by least squares in the
//! logarithms of `A_i` and `tau_i`. `y_0` is known (0 for an impedance) or fitted. The sum of
//! squares has several minima, so each number of terms is searched from several starts: time
//! constants at equal ratios over the record, and those of one term less with one of them split.
//!
//! The number of terms is given, or that of the least AICc, `N ln(S / N) + 2 k + 2 k (k + 1) / (N -
//! k - 1)` with `S` the sum of squares and `k` the number of parameters and 1 (C. M. Hurvich and
//! C.-L. Tsai, Biometrika 76 (1989) 297).

use lptn_units::Class;

use super::{Estimated, Random};
use crate::least_squares::{Evaluated, LeastSquaresFit, Residuals, Settings, minimise};
use crate::noise::Noise;

/// Most terms that are fitted.
pub const MOST_TERMS: usize = 12;

/// Starts whose time constants are split from those of one term less.
const SPLITS: [f64; 3] = [0.1, 0.5, 2.0];

/// Logarithm of the ratio of two time constants that are one.
const SAME: f64 = 0.1;

lptn_units::errors! {
/// Reasons why a record has no sum of exponentials.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TermsError {
    /// Times and values differ in number, or the times do not ascend.
    Record = "fit::not_a_record", "the record has no ascending times with a value each";
    /// The number of terms is not from 1 to [`MOST_TERMS`].
    Count { count: usize } = "fit::terms_count",
        format!("{count} terms cannot be fitted: it is a number from 1 to {MOST_TERMS}"),
        help "write --terms 4, or --terms auto";
    /// Fewer samples than the terms need.
    Few { points: usize, terms: usize, needed: usize } = "fit::terms_points",
        format!("{points} samples after the first do not determine {terms} terms: {needed} would"),
        help "fit fewer terms, or measure more points in each decade of time";
    /// The record does not determine that many terms: two are one, or one of them is outside.
    Undetermined { terms: usize, most: usize } = "fit::terms_undetermined",
        format!("the record does not determine {terms} terms"),
        help match most {
            0 => "is there a step in it? the record has to bend as an exponential does".to_owned(),
            most => format!("it determines {most}: --terms {most}"),
        },
        class Class::Numbers;
}
}

/// A step response.
#[derive(Clone, Copy, Debug)]
pub struct StepCurve<'a> {
    /// Times after the step in s, ascending.
    pub times: &'a [f64],
    /// Values at these times; NaN if there is none.
    pub values: &'a [f64],
    /// The value at time 0, if it is known.
    pub start: Option<f64>,
}

/// A positive number with its error, which is one of its logarithm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PositiveEstimate {
    /// The number.
    pub value: f64,
    /// Its standard error.
    pub standard_error: f64,
    /// The standard error if every sample were independent of the others.
    pub naive: f64,
    /// The 95 % interval.
    pub interval: (f64, f64),
}

/// A term.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TermEstimate {
    /// Size of `A`, in the unit of the values.
    pub amplitude: PositiveEstimate,
    /// `tau` in s.
    pub tau: PositiveEstimate,
}

/// The best sum with a number of terms.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TermsTried {
    /// Number of terms.
    pub terms: usize,
    /// Root mean square of the residuals, in the unit of the values.
    pub rms: f64,
    /// Largest residual.
    pub largest: f64,
    /// AICc.
    pub criterion: f64,
    /// False if the record does not determine all of them.
    pub determined: bool,
}

/// A sum of exponentials through a step response.
#[derive(Clone, Debug, PartialEq)]
pub struct ExponentialSum {
    /// `y_0`, if it was fitted.
    pub start: Option<Estimated>,
    /// The terms, fastest first.
    pub terms: Vec<TermEstimate>,
    /// The sum of the sizes of all `A`.
    pub settled: Estimated,
    /// 1 if the values rise, -1 if they fall.
    pub sign: f64,
    /// Number of samples that were fitted.
    pub samples: usize,
    /// The numbers of terms that were tried, this one included.
    pub tried: Vec<TermsTried>,
    /// The known or fitted value at time 0.
    from: f64,
}

impl ExponentialSum {
    /// Fits `count` terms; with `None` the number of the least AICc.
    ///
    /// # Errors
    /// [`TermsError`]
    pub fn new(curve: StepCurve<'_>, count: Option<usize>) -> Result<Self, TermsError> {
        let search = Search::of(curve)?;
        let most = search.most();
        if let Some(count) = count {
            if count == 0 || count > MOST_TERMS {
                return Err(TermsError::Count { count });
            }
            if count > most {
                let (points, needed) = (search.times.len(), search.needed(count));
                return Err(TermsError::Few { points, terms: count, needed });
            }
        }
        if most == 0 {
            let (points, needed) = (search.times.len(), search.needed(1));
            return Err(TermsError::Few { points, terms: 1, needed });
        }
        let fits = search.all(count.unwrap_or(most), count.is_some());
        let tried: Vec<TermsTried> = fits.iter().map(|fit| search.tried(fit)).collect();
        let determined = || (0..fits.len()).filter(|&i| tried[i].determined);
        let chosen = match count {
            Some(count) => determined().find(|&i| tried[i].terms == count),
            None => determined().min_by(|&i, &j| tried[i].criterion.total_cmp(&tried[j].criterion)),
        };
        let most = determined().next_back().map_or(0, |i| tried[i].terms);
        let refused = TermsError::Undetermined { terms: count.unwrap_or(1), most };
        let found = chosen.and_then(|i| search.answer(&fits[i])).ok_or(refused)?;
        Ok(Self { tried, ..found })
    }

    /// The curve at a time in s after the step.
    pub fn at(&self, time: f64) -> f64 {
        let part = |term: &TermEstimate| term.amplitude.value * -(-time / term.tau.value).exp_m1();
        self.from + self.sign * self.terms.iter().map(part).sum::<f64>()
    }

    /// The choice among the numbers that were tried.
    pub fn chosen(&self) -> Option<&TermsTried> {
        self.tried.iter().find(|tried| tried.terms == self.terms.len())
    }
}

/// The samples after the step, and the direction in which they go.
struct Search {
    times: Vec<f64>,
    values: Vec<f64>,
    start: Option<f64>,
    sign: f64,
    /// Size of the whole change.
    change: f64,
}

impl Search {
    fn of(curve: StepCurve<'_>) -> Result<Self, TermsError> {
        let ascends = curve.times.windows(2).all(|pair| pair[0] < pair[1]);
        if curve.times.len() != curve.values.len() || !ascends {
            return Err(TermsError::Record);
        }
        // a known start is not a sample: its residual is 0 whatever the terms are
        let after = |time: f64| if curve.start.is_some() { time > 0.0 } else { time >= 0.0 };
        let rows = curve.times.iter().zip(curve.values);
        let rows = rows.filter(|(time, value)| after(**time) && value.is_finite());
        let (times, values): (Vec<f64>, Vec<f64>) = rows.unzip();
        let first = curve.start.or(values.first().copied()).unwrap_or(0.0);
        let change = values.last().map_or(0.0, |last| last - first);
        let sign = if change < 0.0 { -1.0 } else { 1.0 };
        let change = change.abs().max(f64::MIN_POSITIVE);
        Ok(Self { times, values, start: curve.start, sign, change })
    }

    /// Number of parameters of some terms.
    fn parameters_of(&self, terms: usize) -> usize {
        2 * terms + usize::from(self.start.is_none())
    }

    /// Samples with which the criterion exists.
    fn needed(&self, terms: usize) -> usize {
        self.parameters_of(terms) + 3
    }

    fn most(&self) -> usize {
        (1..=MOST_TERMS).rev().find(|&n| self.needed(n) <= self.times.len()).unwrap_or(0)
    }

    /// Times of the first and last sample after 0.
    fn ends(&self) -> (f64, f64) {
        let first = self.times.iter().copied().find(|time| *time > 0.0).unwrap_or(1.0);
        (first, self.times.last().copied().unwrap_or(first).max(first))
    }

    /// The best sums of 1, 2, … terms. Unless all are asked for, the search ends after two numbers
    /// that are worse than the best.
    fn all(&self, most: usize, whole: bool) -> Vec<LeastSquaresFit> {
        let mut fits: Vec<LeastSquaresFit> = Vec::new();
        for terms in 1..=most {
            let Some(fit) = self.best(terms, fits.last()) else { break };
            fits.push(fit);
            let criteria: Vec<f64> = fits.iter().map(|fit| self.tried(fit).criterion).collect();
            let least = criteria.iter().copied().fold(f64::INFINITY, f64::min);
            if !whole && criteria.iter().rev().take(2).filter(|c| **c > least).count() == 2 {
                break;
            }
        }
        fits
    }

    /// The lowest minimum of the searches from all starts.
    fn best(&self, terms: usize, before: Option<&LeastSquaresFit>) -> Option<LeastSquaresFit> {
        let mut starts = vec![self.even(terms, 1.0), self.even(terms, 0.6)];
        if let Some(before) = before {
            let split = |term| SPLITS.map(|ratio| self.split(&before.parameters, term, ratio));
            starts.extend((0..terms - 1).flat_map(split));
        }
        let found = starts.iter().filter_map(|start| self.fitted(start));
        found.min_by(|a, b| a.squares.total_cmp(&b.squares))
    }

    /// Equal terms at equal ratios over a part of the record, in logarithms.
    fn even(&self, terms: usize, part: f64) -> Vec<f64> {
        let (first, last) = self.ends();
        let (middle, width) = ((first * last).sqrt().ln(), (last / first).ln() * part);
        let place = |k: usize| (k as f64 + 0.5) / terms as f64 - 0.5;
        let amplitudes = (0..terms).map(|_| (self.change / terms as f64).ln());
        let taus = (0..terms).map(|k| middle + width * place(k));
        amplitudes.chain(taus).chain(self.first()).collect()
    }

    fn first(&self) -> Option<f64> {
        self.start.is_none().then(|| self.values.first().copied().unwrap_or(0.0))
    }

    /// A term halved, and one of the halves moved by a ratio.
    fn split(&self, old: &[f64], term: usize, ratio: f64) -> Vec<f64> {
        let terms = (old.len() - usize::from(self.start.is_none())) / 2;
        let (mut new, half) = (old.to_vec(), old[term] - 2_f64.ln());
        new[term] = half;
        new.insert(2 * terms, old[terms + term] + f64::ln(ratio));
        new.insert(terms, half);
        new
    }

    fn fitted(&self, start: &[f64]) -> Option<LeastSquaresFit> {
        let terms = start.len() / 2;
        let (first, last) = self.ends();
        let amplitude = ((1e-6 * self.change).ln(), (100.0 * self.change).ln());
        let tau = ((0.05 * first).ln(), (50.0 * last).ln());
        let free = (f64::NEG_INFINITY, f64::INFINITY);
        let bounds = std::iter::repeat_n(amplitude, terms).chain(std::iter::repeat_n(tau, terms));
        let bounds: Vec<_> = bounds.chain(self.first().map(|_| free)).collect();
        let inside = |(p, (low, high)): (&f64, &(f64, f64))| p.clamp(*low, *high);
        let start: Vec<f64> = start.iter().zip(&bounds).map(inside).collect();
        let settings = Settings { bounds, iterations: 200, ..Settings::default() };
        let mut sum = Sum { search: self, terms };
        minimise(&mut sum, &start, &settings).ok()
    }

    fn tried(&self, fit: &LeastSquaresFit) -> TermsTried {
        let terms = fit.parameters.len() / 2;
        let (count, k) = (self.times.len() as f64, self.parameters_of(terms) as f64 + 1.0);
        let largest = fit.residuals.iter().fold(0.0, |most: f64, r| most.max(r.abs()));
        let misfit = count * (fit.squares.max(f64::MIN_POSITIVE) / count).ln();
        let criterion = misfit + 2.0 * k + 2.0 * k * (k + 1.0) / (count - k - 1.0);
        let rms = (fit.squares / count).sqrt();
        TermsTried { terms, rms, largest, criterion, determined: self.is_determined(fit, terms) }
    }

    /// True if the search converged away from every bound, and no two terms are one.
    fn is_determined(&self, fit: &LeastSquaresFit, terms: usize) -> bool {
        let mut taus = fit.parameters[terms..2 * terms].to_vec();
        taus.sort_by(f64::total_cmp);
        let apart = taus.windows(2).all(|pair| pair[1] - pair[0] > SAME);
        let free = fit.on_bound.iter().all(Option::is_none);
        apart && free && fit.outcome.converged() && fit.covariance().is_some()
    }

    fn answer(&self, fit: &LeastSquaresFit) -> Option<ExponentialSum> {
        let (p, terms) = (&fit.parameters, fit.parameters.len() / 2);
        let noise = Noise::estimate(&self.times, &fit.residuals, &fit.jacobian);
        let random = Random::new(&self.times, &fit.jacobian, &noise)?;
        let along = |of: &dyn Fn(usize) -> f64| (0..p.len()).map(of).collect::<Vec<f64>>();
        let at = |j: usize, value: f64| {
            random.estimated(value, &along(&|k| if k == j { 1.0 } else { 0.0 }))
        };
        let positive = |j: usize| PositiveEstimate::of(&at(j, p[j]));
        let term = |k| TermEstimate { amplitude: positive(k), tau: positive(terms + k) };
        let mut found: Vec<TermEstimate> = (0..terms).map(term).collect();
        found.sort_by(|a, b| a.tau.value.total_cmp(&b.tau.value));
        let slopes = along(&|k| if k < terms { p[k].exp() } else { 0.0 });
        let start = self.start.is_none().then(|| at(2 * terms, p[2 * terms]));
        Some(ExponentialSum {
            from: self.start.unwrap_or_else(|| p[2 * terms]),
            start,
            terms: found,
            settled: random.estimated(p[..terms].iter().map(|a| a.exp()).sum(), &slopes),
            sign: self.sign,
            samples: self.times.len(),
            tried: Vec::new(),
        })
    }
}

impl PositiveEstimate {
    /// From the estimate of its logarithm.
    fn of(log: &Estimated) -> Self {
        let value = log.value.exp();
        let interval = (value * (-log.half_width).exp(), value * log.half_width.exp());
        let (standard_error, naive) = (value * log.standard_error, value * log.naive);
        Self { value, standard_error, naive, interval }
    }

    /// The number over a positive divisor.
    #[must_use]
    pub fn over(self, divisor: f64) -> Self {
        let (low, high) = self.interval;
        Self {
            value: self.value / divisor,
            standard_error: self.standard_error / divisor,
            naive: self.naive / divisor,
            interval: (low / divisor, high / divisor),
        }
    }
}

/// A sum of terms; the parameters are the logarithms of all `A`, those of all `tau`, and `y_0`.
struct Sum<'a> {
    search: &'a Search,
    terms: usize,
}

impl Residuals for Sum<'_> {
    fn parameters(&self) -> usize {
        self.search.parameters_of(self.terms)
    }

    fn evaluate(&mut self, p: &[f64], derivatives: bool) -> Evaluated {
        let (search, n) = (self.search, self.terms);
        let from = search.start.unwrap_or_else(|| p[2 * n]);
        let mut residuals: Vec<f64> = search.values.iter().map(|value| from - value).collect();
        let mut jacobian = Vec::new();
        let mut by_tau = Vec::new();
        for k in 0..n {
            let (amplitude, tau) = (search.sign * p[k].exp(), p[n + k].exp());
            for (time, residual) in search.times.iter().zip(&mut residuals) {
                let decay = (-time / tau).exp();
                let part = amplitude * -(-time / tau).exp_m1();
                *residual += part;
                if derivatives {
                    jacobian.push(part);
                    by_tau.push(-amplitude * decay * time / tau);
                }
            }
        }
        if derivatives {
            jacobian.extend(by_tau);
            if search.start.is_none() {
                jacobian.extend(std::iter::repeat_n(1.0, search.times.len()));
            }
        }
        Ok((residuals, jacobian))
    }
}
