//! State of a network: the start or end of a run, to the last digit.

use lptn_assembly::ThermalSystem;
use lptn_network::InputError;

use crate::pipe::Content;
use crate::unfold::carried;

/// The state of a network at one time: all that its future depends on in addition to its inputs.
///
/// For every node with capacity it contains the integrator's variable, in K, in the order of
/// [`ThermalSystem::states`]. For a constant capacity that is the temperature. For a capacity that
/// depends on temperature it is `T0 + H / C0` with H the heat content over that at the start of the
/// network in J, T0 the temperature and C0 the capacity there. The temperature of a node that melts
/// at one temperature does not determine it. An end state also contains the solution of each
/// massless node with several.
#[derive(Clone, Debug, PartialEq)]
pub struct State {
    carried: Vec<f64>,
    /// Temperatures in K of the massless nodes that may have several solutions; empty if they are
    /// not known, or do not.
    stood: Vec<f64>,
    /// The content of each pipe; empty if it is that of the start of the network.
    contents: Vec<Content>,
}

impl State {
    /// The network's own start.
    pub fn initial(system: &ThermalSystem) -> Self {
        Self::of_carried(system.initial())
    }

    /// The state in which every node has the temperature given for it in K, in the order of the
    /// network's nodes; those of massless nodes are ignored. A node that melts at one temperature
    /// has that as a solid.
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

    /// The variable of every state in K, see [`State`].
    pub fn carried(&self) -> &[f64] {
        &self.carried
    }

    /// A saved state: the values of [`State::carried`] and [`State::stood`].
    pub fn restored(carried: Vec<f64>, stood: Vec<f64>) -> Self {
        Self { stood, ..Self::of_carried(carried) }
    }

    pub(crate) fn of_carried(carried: Vec<f64>) -> Self {
        Self { carried, stood: Vec::new(), contents: Vec::new() }
    }

    /// The same with massless nodes of several solutions at these temperatures in K.
    pub(crate) fn standing(self, stood: Vec<f64>) -> Self {
        Self { stood, ..self }
    }

    /// The same with this content of each pipe.
    pub(crate) fn filled(self, contents: Vec<Content>) -> Self {
        Self { contents, ..self }
    }

    /// The content of each pipe; may be empty.
    pub(crate) fn contents(&self) -> &[Content] {
        &self.contents
    }

    /// Temperatures in K of massless nodes of several solutions; may be empty.
    pub fn stood(&self) -> &[f64] {
        &self.stood
    }

    /// Temperature in K of one of the states; `None` if its heat content is impossible.
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
            && self.knows_contents(system)
            && self.carried.iter().chain(&self.stood).all(|y| y.is_finite())
    }

    /// True if it has the content of each pipe, or no fluid has passed.
    fn knows_contents(&self, system: &ThermalSystem) -> bool {
        let (network, states) = (system.network(), system.states());
        let fresh = |pipe: &lptn_network::Pipe| {
            let node = network.counter_of(pipe);
            let state = states.iter().position(|id| *id == node);
            state.is_some_and(|i| self.carried[i].to_bits() == network.initial(node).to_bits())
        };
        let pipes = network.pipes();
        self.contents.len() == pipes.len() || pipes.iter().all(fresh)
    }

    /// The largest difference to another state of the same network, in K.
    pub fn distance(&self, other: &Self) -> f64 {
        let pairs = self.carried.iter().zip(&other.carried);
        pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    }
}
