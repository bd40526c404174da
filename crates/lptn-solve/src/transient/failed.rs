//! Reasons why a run breaks off.

use lptn_integrate::{FactorError, IntegrateError};
use lptn_network::NodeId;

use super::{Break, Run};
use crate::newton_error::NewtonError;
use crate::runaway::Runaway;
use crate::stop_reason::StopReason;
use crate::unsolved::Unsolved;

/// Steps shorter than this part of the run, each after refused ones, make no progress …
const CRAWL: f64 = 1e-9;

/// … if there are this many. The first step of a segment may be one of them by chance.
const PATIENCE: usize = 8;

/// A capacity below this share of that at the start is none.
const EMPTY: f64 = 1e-9;

/// The same before the end of a branch.
const FOLD_PATIENCE: usize = 400;

impl Run<'_> {
    /// Breaks off a run that only creeps, with ever smaller steps, up to where its heat fails.
    pub(super) fn check_crawl(&mut self, step: f64) -> Result<(), Break> {
        let (start, stop) = self.recorder.span();
        let refused = self.integrator.system_mut().refused.take();
        // a fold is approached in short steps before the jump over it
        let patience = match refused {
            Some(NewtonError::Fold { .. }) => FOLD_PATIENCE,
            _ => PATIENCE,
        };
        if step >= CRAWL * (stop - start) {
            self.crawled = 0;
            return Ok(());
        }
        self.crawled += usize::from(refused.is_some());
        match refused {
            Some(failure) if self.crawled >= patience => Err(Break::Failed(self.reason(failure))),
            _ => Ok(()),
        }
    }

    fn reason(&self, failure: NewtonError) -> StopReason {
        match failure {
            NewtonError::Input(input) => StopReason::Input(input),
            other => self.empty().unwrap_or_else(|| {
                StopReason::Unsolved(Unsolved::new(self.recorder.system(), other))
            }),
        }
    }

    /// The runaway of a network that became hotter and hotter, if that is why no step succeeds.
    fn runaway(&mut self) -> Option<StopReason> {
        let (time, last) = (self.integrator.time(), self.unknowns()?);
        let system = self.recorder.system();
        let positions = self.switching.as_ref().map(|switching| switching.positions.clone());
        let runaway = Runaway::of(system, (time, &positions.unwrap_or_default()), &last)?;
        Some(runaway.reason(system))
    }

    /// The first node of which nothing is left: its capacity follows states that fell to zero.
    fn empty(&self) -> Option<StopReason> {
        let (system, y) = (self.recorder.system(), self.integrator.state());
        let (network, mut work) = (system.network(), system.workspace());
        let contents = system.capacities_of_states(&mut work, y);
        let node = |id: &NodeId| network.nodes()[id.index()].name.clone();
        let mut all = network.state_capacities().iter().zip(contents);
        all.find(|(of, now)| *now <= EMPTY * network.capacity(of.node)).map(|(of, capacity)| {
            let states = of.states.iter().map(node).collect();
            StopReason::Empty { node: node(&of.node), capacity, states }
        })
    }

    /// The reason of a failure: that of the system has precedence over that of the integrator.
    pub(super) fn failed(&mut self, error: IntegrateError) -> Break {
        if let Some(failure) = self.integrator.system_mut().failure.take() {
            return Break::Failed(self.reason(failure));
        }
        if let IntegrateError::Linear { cause: FactorError::Singular { index: unknown }, .. } =
            error
        {
            return Break::Failed(self.reason(NewtonError::Singular { unknown }));
        }
        if let Some(reason) = self.empty().or_else(|| self.runaway()) {
            return Break::Failed(reason);
        }
        let node = error.component().map(|state| self.recorder.state_name(state));
        Break::Failed(StopReason::Integrator { error, node })
    }
}
