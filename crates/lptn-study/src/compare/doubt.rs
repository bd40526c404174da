//! Uncertainty of compared results, and of the difference between two candidates.

use lptn_analysis::RunAnalysis;
use lptn_network::{LimitId, Network, Parameters, RunSettings};
use lptn_units::statistics::share_below;

use crate::uncertainty::{
    Answer, AnswerOf, Bent, Inputs, UncertaintyError, UncertaintyMethod, UncertaintyTask, uncertain,
};

/// Effects of the `±` of parameters on the compared results of a candidate, by straight lines.
#[derive(Clone, Debug)]
pub struct Scatter {
    /// One standard deviation of the peak in K.
    pub peak: f64,
    /// For each limit of the network one standard deviation of its margin in SI units, and the
    /// probability that it is broken.
    pub limits: Vec<(f64, f64)>,
    /// Results that straight lines get wrong.
    pub bent: Vec<Bent>,
    /// The peak in K.
    value: f64,
    /// Change of the peak in K with one standard deviation of each parameter, by name.
    effects: Vec<(String, f64)>,
    /// The names of the inputs.
    names: Vec<String>,
    inputs: Inputs,
}

/// Difference between one peak and another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Above {
    /// In K.
    pub by: f64,
    /// One standard deviation of that in K.
    pub deviation: f64,
    /// The probability that it is above.
    pub probability: f64,
}

impl Scatter {
    /// Scatter of the run of a network with these parameters, `hottest` being the node that gets
    /// hottest; `None` if every parameter is certain, or there is no such node.
    ///
    /// # Errors
    /// [`UncertaintyError`].
    pub fn of_run(
        network: &Network,
        (parameters, run): (&Parameters, &RunSettings),
        hottest: &str,
    ) -> Result<Option<Self>, UncertaintyError> {
        let inputs = match uncertain(network, parameters) {
            Err(UncertaintyError::NoDeviation) => return Ok(None),
            inputs => inputs?,
        };
        let Ok(node) = network.node(hottest) else { return Ok(None) };
        let (parameters, run) = (parameters.clone(), RunAnalysis::of(network, run));
        let found = UncertaintyTask { network, parameters, run, nodes: vec![node] }.linear()?;
        let name = |i: usize| network.parameters()[inputs[i].parameter.index()].name.clone();
        let of = |wanted: AnswerOf| found.answers.iter().find(|answer| answer.of == wanted);
        let Some(peak) = of(AnswerOf::Max(node)) else { return Ok(None) };
        let limit = |id: LimitId| {
            let judged = |answer: &Answer| (answer.deviation.value, answer.below_zero.value);
            of(AnswerOf::Margin(id)).map_or((f64::NAN, f64::NAN), judged)
        };
        Ok(Some(Self {
            peak: peak.deviation.value,
            limits: network.limit_ids().map(limit).collect(),
            bent: match &found.method {
                UncertaintyMethod::Linear { bent, .. } => bent.clone(),
                UncertaintyMethod::Sobol { .. } => Vec::new(),
            },
            value: peak.value,
            effects: peak.ranking.iter().map(|part| (name(part.input), part.effect)).collect(),
            names: (0..inputs.len()).map(name).collect(),
            inputs,
        }))
    }

    /// Difference of the peak from that of another candidate. Parameters of one name are the same:
    /// they deviate by as many of their standard deviations in both, and a correlation in one
    /// applies to both.
    pub fn above(&self, other: &Self) -> Above {
        let mut all: Vec<(&str, f64)> =
            self.effects.iter().map(|(name, effect)| (name.as_str(), *effect)).collect();
        for (name, effect) in &other.effects {
            match all.iter_mut().find(|(own, _)| own == name) {
                Some((_, own)) => *own -= effect,
                None => all.push((name, -effect)),
            }
        }
        let tied = |a: &str, b: &str| self.tied(a, b).or_else(|| other.tied(a, b)).unwrap_or(0.0);
        let with = |a: &str| -> f64 {
            all.iter().map(|(b, effect)| if a == *b { *effect } else { effect * tied(a, b) }).sum()
        };
        let variance: f64 = all.iter().map(|(a, effect)| effect * with(a)).sum();
        let (by, deviation) = (self.value - other.value, variance.max(0.0).sqrt());
        let certain = f64::from(u8::from(by > 0.0));
        let probability = if deviation > 0.0 { share_below(by / deviation) } else { certain };
        Above { by, deviation, probability }
    }

    /// The correlation of two parameters by name; `None` if it does not have both.
    fn tied(&self, a: &str, b: &str) -> Option<f64> {
        // effects are in the order of the ranking, inputs in that of the network
        let place = |name: &str| self.names.iter().position(|own| own == name);
        Some(self.inputs.correlations().between(place(a)?, place(b)?))
    }
}
