//! Results that straight lines get wrong.
//!
//! The slope of a peak or a margin is that of one moment and of one side of a kink. If another
//! moment, or the other side, becomes the worst within the deviations, the slope says nothing.

use lptn_solve::Proceed;
use lptn_units::statistics::NORMAL_95;

use crate::uncertainty::answer::Answer;
use crate::uncertainty::input::{Inputs, Uncertain};
use crate::uncertainty::result::Bent;
use crate::uncertainty::sample::{NoSample, Sample};
use crate::uncertainty::task::UncertaintyTask;

/// The part of the half width of a band by which runs may go beyond the band.
const BEYOND: f64 = 0.5;

/// Changes below this part of a result, or this many tolerances in K, are the error of the runs.
const ERROR: f64 = 1e-6;
const TOLERANCES: f64 = 20.0;

impl UncertaintyTask<'_> {
    /// Runs the network with each parameter, and those correlated to it, at both ends of its 95 %;
    /// gives the results that change by more than straight lines say. A run without a result counts
    /// for nothing.
    pub(super) fn bent(&self, inputs: &Inputs, answers: &[Answer]) -> Vec<Bent> {
        let mut squares = vec![[0.0; 2]; answers.len()];
        for direction in inputs.directions() {
            let sides = [-NORMAL_95, NORMAL_95].map(|score| self.moved(&direction, score).ok());
            let sides: Vec<Sample> = sides.into_iter().flatten().collect();
            for (i, (answer, [down, up])) in answers.iter().zip(&mut squares).enumerate() {
                let changes = sides.iter().map(|side| side.answers[i] - answer.value);
                let finite = changes.filter(|change| change.is_finite());
                let ends = finite.fold([0.0_f64; 2], |[low, high], by| [low.min(by), high.max(by)]);
                (*down, *up) = (*down + ends[0].powi(2), *up + ends[1].powi(2));
            }
        }
        let found = answers.iter().zip(squares);
        found.filter_map(|(answer, [down, up])| self.judged(answer, down.max(up).sqrt())).collect()
    }

    fn judged(&self, answer: &Answer, found: f64) -> Option<Bent> {
        let linear = NORMAL_95 * answer.deviation.value;
        let error = (ERROR * answer.value.abs()).max(TOLERANCES * self.run.tolerance());
        let bent = found - linear > BEYOND * linear + error;
        bent.then_some(Bent { of: answer.of, linear, found })
    }

    /// The run with the parameters of a direction at this normal number.
    fn moved(&self, direction: &[(Uncertain, f64)], score: f64) -> Result<Sample, NoSample> {
        let mut parameters = self.parameters.clone();
        for (input, part) in direction {
            let to = input.moved(input.value, input.standard(score) * part);
            parameters.set(input.parameter, to);
        }
        self.sample(&parameters, false, &|| Proceed::Continue)
    }
}
