//! Summary of a run: start, end, peak, steady state, time to 95 % of the rise.

use lptn_assembly::ThermalSystem;
use lptn_network::NodeId;

use crate::newton_error::NewtonError;
use crate::solution::Solution;
use crate::steady::SteadyState;
use crate::times::just_after;
use crate::unfold::Unfold;
use crate::unsolved::Unsolved;
use crate::watch::Watch;

/// The share of the rise whose time is given: three time constants of a single exponential.
const SHARE: f64 = 0.95;

/// A steady rise smaller than this, in K, does not count: its 95 % would be noise.
const LEAST_RISE: f64 = 1e-6;

/// One node of a summary. Temperatures in K, times in s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NodeSummary {
    /// The node.
    pub node: NodeId,
    /// Temperature at the start.
    pub start: f64,
    /// Temperature at the end.
    pub end: f64,
    /// Highest temperature and when it was first there.
    pub peak: (f64, f64),
    /// Temperature in steady state, if inputs are constant and there is one.
    pub steady: Option<f64>,
    /// Time from the start to 95 % of the way from start to steady state; `None` if that is not
    /// known or was not reached.
    pub time_to_95: Option<f64>,
}

impl NodeSummary {
    /// The share of the way from start to steady state that the record covers; `None` if there is
    /// no such way.
    pub fn reached(&self) -> Option<f64> {
        let rise = self.steady? - self.start;
        (rise.abs() > LEAST_RISE).then(|| (self.end - self.start) / rise)
    }
}

/// A summary of the watched nodes of a run.
#[derive(Clone, Debug)]
pub struct Summary {
    /// One entry for each watched node, in the order they were named.
    pub nodes: Vec<NodeSummary>,
}

impl Summary {
    /// The watches that a summary of `nodes` needs, to be put into [`crate::Transient::watch`].
    ///
    /// # Errors
    /// [`Unsolved`] if a value cannot be computed at the start, or the balances of massless nodes
    /// have no solution there.
    pub fn watches(
        system: &ThermalSystem,
        start: f64,
        nodes: &[NodeId],
        steady: Option<&SteadyState>,
    ) -> Result<Vec<Watch>, Unsolved> {
        let mut work = system.workspace();
        let unsolved = |error| Unsolved::new(system, error);
        let inputs = system.read_inputs(&mut work, start, just_after(start));
        inputs.map_err(|error| unsolved(NewtonError::Input(error)))?;
        let mut unfold = Unfold::at_start(system).map_err(unsolved)?;
        let temperatures = unfold.temperatures(&mut work, &system.initial()).map_err(unsolved)?;
        system.recover(&mut work, temperatures);
        let initial = system.node_temperatures(&work);
        let level = |node: NodeId| {
            let (from, to) = (initial[node.index()], steady?.temperatures[node.index()]);
            ((to - from).abs() > LEAST_RISE).then_some(from + SHARE * (to - from))
        };
        Ok(nodes.iter().map(|&node| Watch { node, level: level(node) }).collect())
    }

    /// Summarises the nodes that `solution` watched.
    pub fn new(solution: &Solution, steady: Option<&SteadyState>) -> Self {
        let start = solution.times().first().copied().unwrap_or(0.0);
        let one = |seen: &crate::Watched| NodeSummary {
            node: seen.watch.node,
            start: seen.first(),
            end: seen.last(),
            peak: seen.peak,
            steady: steady.map(|s| s.temperatures[seen.watch.node.index()]),
            time_to_95: seen.crossed.map(|time| time - start),
        };
        Self { nodes: solution.watched().iter().map(one).collect() }
    }
}
