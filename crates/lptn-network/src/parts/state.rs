//! States of one's own: values of any unit with a given rate of change, such as the integral of a
//! controller, a state of charge or an amount of fuel.
//!
//! A state is a node without paths. Its rate, divided by its scale, is the heat of a source into a
//! capacity of 1 J/K, so 1 K of the node is one scale of the state. Integrators, steady states,
//! events and sensitivities then need nothing more, and one tolerance in K serves all. Its
//! node and source are not a part of the energy balance.
//!
//! A sampled state has its next value instead of a rate, from one sample to the next. Its rate is
//! the change over the time between samples, so that a steady state is one that repeats itself; a
//! run keeps its value between samples (`lptn-solve`, `samples.rs`).
//!
//! A state with a balance instead of a rate, such as the pressure of a junction, is a massless node
//! without paths: Newton's method finds the value at which its balance is zero.

use std::sync::Arc;

use lptn_units::{Expression, Type, Unit};

use crate::id::{Field, NodeId, SourceId};
use crate::value::Value;

/// A value with a rate of change.
#[derive(Clone, Debug)]
pub struct State {
    /// Its name, unique among parameters, signals, tables, controls, states and reports.
    pub name: String,
    /// Its type.
    pub ty: Type,
    /// Its change in SI units for 1 K of its node; 1 for a temperature.
    pub scale: f64,
    /// True if a balance determines it at every moment, false if it has a rate.
    pub balanced: bool,
    /// The time between samples in s; `None` if it is not sampled.
    pub every: Option<Value>,
    /// The node that contains it.
    pub node: NodeId,
    /// The source that changes it; `None` until
    /// [`NetworkBuilder::state_law`](crate::NetworkBuilder::state_law) sets it.
    pub source: Option<SourceId>,
    /// Its value at the start in SI units, an absolute temperature in K.
    pub start: Option<Value>,
    /// Its least and its greatest value in SI units, where its rate stops.
    pub bounds: [Option<Value>; 2],
    /// The unit in which it is shown; SI if there is none.
    pub unit: Option<Unit>,
    /// Its value as an expression of its node.
    pub(crate) meaning: Arc<Expression>,
}

impl State {
    /// Its value in SI units if its node is at `kelvin`.
    pub fn value(&self, kelvin: f64) -> f64 {
        self.scale * kelvin
    }

    /// The field that determines it.
    pub fn law(&self) -> Field {
        match (self.balanced, &self.every) {
            (true, _) => Field::Balance,
            (false, Some(_)) => Field::Next,
            (false, None) => Field::Rate,
        }
    }

    /// A usual size in SI units with this scale.
    pub fn size(&self) -> f64 {
        usual_size(self.balanced).exp2() * self.scale
    }

    /// The temperature of its node in K for a value in SI units.
    pub fn kelvin(&self, value: f64) -> f64 {
        value / self.scale
    }
}

/// The name of the node of a state in expressions: no name that can be written.
pub(crate) fn inner_name(state: &str) -> String {
    format!("{state}'")
}

/// The scale of a state of this usual size: a power of two, so that nothing is rounded, by which
/// the size is 512 K to 1024 K with a rate, and 64 K to 128 K with a balance.
///
/// With a tolerance of 1e-5 K the state has an error of about 1e-7 of its size. The integrator
/// limits the error of a step, and an integral collects those of the temperatures in its rate: steps
/// are allowed an eighth of it. The worst of 1000 random controllers was then off by 7 tolerances
/// instead of 31, for a third more steps.
pub(crate) fn scale_of(size: f64, ty: Type, balanced: bool) -> f64 {
    let usual = usual_size(balanced);
    if ty.is_temperature() { 1.0 } else { (size.log2().floor() - usual).exp2() }
}

/// Logarithm to base 2 of the least usual size in K of the node.
fn usual_size(balanced: bool) -> f64 {
    if balanced { 6.0 } else { 9.0 }
}
