//! Distances of controls from their switching points, while temperatures are inside a tube.

use lptn_assembly::ThermalSystem;
use lptn_network::{ControlId, End, Evaluation, Item, Positions};
use lptn_units::Taylor;

use super::polynomial::Course;
use super::way::{SAMPLES, Way};
use super::{ROUNDING, Uncertified};
use crate::events::ControlState;

/// A distance counts as small below these shares of the allowance, so that a shorter piece is
/// clear: the first ones leave little for the last one, which decides how much a bound grows at a
/// switch.
const NEAR: [f64; 4] = [1.5, 1.1, 1.01, 1.001];

/// Temperatures during a part of a run: at most `most` in K away from a way.
pub(super) struct Tube<'t> {
    /// From a time in s to another, and one inside their segment.
    pub(super) span: (f64, f64),
    pub(super) inside: f64,
    pub(super) way: &'t Way<SAMPLES>,
    pub(super) most: &'t dyn Fn(usize) -> f64,
}

impl Tube<'_> {
    fn time(&self, place: f64) -> f64 {
        let (from, to) = self.span;
        (from + 0.5 * (1.0 + place) * (to - from)).clamp(from, to)
    }

    fn place(&self, time: f64) -> f64 {
        let (from, to) = self.span;
        (2.0 * (time - from) / (to - from) - 1.0).clamp(-1.0, 1.0)
    }

    /// The range of each unknown in K.
    pub(super) fn box_of(&self) -> Vec<[f64; 2]> {
        let nothing = [f64::NEG_INFINITY, f64::INFINITY];
        let [whole, _] = self.way.tube(self.most);
        whole.iter().map(|bounds| bounds.range().unwrap_or(nothing)).collect()
    }
}

/// The controls of a network, with the states that they have for sure.
pub(super) struct Gates<'a> {
    system: &'a ThermalSystem,
    pub(super) positions: Positions,
    /// For each control the times in s between which it switched last.
    pub(super) since: Vec<[f64; 2]>,
}

impl<'a> Gates<'a> {
    pub(super) fn new(system: &'a ThermalSystem) -> Self {
        let positions = system.network().initial_positions();
        let since = vec![[f64::NEG_INFINITY; 2]; positions.controls.len()];
        Self { system, positions, since }
    }

    /// Takes the states at the start, which are exact.
    pub(super) fn begin(&mut self, controls: &[ControlState]) {
        self.positions.controls = controls.iter().map(|control| control.on).collect();
        self.since = controls.iter().map(|control| [control.since; 2]).collect();
    }

    pub(super) fn ids(&self) -> impl Iterator<Item = ControlId> + use<> {
        self.system.network().control_ids()
    }

    pub(super) fn name(&self, id: ControlId) -> String {
        self.system.network().name_of(Item::Control(id)).into_owned()
    }

    fn is_on(&self, id: ControlId) -> bool {
        self.positions.controls[id.index()]
    }

    /// A time in s before which a control stays for sure, and one after which it may switch for
    /// sure.
    pub(super) fn armed(&self, id: ControlId) -> [f64; 2] {
        self.since[id.index()].map(|since| since + self.system.network().min_dwell(id))
    }

    /// The unknown whose temperature switches a control, and the range in K of the temperature at
    /// which it leaves its state from one time in s to another; `None` if it is not that simple.
    pub(super) fn threshold(
        &self,
        scope: &mut Evaluation,
        (span, inside): ((f64, f64), f64),
        id: ControlId,
    ) -> Option<(usize, [f64; 2])> {
        let network = self.system.network();
        let End::Node(node) = network.thermostat(id)?.sense else { return None };
        let unknown = self.system.unknowns().iter().position(|known| *known == node)?;
        let [mut inputs, _] = network.input_bounds(scope, span, inside);
        Some((unknown, network.enclose_threshold((id, self.is_on(id)), &mut inputs)?))
    }

    /// The distance of each control from leaving a state in K; positive if it stays. The state of
    /// an open control may be either one.
    fn rooms(
        &self,
        scope: &mut Evaluation,
        tube: &Tube<'_>,
        (states, open): (&[(ControlId, bool)], Option<ControlId>),
    ) -> Result<Vec<Course>, Uncertified> {
        let network = self.system.network();
        let [over, at] = network.input_bounds(scope, tube.span, tube.inside);
        let mut sides = Vec::with_capacity(2);
        for (mut inputs, way) in [over, at].into_iter().zip(tube.way.tube(tube.most)) {
            open.iter().for_each(|id| network.loosen(&mut inputs, *id));
            let vertices = self.system.enclose_vertices(&mut inputs, &way);
            let name = |item| network.name_of(item).into_owned();
            let law = |item| Uncertified::Law { name: name(item), time: tube.span.0 };
            let vertices = vertices.map_err(law)?;
            network.place_bounds(&mut inputs, &vertices);
            let excess =
                states.iter().map(|state| network.enclose_excess(*state, &mut inputs, &vertices));
            sides.push(excess.collect::<Vec<Option<Taylor>>>());
        }
        let (at, over) = (sides.pop().unwrap_or_default(), sides.pop().unwrap_or_default());
        let room = |k: usize| {
            let course = at[k].zip(over[k]).and_then(|(m, w)| Course::of(&-m, &-w));
            let unclear = || self.unclear(states[k].0, tube.span.0, NO_BOUNDS);
            let mut course = course.ok_or_else(unclear)?;
            course.allowance += ROUNDING * course.size();
            Ok(course)
        };
        (0..states.len()).map(room).collect()
    }

    /// The first control that may leave its state inside a tube, and a time in s up to which none
    /// does for sure.
    pub(super) fn first(
        &self,
        scope: &mut Evaluation,
        tube: &Tube<'_>,
    ) -> Result<Option<(ControlId, f64)>, Uncertified> {
        let (ids, to) = (self.system.network().control_ids(), tube.span.1);
        let may: Vec<_> = ids.filter(|id| self.armed(*id)[0] < to).collect();
        let states: Vec<_> = may.iter().map(|id| (*id, self.is_on(*id))).collect();
        if states.is_empty() {
            return Ok(None);
        }
        let rooms = self.rooms(scope, tube, (&states, None))?;
        let one = |(room, id): (&Course, &ControlId)| {
            room.may_fall_below(room.allowance)?;
            let time = |near: f64| {
                let place = room.may_fall_below(near * room.allowance);
                tube.time(place.unwrap_or(1.0)).max(self.armed(*id)[0])
            };
            let later = NEAR.into_iter().map(time).find(|time| *time > tube.span.0);
            Some((*id, later.unwrap_or(tube.span.0)))
        };
        let all = rooms.iter().zip(&may).filter_map(one);
        Ok(all.min_by(|a, b| a.1.total_cmp(&b.1)))
    }

    /// A time in s at which a control has left its state for sure; `None` if there is none.
    pub(super) fn leaves(
        &self,
        scope: &mut Evaluation,
        tube: &Tube<'_>,
        id: ControlId,
    ) -> Result<Option<f64>, Uncertified> {
        let rooms = self.rooms(scope, tube, (&[(id, self.is_on(id))], None))?;
        let (armed, to) = (self.armed(id)[1], tube.span.1);
        let time = |room: &Course| {
            if tube.span.0 < armed && armed <= to {
                let beyond = room.at(tube.place(armed)) < -room.allowance;
                return beyond.then_some(armed);
            }
            room.falls_below(-room.allowance).map(|place| tube.time(place).next_up().min(to))
        };
        Ok(rooms.first().and_then(time).filter(|_| armed <= to))
    }

    /// Checks that nothing else switches inside a tube in which a control may have either state,
    /// and that this one does not switch back.
    pub(super) fn stay(
        &self,
        scope: &mut Evaluation,
        tube: &Tube<'_>,
        open: (ControlId, f64),
    ) -> Result<(), Uncertified> {
        let network = self.system.network();
        let back = (open.0, !self.is_on(open.0));
        let others = network.control_ids().filter(|id| *id != open.0);
        let others = others.filter(|id| self.armed(*id)[0] < tube.span.1);
        let mut states: Vec<_> = others.map(|id| (id, self.is_on(id))).collect();
        states.extend((open.1 + network.min_dwell(open.0) < tube.span.1).then_some(back));
        let rooms = self.rooms(scope, tube, (&states, Some(open.0)))?;
        let near = rooms.iter().position(|room| room.may_fall_below(room.allowance).is_some());
        let because = |id| if id == open.0 { GRAZES } else { TOGETHER };
        let error = |id| self.unclear(id, tube.span.0, because(id));
        near.map_or(Ok(()), |near| Err(error(states[near].0)))
    }

    pub(super) fn unclear(&self, id: ControlId, time: f64, because: &'static str) -> Uncertified {
        Uncertified::SwitchTime { name: self.name(id), time, because }
    }
}

/// Reasons why the time of a switch is not bounded.
pub(super) const GRAZES: &str = "the temperature stays too close to the threshold";
pub(super) const TOGETHER: &str = "something else changes or switches at about the same time";
pub(super) const NO_BOUNDS: &str = "its threshold has no bounds";
