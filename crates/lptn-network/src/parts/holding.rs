//! A network whose tables have their end values outside their points, for searches.

use std::collections::BTreeMap;
use std::sync::Arc;

use lptn_units::Program;

use crate::law::Law;
use crate::network::Network;
use crate::value::Value;

/// Programs that were made, by those that they replace: paths of a body share one.
type Made = BTreeMap<*const Program, Arc<Program>>;

impl Network {
    /// The same network, with the end values of the tables in the laws of its conductors and
    /// sources outside their points.
    pub fn holding(&self) -> Self {
        let mut parts = (*self.parts).clone();
        let mut made = Made::new();
        let conductors = parts.conductors.iter_mut().map(|conductor| &mut conductor.law);
        let laws = conductors.chain(parts.sources.iter_mut().map(|source| &mut source.law));
        laws.for_each(|law| hold_law(law, &mut made));
        Self { parts: Arc::new(parts), numbers: Arc::clone(&self.numbers) }
    }
}

fn hold_law(law: &mut Law, made: &mut Made) {
    if law.values().iter().any(has_table) {
        *law = law.clone().map(|_, mut value| {
            hold(&mut value, made);
            value
        });
    }
}

fn has_table(value: &Value) -> bool {
    value.programs().iter().any(|program| !program.table_calls().is_empty())
}

fn hold(value: &mut Value, made: &mut Made) {
    match value {
        Value::Constant(_) => {}
        Value::Product(factors) => {
            Arc::make_mut(factors).iter_mut().for_each(|factor| hold(factor, made));
        }
        Value::Expression(program) => {
            let held = made.entry(Arc::as_ptr(program));
            *program = Arc::clone(held.or_insert_with(|| Arc::new(program.holding())));
        }
    }
}
