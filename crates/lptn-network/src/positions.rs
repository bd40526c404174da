//! Positions: the states of controls and the truth of comparisons of temperatures, fixed between
//! two events.
//!
//! A control and every comparison of temperatures have a slot that contains 0 or 1 until an event
//! changes it. The code of an expression is rewritten once, when the network is built, to read the
//! slot instead of the comparison. Heat flows are therefore smooth inside a step, and dual numbers
//! see one branch.

use std::sync::Arc;

use crate::evaluation::Evaluation;
use crate::id::{ControlId, SwitchId};
use crate::network::Network;

/// The positions of everything that switches. Between two events none of them changes.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Positions {
    /// True for each control that is on.
    pub controls: Vec<bool>,
    /// True for each switch whose comparison is true.
    pub switches: Vec<bool>,
}

impl Network {
    /// The positions before any temperature is known: controls as their `start` says, all
    /// comparisons false.
    pub fn initial_positions(&self) -> Positions {
        let start = |id: ControlId| self.thermostat(id).is_some_and(|thermostat| thermostat.start);
        Positions {
            controls: self.control_ids().map(start).collect(),
            switches: vec![false; self.switches().len()],
        }
    }

    /// True if anything switches at times that are not known in advance.
    pub fn has_events(&self) -> bool {
        !(self.controls().is_empty() && self.switches().is_empty())
    }
}

impl Evaluation {
    /// Sets the states of the controls and the truth of the comparisons.
    pub fn set_positions(&mut self, positions: &Positions) {
        let layout = Arc::clone(self.layout());
        let number = |holds: bool| f64::from(u8::from(holds));
        for (i, &on) in positions.controls.iter().enumerate() {
            self.set(layout.control(ControlId::from_len(i)), number(on));
        }
        for (i, &holds) in positions.switches.iter().enumerate() {
            self.set(layout.switch(SwitchId::from_len(i)), number(holds));
        }
    }

    /// The positions that were set last.
    pub fn positions(&self) -> Positions {
        let layout = self.layout();
        let controls = (0..layout.control_count()).map(|i| self.is_on(ControlId::from_len(i)));
        let switches = (0..layout.switch_count())
            .map(|i| self.slot(layout.switch(SwitchId::from_len(i))) != 0.0);
        Positions { controls: controls.collect(), switches: switches.collect() }
    }

    /// True if a control is on.
    pub fn is_on(&self, id: ControlId) -> bool {
        self.slot(self.layout().control(id)) != 0.0
    }

    /// The value of a control, 0 or 1.
    pub fn control(&self, id: ControlId) -> f64 {
        self.slot(self.layout().control(id))
    }
}
