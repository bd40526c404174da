//! What a port sees, with a few nodes.

use crate::definition::{Definition, Pair};
use crate::fewer::fewer;
use crate::ladder::Ladder;
use crate::step::StepResponse;
use crate::worst::WorstCase;

/// A few nodes that stand for a network at a port.
#[derive(Clone, Debug, PartialEq)]
pub struct Nodes {
    /// The definition of the capacity, where it is one node.
    pub definition: Option<Definition>,
    /// Resistance in K/W between the port and the first node: 0 unless the port is massless, and
    /// then that which answers at once.
    pub direct: f64,
    /// The nodes.
    pub ladder: Ladder,
    /// The largest error over every load.
    pub worst: WorstCase,
    /// Time constants in s and resistances in K/W of the step response.
    pub terms: Vec<(f64, f64)>,
}

impl Nodes {
    /// Rise of the port in K at a time in s after a step of 1 W.
    pub fn rise(&self, time: f64) -> f64 {
        let parts = self.terms.iter().map(|(tau, r)| -r * (-time / tau).exp_m1());
        self.direct + parts.sum::<f64>()
    }

    /// How many nodes with capacity there are.
    pub fn count(&self) -> usize {
        self.ladder.capacity.len()
    }

    /// One node, with the capacity of a pair; `None` for a capacity of 0.
    pub fn of_pair(step: &StepResponse, pair: &Pair) -> Option<Self> {
        let (resistance, capacity) = (step.resistance, pair.capacity);
        let ladder = Ladder { capacity: vec![capacity], resistance: vec![resistance] };
        let terms = vec![(resistance * capacity, resistance)];
        let worst = WorstCase::new(step, &terms);
        let definition = Some(pair.definition);
        (capacity > 0.0).then_some(Self { definition, direct: 0.0, ladder, worst, terms })
    }

    /// So many nodes behind one another, with the smallest error over every load that was found;
    /// fewer where the port sees no more. `None` where rounding leaves an element that is not
    /// positive.
    pub fn of(step: &StepResponse, count: usize) -> Option<Self> {
        let terms = fewer(step, count)?;
        let sum = step.resistance - step.direct;
        let ladder = Ladder::new(&terms)?.with_sum(sum);
        let worst = WorstCase::new(step, &terms);
        Some(Self { definition: None, direct: step.direct, ladder, worst, terms })
    }

    /// The smallest number of nodes, at most `most`, whose error over every load is no larger than
    /// `limit` in K for each W of the largest power; one node is the best of the pairs. Beside it
    /// the numbers that were not enough, the smallest first.
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
