//! The derivatives of the state by parameters, carried along with it.
//!
//! State and sensitivities are corrected together (`CV_SIMULTANEOUS`). This takes half the flow
//! evaluations of the staggered way, and leaves no history in the middle of a step if a flow fails.

use super::Cvodes;
use crate::context::Context;
use crate::memory::Flag;
use crate::vectors::Vectors;
use lptn_integrate::{IntegrateError, OdeSystem, Options};

/// Sensitivities as last read or set.
pub(super) struct Sensitivities {
    pub(super) vectors: Vectors,
    /// The same values, block after block.
    pub(super) blocks: Vec<f64>,
}

impl Sensitivities {
    pub(super) fn new(context: &Context, system: &impl OdeSystem) -> Result<Self, IntegrateError> {
        let (count, length) = (system.sensitivity_count(), system.size());
        Ok(Self {
            vectors: Vectors::new(context, count, length)?,
            blocks: vec![0.0; count * length],
        })
    }
}

impl<S: OdeSystem> Cvodes<S> {
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
        // Before the first step after a (re)start CVODES has no step to evaluate them in; they are
        // as they were set.
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
