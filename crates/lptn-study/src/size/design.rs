//! Designs: values of several parameters, and what the best one has least or most of.

use lptn_netlist::Goal;
use lptn_network::{ParameterId, Value};

use crate::size::error::SizeError;
use crate::size::judge::{Care, Demand, Judge, Judged};

/// What the best design has least or most of.
#[derive(Clone, Copy, Debug)]
pub struct Aim<'a> {
    /// The quantity: an expression of parameters.
    pub value: &'a Value,
    /// Whether the best design has least or most of it.
    pub goal: Goal,
}

/// Values of several parameters, and what came of them.
#[derive(Clone, Debug)]
pub struct Design {
    /// The values in SI units, in the order of the parameters.
    pub values: Vec<f64>,
    /// What is sought, in SI units.
    pub objective: f64,
    /// What came of it.
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
        Ok(Self { judge: Judge::new(demand)?, aim, parameters })
    }

    fn with_values(&self, values: &[f64]) -> Vec<(ParameterId, f64)> {
        self.parameters.iter().copied().zip(values.iter().copied()).collect()
    }

    pub(crate) fn judge(&self, values: &[f64], care: Care) -> Result<Design, SizeError> {
        let judged = self.judge.judge(&self.with_values(values), care)?;
        Ok(Design { values: values.to_vec(), objective: self.objective(values)?, judged })
    }

    /// What is sought, without a look at what has to be kept.
    pub(crate) fn objective(&self, values: &[f64]) -> Result<f64, SizeError> {
        self.judge.value(&self.with_values(values), self.aim.value)
    }

    /// What is sought as something of which less is better.
    pub(crate) fn cost(&self, objective: f64) -> f64 {
        match self.aim.goal {
            Goal::Minimise => objective,
            Goal::Maximise => -objective,
        }
    }
}
