//! Excess of everything that switches over its switching point.

use std::sync::Arc;

use lptn_assembly::{ThermalSystem, Workspace};
use lptn_network::{Acts, ControlId, End, Field, InputError, Item, Network, Positions, SwitchId};

/// A comparison changes only if its sides differ by this part of the tolerance times the slope of
/// their difference. Otherwise rounding at the moment of an event would decide which side it is on.
const MARGIN: f64 = 0.01;

/// The share of the margin by which a state passes its bound before it stops or goes on: less than
/// a strict comparison with the bound needs to change, more than one that is true of equal sides.
const BOUND: f64 = 0.3;

/// The share of the margin if the new truth is that of equal sides.
const EQUAL: f64 = 0.1;

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
    /// For each comparison true if it stops a state at its bound.
    stops: Arc<Vec<bool>>,
}

/// True for the comparison of a state with its bound.
pub(super) fn stops(network: &Network, id: SwitchId) -> bool {
    let (item, field) = network.place_of_switch(id);
    matches!((item, field), (Item::State(_), Field::Least | Field::Most))
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
            stops: Arc::new(network.switch_ids().map(|id| stops(network, id)).collect()),
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
            let switch = &system.network().switches()[id.index()];
            let towards_true = if switch.holds(1.0) { difference } else { -difference };
            let holds = work.positions().switches[id.index()];
            let share = match self.stops[id.index()] {
                true => BOUND,
                false if switch.holds(0.0) != holds => EQUAL,
                false => 1.0,
            };
            *out = if holds { -towards_true } else { towards_true } - share * margin;
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
