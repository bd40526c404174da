//! The cycle to which a candidate settles whose inputs repeat themselves.

use std::sync::Arc;

use lptn_assembly::ThermalSystem;
use lptn_network::{OutputTimes, RunSettings};
use lptn_solve::{
    Periodic, PeriodicError, Proceed, Progress, RecordedNodes, Solution, Summary, Transient,
    TransientError, Watch,
};

use crate::compare::error::CompareError;
use crate::compare::heat;
use crate::compare::limits::{self, LimitResult};
use crate::compare::peak::{Peak, hottest, peak};

/// What is compared of a settled cycle. Temperatures in K, times in s.
#[derive(Clone, Debug)]
pub struct Settled {
    /// The name of the node that gets hottest in it; `None` for boundaries alone.
    pub hottest: Option<String>,
    /// Its highest temperature.
    pub peak: Option<Peak>,
    /// How long the cycle is.
    pub period: f64,
    /// Every limit over the cycle, in the order of the network.
    pub limits: Vec<LimitResult>,
}

/// A settled cycle, and what was integrated of it.
pub(crate) struct Found {
    pub(crate) settled: Settled,
    pub(crate) solution: Solution,
}

/// A settled cycle, or why there is none; nothing where signals do not repeat themselves.
pub(crate) type Search = Option<Result<Found, Arc<PeriodicError>>>;

impl Settled {
    /// The settled cycle where signals repeat themselves and it can be found; the reason where they do
    /// and it cannot; nothing where they do not.
    ///
    /// # Errors
    /// [`CompareError::Interrupted`].
    pub(crate) fn find(
        system: &ThermalSystem,
        run: Option<&RunSettings>,
        observer: &mut dyn FnMut(Progress) -> Proceed,
    ) -> Result<Search, CompareError> {
        let Ok(Some(period)) = system.network().repeat_period() else { return Ok(None) };
        let cycle = RunSettings::cycle(run, period);
        match Periodic::find_observed(system, &transient(system, &cycle), observer) {
            Ok(found) => {
                let (settled, solution) = (Self::of(&found, &cycle), found.solution);
                Ok(Some(Ok(Found { settled, solution })))
            }
            Err(PeriodicError::Interrupted { .. }) => Err(CompareError::Interrupted(cycle.start)),
            Err(PeriodicError::Cycle(open @ TransientError::Open { .. })) => {
                Err(CompareError::Run(Box::new(open)))
            }
            Err(reason) => Ok(Some(Err(Arc::new(reason)))),
        }
    }

    fn of(found: &Periodic, cycle: &RunSettings) -> Self {
        let (solution, network) = (&found.solution, found.solution.network());
        let nodes = Summary::new(solution, None).nodes;
        let node = hottest(nodes.iter().map(|node| (node, node.peak.0))).map(|(node, _)| node);
        Self {
            hottest: node.map(|node| network.nodes()[node.node.index()].name.clone()),
            peak: node.map(|node| peak(node, cycle)),
            period: cycle.stop - cycle.start,
            // a cycle has no first time
            limits: limits::over_time(network, solution.limits())
                .into_iter()
                .map(|limit| LimitResult { broken_at: None, ..limit })
                .collect(),
        }
    }
}

/// The cycle without its rows, and with every node watched.
fn transient(system: &ThermalSystem, cycle: &RunSettings) -> Transient {
    let network = system.network();
    let of = Transient::of(network, cycle);
    let output = OutputTimes::At(vec![cycle.stop]);
    let windows = heat::window(network, (cycle.start, cycle.stop)).into_iter().collect();
    Transient {
        output,
        windows,
        record: RecordedNodes::Nodes(Vec::new()),
        watch: network.node_ids().map(|node| Watch { node, level: None }).collect(),
        hottest_only: true,
        ..of
    }
}
