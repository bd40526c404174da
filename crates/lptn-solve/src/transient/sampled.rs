//! Samples at the start of a segment.

use lptn_assembly::ThermalSystem;

use super::{Break, Care, Run};
use crate::heat::Heat;
use crate::samples::Sampled;
use crate::stop_reason::StopReason;
use crate::times::Segment;

/// The states that keep their values between samples: none on the way to a steady state.
pub(super) fn of(system: &ThermalSystem, care: Care) -> Vec<Sampled> {
    if care == Care::Way { Vec::new() } else { Sampled::all_of(system) }
}

/// The state after the samples at a time in s at which it is `y`; `None` if there are none.
fn sampled(heat: &mut Heat<'_>, time: f64, y: &[f64]) -> Result<Option<Vec<f64>>, StopReason> {
    let due: Vec<Sampled> =
        heat.samples.iter().filter(|sampled| sampled.is_due(time)).cloned().collect();
    if due.is_empty() {
        return Ok(None);
    }
    let system = heat.system();
    let (temperatures, work) = heat.temperatures(time, y)?;
    let temperatures = temperatures.to_vec();
    let mut next = y.to_vec();
    for one in due {
        one.take((system, &mut *work), &temperatures, &mut next).map_err(StopReason::Input)?;
    }
    Ok(Some(next))
}

impl Run<'_> {
    /// Takes the samples at the start of a segment, and switches with them; restarts the
    /// integrator unless it is at its beginning.
    pub(super) fn sample(&mut self, segment: Segment, first: bool) -> Result<(), Break> {
        let state = self.integrator.state().to_vec();
        let heat = self.integrator.system_mut();
        let sampled = sampled(heat, segment.from, &state).map_err(Break::Failed)?;
        if sampled.is_some() || !first {
            self.integrator.restart(sampled.as_deref()).map_err(|e| self.failed(e))?;
        }
        if sampled.is_some() && self.switch(&[], false)? {
            self.integrator.restart(None).map_err(|e| self.failed(e))?;
        }
        Ok(())
    }
}
