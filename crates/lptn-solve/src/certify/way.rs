//! The way of the unknowns over a step, as polynomials.
//!
//! A certificate bounds the distance of the exact solution from these polynomials. They pass
//! through samples of the integrator's own solution. Between the samples they are their own, so a
//! certificate needs to know nothing about the integrator.

use std::f64::consts::PI;

use lptn_units::Taylor;

use super::defect::largest_of;

/// Samples of a step: the polynomials have one degree less.
pub(super) const SAMPLES: usize = 8;

/// Samples that determine the solution of every integrator: the one-step method has polynomials of
/// degree 11, CVODE of degree 5.
pub(super) const INTEGRATED: usize = 13;

/// Polynomials of one step in a variable from -1 at its start to 1 at its end.
#[derive(Clone, Debug)]
pub(super) struct Way {
    /// Coefficients of each unknown in K.
    coefficients: Vec<[f64; SAMPLES]>,
}

/// The places of the samples: the extrema of a Chebyshev polynomial, at which interpolation is
/// well conditioned, from the start to the end.
pub(super) fn places<const N: usize>() -> [f64; N] {
    let last = (N - 1) as f64;
    std::array::from_fn(|i| -(PI * i as f64 / last).cos())
}

/// For each sample the coefficients of the polynomial that is 1 there and 0 at the others.
pub(super) fn basis<const N: usize>() -> [[f64; N]; N] {
    let places = places::<N>();
    std::array::from_fn(|i| {
        let mut product = [0.0; N];
        product[0] = 1.0;
        for (_, place) in places.iter().enumerate().filter(|(j, _)| *j != i) {
            // times (s - place) / (places[i] - place)
            let over = (places[i] - place).recip();
            for k in (0..N).rev() {
                let below = if k == 0 { 0.0 } else { product[k - 1] };
                product[k] = (below - product[k] * place) * over;
            }
        }
        product
    })
}

impl Way {
    /// The polynomials through samples, one list of all unknowns for each place.
    pub(super) fn through(samples: &[Vec<f64>], basis: &[[f64; SAMPLES]; SAMPLES]) -> Self {
        let first = &samples[0];
        let polynomial = |unknown: usize| {
            let mut of = [0.0; SAMPLES];
            for (sample, weights) in samples.iter().zip(basis) {
                // differences keep the digits that temperatures share
                let rise = sample[unknown] - first[unknown];
                of.iter_mut().zip(weights).for_each(|(c, w)| *c += w * rise);
            }
            of[0] += first[unknown];
            of
        };
        Self { coefficients: (0..first.len()).map(polynomial).collect() }
    }

    /// Number of unknowns.
    pub(super) fn len(&self) -> usize {
        self.coefficients.len()
    }

    /// Temperature of an unknown in K at a place.
    pub(super) fn at(&self, unknown: usize, place: f64) -> f64 {
        self.coefficients[unknown].iter().rev().fold(0.0, |sum, c| sum * place + c)
    }

    /// A bound on the distance in K of an unknown from the integrator's solution, of which these
    /// are the values at [`places`].
    pub(super) fn apart(
        &self,
        unknown: usize,
        values: [f64; INTEGRATED],
        basis: &[[f64; INTEGRATED]; INTEGRATED],
    ) -> f64 {
        let mut difference = [0.0; INTEGRATED];
        for ((value, place), weights) in values.iter().zip(places::<INTEGRATED>()).zip(basis) {
            let apart = value - self.at(unknown, place);
            difference.iter_mut().zip(weights).for_each(|(c, w)| *c += w * apart);
        }
        largest_of(&difference)
    }

    /// Bounds on an unknown and its Taylor coefficients over the whole step.
    pub(super) fn whole(&self, unknown: usize) -> Taylor {
        let of = &self.coefficients[unknown];
        let bounds: [[f64; 2]; SAMPLES] = std::array::from_fn(|k| {
            let mut choose = 1.0;
            let mut spread = 0.0;
            for (j, c) in of.iter().enumerate().skip(k + 1) {
                // j over k
                choose *= j as f64 / (j - k) as f64;
                spread += choose * c.abs();
            }
            [of[k] - spread, of[k] + spread]
        });
        Taylor::between(&bounds)
    }

    /// The Taylor coefficients of an unknown in the middle of the step.
    pub(super) fn middle(&self, unknown: usize) -> Taylor {
        Taylor::between(&self.coefficients[unknown].map(|c| [c, c]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `s^7 - 2 s^3 + 300`, whose values and derivatives are known.
    #[test]
    fn polynomials_pass_through_their_samples() {
        let of = |s: f64| s.powi(7) - 2.0 * s.powi(3) + 300.0;
        let samples: Vec<Vec<f64>> = places::<SAMPLES>().iter().map(|s| vec![of(*s)]).collect();
        let way = Way::through(&samples, &basis());
        for i in 0..=40 {
            let s = f64::from(i) / 20.0 - 1.0;
            assert!((way.at(0, s) - of(s)).abs() < 1e-12, "{s}");
            let [low, high] = way.whole(0).term(1);
            let slope = 7.0 * s.powi(6) - 6.0 * s * s;
            assert!(low <= slope && slope <= high, "{low} {slope} {high}");
        }
        assert!((way.middle(0).term(3)[0] + 2.0).abs() < 1e-12);
    }
}
