//! Checks the thresholds of controls.

use crate::error::BuildErrorKind;
use crate::id::{ControlId, Field, Item};
use crate::numbers::Work;
use crate::parts::control::Thermostat;
use lptn_laws::Range;

impl Work<'_> {
    /// Minimum time in s that each control keeps its state after a switch. Thresholds that are
    /// constant are compared now.
    pub(crate) fn controls(&mut self) -> Vec<f64> {
        let parts = self.parts;
        let controls = parts.controls.iter().enumerate();
        controls
            .map(|(i, control)| {
                let id = ControlId::from_len(i);
                let Some(thermostat) = &control.thermostat else {
                    self.error(Item::Control(id), BuildErrorKind::NoThermostat { control: id });
                    return 0.0;
                };
                self.thresholds(id, thermostat);
                let (item, field, value) =
                    (Item::Control(id), Field::MinDwell, &thermostat.min_dwell);
                let dwell = self.constant(item, field, value, Range::Finite);
                if dwell < 0.0 {
                    self.error(item, BuildErrorKind::Negative { item, field, value: dwell });
                }
                dwell
            })
            .collect()
    }

    fn thresholds(&mut self, control: ControlId, thermostat: &Thermostat) {
        let (item, fields) = (Item::Control(control), thermostat.acts.fields());
        let [on, off] =
            [(fields[0], &thermostat.on), (fields[1], &thermostat.off)].map(|(field, value)| {
                let constant = self.parts.reads(value).is_constant();
                constant.then(|| self.constant(item, field, value, Range::Temperature))
            });
        if let (Some(on), Some(off)) = (on, off)
            && on.is_finite()
            && off.is_finite()
            && !thermostat.acts.in_order(on, off)
        {
            self.error(item, BuildErrorKind::ThresholdsCrossed { control, fields, on, off });
        }
    }
}
