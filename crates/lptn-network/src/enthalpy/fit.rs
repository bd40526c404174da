//! Polynomials on panels instead of a capacity.
//!
//! The error of a panel is bounded by the form of the capacity over the whole of it (see
//! [`Taylor`]), not judged at some points. So a peak between points is found, however narrow.
//!
//! Compiled expressions are evaluated in interval Taylor arithmetic (`Program::enclose`). Its ninth
//! derivative bounds the error of an interpolation, so that nothing hides between points. Rounding
//! is not directed, because 1e-12 is sufficient. Nodes share curves by form. The identity of a
//! table is part of the form, because tables of different materials may have the same text of a
//! call.

use lptn_units::Taylor;

use super::panel::{Panel, TERMS};

/// Relative difference between a capacity and its polynomials.
const ACCURACY: f64 = 1e-12;

/// Initial width of a panel in K.
const PANEL: f64 = 64.0;

/// Distance in K from its end to which a range of temperatures is followed.
const NARROWEST: f64 = 1e-6;

/// The highest temperature in K at which values are needed.
const HOTTEST: f64 = 16_384.0;

/// Number of searches for a nearer edge before the capacity counts as unknown.
const EDGES: usize = 50;

/// Number of panels tried in each direction; the curve ends when they are used up. A smooth
/// capacity takes some hundreds, a jump or a kink some forty more.
const TRIES: usize = 100_000;

/// The same for [`Known::between`].
const BLOCK_TRIES: usize = 20_000;

/// Interpolation points of a panel: the zeros of Chebyshev's polynomial of degree 9.
const POINTS: [f64; TERMS] = [
    -0.984_807_753_012_208,
    -0.866_025_403_784_438_7,
    -0.642_787_609_686_539_4,
    -0.342_020_143_325_668_7,
    0.0,
    0.342_020_143_325_668_7,
    0.642_787_609_686_539_4,
    0.866_025_403_784_438_7,
    0.984_807_753_012_208,
];

/// The largest absolute value on (-1, 1) of the product of all `x - point`.
const PRODUCT: f64 = 1.0 / 256.0;

/// Differences are judged relative to the capacity, but no smaller one than this part of that at
/// the start.
const FLOOR: f64 = 1e-6;

/// A capacity over temperature in K.
pub(crate) trait Capacity {
    /// Its value; `None` if it has none.
    fn at(&mut self, temperature: f64) -> Option<f64>;

    /// Bounds on it and its derivatives between two temperatures.
    fn over(&mut self, from: f64, to: f64) -> Taylor;
}

/// Why there is no curve.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum NoCurve {
    /// The capacity is not known and positive at the start.
    Unknown,
    /// It changes so quickly there that it cannot be followed.
    TooQuick,
}

/// Why a stretch is not covered.
enum Stop {
    /// A temperature at which the capacity is not known and positive.
    Outside(f64),
    /// Too many panels.
    TooQuick,
}

pub(super) struct Fit<'a> {
    capacity: &'a mut dyn Capacity,
    panels: Vec<Panel>,
    /// The least capacity that differences are judged by.
    floor: f64,
    /// Number of panels that may still be tried.
    tries: usize,
    /// True if the capacity has to be positive; otherwise it may vanish.
    positive: bool,
}

/// The panels of a value that may vanish, and the gaps between them.
pub(crate) struct Known {
    /// Ascending; their heat is not filled in.
    pub(crate) panels: Vec<Panel>,
    /// A temperature in K in each gap between them, ascending.
    pub(crate) gaps: Vec<f64>,
}

impl Known {
    /// The known parts of a value between two temperatures in K. A temperature is in a gap if the
    /// value is not defined or negative there, or changes too quickly to be followed. `stops` are
    /// temperatures at which it may bend.
    pub(crate) fn between(value: &mut dyn Capacity, [from, to]: [f64; 2], stops: &[f64]) -> Self {
        let (panels, tries) = (Vec::new(), BLOCK_TRIES);
        let mut fit = Fit { capacity: value, panels, floor: 0.0, tries, positive: false };
        let mut ends: Vec<f64> = stops.iter().copied().filter(|t| *t > from && *t < to).collect();
        ends.extend([from, to]);
        ends.sort_by(f64::total_cmp);
        ends.dedup();
        let points = POINTS.map(|x| from + 0.5 * (to - from) * (1.0 + x));
        let values = points.into_iter().chain(ends.iter().copied()).filter_map(|t| fit.at(t));
        let largest = values.fold(0.0, f64::max);
        fit.floor = FLOOR * largest;
        ends.windows(2).for_each(|pair| fit.fill(pair[0], pair[1]));
        let mut gaps = Vec::new();
        let mut here = from;
        for panel in &fit.panels {
            gaps.extend((panel.from > here).then_some(here.midpoint(panel.from)));
            here = panel.to;
        }
        gaps.extend((to > here).then_some(here.midpoint(to)));
        Self { panels: fit.panels, gaps }
    }
}

impl<'a> Fit<'a> {
    /// The panels of a capacity around a start, ascending. `stops` are temperatures at which it may
    /// bend.
    pub(super) fn panels(
        capacity: &'a mut dyn Capacity,
        start: f64,
        stops: &[f64],
    ) -> Result<Vec<Panel>, NoCurve> {
        let (panels, tries) = (Vec::new(), TRIES);
        let mut fit = Self { capacity, panels, floor: 0.0, tries, positive: true };
        fit.floor = FLOOR * fit.at(start).ok_or(NoCurve::Unknown)?;
        fit.walk(start, stops, -1.0);
        if fit.tries == 0 && fit.panels.is_empty() {
            return Err(NoCurve::TooQuick);
        }
        fit.tries = TRIES;
        fit.walk(start, stops, 1.0);
        if fit.panels.is_empty() {
            return Err(if fit.tries == 0 { NoCurve::TooQuick } else { NoCurve::Unknown });
        }
        fit.panels.sort_by(|a, b| a.from.total_cmp(&b.from));
        Ok(fit.panels)
    }

    fn at(&mut self, temperature: f64) -> Option<f64> {
        let least = |c: f64| if self.positive { c > 0.0 } else { c >= 0.0 };
        self.capacity.at(temperature).filter(|c| c.is_finite() && least(*c))
    }

    /// Covers as much as possible between two temperatures.
    fn fill(&mut self, from: f64, to: f64) {
        let before = self.panels.len();
        if self.cover(from, to).is_ok() {
            return;
        }
        self.panels.truncate(before);
        let mut points = [-1.0, 1.0].into_iter().chain(POINTS);
        let known = points.any(|x| self.at(from + 0.5 * (to - from) * (1.0 + x)).is_some());
        if known && to - from > NARROWEST && self.tries > 0 {
            let middle = from.midpoint(to);
            self.fill(from, middle);
            self.fill(middle, to);
        }
    }

    /// Covers the temperatures from `start` on in one direction with panels, as far as the capacity
    /// is defined.
    fn walk(&mut self, start: f64, stops: &[f64], direction: f64) {
        let mut here = start;
        while here > 0.0 && here < HOTTEST || here <= 0.0 && direction > 0.0 {
            let next = (here + direction * PANEL).clamp(0.0, HOTTEST);
            let ahead = |t: &&f64| (**t - here) * direction > 0.0 && (next - **t) * direction > 0.0;
            let nearest = |a: &&f64, b: &&f64| ((**a - here).abs()).total_cmp(&(**b - here).abs());
            let next = stops.iter().filter(ahead).min_by(nearest).copied().unwrap_or(next);
            match self.stretch(here, next) {
                Ok(()) => here = next,
                Err(Stop::Outside(outside)) => return self.last(here, outside),
                Err(Stop::TooQuick) => return,
            }
        }
    }

    /// Covers the rest up to the first temperature at which the capacity is not defined.
    fn last(&mut self, here: f64, mut outside: f64) {
        for _ in 0..EDGES {
            let Some(inside) = self.edge(here, outside) else { return };
            match self.stretch(here, inside) {
                Err(Stop::Outside(nearer)) => outside = nearer,
                Ok(()) | Err(Stop::TooQuick) => return,
            }
        }
    }

    /// Covers the temperatures between `here` and `next`, or nothing.
    fn stretch(&mut self, here: f64, next: f64) -> Result<(), Stop> {
        let before = self.panels.len();
        let done = match self.at(next) {
            Some(_) => self.cover(here.min(next), here.max(next)),
            None => Err(Stop::Outside(next)),
        };
        if done.is_err() {
            self.panels.truncate(before);
        }
        done
    }

    /// The last temperature between one where the capacity is defined and one where it is not.
    fn edge(&mut self, mut inside: f64, mut outside: f64) -> Option<f64> {
        let first = inside;
        while (outside - inside).abs() > NARROWEST {
            let middle = 0.5 * (inside + outside);
            if self.at(middle).is_some() { inside = middle } else { outside = middle }
        }
        ((inside - first).abs() > NARROWEST).then_some(inside)
    }

    /// Adds panels from `from` to `to`, halved until it is certain that they agree with the
    /// capacity.
    fn cover(&mut self, from: f64, to: f64) -> Result<(), Stop> {
        self.tries = self.tries.checked_sub(1).ok_or(Stop::TooQuick)?;
        let half = 0.5 * (to - from);
        let mut values = [0.0; TERMS];
        for (value, x) in values.iter_mut().zip(POINTS) {
            let place = from + half * (1.0 + x);
            *value = self.at(place).ok_or(Stop::Outside(place))?;
        }
        let bounds = self.capacity.over(from, to);
        let terms = (bounds.degree() + 1).min(TERMS);
        let mut capacity = interpolate(&values);
        capacity[terms..].fill(0.0);
        let middle = from.midpoint(to);
        if self.is_met(&capacity, &bounds, half) {
            self.panels.push(Panel::new((from, to), capacity, terms));
        } else if to - from <= 4.0 * f64::EPSILON * to {
            // hardly a number lies between the ends: all have been evaluated
            let mut mean = [0.0; TERMS];
            mean[0] = values.iter().sum::<f64>() / values.len() as f64;
            self.panels.push(Panel::new((from, to), mean, 1));
        } else {
            self.cover(from, middle)?;
            self.cover(middle, to)?;
        }
        Ok(())
    }

    /// True if capacity and polynomial are certainly positive on a panel and agree: the ninth
    /// derivative bounds the error of the interpolation, or the capacity hardly changes.
    fn is_met(&self, capacity: &[f64; TERMS], bounds: &Taylor, half: f64) -> bool {
        let Some([least, most]) = bounds.range() else { return false };
        let missed = bounds.largest(TERMS) * half.powi(9) * PRODUCT;
        let swing: f64 = capacity[1..].iter().map(|c| c.abs()).sum();
        let least = least.max(capacity[0] - swing - missed);
        let enough = ACCURACY * least.max(self.floor);
        // limit on the heat per K of a kink or jump that remains
        let hidden = (most - least) * (2.0 * half).min(1.0);
        (least > 0.0 || !self.positive) && (missed <= enough || hidden <= enough)
    }
}

/// The polynomial through the values at [`POINTS`], by powers: Newton's divided differences,
/// multiplied out.
fn interpolate(values: &[f64; TERMS]) -> [f64; TERMS] {
    let mut divided = *values;
    for order in 1..TERMS {
        for i in (order..TERMS).rev() {
            divided[i] = (divided[i] - divided[i - 1]) / (POINTS[i] - POINTS[i - order]);
        }
    }
    let mut powers = [0.0; TERMS];
    for i in (0..TERMS).rev() {
        for k in (1..TERMS).rev() {
            powers[k] = powers[k - 1] - POINTS[i] * powers[k];
        }
        powers[0] = divided[i] - POINTS[i] * powers[0];
    }
    powers
}
