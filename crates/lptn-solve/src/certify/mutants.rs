//! Wrong bounds that have to be noticed: a bound that is never exceeded is worth nothing if half of
//! it is not either.

use lptn_assembly::ThermalSystem;
use lptn_network::{Conductance, HeatCapacity, HeatFlow, NetworkBuilder, Temperature};

use super::Certifier;
use super::results::Rows;
use super::way::{SAMPLES, Way, basis, places};
use crate::readings::Readings;
use crate::times::Segment;

/// Error of the bound.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Wrong {
    Nothing,
    /// Half of the defect counts.
    HalvedDefect,
    /// The second step does not count.
    SkippedStep,
    /// A warmer neighbour cools.
    Sign,
}

const AIR: f64 = 300.0;
/// The defect of the first node in W.
const DEFECT: f64 = 0.01;
const STEP: f64 = 2.0;

/// Two nodes of 10 J/K, joined by 1 W/K, the second tied to air by 1.5 W/K, 6 W into the first, at
/// rest from the start on.
fn at_rest() -> (ThermalSystem, [f64; 2]) {
    let rest = [AIR + 6.0 / 1.5 + 6.0, AIR + 6.0 / 1.5];
    let mut b = NetworkBuilder::new();
    let node = |b: &mut NetworkBuilder, i: usize| {
        b.node(&format!("n{i}"), HeatCapacity(10.0), Temperature(rest[i]))
    };
    let (first, second) = (node(&mut b, 0), node(&mut b, 1));
    let air = b.boundary("air", Temperature(AIR));
    b.resistor("between", first, second, Conductance(1.0));
    b.resistor("out", second, air, Conductance(1.5));
    b.source("heat", first, HeatFlow(6.0));
    let network = b.build().unwrap_or_else(|errors| panic!("{errors}"));
    (ThermalSystem::assemble(&network).unwrap_or_else(|error| panic!("{error}")), rest)
}

/// Errors at a time in s if the first node lacks [`DEFECT`]: `10 e' = [[-1, 1], [1, -2.5]] e +
/// (DEFECT, 0)`, whose matrix has the eigenvalues -1/2 and -3 with the vectors (2, 1) and (1, -2).
fn errors(time: f64) -> [f64; 2] {
    let share = |rate: f64| -(-rate * time / 10.0).exp_m1() / rate * DEFECT / 5.0;
    let (slow, fast) = (2.0 * share(0.5), share(3.0));
    [2.0 * slow + fast, slow - 2.0 * fast]
}

/// The least share of bound over error, after the first step.
fn least_share(wrong: Wrong) -> f64 {
    let (system, rest) = at_rest();
    let way_at = |time: f64| {
        let errors = errors(time);
        vec![rest[0] - errors[0], rest[1] - errors[1]]
    };
    let recorded: Vec<_> = system.network().node_ids().collect();
    let rows = Rows {
        recorded: &recorded,
        columns: Vec::new(),
        times: &[0.0, 100.0],
        readings: &Readings::none(Segment { from: 0.0, to: 100.0 }),
    };
    let mut certifier =
        Certifier::new(&system, rows, (&rest, 1e-5)).unwrap_or_else(|reason| panic!("{reason}"));
    let mut slopes = certifier.constant.take().unwrap_or_default();
    if wrong == Wrong::Sign {
        let diagonal = [0, 1].map(|i| system.pattern().diagonal_slot(i));
        let others = slopes.iter_mut().enumerate().filter(|(slot, _)| !diagonal.contains(slot));
        others.for_each(|(_, slope)| *slope = -*slope);
    }
    let mut least = f64::INFINITY;
    for step in 0..30 {
        let (from, to) = (STEP * f64::from(step), STEP * f64::from(step + 1));
        let times = places::<SAMPLES>().map(|place| from + 0.5 * STEP * (1.0 + place));
        let way = Way::through(&times.map(way_at), &basis());
        let found = certifier.defect(((from, to), from), &way);
        let (mut defect, _) = found.unwrap_or_else(|reason| panic!("{reason}"));
        if wrong == Wrong::HalvedDefect {
            defect.iter_mut().for_each(|defect| *defect *= 0.5);
        }
        if wrong != Wrong::SkippedStep || step != 1 {
            let line = certifier.bound.over(STEP, &slopes, &defect);
            certifier.bound.go(&line.unwrap_or_else(|| panic!("{wrong:?} at {from} s")));
        }
        let pairs = certifier.bound.now().iter().zip(errors(to));
        least = pairs.map(|(bound, error)| bound / error).fold(least, f64::min);
    }
    least
}

#[test]
fn a_wrong_bound_is_exceeded() {
    let right = least_share(Wrong::Nothing);
    assert!((1.0..1.3).contains(&right), "{right}");
    for wrong in [Wrong::HalvedDefect, Wrong::SkippedStep, Wrong::Sign] {
        let share = least_share(wrong);
        assert!(share < 0.99, "{wrong:?} is not noticed: {share}");
    }
}
