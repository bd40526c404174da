//! Derivatives of a network's values by its parameters at fixed temperatures: the right-hand sides
//! of sensitivities.
//!
//! Each value is evaluated on dual numbers by the same code that evaluates it on numbers, the
//! parameters being the variables. Only values that depend on one of them are evaluated at all.

mod content;
mod heat;
mod influence;
mod refusal;

use crate::evaluation::{PASS, Slope};
use crate::id::{BoundaryId, ConductorId, ParameterId, SignalId, SourceId};
use crate::network::Network;
use crate::slot;
use content::Content;
use influence::Influence;

pub use refusal::NoTangents;

/// Derivatives of a network's heat flows and heat contents by some of its parameters.
///
/// All results are in SI units per SI unit of the parameter, in blocks, one for each parameter in
/// the order in which they were requested. Evaluating allocates nothing.
#[derive(Clone, Debug)]
pub struct Tangents {
    parameters: Vec<ParameterId>,
    passes: Vec<Pass>,
    conductors: Vec<ConductorId>,
    sources: Vec<SourceId>,
    boundaries: Vec<BoundaryId>,
    /// Signals that are expressions of the parameters.
    signals: Vec<SignalId>,
    contents: Vec<Content>,
}

/// Up to [`PASS`] parameters that are followed together.
#[derive(Clone, Debug)]
struct Pass {
    slots: Vec<Slope>,
    stack: Vec<Slope>,
    /// Temperatures of all boundaries in K.
    boundaries: Vec<Slope>,
}

impl Network {
    /// Prepares derivatives by these parameters. One that is an expression of others counts as a
    /// separate variable if it is among them.
    ///
    /// # Errors
    /// [`NoTangents`] if a derivative by them does not exist everywhere or cannot be computed.
    pub fn tangents(&self, parameters: &[ParameterId]) -> Result<Tangents, NoTangents> {
        let influence = Influence::new(self, parameters);
        refusal::check(self, &influence)?;
        let chunks = parameters.chunks(PASS);
        let mut passes: Vec<Pass> = chunks.map(|chunk| Pass::new(self, chunk)).collect();
        let contents = content::all_of(self, &influence, &mut passes)?;
        Ok(Tangents {
            parameters: parameters.to_vec(),
            passes,
            conductors: self.conductor_ids().filter(|id| influence.conductor(*id)).collect(),
            sources: self.source_ids().filter(|id| influence.source(*id)).collect(),
            boundaries: self.boundary_ids().filter(|id| influence.boundary(*id)).collect(),
            signals: self.signal_ids().filter(|id| influence.signal(*id)).collect(),
            contents,
        })
    }
}

impl Tangents {
    /// The parameters that derivatives are taken by, in this order.
    pub fn parameters(&self) -> &[ParameterId] {
        &self.parameters
    }

    /// For each pass the number of its first parameter and how many it follows.
    fn spans(&self) -> impl Iterator<Item = (usize, usize)> + use<> {
        let count = self.parameters.len();
        (0..count).step_by(PASS).map(move |first| (first, PASS.min(count - first)))
    }
}

impl Pass {
    /// The slots with the parameters in them, the expressions among these evaluated in their order.
    fn new(network: &Network, variables: &[ParameterId]) -> Self {
        let layout = &network.parts.layout;
        let mut slots = vec![Slope::constant(f64::NAN); layout.len()];
        slots[slot::TIME as usize] = Slope::constant(0.0);
        slots[slot::SEGMENT as usize] = Slope::constant(0.0);
        let mut stack = Vec::new();
        for id in network.parameter_ids() {
            let number = network.parameter_value(id);
            let own = variables.iter().position(|variable| *variable == id);
            let value = &network.parameters()[id.index()].value;
            let dual = match own {
                Some(index) => Slope::variable(number, index),
                None if network.numbers.given[id.index()] => Slope::constant(number),
                None => value.on(&slots, &mut stack).unwrap_or(Slope::constant(number)),
            };
            slots[layout.parameter(id) as usize] = dual;
        }
        Self {
            slots,
            stack,
            boundaries: vec![Slope::constant(f64::NAN); network.boundaries().len()],
        }
    }
}
