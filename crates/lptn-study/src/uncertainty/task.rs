//! A task of uncertainty, and one run of it.

use lptn_analysis::{RunAnalysis, RunError, Trusted};
use lptn_assembly::ThermalSystem;
use lptn_network::{Network, NodeId, Parameters};
use lptn_solve::{Proceed, RecordedNodes, Solution};

use crate::uncertainty::answer::AnswerOf;
use crate::uncertainty::error::UncertaintyError;
use crate::uncertainty::sample::{NoSample, Sample};

/// A run whose uncertainty is to be computed.
#[derive(Debug)]
pub struct UncertaintyTask<'a> {
    /// The network with every parameter at its own value.
    pub network: &'a Network,
    /// The values that were set instead of the network's own; see [`Network::overrides`].
    pub parameters: Parameters,
    /// The times, the tolerance and the controls at the start; the method chooses the nodes to
    /// record and watch. The times stay as they are, even if they were computed from a parameter
    /// with `±`.
    pub run: RunAnalysis,
    /// The requested nodes, ascending.
    pub nodes: Vec<NodeId>,
}

impl UncertaintyTask<'_> {
    /// The requested numbers in addition to the rows.
    pub(crate) fn questions(&self) -> Vec<AnswerOf> {
        let of_node = |&node: &NodeId| [AnswerOf::End(node), AnswerOf::Max(node)];
        let margins = self.network.limit_ids().map(AnswerOf::Margin);
        self.nodes.iter().flat_map(of_node).chain(margins).collect()
    }

    /// The time of each row in s.
    pub(crate) fn times(&self) -> Result<Vec<f64>, UncertaintyError> {
        Ok(self.run.rows()?)
    }

    /// The run with the nodes to be recorded and watched.
    pub(crate) fn watched(&self) -> RunAnalysis {
        let record = RecordedNodes::Nodes(self.nodes.clone());
        self.run.clone().bare().keeping(record).watching(self.nodes.iter().copied())
    }

    /// Runs the network with other parameters; without `rows` only the numbers other than the rows.
    pub(crate) fn sample(
        &self,
        parameters: &Parameters,
        rows: bool,
        control: &(dyn Fn() -> Proceed + Sync),
    ) -> Result<Sample, NoSample> {
        let system = ThermalSystem::of(self.network, parameters)
            .map_err(|error| NoSample::refused(&error))?;
        match self.solve(&system, rows, control) {
            Ok(answer) => Ok(Sample::of(&answer, rows)),
            Err(RunError::Interrupted { .. }) => Err(NoSample::Interrupted),
            Err(error) => Err(NoSample::failed(&error)),
        }
    }

    /// The run of an assembled network.
    pub(crate) fn solve(
        &self,
        system: &ThermalSystem,
        rows: bool,
        control: &(dyn Fn() -> Proceed + Sync),
    ) -> Result<Trusted<Solution>, RunError> {
        let run = if rows { self.watched() } else { self.watched().at(Vec::new()) };
        run.solve(system, &mut |_| control())
    }
}
