//! Limits over a step: their least margins, and when they are first broken.

use lptn_network::{Bends, Evaluation};

use crate::cuts::{Levels, passing, points};
use crate::hidden::Hidden;
use crate::interval::{AGREEMENT, At, Interval};
use crate::limit_seen::{LimitSeen, Point};
use crate::quadrature::{Halvings, ROUNDING};
use crate::resolve::{Judged, Resolved, resolve};
use crate::stop_reason::StopReason;
use crate::watch::{is_same, put_in, top};

/// Number of parabolas that approach the valley of a margin after the first.
const REFINEMENTS: usize = 12;

/// A time is found to this share of the gap between two points.
const ENOUGH: f64 = 1e-15;

/// Data of limits, to evaluate a step.
#[derive(Default)]
pub(crate) struct LimitLook {
    /// Their bends, and the values that are constant during the evaluation.
    bends: Bends,
    pub(crate) slots: Vec<f64>,
    pub(crate) seen: Vec<LimitSeen>,
    /// Sizes of the compared sides.
    pub(crate) sizes: Vec<f64>,
    halvings: Halvings,
    /// For each limit the least margin that parts which are not resolved may hide; minus infinity if
    /// they may hide an earlier break.
    reaches: Vec<f64>,
}

impl LimitLook {
    pub(crate) fn new(seen: Vec<LimitSeen>, bends: Bends) -> Self {
        let reaches = vec![f64::INFINITY; seen.len()];
        Self { bends, seen, reaches, ..Self::default() }
    }

    /// A segment begins at the state of `scope`.
    pub(crate) fn stand(&mut self, scope: &mut Evaluation) {
        self.bends.stand(scope);
    }

    /// Evaluates a step.
    pub(crate) fn step(&mut self, step: Interval, at: &mut At<'_>) -> Result<(), StopReason> {
        let levels = Levels::new(self.seen.len(), &self.bends);
        let mut hidden = Hidden::new((&self.bends, &self.slots), self.seen.len());
        let mut judge = |interval: &Interval| Judged {
            wanting: self.wanting(interval),
            hides: hidden.wanting(interval),
        };
        let whole = step.clone();
        let parts = resolve(step, levels, self.halvings.0, (at, &mut judge))?;
        self.halvings.after(parts.iter().all(|part| part.told));
        let open = parts.iter().any(|part| part.open);
        let most = if open { hidden.width(&whole) } else { 0.0 };
        for Resolved { interval, open, .. } in &parts {
            let hides = *open && hidden.wanting(interval) > 0.0;
            for (limit, seen) in self.seen.iter_mut().enumerate() {
                if *open {
                    let most = hides.then_some(f64::min(most, self.sizes[limit]));
                    let found = seen.leave_open(&interval.of(limit), (self.sizes[limit], most));
                    let reach = found.unwrap_or(f64::INFINITY);
                    let breaks = reach < 0.0 && seen.broken_at.is_none();
                    let reach = if breaks { f64::NEG_INFINITY } else { reach };
                    self.reaches[limit] = self.reaches[limit].min(reach);
                }
                of_limit(interval, (limit, self.sizes[limit]), seen, at)?;
            }
        }
        Ok(())
    }

    /// The results. A part that cannot hide a smaller margin than the least of the whole run leaves
    /// nothing open.
    pub(crate) fn into_seen(self) -> Vec<LimitSeen> {
        let settled = |(seen, reach): (LimitSeen, f64)| {
            let open = if reach < seen.margin { seen.open } else { 0.0 };
            LimitSeen { open, ..seen }
        };
        self.seen.into_iter().zip(self.reaches).map(settled).collect()
    }

    /// Difference of the two rules of an interval for the worst limit that counts, over the allowed
    /// one; 0 if they agree.
    fn wanting(&self, interval: &Interval) -> f64 {
        let length = interval.to - interval.from;
        let integrals = interval.integrals(self.seen.len());
        let one = |(limit, [_, apart, absolute]): (usize, [f64; 3])| {
            let allowed = (AGREEMENT * absolute).max(ROUNDING * self.sizes[limit] * length);
            let open = apart.abs() > allowed && counts(&self.seen[limit], &interval.of(limit));
            if open { apart.abs() / allowed } else { 0.0 }
        };
        integrals.into_iter().enumerate().map(one).fold(0.0, f64::max)
    }
}

/// A margin that changes by less than this share of its sides, in a part of a step that is not
/// resolved any further, is rounding.
const ROUNDED: f64 = 1e-6;

impl LimitSeen {
    /// Records that a part of a step with these margins, of sides of this size, is not resolved any
    /// further, and the change that may hide in it. The least margin that it may have then, if that
    /// counts.
    fn leave_open(&mut self, margins: &[f64], (size, hides): (f64, Option<f64>)) -> Option<f64> {
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for &margin in margins {
            (low, high) = (low.min(margin), high.max(margin));
        }
        let by = hides.unwrap_or(high - low);
        let open = by > ROUNDED * size && (hides.is_some() || counts(self, margins));
        open.then(|| {
            self.open = self.open.max(by);
            low - by
        })
    }
}

/// True if a margin with these values may become the least one up to now, or the first below zero. No
/// curve that its points resolve leaves their range by as much again.
fn counts(seen: &LimitSeen, values: &[f64]) -> bool {
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    for &value in values {
        (low, high) = (low.min(value), high.max(value));
    }
    let reach = low - (high - low);
    reach < seen.margin || (seen.broken_at.is_none() && reach < 0.0)
}

/// Takes in one limit over an interval.
fn of_limit(
    interval: &Interval,
    (limit, size): (usize, f64),
    seen: &mut LimitSeen,
    at: &mut At<'_>,
) -> Result<(), StopReason> {
    if !counts(seen, &interval.of(limit)) {
        return Ok(());
    }
    let mut points = points(interval, limit).to_vec();
    for _ in 0..REFINEMENTS {
        let Some(time) = valley(&points, seen, ROUNDING * size) else { break };
        put_in(&mut points, (time, at(time)?[limit]));
    }
    let breaks = points.windows(2).find(|pair| pair[0].1 >= 0.0 && pair[1].1 < 0.0);
    if let (Some(pair), None) = (breaks, seen.broken_at) {
        let (gap, between) = ([pair[0], pair[1]], pair[1].0 - pair[0].0);
        let guess = pair[0].0 + between * (pair[0].1 / (pair[0].1 - pair[1].1));
        let (time, values) = passing(at, (limit, 0.0), (gap, guess), ENOUGH * between)?;
        seen.take_in((time, values[limit].min(-f64::MIN_POSITIVE)));
    }
    points.into_iter().for_each(|point| seen.take_in(point));
    Ok(())
}

/// The time of the deepest valley that the points promise, if it may be the least margin up to now or
/// the first below zero.
fn valley(points: &[Point], seen: &LimitSeen, rounding: f64) -> Option<f64> {
    let ends = (points[0].0, points[points.len() - 1].0);
    let turned = |&(time, margin): &Point| (time, -margin);
    let tops = points.windows(3).filter_map(|w| top([turned(&w[0]), turned(&w[1]), turned(&w[2])]));
    let known = |time: f64| points.iter().any(|point| is_same(point.0, time, ends));
    let (height, time) =
        tops.filter(|(_, time)| !known(*time)).max_by(|a, b| a.0.total_cmp(&b.0))?;
    let least = points.iter().map(|point| point.1).fold(seen.margin, f64::min);
    let deeper = -height < least - rounding;
    let first = seen.broken_at.is_none() && least >= 0.0 && height > 0.0;
    (deeper || first).then_some(time)
}

#[cfg(test)]
mod tests;
