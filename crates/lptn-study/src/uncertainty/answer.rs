//! One number of a run, its uncertainty, and the contributions to it.

use std::borrow::Cow;

use lptn_network::{Item, LimitId, Network, NodeId};

use crate::uncertainty::estimate::Estimate;

/// A number that a run answers with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AnswerOf {
    /// The temperature of a node at the stop, in K.
    End(NodeId),
    /// Its highest temperature, between the rows too, in K.
    Max(NodeId),
    /// The least margin of a limit in SI units of its quantity, a difference in K for temperatures;
    /// negative if it is broken.
    Margin(LimitId),
}

impl AnswerOf {
    /// `steel.T end`, `steel.T max`, `seals margin`.
    pub fn name(self, network: &Network) -> String {
        let name = |item: Item| -> Cow<'_, str> { network.name_of(item) };
        match self {
            Self::End(id) => format!("{}.T end", name(Item::Node(id))),
            Self::Max(id) => format!("{}.T max", name(Item::Node(id))),
            Self::Margin(id) => format!("{} margin", name(Item::Limit(id))),
        }
    }
}

/// The contribution of one parameter to an answer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contribution {
    /// The parameter, as its place in
    /// [`Uncertainty::inputs`](crate::uncertainty::Uncertainty::inputs).
    pub input: usize,
    /// Change of the answer, in its unit, with one standard deviation more of the parameter and the
    /// others fixed: exact for a small deviation if the method is linear, else the mean slope over
    /// the samples.
    pub effect: f64,
    /// The share of the answer's variance that this parameter makes by itself, its first-order
    /// index. For correlated parameters no such share is defined; then it is the effect times the
    /// covariance of the answer and the parameter (J. W. Pratt, Proc. 2nd Int. Tampere Conf.
    /// Statistics (1987) 245), which may be negative: shares add up to the part of the variance
    /// that straight lines explain.
    pub share: Estimate,
    /// The share that it makes by itself and together with others, its total index; `None` if the
    /// method is linear, which has no interactions, and if parameters are correlated.
    pub total: Option<Estimate>,
}

impl Contribution {
    /// The weight in the ranking: the total share, or the share if there is no total.
    pub fn weight(&self) -> f64 {
        self.total.unwrap_or(self.share).value
    }
}

/// One answer of a run with its uncertainty.
#[derive(Clone, Debug)]
pub struct Answer {
    /// The number of the run.
    pub of: AnswerOf,
    /// Its value in SI units with every parameter at its own.
    pub value: f64,
    /// One standard deviation, in K for temperatures.
    pub deviation: Estimate,
    /// 2.5 % of the answers are below this.
    pub low: Estimate,
    /// Half of the answers are below this; `None` if the method is linear: it is the value.
    pub median: Option<Estimate>,
    /// 2.5 % of the answers are above this.
    pub high: Estimate,
    /// The share of answers below zero: for a margin the probability that the limit is broken.
    pub below_zero: Estimate,
    /// Every uncertain parameter, the one that matters most first.
    pub ranking: Vec<Contribution>,
}

impl Answer {
    /// Sorts the parameters by weight; equal ones stay in the order of the network.
    pub(crate) fn sorted(mut self) -> Self {
        self.ranking.sort_by(|a, b| b.weight().total_cmp(&a.weight()));
        self
    }
}
