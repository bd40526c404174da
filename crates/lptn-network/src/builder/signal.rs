//! Adds signals.

use std::sync::Arc;

use lptn_units::{Type, Unit};

use crate::builder::NetworkBuilder;
use crate::error::BuildErrorKind;
use crate::id::{Item, SignalId};
use crate::parts::signal::{AfterEnd, Course, Signal};
use crate::value::{Input, Value};

impl NetworkBuilder {
    /// Adds a signal. Expressions that are compiled afterwards may use its name.
    pub fn signal(&mut self, name: &str, ty: Type, course: Course) -> SignalId {
        let sound = course.is_sound();
        let constant = Course::Expression(Value::Constant(f64::NAN));
        // nothing reads the constant: the network is refused
        let course = if sound { course } else { constant };
        let layout = Arc::make_mut(&mut self.parts.layout);
        let id = layout.add_signal(Signal {
            name: name.to_owned(),
            ty,
            course: course.clone(),
            unit: None,
        });
        if let AfterEnd::Repeat(period) = course.after() {
            let (first, last) = course.span();
            if !course.is_covered() {
                let span = last - first;
                self.error(name, BuildErrorKind::PeriodTooShort { signal: id, period, span });
            }
        }
        if !sound {
            self.error(name, BuildErrorKind::SignalPoints { signal: id });
        }
        self.register_value(name, Item::Signal(id));
        id
    }

    /// The names and types of the signals added up to now.
    pub fn signals(&self) -> impl Iterator<Item = (&str, Type)> {
        self.parts.layout.signals().iter().map(|signal| (signal.name.as_str(), signal.ty))
    }

    /// Sets the unit in which a signal is shown; a unit of another dimension is ignored.
    pub fn show_signal_in(&mut self, id: SignalId, unit: Unit) {
        Arc::make_mut(&mut self.parts.layout).show_signal_in(id, unit);
    }

    /// Adds a signal that an expression of `t`, parameters and earlier signals describes.
    pub fn signal_expression(&mut self, name: &str, input: impl Into<Input>) -> SignalId {
        let Input { value, ty, .. } = input.into();
        self.signal(name, ty, Course::Expression(value))
    }
}
