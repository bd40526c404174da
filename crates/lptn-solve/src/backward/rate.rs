//! The rate of a margin, or of the distance of a position from its threshold, along a run.

use super::error::BackwardError;
use super::moment::Moment;
use super::{Aim, Asked};
use crate::bracket::Bracket;
use crate::events::EventKind;
use crate::margin::Point;
use crate::stencil::slope_below;

/// The change of the fastest temperature in K over a step of time for a derivative by it.
const KELVIN: f64 = 0.01;

/// The parts of a stretch or of a step of the run in such a step.
const PARTS: f64 = 8.0;

/// Steps below a time from which its derivative is read.
const BELOW: f64 = 4.0;

/// Steps of the run to both sides in which an extremum is looked for.
const REACH: [f64; 3] = [1.0, 4.0, 16.0];

/// Margins that differ by less than this part of them are the same.
const ROUNDING: f64 = 1e-9;

/// A number along a run.
#[derive(Clone, Copy)]
pub(super) enum Read {
    Margin,
    Excess(EventKind),
}

impl Asked<'_> {
    /// The rate in 1/s along a stretch at a time in s, from the temperatures just before, at its start
    /// from those after.
    pub(super) fn rate(
        &self,
        moment: &mut Moment<'_>,
        (stretch, time): (usize, f64),
        read: Read,
    ) -> Result<f64, BackwardError> {
        let known = &self.trajectory.stretches[stretch];
        let (from, to) = known.span();
        let point = self.point(moment, (stretch, time))?;
        let (rates, state) = (moment.rates()?, moment.state().to_vec());
        let fastest = rates.iter().fold(0.0_f64, |most, rate| most.max(rate.abs()));
        let longest = (to - from).min(known.step(time)) / PARTS;
        let by = if fastest > 0.0 { longest.min(KELVIN / fastest) } else { longest };
        // before the start there is nothing to read
        let by = if time - BELOW * by < from { -by } else { by };
        let found = slope_below(by, |change| {
            let moved: Vec<f64> =
                state.iter().zip(&rates).map(|(y, rate)| y + rate * change).collect();
            let at = (time + change, point.at.1);
            moment.go(at, &moved)?;
            match read {
                Read::Excess(kind) => moment.excess(kind),
                Read::Margin => {
                    let nodes = moment.nodes().to_vec();
                    Ok(self.margin.at(&Point { at, nodes, ..point.clone() })?)
                }
            }
        })?;
        Ok(found.unwrap_or(f64::NAN))
    }

    /// The moment near another one at which the margin is level. A value is flat around its extremum,
    /// so that the run knows the moment only to the root of its tolerance; the rate crosses zero.
    /// The same moment if the margin is least at an end or in a bend.
    pub(super) fn level(&self, moment: &mut Moment<'_>, aim: Aim) -> Result<Aim, BackwardError> {
        let Aim { stretch, time } = aim;
        let (from, to) = self.trajectory.stretches[stretch].span();
        let step = self.trajectory.stretches[stretch].step(time);
        let mut rate = |time| self.rate(moment, (stretch, time), Read::Margin);
        for reach in REACH {
            let ends = [(time - reach * step).max(from), (time + reach * step).min(to)];
            let [before, after] = [(ends[0], rate(ends[0])?), (ends[1], rate(ends[1])?)];
            if before.1 < 0.0 && after.1 > 0.0 {
                let mut bracket = Bracket::new([before, after], time, 0.0);
                let mut level = time;
                while let Some(next) = bracket.next() {
                    level = next;
                    bracket.put(next, rate(next)?);
                }
                let level = Aim { stretch, time: level };
                return Ok(if self.rises(moment, [aim, level])? { aim } else { level });
            }
        }
        Ok(aim)
    }

    /// True if the margin is larger at the second moment by more than rounding.
    fn rises(&self, moment: &mut Moment<'_>, aims: [Aim; 2]) -> Result<bool, BackwardError> {
        let mut margins = [0.0; 2];
        for (margin, aim) in margins.iter_mut().zip(aims) {
            *margin = self.margin.at(&self.point(moment, (aim.stretch, aim.time))?)?;
        }
        let [before, after] = margins;
        Ok(after > before + ROUNDING * before.abs().max(self.solution.tolerance))
    }
}
