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
    /// Integral of the absolute value.
    size: f64,
}

impl Integral {
    /// Over all stretches.
    pub(super) fn of(way: &mut Way<'_>) -> Result<Self, BackwardError> {
        let mut integral = Self::default();
        let stretches = &way.asked.trajectory.stretches;
        let length = way.asked.length();
        for (number, stretch) in stretches.iter().enumerate() {
            let (from, to) = stretch.span();
            let parts = (PARTS * (to - from) / length).ceil().max(1.0);
            for k in (0..).map(f64::from).take_while(|k| *k < parts) {
                let ends = [k, k + 1.0].map(|k| from + (to - from) * k / parts);
                integral.add(way, number, (ends, HALVINGS))?;
            }
        }
        Ok(integral)
    }

    /// Adds a part, halved until the two rules agree.
    fn add(
        &mut self,
        way: &mut Way<'_>,
        stretch: usize,
        ([from, to], halvings): ([f64; 2], usize),
    ) -> Result<(), BackwardError> {
        let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
        let (mut fine, mut rough, mut size) = (0.0, 0.0, 0.0);
        let mut points = Vec::with_capacity(GAUSS.len());
        for [place, weight, other] in GAUSS {
            let (point, margin) = way.read(stretch, middle + half * place)?;
            fine += half * weight * margin;
            rough += half * other * margin;
            size += half * weight * margin.abs();
            points.push(Point { weight: half * weight, ..point });
        }
        if (fine - rough).abs() <= RESOLVED * (self.size + size) {
            self.value += fine;
            self.size += size;
            self.points.extend(points);
            return Ok(());
        }
        let Some(left) = halvings.checked_sub(1) else { return Err(way.asked.unresolved()) };
        self.add(way, stretch, ([from, middle], left))?;
        self.add(way, stretch, ([middle, to], left))
    }
}
