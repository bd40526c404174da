//! Gives comparisons of temperatures a slot for their truth.

use std::sync::Arc;

use lptn_units::Program;

use crate::id::{ConductorId, Field, Item, SourceId, SwitchId};
use crate::law::Law;
use crate::parts::Parts;
use crate::parts::layout::Holds;
use crate::parts::switch::Switch;
use crate::value::Value;

impl Parts {
    /// True if the truth of a comparison is not known in advance: it compares temperatures, or
    /// something that both a control and time change.
    pub(crate) fn is_switch(&self, difference: &Program) -> bool {
        let value = Value::Expression(difference.clone().into());
        let reads = self.reads(&value);
        let controlled = difference
            .slots()
            .into_iter()
            .any(|slot| matches!(self.layout.holds(slot), Holds::Control(_)));
        reads.reads_results()
            || (controlled && self.course_of(difference) > lptn_units::Degree::Constant)
    }

    /// Gives every such comparison in the values of sources and conductors a slot for its truth.
    pub(crate) fn hold_comparisons(&mut self) {
        let mut sources = std::mem::take(&mut self.sources);
        for (i, source) in sources.iter_mut().enumerate() {
            self.hold_law(Item::Source(SourceId::from_len(i)), &mut source.law);
        }
        self.sources = sources;
        let mut conductors = std::mem::take(&mut self.conductors);
        for (i, conductor) in conductors.iter_mut().enumerate() {
            self.hold_law(Item::Conductor(ConductorId::from_len(i)), &mut conductor.law);
        }
        self.conductors = conductors;
    }

    fn hold_law(&mut self, item: Item, law: &mut Law) {
        if law.values().iter().any(|value| self.switches_in(value)) {
            *law = law.clone().map(|field, mut value| {
                self.hold((item, field), &mut value);
                value
            });
        }
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
        programs.any(|program| {
            program.comparisons().iter().any(|difference| self.is_switch(difference))
        })
    }

    fn held(&mut self, (item, field): (Item, Field), program: &Program) -> Program {
        let is_switch: Vec<bool> =
            program.comparisons().iter().map(|d| self.is_switch(d)).collect();
        let mut next = self.switches.len();
        let layout = Arc::make_mut(&mut self.layout);
        let held = program.with_held_comparisons(&mut |i| {
            is_switch[i].then(|| {
                next += 1;
                layout.add_switch(SwitchId::from_len(next - 1))
            })
        });
        let of =
            held.comparisons().iter().zip(held.relations()).zip(is_switch).filter(|(_, is)| *is);
        self.switches.extend(of.map(|((difference, &relation), _)| Switch {
            item,
            field,
            difference: Arc::new(difference.clone()),
            relation,
        }));
        held
    }
}
