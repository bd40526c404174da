//! The slots from which expressions read numbers: one for each thing that a name can mean.
//!
//! Slots are in the order of addition. An expression is compiled once and then reads numbers or
//! dual numbers. Comparisons read `t` and signals in a second slot that is constant inside a
//! segment.

use crate::id::{BoundaryId, ControlId, End, NodeId, ParameterId, SignalId, SwitchId};
use crate::parts::grid_value::GridValue;
use crate::parts::heat::HeatOf;
use crate::parts::signal::{Course, Signal};
use crate::slot;

/// The content of a slot.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Holds {
    /// `t`.
    Time,
    /// `t` as comparisons read it.
    FrozenTime,
    /// A temperature of the conductor at hand.
    Link,
    /// The temperature of the node or material at hand.
    Own,
    /// A parameter.
    Parameter(ParameterId),
    /// A signal.
    Signal(SignalId),
    /// A signal as comparisons read it.
    FrozenSignal(SignalId),
    /// The temperature of a node or boundary.
    Temperature(End),
    /// A heat flow, in results only.
    Heat(HeatOf),
    /// A control: 0 or 1.
    Control(ControlId),
    /// The truth of a comparison of temperatures: 0 or 1.
    Switch(SwitchId),
    /// A temperature of a grid as a whole, in results only.
    Grid(GridValue),
}

/// The variable that a value follows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Followed {
    /// The temperature of a node or boundary.
    Temperature(End),
    /// A heat flow.
    Heat(HeatOf),
}

/// The slots of a network.
#[derive(Clone, Debug)]
pub(crate) struct Layout {
    holds: Vec<Holds>,
    parameters: Vec<u32>,
    /// The value now; the frozen value is in the next slot.
    signal_slots: Vec<u32>,
    signals: Vec<Signal>,
    nodes: Vec<u32>,
    boundaries: Vec<u32>,
    /// The heat flows that expressions of results name, with their slots.
    heats: Vec<(HeatOf, u32)>,
    controls: Vec<u32>,
    switches: Vec<u32>,
    /// The same for temperatures of grids, and the nodes that each is made of with their weights.
    grid_values: Vec<(GridValue, u32)>,
    members: Vec<(Vec<u32>, Vec<f64>)>,
}

impl Default for Layout {
    fn default() -> Self {
        use Holds::{FrozenTime, Link, Own, Time};
        let holds = vec![Time, FrozenTime, Link, Link, Link, Link, Own];
        debug_assert_eq!(holds.len(), slot::FIXED);
        Self {
            holds,
            parameters: vec![],
            signal_slots: vec![],
            signals: vec![],
            nodes: vec![],
            boundaries: vec![],
            heats: vec![],
            controls: vec![],
            switches: vec![],
            grid_values: vec![],
            members: vec![],
        }
    }
}

impl Layout {
    fn push(&mut self, holds: Holds) -> u32 {
        let slot =
            u32::try_from(self.holds.len()).expect("a network contains fewer than 2^32 names");
        self.holds.push(holds);
        slot
    }

    pub(crate) fn add_parameter(&mut self, id: ParameterId) {
        let slot = self.push(Holds::Parameter(id));
        self.parameters.push(slot);
    }

    pub(crate) fn add_signal(&mut self, signal: Signal) -> SignalId {
        let id = SignalId::from_len(self.signals.len());
        let slot = self.push(Holds::Signal(id));
        self.push(Holds::FrozenSignal(id));
        self.signal_slots.push(slot);
        self.signals.push(signal);
        id
    }

    pub(crate) fn show_signal_in(&mut self, id: SignalId, unit: lptn_units::Unit) {
        let signal = self
            .signals
            .get_mut(id.index())
            .filter(|signal| signal.ty.dimension == unit.ty.dimension);
        if let Some(signal) = signal {
            signal.unit = Some(unit);
        }
    }

    /// Gives a signal another time history.
    pub(crate) fn set_course(&mut self, id: SignalId, course: Course) {
        if let Some(signal) = self.signals.get_mut(id.index()) {
            signal.course = course;
        }
    }

    pub(crate) fn signals(&self) -> &[Signal] {
        &self.signals
    }

    pub(crate) fn add_node(&mut self, id: NodeId) {
        let slot = self.push(Holds::Temperature(End::Node(id)));
        self.nodes.push(slot);
    }

    pub(crate) fn add_boundary(&mut self, id: BoundaryId) {
        let slot = self.push(Holds::Temperature(End::Boundary(id)));
        self.boundaries.push(slot);
    }

    /// Gives a heat flow a slot, unless it has one.
    pub(crate) fn add_heat(&mut self, heat: HeatOf) {
        if self.heat(heat).is_none() {
            let slot = self.push(Holds::Heat(heat));
            self.heats.push((heat, slot));
        }
    }

    pub(crate) fn heat(&self, heat: HeatOf) -> Option<u32> {
        self.heats.iter().find(|(known, _)| *known == heat).map(|(_, slot)| *slot)
    }

    pub(crate) fn heats(&self) -> &[(HeatOf, u32)] {
        &self.heats
    }

    pub(crate) fn add_control(&mut self, id: ControlId) {
        let slot = self.push(Holds::Control(id));
        self.controls.push(slot);
    }

    pub(crate) fn add_switch(&mut self, id: SwitchId) -> u32 {
        let slot = self.push(Holds::Switch(id));
        self.switches.push(slot);
        slot
    }

    pub(crate) fn control(&self, id: ControlId) -> u32 {
        self.controls[id.index()]
    }

    pub(crate) fn control_count(&self) -> usize {
        self.controls.len()
    }

    pub(crate) fn switch(&self, id: SwitchId) -> u32 {
        self.switches[id.index()]
    }

    pub(crate) fn switch_count(&self) -> usize {
        self.switches.len()
    }

    /// Gives a temperature of a grid a slot, unless it has one.
    pub(crate) fn add_grid_value(&mut self, value: GridValue) {
        if self.grid_value(value).is_none() {
            let slot = self.push(Holds::Grid(value));
            self.grid_values.push((value, slot));
        }
    }

    pub(crate) fn grid_value(&self, value: GridValue) -> Option<u32> {
        self.grid_values.iter().find(|(known, _)| *known == value).map(|(_, slot)| *slot)
    }

    pub(crate) fn grid_values(&self) -> &[(GridValue, u32)] {
        &self.grid_values
    }

    /// Sets the nodes that belong to each temperature of a grid with their weights, in the order of
    /// [`Layout::grid_values`].
    pub(crate) fn set_members(&mut self, members: Vec<(Vec<u32>, Vec<f64>)>) {
        self.members = members;
    }

    /// The temperatures of grids that expressions name, as slots and values, from the temperatures
    /// of all nodes.
    pub(crate) fn grid_temperatures<'a>(
        &'a self,
        nodes: &'a [f64],
    ) -> impl Iterator<Item = (u32, f64)> + 'a {
        let values = self.grid_values.iter().zip(&self.members);
        values
            .map(|((value, slot), (members, weights))| (*slot, value.of((members, weights), nodes)))
    }

    pub(crate) fn len(&self) -> usize {
        self.holds.len()
    }

    pub(crate) fn holds(&self, slot: u32) -> Holds {
        self.holds[slot as usize]
    }

    pub(crate) fn parameter(&self, id: ParameterId) -> u32 {
        self.parameters[id.index()]
    }

    pub(crate) fn signal(&self, id: SignalId) -> u32 {
        self.signal_slots[id.index()]
    }

    pub(crate) fn temperature(&self, end: End) -> u32 {
        match end {
            End::Node(id) => self.nodes[id.index()],
            End::Boundary(id) => self.boundaries[id.index()],
        }
    }

    /// The slots of all temperatures: nodes, then boundaries.
    pub(crate) fn temperatures(&self) -> impl Iterator<Item = u32> {
        self.nodes.iter().chain(&self.boundaries).copied()
    }
}
