//! The four capacities that may stand for a network at a port.

use crate::deviation::Deviation;

/// What the capacity of the one-node equivalent is to be equal in. `R_eq` is the same for all.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Definition {
    /// The heat stored when all nodes are equally warm: the sum of the capacities that heat from the port reaches.
    Sum,
    /// The first moment of the impulse response, `m1 / R_eq^2` with `m1 = sum of C_k R_pk^2`: the area between
    /// the step response and its final value.
    FirstMoment,
    /// The slowest time constant that the port sees, `tau_1 / R_eq`.
    DominantPole,
    /// The step response over a window, by least squares.
    LeastSquares,
}

impl Definition {
    /// All of them, the simplest first.
    pub const ALL: [Self; 4] = [Self::Sum, Self::FirstMoment, Self::DominantPole, Self::LeastSquares];

    /// The name in results and on the command line.
    pub fn key(self) -> &'static str {
        match self {
            Self::Sum => "sum",
            Self::FirstMoment => "first_moment",
            Self::DominantPole => "dominant_pole",
            Self::LeastSquares => "least_squares",
        }
    }
}

/// A capacity that goes with `R_eq`, and what the two are worth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pair {
    /// What the capacity is equal in.
    pub definition: Definition,
    /// `C_eq` in J/K; 0 where the least squares of a massless port are those of no capacity.
    pub capacity: f64,
    /// Largest error for a step of 1 W at the port; the rise is `R_eq` times 1 W.
    pub step: Deviation,
    /// Largest error for the network's own sources, boundaries and run; `None` where no run was given.
    pub run: Option<Deviation>,
}

/// The pair to use.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Recommended {
    /// Its definition.
    pub definition: Definition,
    /// Whether it has the smallest error of the run, or else of the unit step.
    pub by_run: bool,
}

/// The pair with the smallest error; of pairs that differ by less than the noise of the run or of the step, both
/// in K, the simplest.
pub(crate) fn recommended(pairs: &[Pair; 4], (of_run, of_step): (f64, f64)) -> Recommended {
    let by_run = pairs.iter().all(|pair| pair.run.is_some_and(|run| run.relative.is_some()));
    let error = |pair: &Pair| match pair.run {
        Some(run) if by_run => run.kelvin,
        _ => pair.step.kelvin,
    };
    let noise = if by_run { of_run } else { of_step };
    let mut best = &pairs[0];
    for pair in &pairs[1..] {
        if error(pair) < error(best) - noise {
            best = pair;
        }
    }
    Recommended { definition: best.definition, by_run }
}
