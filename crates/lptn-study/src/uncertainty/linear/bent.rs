//! Results that straight lines get wrong.
//!
//! The slope of a peak or a margin is that of one moment and of one side of a kink. If another
//! moment, or the other side, becomes the worst within the deviations, the slope says nothing.

use lptn_network::{LimitId, NodeId};
use lptn_solve::Proceed;
use lptn_units::statistics::NORMAL_95;

use crate::uncertainty::answer::{Answer, AnswerOf};
use crate::uncertainty::input::{Inputs, Uncertain};
use crate::uncertainty::joint::{NodesRead, directions};
use crate::uncertainty::result::Bent;
use crate::uncertainty::sample::{NoSample, Sample};
use crate::uncertainty::task::UncertaintyTask;

/// The part of the half width of a band by which runs may go beyond the band.
const BEYOND: f64 = 0.5;

/// Changes below this part of a result, or this many tolerances in K, are the error of the runs.
const ERROR: f64 = 1e-6;
const TOLERANCES: f64 = 20.0;

/// A move of parameters, each by this part of its standard deviation.
type Direction = [(Uncertain, f64)];

/// The numbers of the runs at both ends of a direction, which may have none.
type Ends = [Option<Vec<f64>>; 2];

impl UncertaintyTask<'_> {
    /// Runs the network with each parameter, and those correlated to it, at both ends of its 95 %,
    /// then with all of them along the directions in which results change most; gives the
    /// results that change by more than straight lines say. A run without a result counts for
    /// nothing.
    pub(super) fn bent(&self, inputs: &Inputs, answers: &[Answer]) -> Vec<Bent> {
        let read = NodesRead::of(self.network, self.network.limits());
        let wide = self.with_nodes(&read.nodes);
        let questions = wide.questions();
        let place = |of: AnswerOf| questions.iter().position(|other| *other == of).unwrap_or(0);
        let places: Vec<usize> = answers.iter().map(|answer| place(answer.of)).collect();
        let alone: Vec<Ends> = inputs.directions().iter().map(|one| wide.ends(one)).collect();
        let changes = |question: usize| alone.iter().map(|ends| change(ends, question)).collect();
        let of_limit = |(limit, nodes): (LimitId, &Vec<usize>)| {
            let nodes = nodes.iter().map(|&i| read.nodes[i]);
            let of_nodes = nodes.flat_map(|node| [AnswerOf::End(node), AnswerOf::Max(node)]);
            std::iter::once(AnswerOf::Margin(limit))
                .chain(of_nodes)
                .map(|of| changes(place(of)))
                .collect()
        };
        let limits = self.network.limit_ids().zip(&read.of_limits);
        let groups: Vec<Vec<Vec<f64>>> = limits.map(of_limit).collect();
        let joint: Vec<Ends> =
            directions(&groups).iter().map(|one| wide.ends(&inputs.along(one))).collect();
        let found = answers.iter().zip(places).filter_map(|(answer, place)| {
            let beyond = |ends: &Ends| beyond(ends, place, answer.value);
            let squares = |side: usize| alone.iter().map(|e| beyond(e)[side].powi(2)).sum::<f64>();
            let alone = squares(0).max(squares(1)).sqrt();
            let together = joint.iter().flat_map(beyond).fold(alone, f64::max);
            self.judged(answer, together)
        });
        found.collect()
    }

    fn judged(&self, answer: &Answer, found: f64) -> Option<Bent> {
        let linear = NORMAL_95 * answer.deviation.value;
        let error = (ERROR * answer.value.abs()).max(TOLERANCES * self.run.tolerance());
        let bent = found - linear > BEYOND * linear + error;
        bent.then_some(Bent { of: answer.of, linear, found })
    }

    /// The same task, which asks for these nodes too.
    fn with_nodes(&self, more: &[NodeId]) -> UncertaintyTask<'_> {
        let mut nodes = [&self.nodes, more].concat();
        nodes.sort_unstable();
        nodes.dedup();
        let (parameters, run) = (self.parameters.clone(), self.run.clone());
        UncertaintyTask { network: self.network, parameters, run, nodes }
    }

    fn ends(&self, direction: &Direction) -> Ends {
        [-NORMAL_95, NORMAL_95].map(|score| Some(self.moved(direction, score).ok()?.answers))
    }

    /// The run with the parameters of a direction at this normal number.
    fn moved(&self, direction: &Direction, score: f64) -> Result<Sample, NoSample> {
        let mut parameters = self.parameters.clone();
        for (input, part) in direction {
            let to = input.at(score * part);
            parameters.set(input.parameter, to);
        }
        self.sample(&parameters, false, &|| Proceed::Continue)
    }
}

/// Half the change of a number from one end to the other; 0 if there is none.
fn change(ends: &Ends, place: usize) -> f64 {
    let [Some(down), Some(up)] = ends else { return 0.0 };
    let half = 0.5 * (up[place] - down[place]);
    if half.is_finite() { half } else { 0.0 }
}

/// The largest changes of a number from its value, down and up, both positive.
fn beyond(ends: &Ends, place: usize, value: f64) -> [f64; 2] {
    let changes = ends.iter().flatten().map(|numbers| numbers[place] - value);
    let finite = changes.filter(|change| change.is_finite());
    finite.fold([0.0_f64; 2], |[down, up], by| [down.max(-by), up.max(by)])
}
