//! The way of the unknowns over a step, as polynomials.
//!
//! A certificate bounds the distance of the exact solution from these polynomials. They pass
//! through samples of a second solution. Between the samples they are their own, so a certificate
//! needs to know nothing about an integrator.

use std::f64::consts::PI;

use lptn_units::Taylor;

use super::ROUNDING;

/// Samples of a step: the polynomials have one degree less.
pub(super) const SAMPLES: usize = 8;

/// Polynomials of one step in a variable from -1 at its start to 1 at its end.
#[derive(Clone, Debug, Default)]
pub(super) struct Way<const N: usize> {
    /// Coefficients of each unknown in K.
    coefficients: Vec<[f64; N]>,
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

impl<const N: usize> Way<N> {
    /// Takes the polynomials through samples, one list of all unknowns for each place.
    pub(super) fn put(&mut self, samples: &[Vec<f64>; N], basis: &[[f64; N]; N]) {
        let first = &samples[0];
        self.coefficients.resize(first.len(), [0.0; N]);
        for (unknown, of) in self.coefficients.iter_mut().enumerate() {
            *of = [0.0; N];
            for (sample, weights) in samples[1..].iter().zip(&basis[1..]) {
                // differences keep the digits that temperatures share
                let rise = sample[unknown] - first[unknown];
                of.iter_mut().zip(weights).for_each(|(c, w)| *c += w * rise);
            }
            of[0] += first[unknown];
        }
    }

    /// Takes constant temperatures in K.
    pub(super) fn put_still(&mut self, state: &[f64]) {
        self.coefficients.clear();
        self.coefficients.extend(state.iter().map(|t| {
            let mut of = [0.0; N];
            of[0] = *t;
            of
        }));
    }

    /// Number of unknowns.
    pub(super) fn len(&self) -> usize {
        self.coefficients.len()
    }

    /// Temperature of an unknown in K at a place.
    pub(super) fn at(&self, unknown: usize, place: f64) -> f64 {
        self.coefficients[unknown].iter().rev().fold(0.0, |sum, c| sum * place + c)
    }

    /// Change of the temperature of an unknown in K at a place.
    pub(super) fn slope(&self, unknown: usize, place: f64) -> f64 {
        let terms = self.coefficients[unknown].iter().enumerate().skip(1).rev();
        terms.fold(0.0, |sum, (k, c)| sum * place + k as f64 * c)
    }

    /// The Taylor coefficients of an unknown in the middle of the step.
    pub(super) fn middle(&self, unknown: usize) -> Taylor {
        Taylor::between(&self.coefficients[unknown].map(|c| [c, c]))
    }

    /// Bounds on all unknowns and their Taylor coefficients, over the whole step and in its middle,
    /// while each differs from its polynomial by at most these numbers in K.
    pub(super) fn tube(&self, bound: &dyn Fn(usize) -> f64) -> [Vec<Taylor>; 2] {
        let wide = |i: usize, of: Taylor| {
            let bound = bound(i) + ROUNDING * self.at(i, 1.0);
            of + Taylor::between(&[[-bound, bound]])
        };
        let whole = (0..self.len()).map(|i| wide(i, self.whole(i))).collect();
        [whole, (0..self.len()).map(|i| wide(i, self.middle(i))).collect()]
    }

    /// Bounds on an unknown and its Taylor coefficients over the whole step.
    pub(super) fn whole(&self, unknown: usize) -> Taylor {
        let of = &self.coefficients[unknown];
        let bounds: [[f64; 2]; N] = std::array::from_fn(|k| {
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
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `s^7 - 2 s^3 + 300`, whose values and derivatives are known.
    #[test]
    fn polynomials_pass_through_their_samples() {
        let of = |s: f64| s.powi(7) - 2.0 * s.powi(3) + 300.0;
        let samples = places::<SAMPLES>().map(|s| vec![of(s)]);
        let mut way = Way::default();
        way.put(&samples, &basis());
        for i in 0..=40 {
            let s = f64::from(i) / 20.0 - 1.0;
            assert!((way.at(0, s) - of(s)).abs() < 1e-12, "{s}");
            let [low, high] = way.whole(0).term(1);
            let slope = 7.0 * s.powi(6) - 6.0 * s * s;
            assert!(low <= slope && slope <= high, "{low} {slope} {high}");
        }
        assert!((way.middle(0).term(3)[0] + 2.0).abs() < 1e-12);
        assert!((way.slope(0, 0.5) - (7.0 * 0.5_f64.powi(6) - 1.5)).abs() < 1e-12);
    }
}
