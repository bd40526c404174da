//! Limits in results: how near each came to being broken, and when it first was.

use lptn_assembly::{ThermalSystem, Workspace};
use lptn_network::{Evaluation, InputError, LimitId, Network};
use lptn_units::Dimension;

use crate::events::{Event, EventKind};
use crate::reading::Reading;
use crate::watch::top;

/// How a limit fared in a run, between the rows too.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LimitSeen {
    /// The limit.
    pub limit: LimitId,
    /// Its least margin in SI units, positive if it was kept all the time; NaN if it could not be
    /// [judged](Network::is_judged) at any moment; see
    /// [`Network::limit_margin`]. Zero where a temperature passes it by less than ten times the
    /// tolerance, which is the error of a run.
    pub margin: f64,
    /// When that was, in s.
    pub worst_at: f64,
    /// When it was first broken, in s.
    pub broken_at: Option<f64>,
}

/// A temperature that passes its limit by less than this, in K, does so by rounding: a temperature
/// of 300 K has steps of 6e-14 K, and the refined steady state of a network is good to a few
/// hundred of them.
const ROUNDING: f64 = 1e-9;

/// A time in s with a margin.
type Point = (f64, f64);

/// All limits of a network during a run.
pub(crate) struct LimitWatch<'a> {
    network: &'a Network,
    reading: Reading<'a>,
    seen: Vec<LimitSeen>,
    /// For each limit the last point, then those of the present step.
    points: Vec<Vec<Point>>,
    /// For each limit the point at the start.
    first: Vec<Option<Point>>,
    /// For each limit whether it could be judged at some moment.
    judged: Vec<bool>,
}

impl<'a> LimitWatch<'a> {
    pub(crate) fn new(system: &'a ThermalSystem) -> Self {
        let network = system.network();
        let nothing =
            |limit| LimitSeen { limit, margin: f64::INFINITY, worst_at: f64::NAN, broken_at: None };
        Self {
            network,
            reading: Reading::new(system),
            seen: network.limit_ids().map(nothing).collect(),
            points: vec![Vec::new(); network.limits().len()],
            first: vec![None; network.limits().len()],
            judged: vec![false; network.limits().len()],
        }
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.seen.is_empty()
    }

    pub(crate) fn ids(&self) -> impl Iterator<Item = LimitId> + use<> {
        self.network.limit_ids()
    }

    /// Begins a segment: what comes before it is no part of a curve that goes on.
    pub(crate) fn enter(&mut self, work: &mut Workspace, at: (f64, f64)) -> Result<(), InputError> {
        self.points.iter_mut().for_each(Vec::clear);
        self.sample(work, at)?;
        for (first, points) in self.first.iter_mut().zip(&self.points) {
            *first = first.or(points.first().copied());
        }
        self.ids().for_each(|id| self.take_in(id, None));
        Ok(())
    }

    /// Adds a point for each limit; `at` is the time and a time inside the segment.
    pub(crate) fn sample(
        &mut self,
        work: &mut Workspace,
        at: (f64, f64),
    ) -> Result<(), InputError> {
        if self.is_empty() {
            return Ok(());
        }
        self.reading.place(work, at)?;
        for id in self.ids() {
            let margin = self.network.limit_margin(id, &mut self.reading.scope)?;
            self.points[id.index()].push((at.0, margin));
            if !self.judged[id.index()] {
                self.judged[id.index()] = self.network.is_judged(id, &mut self.reading.scope)?;
            }
        }
        Ok(())
    }

    /// The margin of one limit.
    pub(crate) fn margin(
        &mut self,
        id: LimitId,
        work: &mut Workspace,
        at: (f64, f64),
    ) -> Result<f64, InputError> {
        self.reading.place(work, at)?;
        self.network.limit_margin(id, &mut self.reading.scope)
    }

    /// The times between the points at which a limit may be nearest to being broken.
    pub(crate) fn valleys(&self, id: LimitId) -> Vec<f64> {
        let turned = |&(time, margin): &Point| (time, -margin);
        let found = self.points[id.index()]
            .windows(3)
            .filter_map(|w| top([turned(&w[0]), turned(&w[1]), turned(&w[2])]));
        found.map(|(_, time)| time).collect()
    }

    /// Adds a point between the others.
    pub(crate) fn insert(&mut self, id: LimitId, point: Point) {
        let points = &mut self.points[id.index()];
        let place = points.partition_point(|p| p.0 < point.0);
        points.insert(place, point);
    }

    /// Two points next to each other between which a limit is first broken.
    pub(crate) fn break_between(&self, id: LimitId) -> Option<(f64, f64)> {
        if self.seen[id.index()].broken_at.is_some() {
            return None;
        }
        let pair = self.points[id.index()].windows(2).find(|w| w[0].1 >= 0.0 && w[1].1 < 0.0)?;
        Some((pair[0].0, pair[1].0))
    }

    /// Takes the points into account and keeps the last; `broken_at` is where they go below zero.
    pub(crate) fn take_in(&mut self, id: LimitId, broken_at: Option<f64>) {
        let (seen, points) = (&mut self.seen[id.index()], &mut self.points[id.index()]);
        for &(time, margin) in points.iter() {
            if margin < seen.margin {
                (seen.margin, seen.worst_at) = (margin, time);
            }
        }
        let below = points.iter().find(|p| p.1 < 0.0).map(|p| p.0);
        seen.broken_at = seen.broken_at.or(broken_at).or(below);
        points.drain(..points.len().saturating_sub(1));
    }

    /// What was seen. A worst that the tolerance in K cannot tell from the start or from the end is
    /// there, and a limit that it cannot tell from being reached and not passed is not broken; a
    /// start that breaks it is exact.
    pub(crate) fn into_seen(mut self, tolerance: f64) -> Vec<LimitSeen> {
        let ends = self.first.iter().zip(&self.points);
        for (seen, (first, points)) in self.seen.iter_mut().zip(ends) {
            let temperature = is_temperature(self.network, seen.limit);
            let same = |point: &&Point| temperature && point.1 - seen.margin <= 10.0 * tolerance;
            if let Some(&(time, _)) = first.iter().chain(points.last()).find(same) {
                seen.worst_at = time;
            }
            let exact = first.is_some_and(|(_, margin)| margin < -ROUNDING);
            if temperature
                && !exact
                && seen.margin < 0.0
                && seen.margin >= -ROUNDING.max(10.0 * tolerance)
            {
                (seen.margin, seen.broken_at) = (0.0, None);
            }
        }
        for (seen, judged) in self.seen.iter_mut().zip(&self.judged) {
            if !judged && seen.margin.is_finite() {
                (seen.margin, seen.broken_at) = (f64::NAN, None);
            }
        }
        self.seen
    }
}

/// The margin of each limit in SI units where the nodes have these temperatures in K, with inputs
/// as they are at `time` in s and everything that switches as it stands at the start; see
/// [`Network::limit_margin`].
///
/// # Errors
/// [`InputError`] if an input or a limit has no value.
pub fn limit_margins_at(
    system: &ThermalSystem,
    time: f64,
    temperatures: &[f64],
) -> Result<Vec<f64>, InputError> {
    let mut work = system.workspace();
    system.read_inputs(&mut work, time, time)?;
    system.place(&mut work, temperatures);
    let mut reading = Reading::new(system);
    reading.place(&mut work, (time, time))?;
    let network = system.network();
    network.limit_ids().map(|id| network.limit_margin(id, &mut reading.scope)).collect()
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

/// The margin of each limit in SI units where `scope` stands, zero where a temperature passes it by
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
