//! Switches inside a step, and the bounds of its errors.

use lptn_assembly::ThermalSystem;
use lptn_integrate::Step;
use lptn_network::IntegratorChoice;

use super::{Break, Run};
use crate::events::{Switching, Trouble, find_crossings};
use crate::settings::Transient;
use crate::times::Segment;

impl Transient {
    /// The integrator: pieces of the run prove the times of switches, and the one-step method has
    /// none.
    pub(super) fn integrator_for(&self, system: &ThermalSystem) -> IntegratorChoice {
        let switches = self.certify && system.network().has_events();
        match self.integrator {
            IntegratorChoice::Auto if switches && cfg!(feature = "cvodes") => {
                IntegratorChoice::Cvode
            }
            choice => choice,
        }
    }
}

impl Run<'_> {
    /// Bounds the errors over a part of a step.
    pub(super) fn bound_errors(&mut self, part: (f64, f64), segment: Segment) {
        let Some(Ok(certifier)) = &mut self.certifier else { return };
        let controls = self.switching.as_ref().map_or_else(Vec::new, Switching::controls);
        let now = (segment, &controls[..]);
        if let Err(reason) = certifier.step(part, now, self.integrator.as_mut()) {
            self.certifier = Some(Err(reason));
        }
    }

    /// Positions that have to switch inside a step or at its end, and the time in s.
    pub(super) fn crossings(&mut self, step: &Step) -> Result<(Vec<usize>, f64), Break> {
        if self.switching.is_none() {
            return Ok((Vec::new(), step.to));
        }
        find_crossings(self.integrator.as_mut(), step).map_err(|trouble| match trouble {
            Trouble::Integrator(error) => self.failed(error),
            Trouble::Stop(reason) => Break::Failed(reason),
        })
    }

    /// Switches what is due and everything that follows; true if anything changed.
    pub(super) fn switch(&mut self, due: &[usize], first: bool) -> Result<bool, Break> {
        let Some(switching) = &mut self.switching else { return Ok(false) };
        let (time, state) = (self.integrator.time(), self.integrator.state().to_vec());
        let before = switching.positions.clone();
        let heat = self.integrator.system_mut();
        let switched = match first {
            true => switching.begin(heat, time, &state),
            false => switching.settle(heat, time, &state, due),
        };
        let changed = switching.positions != before;
        switched.map_err(Break::Failed).map(|()| changed)
    }
}
