//! `[control]`.

use lptn_units::{Dimension, Type};

use super::Writer;
use crate::toml_text::{TomlFields, value};

impl Writer<'_> {
    pub(super) fn controls(&mut self) {
        let (network, mut section) = (&self.network, TomlFields::default());
        for (id, control) in network.control_ids().zip(network.controls()) {
            let Some(thermostat) = network.thermostat(id) else { continue };
            let mut fields = TomlFields::default();
            fields.word("sense", &self.name(thermostat.sense));
            let [on, off] = thermostat.acts.fields();
            fields.put(on.key(), value(&thermostat.on, Type::ABSOLUTE_TEMPERATURE));
            fields.put(off.key(), value(&thermostat.off, Type::ABSOLUTE_TEMPERATURE));
            if thermostat.start {
                fields.word("start", "on");
            }
            if network.min_dwell(id) > 0.0 {
                fields.put("min_dwell", value(&thermostat.min_dwell, Type::of(Dimension::TIME)));
            }
            section.put(&control.name, fields.inline());
        }
        self.section("control", &section);
    }
}
