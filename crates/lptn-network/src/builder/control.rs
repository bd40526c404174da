//! Adds controls.

use std::sync::Arc;

use lptn_units::{Dimension, Type};

use crate::builder::NetworkBuilder;
use crate::error::BuildErrorKind;
use crate::id::{ControlId, Field, Item};
use crate::parts::control::{Control, Thermostat};
use crate::value::Input;

impl NetworkBuilder {
    /// Adds a control. Expressions that are compiled afterwards may use its name.
    pub fn control(&mut self, name: &str) -> ControlId {
        let id = ControlId::from_len(self.parts.controls.len());
        self.parts.controls.push(Control { name: name.to_owned(), thermostat: None });
        Arc::make_mut(&mut self.parts.layout).add_control(id);
        self.register_value(name, Item::Control(id));
        id
    }

    /// Says when a control switches.
    pub fn thermostat(&mut self, id: ControlId, thermostat: Thermostat<Input>) {
        let item = Item::Control(id);
        let Some(name) = self.parts.controls.get(id.index()).map(|c| c.name.clone()) else {
            return self.error("", BuildErrorKind::ForeignId { item });
        };
        self.check_end(&name, item, thermostat.sense);
        let Thermostat { sense, acts, on, off, start, min_dwell } = thermostat;
        let [on_field, off_field] = acts.fields();
        let threshold = Type::ABSOLUTE_TEMPERATURE;
        let on = self.typed((&name, item, on_field), on, threshold);
        let off = self.typed((&name, item, off_field), off, threshold);
        let min_dwell =
            self.typed((&name, item, Field::MinDwell), min_dwell, Type::of(Dimension::TIME));
        let thermostat = Thermostat { sense, acts, on, off, start, min_dwell };
        self.parts.controls[id.index()].thermostat = Some(thermostat);
    }
}
