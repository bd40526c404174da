//! A linear system driven by random walks, from one moment to the next.
//!
//! Transitions are doubled, not diagonalised. A series over a short time gives `exp(F t) - 1`, the
//! response to a ramp, and the covariance of the random walks. Doubling keeps the digits of slow
//! states next to fast ones and inverts nothing. Streams, whose matrices may have no modes, are not
//! a special case.

use std::rc::Rc;

use lptn_integrate::vectors::{add, dot};

use crate::kalman::{Transition, multiplied};

/// Solution of `dx/dt = F x` over a time, with random walks among the states.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Discrete {
    /// `exp(F t)`
    pub(crate) transition: Rc<Transition>,
    /// For each walk, the effect of its steady rise by 1 per s on every state.
    pub(crate) ramps: Vec<Vec<f64>>,
    /// For each walk, the covariance that it adds at an intensity of 1 per s.
    pub(crate) noises: Vec<Vec<f64>>,
}

/// Terms of a series of a step so short that the largest sum of a row of `F t` is at most
/// [`SHORT`]: the remainder is below rounding.
const TERMS: usize = 10;
const SHORT: f64 = 0.1;

/// The factorials 0! to 10!.
const FACTORIAL: [f64; TERMS + 1] =
    [1.0, 1.0, 2.0, 6.0, 24.0, 120.0, 720.0, 5040.0, 40320.0, 362_880.0, 3_628_800.0];

impl Discrete {
    /// Uses a series over a short time, then doubles it. `exp(F t) - 1` is doubled, so that slow
    /// states keep their digits next to fast ones. Nothing is inverted and nothing grows, however
    /// fast a state is.
    pub(crate) fn new(rates: &[f64], size: usize, time: f64, walks: &[usize]) -> Self {
        let row = |row: &[f64]| row.iter().map(|x| x.abs()).sum::<f64>();
        let norm = rates.chunks_exact(size.max(1)).map(row).fold(0.0, f64::max) * time;
        let mut doublings = 0;
        let mut short = time;
        while norm.is_finite() && norm * short > SHORT * time {
            short *= 0.5;
            doublings += 1;
        }
        let mut change = series(rates, size, short);
        let powers = |&walk: &usize| powers(rates, size, walk);
        let powers: Vec<_> = walks.iter().map(powers).collect();
        let mut ramps: Vec<_> = powers.iter().map(|v| ramp(v, short)).collect();
        let mut noises: Vec<_> = powers.iter().map(|v| noise(v, short)).collect();
        for _ in 0..doublings {
            for ramp in &mut ramps {
                let later = multiplied(&change, ramp);
                ramp.iter_mut().zip(later).for_each(|(r, x)| *r = *r + *r + x);
            }
            noises.iter_mut().for_each(|noise| *noise = doubled(&change, noise, size));
            let square = times(&change, &change, size);
            change.iter_mut().zip(square).for_each(|(e, s)| *e = *e + *e + s);
        }
        change.iter_mut().step_by(size + 1).for_each(|x| *x += 1.0);
        Self { transition: Rc::new(Transition::of(&change)), ramps, noises }
    }

    /// The covariance that walks of these intensities add.
    pub(crate) fn noise(&self, intensities: &[f64]) -> Rc<Vec<f64>> {
        let side = self.transition.side();
        let mut noise = vec![0.0; side * side];
        for (own, q) in self.noises.iter().zip(intensities).filter(|(_, q)| **q > 0.0) {
            add(&mut noise, *q, own);
        }
        Rc::new(noise)
    }

    /// Change of the states if the walks rise at these rates per s in addition to their steps.
    pub(crate) fn input(&self, rises: &[f64]) -> Vec<f64> {
        let mut input = vec![0.0; self.transition.side()];
        for (ramp, rise) in self.ramps.iter().zip(rises) {
            add(&mut input, *rise, ramp);
        }
        input
    }
}

/// `exp(F t) - 1`
fn series(rates: &[f64], size: usize, time: f64) -> Vec<f64> {
    let scaled: Vec<f64> = rates.iter().map(|x| x * time).collect();
    let mut term = scaled.clone();
    let mut sum = scaled.clone();
    for k in 2..=TERMS {
        term = times(&term, &scaled, size).iter().map(|x| x / k as f64).collect();
        sum.iter_mut().zip(&term).for_each(|(s, t)| *s += t);
    }
    sum
}

/// `F^k e` for the unit vector of a walk.
fn powers(rates: &[f64], size: usize, walk: usize) -> Vec<Vec<f64>> {
    let unit: Vec<f64> = (0..size).map(|i| if i == walk { 1.0 } else { 0.0 }).collect();
    std::iter::successors(Some(unit), |last| Some(multiplied(rates, last))).take(TERMS).collect()
}

/// The integral of `exp(F t) e`.
fn ramp(powers: &[Vec<f64>], time: f64) -> Vec<f64> {
    let mut sum = vec![0.0; powers[0].len()];
    let mut factor = 1.0;
    for (k, power) in powers.iter().enumerate() {
        factor *= time / (k + 1) as f64;
        add(&mut sum, factor, power);
    }
    sum
}

/// The integral of `exp(F t) e e' exp(F t)'`.
fn noise(powers: &[Vec<f64>], time: f64) -> Vec<f64> {
    let size = powers[0].len();
    let mut sum = vec![0.0; size * size];
    for (i, v) in powers.iter().enumerate() {
        for (j, w) in powers.iter().enumerate().take(TERMS - i) {
            let order = i + j + 1;
            let length = (0..order).fold(1.0, |length, _| length * time);
            let factor = length / (order as f64 * FACTORIAL[i] * FACTORIAL[j]);
            for (row, a) in sum.chunks_exact_mut(size).zip(v) {
                row.iter_mut().zip(w).for_each(|(s, b)| *s += factor * a * b);
            }
        }
    }
    sum
}

/// `Q + (1 + E) Q (1 + E)'`
fn doubled(change: &[f64], noise: &[f64], size: usize) -> Vec<f64> {
    let half = times(change, noise, size);
    let mut out = vec![0.0; size * size];
    for i in 0..size {
        for j in 0..=i {
            let last = dot(&half[i * size..][..size], &change[j * size..][..size]);
            let own = noise[i * size + j];
            let sum = own + own + half[i * size + j] + half[j * size + i] + last;
            (out[i * size + j], out[j * size + i]) = (sum, sum);
        }
    }
    out
}

fn times(a: &[f64], b: &[f64], size: usize) -> Vec<f64> {
    let mut out = vec![0.0; size * size];
    for (row, a) in out.chunks_exact_mut(size.max(1)).zip(a.chunks_exact(size.max(1))) {
        for (factor, b) in a.iter().zip(b.chunks_exact(size)) {
            add(row, *factor, b);
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::Discrete;

    /// `dT/dt = -T / tau + p / C`, p a walk: closed forms of J. M. Mendel, Lessons in Estimation
    /// Theory (1995), lesson 26, by hand.
    #[test]
    fn analytic_one_body_driven_by_a_walk() {
        for (tau, time) in [(800.0, 5.0), (800.0, 4000.0), (0.01, 60.0)] {
            let capacity = 2659.0;
            let found = Discrete::new(&[-1.0 / tau, 1.0 / capacity, 0.0, 0.0], 2, time, &[1]);
            let left = f64::exp(-time / tau);
            let rise = -tau * f64::exp_m1(-time / tau);
            let expected = [left, rise / capacity, 0.0, 1.0];
            let column = |unit: [f64; 2]| found.transition.advanced(&[], &unit);
            let (first, second) = (column([1.0, 0.0]), column([0.0, 1.0]));
            let matrix = [first[0], second[0], first[1], second[1]];
            for (a, b) in matrix.iter().zip(expected) {
                assert!((a - b).abs() <= 1e-13 * b.abs().max(1e-4), "{a} {b}");
            }
            let ramp = tau * (time - rise) / capacity;
            assert!((found.ramps[0][0] - ramp).abs() <= 1e-11 * ramp);
            let variance =
                tau * tau * (time - 2.0 * rise - 0.5 * tau * f64::exp_m1(-2.0 * time / tau))
                    / (capacity * capacity);
            // differences of nearly equal numbers in the closed form itself
            let digits = (tau / time).max(1.0).powi(2) * 1e-12;
            assert!((found.noises[0][0] - variance).abs() <= digits * variance);
            assert!((found.noises[0][3] - time).abs() <= 1e-12 * time);
            assert!((found.noises[0][1] - ramp).abs() <= 1e-11 * ramp);
        }
    }
}
