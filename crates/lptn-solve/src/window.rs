//! Means and extremes over windows of time, from the integrator's own curve and not from rows.

use lptn_network::Network;
use lptn_units::{Type, Unit};

use crate::error::StopReason;
use crate::quadrature::{self, Point};
use crate::quantity::Shown;
use crate::table::Selection;
use crate::watch::{REFINEMENTS, top};

/// A part of a run over which columns are averaged and their extremes found.
#[derive(Clone, Debug)]
pub struct Window {
    /// Its name.
    pub name: String,
    /// When it begins, in s.
    pub from: f64,
    /// When it ends, in s; after `from`.
    pub to: f64,
    /// The columns.
    pub of: Selection,
}

/// What was seen of a column over a window, in SI units.
#[derive(Clone, Debug, PartialEq)]
pub struct ColumnSeen {
    /// The name of the column, `steel.T`.
    pub name: String,
    /// Its type.
    pub ty: Type,
    /// The mean over time.
    pub mean: f64,
    /// The least value and when it was first there, in s; at a jump both sides count.
    pub min: (f64, f64),
    /// The largest value and when it was first there, in s.
    pub max: (f64, f64),
    shown: Shown,
}

impl ColumnSeen {
    /// The unit that its values are shown in: `temperature` for points on the scale, that of a signal which has one,
    /// else SI; `1` for a number.
    pub fn unit(&self, temperature: &Unit) -> String {
        self.shown.unit(temperature)
    }

    /// A value in that unit.
    pub fn shown(&self, value: f64, temperature: &Unit) -> f64 {
        self.shown.value(value, temperature)
    }
}

/// What was seen over a window.
#[derive(Clone, Debug, PartialEq)]
pub struct WindowSeen {
    /// Its name.
    pub name: String,
    /// When it begins, in s.
    pub from: f64,
    /// When it ends, in s; where the run broke off earlier, that time.
    pub to: f64,
    /// Each of its columns.
    pub columns: Vec<ColumnSeen>,
}

/// An extreme that differs from the value at an end of the window by less than this share of it is there.
const SAME: f64 = 1e-9;

/// A window with what was seen so far.
#[derive(Clone, Debug)]
pub(crate) struct Tracked {
    pub(crate) window: Window,
    reached: f64,
    integral: Vec<f64>,
    min: Vec<(f64, f64)>,
    max: Vec<(f64, f64)>,
    first: Vec<f64>,
    last: Vec<f64>,
}

/// Writes the value of every column of a window at a time inside the present step.
pub(crate) type Columns<'a> = dyn FnMut(f64, &Selection, &mut Vec<f64>) -> Result<(), StopReason> + 'a;

impl Tracked {
    pub(crate) fn new(window: Window) -> Self {
        let count = window.of.quantities().len();
        Self {
            reached: window.from,
            window,
            integral: vec![0.0; count],
            min: vec![(f64::INFINITY, f64::NAN); count],
            max: vec![(f64::NEG_INFINITY, f64::NAN); count],
            first: Vec::new(),
            last: Vec::new(),
        }
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
        let of = &self.window.of;
        let mut at = |time: f64| {
            let mut values = Vec::with_capacity(of.quantities().len());
            columns(time, of, &mut values).map(|()| Point { time, values })
        };
        let mut points = quadrature::integrate((from, to), &mut self.integral, &mut at)?;
        for column in 0..self.integral.len() {
            extreme(column, 1.0, &mut self.max[column], &mut points, &mut at)?;
            extreme(column, -1.0, &mut self.min[column], &mut points, &mut at)?;
        }
        if self.first.is_empty() {
            self.first = points.first().map_or(Vec::new(), |p| p.values.clone());
        }
        self.last = points.pop().map_or(Vec::new(), |p| p.values);
        self.reached = to;
        Ok(())
    }

    /// What was seen; `None` where the run did not come so far.
    pub(crate) fn into_seen(self, network: &Network, tolerance: f64) -> Option<WindowSeen> {
        let length = self.reached - self.window.from;
        let (from, to) = (self.window.from, self.reached);
        let column = |(i, quantity): (usize, &crate::quantity::Quantity)| {
            let ty = quantity.ty(network);
            let margin = if ty.absolute { 10.0 * tolerance } else { 0.0 };
            let settle = |(value, time): (f64, f64)| {
                let same = |end: f64| (end - value).abs() <= margin.max(SAME * value.abs());
                match (same(self.first[i]), same(self.last[i])) {
                    (true, _) => (value, from),
                    (_, true) => (value, to),
                    _ => (value, time),
                }
            };
            let mean = self.integral[i] / length;
            let name = quantity.name(network);
            let shown = Shown::of(*quantity, network);
            ColumnSeen { name, ty, mean, min: settle(self.min[i]), max: settle(self.max[i]), shown }
        };
        (length > 0.0).then(|| WindowSeen {
            name: self.window.name.clone(),
            from,
            to,
            columns: self.window.of.quantities().iter().enumerate().map(column).collect(),
        })
    }
}

/// Seeks the largest value (`sign` 1) or the least (-1) of a column among points, and where a parabola through three
/// of them promises more.
fn extreme(
    column: usize,
    sign: f64,
    best: &mut (f64, f64),
    points: &mut Vec<Point>,
    at: &mut dyn FnMut(f64) -> Result<Point, StopReason>,
) -> Result<(), StopReason> {
    let better = |best: &mut (f64, f64), point: &Point| {
        if sign * point.values[column] > sign * best.0 {
            *best = (point.values[column], point.time);
        }
    };
    points.iter().for_each(|point| better(best, point));
    for _ in 0..REFINEMENTS {
        let of = |p: &Point| (p.time, sign * p.values[column]);
        let tops = points.windows(3).filter_map(|w| top([of(&w[0]), of(&w[1]), of(&w[2])]));
        let Some((height, time)) = tops.max_by(|a, b| a.0.total_cmp(&b.0)) else { break };
        let known = points.iter().any(|p| (p.time - time).abs() <= 1e-12 * time.abs());
        if known || height <= sign * best.0 + 1e-14 * best.0.abs() {
            break;
        }
        let point = at(time)?;
        better(best, &point);
        let place = points.partition_point(|p| p.time < time);
        points.insert(place, point);
    }
    Ok(())
}
