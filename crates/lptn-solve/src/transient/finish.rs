//! The solution of a run that has ended.

use std::sync::Arc;

use lptn_integrate::Statistics;

use crate::certify::Certifier;
use crate::error::TransientError;
use crate::events::Switching;
use crate::growth;
use crate::guard::Guard;
use crate::settings::FINEST;
use crate::solution::{RunStatus, Solution};
use crate::state::State;
use crate::transient::Run;

impl Run<'_> {
    /// Change of the heat content of each node whose capacity follows states, in J; NaN, which
    /// breaks the energy balance, if a capacity has no value. Also the sum in J/K by which those
    /// capacities grow that do.
    fn filled(&self) -> (Vec<f64>, f64) {
        let system = self.recorder.system();
        let mut work = system.workspace();
        let count = system.network().state_capacities().len();
        let mut at = |y: &[f64]| {
            let contents = system.contents(&mut work, y).unwrap_or_else(|_| vec![f64::NAN; count]);
            (contents, system.capacities_of_states(&mut work, y))
        };
        let (before, now) = (at(&self.initial), at(self.integrator.state()));
        let heat = now.0.iter().zip(before.0).map(|(now, before)| now - before).collect();
        let grown = now.1.iter().zip(before.1).map(|(now, before)| (now - before).max(0.0)).sum();
        (heat, grown)
    }

    pub(super) fn finish(mut self, end: RunStatus) -> Result<Solution, TransientError> {
        let (growth, system) = (self.errors_grow(), self.recorder.system());
        let unresolved = self.guard.as_ref().and_then(Guard::unresolved);
        let mut stored = vec![0.0; system.network().nodes().len()];
        let changes = self.integrator.state().iter().zip(&self.initial).zip(system.capacity());
        for (((now, before), capacity), id) in changes.zip(system.states()) {
            if system.network().is_thermal(*id) {
                stored[id.index()] = capacity * (now - before);
            }
        }
        let (filled, grown) = self.filled();
        for (of, heat) in system.network().state_capacities().iter().zip(filled) {
            stored[of.node.index()] = heat;
        }
        let pipes = self.pipes.as_ref().map(|pipes| pipes.borrow());
        for (pipe, heat) in
            system.network().pipes().iter().zip(pipes.iter().flat_map(|pipes| pipes.stored(system)))
        {
            stored[pipe.node.index()] = heat;
        }
        let contents = pipes.map_or_else(Vec::new, |pipes| pipes.contents());
        let statistics: Statistics = self.integrator.statistics();
        let integrals = self.integrator.quadratures().map_err(TransientError::Integrator)?;
        let integrals = integrals.to_vec();
        let at_the_end = (self.integrator.time(), self.integrator.state());
        let work = self.recorder.at_state(at_the_end);
        let books = self.books.close(system, work, &integrals, (stored, (self.tolerance, grown)));
        let controls = self.switching.as_ref().map_or_else(Vec::new, Switching::controls);
        let undecided = self.switching.as_ref().and_then(|switching| switching.undecided);
        let events = self.switching.map_or_else(Vec::new, |switching| switching.events);
        let stood = self.recorder.branch().to_vec();
        let end_state = State::of_carried(self.integrator.state().to_vec()).standing(stood);
        let end_state = end_state.filled(contents);
        let solution = self.recorder.into_solution(books, (statistics, events), end);
        let made_up = growth::made_up(self.grows, FINEST / self.tolerance);
        let method = Some(self.method);
        let trajectory = self.trajectory.map(Arc::new);
        let certificate = self.certifier.map(|c| c.and_then(Certifier::finish));
        Ok(Solution {
            end_state,
            controls,
            method,
            growth,
            made_up,
            unresolved,
            undecided,
            certificate,
            trajectory,
            ..solution
        }
        .with_proofs())
    }
}
