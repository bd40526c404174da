//! Controls: thermostats that switch between off and on.

use crate::id::{End, Field};
use crate::value::Value;

/// A thermostat. Its name is 0 (off) or 1 (on) in expressions.
#[derive(Clone, Debug)]
pub struct Control {
    /// Its name, unique among parameters, signals, tables, controls and reports.
    pub name: String,
    /// What it does; `None` until [`NetworkBuilder::thermostat`](crate::NetworkBuilder::thermostat)
    /// says so.
    pub thermostat: Option<Thermostat>,
}

/// When a control switches. Both thresholds are absolute temperatures in K and may depend on time,
/// parameters, other controls and temperatures.
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

    /// How far a temperature in K is beyond the threshold at which a control leaves its state.
    pub fn excess(self, [on, off]: [f64; 2], is_on: bool, felt: f64) -> f64 {
        match (self, is_on) {
            (Self::Cooling, false) => felt - on,
            (Self::Cooling, true) => off - felt,
            (Self::Heating, false) => on - felt,
            (Self::Heating, true) => felt - off,
        }
    }

    /// Whether the threshold for on lies on its side of that for off.
    pub fn in_order(self, on: f64, off: f64) -> bool {
        match self {
            Self::Cooling => on > off,
            Self::Heating => on < off,
        }
    }
}
