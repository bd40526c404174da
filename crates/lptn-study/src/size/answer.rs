//! The task of sizing, and the answer to it.

use lptn_netlist::Goal;
use lptn_network::{NodeId, ParameterId};

use crate::size::judge::{Demand, Judged};

/// A task of sizing.
#[derive(Clone, Debug)]
pub struct SizeTask<'a> {
    /// The requirements.
    pub demand: Demand<'a>,
    /// The parameter to be sized.
    pub parameter: ParameterId,
    /// The least and the largest value it may take, in SI units.
    pub range: (f64, f64),
    /// The direction in which values that keep every requirement get better.
    pub goal: Goal,
}

/// The network at one value of the parameter.
#[derive(Clone, Debug)]
pub struct Trial {
    /// The value in SI units.
    pub value: f64,
    /// The results there.
    pub judged: Judged,
}

/// The kind of answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// A requirement binds: beyond the value it is broken.
    Bound,
    /// A requirement is broken beyond an edge, at which the network goes to another state.
    Edge,
    /// The best end of the range keeps every requirement already.
    BestEnd,
    /// No value that was evaluated keeps every requirement.
    Infeasible,
}

/// The result of sizing.
#[derive(Clone, Debug)]
pub struct Sizing {
    /// The kind of answer.
    pub verdict: Verdict,
    /// The value with its margins; if it is infeasible, the value that comes closest.
    pub trial: Trial,
    /// The requirement that is broken most, or is the closest to it, in the measure of
    /// [`Shortfall`](crate::Shortfall).
    pub closest: usize,
    /// The value in SI units at which a requirement breaks again on the far side of the answer:
    /// more, or for a maximum less, is not always better.
    pub breaks_again: Option<f64>,
    /// The edge at which the network goes to another state, if the verdict is [`Verdict::Edge`].
    pub edge: Option<Edge>,
    /// Change of the closest requirement's margin, in SI units, for 1 % more of the parameter;
    /// `None` for a temperature, which has no percentage, for zero, and near an edge.
    pub sensitivity: Option<f64>,
    /// Error of the value in SI units, as runs are computed to a tolerance: their error over the
    /// change of the closest margin with the value. `None` in steady state, whose margins are exact
    /// to rounding, if nothing binds, and if that change is not known.
    pub error: Option<f64>,
    /// The value that the Norton equivalent seen from the changed path predicted, in SI units; only
    /// in steady state.
    pub first_guess: Option<f64>,
    /// Number of networks that were solved.
    pub solved: usize,
    /// The points over the whole range that were evaluated first, the best end of it first.
    pub looked_at: Vec<Trial>,
}

impl Sizing {
    /// True if the value keeps every requirement.
    pub fn feasible(&self) -> bool {
        self.verdict != Verdict::Infeasible
    }

    /// The margin of the closest requirement in SI units; negative by as much as it is broken.
    pub fn margin(&self) -> f64 {
        self.trial.judged.margins[self.closest]
    }
}

/// An edge: a value at which a network goes to another state.
#[derive(Clone, Debug)]
pub struct Edge {
    /// The last value of the parameter on the side of the answer, in SI units.
    pub value: f64,
    /// The margin in SI units, just beyond it, of the requirement that is broken most there.
    pub beyond: f64,
    /// Index of that requirement among the margins.
    pub broken: usize,
    /// In steady state the node whose temperature differs most, with its temperatures in K on the
    /// side of the answer and beyond.
    pub states: Option<(NodeId, [f64; 2])>,
}
