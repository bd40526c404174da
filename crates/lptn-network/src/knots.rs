//! Knots: temperatures at which the tables in a value bend.

use lptn_units::LookupTable;

use crate::slot;
use crate::value::Value;

/// Temperatures at which the tables in a value bend for these values of the slots, if they are
/// called with an argument linear in temperature.
pub(crate) fn knots(value: &Value, slots: &mut [f64], stack: &mut Vec<f64>) -> Vec<f64> {
    let mut edges = Vec::new();
    for program in value.programs() {
        for call in program.table_calls() {
            let (LookupTable::One(table), [argument]) = (&*call.table, &call.arguments[..]) else {
                continue;
            };
            // linear in T, so two values give the temperature at which it reaches a knot
            let mut of = |t: f64| {
                slots[slot::OWN as usize] = t;
                argument.eval(slots, stack).ok()
            };
            if let (Some(a), Some(b)) = (of(0.0), of(1000.0)) {
                edges.extend(table.knots().iter().map(|knot| 1000.0 * (knot - a) / (b - a)));
            }
        }
    }
    edges.retain(|t| t.is_finite() && *t > 0.0);
    edges
}
