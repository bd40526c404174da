//! Results of some nodes between the rows: peaks, and the time at which a level is crossed.

use lptn_network::NodeId;

use crate::interval::{POINTS, interpolated};

/// A node to watch at every step of the integrator.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Watch {
    /// The node.
    pub node: NodeId,
    /// A temperature in K whose first crossing is searched for.
    pub level: Option<f64>,
}

/// Results of a watched node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Watched {
    /// The node and the level.
    pub watch: Watch,
    /// Highest temperature in K and its time in s.
    pub peak: (f64, f64),
    /// Time in s at which the level was first reached, from either side.
    pub crossed: Option<f64>,
    first: f64,
    last: (f64, f64),
}

/// Number of parabolas that approach the top of a curve after the first.
pub(crate) const REFINEMENTS: usize = 4;

/// Values that differ by less than this share are one and the same but for rounding: an extreme
/// that lasts, in a node that nothing delays, has it over and over.
pub(crate) const LASTS: f64 = 16.0 * f64::EPSILON;

/// The first time of an extreme (value, time) of a curve with these values at its ends. An extreme
/// within `margin` of the first value cannot be distinguished from it, and is there. One that
/// differs from the last value by no more than that is there, unless it is the last value to
/// rounding: then it has lasted until the end and was there before.
pub fn first_there((value, time): (f64, f64), [first, last]: [(f64, f64); 2], margin: f64) -> f64 {
    let apart = |end: f64| (end - value).abs();
    if apart(first.0) <= margin {
        first.1
    } else if apart(last.0) <= margin && apart(last.0) > LASTS * value.abs() {
        last.1
    } else {
        time
    }
}

impl Watched {
    pub(crate) fn new(watch: Watch, time: f64, temperature: f64) -> Self {
        Self {
            watch,
            peak: (temperature, time),
            crossed: None,
            first: temperature,
            last: (time, temperature),
        }
    }

    /// Temperature at the start in K.
    pub fn first(&self) -> f64 {
        self.first
    }

    /// Temperature at the end that was reached in K.
    pub fn last(&self) -> f64 {
        self.last.1
    }

    /// Takes in the temperatures at successive points of a step, the first being the present one.
    pub(crate) fn look(&mut self, points: &[(f64, f64)]) {
        for (k, &point) in points.iter().enumerate() {
            self.peak_at(point);
            if self.crosses(point) {
                self.crossed = Some(match k {
                    0 => self.straight(point),
                    k => on_the_curve(points, k, self.watch.level.unwrap_or(point.1)),
                });
            }
            self.last = point;
        }
    }

    /// Takes in a temperature that may be the highest.
    pub(crate) fn peak_at(&mut self, (time, temperature): (f64, f64)) {
        if temperature > self.peak.0 + LASTS * temperature {
            self.peak = (temperature, time);
        }
    }

    /// A time inside the points at which the curve promises to be higher than the peak up to now: the
    /// top of a parabola near the highest of them. No curve that its points resolve leaves their
    /// range by as much again.
    pub(crate) fn promising(&self, points: &[(f64, f64)]) -> Option<f64> {
        let (mut low, mut high, mut at) = (f64::INFINITY, f64::NEG_INFINITY, 0);
        for (k, &(_, temperature)) in points.iter().enumerate() {
            low = low.min(temperature);
            if temperature > high {
                (high, at) = (temperature, k);
            }
        }
        if high + (high - low) <= self.peak.0 {
            return None;
        }
        let near = &points[at.saturating_sub(2)..(at + 3).min(points.len())];
        let tops = near.windows(3).filter_map(|p| top([p[0], p[1], p[2]]));
        let (height, time) = tops.max_by(|a, b| a.0.total_cmp(&b.0))?;
        let known =
            near.iter().any(|p| is_same(p.0, time, (points[0].0, points[points.len() - 1].0)));
        (height > self.peak.0 && !known).then_some(time)
    }

    /// True if its peak up to now is at least this temperature in K.
    pub(crate) fn is_above(&self, temperature: f64) -> bool {
        temperature <= self.peak.0
    }

    /// True if the level may first be reached by a curve in this range.
    pub(crate) fn may_cross(&self, low: f64, high: f64) -> bool {
        let (Some(level), None) = (self.watch.level, self.crossed) else { return false };
        low <= level && level <= high
    }

    /// Goes on to the present point of the curve.
    pub(crate) fn go_to(&mut self, point: (f64, f64)) {
        self.last = point;
    }

    /// The highest temperature of a step and its time, if the polynomial through its points is
    /// higher than the peak up to now between them.
    pub(crate) fn top(
        &self,
        step: (f64, f64),
        values: &[f64; POINTS],
        points: &[(f64, f64)],
    ) -> Option<(f64, f64)> {
        let first = self.promising(points)?;
        let mut points = points.to_vec();
        let (mut best, mut next) = ((self.peak.0, f64::NAN), Some(first));
        for _ in 0..REFINEMENTS {
            let Some(time) = next else { break };
            let value = interpolated(step, values, time);
            if value > best.0 {
                best = (value, time);
            }
            put_in(&mut points, (time, value));
            next = Self { peak: best, ..*self }.promising(&points);
        }
        (!best.1.is_nan()).then_some(best)
    }

    /// Takes in the temperature after a jump: a massless node may jump over its level.
    pub(crate) fn jump(&mut self, time: f64, temperature: f64) {
        if self.crosses((time, temperature)) {
            self.crossed = Some(self.straight((time, temperature)));
        }
        self.peak_at((time, temperature));
        self.last = (time, temperature);
    }

    /// True if the level is first reached between the last point and this one.
    fn crosses(&self, (_, temperature): (f64, f64)) -> bool {
        let (Some(level), None) = (self.watch.level, self.crossed) else { return false };
        let (before, after) = (self.last.1 - level, temperature - level);
        (before > 0.0) != (after > 0.0) || after == 0.0
    }

    /// The time in s of that, on the line from the last point to this one.
    fn straight(&self, (time, temperature): (f64, f64)) -> f64 {
        let level = self.watch.level.unwrap_or(temperature);
        let (before, after) = (self.last.1 - level, temperature - level);
        self.last.0 + (time - self.last.0) * (before / (before - after))
    }
}

/// Points on either side of a crossing whose polynomial represents the curve between them.
const BESIDE: usize = 3;

/// Halvings of the interval between two points: to the rounding of its length.
const HALVINGS: usize = 53;

/// The time at which a curve through points of a step reaches a level between `k - 1` and `k`.
fn on_the_curve(points: &[(f64, f64)], k: usize, level: f64) -> f64 {
    let near = &points[k.saturating_sub(BESIDE)..(k + BESIDE).min(points.len())];
    let above = |time: f64| polynomial(near, time) > level;
    let (mut before, mut after) = (points[k - 1].0, points[k].0);
    let begins_above = points[k - 1].1 > level;
    for _ in 0..HALVINGS {
        let middle = before.midpoint(after);
        match above(middle) == begins_above {
            true => before = middle,
            false => after = middle,
        }
    }
    after
}

/// The polynomial through at most twice [`BESIDE`] points at a time, by Neville's scheme.
fn polynomial(points: &[(f64, f64)], time: f64) -> f64 {
    let mut values = [0.0; 2 * BESIDE];
    values.iter_mut().zip(points).for_each(|(value, point)| *value = point.1);
    for width in 1..points.len() {
        for i in 0..points.len() - width {
            let (from, to) = (points[i].0, points[i + width].0);
            let share = (time - from) / (to - from);
            values[i] += share * (values[i + 1] - values[i]);
        }
    }
    values[0]
}

/// Puts a point (time, value) among others of ascending time.
pub(crate) fn put_in(points: &mut Vec<(f64, f64)>, point: (f64, f64)) {
    points.push(point);
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
}

/// True if two times between these ends are one: far from 0 those of a short step are all near each
/// other.
pub(crate) fn is_same(a: f64, b: f64, (from, to): (f64, f64)) -> bool {
    (a - b).abs() <= (1e-12 * b.abs()).min(1e-9 * (to - from))
}

/// The top (value, time) of the parabola through three points (time, value) of ascending time, if
/// it has one between them.
pub fn top([(t0, y0), (t1, y1), (t2, y2)]: [(f64, f64); 3]) -> Option<(f64, f64)> {
    let (left, right) = ((y1 - y0) / (t1 - t0), (y2 - y1) / (t2 - t1));
    let curvature = (right - left) / (t2 - t0);
    let slope = left + curvature * (t1 - t0);
    let step = -slope / (2.0 * curvature);
    let time = t1 + step;
    (curvature < 0.0 && time > t0 && time < t2).then_some((y1 + 0.5 * slope * step, time))
}

#[cfg(test)]
mod tests;
