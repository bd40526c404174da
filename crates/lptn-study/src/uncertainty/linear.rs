//! Straight lines from the exact sensitivities of one run.

mod bent;
mod line;
mod margins;

use lptn_assembly::ThermalSystem;
use lptn_solve::Proceed;
use lptn_units::statistics::{NORMAL_95, share_below};

use crate::uncertainty::answer::{Answer, AnswerOf, Contribution};
use crate::uncertainty::error::UncertaintyError;
use crate::uncertainty::estimate::Estimate;
use crate::uncertainty::input::{Inputs, uncertain};
use crate::uncertainty::linear::line::Line;
use crate::uncertainty::result::{Uncertainty, UncertaintyMethod};
use crate::uncertainty::sample::Sample;
use crate::uncertainty::task::UncertaintyTask;

impl UncertaintyTask<'_> {
    /// Bands and shares of the variance from `dT/dp`: the variance of a result is the sum of
    /// `(dT/dp sigma)^2`, with twice the correlation times their product for each pair that is
    /// correlated, its band 1.96 standard deviations to each side of the value (ISO/IEC Guide 98-3,
    /// 5.1.2 and 5.2.2). A maximum changes as the temperature does at its time, a margin as it does
    /// when it is least: on its own side, if something jumps there. If a network has no exact
    /// sensitivities, they are differences of runs, and the method reports it. Two runs for each
    /// parameter find the results that straight lines get wrong.
    ///
    /// # Errors
    /// [`UncertaintyError`].
    pub fn linear(&self) -> Result<Uncertainty, UncertaintyError> {
        let inputs = uncertain(self.network, &self.parameters)?;
        let system = ThermalSystem::assemble(self.network).map_err(UncertaintyError::Assembly)?;
        let solution = self.solve(&system, true, &|| Proceed::Continue)?;
        let sample = Sample::of(&solution, true);
        let line = Line::new(self, &inputs, &solution)?;
        let margins = margins::effects(self, &line, &solution)?;
        let answer = |(of, &value): (AnswerOf, &f64)| {
            let effects = match of {
                AnswerOf::End(node) => line.effects(node, line.end()),
                AnswerOf::Max(node) => line.effects_on_maximum(node),
                AnswerOf::Margin(limit) => margins[limit.index()].clone(),
            };
            answer(of, value, (&effects, &inputs))
        };
        let answers: Vec<Answer> =
            self.questions().into_iter().zip(&sample.answers).map(answer).collect();
        let bent = self.bent(&inputs, &answers);
        Ok(Uncertainty {
            method: UncertaintyMethod::Linear { differences: line.differences(), bent },
            times: self.times()?,
            bands: self.nodes.iter().map(|&node| line.bands(node)).collect(),
            answers,
            inputs,
        })
    }
}

/// Effects below this part of a result (3e-7 K at room temperature) are rounding of the run.
const ROUNDING: f64 = 1e-9;

/// A result whose change with one standard deviation more of each parameter is known.
fn answer(of: AnswerOf, value: f64, (effects, inputs): (&[f64], &Inputs)) -> Answer {
    let least = ROUNDING * value.abs();
    let effects: Vec<f64> =
        effects.iter().map(|e| if e.abs() > least { *e } else { 0.0 }).collect();
    let together = inputs.together(&effects);
    let variance = inputs.variance(&effects).max(0.0);
    let deviation = variance.sqrt();
    let share = |input: usize, effect: f64| {
        if variance > 0.0 { effect * together[input] / variance } else { 0.0 }
    };
    let part = |(input, &effect): (usize, &f64)| Contribution {
        input,
        effect,
        share: Estimate::exact(share(input, effect)),
        total: None,
    };
    let below_zero =
        if deviation > 0.0 { share_below(-value / deviation) } else { f64::from(value < 0.0) };
    Answer {
        of,
        value,
        deviation: Estimate::exact(deviation),
        low: Estimate::exact(value - NORMAL_95 * deviation),
        median: None,
        high: Estimate::exact(value + NORMAL_95 * deviation),
        below_zero: Estimate::exact(below_zero),
        ranking: effects.iter().enumerate().map(part).collect(),
    }
    .sorted()
}
