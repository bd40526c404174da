//! Results with their uncertainty.

use lptn_network::NodeId;

use crate::uncertainty::answer::{Answer, AnswerOf};
use crate::uncertainty::input::Inputs;
use crate::uncertainty::lost::Lost;

/// The method by which the uncertainty of the results was found.
#[derive(Clone, Debug, PartialEq)]
pub enum UncertaintyMethod {
    /// From the sensitivities of one run.
    Linear {
        /// Why they are differences of runs, if they are not exact.
        differences: Option<String>,
        /// The results that straight lines get wrong.
        bent: Vec<Bent>,
    },
    /// From runs at scrambled Sobol points.
    Sobol {
        /// Base points: each gives two runs for the bands and, if no parameters are correlated, one
        /// for each parameter.
        samples: usize,
        /// The seed of the scrambling.
        seed: u32,
        /// All runs that were made.
        runs: usize,
        /// Runs without a result: the bands are those of the others.
        lost: Vec<Lost>,
    },
}

/// A result that runs take further than straight lines do.
#[derive(Clone, Debug, PartialEq)]
pub struct Bent {
    /// The result.
    pub of: AnswerOf,
    /// Half the band of 95 % of straight lines, in SI units.
    pub linear: f64,
    /// The largest change in SI units, down or up: if each parameter alone is at the 2.5 % or 97.5 %
    /// end of its own distribution, the changes added as squares, and if several move together to a
    /// point that is as far from the centre.
    pub found: f64,
}

/// The temperature of a node over the rows, in K, with its band of 95 %.
#[derive(Clone, Debug, PartialEq)]
pub struct Bands {
    /// The node whose temperature it is.
    pub node: NodeId,
    /// With every parameter at its own value.
    pub value: Vec<f64>,
    /// One standard deviation.
    pub deviation: Vec<f64>,
    /// 2.5 % of the answers are below this.
    pub low: Vec<f64>,
    /// Half of them are below this; `None` if the method is linear.
    pub median: Option<Vec<f64>>,
    /// 2.5 % of them are above this.
    pub high: Vec<f64>,
}

/// The results of a run with their uncertainty.
#[derive(Clone, Debug)]
pub struct Uncertainty {
    /// The method.
    pub method: UncertaintyMethod,
    /// The parameters that are not certain, in the order of the network.
    pub inputs: Inputs,
    /// The time of each row in s.
    pub times: Vec<f64>,
    /// The bands of the requested nodes.
    pub bands: Vec<Bands>,
    /// For each of these nodes its end and its maximum, then the margin of every limit.
    pub answers: Vec<Answer>,
}
