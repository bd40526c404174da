//! The distance of the integrator's solution from a second one, in rows and between them.

use std::f64::consts::PI;

use lptn_integrate::SeriesStep;

use super::rows::Rows;

/// Times in a part of a run that determine both solutions, whose degree is at most 12.
const PLACES: usize = 13;

/// A polynomial is at most this much larger between the places than there: their Lebesgue constant
/// is at most `2/pi (ln 12 + 0.5772 + ln(8/pi))` (H. Ehlich, K. Zeller, Math. Ann. 164 (1966) 105).
const LEBESGUE: f64 = 2.6;

/// Most terms of a solution.
const MOST: usize = PLACES - 1;

/// Two solutions over a part of the run.
pub(super) struct Apart<'s> {
    steps: [&'s SeriesStep<'s>; 2],
    span: (f64, f64),
}

/// Weights of the terms of both solutions at one time.
pub(super) type Weights = [[f64; MOST]; 2];

impl<'s> Apart<'s> {
    pub(super) fn new(steps: [&'s SeriesStep<'s>; 2], span: (f64, f64)) -> Self {
        Self { steps, span }
    }

    pub(super) fn at(&self, time: f64) -> Weights {
        self.steps.map(|step| {
            let after = (time - step.span.0) / step.length;
            step.weights(after.clamp(0.0, step.share))
        })
    }

    /// The distances of an unknown in K at times with these weights, for each solution one list for
    /// each term.
    fn all(&self, weights: &[[[f64; PLACES]; MOST]; 2], unknown: usize) -> [f64; PLACES] {
        let [start, beside] = self.steps.map(|step| step.ends[0][unknown]);
        let mut changes = [[0.0; PLACES]; 2];
        for ((changes, weights), step) in changes.iter_mut().zip(weights).zip(self.steps) {
            for (weights, term) in weights.iter().zip(step.terms) {
                let term = term[unknown];
                changes.iter_mut().zip(weights).for_each(|(sum, weight)| *sum += weight * term);
            }
        }
        std::array::from_fn(|k| (start - beside) + (changes[0][k] - changes[1][k]))
    }

    /// The distance of an unknown in K.
    pub(super) fn of(&self, weights: &Weights, unknown: usize) -> f64 {
        let [change, other] = [0, 1].map(|k| {
            let terms = weights[k].iter().zip(self.steps[k].terms);
            terms.map(|(weight, term)| weight * term[unknown]).sum::<f64>()
        });
        let [start, beside] = self.steps.map(|step| step.ends[0][unknown]);
        (start - beside) + (change - other)
    }
}

/// The largest distances of recorded nodes.
pub(super) struct Far {
    most: Vec<f64>,
    /// The places as shares of a part of the run.
    places: [f64; PLACES],
    /// For each place the Chebyshev coefficients of the polynomial that is 1 there and 0 at the
    /// others.
    basis: [[f64; PLACES]; PLACES],
}

impl Far {
    pub(super) fn new(recorded: usize) -> Self {
        let last = (PLACES - 1) as f64;
        let end = |k: usize| if k == 0 || k == PLACES - 1 { 0.5 } else { 1.0 };
        let basis = std::array::from_fn(|place| {
            std::array::from_fn(|k| {
                let angle = PI * (k * place) as f64 / last;
                2.0 / last * end(k) * end(place) * angle.cos()
            })
        });
        let places = std::array::from_fn(|k| 0.5 + 0.5 * (PI * k as f64 / last).cos());
        Self { most: vec![0.0; recorded], places, basis }
    }

    /// Takes the largest distance over a part of the run.
    pub(super) fn take(&mut self, apart: &Apart<'_>, rows: &Rows<'_>) {
        let (from, to) = apart.span;
        let mut weights = [[[0.0; PLACES]; MOST]; 2];
        for (place, share) in self.places.iter().enumerate() {
            let here = apart.at(from + share * (to - from));
            for (all, here) in weights.iter_mut().zip(here) {
                all.iter_mut().zip(here).for_each(|(all, here)| all[place] = here);
            }
        }
        let mut most = std::mem::take(&mut self.most);
        rows.for_each_unknown(|node, unknown| {
            let values = apart.all(&weights, unknown);
            let largest = values.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
            // most steps add nothing to the largest one
            if LEBESGUE * largest > most[node] {
                most[node] = most[node].max(largest_of(&values, &self.basis));
            }
        });
        self.most = most;
    }

    /// Hands the distances over, and begins with none.
    pub(super) fn hand_over(&mut self, to: &mut [f64]) {
        to.iter_mut().zip(&mut self.most).for_each(|(to, most)| {
            *to = to.max(*most);
            *most = 0.0;
        });
    }
}

/// A bound on a polynomial from its values at the extrema of a Chebyshev polynomial.
///
/// As a function of an angle it is `p = sum of c_k cos(k x)`. Between its largest value, at which
/// its slope is 0, and the next place, at most half of their distance away, it falls by at most
/// half the square of that times the largest `p''`, which is at most the sum of `k^2 |c_k|`.
fn largest_of(values: &[f64; PLACES], basis: &[[f64; PLACES]; PLACES]) -> f64 {
    let mut coefficients = [0.0; PLACES];
    let mut most = 0.0_f64;
    for (value, weights) in values.iter().zip(basis) {
        most = most.max(value.abs());
        coefficients.iter_mut().zip(weights).for_each(|(c, w)| *c += w * value);
    }
    let bend: f64 = coefficients.iter().enumerate().map(|(k, c)| (k * k) as f64 * c.abs()).sum();
    let half = 0.5 * PI / (PLACES - 1) as f64;
    most + 0.5 * half * half * bend
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A Chebyshev polynomial of degree 5, and `s^2 - 1/4`.
    #[test]
    fn polynomials_are_bounded_closely() {
        let far = Far::new(0);
        let bound = |p: &dyn Fn(f64) -> f64| {
            let place = |i: usize| (PI * i as f64 / (PLACES - 1) as f64).cos();
            largest_of(&std::array::from_fn(|i| p(place(i))), &far.basis)
        };
        let chebyshev = bound(&|s| ((16.0 * s * s - 20.0) * s * s + 5.0) * s);
        assert!((1.0..1.3).contains(&chebyshev), "{chebyshev}");
        let square = bound(&|s| s * s - 0.25);
        assert!((0.75..0.78).contains(&square), "{square}");
    }
}
