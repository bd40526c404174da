//! Excess of everything that switches over its switching point.

use std::sync::Arc;

use lptn_assembly::{ThermalSystem, Workspace};
use lptn_network::{Acts, ControlId, End, InputError, Positions};

/// A comparison changes only if its sides differ by this part of the tolerance times the slope of
/// their difference. Otherwise rounding at the moment of an event would decide which side it is on.
const MARGIN: f64 = 0.01;

/// A thermostat with constant thresholds that feels a node with capacity.
#[derive(Clone, Copy, Debug)]
struct Plain {
    state: usize,
    acts: Acts,
    /// Temperatures at which it switches on and off, in K.
    thresholds: [f64; 2],
}

impl Plain {
    fn of(system: &ThermalSystem, id: ControlId) -> Option<Self> {
        let network = system.network();
        let thermostat = network.thermostat(id)?;
        let End::Node(node) = thermostat.sense else { return None };
        let state = system.states().binary_search(&node).ok()?;
        let thresholds = network.thresholds(id)?;
        let [on, off] = thresholds;
        let acts = thermostat.acts;
        acts.in_order(on, off).then_some(Self { state, acts, thresholds })
    }
}

/// Conditions of everything that switches: controls in their order, then comparisons.
#[derive(Clone, Debug, Default)]
pub(crate) struct Gates {
    /// For each control true if it may switch; false while it has to stay as it is.
    pub(crate) armed: Vec<bool>,
    /// For each comparison the least difference of its sides.
    pub(crate) margins: Vec<f64>,
    /// An excess of a control below this, in K, does not count.
    room: f64,
    /// Every control, if all that switches are plain thermostats.
    plain: Arc<Vec<Plain>>,
}

impl Gates {
    pub(crate) fn new(system: &ThermalSystem) -> Self {
        let network = system.network();
        let plain = network.control_ids().map(|id| Plain::of(system, id));
        let plain = if network.switches().is_empty() { plain.collect() } else { None };
        Self {
            armed: vec![true; network.controls().len()],
            margins: vec![0.0; network.switches().len()],
            room: 0.0,
            plain: Arc::new(plain.unwrap_or_default()),
        }
    }

    /// True if the temperatures of the states determine all of [`Gates::excess`].
    pub(crate) fn are_plain(&self) -> bool {
        !self.plain.is_empty()
    }

    /// [`Gates::excess`] for plain thermostats, from the temperatures of the states in K.
    pub(crate) fn plain_excess(&self, positions: &Positions, states: &[f64], out: &mut [f64]) {
        let controls = self.plain.iter().zip(&positions.controls).zip(&self.armed);
        for (((plain, is_on), armed), out) in controls.zip(out) {
            let excess = plain.acts.excess(plain.thresholds, *is_on, states[plain.state]);
            *out = if *armed { excess } else { -1.0 };
        }
    }

    /// Number of controls and comparisons.
    pub(crate) fn count(&self) -> usize {
        self.armed.len() + self.margins.len()
    }

    /// The excess of each below which no search is made.
    pub(crate) fn rooms(&self) -> Vec<f64> {
        let controls = self.armed.iter().map(|_| self.room);
        controls.chain(self.margins.iter().copied()).collect()
    }

    /// Writes the excess of each over its switching point, positive if it has to switch; from the
    /// inputs, the positions and the temperatures in `work`.
    pub(crate) fn excess(
        &self,
        system: &ThermalSystem,
        work: &mut Workspace,
        out: &mut [f64],
    ) -> Result<(), InputError> {
        let (controls, switches) = out.split_at_mut(self.armed.len());
        for ((id, armed), out) in system.network().control_ids().zip(&self.armed).zip(controls) {
            let excess = system.control_excess(work, id)?;
            *out = if *armed { excess } else { -1.0 };
        }
        for ((id, margin), out) in system.network().switch_ids().zip(&self.margins).zip(switches) {
            let (difference, _) = system.switch_difference(work, id)?;
            let towards_true = if system.network().switches()[id.index()].holds(1.0) {
                difference
            } else {
                -difference
            };
            let holds = work.positions().switches[id.index()];
            *out = if holds { -towards_true } else { towards_true } - margin;
        }
        Ok(())
    }

    /// Sets the least difference of the sides of each comparison, for this tolerance in K.
    pub(crate) fn set_margins(
        &mut self,
        system: &ThermalSystem,
        work: &mut Workspace,
        tolerance: f64,
    ) -> Result<(), InputError> {
        self.room = MARGIN * tolerance;
        for (id, margin) in system.network().switch_ids().zip(&mut self.margins) {
            let (difference, slope) = system.switch_difference(work, id)?;
            // a side that hardly depends on temperature here still has rounding
            *margin = (MARGIN * tolerance * slope).max(4.0 * f64::EPSILON * difference.abs());
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests;
