//! Pipes with plug flow: the fluid that enters at one end leaves at the other one when the content
//! of the pipe has followed it.
//!
//! A pipe is a massless node with a stream into it and one out of it. A steady state needs no more:
//! the fluid leaves as it enters. In a run the temperature of the node is that of the fluid that
//! leaves the pipe, which entered earlier. A state counts the fluid that passed, so that the flow
//! may be any expression, and may reverse.

use crate::id::{ConductorId, NodeId, SourceId, StateId};
use crate::value::Value;

/// A pipe, as a netlist writes it.
#[derive(Clone, Debug)]
pub struct PipePart {
    /// Its node, which has the temperature of the fluid that leaves.
    pub node: NodeId,
    /// The state that counts the fluid that passed, in kg, m^3 or J/K.
    pub passed: StateId,
    /// Its content in SI units of that state.
    pub content: Value,
    /// The temperature of its content at the start in K.
    pub start: Value,
}

/// A pipe for one set of parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pipe {
    /// Its node, which has the temperature of the fluid that leaves.
    pub node: NodeId,
    /// The state that counts the fluid that passed.
    pub passed: StateId,
    /// The source of that state: its rate is the flow.
    pub flow: SourceId,
    /// Its content in SI units of that state.
    pub content: f64,
    /// The temperature of its content at the start in K.
    pub start: f64,
    /// The stream into it, and the stream out of it.
    pub streams: [ConductorId; 2],
}
