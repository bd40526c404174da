//! Limits in results: their least margins, and when each was first broken.
//!
//! A limit is judged to the error of the run: ten times the tolerance, or 1e-9 K in steady state. A
//! limit that is broken at the start is exact.

use lptn_assembly::{ThermalSystem, Workspace};
use lptn_network::{Bends, Evaluation, InputError, Item, LimitId, Network};
use lptn_units::Dimension;

use crate::events::{Event, EventKind};
use crate::limit_look::LimitLook;
use crate::limit_seen::{LimitSeen, Point};
use crate::reading::Reading;

/// A temperature that passes its limit by less than this, in K, does so by rounding: a temperature
/// of 300 K has steps of 6e-14 K, and the refined steady state of a network is good to a few
/// hundred of them.
const ROUNDING: f64 = 1e-9;

/// All limits of a network during a run.
pub(crate) struct LimitWatch<'a> {
    network: &'a Network,
    reading: Reading<'a>,
    /// Bends of their sides.
    bends: Bends,
    look: LimitLook,
    /// For each limit the point at the start.
    first: Vec<Option<Point>>,
    /// The last time with the margins, and the quantities that determine their bends.
    last: (f64, Vec<f64>),
    /// For each limit the largest absolute value of a side: its margin is rounded by a share of it.
    sizes: Vec<f64>,
    /// For each limit true if it could be judged at some moment.
    judged: Vec<bool>,
}

impl<'a> LimitWatch<'a> {
    pub(crate) fn new(system: &'a ThermalSystem) -> Self {
        let network = system.network();
        let nothing = |limit| LimitSeen {
            limit,
            margin: f64::INFINITY,
            worst_at: f64::NAN,
            broken_at: None,
            open: 0.0,
        };
        let count = network.limits().len();
        let bends = network.bends(network.limit_ids().map(Item::Limit));
        let seen = network.limit_ids().map(nothing).collect();
        let of_mean: Vec<bool> = network.limits().iter().map(|limit| limit.of_mean).collect();
        Self {
            network,
            reading: Reading::new(system),
            look: LimitLook::new(seen, &of_mean, bends.clone()),
            bends,
            first: vec![None; count],
            last: (f64::NAN, Vec::new()),
            sizes: vec![0.0; count],
            judged: vec![false; count],
        }
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.sizes.is_empty()
    }

    /// Begins a segment: earlier points do not belong to a curve that goes on.
    pub(crate) fn enter(&mut self, work: &mut Workspace, at: (f64, f64)) -> Result<(), InputError> {
        let margins = self.values(work, at)?;
        for ((seen, first), &margin) in self.look.seen.iter_mut().zip(&mut self.first).zip(&margins)
        {
            first.get_or_insert((at.0, margin));
            seen.take_in((at.0, margin));
        }
        self.last = (at.0, margins);
        Ok(())
    }

    /// The margin of every limit at the state of the workspace, then the quantities that determine
    /// their bends; `at` is the time and a time inside the segment.
    pub(crate) fn values(
        &mut self,
        work: &mut Workspace,
        at: (f64, f64),
    ) -> Result<Vec<f64>, InputError> {
        if self.is_empty() {
            return Ok(Vec::new());
        }
        self.reading.place(work, at)?;
        let mut values = Vec::with_capacity(self.sizes.len() + self.bends.levels().len());
        for (id, size) in self.network.limit_ids().zip(&mut self.sizes) {
            let [low, high] = self.network.limit_sides(id, &mut self.reading.scope)?;
            *size = size.max(low.abs()).max(high.abs());
            values.push(high - low);
            let judged = &mut self.judged[id.index()];
            *judged = *judged || self.network.is_judged(id, &mut self.reading.scope)?;
        }
        self.bends.read(&mut self.reading.scope, &mut values);
        Ok(values)
    }

    /// The last values that were handed over or begun with.
    pub(crate) fn last(&self) -> Vec<f64> {
        self.last.1.clone()
    }

    /// Lends the data of the limits, to evaluate a step.
    pub(crate) fn take_look(&mut self) -> LimitLook {
        let mut look = std::mem::take(&mut self.look);
        look.sizes.clone_from(&self.sizes);
        look.slots = self.bends.slots(&mut self.reading.scope);
        look
    }

    /// Takes the data back; the step ends with these values.
    pub(crate) fn looked(&mut self, look: LimitLook, end: (f64, Vec<f64>)) {
        (self.look, self.last) = (look, end);
    }

    /// The results. A worst point that the tolerance in K cannot distinguish from the start or end
    /// is put there. A limit that it cannot distinguish from being just reached is not broken; a
    /// start that breaks it is exact. A mean is known at the end, and broken there.
    pub(crate) fn into_seen(mut self, tolerance: f64) -> Vec<LimitSeen> {
        let (end, margins) = self.last;
        let mut all = std::mem::take(&mut self.look.seen);
        let points = self.first.iter().zip(margins.into_iter().map(|margin| (end, margin)));
        for (i, (seen, (first, last))) in all.iter_mut().zip(points).enumerate() {
            let temperature = is_temperature(self.network, seen.limit);
            let length = end - first.map_or(end, |(time, _)| time);
            let mut exact = first.is_some_and(|(_, margin)| margin < -ROUNDING);
            if let Some(integral) = self.look.integral(i).filter(|_| length > 0.0) {
                exact = false;
                *seen = seen.of_mean((end, integral / length));
            } else if temperature {
                let same = |point: &&Point| point.1 - seen.margin <= 10.0 * tolerance;
                let end = first.iter().chain([&last]).find(same);
                seen.worst_at = end.map_or(seen.worst_at, |(time, _)| *time);
            }
            let reached = -ROUNDING.max(10.0 * tolerance)..0.0;
            if temperature && !exact && reached.contains(&seen.margin) {
                (seen.margin, seen.broken_at) = (0.0, None);
            }
        }
        for (seen, judged) in all.iter_mut().zip(&self.judged) {
            if !judged && seen.margin.is_finite() {
                (seen.margin, seen.broken_at) = (f64::NAN, None);
            }
        }
        all
    }
}

/// Events with the limits that were broken, in the order of time.
pub(crate) fn with_limits(mut events: Vec<Event>, limits: &[LimitSeen]) -> Vec<Event> {
    let broken = limits.iter().filter_map(|seen| Some((seen.limit, seen.broken_at?)));
    events.extend(broken.map(|(id, time)| Event::new(time, EventKind::Limit(id), true)));
    events.sort_by(|a, b| a.time.total_cmp(&b.time));
    events
}

fn is_temperature(network: &Network, id: LimitId) -> bool {
    network.limits()[id.index()].ty.dimension == Dimension::TEMPERATURE
}

/// The margin of each limit in SI units at the state of `scope`; zero if a temperature passes it by
/// rounding only, NaN if it cannot be [judged](Network::is_judged) there.
pub(crate) fn margins(network: &Network, scope: &mut Evaluation) -> Result<Vec<f64>, InputError> {
    let margin = |id: LimitId| {
        let margin = network.limit_margin(id, scope)?;
        if !network.is_judged(id, scope)? {
            return Ok(f64::NAN);
        }
        let rounding = is_temperature(network, id) && (-ROUNDING..0.0).contains(&margin);
        Ok(if rounding { 0.0 } else { margin })
    };
    network.limit_ids().map(margin).collect()
}
