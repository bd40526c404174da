//! The fluid in a pipe: its temperature over its place.
//!
//! Fluid has a mark that does not change while it moves: the amount that had passed the inlet when
//! it entered. If `passed` is the present amount, the pipe contains the marks from `passed -
//! content` (at the outlet) to `passed` (at the inlet), whichever way the fluid moves (method of
//! characteristics for `dT/dt + v dT/dx = 0`; R. J. LeVeque, Finite Volume Methods for Hyperbolic
//! Problems, Cambridge 2002, section 2.1). Each step of a run adds one piece of fluid at the end at
//! which it enters.

use std::collections::VecDeque;

use crate::interval::{GAUSS, NODES, POINTS, polynomial};

/// Marks that differ by less than this share of the content are the same.
const SAME: f64 = 1e-11;

/// A bend of the temperature over the content by less than this number of the differences that are
/// a jump does not count.
const BENT: f64 = 1e4;

/// Pieces narrower than this share of the content do not tell their slope.
const NARROW: f64 = 1e-7;

/// Most evaluations in search of a mark in a piece.
const LOOKS: usize = 100;

/// Fluid that entered in one step: its marks and temperatures in K at the points of the step.
#[derive(Clone, Debug, PartialEq)]
struct Piece {
    /// The marks that are still in the pipe, ascending.
    from: f64,
    to: f64,
    marks: [f64; POINTS],
    temperatures: [f64; POINTS],
}

impl Piece {
    /// The temperature of the fluid of a mark in K.
    fn at(&self, mark: f64) -> f64 {
        // of the rises, so that an even temperature stays even to the last digit
        let first = self.temperatures[0];
        let rises = self.temperatures.map(|t| t - first);
        match rises.iter().all(|rise| rise.abs() <= 0.0) {
            true => first,
            false => first + polynomial(&rises, self.place(mark)),
        }
    }

    /// Slope of the temperature at a mark, by the difference to the middle of the piece; `None` for a
    /// piece that is narrower than `least`.
    fn slope_at(&self, mark: f64, least: f64) -> Option<f64> {
        let near = mark + 0.01 * (0.5 * (self.from + self.to) - mark);
        let wide = self.to - self.from >= least;
        wide.then(|| (self.at(near) - self.at(mark)) / (near - mark))
    }

    /// The place in the step, from -1 to 1, at which the fluid of a mark entered (Illinois
    /// algorithm; M. Dowell and P. Jarratt, BIT 11 (1971) 168).
    fn place(&self, mark: f64) -> f64 {
        let over = |place: f64| polynomial(&self.marks, place) - mark;
        let [mut a, mut b] = [NODES[0], NODES[POINTS - 1]];
        let [mut at_a, mut at_b] = [self.marks[0] - mark, self.marks[POINTS - 1] - mark];
        let enough = 4.0 * f64::EPSILON * (self.marks[0].abs() + self.marks[POINTS - 1].abs());
        if at_a.abs() <= enough {
            return a;
        }
        for _ in 0..LOOKS {
            if at_b.abs() <= enough || at_a * at_b > 0.0 || (b - a).abs() <= f64::EPSILON {
                break;
            }
            let next = (a - at_a * (b - a) / (at_b - at_a)).clamp(a.min(b), a.max(b));
            let value = over(next);
            if value.abs() <= enough {
                return next;
            }
            if value * at_b < 0.0 {
                (a, at_a, b, at_b) = (b, at_b, next, value);
            } else {
                (b, at_b) = (next, value);
                at_a *= 0.5;
            }
        }
        b
    }
}

/// Fluid that enters in a step: the amounts passed and its temperatures in K, at the points of the
/// step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Entering {
    pub(crate) passed: [f64; POINTS],
    pub(crate) temperatures: [f64; POINTS],
}

/// A mark at which a step has to end when it leaves.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Edge {
    mark: f64,
    /// True if the temperature jumps there; false if it bends.
    jumps: bool,
}

/// An edge that leaves when this amount has passed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Leaving {
    pub(crate) passed: f64,
    pub(crate) jumps: bool,
}

/// The fluid in a pipe, in the unit of the state that counts it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Content {
    size: f64,
    passed: f64,
    /// From the outlet to the inlet.
    pieces: VecDeque<Piece>,
    /// Ascending.
    edges: VecDeque<Edge>,
}

impl Content {
    /// Fluid of one temperature in K, with this amount passed.
    pub(crate) fn new(size: f64, passed: f64, temperature: f64) -> Self {
        let mut marks = NODES;
        marks.iter_mut().for_each(|x| *x = passed + 0.5 * (*x - 1.0) * size);
        let piece =
            Piece { from: passed - size, to: passed, marks, temperatures: [temperature; POINTS] };
        Self { size, passed, pieces: VecDeque::from([piece]), edges: VecDeque::new() }
    }

    pub(crate) fn size(&self) -> f64 {
        self.size
    }

    /// The amount that had passed when the content was recorded last.
    pub(crate) fn passed(&self) -> f64 {
        self.passed
    }

    fn same(&self) -> f64 {
        SAME * self.size + 4.0 * f64::EPSILON * self.passed.abs()
    }

    /// Temperature in K of the fluid that leaves when `passed` is reached, at the inlet if the flow
    /// is `reversed`. A jump that arrives on the way is not passed. `None` for fluid that had not
    /// entered when the content was recorded.
    pub(crate) fn leaving(&self, passed: f64, reversed: bool) -> Option<f64> {
        let mark = if reversed { passed } else { passed - self.size };
        let edge = if reversed { self.edges.back() } else { self.edges.front() };
        let (first, last) = (self.pieces.front()?, self.pieces.back()?);
        let piece = match edge.map(|edge| edge.mark) {
            Some(jump) if reversed && mark <= jump => {
                let behind = self.pieces.iter().find(|piece| piece.to > jump)?;
                return Some(behind.at(jump.max(behind.from)));
            }
            Some(jump) if !reversed && mark >= jump => {
                let before = self.pieces.iter().rev().find(|piece| piece.from < jump)?;
                return Some(before.at(jump.min(before.to)));
            }
            // an end may be off by a rounding; fluid that entered in a step and comes back in it is
            // that at the end, and the step is cut where the flow turns
            _ if reversed && mark < first.from - 4.0 * self.same() => return None,
            _ if !reversed && mark > last.to + 4.0 * self.same() => return None,
            _ if reversed => self.pieces.iter().rev().find(|piece| piece.from <= mark),
            _ => self.pieces.iter().find(|piece| piece.to >= mark),
        };
        let piece = piece.unwrap_or(if reversed { first } else { last });
        Some(piece.at(mark.clamp(piece.from, piece.to)))
    }

    /// The edge that leaves next; `None` if there is none in the pipe.
    pub(crate) fn next_edge(&self, reversed: bool) -> Option<Leaving> {
        let (edge, way) = match reversed {
            false => (self.edges.front()?, self.size),
            true => (self.edges.back()?, 0.0),
        };
        Some(Leaving { passed: edge.mark + way, jumps: edge.jumps })
    }

    /// True if an edge has arrived when this amount has passed.
    pub(crate) fn has_come(&self, edge: Leaving, passed: f64, reversed: bool) -> bool {
        let ahead = if reversed { passed - edge.passed } else { edge.passed - passed };
        ahead <= self.same()
    }

    /// Takes in the fluid that entered during a step in which the flow did not reverse. A difference
    /// of more than `apart` in K to the fluid before it is a jump; if the step follows an event, a bend is an
    /// edge too.
    pub(crate) fn enter(&mut self, fluid: Entering, (apart, fresh): (f64, bool)) {
        let Entering { passed, temperatures } = fluid;
        let [start, end] = [passed[0], passed[POINTS - 1]];
        self.passed = end;
        let forward = end > start;
        // pieces of no width would make no difference
        if (end - start).abs() <= f64::EPSILON * (self.size + end.abs()) {
            if forward || end < start {
                self.drop_the_rest(forward);
            }
            return;
        }
        let way = if forward { 0.0 } else { self.size };
        let mut marks = passed.map(|passed| passed - way);
        self.follow_on(&mut marks[0], forward);
        let (from, to) = (marks[0].min(marks[POINTS - 1]), marks[0].max(marks[POINTS - 1]));
        let piece = Piece { from, to, marks, temperatures };
        let edge = self.edge(&piece, forward, (apart, fresh));
        match forward {
            true => {
                self.edges.extend(edge);
                self.pieces.push_back(piece);
            }
            false => {
                edge.into_iter().for_each(|edge| self.edges.push_front(edge));
                self.pieces.push_front(piece);
            }
        }
        self.drop_the_rest(forward);
    }

    /// Moves the first mark of a piece to the end of the one before it: the interpolation at the start
    /// of a step is off by a rounding, and fluid before a jump would be that after it.
    fn follow_on(&self, mark: &mut f64, forward: bool) {
        let end = match forward {
            true => self.pieces.back().map(|piece| piece.to),
            false => self.pieces.front().map(|piece| piece.from),
        };
        if let Some(end) = end.filter(|end| (end - *mark).abs() <= self.same()) {
            *mark = end;
        }
    }

    /// The edge between the fluid at the end that a piece enters and that piece.
    fn edge(&self, piece: &Piece, forward: bool, (apart, fresh): (f64, bool)) -> Option<Edge> {
        let beside = if forward { self.pieces.back()? } else { self.pieces.front()? };
        let mark = piece.marks[0];
        let before = beside.at(if forward { beside.to } else { beside.from });
        if (before - piece.temperatures[0]).abs() > apart {
            return Some(Edge { mark, jumps: true });
        }
        let slopes = [beside, piece].map(|piece| piece.slope_at(mark, NARROW * self.size));
        let bends = match slopes {
            [Some(before), Some(after)] => (after - before).abs() * self.size > BENT * apart,
            _ => true,
        };
        (fresh && bends).then_some(Edge { mark, jumps: false })
    }

    /// Forgets the fluid that has left the pipe. That at the other end has just entered, however little
    /// it is.
    fn drop_the_rest(&mut self, forward: bool) {
        // an edge that has come has left, whatever the rounding
        let (outlet, inlet, same) = (self.passed - self.size, self.passed, 2.0 * self.same());
        match forward {
            true => {
                self.pieces.retain(|piece| piece.to > outlet + same);
                self.edges.retain(|edge| edge.mark > outlet + same);
            }
            false => {
                self.pieces.retain(|piece| piece.from < inlet - same);
                self.edges.retain(|edge| edge.mark < inlet - same);
            }
        }
        if let Some(first) = self.pieces.front_mut() {
            first.from = first.from.max(outlet);
        }
        if let Some(last) = self.pieces.back_mut() {
            last.to = last.to.min(inlet);
        }
    }

    /// The integral of a function of temperature in K over the content.
    pub(crate) fn integral(&self, of: &dyn Fn(f64) -> f64) -> f64 {
        let mut sum = 0.0;
        for piece in &self.pieces {
            let (middle, half) = (0.5 * (piece.from + piece.to), 0.5 * (piece.to - piece.from));
            sum +=
                GAUSS.iter().map(|(x, w)| half * w * of(piece.at(middle + half * x))).sum::<f64>();
        }
        sum
    }
}

#[cfg(test)]
mod tests;
