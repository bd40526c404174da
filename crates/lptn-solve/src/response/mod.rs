//! Response of a linear network to one input: an oscillation at a frequency, or a step from 0 to 1.

mod carried;
mod frequency;
mod settled;
mod step;

use lptn_assembly::ThermalSystem;
use lptn_integrate::FactorError;
use lptn_network::{BoundaryId, InputError, NodeId, SourceId, list_of_names};

pub use frequency::FrequencyResponse;
pub use settled::settled_rises;
pub use step::StepAnswer;

use crate::exact::ExactError;
use crate::linearised::{Linearised, LinearisedError};
use crate::modes::ModesError;

/// The input of a response.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Drive {
    /// Heat into a node in W: responses are in K/W.
    Node(NodeId),
    /// The heat of a source in W, to all that it heats: responses are in K/W.
    Source(SourceId),
    /// The temperature of a boundary in K: responses are in K/K.
    Boundary(BoundaryId),
}

lptn_units::errors! {
/// Reason why a response is not known.
#[derive(Clone, Debug)]
pub enum ResponseError {
    /// The network cannot be linearised.
    Linearised => LinearisedError;
    /// An element has no value next to the state.
    Input => InputError;
    /// Its modes cannot be computed.
    Modes => ModesError;
    /// Heat enters nodes from which no path leads to a boundary: it never settles.
    NoGround { names: Vec<String> } = "response::no_ground",
        format!("no path leads to a boundary from {}", list_of_names(names)),
        help "add a path to a boundary, or ask at frequencies above 0: without one, a constant heat \
            never leads to a rise that stays";
    /// A network near a state that grows by itself: nothing settles.
    Grows = "response::grows", "this state is unstable: disturbances grow by themselves",
        help "choose another operating point; `lptn modes` shows what grows";
    /// The numbers fail.
    Factorization(error: FactorError) = "response::singular", error, source error,
        help crate::exact::MERGE, class lptn_units::Class::Numbers;
}
}

impl From<FactorError> for ResponseError {
    fn from(error: FactorError) -> Self {
        Self::Factorization(error)
    }
}

impl From<ExactError> for ResponseError {
    fn from(error: ExactError) -> Self {
        Self::Modes(error.into())
    }
}

/// Direct effect of a unit of an input.
struct Effect {
    /// Heat into each node in W.
    heat: Vec<f64>,
    /// Change of each boundary in K.
    boundaries: Vec<f64>,
    /// Heat into each unknown in W, with that of massless nodes handed on.
    flow: Vec<f64>,
}

/// Half the change of a boundary in K over which the slope of nonlinear elements is taken.
const NEAR: f64 = 0.01;

impl Effect {
    fn of(linear: &Linearised<'_>, drive: Drive) -> Result<Self, ResponseError> {
        let system = linear.system();
        let network = system.network();
        let mut heat = vec![0.0; network.nodes().len()];
        let mut boundaries = vec![0.0; network.boundaries().len()];
        match drive {
            Drive::Node(node) => heat[node.index()] = 1.0,
            Drive::Source(source) => network.sources()[source.index()]
                .into
                .iter()
                .for_each(|(node, share)| heat[node.index()] += share),
            Drive::Boundary(boundary) => boundaries[boundary.index()] = 1.0,
        }
        let flow = match drive {
            Drive::Boundary(boundary) if !system.is_linear() => of_boundary(linear, boundary)?,
            _ => handed_on(system, &heat, &boundaries),
        };
        Ok(Self { heat, boundaries, flow })
    }

    /// The effect of heat into each node in W.
    fn of_heat(system: &ThermalSystem, heat: Vec<f64>) -> Self {
        let boundaries = vec![0.0; system.network().boundaries().len()];
        let flow = handed_on(system, &heat, &boundaries);
        Self { heat, boundaries, flow }
    }

    /// Temperatures of all nodes that follow from those of the unknowns and `share` of the input.
    fn recovered(&self, system: &ThermalSystem, unknowns: &[f64], share: f64) -> Vec<f64> {
        let scaled = |values: &[f64]| values.iter().map(|x| share * x).collect::<Vec<f64>>();
        let mut work = system.workspace();
        system.apply(&mut work, &scaled(&self.heat), &scaled(&self.boundaries));
        system.recover(&mut work, unknowns);
        system.node_temperatures(&work).to_vec()
    }
}

/// Heat into the unknowns, with that of massless nodes handed on.
fn handed_on(system: &ThermalSystem, heat: &[f64], boundaries: &[f64]) -> Vec<f64> {
    let mut work = system.workspace();
    system.apply(&mut work, heat, boundaries);
    let mut flow = vec![0.0; system.unknowns().len()];
    system.linear_flow(&work, &vec![0.0; flow.len()], &mut flow);
    flow
}

/// Heat into the unknowns per K of a boundary, by a difference to both sides of it.
fn of_boundary(linear: &Linearised<'_>, of: BoundaryId) -> Result<Vec<f64>, ResponseError> {
    let system = linear.system();
    let near = if system.is_proportional() { 0.5 } else { NEAR };
    let moved = |by: f64| {
        let (mut work, at) = linear.workspace();
        let mut boundaries = system.boundary_temperatures(&work).to_vec();
        boundaries[of.index()] += by;
        system.apply(&mut work, &vec![0.0; system.network().nodes().len()], &boundaries);
        let mut flow = vec![0.0; at.len()];
        system.flow(&mut work, at, &mut flow).map(|()| flow)
    };
    let (above, below) = (moved(near)?, moved(-near)?);
    Ok(above.iter().zip(&below).map(|(a, b)| (a - b) / (2.0 * near)).collect())
}

/// Refuses heat into nodes that no path joins to a boundary.
fn grounded(system: &ThermalSystem, effect: &Effect) -> Result<(), ResponseError> {
    let network = system.network();
    for island in network.ungrounded() {
        if island.iter().any(|id| effect.heat[id.index()] != 0.0) {
            let names = island.iter().map(|id| network.nodes()[id.index()].name.clone()).collect();
            return Err(ResponseError::NoGround { names });
        }
    }
    Ok(())
}
