//! What a network remembers: where a run can begin and where it ended, to the last digit.

use lptn_assembly::ThermalSystem;
use lptn_network::InputError;

use crate::unfold::carried;

/// The state of a network at one time: everything that its future depends on beside its inputs.
///
/// For every node with capacity it holds what an integrator carries, in K, in the order of
/// [`ThermalSystem::states`]: the temperature of a node with a constant capacity; for one whose
/// capacity depends on its temperature `T0 + H / C0` with H the heat content over that at the start
/// of the network in J, T0 the temperature and C0 the capacity there, since a node that melts at
/// one temperature is not told by that temperature. The state at the end of a run also knows which
/// of several solutions each massless node has.
#[derive(Clone, Debug, PartialEq)]
pub struct State {
    carried: Vec<f64>,
    /// Temperatures in K of the massless nodes that may have several solutions; empty where they
    /// are not known, or do not.
    stood: Vec<f64>,
}

impl State {
    /// The start that the network itself says.
    pub fn initial(system: &ThermalSystem) -> Self {
        Self::of_carried(system.initial())
    }

    /// The state in which every node has the temperature given for it in K, in the order of the
    /// network's nodes; those of massless nodes are not looked at. A node that melts at one
    /// temperature has that as a solid.
    ///
    /// # Errors
    /// [`InputError`] for a temperature outside the range for which a capacity is known.
    pub fn of_temperatures(system: &ThermalSystem, nodes: &[f64]) -> Result<Self, InputError> {
        let one = |(i, id): (usize, &lptn_network::NodeId)| {
            let temperature = nodes.get(id.index()).copied().unwrap_or(f64::NAN);
            carried(system, i, temperature)
        };
        let carried: Result<Vec<f64>, InputError> =
            system.states().iter().enumerate().map(one).collect();
        Ok(Self::of_carried(carried?))
    }

    /// What is carried for every state in K, see [`State`].
    pub fn carried(&self) -> &[f64] {
        &self.carried
    }

    /// A state that was saved: what was carried, and where massless nodes of several solutions
    /// stood, as [`State::carried`] and [`State::stood`] gave them.
    pub fn restored(carried: Vec<f64>, stood: Vec<f64>) -> Self {
        Self { carried, stood }
    }

    pub(crate) fn of_carried(carried: Vec<f64>) -> Self {
        Self { carried, stood: Vec::new() }
    }

    /// The same with massless nodes of several solutions at these temperatures in K.
    pub(crate) fn standing(self, stood: Vec<f64>) -> Self {
        Self { stood, ..self }
    }

    /// Temperatures in K of massless nodes of several solutions; may be empty.
    pub fn stood(&self) -> &[f64] {
        &self.stood
    }

    /// Temperature in K of one of the states; `None` where its heat content is one that it cannot
    /// have.
    pub fn temperature(&self, system: &ThermalSystem, state: usize) -> Option<f64> {
        let id = *system.states().get(state)?;
        let carried = *self.carried.get(state)?;
        let Some(curve) = system.network().enthalpy(id) else { return Some(carried) };
        let heat = system.capacity()[state] * (carried - system.network().initial(id));
        curve.temperature(heat).map(|content| content.temperature)
    }

    /// True if it can be a state of this system: the number of its values is right, all are finite.
    pub fn fits(&self, system: &ThermalSystem) -> bool {
        let (states, massless) = (system.states().len(), system.algebraic().len());
        self.carried.len() == states
            && (self.stood.is_empty() || self.stood.len() == massless)
            && self.carried.iter().chain(&self.stood).all(|y| y.is_finite())
    }

    /// The largest difference to another state of the same network, in K.
    pub fn distance(&self, other: &Self) -> f64 {
        let pairs = self.carried.iter().zip(&other.carried);
        pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    }
}
