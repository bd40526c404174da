//! Bounds on results: heats, values of grids, states, reports and sides of limits, while the
//! temperatures that they read have bounds.

use std::ops::Add as _;

use lptn_units::{Bounded, Scalar, Taylor};

use crate::id::{End, LimitId, ReportId, StateId};
use crate::network::Network;
use crate::network::enclosure::InputBounds;
use crate::parts::grid_value::GridValue;
use crate::parts::heat::HeatOf;
use crate::value::Value;

impl Network {
    /// Takes bounds on the temperatures of all vertices in K, nodes, then boundaries, for the
    /// results that read them.
    pub fn place_bounds(&self, inputs: &mut InputBounds, vertices: &[Taylor]) {
        let layout = &self.parts.layout;
        for (slot, bounds) in layout.temperatures().zip(vertices) {
            inputs.set(slot, *bounds);
        }
        for (value, slot) in layout.grid_values() {
            inputs.set(*slot, self.enclose_grid_value(*value, vertices));
        }
    }

    /// Takes bounds on the heat flows that results name, in W, in the order of
    /// [`Network::named_heats`]; `None` for one without bounds.
    pub fn place_heat_bounds(&self, inputs: &mut InputBounds, heats: &[Option<Taylor>]) {
        for ((_, slot), heat) in self.parts.layout.heats().iter().zip(heats) {
            inputs.set(*slot, heat.unwrap_or_else(nothing));
        }
    }

    /// Bounds on the heat in W that each boundary gives to the network while the vertices have these
    /// bounds in K; `None` for one without bounds.
    pub fn enclose_given(
        &self,
        inputs: &mut InputBounds,
        vertices: &[Taylor],
    ) -> Vec<Option<Taylor>> {
        let at = |vertex: u32| vertices[vertex as usize];
        let mut given = vec![Some(Taylor::constant(0.0)); self.boundaries().len()];
        for (path, conductor) in self.conductor_ids().zip(self.conductors()) {
            let ends = [conductor.from, conductor.to];
            if !ends.iter().any(|end| matches!(end, End::Boundary(_))) {
                continue;
            }
            let received = self.enclose_exchange(path, inputs, &at);
            for (end, place) in ends.into_iter().zip(0..) {
                let End::Boundary(id) = end else { continue };
                let given = &mut given[id.index()];
                *given = given.zip(received).map(|(given, received)| given - received[place]);
            }
        }
        given
    }

    /// Bounds on a heat flow in W while the vertices have these bounds in K, and the boundaries give
    /// the heat of [`Network::enclose_given`]; `None` if there are none, and for the further results
    /// of laws.
    pub fn enclose_heat(
        &self,
        heat: HeatOf,
        inputs: &mut InputBounds,
        (vertices, given): (&[Taylor], &[Option<Taylor>]),
    ) -> Option<Taylor> {
        let at = |vertex: u32| vertices[vertex as usize];
        let bounds = match heat {
            HeatOf::Conductor(id) | HeatOf::ReceivedTo(id) => {
                self.enclose_exchange(id, inputs, &at)?[1]
            }
            HeatOf::ReceivedFrom(id) => self.enclose_exchange(id, inputs, &at)?[0],
            HeatOf::Source(id) => self.enclose_source(id, inputs, &at)?,
            HeatOf::Boundary(id) => given[id.index()]?,
            HeatOf::FacePath(id) => {
                let mut parts = self.face_paths()[id.index()].conductors();
                parts.try_fold(Taylor::constant(0.0), |sum, part| {
                    Some(sum + self.enclose_exchange(part, inputs, &at)?[1])
                })?
            }
            HeatOf::Told(..) => return None,
        };
        bounds.range().map(|_| bounds)
    }

    /// Bounds on a temperature of a grid in K; without a range if there are none.
    pub fn enclose_grid_value(&self, value: GridValue, vertices: &[Taylor]) -> Taylor {
        let grid = &self.grids()[value.grid().index()];
        let (members, weights) = (self.grid_value_members(value), grid.weights(value));
        let all = members.iter().map(|member| Bounded::from(vertices[*member as usize]));
        let share = (members.len() as f64).recip();
        let found = match value {
            GridValue::Min(_) => all.reduce(Bounded::min),
            GridValue::Max(_) => all.reduce(Bounded::max),
            _ => {
                let weights = weights.into_iter().chain(std::iter::repeat(share));
                all.zip(weights)
                    .map(|(t, weight)| t * Bounded::from_f64(weight))
                    .reduce(Bounded::add)
            }
        };
        found.map_or_else(nothing, Bounded::taylor)
    }

    /// Bounds on the value of a state in SI units; without a range if there are none.
    pub fn enclose_state(&self, id: StateId, vertices: &[Taylor]) -> Taylor {
        let state = &self.states()[id.index()];
        vertices[state.node.index()] * Taylor::constant(state.value(1.0))
    }

    /// Bounds on a report, or on the quantity of a report over time, in SI units, after
    /// [`Network::place_bounds`] and [`Network::place_heat_bounds`]; `None` if there are none.
    pub fn enclose_report(&self, id: ReportId, inputs: &mut InputBounds) -> Option<Taylor> {
        enclose(&self.reports()[id.index()].value, inputs)
    }

    /// The same of the margin of a limit.
    pub fn enclose_margin(&self, id: LimitId, inputs: &mut InputBounds) -> Option<Taylor> {
        let sides = [self.enclose_side((id, 0), inputs)?, self.enclose_side((id, 1), inputs)?];
        let [low, high] = self.ordered(id, sides);
        Some(high - low)
    }

    /// The same of one of the sides of a limit (0: `of`, 1: its bound).
    pub fn enclose_side(
        &self,
        (id, side): (LimitId, usize),
        inputs: &mut InputBounds,
    ) -> Option<Taylor> {
        enclose(self.limits()[id.index()].sides()[side], inputs)
    }
}

fn enclose(value: &Value, inputs: &mut InputBounds) -> Option<Taylor> {
    let bounds = inputs.value(value)?;
    bounds.range().map(|_| bounds)
}

/// No bounds.
fn nothing() -> Taylor {
    Taylor::between(&[[f64::NEG_INFINITY, f64::INFINITY]])
}
