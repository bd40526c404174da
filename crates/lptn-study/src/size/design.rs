//! Designs: values of several parameters, and the objective.

use lptn_network::{Network, ParameterId};

use crate::size::aim::Aim;
use crate::size::error::SizeError;
use crate::size::judge::{Care, Demand, Judge, Judged};

/// Values of several parameters, and their results.
#[derive(Clone, Debug)]
pub struct Design {
    /// The values in SI units, in the order of the parameters.
    pub values: Vec<f64>,
    /// The objective in SI units.
    pub objective: f64,
    /// The results.
    pub judged: Judged,
}

/// Judges designs that are given by values of the same parameters.
pub(crate) struct Designs<'a> {
    pub(crate) judge: Judge<'a>,
    pub(crate) aim: Aim<'a>,
    pub(crate) parameters: Vec<ParameterId>,
}

impl<'a> Designs<'a> {
    pub(crate) fn new(
        demand: Demand<'a>,
        aim: Aim<'a>,
        parameters: Vec<ParameterId>,
    ) -> Result<Self, SizeError> {
        let judge = Judge::seeking(demand, Some(aim).filter(|aim| aim.of_results))?;
        Ok(Self { judge, aim, parameters })
    }

    fn with_values(&self, values: &[f64]) -> Vec<(ParameterId, f64)> {
        self.parameters.iter().copied().zip(values.iter().copied()).collect()
    }

    pub(crate) fn judge(&self, values: &[f64], care: Care) -> Result<Design, SizeError> {
        let judged = self.judge.judge(&self.with_values(values), care)?;
        let objective = match judged.objective {
            Some(objective) => objective,
            None => self.objective(values)?,
        };
        Ok(Design { values: values.to_vec(), objective, judged })
    }

    /// The network with these values.
    pub(crate) fn network(&self, values: &[f64]) -> Result<Network, SizeError> {
        self.judge.network(&self.with_values(values))
    }

    /// The objective if it follows from parameters, without evaluating the requirements.
    pub(crate) fn objective(&self, values: &[f64]) -> Result<f64, SizeError> {
        self.judge.value(&self.with_values(values), self.aim.value)
    }

    /// The objective as a cost, of which less is better.
    pub(crate) fn cost(&self, objective: f64) -> f64 {
        self.aim.cost(objective)
    }
}
