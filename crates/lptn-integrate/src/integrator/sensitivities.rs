//! The derivatives of the state by parameters, carried along with it.

use super::Integrator;
use super::times::Shown;
use crate::context::Context;
use crate::memory::Flag;
use crate::vectors::Vectors;
use crate::{IntegrateError, OdeSystem, Options, start};

/// Sensitivities as last read or set.
pub(super) struct Sensitivities {
    vectors: Vectors,
    /// The same values, block behind block.
    blocks: Vec<f64>,
}

impl Sensitivities {
    pub(super) fn new(context: &Context, system: &impl OdeSystem) -> Result<Self, IntegrateError> {
        let (count, length) = (system.sensitivity_count(), system.size());
        Ok(Self { vectors: Vectors::new(context, count, length)?, blocks: vec![0.0; count * length] })
    }
}

impl<S: OdeSystem> Integrator<S> {
    /// The sensitivities at [`time`](Self::time): [`OdeSystem::sensitivity_count`] blocks of [`OdeSystem::size`] values,
    /// one behind the other, in units of y per unit of the parameter. They begin at 0.
    ///
    /// Their error against those of the exact solution stays below ten times the tolerance over
    /// [`Options::sensitivity_scales`], by the same rule as that of the state.
    ///
    /// # Errors
    /// [`IntegrateError::Sundials`] only.
    pub fn sensitivities(&mut self) -> Result<&[f64], IntegrateError> {
        self.read_sensitivities().map_err(|flag| self.unexpected(flag))?;
        self.sensitivities.vectors.copy_to(&mut self.sensitivities.blocks);
        Ok(&self.sensitivities.blocks)
    }

    /// Sets the sensitivities at [`time`](Self::time), in the order of [`sensitivities`](Self::sensitivities): because the
    /// start depends on the parameters, or because the state or the time of a jump does. If steps were taken since the
    /// last start, this begins anew as [`restart`](Self::restart) does and counts as one; behind a start, a restart or a
    /// rewind it costs nothing.
    ///
    /// If `f` jumps by `D` (after minus before) at the time `tau` that itself moves with a parameter, `s_i` jumps by
    /// `-D / M dtau/dp_i`.
    ///
    /// # Errors
    /// A wrong length, a value that is not finite ([`IntegrateError::InvalidState`] with its place in all blocks).
    pub fn set_sensitivities(&mut self, s: &[f64]) -> Result<(), IntegrateError> {
        start::expect_length("sensitivities", self.sensitivities.blocks.len(), s.len())?;
        start::check_state(s)?;
        let is_new = self.memory.counters().steps == 0;
        self.read_quadratures().map_err(|flag| self.unexpected(flag))?;
        self.sensitivities.vectors.set(s);
        if is_new { self.begin_anew().map_err(|flag| self.unexpected(flag)) } else { self.restart_here() }
    }

    /// Writes the sensitivities at a time inside the last step, ends included, in the order of
    /// [`sensitivities`](Self::sensitivities).
    ///
    /// # Errors
    /// [`IntegrateError::OutsideLastStep`] (after a start or a restart only the present time is inside), a wrong length.
    pub fn interpolate_sensitivities(&mut self, t: f64, s: &mut [f64]) -> Result<(), IntegrateError> {
        start::expect_length("sensitivities", self.sensitivities.blocks.len(), s.len())?;
        let Shown { from, time: to, .. } = self.shown;
        if !(from..=to).contains(&t) {
            return Err(IntegrateError::OutsideLastStep { time: t, from, to });
        }
        let t = self.within(t);
        let read = if t < self.time { self.read_sensitivities_at(t) } else { self.read_sensitivities() };
        read.map_err(|flag| self.unexpected(flag))?;
        self.sensitivities.vectors.copy_to(s);
        Ok(())
    }

    pub(super) fn start_sensitivities(&mut self, options: &Options) -> Result<(), Flag> {
        let vectors = &self.sensitivities.vectors;
        if vectors.is_empty() {
            return Ok(());
        }
        self.memory.start_sensitivities::<S>(vectors, &options.sensitivity_scales)
    }

    pub(super) fn restart_sensitivities(&mut self) -> Result<(), Flag> {
        let vectors = &self.sensitivities.vectors;
        if vectors.is_empty() { Ok(()) } else { self.memory.restart_sensitivities(vectors) }
    }

    pub(super) fn read_sensitivities(&mut self) -> Result<(), Flag> {
        let vectors = &mut self.sensitivities.vectors;
        // Before the first step after a (re)start CVODES has no step to evaluate them in; they are as they were set.
        if vectors.is_empty() || self.memory.counters().steps == 0 {
            return Ok(());
        }
        self.memory.sensitivities(vectors)
    }

    pub(super) fn read_sensitivities_at(&mut self, t: f64) -> Result<(), Flag> {
        let vectors = &mut self.sensitivities.vectors;
        if vectors.is_empty() { Ok(()) } else { self.memory.sensitivities_at(t, vectors) }
    }
}
