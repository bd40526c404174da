//! Means and extremes over windows of time, from the integrator's own curve and not from rows.

use lptn_network::{Bends, Evaluation, Item, Network, ReportId};
use lptn_units::Type;

use crate::drawn::Day;
use crate::interval::{Interval, POINTS};
use crate::quadrature::Quadrature;
use crate::quantity::{Quantity, Shown};
use crate::selection::Selection;
use crate::stop_reason::StopReason;
use crate::watch::{LASTS, REFINEMENTS, first_there, is_same, put_in, top};
use crate::window::{ColumnSeen, ReportSeen, Window, WindowSeen};
use crate::zeros::share_above;

/// An extreme that differs from the value at an end of the window by less than this share of it is
/// there.
const SAME: f64 = 1e-9;

/// A window with its results up to now.
#[derive(Clone, Debug)]
pub(crate) struct Tracked {
    pub(crate) window: Window,
    /// Bends of its columns.
    bends: Bends,
    /// Values that are constant during the evaluation.
    slots: Vec<f64>,
    /// True at the start of a segment.
    jumped: bool,
    reached: f64,
    sums: Quadrature,
    min: Vec<(f64, f64)>,
    max: Vec<(f64, f64)>,
    positive: Vec<f64>,
    first: Vec<f64>,
    last: Vec<f64>,
}

/// Writes the value of every column of a window at a time inside the present step, then the
/// quantities that determine their bends.
pub(crate) type Columns<'a> =
    dyn FnMut(f64, (&Selection, &Bends), &mut Vec<f64>) -> Result<(), StopReason> + 'a;

impl Tracked {
    pub(crate) fn new(window: Window, network: &Network) -> Self {
        let count = window.of.quantities().len();
        let results = window.of.quantities().iter().filter_map(|quantity| match quantity {
            Quantity::Report(id) => Some(Item::Report(*id)),
            Quantity::Side(id, 0) => Some(Item::Limit(*id)),
            _ => None,
        });
        Self {
            bends: network.bends(results),
            slots: Vec::new(),
            jumped: true,
            reached: window.from,
            sums: Quadrature::new(kinds(&window.of, network)),
            window,
            min: vec![(f64::INFINITY, f64::NAN); count],
            max: vec![(f64::NEG_INFINITY, f64::NAN); count],
            positive: vec![0.0; count],
            first: Vec::new(),
            last: Vec::new(),
        }
    }

    /// Takes these constant values from the state of `scope`.
    pub(crate) fn stand(&mut self, scope: &mut Evaluation) {
        self.slots = self.bends.slots(scope);
        if std::mem::take(&mut self.jumped) {
            self.bends.stand(scope);
        }
    }

    /// The columns may jump here.
    pub(crate) fn jump(&mut self) {
        self.sums.jump();
        self.jumped = true;
    }

    /// Takes in the part of a step that lies inside.
    pub(crate) fn step(
        &mut self,
        (from, to): (f64, f64),
        columns: &mut Columns<'_>,
    ) -> Result<(), StopReason> {
        let (from, to) = (from.max(self.window.from), to.min(self.window.to));
        if from >= to {
            return Ok(());
        }
        let Self { window, bends, slots, sums, min, max, positive, first, last, .. } = self;
        let mut at = |time: f64| {
            let mut values = Vec::with_capacity(window.of.quantities().len());
            columns(time, (&window.of, bends), &mut values).map(|()| values)
        };
        sums.step((from, to), ((&*bends, slots), &mut at), &mut |interval, told| {
            if first.is_empty() {
                first.clone_from(&interval.values[0]);
            }
            last.clone_from(&interval.values[POINTS - 1]);
            look(interval, told, min, max);
            for (column, sum) in positive.iter_mut().enumerate() {
                *sum += above_zero(interval, told, column);
            }
        })?;
        self.reached = to;
        Ok(())
    }

    /// Mean and extremes of its columns as a day; `None` if the run did not reach it.
    pub(crate) fn into_day(self) -> Option<Day> {
        let (from, to) = (self.window.from, self.reached);
        let extremes = self.min.iter().zip(&self.max);
        let values = self.sums.integral.iter().zip(extremes);
        let values = values.map(|(sum, (min, max))| [sum / (to - from), min.0, max.0]).collect();
        (to > from).then_some(Day { from, to, values })
    }

    /// The results; `None` if the run did not reach the window.
    pub(crate) fn into_seen(self, network: &Network, tolerance: f64) -> Option<WindowSeen> {
        let length = self.reached - self.window.from;
        let (from, to) = (self.window.from, self.reached);
        let column = |(i, quantity): (usize, &Quantity)| {
            let ty = quantity.ty(network);
            let margin = if ty.absolute { 10.0 * tolerance } else { 0.0 };
            let settle = |(value, time): (f64, f64)| {
                let ends = [(self.first[i], from), (self.last[i], to)];
                (value, first_there((value, time), ends, margin.max(SAME * value.abs())))
            };
            let mean = self.sums.integral[i] / length;
            let name = quantity.name(network);
            let shown = Shown::of(*quantity, network);
            let (min, max) = (settle(self.min[i]), settle(self.max[i]));
            let (last, positive) = (self.last[i], self.positive[i]);
            let open = self.sums.open(i);
            ColumnSeen { name, ty, mean, min, max, last, positive, open, shown }
        };
        if length.is_nan() || length <= 0.0 {
            return None;
        }
        let name = self.window.name.clone();
        let mut seen = WindowSeen { name, from, to, columns: Vec::new(), reports: Vec::new() };
        for (i, quantity) in self.window.of.quantities().iter().enumerate() {
            let column = column((i, quantity));
            match report_over_time(*quantity, network) {
                Some(id) => seen.reports.push(ReportSeen::of((id, &column), &seen, network)),
                None => seen.columns.push(column),
            }
        }
        Some(seen)
    }
}

/// The report that a quantity is, if that is a number over time and not a column.
fn report_over_time(quantity: Quantity, network: &Network) -> Option<ReportId> {
    let Quantity::Report(id) = quantity else { return None };
    network.reports()[id.index()].over_time.is_some().then_some(id)
}

/// For each column a number that those of the same dimension share.
fn kinds(of: &Selection, network: &Network) -> Vec<usize> {
    let mut known: Vec<Type> = Vec::new();
    let kind = |quantity: &Quantity| {
        let ty = quantity.ty(network);
        known.iter().position(|other| *other == ty).unwrap_or_else(|| {
            known.push(ty);
            known.len() - 1
        })
    };
    of.quantities().iter().map(kind).collect()
}

/// Takes the extremes of all columns over an interval into those found up to now.
fn look(interval: &Interval, told: bool, min: &mut [(f64, f64)], max: &mut [(f64, f64)]) {
    let times: [f64; POINTS] = std::array::from_fn(|point| interval.time(point));
    for (column, (min, max)) in min.iter_mut().zip(max).enumerate() {
        let values: [f64; POINTS] = std::array::from_fn(|point| interval.values[point][column]);
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for value in values {
            (low, high) = (low.min(value), high.max(value));
        }
        let smooth = told && interval.is_smooth(column);
        let of = Curve { interval, column, times: &times, values: &values, smooth };
        // no curve that its points resolve leaves their range by as much again
        if high + (high - low) > max.0 {
            of.extreme(1.0, high, max);
        }
        if low - (high - low) < min.0 {
            of.extreme(-1.0, low, min);
        }
    }
}

/// Time in s for which a column is above zero in an interval.
fn above_zero(interval: &Interval, told: bool, column: usize) -> f64 {
    let values: [f64; POINTS] = std::array::from_fn(|point| interval.values[point][column]);
    let range = |(low, high): (f64, f64), value: f64| (low.min(value), high.max(value));
    let (low, high) = values.into_iter().fold((f64::INFINITY, f64::NEG_INFINITY), range);
    let length = interval.time(POINTS - 1) - interval.time(0);
    // no curve that its points resolve leaves their range by as much again
    if low - (high - low) > 0.0 {
        return length;
    } else if high + (high - low) < 0.0 {
        return 0.0;
    }
    if told && interval.is_smooth(column) {
        return length * share_above(&values);
    }
    let point = |point: usize| (interval.time(point), values[point]);
    (1..POINTS).map(|to| above_on_the_chord([point(to - 1), point(to)])).sum()
}

fn above_on_the_chord([(from, first), (to, last)]: [(f64, f64); 2]) -> f64 {
    match (first > 0.0, last > 0.0) {
        (true, true) => to - from,
        (false, false) => 0.0,
        _ => (to - from) * first.max(last) / (first - last).abs(),
    }
}

/// A column over an interval.
struct Curve<'a> {
    interval: &'a Interval,
    column: usize,
    times: &'a [f64; POINTS],
    values: &'a [f64; POINTS],
    /// True if the points resolve the curve.
    smooth: bool,
}

impl Curve<'_> {
    /// Takes in the largest value (`sign` 1) or the least (-1) of the points; if they resolve the
    /// curve also the top of parabolas through it and its neighbours.
    fn extreme(&self, sign: f64, value: f64, best: &mut (f64, f64)) {
        let same = |other: &f64| (other - value).abs() <= LASTS * value.abs();
        let Some(at) = self.values.iter().position(same) else { return };
        better(sign, best, (self.values[at], self.times[at]));
        let promises = |centre: usize| {
            let point = |p: usize| (self.times[p], sign * self.values[p]);
            let top = top([point(centre - 1), point(centre), point(centre + 1)]);
            top.is_some_and(|(height, _)| height > sign * best.0)
        };
        // a kink has no parabola
        if self.smooth && (at.saturating_sub(1).max(1)..=(at + 1).min(POINTS - 2)).any(promises) {
            self.refine(sign, best);
        }
    }

    fn refine(&self, sign: f64, best: &mut (f64, f64)) {
        let ends = (self.times[0], self.times[POINTS - 1]);
        let mut points: Vec<(f64, f64)> =
            self.times.iter().zip(self.values).map(|(time, value)| (*time, sign * value)).collect();
        for _ in 0..REFINEMENTS {
            let tops = points.windows(3).filter_map(|w| top([w[0], w[1], w[2]]));
            let Some((height, time)) = tops.max_by(|a, b| a.0.total_cmp(&b.0)) else { break };
            let known = points.iter().any(|p| is_same(p.0, time, ends));
            if known || height <= sign * best.0 + 1e-14 * best.0.abs() {
                break;
            }
            let value = self.interval.interpolated(self.column, time);
            better(sign, best, (value, time));
            put_in(&mut points, (time, sign * value));
        }
    }
}

/// Takes a value that is larger (`sign` 1) or less (-1) by more than rounding: an extreme that
/// lasts is where it begins.
fn better(sign: f64, best: &mut (f64, f64), (value, time): (f64, f64)) {
    if sign * value > sign * best.0 + LASTS * value.abs() {
        *best = (value, time);
    }
}

#[cfg(test)]
mod tests;
