//! Switches: comparisons of temperatures. Their truth is held between events.

use std::sync::Arc;

use lptn_units::{Comparison, Program};

use crate::dependence::{Dependence, NONE};
use crate::evaluation::{Evaluation, PASS};
use crate::flow::{name, place, seeded};
use crate::id::{ConductorId, Field, Item, SourceId, SwitchId};
use crate::input_error::InputError;
use crate::layout::Holds;
use crate::network::Network;
use crate::parts::Parts;
use crate::value::Value;

/// A comparison whose truth changes at times that are not known beforehand.
#[derive(Clone, Debug)]
pub struct Switch {
    /// The source or conductor it belongs to.
    pub item: Item,
    /// The field it stands in.
    pub field: Field,
    /// Left side minus right side.
    pub difference: Arc<Program>,
    /// How the sides are compared: less or greater, never for equality.
    pub relation: Comparison,
}

impl Switch {
    /// Whether the comparison holds where left minus right is `difference`.
    pub fn holds(&self, difference: f64) -> bool {
        self.relation.holds(difference, 0.0)
    }
}

impl Parts {
    /// Whether the truth of a comparison is not known beforehand: it compares temperatures, or something that a
    /// control changes with something that time does.
    pub(crate) fn is_switch(&self, difference: &Program) -> bool {
        let value = Value::Expression(difference.clone().into());
        let reads = self.reads(&value);
        let controlled =
            difference.slots().into_iter().any(|slot| matches!(self.layout.holds(slot), Holds::Control(_)));
        reads.reads_results() || (controlled && self.course_of(difference) > lptn_units::Degree::Constant)
    }

    /// Gives every such comparison in the values of sources and conductors a slot that holds its truth.
    pub(crate) fn hold_comparisons(&mut self) {
        let mut sources = std::mem::take(&mut self.sources);
        for (i, source) in sources.iter_mut().enumerate() {
            if self.switches_in(&source.power) {
                self.hold((Item::Source(SourceId::from_len(i)), Field::Power), &mut source.power);
            }
        }
        self.sources = sources;
        let mut conductors = std::mem::take(&mut self.conductors);
        for (i, conductor) in conductors.iter_mut().enumerate() {
            let item = Item::Conductor(ConductorId::from_len(i));
            if conductor.law.values().iter().any(|value| self.switches_in(value)) {
                let law = conductor.law.clone();
                conductor.law = law.map(|field, mut value| {
                    self.hold((item, field), &mut value);
                    value
                });
            }
        }
        self.conductors = conductors;
    }

    fn hold(&mut self, (item, field): (Item, Field), value: &mut Value) {
        match value {
            Value::Constant(_) => {}
            Value::Product(factors) => {
                let own = Arc::make_mut(factors).iter_mut();
                own.for_each(|factor| self.hold((item, field), factor));
            }
            Value::Expression(program) => *program = Arc::new(self.held((item, field), program)),
        }
    }

    fn switches_in(&self, value: &Value) -> bool {
        let mut programs = value.programs().into_iter();
        programs.any(|program| program.comparisons().iter().any(|difference| self.is_switch(difference)))
    }

    fn held(&mut self, (item, field): (Item, Field), program: &Program) -> Program {
        let is_switch: Vec<bool> = program.comparisons().iter().map(|d| self.is_switch(d)).collect();
        let mut next = self.switches.len();
        let layout = Arc::make_mut(&mut self.layout);
        let held = program.with_held_comparisons(&mut |i| {
            is_switch[i].then(|| {
                next += 1;
                layout.add_switch(SwitchId::from_len(next - 1))
            })
        });
        let of = held.comparisons().iter().zip(held.relations()).zip(is_switch).filter(|(_, is)| *is);
        self.switches.extend(of.map(|((difference, &relation), _)| Switch {
            item,
            field,
            difference: Arc::new(difference.clone()),
            relation,
        }));
        held
    }
}

impl Network {
    /// The comparisons whose truth is held between events.
    pub fn switches(&self) -> &[Switch] {
        &self.parts.switches
    }

    /// Ids of all switches.
    pub fn switch_ids(&self) -> impl ExactSizeIterator<Item = SwitchId> + use<> {
        (0..self.switches().len()).map(SwitchId::from_len)
    }

    /// Left side minus right side of a switch, at the time of `scope` and these temperatures of all vertices in K, and
    /// how much it changes, at most and in linear terms, when each temperature changes by 1 K.
    ///
    /// # Errors
    /// [`InputError`] if a side fails or gives no number.
    pub fn switch_difference(
        &self,
        id: SwitchId,
        scope: &mut Evaluation,
        temperatures: &[f64],
    ) -> Result<(f64, f64), InputError> {
        let switch = &self.switches()[id.index()];
        let (dependence, link) = self.switch_dependence(switch);
        let (mut value, mut slope) = (0.0, 0.0);
        for first in (0..dependence.vertices.len().max(1)).step_by(PASS) {
            let at = |k: usize| seeded(temperatures[dependence.vertices[k] as usize], k, first);
            let (slots, stack) = scope.dual();
            if link {
                place(slots, dependence, &at)
            } else {
                name(slots, dependence, &at)
            }
            let result = switch.difference.eval(slots, stack);
            let found = self.finite(result, (switch.item, switch.field), scope)?;
            value = found.value;
            slope += found.derivatives.iter().map(|d| d.abs()).sum::<f64>();
        }
        Ok((value, slope))
    }

    fn switch_dependence(&self, switch: &Switch) -> (&Dependence, bool) {
        match switch.item {
            Item::Conductor(id) => (self.parts.dependence(id), true),
            Item::Source(id) => (&self.parts.source_dependence[id.index()], false),
            _ => (&NONE, false),
        }
    }
}
