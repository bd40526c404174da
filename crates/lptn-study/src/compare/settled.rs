//! The cycle to which a candidate with repeating inputs settles.
//!
//! Repeating signals ask for the periodic steady state, so `compare` computes it without an option.
//! Without a `[run]` it is the state that is compared, because no other moment has a meaning. Heat
//! comes from the ledger, heat by path from a window over the run.

use std::sync::Arc;

use lptn_analysis::{CycleError, Observer, Trusted};
use lptn_assembly::ThermalSystem;
use lptn_network::RunSettings;
use lptn_solve::{Periodic, PeriodicError, Summary};

use crate::compare::asked::{all_nodes, bare};
use crate::compare::error::CompareError;
use crate::compare::limits::{self, CandidateLimit};
use crate::compare::peak::{Peak, hottest, peak};

/// The compared results of a periodic steady state. Temperatures in K, times in s.
#[derive(Clone, Debug)]
pub struct Settled {
    /// The name of the node that gets hottest in it; `None` for boundaries alone.
    pub hottest: Option<String>,
    /// Its highest temperature.
    pub peak: Option<Peak>,
    /// The period of the cycle.
    pub period: f64,
    /// Every limit over the cycle, in the order of the network.
    pub limits: Vec<CandidateLimit>,
}

/// A periodic steady state with its answer.
pub(crate) struct Found {
    pub(crate) settled: Settled,
    pub(crate) limits: Vec<lptn_analysis::LimitResult>,
    pub(crate) answer: Trusted<Periodic>,
}

/// A periodic steady state, or why there is none; nothing if signals do not repeat themselves.
pub(crate) type Search = Option<Result<Found, Arc<PeriodicError>>>;

impl Settled {
    /// The settled cycle if signals repeat themselves and it can be found; the reason if they do
    /// and it cannot; nothing if they do not.
    ///
    /// # Errors
    /// [`CompareError`] if it was interrupted, or its energy balance does not close.
    pub(crate) fn find(
        system: &ThermalSystem,
        run: Option<&RunSettings>,
        observer: &mut Observer<'_>,
    ) -> Result<Search, CompareError> {
        let network = system.network();
        let Ok(Some(period)) = network.repeat_period() else { return Ok(None) };
        let cycle = RunSettings::cycle(run, period);
        let asked = bare(network, &cycle).watching(all_nodes(network)).for_the_hottest();
        match asked.cycle(system, observer) {
            Ok(answer) => Ok(Some(Ok(Self::of(system, (answer, &cycle))))),
            Err(CycleError::Missing(reason)) => Ok(Some(Err(Arc::from(reason)))),
            Err(CycleError::Run(error)) => Err(error.into()),
        }
    }

    fn of(system: &ThermalSystem, (answer, cycle): (Trusted<Periodic>, &RunSettings)) -> Found {
        let network = system.network();
        let nodes = Summary::new(&answer.solution, None).nodes;
        let node = hottest(nodes.iter().map(|node| (node, node.peak.0))).map(|(node, _)| node);
        let limits = lptn_analysis::LimitResult::of_cycle(&answer);
        let settled = Self {
            hottest: node.map(|node| network.nodes()[node.node.index()].name.clone()),
            peak: node.map(|node| peak(node, cycle)),
            period: cycle.stop - cycle.start,
            limits: limits::named(network, &limits),
        };
        Found { settled, limits, answer }
    }
}
