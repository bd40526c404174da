//! What happens to some nodes between the rows: peaks, and the time at which a level is crossed.

use lptn_network::NodeId;

/// A node to watch at every step of the integrator.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Watch {
    /// The node.
    pub node: NodeId,
    /// A temperature in K whose first crossing is sought.
    pub level: Option<f64>,
}

/// What was seen of a watched node.
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

/// Points looked at inside each step, besides its ends.
pub(crate) const SAMPLES: u32 = 8;

/// How often the top of a curve is approached by another parabola.
pub(crate) const REFINEMENTS: usize = 4;

/// Values that differ by less than this share are one and the same but for rounding: an extreme
/// that lasts, in a node that nothing delays, has it over and over.
pub(crate) const LASTS: f64 = 16.0 * f64::EPSILON;

/// When an extreme (value, time) was first there, of a curve that begins and ends with these values
/// at these times. An extreme that differs from the first value by no more than `margin` cannot be
/// told from it, and is there. One that differs from the last value by no more than that is there,
/// unless it is the last value to rounding: then it has lasted until the end and was there before.
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

    /// Where the curve stands.
    pub(crate) fn last_point(&self) -> (f64, f64) {
        self.last
    }

    /// Takes in the temperatures at successive points of a step, the first being where the curve
    /// stands.
    pub(crate) fn look(&mut self, points: &[(f64, f64)]) {
        for &point in points {
            self.peak_at(point);
            self.cross(point);
            self.last = point;
        }
    }

    /// Takes in a temperature that may be the highest.
    pub(crate) fn peak_at(&mut self, (time, temperature): (f64, f64)) {
        if temperature > self.peak.0 + LASTS * temperature {
            self.peak = (temperature, time);
        }
    }

    /// A time inside the points where the curve promises to be higher than the peak so far.
    pub(crate) fn promising(&self, points: &[(f64, f64)]) -> Option<f64> {
        let tops = points.windows(3).filter_map(|p| top([p[0], p[1], p[2]]));
        let (height, time) = tops.max_by(|a, b| a.0.total_cmp(&b.0))?;
        let known =
            points.iter().any(|p| is_same(p.0, time, (points[0].0, points[points.len() - 1].0)));
        (height > self.peak.0 && !known).then_some(time)
    }

    /// Takes in the temperature after a jump: a massless node may leap over its level in no time.
    pub(crate) fn jump(&mut self, time: f64, temperature: f64) {
        self.cross((time, temperature));
        self.peak_at((time, temperature));
        self.last = (time, temperature);
    }

    /// Finds the crossing between the last point and this one by linear interpolation.
    fn cross(&mut self, (time, temperature): (f64, f64)) {
        let (Some(level), None) = (self.watch.level, self.crossed) else { return };
        let (before, after) = (self.last.1 - level, temperature - level);
        if (before > 0.0) != (after > 0.0) || after == 0.0 {
            self.crossed = Some(self.last.0 + (time - self.last.0) * (before / (before - after)));
        }
    }
}

/// Whether two times between these ends are one: far from 0 those of a short step are all near each
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
mod tests {
    use super::*;

    #[test]
    fn the_top_of_a_parabola_is_found_exactly() {
        let y = |t: f64| 5.0 - (t - 1.25) * (t - 1.25);
        let found = top([(0.0, y(0.0)), (1.0, y(1.0)), (3.0, y(3.0))]).unwrap();
        assert!((found.0 - 5.0).abs() < 1e-14 && (found.1 - 1.25).abs() < 1e-14, "{found:?}");
    }

    #[test]
    fn a_monotonic_curve_has_no_inner_top() {
        assert_eq!(top([(0.0, 0.0), (1.0, 1.0), (2.0, 2.0)]), None);
    }
}
