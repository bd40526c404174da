//! The four capacities that may represent a network at a port.

use crate::deviation::Deviation;

lptn_units::words! {
/// Property that the one-node equivalent's capacity preserves. `R_eq` is the same for all.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Definition {
    /// The heat stored when all nodes are equally warm: the sum of the capacities that heat from
    /// the port reaches.
    Sum = "sum",
    /// The first moment of the impulse response, `m1 / R_eq^2` with `m1 = sum of C_k R_pk^2`: the
    /// area between the step response and its final value.
    FirstMoment = "first_moment",
    /// The slowest time constant that the port sees, `tau_1 / R_eq`.
    DominantPole = "dominant_pole",
    /// The step response over a window, by least squares.
    LeastSquares = "least_squares",
}
/// The name in results and on the command line.
pub fn key;
}

/// A capacity that goes with `R_eq`, and the errors of the two.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pair {
    /// The property that the capacity preserves.
    pub definition: Definition,
    /// `C_eq` in J/K; 0 if no capacity has the least squares, at a massless port.
    pub capacity: f64,
    /// Largest error for a step of 1 W at the port; the rise is `R_eq` times 1 W. `None` if streams
    /// go on from node to node: the step is then not a sum of falling exponentials.
    pub step: Option<Deviation>,
    /// Largest error for the network's own sources, boundaries and run; `None` if no run was given.
    pub run: Option<Deviation>,
}

lptn_units::words! {
/// The criterion for a pair.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Judge {
    /// A step of heat at the port and all times after it: the same for every run.
    #[default]
    Step = "step",
    /// The network's own run.
    Run = "run",
}
/// The word for it in results and on the command line.
pub fn key;
}

/// The pair to use.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Recommended {
    /// The definition whose capacity is recommended.
    pub definition: Definition,
    /// The criterion by which its error is smallest; `None` if there is none.
    pub by: Option<Judge>,
}

/// The pair with the smallest error by the wanted criterion, or else by one that is available. Of
/// pairs that differ by less than the noise of the run or of the step, both in K, the simplest.
pub(crate) fn recommended(
    pairs: &[Pair],
    wanted: Judge,
    (of_run, of_step): (f64, f64),
) -> Recommended {
    let error = |pair: &Pair, judge: Judge| match judge {
        Judge::Run => pair.run.filter(|run| run.relative.is_some()),
        Judge::Step => pair.step,
    };
    let known = |judge: &Judge| pairs.iter().all(|pair| error(pair, *judge).is_some());
    let Some(by) = [wanted, Judge::Step, Judge::Run].into_iter().find(known) else {
        // the first moment is exact in the mean over every load
        return Recommended { definition: Definition::FirstMoment, by: None };
    };
    let noise = if by == Judge::Run { of_run } else { of_step };
    let kelvin = |pair: &Pair| error(pair, by).map_or(f64::INFINITY, |d| d.kelvin);
    let mut best = &pairs[0];
    for pair in &pairs[1..] {
        if kelvin(pair) < kelvin(best) - noise {
            best = pair;
        }
    }
    Recommended { definition: best.definition, by: Some(by) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Pairs with these errors in K of the step and of the run; no run if it is not finite.
    fn pairs(of_step: [f64; 4], of_run: [f64; 4]) -> [Pair; 4] {
        let deviation = |kelvin: f64| Deviation {
            kelvin,
            relative: Some(kelvin / 50.0),
            time: 1.0,
            signed: kelvin,
            good_from: None,
        };
        [0, 1, 2, 3].map(|k| Pair {
            definition: Definition::ALL[k],
            capacity: 1.0,
            step: Some(deviation(of_step[k])),
            run: Some(deviation(of_run[k])).filter(|run| run.kelvin.is_finite()),
        })
    }

    const NO_RUN: [f64; 4] = [f64::NAN; 4];

    fn found(definition: Definition, by: Judge) -> Recommended {
        Recommended { definition, by: Some(by) }
    }

    #[test]
    fn the_run_decides_where_it_is_asked_for() {
        let both = pairs([1.0, 2.0, 3.0, 4.0], [4.0, 3.0, 1.0, 2.0]);
        let by = |judge| recommended(&both, judge, (0.1, 0.1));
        assert_eq!(by(Judge::Run), found(Definition::DominantPole, Judge::Run));
        assert_eq!(by(Judge::Step), found(Definition::Sum, Judge::Step));
        let none = recommended(&pairs([2.0, 1.0, 3.0, 4.0], NO_RUN), Judge::Run, (0.1, 0.1));
        assert_eq!(none, found(Definition::FirstMoment, Judge::Step));
    }

    /// A run without a rise has no share of the rise and cannot decide.
    #[test]
    fn a_run_in_which_nothing_rises_decides_nothing() {
        let mut still = pairs([2.0, 3.0, 4.0, 1.0], [0.0; 4]);
        for pair in &mut still {
            pair.run = pair.run.map(|run| Deviation { kelvin: 0.0, relative: None, ..run });
        }
        let by_step = found(Definition::LeastSquares, Judge::Step);
        assert_eq!(recommended(&still, Judge::Run, (0.0, 0.0)), by_step);
        still.iter_mut().for_each(|pair| pair.step = None);
        let nothing = Recommended { definition: Definition::FirstMoment, by: None };
        assert_eq!(recommended(&still, Judge::Run, (0.0, 0.0)), nothing);
    }

    #[test]
    fn within_the_noise_the_simplest_is_taken() {
        let definition = |errors: [f64; 4], noise| {
            recommended(&pairs(NO_RUN.map(|_| 9.0), errors), Judge::Run, noise).definition
        };
        assert_eq!(definition([1.0, 0.9, 0.9, 0.8], (0.3, 0.0)), Definition::Sum);
        assert_eq!(definition([1.0, 0.9, 0.9, 0.8], (0.15, 0.0)), Definition::LeastSquares);
        assert_eq!(definition([1.0, 0.5, 0.5, 0.5], (0.0, 9.0)), Definition::FirstMoment);
        // better by exactly the noise is not better
        assert_eq!(definition([1.0, 0.5, 0.5, 0.5], (0.5, 0.0)), Definition::Sum);
        let steps = pairs([1.0, 0.9, 0.8, 0.7], NO_RUN);
        let by_step = recommended(&steps, Judge::Step, (0.0, 0.25));
        assert_eq!(by_step.definition, Definition::LeastSquares);
    }
}
