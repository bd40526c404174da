//! Brings the workspace to a time inside the present step, whatever was evaluated before.

use lptn_assembly::Workspace;

use super::{Recorder, StateAt};
use crate::heat::Heat;
use crate::interval::{POINTS, time_of};
use crate::newton_error::NewtonError;
use crate::stop_reason::StopReason;
use crate::unsolved::Unsolved;

impl Recorder<'_> {
    /// Sets the present temperatures of the massless nodes of several solutions, in K.
    pub(crate) fn set_branch(&mut self, branch: Vec<f64>) {
        self.branch.clone_from(&branch);
        self.branch_ahead = branch;
    }

    /// Sets their temperatures at the end of the step that has to be written, in K.
    pub(crate) fn set_branch_ahead(&mut self, branch: Vec<f64>) {
        self.branch_ahead = branch;
    }

    /// The temperatures that were set last, in K.
    pub(crate) fn branch(&self) -> &[f64] {
        &self.branch
    }

    /// The workspace at `time`, for a system without state, with inputs as they are in the stretch
    /// around `middle`.
    pub(crate) fn at(&mut self, time: f64, middle: f64) -> Result<&mut Workspace, StopReason> {
        self.inside = self.readings.inside(middle);
        self.place(time)?;
        Ok(&mut self.work)
    }

    /// The workspace at a time and state; unchanged if these cannot be computed.
    pub(crate) fn at_state(&mut self, (time, state): (f64, &[f64])) -> &mut Workspace {
        self.state.copy_from_slice(state);
        self.inside = self.readings.inside_before(time);
        if self.place(time).is_ok() {
            // brings the heat of sources that depend on temperatures up to date
            drop(self.reading.place(&mut self.work, (time, self.inside)));
        }
        &mut self.work
    }

    pub(super) fn place_at(
        &mut self,
        time: f64,
        state_at: &mut StateAt<'_>,
    ) -> Result<(), StopReason> {
        state_at(time, &mut self.state)
            .map_err(|error| StopReason::Integrator { error, node: None })?;
        self.place(time)
    }

    /// Brings the workspace to `time` and the temperatures in `state`.
    pub(super) fn place(&mut self, time: f64) -> Result<(), StopReason> {
        self.placed += 1;
        self.system.read_inputs(&mut self.work, time, self.inside).map_err(StopReason::Input)?;
        self.unfold(time).map_err(|e| StopReason::Unsolved(Unsolved::new(self.system, e)))?;
        self.system.recover(&mut self.work, self.unfold.last());
        Ok(())
    }

    /// Finds the temperatures of massless nodes from those at the start of the step, or from those
    /// at its end: near the end of a branch the nearer of the two leads there. The run has gone
    /// through the step. A node that needs a jump from both therefore jumps on the way, by less
    /// than the run has to resolve.
    fn unfold(&mut self, time: f64) -> Result<(), NewtonError> {
        if self.branch.is_empty() {
            self.anchor.begin(time, &mut self.unfold);
            return self.unfold.temperatures(&mut self.work, &self.state).map(drop);
        }
        self.unfold.lean();
        let mut failed = None;
        for leaps in [false, true] {
            for seed in [&self.branch, &self.branch_ahead] {
                self.unfold.seed(seed);
                if leaps {
                    self.unfold.may_leap();
                }
                match self.unfold.temperatures(&mut self.work, &self.state) {
                    Ok(_) => return Ok(()),
                    Err(error) => failed = failed.or(Some(error)),
                }
            }
        }
        failed.map_or(Ok(()), Err)
    }

    /// Sets the start of evaluations inside a step from the integrator's solution at its end.
    pub(super) fn lean_on(&mut self, heat: &Heat<'_>, (from, to): (f64, f64)) {
        if heat.algebraic().is_empty() {
            return;
        }
        self.anchor.go_on(from);
        self.anchor.add(to, heat.algebraic());
        self.unfold.lean_on(heat.matrix());
    }

    /// The same for a system without state: goes through a part by itself, in small steps if there
    /// may be several solutions. If it fails, an evaluation reports that.
    pub(super) fn walk(&mut self, part: (f64, f64)) {
        if self.system.algebraic().is_empty() {
            return;
        }
        self.anchor.go_on(part.0);
        let first = if self.unfold.is_guarded() { 1 } else { POINTS - 1 };
        for point in first..POINTS {
            let time = time_of(part, point);
            self.inside = self.readings.inside_before(time);
            if self.place(time).is_err() {
                return;
            }
            self.anchor.add(time, self.unfold.algebraic());
            self.unfold.lean_on_itself();
        }
    }
}
