//! Guards of a run against laws that depend on temperature, and against growing errors.

use lptn_integrate::{OdeSystem, Step};

use crate::growth::{self, Growth};
use crate::guard::{Guard, Verdict};
use crate::settings::Transient;
use crate::solution::{RunStatus, Solution};
use crate::transient::{Break, Care, Run};

/// A run is repeated with a tolerance below this share of the first one.
const WORTH_IT: f64 = 0.5;

/// Effort against errors of a run.
#[derive(Clone, Copy)]
pub(super) struct Effort {
    pub(super) care: Care,
    /// Growth of errors, as far as that is known.
    pub(super) grows: f64,
}

impl Transient {
    /// True if errors of a run grow by more than allowed, and a smaller tolerance corrects it at
    /// least in part.
    pub(super) fn can_make_up_for(&self, solution: &Solution) -> bool {
        let possible = growth::share(solution.growth).max(self.finest());
        possible < WORTH_IT && solution.end() == RunStatus::Reached
    }
}

impl Run<'_> {
    /// Sets the latest end and the greatest length of the next step in s, for `stop` and `longest`
    /// among other reasons.
    pub(super) fn hold_step(&mut self, stop: f64, longest: f64) {
        let mut stop = stop;
        if let Some(guard) = &mut self.guard {
            stop = stop.min(guard.end_of_step(self.integrator.as_mut()));
        }
        self.integrator.set_stop(stop);
        let curved = self.curved.as_ref().map(|curved| curved.longest(self.integrator.time()));
        if curved.is_some() || self.pipes.is_some() {
            let longest = longest.min(curved.unwrap_or(f64::INFINITY));
            self.integrator.set_longest_step(longest);
        }
    }

    /// Verdict on a step, for laws that depend on temperature; a step that is not accepted is taken
    /// back.
    pub(super) fn judged(&mut self, step: &Step) -> Result<Verdict, Break> {
        let Some(guard) = &mut self.guard else { return Ok(Verdict::Stands) };
        let verdict = guard.judge(self.integrator.as_mut(), step);
        if verdict == Verdict::Back {
            self.integrator.rewind(step.from).map_err(|e| self.failed(e))?;
            self.integrator.system_mut().fold = None;
            self.guard_begins();
        }
        Ok(verdict)
    }

    /// Prepares the guard for a start or restart of the integrator.
    pub(super) fn guard_begins(&mut self) {
        if let Some(guard) = &mut self.guard {
            guard.begin(self.integrator.as_mut());
        }
    }

    /// The same after a jump, or for the first time: the speed is another one.
    pub(super) fn begin_to_guard(&mut self) {
        self.guard_begins();
        if let Some(growth) = &mut self.growth {
            growth.begin(self.integrator.state());
        }
    }

    /// Follows errors over a step of `length` in s.
    pub(super) fn errors_go_on(&mut self, length: f64) {
        let Some(growth) = &mut self.growth else { return };
        let (time, state) = (self.integrator.time(), self.integrator.state().to_vec());
        let heat = self.integrator.system_mut();
        if heat.slope().is_some()
            && heat.look(time, &state).is_some()
            && let Some(slopes) = heat.slope()
        {
            growth.weigh(slopes);
        }
        growth.step(length, &state);
    }

    /// Growth of errors. Those of the steps through something narrow add up too.
    pub(super) fn errors_grow(&self) -> f64 {
        let growth = self.growth.as_ref().map_or(1.0, Growth::most);
        let growth = growth.max(self.guard.as_ref().map_or(1.0, Guard::grown));
        match self.guard.as_ref().is_some_and(Guard::met_narrow) {
            true => growth.max(growth::NARROW),
            false => growth,
        }
    }
}
