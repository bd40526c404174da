//! A run with its sensitivities at the rows and at the highest temperatures.

use lptn_analysis::Trusted;
use lptn_network::{NodeId, ParameterId};
use lptn_solve::{Gradient, Proceed, SensitiveRun, Solution, on_both_sides};
use lptn_units::statistics::NORMAL_95;

use crate::uncertainty::error::UncertaintyError;
use crate::uncertainty::input::{Inputs, Uncertain};
use crate::uncertainty::result::Bands;
use crate::uncertainty::task::UncertaintyTask;

/// Two times that are nearer than this part of the run are the same.
const SAME: f64 = 1e-9;

/// A run with sensitivities by every uncertain parameter.
pub(super) struct Line<'a> {
    pub(super) inputs: &'a Inputs,
    pub(super) run: Trusted<SensitiveRun>,
    /// The rows as places among the times of the run.
    rows: Vec<usize>,
}

impl<'a> Line<'a> {
    /// The run at its rows and at the times at which `solution` saw the nodes highest, on both
    /// sides of those.
    pub(super) fn new(
        task: &UncertaintyTask<'_>,
        inputs: &'a Inputs,
        solution: &Solution,
    ) -> Result<Self, UncertaintyError> {
        let rows = task.times()?;
        let peaks = solution.watched().iter().map(|seen| seen.peak.1);
        let peaks = on_both_sides(peaks, (task.run.start(), task.run.stop()));
        let times = joined(&rows, peaks.into_iter());
        let places = rows.iter().map(|row| times.partition_point(|time| time < row)).collect();
        let run = task.watched().at(times);
        let run = run.with_slopes((task.network, &ids(inputs)), &|_| Proceed::Continue)?;
        Ok(Self { inputs, run, rows: places })
    }

    /// Change of the temperature of a node in K with one standard deviation more of each parameter,
    /// at a time of the run.
    pub(super) fn effects(&self, node: NodeId, place: usize) -> Vec<f64> {
        let effect = |input: &Uncertain| self.slopes(input, node)[place] * input.deviation();
        self.inputs.iter().map(effect).collect()
    }

    fn slopes(&self, input: &Uncertain, node: NodeId) -> Vec<f64> {
        self.run
            .sensitivity(input.parameter, node)
            .expect("every node that is asked for is recorded")
    }

    /// The place of the last time.
    pub(super) fn end(&self) -> usize {
        self.run.solution.times().len() - 1
    }

    /// The same for its maximum: as the temperature changes at the time of the maximum, or as the
    /// maxima of the runs do if these are compared, for a maximum may be where something jumps.
    pub(super) fn effects_on_maximum(&self, node: NodeId) -> Vec<f64> {
        let of_runs =
            |input: &Uncertain| Some(self.run.peak(input.parameter, node)? * input.deviation());
        let all: Option<Vec<f64>> = self.inputs.iter().map(of_runs).collect();
        all.unwrap_or_else(|| self.effects(node, self.highest(node)))
    }

    /// The place at which a node is hottest, the first of several.
    fn highest(&self, node: NodeId) -> usize {
        let temperatures = self.run.solution.temperature(node).unwrap_or_default();
        let places = (0..temperatures.len()).rev();
        places.max_by(|&a, &b| temperatures[a].total_cmp(&temperatures[b])).unwrap_or(0)
    }

    /// The band of a node at the rows.
    pub(super) fn bands(&self, node: NodeId) -> Bands {
        let temperatures = self.run.solution.temperature(node).unwrap_or_default();
        let value: Vec<f64> = self.rows.iter().map(|&place| temperatures[place]).collect();
        let slopes: Vec<Vec<f64>> =
            self.inputs.iter().map(|input| self.slopes(input, node)).collect();
        let deviation = |&place: &usize| {
            let each = self.inputs.iter().zip(&slopes);
            let effects: Vec<f64> =
                each.map(|(input, slopes)| slopes[place] * input.deviation()).collect();
            self.inputs.variance(&effects).max(0.0).sqrt()
        };
        let deviation: Vec<f64> = self.rows.iter().map(deviation).collect();
        let side = |sign: f64| {
            value.iter().zip(&deviation).map(|(v, d)| v + sign * NORMAL_95 * d).collect()
        };
        Bands { node, low: side(-1.0), median: None, high: side(1.0), value, deviation }
    }

    /// Why the sensitivities are differences of runs, if they are.
    pub(super) fn differences(&self) -> Option<String> {
        match &self.run.gradient {
            Gradient::Exact => None,
            Gradient::Differences(why) => Some(why.to_string()),
        }
    }
}

/// The parameters of some inputs.
pub(super) fn ids(inputs: &[Uncertain]) -> Vec<ParameterId> {
    inputs.iter().map(|input| input.parameter).collect()
}

/// The times with those of `more` that lie between them, ascending.
pub(super) fn joined(times: &[f64], more: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut all = times.to_vec();
    let same =
        SAME * (times.last().copied().unwrap_or(0.0) - times.first().copied().unwrap_or(0.0));
    for time in more {
        let place = all.partition_point(|known| *known < time);
        let (before, after) = (place.checked_sub(1).map(|i| all[i]), all.get(place).copied());
        if let (Some(before), Some(after)) = (before, after)
            && time - before > same
            && after - time > same
        {
            all.insert(place, time);
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::joined;

    #[test]
    fn times_are_joined_in_their_order_and_once() {
        let more = [5.0, 2.5, 0.0, 10.0, 10.0 - 1e-9, 2.5, 11.0, -1.0];
        assert_eq!(joined(&[0.0, 5.0, 10.0], more.into_iter()), [0.0, 2.5, 5.0, 10.0]);
    }
}
