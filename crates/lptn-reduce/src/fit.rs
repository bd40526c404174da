//! One exponential through a record.

use lptn_units::statistics::mean;

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
    /// Root mean square of the residual, in the unit of the record.
    pub rms: f64,
}

/// Fits `T_i`, `T_f` and `tau` to temperatures at ascending times in s, counted from time 0.
///
/// By variable projection (G. H. Golub and V. Pereyra, SIAM J. Numer. Anal. 10 (1973) 413): for a
/// given `tau` the other two are linear. `tau` is found on a grid over all scales of the record,
/// then by Gauss-Newton steps in its logarithm, without the term of the derivative that vanishes
/// with the residual (L. Kaufman, BIT 15 (1975) 49).
///
/// # Errors
/// [`FitError`], in particular if the record does not bend.
pub fn fit_exponential(times: &[f64], temperatures: &[f64]) -> Result<ExponentialFit, FitError> {
    let record = Record::new(times, temperatures)?;
    let (log_tau, best) = record.refined(record.search()?);
    let (tau, rms) = (log_tau.exp(), (best.squares / record.count()).sqrt());
    let initial = best.initial - best.rise * (record.first / tau).exp_m1();
    if !initial.is_finite() {
        return Err(FitError::NoCurvature { tau });
    }
    Ok(ExponentialFit { initial, settled: best.initial + best.rise, tau, rms })
}

struct Record<'a> {
    times: &'a [f64],
    /// The first time in s. Shapes begin there: far after time 0 only rounding would be left of
    /// them.
    first: f64,
    temperatures: &'a [f64],
}

/// The best curve for one time constant.
struct Projected {
    /// At the first point.
    initial: f64,
    rise: f64,
    /// `1 - exp(-t / tau)`, t from the first point on.
    shape: Vec<f64>,
    /// Sum of the squares of the residual.
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
        Ok(Self { times, first: times[0], temperatures })
    }

    #[expect(clippy::cast_precision_loss, reason = "records are shorter than 2^52")]
    fn count(&self) -> f64 {
        self.times.len() as f64
    }

    /// The minimum near a logarithm of the time constant.
    fn refined(&self, mut log_tau: f64) -> (f64, Projected) {
        let mut best = self.project(log_tau);
        for _ in 0..50 {
            let step = self.step(log_tau, &best).clamp(-0.5, 0.5);
            let next = self.project(log_tau + step);
            if next.squares > best.squares || !step.is_finite() {
                break;
            }
            log_tau += step;
            best = next;
            if step.abs() < 1e-13 {
                break;
            }
        }
        (log_tau, best)
    }

    /// The logarithm of the best time constant of a grid, from a tenth of the shortest distance of
    /// two points to a thousand times the length.
    ///
    /// A long record is searched through the means of its stretches first, which show all but time
    /// constants as short as the stretches.
    fn search(&self) -> Result<f64, FitError> {
        if self.times.len() >= 2 * FEW {
            let (times, temperatures) = (means(self.times), means(self.temperatures));
            let few = Record { times: &times, first: times[0], temperatures: &temperatures };
            let stretch = (times[times.len() - 1] - times[0]) / few.count();
            match few.grid(100) {
                Ok(log_tau) if log_tau.exp() > 5.0 * stretch => return Ok(few.refined(log_tau).0),
                _ => {}
            }
        }
        self.grid(300)
    }

    /// The logarithm of the best time constant of a grid of `count` steps, if it is inside.
    fn grid(&self, count: i32) -> Result<f64, FitError> {
        let shortest =
            self.times.windows(2).map(|pair| pair[1] - pair[0]).fold(f64::INFINITY, f64::min);
        let from = (0.1 * shortest).ln();
        let to = (1e3 * (self.times[self.times.len() - 1] - self.times[0])).ln();
        let at = |k: i32| from + (to - from) * f64::from(k) / f64::from(count);
        let squares = |k: i32| self.project(at(k)).squares;
        let all = (0..=count).map(|k| (k, squares(k)));
        let best = all.min_by(|a, b| a.1.total_cmp(&b.1)).map_or(0, |(k, _)| k);
        if best == 0 || best == count {
            return Err(FitError::NoCurvature { tau: at(best).exp() });
        }
        Ok(at(best))
    }

    fn project(&self, log_tau: f64) -> Projected {
        let tau = log_tau.exp();
        let shape: Vec<f64> =
            self.times.iter().map(|t| -f64::exp_m1((self.first - t) / tau)).collect();
        let (initial, rise) = line(&shape, self.temperatures);
        let misses = self.temperatures.iter().zip(&shape).map(|(t, s)| t - initial - rise * s);
        let squares = misses.map(|m| m * m).sum();
        Projected { initial, rise, shape, squares }
    }

    /// The Gauss-Newton step of the logarithm: the residual against the part of the derivative that
    /// offset and factor cannot follow.
    fn step(&self, log_tau: f64, at: &Projected) -> f64 {
        let tau = log_tau.exp();
        let slope = |(t, s): (&f64, &f64)| -at.rise * ((t - self.first) / tau) * (1.0 - s);
        let slopes: Vec<f64> = self.times.iter().zip(&at.shape).map(slope).collect();
        let (offset, factor) = line(&at.shape, &slopes);
        let (mut square, mut product) = (0.0, 0.0);
        for ((slope, shape), t) in slopes.iter().zip(&at.shape).zip(self.temperatures) {
            let free = slope - offset - factor * shape;
            square += free * free;
            product += free * (t - at.initial - at.rise * shape);
        }
        product / square
    }
}

/// Offset and factor of the shape that are nearest to `values`.
fn line(shape: &[f64], values: &[f64]) -> (f64, f64) {
    let mean_shape = mean(shape);
    let mean_value = mean(values);
    let (mut square, mut product) = (0.0, 0.0);
    for (s, v) in shape.iter().zip(values) {
        let apart = s - mean_shape;
        square += apart * apart;
        product += apart * (v - mean_value);
    }
    let factor = if square > 0.0 { product / square } else { 0.0 };
    (mean_value - factor * mean_shape, factor)
}

/// Smallest number of stretches of a long record.
const FEW: usize = 200;

/// The means of [`FEW`] stretches or some more.
fn means(values: &[f64]) -> Vec<f64> {
    values.chunks(values.len() / FEW).map(mean).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The means of equal stretches of an exponential are an exponential with the same time
    /// constant. The search through them finds it; no grid point does.
    #[test]
    fn a_long_record_is_searched_through_its_means() {
        for tau in [80.0_f64, 900.0, 31_000.0] {
            let times: Vec<f64> = (0..2000).map(f64::from).collect();
            let values: Vec<f64> = times.iter().map(|t| 350.0 - 50.0 * (-t / tau).exp()).collect();
            let found = Record::new(&times, &values).unwrap().search().unwrap();
            assert!((found.exp() / tau - 1.0).abs() < 1e-6, "{tau}: {}", found.exp());
        }
    }
}
