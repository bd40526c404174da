//! The trajectory of a run, if it is kept.

use lptn_network::Positions;

use super::{Break, Run};
use crate::readings::pieces;
use crate::trajectory::Trajectory;

/// Positions before a switch, and the control whose dwell ends there.
pub(super) struct Before {
    positions: Positions,
    waited: Option<usize>,
}

impl Run<'_> {
    /// Begins a stretch of the trajectory at a time in s.
    pub(super) fn remember_stretch(&mut self, time: f64) {
        let positions = self.switching.as_ref().map(|switching| &switching.positions);
        let inside = self.recorder.readings().inside(time);
        if let Some(trajectory) = &mut self.trajectory {
            trajectory.enter(inside, positions);
        }
    }

    /// Keeps a step or a part of it: a stretch ends if a limit bends or jumps.
    pub(super) fn remember_step(&mut self, from: f64, to: f64) -> Result<(), Break> {
        if self.trajectory.is_none() {
            return Ok(());
        }
        for (part, begins) in pieces(&self.recorder.readings().bends, (from, to)) {
            if begins {
                self.remember_stretch(part.0);
            }
            self.remember_part(part)?;
        }
        Ok(())
    }

    fn remember_part(&mut self, (from, to): (f64, f64)) -> Result<(), Break> {
        let Some(trajectory) = &mut self.trajectory else { return Ok(()) };
        if let Some(series) = self.integrator.series() {
            trajectory.add_series((from, to), &series);
            return Ok(());
        }
        let mut state = self.integrator.state().to_vec();
        let order = self.integrator.statistics().last_order as usize;
        let times: Vec<f64> = Trajectory::times((from, to), order).collect();
        let mut values = Vec::with_capacity(times.len() * state.len());
        for &time in &times {
            let taken = self.integrator.interpolate(time, &mut state);
            taken.map_err(|error| self.failed(error))?;
            values.extend_from_slice(&state);
        }
        let branch = self.massless(to, &state)?;
        if let Some(trajectory) = &mut self.trajectory {
            trajectory.add((from, to), (values, times.len()), branch);
        }
        Ok(())
    }

    /// Temperatures in K of the massless nodes that are solved for, at a state.
    fn massless(&mut self, time: f64, state: &[f64]) -> Result<Vec<f64>, Break> {
        let found = self.integrator.system_mut().temperatures(time, state);
        Ok(found.map_err(Break::Failed)?.0[state.len()..].to_vec())
    }

    /// The positions now, if switches are kept; `armed` is the next end of a dwell in s.
    pub(super) fn before_switch(&self, armed: f64) -> Option<Before> {
        let (switching, _) = (self.switching.as_ref()?, self.trajectory.as_ref()?);
        Some(Before {
            positions: switching.positions.clone(),
            waited: switching.control_armed_at(armed),
        })
    }

    /// Keeps a switch of these positions at the present time.
    pub(super) fn remember_switch(
        &mut self,
        due: &[usize],
        before: Option<Before>,
    ) -> Result<(), Break> {
        let (time, state) = (self.integrator.time(), self.integrator.state().to_vec());
        let Some(before) = before else { return Ok(()) };
        let branch = self.massless(time, &state)?;
        let (Some(switching), Some(trajectory)) = (&self.switching, &mut self.trajectory) else {
            return Ok(());
        };
        trajectory.check_alone((time, due), |position| switching.name(position));
        let positions = [&before.positions, &switching.positions];
        trajectory.turn((time, due, before.waited), positions, branch);
        Ok(())
    }
}
