//! The task of sizing, and the answer to it.

use lptn_netlist::Goal;
use lptn_network::{NodeId, ParameterId};

use crate::size::judge::{Demand, Judged};

/// What is to be sized.
#[derive(Clone, Debug)]
pub struct SizeTask<'a> {
    /// What has to be kept.
    pub demand: Demand<'a>,
    /// The parameter whose value is sought.
    pub parameter: ParameterId,
    /// The least and the largest value it may take, in SI units.
    pub range: (f64, f64),
    /// Which of several values that do is the best.
    pub goal: Goal,
}

/// The network at one value of the parameter.
#[derive(Clone, Debug)]
pub struct Trial {
    /// The value in SI units.
    pub value: f64,
    /// What came of it.
    pub judged: Judged,
}

/// How an answer came about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// A requirement binds: beyond the value it is broken.
    Bound,
    /// A requirement is broken behind an edge, at which the network goes elsewhere.
    Edge,
    /// The best end of the range keeps every requirement already.
    BestEnd,
    /// No value that was looked at keeps every requirement.
    Infeasible,
}

/// What came of sizing.
#[derive(Clone, Debug)]
pub struct Sizing {
    /// How the answer came about.
    pub verdict: Verdict,
    /// The value with its margins; where it is infeasible, the value that comes closest.
    pub trial: Trial,
    /// The requirement that is closest to being broken, relative to how much it varies over the
    /// range.
    pub closest: usize,
    /// Where a requirement breaks again on the far side of the value, in SI units: more is not
    /// always better.
    pub breaks_again: Option<f64>,
    /// The edge at which the network goes elsewhere, if the verdict is [`Verdict::Edge`].
    pub edge: Option<Edge>,
    /// Change of the closest requirement's margin, in SI units, for 1 % more of the parameter;
    /// `None` for a temperature, of which there is no percentage, for zero, and near an edge.
    pub sensitivity: Option<f64>,
    /// By how much the value may be off, in SI units, since runs are computed to a tolerance: their
    /// error over what the closest margin changes with the value. `None` in steady state, where
    /// margins are exact to rounding, where nothing binds, and where that change is not known.
    pub error: Option<f64>,
    /// The value that the Norton equivalent seen from the changed path predicted, in SI units; only
    /// in steady state.
    pub first_guess: Option<f64>,
    /// How many networks were solved.
    pub solved: usize,
    /// The places over the whole range that were looked at first, the best end of it first.
    pub looked_at: Vec<Trial>,
}

impl Sizing {
    /// Whether the value keeps every requirement.
    pub fn feasible(&self) -> bool {
        self.verdict != Verdict::Infeasible
    }

    /// The margin of the closest requirement in SI units; negative by as much as it is broken.
    pub fn margin(&self) -> f64 {
        self.trial.judged.margins[self.closest]
    }
}

/// Where a network goes elsewhere.
#[derive(Clone, Debug)]
pub struct Edge {
    /// The last value of the parameter on the side of the answer, in SI units.
    pub value: f64,
    /// The margin in SI units, just beyond it, of the requirement that is broken most there.
    pub beyond: f64,
    /// That requirement, by its position among the margins.
    pub broken: usize,
    /// In steady state the node whose temperature differs most, with its temperatures in K on the
    /// side of the answer and beyond.
    pub states: Option<(NodeId, [f64; 2])>,
}
