//! Text of the time history of a signal.

use lptn_network::{AfterEnd, Course, Signal};
use lptn_units::{Dimension, Interpolation, Type};

use crate::toml_text::{TomlFields, like, list, list_in, quantity};

const TIME: Type = Type::of(Dimension::TIME);

/// The value of its key: an expression, or a table of points.
pub(crate) fn course(signal: &Signal) -> String {
    let (times, values, interpolation) = match &signal.course {
        // alone, `K` would be a difference
        Course::Expression(expression) => return like(expression, signal.ty),
        Course::Steps { times, values, .. } => {
            (times.as_slice(), values.as_slice(), Some("previous"))
        }
        Course::Curve { points, .. } => {
            let pchip = points.interpolation() == Interpolation::Pchip;
            (points.knots(), points.values(), pchip.then_some("pchip"))
        }
    };
    let mut fields = TomlFields::default();
    fields.list("t", list(times, TIME));
    fields.list("v", list_in(values, signal.ty, signal.unit.as_ref()));
    if let Some(interpolation) = interpolation {
        fields.word("interp", interpolation);
    }
    match signal.course.after() {
        AfterEnd::Error => {}
        AfterEnd::Hold => fields.word("after_end", "hold"),
        AfterEnd::Repeat(period) => {
            fields.word("after_end", "repeat");
            fields.put("period", quantity(period, TIME));
        }
    }
    fields.inline()
}
