//! A few nodes at a port.

use crate::definition::{Definition, Pair};
use crate::fewer::fewer;
use lptn_network::{Cauer, Foster};

use crate::step::StepResponse;
use crate::worst::WorstCase;

/// A few nodes that represent a network at a port.
#[derive(Clone, Debug, PartialEq)]
pub struct Nodes {
    /// The definition of the capacity, if it is one node.
    pub definition: Option<Definition>,
    /// The nodes, one per rung. The resistance before the first is 0 unless the port is massless;
    /// then it is the immediate response.
    pub ladder: Cauer,
    /// Their step response.
    pub foster: Foster,
    /// The largest error over every load.
    pub worst: WorstCase,
}

impl Nodes {
    /// Number of nodes with capacity.
    pub fn count(&self) -> usize {
        self.ladder.rungs.len()
    }

    /// One node, with the capacity of a pair; `None` for a capacity of 0.
    pub fn of_pair(step: &StepResponse, pair: &Pair) -> Option<Self> {
        let (resistance, capacity) = (step.resistance, pair.capacity);
        let ladder = Cauer::new(vec![(capacity, resistance)], 0.0).ok()?;
        let foster = Foster::new(0.0, &[(resistance, resistance * capacity)]).ok()?;
        let worst = WorstCase::new(step, &foster);
        Some(Self { definition: Some(pair.definition), ladder, foster, worst })
    }

    /// `count` nodes in a row, with the smallest error over every load that was found; fewer if the
    /// port sees no more. `None` if an element is beyond the range of a number.
    pub fn of(step: &StepResponse, count: usize) -> Option<Self> {
        let terms = fewer(step, count)?;
        // rounding must not move the steady state
        let sum: f64 = terms.iter().map(|term| term.0).sum();
        let factor = (step.resistance - step.direct) / sum;
        let terms: Vec<(f64, f64)> = terms.iter().map(|(r, tau)| (r * factor, *tau)).collect();
        let foster = Foster::new(step.direct, &terms).ok()?;
        let ladder = foster.cauer().ok()?;
        let worst = WorstCase::new(step, &foster);
        Some(Self { definition: None, ladder, foster, worst })
    }

    /// The smallest number of nodes, at most `most`, whose error over every load is at most
    /// `limit` in K for each W of the largest power; one node is the best of the pairs. Also
    /// returns the smaller numbers of nodes that were not enough, the smallest first.
    pub fn enough(
        step: &StepResponse,
        pairs: &[Pair],
        (limit, most): (f64, usize),
    ) -> (Option<Self>, Vec<Self>) {
        let mut short: Vec<Self> = Vec::new();
        for count in 1..=most {
            let found = match count {
                1 => Self::best_pair(step, pairs),
                _ => Self::of(step, count),
            };
            let Some(found) = found else { continue };
            if found.worst.most() <= limit {
                return (Some(found), short);
            }
            if short.last().is_some_and(|last| last.count() == found.count()) {
                break;
            }
            short.push(found);
        }
        (None, short)
    }

    fn best_pair(step: &StepResponse, pairs: &[Pair]) -> Option<Self> {
        let all = pairs.iter().filter_map(|pair| Self::of_pair(step, pair));
        all.min_by(|a, b| a.worst.most().total_cmp(&b.worst.most()))
    }
}
