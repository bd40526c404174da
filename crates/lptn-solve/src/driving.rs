//! The inputs of a network over time, in parts that are short enough to resolve them.
//!
//! For a network without capacity the parts follow from its inputs alone; rows have no effect.

use lptn_assembly::{ThermalSystem, Workspace};
use lptn_network::InputError;

use crate::cells::stretches;
use crate::interval::{POINTS, time_of};
use crate::readings::parts;
use crate::times::{Segment, segments};
use crate::watch::{is_same, put_in, top};

/// Parts of a segment in which no input curves: the response to straight lines may curve.
const PARTS: u32 = 8;

/// Number of parabolas that approach the top of a curve after the first.
const REFINEMENTS: usize = 12;

/// The parts of each segment, from and to in s. They follow from the inputs alone, whatever rows
/// there are.
pub(crate) fn parts_of(system: &ThermalSystem, all: &[Segment]) -> Vec<Vec<(f64, f64)>> {
    let network = system.network();
    let curves = network.curves();
    let curved = match curves.is_empty() {
        true => Vec::new(),
        false => stretches(network, &curves, all, f64::INFINITY),
    };
    let begins: Vec<f64> = curved.iter().flat_map(parts).collect();
    let of = |segment: &Segment| {
        let Segment { from, to } = *segment;
        let inside = |time: &f64| *time > from && *time < to;
        let mut ends: Vec<f64> = begins.iter().copied().filter(inside).collect();
        if curved.is_empty() && !(system.is_linear() && network.inputs_are_straight()) {
            let part = |k: u32| from + (to - from) * f64::from(k) / f64::from(PARTS);
            ends = (1..PARTS).map(part).filter(inside).collect();
        }
        let begins: Vec<f64> = [from].into_iter().chain(ends).chain([to]).collect();
        begins.windows(2).map(|pair| (pair[0], pair[1])).collect()
    };
    all.iter().map(of).collect()
}

/// The largest value of `of` for the inputs of a network, from `start` to `stop` in s. For a
/// network that reads no time it is that at the start.
///
/// # Errors
/// [`InputError`] if an input has no value.
pub fn largest_of_inputs(
    system: &ThermalSystem,
    (start, stop): (f64, f64),
    of: &dyn Fn(&ThermalSystem, &Workspace) -> f64,
) -> Result<f64, InputError> {
    let mut work = system.workspace();
    let mut at = |time: f64, inside: f64| {
        system.read_inputs(&mut work, time, inside)?;
        Ok::<f64, InputError>(of(system, &work))
    };
    if !system.network().has_time_dependent_inputs() || start >= stop {
        return at(start, start);
    }
    let segments = segments(start, stop, &system.network().breakpoints(start, stop)?);
    let mut most = f64::NEG_INFINITY;
    for (segment, parts) in segments.iter().zip(parts_of(system, &segments)) {
        for part in parts {
            most = most.max(highest(part, &mut |time| at(time, segment.inside()))?);
        }
    }
    Ok(most)
}

/// The largest value of a curve over a part.
fn highest<E>(part: (f64, f64), at: &mut dyn FnMut(f64) -> Result<f64, E>) -> Result<f64, E> {
    let mut points = Vec::with_capacity(POINTS);
    for point in 0..POINTS {
        let time = time_of(part, point);
        points.push((time, at(time)?));
    }
    for _ in 0..REFINEMENTS {
        let known = points.iter().map(|point| point.1).fold(f64::NEG_INFINITY, f64::max);
        let tops = points.windows(3).filter_map(|w| top([w[0], w[1], w[2]]));
        let new = |time: f64| !points.iter().any(|point| is_same(point.0, time, part));
        let higher = tops.filter(|(height, time)| *height > known && new(*time));
        let Some((_, time)) = higher.max_by(|a, b| a.0.total_cmp(&b.0)) else { break };
        put_in(&mut points, (time, at(time)?));
    }
    Ok(points.iter().map(|point| point.1).fold(f64::NEG_INFINITY, f64::max))
}

#[cfg(test)]
mod tests;
