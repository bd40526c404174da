//! Bounds on tables while their arguments run through intervals.

use super::axis::{Outside, place};
use super::one::Table1;
use super::pchip;
use super::two::Table2;
use crate::taylor::Taylor;
use crate::taylor::interval::Interval;

/// Relative distance beyond a knot at which an argument still counts as before it: a table is
/// continuous, so nothing is lost, and knots are seldom met to the last digit.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// The part of one axis that an argument runs through.
enum Part {
    /// Within the interval that begins with this knot.
    Within(usize),
    /// Beyond the first or the last knot, whose value continues.
    Held(usize),
    /// Over several: the first and the last knot that bound it.
    Over(usize, usize),
}

/// `None` if the table may have no value, or the argument is not bounded.
fn part(knots: &[f64], argument: &Taylor, outside: Outside) -> Option<Part> {
    let [from, to] = argument.range()?;
    place(knots, from, outside).and(place(knots, to, outside))?;
    let last = knots.len() - 1;
    let slack = ROUNDING * from.abs().max(to.abs());
    if to <= knots[0] + slack && outside == Outside::Hold && from < knots[0] {
        return Some(Part::Held(0));
    }
    if from >= knots[last] - slack && outside == Outside::Hold && to > knots[last] {
        return Some(Part::Held(last));
    }
    let before = |x: f64| knots.partition_point(|knot| *knot <= x).clamp(1, last) - 1;
    let middle = before(from.midpoint(to));
    let first = middle == 0 && outside == Outside::Error;
    let end = middle + 1 == last && outside == Outside::Error;
    if (first || from >= knots[middle] - slack) && (end || to <= knots[middle + 1] + slack) {
        return Some(Part::Within(middle));
    }
    Some(Part::Over(before(from), before(to) + 1))
}

impl Table1 {
    /// Bounds on its value for an argument with known bounds: with Taylor coefficients between two
    /// knots, without them over several.
    pub fn enclose(&self, x: Taylor) -> Taylor {
        match part(&self.x, &x, self.outside) {
            None => Taylor::unknown(),
            Some(Part::Held(end)) => Taylor::constant(self.y[end]),
            Some(Part::Within(piece)) => self.piece_of(piece, x),
            // straight lines, and cubics that rise and fall only where the points do
            Some(Part::Over(first, last)) => {
                Taylor::rough(hull(self.y[first..=last].iter().copied()))
            }
        }
    }

    fn piece_of(&self, i: usize, x: Taylor) -> Taylor {
        let (from, width) = (self.x[i], self.x[i + 1] - self.x[i]);
        let t = (x + Taylor::constant(-from)) * Taylor::constant(width.recip());
        let ends = [self.y[i], self.y[i + 1]];
        let powers = match self.slopes.get(i..i + 2) {
            Some(&[d0, d1]) => pchip::powers(ends, [width * d0, width * d1]),
            _ => [ends[0], ends[1] - ends[0], 0.0, 0.0],
        };
        let used = powers.iter().rposition(|c| *c != 0.0).map_or(1, |last| last + 1);
        let sum = powers[..used].iter().rev().copied().map(Taylor::constant);
        sum.reduce(|sum, c| sum * t + c).unwrap_or(Taylor::unknown())
    }
}

impl Table2 {
    /// Bounds on its value for arguments with known bounds.
    pub(crate) fn enclose(&self, [x, y]: [Taylor; 2]) -> Taylor {
        let along = [(self.x_knots(), x), (self.y_knots(), y)];
        let [Some(in_x), Some(in_y)] =
            along.map(|(knots, argument)| part(knots, &argument, self.outside()))
        else {
            return Taylor::unknown();
        };
        let bent = [&in_x, &in_y].iter().any(|part| matches!(part, Part::Over(..)));
        let cells = [in_x, in_y].map(|part| match part {
            Part::Held(end) => (end, end),
            Part::Within(first) => (first, first + 1),
            Part::Over(first, last) => (first, last),
        });
        let [(i, k), (j, l)] = cells;
        if bent {
            let rows = (i..=k).flat_map(|row| self.row(row)[j..=l].iter().copied());
            return Taylor::rough(hull(rows));
        }
        let share =
            |knots: &[f64], (first, last): (usize, usize), argument: Taylor| match first == last {
                true => Taylor::constant(0.0),
                false => {
                    let width = knots[last] - knots[first];
                    (argument + Taylor::constant(-knots[first])) * Taylor::constant(width.recip())
                }
            };
        let (u, v) = (share(self.x_knots(), (i, k), x), share(self.y_knots(), (j, l), y));
        let line = |row: &[f64]| Taylor::constant(row[j]) + v * Taylor::constant(row[l] - row[j]);
        let (low, high) = (line(self.row(i)), line(self.row(k)));
        low + u * (high - low)
    }

    fn row(&self, i: usize) -> &[f64] {
        let count = self.y_knots().len();
        &self.values()[i * count..(i + 1) * count]
    }
}

fn hull(values: impl Iterator<Item = f64>) -> Interval {
    values.map(Interval::point).reduce(Interval::hull).unwrap_or(Interval::ALL)
}
