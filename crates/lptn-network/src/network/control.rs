//! Distance of a control from switching.

use crate::evaluation::Evaluation;
use crate::id::{ControlId, Item};
use crate::input_error::{InputError, InputProblem};
use crate::network::Network;
use crate::parts::control::Thermostat;
use crate::value::Value;

impl Network {
    /// The thermostat of a control.
    pub fn thermostat(&self, id: ControlId) -> Option<&Thermostat> {
        self.controls()[id.index()].thermostat.as_ref()
    }

    /// Minimum time in s that a control keeps its state after a switch.
    pub fn min_dwell(&self, id: ControlId) -> f64 {
        self.numbers.min_dwell[id.index()]
    }

    /// The temperatures in K at which a control switches on and off; `None` unless both are
    /// constant.
    pub fn thresholds(&self, id: ControlId) -> Option<[f64; 2]> {
        let Thermostat { on, off, .. } = self.thermostat(id)?;
        let constant = |value: &Value| self.parts.reads(value).is_constant();
        if !constant(on) || !constant(off) {
            return None;
        }
        let mut scope = self.evaluation();
        Some([on.at(&mut scope).ok()?, off.at(&mut scope).ok()?])
    }

    /// The distance in K between the thresholds of a control; `None` unless both are constant.
    pub fn dead_band(&self, id: ControlId) -> Option<f64> {
        let [on, off] = self.thresholds(id)?;
        Some((on - off).abs())
    }

    /// Excess in K of the temperature that a control senses over the threshold at which it leaves
    /// the state that it has in the mode of `scope`: if positive, the control has to switch.
    /// `scope` is set to a time; `temperatures` are those of all vertices in K.
    ///
    /// # Errors
    /// [`InputError`] if a threshold cannot be evaluated, or the two are in the wrong order.
    pub fn control_excess(
        &self,
        id: ControlId,
        scope: &mut Evaluation,
        temperatures: &[f64],
    ) -> Result<f64, InputError> {
        let Some(thermostat) = self.thermostat(id) else { return Ok(-1.0) };
        let item = Item::Control(id);
        let [on_field, off_field] = thermostat.acts.fields();
        self.place_named(&self.parts.control_dependence[id.index()], scope, temperatures);
        let on = self.number(item, on_field, &thermostat.on, scope)?;
        let off = self.number(item, off_field, &thermostat.off, scope)?;
        if !thermostat.acts.in_order(on, off) {
            return Err(self.failed(
                item,
                (on_field, InputProblem::ThresholdsCrossed { on, off }),
                scope,
            ));
        }
        let felt = temperatures[self.vertex(thermostat.sense)];
        Ok(thermostat.acts.excess([on, off], scope.is_on(id), felt))
    }
}
