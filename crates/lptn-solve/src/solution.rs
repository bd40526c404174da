//! The result of a transient.

use lptn_assembly::{ThermalSystem, Workspace};
use lptn_integrate::Statistics;
use lptn_network::{BoundaryId, ConductorId, Network, NodeId, SourceId};

use crate::ledger::Ledger;
use crate::limit::LimitSeen;
use crate::watch::Seen;

/// How a run ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum End {
    /// It reached its stop.
    Reached,
    /// It was asked to end at this time in s; the rows up to then are whole.
    Interrupted(f64),
    /// It broke off at this time in s; the rows up to then are whole.
    Failed(f64),
}

/// Temperatures over time, from which heat flows follow. Times increase strictly, one row each.
#[derive(Clone, Debug)]
pub struct Solution {
    pub(crate) system: ThermalSystem,
    pub(crate) times: Vec<f64>,
    /// For each row a time inside its segment: comparisons of `t` are read there.
    pub(crate) segments: Vec<f64>,
    /// The nodes that were recorded, ascending.
    pub(crate) recorded: Vec<NodeId>,
    /// Row by row, one temperature in K for each recorded node.
    pub(crate) temperatures: Vec<f64>,
    pub(crate) seen: Vec<Seen>,
    pub(crate) limits: Vec<LimitSeen>,
    pub(crate) ledger: Ledger,
    pub(crate) statistics: Statistics,
    pub(crate) end: End,
    pub(crate) tolerance: f64,
}

impl Solution {
    /// The network that was run.
    pub fn network(&self) -> &Network {
        self.system.network()
    }

    /// The time of each row in s.
    pub fn times(&self) -> &[f64] {
        &self.times
    }

    /// The recorded nodes, ascending.
    pub fn recorded(&self) -> &[NodeId] {
        &self.recorded
    }

    /// Temperatures of the recorded nodes in one row, in K.
    pub fn row(&self, row: usize) -> &[f64] {
        let width = self.recorded.len();
        &self.temperatures[row * width..(row + 1) * width]
    }

    /// Temperature of a node over the rows in K; `None` if it was not recorded.
    pub fn temperature(&self, node: NodeId) -> Option<Vec<f64>> {
        let column = self.recorded.binary_search(&node).ok()?;
        let rows = self.temperatures.chunks_exact(self.recorded.len());
        Some(rows.map(|row| row[column]).collect())
    }

    /// Heat flow of a conductor over the rows in W, positive from `from` to `to`; `None` unless every node was
    /// recorded.
    pub fn conductor_heat(&self, id: ConductorId) -> Option<Vec<f64>> {
        let mut heat = vec![0.0; self.network().conductors().len()];
        self.replay(|system, work| {
            system.conductor_heat(work, &mut heat);
            heat[id.index()]
        })
    }

    /// Heat that a boundary gives to the network over the rows in W; `None` unless every node was recorded.
    pub fn boundary_heat(&self, id: BoundaryId) -> Option<Vec<f64>> {
        let mut heat = vec![0.0; self.network().boundaries().len()];
        self.replay(|system, work| {
            system.boundary_heat(work, &mut heat);
            heat[id.index()]
        })
    }

    /// Temperature of a boundary over the rows in K.
    pub fn boundary_temperature(&self, id: BoundaryId) -> Vec<f64> {
        self.inputs(|system, work| system.boundary_temperatures(work)[id.index()])
    }

    /// Heat of a source over the rows in W.
    pub fn source_heat(&self, id: SourceId) -> Vec<f64> {
        self.inputs(|system, work| system.source_powers(work)[id.index()])
    }

    /// Evaluates the system at every row; the inputs could be read there during the run, so they can be again.
    pub(crate) fn replay<T>(&self, mut value: impl FnMut(&ThermalSystem, &Workspace) -> T) -> Option<Vec<T>> {
        if self.recorded.len() != self.network().nodes().len() {
            return None;
        }
        let mut work = self.system.workspace();
        let rows = self.times.iter().zip(&self.segments).zip(0..);
        rows.map(|((&time, &segment), row)| {
            self.system.read_inputs(&mut work, time, segment).ok()?;
            self.system.place(&mut work, self.row(row));
            Some(value(&self.system, &work))
        })
        .collect()
    }

    fn inputs(&self, mut value: impl FnMut(&ThermalSystem, &Workspace) -> f64) -> Vec<f64> {
        let mut work = self.system.workspace();
        let rows = self.times.iter().zip(&self.segments);
        rows.map(|(&time, &segment)| match self.system.read_inputs(&mut work, time, segment) {
            Ok(()) => value(&self.system, &work),
            Err(_) => f64::NAN,
        })
        .collect()
    }

    /// What was seen of the watched nodes between the rows too, in the order they were named.
    pub fn seen(&self) -> &[Seen] {
        &self.seen
    }

    /// How each limit of the network fared up to the end that was reached, between the rows too.
    pub fn limits(&self) -> &[LimitSeen] {
        &self.limits
    }

    /// The energy ledger from the start to the end that was reached.
    pub fn ledger(&self) -> &Ledger {
        &self.ledger
    }

    /// Counters of the integrator; all zero for a network without state.
    pub fn statistics(&self) -> &Statistics {
        &self.statistics
    }

    /// How the run ended.
    pub fn end(&self) -> End {
        self.end
    }

    /// The tolerance of the run in K.
    pub fn tolerance(&self) -> f64 {
        self.tolerance
    }

    /// Whether the error stays within ten times the tolerance: every node leads to a boundary, so that errors
    /// are forgotten. Otherwise it adds up over the run and the tolerance does not bound it.
    pub fn error_is_bounded(&self) -> bool {
        self.network().ungrounded().is_empty()
    }
}
