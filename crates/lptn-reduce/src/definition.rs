//! The four capacities that may stand for a network at a port.

use crate::deviation::Deviation;

/// What the capacity of the one-node equivalent is to be equal in. `R_eq` is the same for all.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Definition {
    /// The heat stored when all nodes are equally warm: the sum of the capacities that heat from
    /// the port reaches.
    Sum,
    /// The first moment of the impulse response, `m1 / R_eq^2` with `m1 = sum of C_k R_pk^2`: the
    /// area between the step response and its final value.
    FirstMoment,
    /// The slowest time constant that the port sees, `tau_1 / R_eq`.
    DominantPole,
    /// The step response over a window, by least squares.
    LeastSquares,
}

impl Definition {
    /// All of them, the simplest first.
    pub const ALL: [Self; 4] =
        [Self::Sum, Self::FirstMoment, Self::DominantPole, Self::LeastSquares];

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
    /// Largest error for the network's own sources, boundaries and run; `None` where no run was
    /// given.
    pub run: Option<Deviation>,
}

/// The pair to use.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Recommended {
    /// The definition whose capacity is recommended.
    pub definition: Definition,
    /// Whether it has the smallest error of the run, or else of the unit step.
    pub by_run: bool,
}

/// The pair with the smallest error; of pairs that differ by less than the noise of the run or of
/// the step, both in K, the simplest.
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Pairs with these errors in K of the step and of the run; no run where it is not finite.
    fn pairs(of_step: [f64; 4], of_run: [f64; 4]) -> [Pair; 4] {
        let deviation =
            |kelvin: f64| Deviation { kelvin, relative: Some(kelvin / 50.0), time: 1.0 };
        [0, 1, 2, 3].map(|k| Pair {
            definition: Definition::ALL[k],
            capacity: 1.0,
            step: deviation(of_step[k]),
            run: Some(deviation(of_run[k])).filter(|run| run.kelvin.is_finite()),
        })
    }

    const NO_RUN: [f64; 4] = [f64::NAN; 4];

    #[test]
    fn the_run_decides_where_there_is_one() {
        let found = recommended(&pairs([1.0, 2.0, 3.0, 4.0], [4.0, 3.0, 1.0, 2.0]), (0.1, 0.1));
        assert_eq!(found, Recommended { definition: Definition::DominantPole, by_run: true });
        let found = recommended(&pairs([2.0, 1.0, 3.0, 4.0], NO_RUN), (0.1, 0.1));
        assert_eq!(found, Recommended { definition: Definition::FirstMoment, by_run: false });
    }

    /// A run in which nothing rises has no share of the rise: it cannot decide.
    #[test]
    fn a_run_in_which_nothing_rises_decides_nothing() {
        let mut still = pairs([2.0, 3.0, 4.0, 1.0], [0.0; 4]);
        for pair in &mut still {
            pair.run = Some(Deviation { kelvin: 0.0, relative: None, time: 0.0 });
        }
        let found = recommended(&still, (0.0, 0.0));
        assert_eq!(found, Recommended { definition: Definition::LeastSquares, by_run: false });
    }

    #[test]
    fn within_the_noise_the_simplest_is_taken() {
        let definition = |errors: [f64; 4], noise| {
            recommended(&pairs(NO_RUN.map(|_| 9.0), errors), noise).definition
        };
        assert_eq!(definition([1.0, 0.9, 0.9, 0.8], (0.3, 0.0)), Definition::Sum);
        assert_eq!(definition([1.0, 0.9, 0.9, 0.8], (0.15, 0.0)), Definition::LeastSquares);
        assert_eq!(definition([1.0, 0.5, 0.5, 0.5], (0.0, 9.0)), Definition::FirstMoment);
        // better by exactly the noise is not better
        assert_eq!(definition([1.0, 0.5, 0.5, 0.5], (0.5, 0.0)), Definition::Sum);
        let by_step = recommended(&pairs([1.0, 0.9, 0.8, 0.7], NO_RUN), (0.0, 0.25));
        assert_eq!(by_step.definition, Definition::LeastSquares);
    }
}
