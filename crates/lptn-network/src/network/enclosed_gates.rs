//! Bounds on the distance of a control from its next switch.

use lptn_units::Taylor;

use crate::id::ControlId;
use crate::network::Network;
use crate::network::enclosure::InputBounds;

impl Network {
    /// Takes the state of a control as not known: its value is anything from off, 0, to on, 1.
    pub fn loosen(&self, inputs: &mut InputBounds, id: ControlId) {
        let either = Taylor::between(&[[0.0, 1.0]]);
        inputs.set(self.parts.layout.control(id), either);
    }

    /// Bounds on the temperature in K at which a control leaves this state; `None` if there are none,
    /// or if it depends on temperatures or on positions.
    pub fn enclose_threshold(
        &self,
        (id, is_on): (ControlId, bool),
        inputs: &mut InputBounds,
    ) -> Option<[f64; 2]> {
        let thermostat = self.thermostat(id)?;
        let value = if is_on { &thermostat.off } else { &thermostat.on };
        let reads = self.parts.reads(value);
        (!reads.positions && !reads.reads_results()).then(|| inputs.value(value)?.range())?
    }

    /// Bounds on the excess in K of the temperature that a control senses over the threshold at
    /// which it leaves this state ([`Network::control_excess`]), while the vertices have these
    /// bounds in K; after [`Network::place_bounds`]. `None` if there are none.
    pub fn enclose_excess(
        &self,
        (id, is_on): (ControlId, bool),
        inputs: &mut InputBounds,
        vertices: &[Taylor],
    ) -> Option<Taylor> {
        let thermostat = self.thermostat(id)?;
        let thresholds = [inputs.value(&thermostat.on)?, inputs.value(&thermostat.off)?];
        let felt = vertices[self.vertex(thermostat.sense)];
        let excess = thermostat.acts.excess(thresholds, is_on, felt);
        excess.range().map(|_| excess)
    }
}
