//! The values that depend on the variables of a derivative: parameters and signals.

use lptn_units::Program;

use super::Variable;
use crate::id::{BoundaryId, ControlId, Item, NodeId, ParameterId};
use crate::network::Network;
use crate::parts::layout::Holds;
use crate::parts::signal::Course;
use crate::parts::substance::Melting;
use crate::slot;
use crate::value::{Lump, Value};

/// For each slot whether its number changes with one of the variables.
pub(super) struct Influence<'a> {
    network: &'a Network,
    slots: Vec<bool>,
}

impl<'a> Influence<'a> {
    /// Of these parameters.
    pub(super) fn of(network: &'a Network, parameters: &[ParameterId]) -> Self {
        let variables: Vec<Variable> =
            parameters.iter().copied().map(Variable::Parameter).collect();
        Self::new(network, &variables)
    }

    pub(super) fn new(network: &'a Network, variables: &[Variable]) -> Self {
        let layout = &network.parts.layout;
        let mut influence = Self { network, slots: vec![false; layout.len()] };
        for id in network.parameter_ids() {
            let given = network.numbers.given[id.index()];
            let follows = !given && influence.value(&network.parameters()[id.index()].value);
            influence.slots[layout.parameter(id) as usize] =
                follows || variables.contains(&Variable::Parameter(id));
        }
        for id in network.signal_ids() {
            let now = layout.signal(id) as usize;
            // comparisons read the second slot, which keeps its value inside a segment
            influence.slots[now] = variables.contains(&Variable::Signal(id));
            if influence.slots[now] {
                continue;
            }
            if let Course::Expression(value) = &network.signals()[id.index()].course {
                let follows = influence.value(value);
                influence.slots[now] = follows;
                influence.slots[now + 1] = follows; // where comparisons read it
            }
        }
        let nodes = network.nodes().len();
        let temperatures: Vec<u32> = layout.temperatures().skip(nodes).collect();
        for (boundary, slot) in network.boundaries().iter().zip(temperatures) {
            influence.slots[slot as usize] = influence.value(&boundary.temperature);
        }
        influence
    }

    /// True if a value changes with one of the parameters, at fixed temperatures of the nodes.
    pub(super) fn value(&self, value: &Value) -> bool {
        !matches!(value, Value::Constant(_))
            && value.slots().iter().any(|&slot| self.slots[slot as usize])
    }

    /// The same for a program.
    pub(super) fn program(&self, program: &Program) -> bool {
        program.slots().iter().any(|&slot| self.slots[slot as usize])
    }

    pub(super) fn boundary(&self, id: BoundaryId) -> bool {
        self.value(&self.network.boundaries()[id.index()].temperature)
    }

    /// The first input with a comparison that changes its truth at a time which depends on one of
    /// the parameters. Comparisons of temperatures are events, not jumps.
    pub(super) fn moving_jump(&self) -> Option<Item> {
        let parts = &self.network.parts;
        let moves = |c: &Program| self.moves(c) && !parts.is_switch(c);
        let jumps = |value: &Value| {
            value.programs().into_iter().flat_map(|program| program.comparisons()).any(moves)
        };
        self.network.inputs().find(|(_, _, value)| jumps(value)).map(|(item, _, _)| item)
    }

    /// True if a comparison of a result changes its truth at a time which depends on temperatures or
    /// on one of the parameters. No event marks that time.
    pub(super) fn moves_jump_of(&self, item: Item) -> bool {
        let parts = &self.network.parts;
        let moves = |comparison: &Program| {
            let value = Value::Expression(comparison.clone().into());
            self.moves(comparison)
                || self.network.reads_results(&value)
                || parts.is_switch(comparison)
        };
        let values = parts.results(&[item]).values;
        let mut programs = values.into_iter().flat_map(Value::programs);
        programs.any(|program| program.comparisons().iter().any(moves))
    }

    /// True if the time at which a comparison changes its truth depends on one of the parameters.
    fn moves(&self, comparison: &Program) -> bool {
        let slots = comparison.slots();
        slots.iter().any(|&slot| self.slots[slot as usize])
            && slots.iter().any(|&slot| self.varies(slot))
    }

    /// True if a slot changes during a run.
    fn varies(&self, slot: u32) -> bool {
        slot == slot::TIME
            || slot == slot::SEGMENT
            || !matches!(self.network.parts.layout.holds(slot), Holds::Parameter(_))
    }

    /// The first control or comparison of temperatures.
    pub(super) fn event(&self) -> Option<Item> {
        let control =
            (!self.network.controls().is_empty()).then(|| Item::Control(ControlId::from_len(0)));
        control.or_else(|| self.network.switches().first().map(|switch| switch.item))
    }
}

/// The lumps of a node that melt.
pub(super) fn melting(network: &Network, node: NodeId) -> impl Iterator<Item = (&Lump, &Melting)> {
    let own = network.nodes()[node.index()].lump.iter();
    let parts = network.capacitors().iter().filter(move |part| part.node == node);
    own.chain(parts.filter_map(|part| part.lump.as_ref())).filter_map(|lump| {
        let material = &network.materials()[lump.material.index()];
        Some((lump, material.melting.as_ref()?))
    })
}
