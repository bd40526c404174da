//! The objective of the best design.

use lptn_netlist::Goal;
use lptn_network::Value;

/// The quantity that the best design minimises or maximises.
#[derive(Clone, Copy, Debug)]
pub struct Aim<'a> {
    /// The quantity: an expression of parameters, or of results if `of_results` is true.
    pub value: &'a Value,
    /// The direction: least or most of it.
    pub goal: Goal,
    /// True if it reads temperatures or heat flows of the steady state.
    pub of_results: bool,
}

impl Aim<'_> {
    /// The objective as a cost, of which less is better.
    pub(crate) fn cost(self, objective: f64) -> f64 {
        match self.goal {
            Goal::Minimise => objective,
            Goal::Maximise => -objective,
        }
    }

    /// The worse one of two.
    pub(crate) fn worse(self, a: f64, b: f64) -> f64 {
        if self.cost(a) > self.cost(b) { a } else { b }
    }
}
