//! Sampled states in a run: their values stay between samples, and all of them take their next
//! values at once, from those before.
//!
//! Samples are at the multiples of the time between them, whenever a run begins: a run that goes on
//! from a saved state samples when the uninterrupted one does. A sample at the end of a run is left
//! to the run that goes on.

use lptn_assembly::{ThermalSystem, Workspace};
use lptn_integrate::Pattern;
use lptn_network::{InputError, SourceId, StateId};

/// A time is a multiple of another if it is off by less than this share of it.
const SAME: f64 = 1e-9;

/// A sampled state in a run.
#[derive(Clone, Debug)]
pub(crate) struct Sampled {
    /// Its number among the variables of the integrator.
    state: usize,
    /// The source whose heat is the change to the next value over the time between samples.
    source: SourceId,
    /// The time between samples in s.
    every: f64,
    /// The slots of its row in the Jacobian.
    row: Vec<usize>,
}

impl Sampled {
    /// All of a system.
    pub(crate) fn all_of(system: &ThermalSystem) -> Vec<Self> {
        let network = system.network();
        let pattern = Pattern::from_symbolic(system.pattern().symbolic());
        let one = |(id, every): (StateId, f64)| {
            let state = &network.states()[id.index()];
            let place = system.states().iter().position(|node| *node == state.node)?;
            let slots = (0..system.unknowns().len()).flat_map(|column| pattern.column(column));
            let row = slots.filter(|&slot| pattern.row_indices()[slot] == place).collect();
            Some(Self { state: place, source: state.source?, every, row })
        };
        network.sampled_states().filter_map(one).collect()
    }

    /// Takes its rate out of those of all states.
    pub(crate) fn hold(&self, flow: &mut [f64]) {
        flow[self.state] = 0.0;
    }

    /// The same of a Jacobian.
    pub(crate) fn hold_slopes(&self, values: &mut [f64]) {
        self.row.iter().for_each(|slot| values[*slot] = 0.0);
    }

    /// Writes its next value, at these temperatures of all unknowns in K.
    pub(crate) fn take(
        &self,
        (system, work): (&ThermalSystem, &mut Workspace),
        temperatures: &[f64],
        next: &mut [f64],
    ) -> Result<(), InputError> {
        let change = system.source_heat(work, self.source, temperatures)? * self.every;
        next[self.state] += change;
        Ok(())
    }

    /// True at the times of its samples.
    pub(crate) fn is_due(&self, time: f64) -> bool {
        let count = time / self.every;
        (count - count.round()).abs() <= SAME
    }
}
