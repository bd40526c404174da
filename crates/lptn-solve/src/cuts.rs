//! The times inside an interval at which curves bend: some quantity passes one of its levels.
//!
//! A step is cut where a result bends. Limits, windows and functionals of sweeps use one resolution
//! (`resolve.rs`). `Network::bends` gives the quantities at whose roots an expression bends.

use lptn_network::Bends;

use crate::bracket::Bracket;
use crate::interval::{At, Interval, POINTS};
use crate::stop_reason::StopReason;
use crate::watch::{is_same, put_in, top};

/// A quantity nearer to a level at an end of an interval than this share of its range is at the
/// level: the interval was cut there.
const AT_THE_LEVEL: f64 = 1e-9;

/// Tops between the points that are evaluated, for each quantity and side.
const TOPS: usize = 4;

/// Halvings of the gap between two points in which a curve passes a level.
const GUESSES: usize = 50;

/// A time is found to this share of the interval.
const ENOUGH: f64 = 1e-14;

/// Levels at which curves bend: those of the quantities after the first `count` ones.
#[derive(Clone, Copy)]
pub(crate) struct Levels<'a> {
    /// Number of curves that are asked for.
    pub(crate) count: usize,
    /// For each of the others its levels, rising.
    pub(crate) of: &'a [Vec<f64>],
    /// For each of them the change that is rounding; 0 if it is not given.
    pub(crate) roundings: &'a [f64],
}

impl<'a> Levels<'a> {
    /// Those of `bends`.
    pub(crate) fn new(count: usize, bends: &'a Bends) -> Self {
        Self { count, of: bends.levels(), roundings: bends.roundings() }
    }
}

/// A time with the values of all curves there.
type End = (f64, Vec<f64>);

/// The times strictly inside an interval at which it has to be cut, ascending, with the values
/// there.
pub(crate) fn cuts(
    interval: &Interval,
    levels: Levels<'_>,
    at: &mut At<'_>,
) -> Result<Vec<End>, StopReason> {
    let mut found = Vec::new();
    for (i, levels_of) in levels.of.iter().enumerate() {
        let rounding = levels.roundings.get(i).copied().unwrap_or(0.0);
        one(interval, (levels.count + i, levels_of), (at, rounding), &mut found)?;
    }
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    let ends = (interval.from, interval.to);
    let apart = |a: f64, b: f64| (a - b).abs() > 1e-12 * (ends.1 - ends.0) && !is_same(a, b, ends);
    found.retain(|(time, _)| apart(*time, ends.0) && apart(*time, ends.1));
    found.dedup_by(|b, a| !apart(a.0, b.0));
    Ok(found)
}

/// Those of one quantity.
fn one(
    interval: &Interval,
    (column, levels): (usize, &[f64]),
    (at, rounding): (&mut At<'_>, f64),
    found: &mut Vec<End>,
) -> Result<(), StopReason> {
    let values = interval.of(column);
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    for value in values {
        (low, high) = (low.min(value), high.max(value));
    }
    let spread = high - low;
    // no curve that its points resolve leaves their range by as much again
    let within = |level: &f64| {
        let reached = (low - spread..=high + spread).contains(level);
        // noise around a level would pass it without end, and bends nothing
        reached && (high - level).max(level - low) > rounding
    };
    let near: Vec<f64> = levels.iter().copied().filter(within).collect();
    if near.is_empty() {
        return Ok(());
    }
    let mut points: Vec<(f64, f64)> = interval.times().into_iter().zip(values).collect();
    for sign in [1.0, -1.0] {
        look_at_tops((column, &near, sign), at, &mut points)?;
    }
    for level in near {
        let above = sides(&points, level, rounding.max(AT_THE_LEVEL * spread));
        for k in (1..points.len()).filter(|k| above[k - 1] != above[*k]) {
            let gap = [points[k - 1], points[k]];
            let guess = guess(interval, (column, level), gap);
            let enough = ENOUGH * (interval.to - interval.from);
            found.push(passing(at, (column, level), (gap, guess), enough)?);
        }
    }
    Ok(())
}

/// True for each point above a level; an end that is at the level counts as its neighbour.
fn sides(points: &[(f64, f64)], level: f64, margin: f64) -> Vec<bool> {
    let mut above: Vec<bool> = points.iter().map(|point| point.1 > level).collect();
    let last = points.len() - 1;
    for (end, next) in [(0, 1), (last, last - 1)] {
        if (points[end].1 - level).abs() <= margin {
            above[end] = above[next];
        }
    }
    above
}

/// Adds points where a parabola through three of them has its top (`sign` 1) or bottom (-1), as long
/// as a level may be passed there that no point has passed.
fn look_at_tops(
    (column, levels, sign): (usize, &[f64], f64),
    at: &mut At<'_>,
    points: &mut Vec<(f64, f64)>,
) -> Result<(), StopReason> {
    for _ in 0..TOPS {
        let ends = (points[0].0, points[points.len() - 1].0);
        let promising = points.windows(3).find_map(|w| {
            let turned = [w[0], w[1], w[2]].map(|(time, value)| (time, sign * value));
            let (height, time) = top(turned)?;
            let known = turned.iter().fold(f64::NEG_INFINITY, |most, point| most.max(point.1));
            let reach = height + 0.5 * (height - known);
            let passed = levels.iter().any(|level| (known..reach).contains(&(sign * level)));
            (passed && !w.iter().any(|point| is_same(point.0, time, ends))).then_some(time)
        });
        let Some(time) = promising else { break };
        put_in(points, (time, at(time)?[column]));
    }
    Ok(())
}

/// The time between two at which the polynomial through the points of an interval passes a level;
/// the middle if it does not.
fn guess(
    interval: &Interval,
    (column, level): (usize, f64),
    [before, after]: [(f64, f64); 2],
) -> f64 {
    let sign = (after.1 - before.1).signum();
    let passed = |time: f64| sign * (interval.interpolated(column, time) - level) > 0.0;
    let (mut before, mut after) = (before.0, after.0);
    for _ in 0..GUESSES {
        let middle = before.midpoint(after);
        match passed(middle) {
            true => after = middle,
            false => before = middle,
        }
    }
    before.midpoint(after)
}

/// Finds the moment at which a curve passes a level between two points (time in s, value): the
/// first time evaluated after it, with the values of all curves there. It is not further away than
/// `enough` in s unless rounding is more.
pub(crate) fn passing(
    at: &mut At<'_>,
    (column, level): (usize, f64),
    ([before, after], guess): ([(f64, f64); 2], f64),
    enough: f64,
) -> Result<End, StopReason> {
    let sign = (after.1 - before.1).signum();
    let beyond = |value: f64| sign * (value - level);
    let ends = [before, after].map(|(time, value)| (time, beyond(value)));
    let (mut bracket, mut found) = (Bracket::new(ends, guess, enough), None);
    while let Some(time) = bracket.next() {
        let values = at(time)?;
        if bracket.put(time, beyond(values[column])) {
            found = Some((time, values));
        }
    }
    match found {
        Some(end) => Ok(end),
        None => Ok((after.0, at(after.0)?)),
    }
}

/// The points of a curve over an interval.
pub(crate) fn points(interval: &Interval, column: usize) -> [(f64, f64); POINTS] {
    let (times, values) = (interval.times(), interval.of(column));
    std::array::from_fn(|point| (times[point], values[point]))
}

#[cfg(test)]
mod tests;
