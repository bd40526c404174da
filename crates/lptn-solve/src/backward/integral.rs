//! The integral of a margin over a run.

use super::error::BackwardError;
use super::running::GAUSS;
use super::way::Way;
use crate::margin::Point;

/// Parts of a run over which a margin is integrated first.
const PARTS: f64 = 100.0;

/// Largest difference of the two rules, as a part of the integral of the absolute value over the
/// run.
const RESOLVED: f64 = 1e-7;

/// Halvings of a part.
const HALVINGS: usize = 20;

/// The integral of a margin.
#[derive(Default)]
pub(super) struct Integral {
    pub(super) value: f64,
    /// The points at which it was read, with their weights in s.
    pub(super) points: Vec<Point>,
    /// Integral of the absolute value over the run.
    pub(super) size: f64,
}

/// A part of a stretch, with its integral by two rules and that of the absolute value.
struct Part {
    stretch: usize,
    ends: [f64; 2],
    fine: f64,
    rough: f64,
    size: f64,
    points: Vec<Point>,
}

impl Part {
    fn of(way: &mut Way<'_>, stretch: usize, ends: [f64; 2]) -> Result<Self, BackwardError> {
        let [from, to] = ends;
        let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
        let points = Vec::with_capacity(GAUSS.len());
        let mut part = Self { stretch, ends, fine: 0.0, rough: 0.0, size: 0.0, points };
        for [place, weight, other] in GAUSS {
            let (point, margin) = way.read(stretch, middle + half * place)?;
            part.fine += half * weight * margin;
            part.rough += half * other * margin;
            part.size += half * weight * margin.abs();
            part.points.push(Point { weight: half * weight, ..point });
        }
        Ok(part)
    }
}

impl Integral {
    /// Over all stretches.
    pub(super) fn of(way: &mut Way<'_>) -> Result<Self, BackwardError> {
        let stretches = &way.asked.trajectory.stretches;
        let length = way.asked.length();
        let mut parts = Vec::new();
        for (number, stretch) in stretches.iter().enumerate() {
            let (from, to) = stretch.span();
            let count = (PARTS * (to - from) / length).ceil().max(1.0);
            for k in (0..).map(f64::from).take_while(|k| *k < count) {
                let ends = [k, k + 1.0].map(|k| from + (to - from) * k / count);
                parts.push(Part::of(way, number, ends)?);
            }
        }
        let size = parts.iter().map(|part| part.size).sum();
        let mut integral = Self { size, ..Self::default() };
        parts.into_iter().try_for_each(|part| integral.add(way, part, HALVINGS))?;
        Ok(integral)
    }

    /// Adds a part, halved until the two rules agree.
    fn add(&mut self, way: &mut Way<'_>, part: Part, halvings: usize) -> Result<(), BackwardError> {
        if (part.fine - part.rough).abs() <= RESOLVED * self.size {
            self.value += part.fine;
            self.points.extend(part.points);
            return Ok(());
        }
        let Some(left) = halvings.checked_sub(1) else { return Err(way.asked.unresolved()) };
        let [from, to] = part.ends;
        let middle = 0.5 * (from + to);
        for ends in [[from, middle], [middle, to]] {
            let half = Part::of(way, part.stretch, ends)?;
            self.add(way, half, left)?;
        }
        Ok(())
    }
}
