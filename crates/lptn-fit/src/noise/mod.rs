//! Standard errors if residuals depend on those before them.
//!
//! Least squares takes residuals as independent. Those of a thermocouple are not: they drift. The
//! rounding of the instrument adds a part that hides the drift from an estimate by the correlation
//! of neighbours (a plain AR(1) correction). A fit feels only the slow part of the noise. The model
//! is therefore one of the means of stretches of the record (some 100 of them), with a correlated
//! and a white part,
//!
//! ```text
//! covariance(e(t), e(t')) = s^2 (c exp(-|t - t'| / theta) + (1 - c) [t = t'])
//! ```
//!
//! which on an even grid of times is an ARMA(1,1) process, with c up to the limit at which its
//! spectrum falls below 0. The noise inside a stretch need not be modelled. `s`, `c` and `theta`
//! maximise the *restricted* likelihood (H. D. Patterson, R. Thompson, Biometrika 58 (1971) 545; D.
//! A. Harville, J. Am. Stat. Assoc. 72 (1977) 320): that of the part that the fitted parameters
//! could not remove, so the fit does not bias variance and correlation low. It is computed by a
//! Kalman filter over the samples (A. C. Harvey, Forecasting, Structural Time Series Models and the
//! Kalman Filter, 1989, chapter 3), for any times, so gaps need no treatment.
//!
//! The covariance of the parameters is the sandwich `(J^T J)^-1 J^T Omega J (J^T J)^-1`, exact for
//! least squares with residuals of covariance Omega. The uncertainty of the variance itself is
//! counted in degrees of freedom after F. E. Satterthwaite (Biometrics Bulletin 2 (1946) 110), from
//! the curvature of the restricted likelihood. They give the quantile of Student's t for an
//! interval. If the time is known only to a factor (slow drift, few samples), one shape does not
//! represent all. The interval then contains 95 % of the mixture of all shapes, weighted by the
//! restricted likelihood, up to a time as long as the record. The degrees of freedom are those
//! whose quantile is as wide.

mod likelihood;
mod local;
mod middle;
mod resolution;
mod slow;
pub(crate) mod stretches;
mod whitened;

pub(crate) use likelihood::orthonormal;
use likelihood::{Likelihood, Possible, Shape};
pub use middle::Middle;
pub(crate) use middle::Tied;
pub use resolution::resolution;
pub(crate) use whitened::Whitened;

/// Fewer means do not distinguish white noise from slow noise.
const FEW: f64 = 100.0;

/// Prior odds of white noise against all correlated ones, if a curve that absorbs slow noise goes
/// through few samples.
const WHITE_OF_FEW: f64 = 0.25;

/// The random part of a record.
#[derive(Clone, Debug, PartialEq)]
pub struct Noise {
    /// Its standard deviation, in the unit of the residuals: root of the sum of their squares over
    /// the number of samples less that of fitted parameters.
    pub deviation: f64,
    /// Number of samples.
    pub samples: usize,
    /// Number of independent samples whose mean would be known as well as the mean of these.
    pub effective: f64,
    /// Number of samples in a stretch whose mean is modelled.
    pub stretch: usize,
    /// The noise of these means.
    pub means: Means,
    /// Number of fitted parameters that the residuals feel.
    rank: usize,
    /// Maximum of the likelihood, the covariance of its two numbers, and the distance of two means
    /// in s.
    place: [f64; 2],
    spread: [[f64; 2]; 2],
    spacing: f64,
    /// All shapes that are possible, if one does not represent them.
    possible: Vec<Possible>,
    /// True if those are drift as slow as the record.
    slow: bool,
    /// Twice the negative logarithm of the restricted likelihood, of white noise and at its
    /// maximum.
    white: f64,
    likeliest: f64,
    /// The strength of the noise at each sample over that of all; empty if it is the same.
    strengths: Vec<f64>,
}

/// The noise of the means of stretches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Means {
    /// Standard deviation `s`, in the unit of the residuals.
    pub deviation: f64,
    /// The factor `c` of the correlation. Above 1 if means of neighbours have more in common than
    /// the part that is left from stretch to stretch.
    pub correlated: f64,
    /// The time `theta` in s in which that part's correlation falls to 1/e; 0 if nothing is
    /// correlated.
    pub time: f64,
    /// Twice the negative logarithm of the likelihood (of the means, not the restricted one), up to
    /// a constant of their number: to compare models of one record.
    pub misfit: f64,
}

impl Noise {
    /// From the `residuals` of a fit at ascending `times` in s and their derivatives by the fitted
    /// parameters, one parameter after the other.
    ///
    /// White noise is taken if the two more numbers do not lower Akaike's criterion. Residuals that
    /// are all 0 have deviation 0.
    pub fn estimate(times: &[f64], residuals: &[f64], jacobian: &[f64]) -> Self {
        Self::of_even((times, residuals, jacobian), Self::even)
    }

    /// From residuals whose noise has one strength.
    fn even((times, residuals, jacobian): (&[f64], &[f64], &[f64])) -> Self {
        Self::of_stretches(times, residuals, jacobian, stretches::size(times.len(), jacobian))
    }

    /// The result of `of` for residuals and derivatives over the strength of the noise at each.
    fn of_even(
        (times, residuals, jacobian): (&[f64], &[f64], &[f64]),
        of: impl Fn((&[f64], &[f64], &[f64])) -> Self,
    ) -> Self {
        let strengths = local::strengths(residuals);
        let values = local::even(&strengths, residuals);
        let slopes = local::even(&strengths, jacobian);
        let noise = of((times, &values, &slopes));
        Self { strengths, ..noise }
    }

    /// The same as [`Noise::estimate`] for a single record: if drift as slow as the record is as
    /// likely as none, intervals contain 95 % of the mixture of all such drifts.
    pub fn with_drift(times: &[f64], residuals: &[f64], jacobian: &[f64]) -> Self {
        let drifting =
            |record: (&[f64], &[f64], &[f64])| Self::drifting(record, slow::BEHIND_OF_STEP);
        Self::of_even((times, residuals, jacobian), drifting)
    }

    fn drifting((times, residuals, jacobian): (&[f64], &[f64], &[f64]), behind: f64) -> Self {
        let stretch = stretches::longest(times.len());
        let likelihood = of_means(times, residuals, jacobian, stretch);
        let mut noise = Self::of_likelihood(&likelihood, times.len(), residuals, stretch);
        if likelihood.count() < FEW {
            if noise.means.time <= 0.0 && !noise.possible.is_empty() {
                noise.possible = likelihood.white_or_possible(WHITE_OF_FEW);
            }
            return noise;
        }
        if likelihood.has_freedom() && noise.deviation > 0.0 {
            let likeliest = noise.likeliest.min(noise.white);
            if let Some(slow) = likelihood.slow((noise.white, likeliest), behind) {
                (noise.possible, noise.slow) = (slow, true);
                return noise;
            }
        }
        Self::even((times, residuals, jacobian))
    }

    /// The same as [`Noise::with_drift`] for a curve with a known start, of one or two records. The
    /// noise of few samples is that of [`Noise::estimate`].
    pub(crate) fn with_slow_drift(
        (times, residuals, jacobian): (&[f64], &[f64], &[f64]),
        alone: bool,
    ) -> Self {
        if (times.len() as f64) < FEW {
            return Self::estimate(times, residuals, jacobian);
        }
        let behind = if alone { slow::BEHIND_OF_NETWORK } else { slow::BEHIND_OF_TWO };
        let drifting = |record: (&[f64], &[f64], &[f64])| Self::drifting(record, behind);
        Self::of_even((times, residuals, jacobian), drifting)
    }

    /// True if drift as slow as the record is as likely as none, and is in the intervals.
    pub fn drifts(&self) -> bool {
        self.slow
    }

    /// The same as [`Noise::estimate`], with stretches of `stretch` samples.
    pub(crate) fn of_stretches(
        times: &[f64],
        residuals: &[f64],
        jacobian: &[f64],
        stretch: usize,
    ) -> Self {
        let likelihood = of_means(times, residuals, jacobian, stretch);
        Self::of_likelihood(&likelihood, times.len(), residuals, stretch)
    }

    fn of_likelihood(
        likelihood: &Likelihood,
        rows: usize,
        residuals: &[f64],
        stretch: usize,
    ) -> Self {
        let squares: f64 = residuals.iter().map(|r| r * r).sum();
        let rank = likelihood.rank();
        let deviation = (squares / rows.saturating_sub(rank).max(1) as f64).sqrt();
        let white = likelihood.at(Shape::WHITE);
        let whole =
            Means { deviation: white.deviation, correlated: 0.0, time: 0.0, misfit: white.whole };
        let samples = rows;
        let mut noise = Self {
            deviation,
            samples,
            effective: rows as f64,
            stretch,
            means: whole,
            rank,
            place: [0.0; 2],
            spread: [[0.0; 2]; 2],
            spacing: likelihood.spacing(),
            possible: Vec::new(),
            slow: false,
            white: white.restricted,
            likeliest: white.restricted,
            strengths: Vec::new(),
        };
        if !(white.restricted.is_finite() && likelihood.has_freedom()) {
            // residuals that are all 0, or too few to say more
            noise.means.deviation = deviation / (stretch as f64).sqrt();
            return noise;
        }
        noise.refine(likelihood, white.restricted);
        noise
    }

    /// Takes correlated noise instead of white noise if it is more likely.
    fn refine(&mut self, likelihood: &Likelihood, white: f64) {
        let (place, best) = likelihood.maximise();
        self.likeliest = best.restricted;
        let mut shape = Shape::WHITE;
        if best.restricted + 4.0 < white {
            shape = Shape::at(place, self.spacing);
            self.place = place;
            self.means = Means {
                deviation: best.deviation,
                correlated: shape.correlated,
                time: shape.time,
                misfit: best.whole,
            };
            match likelihood.spread(place) {
                Some(spread) => self.spread = spread,
                None => self.possible = likelihood.possible(),
            }
        } else if likelihood.count() < FEW {
            self.possible = likelihood.white_or_possible(1.0);
        }
        let count = likelihood.count();
        let ones = vec![1.0; likelihood.times().len()];
        let of_mean = middle::product(likelihood.times(), &ones, shape)[0] / (count * count);
        let variance = self.means.deviation * self.means.deviation * of_mean;
        self.effective =
            (self.deviation * self.deviation / variance).clamp(1.0, self.samples as f64);
    }

    /// `J^T Omega J` in the sandwich, with its derivatives by the estimated numbers.
    pub fn middle(&self, times: &[f64], jacobian: &[f64]) -> Middle {
        Middle::new(self, times, &local::uneven(&self.strengths, jacobian))
    }
}

fn of_means(times: &[f64], residuals: &[f64], jacobian: &[f64], stretch: usize) -> Likelihood {
    Likelihood::new(
        &stretches::means(times, stretch),
        &stretches::means(residuals, stretch),
        &stretches::means_of_columns(jacobian, times.len(), stretch),
    )
}
