//! The step response of a port with fewer exponentials.
//!
//! A few nodes at one port are a projection, converted to a ladder. A congruence keeps it passive,
//! and one port makes it realisable with positive elements.

use faer::Mat;
use lptn_integrate::dense;
use lptn_integrate::vectors::{dot, norm, take_off};

use crate::exponentials::Exponentials;
use crate::step::{ResponseTerm, StepResponse};

/// The step response with `terms` exponentials: resistances in K/W with time constants in s, all
/// positive, with the same sum.
///
/// In modal coordinates the network is `diag(tau) dx/dt = b P - x` with `b_i = sqrt(r_i)`. It is
/// projected onto the responses `b / (1 + s tau)` at as many real frequencies s >= 0 as there are
/// terms (a rational Krylov space; for s = 0 alone PRIMA: A. Odabasioglu, M. Celik, L. T. Pileggi,
/// IEEE Trans. CAD 17 (1998) 645). This is a congruence, so the result is passive with real time
/// constants and positive resistances, and agrees with the network at every s in value and slope
/// (E. J. Grimme, thesis, Urbana 1997). With s = 0 among them `R_eq` and the area under the
/// response are exact.
///
/// So the error's impulse response is orthogonal to `exp(-s t)` and `t exp(-s t)` for each s, twice
/// as many functions as terms. They form a Chebyshev system: the error has at least as many changes
/// of sign. By Descartes' rule it has no more, because its coefficients, positive for the terms
/// among negative ones for the network, change sign no more often. So all changes are known once
/// that number is found.
///
/// A search finds the other frequencies, for the smallest error over every load.
pub(crate) fn fewer(step: &StepResponse, terms: usize) -> Option<Vec<(f64, f64)>> {
    let all: Vec<(f64, f64)> = step.terms.iter().map(|term| (term.resistance, term.tau)).collect();
    if all.len() <= terms {
        return Some(all);
    }
    let search = Search::new(&step.terms)?;
    let shifts = search.best(terms)?;
    search.projected(&shifts)
}

struct Search<'a> {
    network: &'a [ResponseTerm],
    times: Vec<f64>,
    /// The network's part of the error at these times.
    values: Vec<f64>,
    /// Decades of the frequencies 1 / tau.
    range: (f64, f64),
}

impl<'a> Search<'a> {
    fn new(network: &'a [ResponseTerm]) -> Option<Self> {
        let curve = Exponentials::new(network.iter().map(|term| (term.resistance, term.tau)));
        let times: Vec<f64> = curve.times().into_iter().step_by(4).collect();
        let values = times.iter().map(|&time| curve.value(time)).collect();
        let rates = network.iter().map(|term| -term.tau.log10());
        let (slow, fast) = rates.fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), rate| {
            (least.min(rate), most.max(rate))
        });
        slow.is_finite().then_some(Self { network, times, values, range: (slow, fast) })
    }

    /// Decades of the frequencies other than 0: evenly over the best part of the range, then each
    /// by itself.
    fn best(&self, terms: usize) -> Option<Vec<f64>> {
        const ROUNDS: usize = 3;
        if terms <= 1 {
            return Some(Vec::new());
        }
        let (slow, fast) = self.range;
        let spread = |to: f64| -> Vec<f64> {
            let step = (to - slow) / count(terms - 1);
            (1..terms).map(|k| slow + step * count(k)).collect()
        };
        let pieces = 1 + 3 * (fast - slow).clamp(1.0, 12.0).ceil() as usize;
        let ends = (1..=pieces).map(|k| slow + (fast - slow) * count(k) / count(pieces));
        let (mut best, mut error) = ends
            .map(spread)
            .filter_map(|shifts| Some((self.error(&shifts)?, shifts)))
            .min_by(|a, b| a.0.total_cmp(&b.0))
            .map(|(error, shifts)| (shifts, error))?;
        let mut step = 0.5 * (best[0] - slow).max(0.1);
        for _ in 0..ROUNDS {
            for k in 0..best.len() {
                for way in [step, -step] {
                    let mut other = best.clone();
                    other[k] += way;
                    if let Some(found) = self.error(&other).filter(|found| *found < error) {
                        (best, error) = (other, found);
                    }
                }
            }
            step *= 0.5;
        }
        Some(best)
    }

    /// The largest error over every load of up to 1 W in K, sampled at the times.
    fn error(&self, shifts: &[f64]) -> Option<f64> {
        let terms = self.projected(shifts)?;
        let curve = Exponentials::new(terms.into_iter().map(|(r, tau)| (-r, tau)));
        let (mut last, mut rises) = (0.0, 0.0);
        for (&time, value) in self.times.iter().zip(&self.values) {
            let here = value + curve.value(time);
            rises += f64::max(here - last, 0.0);
            last = here;
        }
        Some(rises + f64::max(-last, 0.0))
    }

    /// Resistances and time constants of the projection onto the responses at 0 and at these
    /// decades of frequencies. `None` if two responses are equal to rounding.
    fn projected(&self, shifts: &[f64]) -> Option<Vec<(f64, f64)>> {
        const SAME: f64 = 1e-10;
        let b: Vec<f64> = self.network.iter().map(|term| term.resistance.sqrt()).collect();
        let mut basis: Vec<Vec<f64>> = Vec::new();
        for s in [0.0].into_iter().chain(shifts.iter().map(|decade| 10_f64.powf(*decade))) {
            let answer = |(b, term): (&f64, &ResponseTerm)| b / (1.0 + s * term.tau);
            let mut vector: Vec<f64> = b.iter().zip(self.network).map(answer).collect();
            let before = norm(&vector);
            take_off(&mut vector, basis.iter().chain(&basis));
            let length = norm(&vector);
            if length <= SAME * before {
                return None;
            }
            basis.push(vector.into_iter().map(|x| x / length).collect());
        }
        let n = basis.len();
        let entry = |i: usize, j: usize| -> f64 {
            let parts = basis[i].iter().zip(&basis[j]).zip(self.network);
            parts.map(|((a, b), term)| a * term.tau * b).sum()
        };
        let (tau, vectors) = dense::symmetric_eigen(Mat::from_fn(n, n, entry).as_ref())?;
        let heat: Vec<f64> = basis.iter().map(|vector| dot(vector, &b)).collect();
        let weight = |k: usize| (0..n).map(|i| vectors[(i, k)] * heat[i]).sum::<f64>().powi(2);
        let terms: Vec<(f64, f64)> = (0..n).rev().map(|k| (weight(k), tau[k])).collect();
        terms.iter().all(|term| term.0 > 0.0 && term.1 > 0.0).then_some(terms)
    }
}

#[expect(clippy::cast_precision_loss, reason = "a number of terms")]
fn count(n: usize) -> f64 {
    n as f64
}
