//! A network that is disturbed near one of its states, as the integrator sees it.

use lptn_assembly::ThermalSystem;
use lptn_integrate::{OdeSystem, Pattern, Retry};

use super::error::NearError;
use crate::balance::Books;
use crate::error::TransientError;
use crate::heat::Heat;
use crate::snapshot::Snapshot;
use crate::state::State;
use crate::stop_reason::StopReason;
use crate::times::just_after;
use crate::unsolved::Unsolved;

/// The full network with inputs and switches fixed, less the heat that its nodes store in the state
/// itself: undisturbed, it stays there.
pub(crate) struct Disturbed<'a> {
    heat: Heat<'a>,
    /// Heat that each undisturbed state receives in W.
    stored: Vec<f64>,
    /// Temperatures of all nodes there in K.
    at: &'a [f64],
}

impl<'a> Disturbed<'a> {
    /// The system, and the integrator's variables if its states are warmer than in `state` by
    /// `rises` in K.
    pub(crate) fn new(
        system: &'a ThermalSystem,
        state: &'a Snapshot,
        rises: &[f64],
    ) -> Result<(Self, Vec<f64>), NearError> {
        let unsolved = |error| TransientError::Start(Unsolved::new(system, error));
        let (time, segment) = (state.time, just_after(state.time));
        let mut heat = Heat::new(system, segment, Books::default()).map_err(unsolved)?;
        heat.held = Some((time, segment));
        if system.network().has_events() {
            heat.set_positions(&state.positions);
        }
        let rest = State::of_temperatures(system, &state.temperatures)?;
        let mut stored = vec![0.0; rest.carried().len()];
        heat.flow_at(time, rest.carried(), &mut stored)?;
        let mut warmer = state.temperatures.clone();
        system.states().iter().zip(rises).for_each(|(id, rise)| warmer[id.index()] += rise);
        let start = State::of_temperatures(system, &warmer)?.carried().to_vec();
        Ok((Self { heat, stored, at: &state.temperatures }, start))
    }

    /// Rises of all nodes over the state, in K.
    pub(crate) fn rises(&mut self, y: &[f64]) -> Result<Vec<f64>, StopReason> {
        let system = self.heat.system();
        let (_, work) = self.heat.temperatures(0.0, y)?;
        let now = system.node_temperatures(work).iter();
        Ok(now.zip(self.at).map(|(now, at)| now - at).collect())
    }
}

impl OdeSystem for Disturbed<'_> {
    fn size(&self) -> usize {
        self.heat.size()
    }

    fn mass(&self) -> &[f64] {
        self.heat.mass()
    }

    fn slope(&self) -> Option<&[f64]> {
        self.heat.slope()
    }

    fn flow(&mut self, time: f64, y: &[f64], flow: &mut [f64]) -> Result<(), Retry> {
        self.heat.flow(time, y, flow)?;
        flow.iter_mut().zip(&self.stored).for_each(|(flow, stored)| *flow -= stored);
        Ok(())
    }

    fn pattern(&self) -> &Pattern {
        self.heat.pattern()
    }

    fn symmetric(&self) -> bool {
        self.heat.symmetric()
    }

    fn leave_symmetry(&mut self) {
        self.heat.leave_symmetry();
    }

    fn jacobian(&mut self, time: f64, y: &[f64], values: &mut [f64]) -> Result<(), Retry> {
        self.heat.jacobian(time, y, values)
    }

    fn jacobian_is_constant(&self) -> bool {
        self.heat.jacobian_is_constant()
    }
}
