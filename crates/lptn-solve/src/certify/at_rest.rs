//! A network at rest whose way lacks a heat, so that its error is known: wrong bounds have to be
//! noticed. A bound that is never exceeded is worth nothing if half of it is not either.

use lptn_assembly::ThermalSystem;
use lptn_network::{Conductance, HeatCapacity, HeatFlow, NetworkBuilder, Temperature};

/// Error of the bound.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Wrong {
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
pub(super) const DEFECT: f64 = 0.01;

/// Two nodes of 10 J/K, joined by 1 W/K, the second tied to air by 1.5 W/K, 6 W into the first, at
/// rest from the start on.
pub(super) fn at_rest() -> (ThermalSystem, [f64; 2]) {
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
pub(super) fn errors(time: f64) -> [f64; 2] {
    let share = |rate: f64| -(-rate * time / 10.0).exp_m1() / rate * DEFECT / 5.0;
    let (slow, fast) = (2.0 * share(0.5), share(3.0));
    [2.0 * slow + fast, slow - 2.0 * fast]
}

/// Turns the sign of all slopes in W/K but those of the diagonal.
pub(super) fn turn(system: &ThermalSystem, slopes: &mut [f64]) {
    let diagonal = [0, 1].map(|i| system.pattern().diagonal_slot(i));
    let others = slopes.iter_mut().enumerate().filter(|(slot, _)| !diagonal.contains(slot));
    others.for_each(|(_, slope)| *slope = -*slope);
}

/// Checks the least share of bound over error.
pub(super) fn notices(least_share: impl Fn(Wrong) -> f64) {
    let right = least_share(Wrong::Nothing);
    assert!((1.0..1.3).contains(&right), "{right}");
    for wrong in [Wrong::HalvedDefect, Wrong::SkippedStep, Wrong::Sign] {
        let share = least_share(wrong);
        assert!(share < 0.99, "{wrong:?} is not noticed: {share}");
    }
}
