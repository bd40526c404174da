//! Errors that the tolerance does not bound.

use lptn_network::NodeId;

use crate::events::Undecided;

/// Reason why the tolerance does not bound the error of a run: errors of the steps add up.
#[derive(Clone, Debug, PartialEq)]
pub enum Unbounded {
    /// These nodes lead to no boundary, so that errors do not decay.
    NoBoundary(Vec<NodeId>),
    /// The network remembers very many steps of inputs that keep exciting it.
    LongMemory {
        /// Number of these steps.
        steps: f64,
    },
    /// Heat grows faster with temperature than it is carried off, or is carried off better when a
    /// body is colder: errors grow with it.
    Grows {
        /// The largest growth factor.
        factor: f64,
    },
    /// Steps over a bend of something that reads a temperature could not be made short enough.
    Unresolved {
        /// The first such time in s.
        at: f64,
    },
    /// Something switches, or does not, by an error of the run.
    Switch(Undecided),
    /// Switch times depend on the solution: an error in the time of one switch does not decay but
    /// moves all that follow. There were more of them than the tolerance is tightened for.
    Switches {
        /// Number of switches.
        count: usize,
    },
}
