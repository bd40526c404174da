//! Limits in results: their least margins, and when each was first broken.
//!
//! A limit is judged to the error of the run: ten times the tolerance, or 1e-9 K in steady state. A
//! limit that is broken at the start is exact.
//!
//! A limit of a number over time is a functional of the time history of its sides, which a window
//! over the whole run follows.

use lptn_assembly::{ThermalSystem, Workspace};
use lptn_network::{Bends, Evaluation, History, InputError, Item, LimitId, Network};
use lptn_units::Dimension;

use crate::events::{Event, EventKind};
use crate::limit_look::LimitLook;
use crate::limit_seen::{LimitSeen, Point};
use crate::reading::Reading;
use crate::selection::Selection;
use crate::window::{Window, WindowSeen};

/// A temperature that passes its limit by less than this, in K, does so by rounding: a temperature
/// of 300 K has steps of 6e-14 K, and the refined steady state of a network is good to a few
/// hundred of them.
const ROUNDING: f64 = 1e-9;

/// The limits of a network that have to be kept at every moment.
pub(crate) fn of_moments(network: &Network) -> impl Iterator<Item = LimitId> + '_ {
    network.limit_ids().filter(|id| network.limits()[id.index()].is_of_moments())
}

/// A window over the whole run that follows the sides of the limits over time and the quantities
/// of the reports over time, if there are any.
pub(crate) fn window(network: &Network, (from, to): (f64, f64)) -> Option<Window> {
    let over_time = |id: &LimitId| !network.limits()[id.index()].is_of_moments();
    let of = Selection::of_limits(network.limit_ids().filter(over_time));
    let of = of.and_reports(network.reports_over_time());
    (!of.is_empty()).then(|| Window { name: String::new(), from, to, of })
}

/// All limits of a network during a run.
pub(crate) struct LimitWatch<'a> {
    network: &'a Network,
    /// The limits that have to be kept at every moment, in the order of all that follows.
    ids: Vec<LimitId>,
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
        let ids: Vec<LimitId> = of_moments(network).collect();
        let count = ids.len();
        let bends = network.bends(ids.iter().map(|id| Item::Limit(*id)));
        let seen = ids.iter().map(|id| nothing(*id)).collect();
        Self {
            network,
            ids,
            reading: Reading::new(system),
            look: LimitLook::new(seen, bends.clone()),
            bends,
            first: vec![None; count],
            last: (f64::NAN, Vec::new()),
            sizes: vec![0.0; count],
            judged: vec![false; network.limits().len()],
        }
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.judged.is_empty()
    }

    /// Begins a segment: earlier points do not belong to a curve that goes on.
    pub(crate) fn enter(&mut self, work: &mut Workspace, at: (f64, f64)) -> Result<(), InputError> {
        let margins = self.values(work, at)?;
        self.look.stand(&mut self.reading.scope);
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
        for (id, size) in self.ids.iter().zip(&mut self.sizes) {
            let [low, high] = self.network.limit_sides(*id, &mut self.reading.scope)?;
            *size = size.max(low.abs()).max(high.abs());
            values.push(high - low);
        }
        for (id, judged) in self.network.limit_ids().zip(&mut self.judged) {
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
    /// start that breaks it is exact. A number over time is known at the end, and broken there;
    /// `window` is that of [`window`].
    pub(crate) fn into_seen(
        mut self,
        (tolerance, window): (f64, Option<&WindowSeen>),
    ) -> Vec<LimitSeen> {
        let (end, margins) = std::mem::take(&mut self.last);
        let mut all = std::mem::take(&mut self.look).into_seen();
        let points = self.first.iter().zip(margins.into_iter().map(|margin| (end, margin)));
        for (seen, (first, last)) in all.iter_mut().zip(points) {
            let exact = first.is_some_and(|(_, margin)| margin < -ROUNDING);
            if is_temperature(self.network, seen.limit) {
                let same = |point: &&Point| point.1 - seen.margin <= 10.0 * tolerance;
                let end = first.iter().chain([&last]).find(same);
                seen.worst_at = end.map_or(seen.worst_at, |(time, _)| *time);
                seen.reached((tolerance, exact));
            }
        }
        all.extend(self.over_time((tolerance, window)));
        all.sort_by_key(|seen| seen.limit);
        for (seen, judged) in all.iter_mut().zip(&self.judged) {
            if !judged && seen.margin.is_finite() {
                (seen.margin, seen.broken_at) = (f64::NAN, None);
            }
        }
        all
    }

    /// The results of the limits over time; not judged if the run has no length.
    fn over_time(&mut self, (tolerance, window): (f64, Option<&WindowSeen>)) -> Vec<LimitSeen> {
        let over_time = |id: &LimitId| !self.network.limits()[id.index()].is_of_moments();
        let ids: Vec<LimitId> = self.network.limit_ids().filter(over_time).collect();
        let sides = window.iter().flat_map(|window| {
            window.columns.chunks_exact(2).map(move |two| {
                [(window.history(&two[0]), two[0].open), (window.history(&two[1]), two[1].open)]
            })
        });
        let mut sides = sides.collect::<Vec<_>>().into_iter();
        let end = window.map_or(f64::NAN, |window| window.to);
        let mut one = |id: LimitId| {
            let unjudged = LimitSeen { margin: f64::NAN, ..nothing(id) };
            let Some(sides) = sides.next() else { return unjudged };
            let found = margin_over_time(self.network, (id, sides), &mut self.reading.scope);
            let Ok((margin, open)) = found else { return unjudged };
            let mut seen = LimitSeen { open, ..unjudged }.over_time((end, margin));
            if is_temperature(self.network, id) {
                seen.reached((tolerance, false));
            }
            seen
        };
        ids.into_iter().map(&mut one).collect()
    }
}

impl LimitSeen {
    /// A margin that the tolerance in K cannot distinguish from being just reached is zero, unless
    /// it is exact.
    fn reached(&mut self, (tolerance, exact): (f64, bool)) {
        let reached = -ROUNDING.max(10.0 * tolerance)..0.0;
        if !exact && reached.contains(&self.margin) {
            self.passed = Some((self.margin, self.broken_at));
            (self.margin, self.broken_at) = (0.0, None);
        }
    }
}

fn nothing(limit: LimitId) -> LimitSeen {
    let (margin, worst_at) = (f64::INFINITY, f64::NAN);
    LimitSeen { limit, margin, worst_at, broken_at: None, open: 0.0, proven: None, passed: None }
}

/// The margin of a limit over time and its possible error, from the time histories of its sides
/// and the shares by which their means may be off.
fn margin_over_time(
    network: &Network,
    (id, sides): (LimitId, [(History, f64); 2]),
    scope: &mut Evaluation,
) -> Result<(f64, f64), InputError> {
    let [low, high] = network.limit_over_time(id, &sides.map(|side| side.0), scope)?;
    let over_time = network.limits()[id.index()].over_time.iter().zip(&sides);
    let open = over_time.map(|(over_time, (history, open))| {
        over_time.as_ref().map_or(0.0, |o| o.functional.error(history, *open))
    });
    Ok((high - low, open.sum()))
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
        let margin = lasting_margin(network, id, scope)?;
        if !network.is_judged(id, scope)? {
            return Ok(f64::NAN);
        }
        let rounding = is_temperature(network, id) && (-ROUNDING..0.0).contains(&margin);
        Ok(if rounding { 0.0 } else { margin })
    };
    network.limit_ids().map(margin).collect()
}

/// The margin of a limit while everything stays as it is in `scope`; NaN for numbers over time that
/// then grow without end.
fn lasting_margin(
    network: &Network,
    id: LimitId,
    scope: &mut Evaluation,
) -> Result<f64, InputError> {
    let limit = &network.limits()[id.index()];
    if !limit.over_time.iter().flatten().all(|over_time| over_time.functional.is_lasting()) {
        return Ok(f64::NAN);
    }
    let mut side = |side: usize| network.limit_side((id, side), scope).map(History::constant);
    let sides = [side(0)?, side(1)?];
    let [low, high] = network.limit_over_time(id, &sides, scope)?;
    Ok(high - low)
}
