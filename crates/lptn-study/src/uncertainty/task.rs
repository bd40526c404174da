//! What is asked, and one run of it.

use lptn_assembly::ThermalSystem;
use lptn_network::{Network, NodeId, OutputTimes, Parameters};
use lptn_solve::{Proceed, RecordedNodes, RunStatus, Solution, Transient, TransientError, Watch};

use crate::uncertainty::answer::AnswerOf;
use crate::uncertainty::error::UncertaintyError;
use crate::uncertainty::sample::{NoSample, Sample};

/// A run whose uncertainty is asked for.
#[derive(Debug)]
pub struct UncertaintyTask<'a> {
    /// The network with every parameter at its own value.
    pub network: &'a Network,
    /// The values that were set in place of the network's own; see [`Network::overrides`].
    pub parameters: Parameters,
    /// The times, the tolerance and the controls at the start; what is recorded and watched is
    /// chosen by the method. The times stay as they are, also where they were computed from a
    /// parameter with `±`.
    pub run: Transient,
    /// The nodes whose temperatures are asked for, ascending.
    pub nodes: Vec<NodeId>,
}

impl UncertaintyTask<'_> {
    /// The numbers that are asked for beside the rows.
    pub(crate) fn questions(&self) -> Vec<AnswerOf> {
        let of_node = |&node: &NodeId| [AnswerOf::End(node), AnswerOf::Max(node)];
        let margins = self.network.limit_ids().map(AnswerOf::Margin);
        self.nodes.iter().flat_map(of_node).chain(margins).collect()
    }

    /// The time of each row in s.
    pub(crate) fn times(&self) -> Result<Vec<f64>, UncertaintyError> {
        let failed = |error| UncertaintyError::Run(Box::new(TransientError::Settings(error)));
        self.run.rows().map_err(failed)
    }

    /// The run with what has to be recorded and watched.
    pub(crate) fn watched(&self) -> Transient {
        let watch = self.nodes.iter().map(|&node| Watch { node, level: None }).collect();
        let (record, windows) = (RecordedNodes::Nodes(self.nodes.clone()), Vec::new());
        Transient { record, watch, windows, balance: None, ..self.run.clone() }
    }

    /// Runs the network with other parameters; without `rows` only what is asked for beside them.
    pub(crate) fn sample(
        &self,
        parameters: &Parameters,
        rows: bool,
        control: &(dyn Fn() -> Proceed + Sync),
    ) -> Result<Sample, NoSample> {
        let system = ThermalSystem::of(self.network, parameters)
            .map_err(|error| NoSample::refused(&error))?;
        let solution =
            self.solve(&system, rows, control).map_err(|error| NoSample::failed(&error))?;
        match solution.end() {
            RunStatus::Interrupted(_) => Err(NoSample::Interrupted),
            _ => Ok(Sample::of(&solution, rows)),
        }
    }

    /// The run of an assembled network.
    pub(crate) fn solve(
        &self,
        system: &ThermalSystem,
        rows: bool,
        control: &(dyn Fn() -> Proceed + Sync),
    ) -> Result<Solution, TransientError> {
        let mut run = self.watched();
        // without states nothing is watched between the rows
        if !rows && !system.states().is_empty() {
            run.output = OutputTimes::At(vec![run.stop]);
        }
        run.solve_observed(system, &mut |_| control())
    }
}
