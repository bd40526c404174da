//! Checks of states for one set of parameters.

use lptn_laws::Range;

use super::Work;
use crate::error::BuildErrorKind;
use crate::id::{Field, Item, NodeId, StateId};
use crate::parts::Parts;
use crate::parts::state::State;

/// The least time between samples in s: a run has as many parts as samples.
const SHORTEST: f64 = 1e-9;

impl Work<'_> {
    /// The time between samples of each state in s; `None` for one that is not sampled.
    pub(crate) fn sampling(&mut self) -> Vec<Option<f64>> {
        let states = self.parts.states.iter().enumerate();
        let one = |(i, state): (usize, &State)| {
            let item = Item::State(StateId::from_len(i));
            let every = state.every.as_ref()?;
            Some(self.constant(item, Field::Every, every, Range::Positive).max(SHORTEST))
        };
        states.map(one).collect()
    }

    /// Checks that each state has a rate and a start inside its bounds, which are returned.
    pub(crate) fn check_states(&mut self) -> Vec<[f64; 2]> {
        let states = self.parts.states.iter().enumerate();
        states.map(|(i, state)| self.bounds_of(StateId::from_len(i), state)).collect()
    }

    fn bounds_of(&mut self, id: StateId, state: &State) -> [f64; 2] {
        let Some((bounds, start)) = self.bounds_and_start(id, state) else {
            self.error(Item::State(id), BuildErrorKind::NoRate { state: id });
            return [f64::NAN; 2];
        };
        self.check_state(id, bounds, start);
        bounds
    }

    fn bounds_and_start(&mut self, id: StateId, state: &State) -> Option<([f64; 2], f64)> {
        let (item, start) = (Item::State(id), state.start.as_ref()?);
        let start = self.constant(item, Field::Start, start, Range::Finite);
        let fields = [(Field::Least, f64::NEG_INFINITY), (Field::Most, f64::INFINITY)];
        let mut bounds = [0.0; 2];
        for ((bound, value), (field, free)) in bounds.iter_mut().zip(&state.bounds).zip(fields) {
            let given = value.as_ref();
            *bound = given.map_or(free, |value| self.constant(item, field, value, Range::Finite));
        }
        Some((bounds, start))
    }

    fn check_state(&mut self, state: StateId, bounds: [f64; 2], start: f64) {
        let beyond = [start < bounds[0], start > bounds[1]].into_iter().position(|beyond| beyond);
        let kind = match beyond {
            _ if bounds[0] >= bounds[1] => BuildErrorKind::StateBounds { state, bounds },
            Some(side) => BuildErrorKind::StateStart { state, start, bound: bounds[side] },
            None => return,
        };
        self.error(Item::State(state), kind);
    }
}

impl Parts {
    /// The range of the temperature of a node at the start: that of a state may be negative.
    pub(crate) fn range_at_start(&self, node: usize) -> Range {
        match self.state_at(NodeId::from_len(node)) {
            Some(id) if !self.states[id.index()].ty.absolute => Range::Finite,
            _ => Range::Temperature,
        }
    }
}
