//! Controls: thermostats that switch between off and on.

use std::sync::Arc;

use lptn_units::{Dimension, Type};

use crate::builder::NetworkBuilder;
use crate::error::BuildErrorKind;
use crate::evaluation::Evaluation;
use crate::id::{ControlId, End, Field, Item};
use crate::input_error::{InputError, InputProblem};
use crate::network::Network;
use crate::numbers::{Range, Work};
use crate::value::{Input, Value};

/// A thermostat. Its name is 0 (off) or 1 (on) in expressions.
#[derive(Clone, Debug)]
pub struct Control {
    /// Its name.
    pub name: String,
    /// What it does; `None` until [`NetworkBuilder::thermostat`] says so.
    pub thermostat: Option<Thermostat>,
}

/// When a control switches. Both thresholds are absolute temperatures in K and may depend on time, parameters, other
/// controls and temperatures.
#[derive(Clone, Debug)]
pub struct Thermostat<T = Value> {
    /// The node or boundary whose temperature it feels.
    pub sense: End,
    /// Which way it acts.
    pub acts: Acts,
    /// Beyond this it switches on.
    pub on: T,
    /// Beyond this, on the other side, it switches off.
    pub off: T,
    /// Whether it is on at the start, where the temperature lies between the thresholds.
    pub start: bool,
    /// How long it stays as it is after a switch, in s.
    pub min_dwell: T,
}

/// Which way a thermostat acts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Acts {
    /// On above a temperature, off below a lower one: a fan.
    Cooling,
    /// On below a temperature, off above a higher one: a heater.
    Heating,
}

impl Acts {
    /// The fields of the thresholds for on and off.
    pub fn fields(self) -> [Field; 2] {
        match self {
            Self::Cooling => [Field::OnAbove, Field::OffBelow],
            Self::Heating => [Field::OnBelow, Field::OffAbove],
        }
    }

    /// Whether the threshold for on lies on its side of that for off.
    pub(crate) fn in_order(self, on: f64, off: f64) -> bool {
        match self {
            Self::Cooling => on > off,
            Self::Heating => on < off,
        }
    }
}

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
        let min_dwell = self.typed((&name, item, Field::MinDwell), min_dwell, Type::of(Dimension::TIME));
        let thermostat = Thermostat { sense, acts, on, off, start, min_dwell };
        self.parts.controls[id.index()].thermostat = Some(thermostat);
    }
}

impl Work<'_> {
    /// How long each control stays as it is after a switch, in s. Thresholds that are constant are compared now.
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
                let (item, field, value) = (Item::Control(id), Field::MinDwell, &thermostat.min_dwell);
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
        let [on, off] = [(fields[0], &thermostat.on), (fields[1], &thermostat.off)].map(|(field, value)| {
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

impl Network {
    /// The controls.
    pub fn controls(&self) -> &[Control] {
        &self.parts.controls
    }

    /// Ids of all controls.
    pub fn control_ids(&self) -> impl ExactSizeIterator<Item = ControlId> + use<> {
        (0..self.controls().len()).map(ControlId::from_len)
    }

    /// The thermostat of a control.
    pub fn thermostat(&self, id: ControlId) -> Option<&Thermostat> {
        self.controls()[id.index()].thermostat.as_ref()
    }

    /// How long a control stays as it is after a switch, in s.
    pub fn min_dwell(&self, id: ControlId) -> f64 {
        self.numbers.min_dwell[id.index()]
    }

    /// The distance in K between the thresholds of a control; `None` unless both are constant.
    pub fn dead_band(&self, id: ControlId) -> Option<f64> {
        let Thermostat { on, off, .. } = self.thermostat(id)?;
        let mut scope = self.evaluation();
        let mut constant = |value: &Value| {
            let is = self.parts.reads(value).is_constant();
            is.then(|| value.at(&mut scope).ok()).flatten()
        };
        Some((constant(on)? - constant(off)?).abs())
    }

    /// How far, in K, the temperature that a control feels is beyond the threshold at which it leaves the state that
    /// it has in the mode of `scope`: a positive number means that it has to switch. `scope` stands at a time;
    /// `temperatures` are those of all vertices in K.
    ///
    /// # Errors
    /// [`InputError`] if a threshold cannot be had, or the two are crossed over.
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
            return Err(self.failed(item, (on_field, InputProblem::ThresholdsCrossed { on, off }), scope));
        }
        let felt = temperatures[self.vertex(thermostat.sense)];
        Ok(match (thermostat.acts, scope.is_on(id)) {
            (Acts::Cooling, false) => felt - on,
            (Acts::Cooling, true) => off - felt,
            (Acts::Heating, false) => on - felt,
            (Acts::Heating, true) => felt - off,
        })
    }
}
