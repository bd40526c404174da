//! The distance of the integrator's solution from a second one, in rows and between them.

use lptn_integrate::SeriesStep;

use super::defect::Largest;
use super::rows::Rows;
use super::way;

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
    largest: Largest<PLACES>,
}

impl Far {
    pub(super) fn new(recorded: usize) -> Self {
        Self { most: vec![0.0; recorded], largest: Largest::new() }
    }

    /// Takes the largest distance over a part of the run.
    pub(super) fn take(&mut self, apart: &Apart<'_>, rows: &Rows<'_>) {
        let (from, to) = apart.span;
        let mut weights = [[[0.0; PLACES]; MOST]; 2];
        for (place, at) in way::places::<PLACES>().into_iter().enumerate() {
            let here = apart.at(from + 0.5 * (1.0 + at) * (to - from));
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
                most[node] = most[node].max(self.largest.of(&values));
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
