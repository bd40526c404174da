//! Event indicators: signed numbers that are zero at the events of a network.
//!
//! The search for events uses the same numbers (`gates.rs`, `limit.rs`), with margins. A simulator
//! that integrates the states itself finds events by changes of sign (fmi3GetEventIndicators of FMI
//! 3.0, Modelica Association 2022).

use lptn_network::{ControlId, InputError, LimitId, SwitchId};
use lptn_units::Type;

use super::{ControlState, EventKind};
use crate::rates::{StateRates, input};
use crate::reading::Reading;
use crate::times::just_after;
use crate::unsolved::Unsolved;

/// A signed number that is zero at an event and continuous between two events.
#[derive(Clone, Debug, PartialEq)]
pub struct EventIndicator {
    /// The control, comparison or limit that it is of.
    pub kind: EventKind,
    /// Its name: of a comparison the element and the field, `heater.P`.
    pub name: String,
    /// The number in SI units.
    pub value: f64,
    /// The type of `value`: for temperatures a difference in K.
    pub ty: Type,
    /// The SI unit of `value`, `K`; `1` for a number.
    pub unit: String,
    /// The meaning of a positive value.
    pub positive: PositiveSide,
    /// The end in s of the dwell of a control, which does not switch before. If the value is positive
    /// then, it switches then. `None` if it may switch now.
    pub stays_until: Option<f64>,
}

/// The meaning of a positive event indicator.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PositiveSide {
    /// The control is off, and its temperature is beyond the threshold at which it switches on.
    SwitchesOn,
    /// The control is on, and its temperature is beyond the threshold at which it switches off.
    SwitchesOff,
    /// The comparison is true.
    IsTrue,
    /// The limit is kept.
    Kept,
}

impl StateRates<'_> {
    /// One indicator for each control, each comparison of temperatures and each limit, in the order
    /// of the network, at `time` in s. A limit of a mean has none: the mean is known at the end of a
    /// run.
    ///
    /// The indicator of a control jumps to minus its dead band when the control switches, because
    /// the other threshold comes next. Those of comparisons and limits do not jump there.
    ///
    /// # Errors
    /// [`Unsolved`] as for [`StateRates::at`], or if a threshold or a side has no value.
    pub fn indicators(
        &mut self,
        time: f64,
        states: &[f64],
    ) -> Result<Vec<EventIndicator>, Unsolved> {
        self.place(time, states)?;
        let network = self.system.network();
        let mut all = Vec::new();
        for id in network.control_ids() {
            all.push(self.of_control(time, id).map_err(input)?);
        }
        for id in network.switch_ids() {
            all.push(self.of_comparison(id).map_err(input)?);
        }
        all.extend(self.of_limits(time).map_err(input)?);
        Ok(all)
    }

    fn indicator(&self, kind: EventKind, (value, ty): (f64, Type)) -> EventIndicator {
        let ty = Type { absolute: false, ..ty };
        EventIndicator {
            kind,
            name: kind.name(self.system.network()),
            value,
            ty,
            unit: ty.dimension.si_unit(),
            positive: PositiveSide::IsTrue,
            stays_until: None,
        }
    }

    fn of_control(&mut self, time: f64, id: ControlId) -> Result<EventIndicator, InputError> {
        let excess = self.system.control_excess(&mut self.work, id)?;
        let is_on = self.work.positions().controls.get(id.index()) == Some(&true);
        let end = |control: &ControlState| control.since + self.system.network().min_dwell(id);
        let end = self.controls.get(id.index()).map(end);
        let positive = if is_on { PositiveSide::SwitchesOff } else { PositiveSide::SwitchesOn };
        Ok(EventIndicator {
            positive,
            stays_until: end.filter(|end| *end > time),
            ..self.indicator(EventKind::Control(id), (excess, Type::ABSOLUTE_TEMPERATURE))
        })
    }

    fn of_comparison(&mut self, id: SwitchId) -> Result<EventIndicator, InputError> {
        let (difference, _) = self.system.switch_difference(&mut self.work, id)?;
        let switch = &self.system.network().switches()[id.index()];
        let towards_true = if switch.holds(1.0) { difference } else { -difference };
        Ok(self.indicator(EventKind::Comparison(id), (towards_true, switch.difference.ty())))
    }

    fn of_limits(&mut self, time: f64) -> Result<Vec<EventIndicator>, InputError> {
        let network = self.system.network();
        let at_moments = |id: &LimitId| network.limits()[id.index()].is_of_moments();
        let limits: Vec<LimitId> = network.limit_ids().filter(at_moments).collect();
        if limits.is_empty() {
            return Ok(Vec::new());
        }
        let mut reading = Reading::new(self.system);
        reading.place(&mut self.work, (time, just_after(time)))?;
        let one = |id: LimitId| {
            let margin = network.limit_margin(id, &mut reading.scope)?;
            let ty = network.limits()[id.index()].ty;
            let indicator = self.indicator(EventKind::Limit(id), (margin, ty));
            Ok(EventIndicator { positive: PositiveSide::Kept, ..indicator })
        };
        limits.into_iter().map(one).collect()
    }
}
