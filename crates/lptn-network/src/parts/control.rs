//! Controls: thermostats that switch between off and on.

use std::ops::Sub;

use crate::id::{End, Field};
use crate::value::Value;

/// A thermostat. Its name is 0 (off) or 1 (on) in expressions.
#[derive(Clone, Debug)]
pub struct Control {
    /// Its name, unique among parameters, signals, tables, controls and reports.
    pub name: String,
    /// Its thermostat; `None` until
    /// [`NetworkBuilder::thermostat`](crate::NetworkBuilder::thermostat) sets it.
    pub thermostat: Option<Thermostat>,
}

/// Switching rule of a control. Both thresholds are absolute temperatures in K and may depend on
/// time, parameters, other controls and temperatures.
#[derive(Clone, Debug)]
pub struct Thermostat<T = Value> {
    /// The node or boundary whose temperature it senses.
    pub sense: End,
    /// Its direction: cooling or heating.
    pub acts: Acts,
    /// Beyond this it switches on.
    pub on: T,
    /// Beyond this, on the other side, it switches off.
    pub off: T,
    /// True if it is on at the start when the temperature lies between the thresholds.
    pub start: bool,
    /// Minimum time in s that it keeps its state after a switch.
    pub min_dwell: T,
}

/// Direction of a thermostat.
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

    /// Excess of a temperature in K over the threshold at which a control leaves its state, of
    /// numbers or of bounds.
    pub fn excess<T: Sub<Output = T>>(self, [on, off]: [T; 2], is_on: bool, felt: T) -> T {
        match (self, is_on) {
            (Self::Cooling, false) => felt - on,
            (Self::Cooling, true) => off - felt,
            (Self::Heating, false) => on - felt,
            (Self::Heating, true) => felt - off,
        }
    }

    /// True if the threshold for on lies on its side of the threshold for off.
    pub fn in_order(self, on: f64, off: f64) -> bool {
        match self {
            Self::Cooling => on > off,
            Self::Heating => on < off,
        }
    }
}
