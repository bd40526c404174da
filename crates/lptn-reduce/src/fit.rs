//! One exponential through a record.

use crate::error::FitError;

/// The curve `T_i + (T_f - T_i)(1 - exp(-t / tau))` that is nearest to a record by least squares.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExponentialFit {
    /// Temperature of the curve at time 0, in the unit of the record.
    pub initial: f64,
    /// Temperature that the curve tends to, in the unit of the record.
    pub settled: f64,
    /// Time constant in s.
    pub tau: f64,
    /// Square root of the mean square of what the curve misses.
    pub rms: f64,
}

/// Fits `T_i`, `T_f` and `tau` to temperatures at ascending times in s, counted from time 0.
///
/// By variable projection (G. H. Golub and V. Pereyra, SIAM J. Numer. Anal. 10 (1973) 413): for a given `tau` the
/// other two are linear; `tau` is sought on a grid over all scales of the record and then by Gauss-Newton steps
/// in its logarithm, without the term of the derivative that vanishes with the residual (L. Kaufman, BIT 15 (1975) 49).
///
/// # Errors
/// [`FitError`], in particular where the record does not bend.
pub fn fit_exponential(times: &[f64], temperatures: &[f64]) -> Result<ExponentialFit, FitError> {
    let record = Record::new(times, temperatures)?;
    let mut log_tau = record.search()?;
    let mut best = record.project(log_tau);
    for _ in 0..50 {
        let step = record.step(log_tau, &best).clamp(-0.5, 0.5);
        let next = record.project(log_tau + step);
        if next.squares > best.squares || !step.is_finite() {
            break;
        }
        log_tau += step;
        best = next;
        if step.abs() < 1e-13 {
            break;
        }
    }
    let rms = (best.squares / record.count()).sqrt();
    Ok(ExponentialFit { initial: best.initial, settled: best.initial + best.rise, tau: log_tau.exp(), rms })
}

struct Record<'a> {
    times: &'a [f64],
    temperatures: &'a [f64],
}

/// The best curve for one time constant.
struct Projected {
    initial: f64,
    rise: f64,
    /// Sum of the squares of what it misses.
    squares: f64,
}

impl<'a> Record<'a> {
    fn new(times: &'a [f64], temperatures: &'a [f64]) -> Result<Self, FitError> {
        if times.len() < 4 || times.len() != temperatures.len() {
            return Err(FitError::TooFew { points: times.len().min(temperatures.len()) });
        }
        let finite = times.iter().chain(temperatures).all(|x| x.is_finite());
        if !finite || times.windows(2).any(|pair| pair[0] >= pair[1]) {
            return Err(FitError::NotARecord);
        }
        let first = temperatures[0];
        let largest = temperatures.iter().fold(0.0, |most: f64, t| most.max((t - first).abs()));
        if largest <= 1e-12 * first.abs() {
            return Err(FitError::Flat);
        }
        Ok(Self { times, temperatures })
    }

    #[expect(clippy::cast_precision_loss, reason = "records are shorter than 2^52")]
    fn count(&self) -> f64 {
        self.times.len() as f64
    }

    /// The logarithm of the best time constant of a grid, from a tenth of the shortest distance of two points to
    /// a thousand times the length.
    fn search(&self) -> Result<f64, FitError> {
        let shortest = self.times.windows(2).map(|pair| pair[1] - pair[0]).fold(f64::INFINITY, f64::min);
        let from = (0.1 * shortest).ln();
        let to = (1e3 * (self.times[self.times.len() - 1] - self.times[0])).ln();
        let count = 300;
        let at = |k: i32| from + (to - from) * f64::from(k) / f64::from(count);
        let squares = |k: i32| self.project(at(k)).squares;
        let best = (0..=count).min_by(|a, b| squares(*a).total_cmp(&squares(*b))).unwrap_or(0);
        if best == 0 || best == count {
            return Err(FitError::NoCurvature { tau: at(best).exp() });
        }
        Ok(at(best))
    }

    /// `1 - exp(-t / tau)`.
    fn shape(&self, log_tau: f64) -> impl Iterator<Item = f64> {
        let tau = log_tau.exp();
        self.times.iter().map(move |t| -f64::exp_m1(-t / tau))
    }

    fn project(&self, log_tau: f64) -> Projected {
        let (initial, rise) = self.line(log_tau, self.temperatures.iter().copied());
        let misses = self.temperatures.iter().zip(self.shape(log_tau)).map(|(t, s)| t - initial - rise * s);
        Projected { initial, rise, squares: misses.map(|m| m * m).sum() }
    }

    /// Offset and factor of the shape that are nearest to `values`.
    fn line(&self, log_tau: f64, values: impl Iterator<Item = f64> + Clone) -> (f64, f64) {
        let n = self.count();
        let mean_shape = self.shape(log_tau).sum::<f64>() / n;
        let mean = values.clone().sum::<f64>() / n;
        let (mut square, mut product) = (0.0, 0.0);
        for (s, v) in self.shape(log_tau).zip(values) {
            square += (s - mean_shape) * (s - mean_shape);
            product += (s - mean_shape) * (v - mean);
        }
        let factor = if square > 0.0 { product / square } else { 0.0 };
        (mean - factor * mean_shape, factor)
    }

    /// The Gauss-Newton step of the logarithm: what is missed against the part of the derivative that offset and
    /// factor cannot follow.
    fn step(&self, log_tau: f64, at: &Projected) -> f64 {
        let tau = log_tau.exp();
        let slope = self.times.iter().map(|t| -at.rise * (t / tau) * (-t / tau).exp());
        let (offset, factor) = self.line(log_tau, slope.clone());
        let (mut square, mut product) = (0.0, 0.0);
        for ((slope, shape), t) in slope.zip(self.shape(log_tau)).zip(self.temperatures) {
            let free = slope - offset - factor * shape;
            square += free * free;
            product += free * (t - at.initial - at.rise * shape);
        }
        product / square
    }
}
