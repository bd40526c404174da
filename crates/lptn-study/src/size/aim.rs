//! What the best design has least or most of.

use lptn_netlist::Goal;
use lptn_network::Value;

/// What the best design has least or most of.
#[derive(Clone, Copy, Debug)]
pub struct Aim<'a> {
    /// The quantity: an expression of parameters, or of results where `of_results` says so.
    pub value: &'a Value,
    /// Whether the best design has least or most of it.
    pub goal: Goal,
    /// Whether it reads temperatures or heat flows of the steady state.
    pub of_results: bool,
}

impl Aim<'_> {
    /// What is sought as something of which less is better.
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
