//! The states of a run at every time, and its events, for analyses that go back through it.
//!
//! The integrator's own interpolant of each step is kept ([`curve`]), so that a trajectory adds no
//! error to that of the run.

mod curve;

use std::sync::Arc;

use lptn_integrate::SeriesStep;
use lptn_network::{Network, NoTangents, Positions};

use curve::Curve;
pub(crate) use curve::Series;

/// The most memory of a trajectory in bytes.
const MOST_BYTES: usize = 1 << 30;

lptn_units::errors! {
/// Why there is no way back through a run.
#[derive(Clone, Debug, PartialEq)]
pub enum NoTrajectory {
    /// The run did not keep its trajectory, or it has no state.
    Unknown = "gradient::trajectory", "the run did not keep its temperatures at every time";
    /// The network has none.
    Tangents => NoTangents;
    /// It would take too much memory: states and steps.
    Long { states: usize, steps: usize } = "gradient::memory",
        format!(
            "{steps} steps of {states} temperatures do not fit in memory, and a gradient goes back \
             through all of them"
        ),
        help "take a looser tolerance, or a shorter run";
    /// A control or comparison switches at the time of another one: its name and the time in s.
    Together { name: String, time: f64 } = "gradient::together",
        format!(
            "`{name}` switches at the same time as another control or comparison, {time} s: a \
             parameter may part them, so that there is no gradient"
        ),
        help "begin at another value, or use a method without derivatives";
}
}

/// A part of a run between two breakpoints or events, in which inputs are smooth and positions stay.
#[derive(Clone, Debug)]
pub(crate) struct Stretch {
    /// A time inside the segment, at which comparisons of `t` are read.
    pub(crate) inside: f64,
    pub(crate) positions: Option<Positions>,
    pieces: Vec<Piece>,
    /// The event that ends it; `None` for a breakpoint.
    pub(crate) end: Option<Turn>,
}

/// A switch at the end of a stretch.
#[derive(Clone, Debug)]
pub(crate) struct Turn {
    pub(crate) time: f64,
    pub(crate) cause: Cause,
    pub(crate) after: Positions,
    /// Temperatures in K of the massless nodes after it.
    pub(crate) branch: Vec<f64>,
}

/// The cause of a switch, which determines how its time moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Cause {
    /// A known time: the start or a breakpoint.
    Fixed,
    /// The threshold of a position is reached.
    Crossing(usize),
    /// The dwell of a control ends. It began at the end of the stretch of this number, or at a known
    /// time.
    Dwell {
        /// The number of the control.
        control: usize,
        /// The number of the stretch.
        began: Option<usize>,
    },
}

/// A step, or a part of one.
#[derive(Clone, Debug)]
struct Piece {
    from: f64,
    to: f64,
    curve: Curve,
    /// Temperatures in K at its end of the massless nodes that are solved for: which of several
    /// solutions they are on.
    branch: Vec<f64>,
}

/// The states of a run over time.
#[derive(Clone, Debug, Default)]
pub(crate) struct Trajectory {
    pub(crate) stretches: Vec<Stretch>,
    /// For each control the stretch at whose end it switched last.
    switched: Vec<Option<usize>>,
    bytes: usize,
    failure: Option<NoTrajectory>,
}

impl Trajectory {
    /// Without any stretch.
    pub(crate) fn new(network: &Network) -> Self {
        Self { switched: vec![None; network.controls().len()], ..Self::default() }
    }

    /// Begins a stretch.
    pub(crate) fn enter(&mut self, inside: f64, positions: Option<&Positions>) {
        let empty = self.stretches.last().is_some_and(|stretch| stretch.pieces.is_empty());
        if empty {
            self.stretches.pop();
        }
        let positions = positions.cloned();
        self.stretches.push(Stretch { inside, positions, pieces: Vec::new(), end: None });
    }

    /// The times in s at which a piece of a polynomial of a degree needs its values.
    pub(crate) fn times(span: (f64, f64), degree: usize) -> impl Iterator<Item = f64> {
        curve::times(span, degree)
    }

    /// Adds a piece with its values at as many of those times, and the temperatures in K of the
    /// massless nodes at its end.
    pub(crate) fn add(
        &mut self,
        span: (f64, f64),
        (values, points): (Vec<f64>, usize),
        branch: Vec<f64>,
    ) {
        self.push(span, Curve::Points(values, points), branch);
    }

    /// Adds a piece of a series.
    pub(crate) fn add_series(&mut self, span: (f64, f64), step: &SeriesStep<'_>) {
        let last = self.stretches.last().and_then(|stretch| stretch.pieces.last());
        let known = last.and_then(|piece| piece.curve.series());
        let series = match known {
            Some(known) if known.is_of(step) => Arc::clone(known),
            _ => Arc::new(Series::of(step)),
        };
        self.push(span, Curve::Series(series), Vec::new());
    }

    fn push(&mut self, (from, to): (f64, f64), curve: Curve, branch: Vec<f64>) {
        if from >= to {
            return;
        }
        let steps = self.stretches.iter().map(|stretch| stretch.pieces.len()).sum::<usize>();
        self.bytes += curve.bytes() + branch.len() * size_of::<f64>();
        if self.bytes > MOST_BYTES {
            let states = curve.states();
            self.failure.get_or_insert(NoTrajectory::Long { states, steps });
            return;
        }
        if let Some(stretch) = self.stretches.last_mut() {
            stretch.pieces.push(Piece { from, to, curve, branch });
        }
    }

    /// Refuses the way back if several positions are due, or if something switched at this time
    /// before; `name` is that of a position.
    pub(crate) fn check_alone(
        &mut self,
        (time, due): (f64, &[usize]),
        name: impl Fn(usize) -> String,
    ) {
        let [ref others @ .., last] = *due else { return };
        let (ended, begun) = match self.stretches.as_slice() {
            [.., before, now] => (before.end.is_some(), now.pieces.is_empty()),
            _ => (false, false),
        };
        if !others.is_empty() || ended && begun {
            self.failure.get_or_insert(NoTrajectory::Together { name: name(last), time });
        }
    }

    /// The stretch ends with a switch at a time in s. `waited` is the control whose dwell ended, if
    /// no threshold was crossed; `due` are the positions at their thresholds.
    pub(crate) fn turn(
        &mut self,
        (time, due, waited): (f64, &[usize], Option<usize>),
        [before, after]: [&Positions; 2],
        branch: Vec<f64>,
    ) {
        if before == after {
            return;
        }
        let last = |control: usize| self.switched.get(control).copied().flatten();
        let cause = match (due.first(), waited) {
            (Some(&position), _) => Cause::Crossing(position),
            (None, Some(control)) => Cause::Dwell { control, began: last(control) },
            (None, None) => Cause::Fixed,
        };
        let number = self.stretches.len().saturating_sub(1);
        for (control, (before, after)) in before.controls.iter().zip(&after.controls).enumerate() {
            if before != after {
                // a switch at a known time does not move
                self.switched[control] = (cause != Cause::Fixed).then_some(number);
            }
        }
        if let (Some(stretch), true) = (self.stretches.last_mut(), cause != Cause::Fixed) {
            stretch.end = Some(Turn { time, cause, after: after.clone(), branch });
        }
    }

    /// # Errors
    /// The reason why it is not complete.
    pub(crate) fn check(&self) -> Result<(), NoTrajectory> {
        self.failure.clone().map_or(Ok(()), Err)
    }
}

impl Stretch {
    /// Start and end in s; NaN if it has no piece.
    pub(crate) fn span(&self) -> (f64, f64) {
        let from = self.pieces.first().map_or(f64::NAN, |piece| piece.from);
        (from, self.pieces.last().map_or(f64::NAN, |piece| piece.to))
    }

    /// The piece at a time, or the nearest one.
    fn piece(&self, time: f64) -> Option<&Piece> {
        let after = self.pieces.partition_point(|piece| piece.to < time);
        self.pieces.get(after).or(self.pieces.last())
    }

    /// Writes the variables of all states at a time inside; outside, those of the nearest end.
    pub(crate) fn at(&self, time: f64, out: &mut [f64]) {
        self.piece(time).iter().for_each(|piece| piece.at(time, out));
    }

    /// The ends in s of the steps inside a part of it, without its own.
    pub(crate) fn joints(&self, (from, to): (f64, f64)) -> impl Iterator<Item = f64> + '_ {
        let first = self.pieces.partition_point(|piece| piece.to <= from);
        let pairs = self.pieces[first..].windows(2).take_while(move |pair| pair[0].to < to);
        let steps = pairs.filter(|pair| !pair[0].curve.goes_on_in(&pair[1].curve));
        steps.map(|pair| pair[0].to)
    }

    /// Duration in s of the step that ends at a time or contains it.
    pub(crate) fn step(&self, time: f64) -> f64 {
        self.piece(time).map_or(f64::INFINITY, |piece| piece.to - piece.from)
    }

    /// Temperatures in K of the massless nodes that are solved for, near a time.
    pub(crate) fn branch(&self, time: f64) -> &[f64] {
        self.piece(time).map_or(&[], |piece| &piece.branch)
    }
}

impl Piece {
    fn at(&self, time: f64, out: &mut [f64]) {
        self.curve.at((self.from, self.to), time, out);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polynomials_up_to_the_fifth_degree_are_exact() {
        for degree in 1..=5 {
            let of = |t: f64| [1.0 - t + 2.0 * t.powi(degree), t.powi(degree - 1)];
            let mut known = Trajectory::default();
            known.enter(3.0, None);
            let times = Trajectory::times((2.0, 4.0), degree as usize);
            let values: Vec<f64> = times.flat_map(of).collect();
            let points = values.len() / 2;
            known.add((2.0, 4.0), (values, points), Vec::new());
            let stretch = &known.stretches[0];
            assert_eq!(stretch.span(), (2.0, 4.0));
            for time in [2.0, 2.1, 3.0, 3.7, 4.0] {
                let mut found = [0.0; 2];
                stretch.at(time, &mut found);
                for (found, expected) in found.into_iter().zip(of(time)) {
                    assert!((found - expected).abs() < 1e-12 * expected.abs(), "{time}: {found}");
                }
            }
        }
    }
}
