//! A start that is known to be off: bounds that ignore it have to be noticed.

use lptn_assembly::ThermalSystem;
use lptn_network::{
    Conductance, HeatCapacity, HeatFlow, NetworkBuilder, OutputTimes, Temperature, Time,
};

use super::*;
use crate::settings::{Proceed, Transient};

const AIR: f64 = 300.0;
/// Distance of the start from the periodic steady state in K.
const OFF: f64 = 1.0;

/// 100 J/K and 1 W/K with 5 W, which is 5 K above the air at all times.
fn body() -> ThermalSystem {
    let mut b = NetworkBuilder::new();
    let node = b.node("body", HeatCapacity(100.0), Temperature(AIR));
    let air = b.boundary("air", Temperature(AIR));
    b.resistor("skin", node, air, Conductance(1.0));
    b.source("heat", node, HeatFlow(5.0));
    let network = b.build().unwrap_or_else(|errors| panic!("{errors}"));
    ThermalSystem::assemble(&network).unwrap_or_else(|error| panic!("{error}"))
}

/// The proof for a cycle of 50 s from a start that is off, and the result of `ask`.
fn with<T>(ask: impl FnOnce(&mut Proof<'_, '_>) -> T) -> T {
    let system = body();
    let settings = Transient {
        certify: true,
        output: OutputTimes::At(Vec::new()),
        ..Transient::until(Time(50.0))
    };
    let observer = &mut |_| Proceed::Continue;
    let mut cycles = Cycles::new(&system, &settings, observer);
    let start = vec![AIR + 5.0 + OFF];
    ask(&mut Proof::new(&mut cycles, (start.clone(), 1e-6), start))
}

/// The end of a cycle from these bounds: with the closing difference, and the bounds alone.
fn ends(proof: &mut Proof<'_, '_>, bounds: f64) -> [f64; 2] {
    let solution = proof.cycle(vec![bounds], false).unwrap_or_else(|error| panic!("{error}"));
    let whole = returned(&solution, &proof.centre).unwrap_or_else(|reason| panic!("{reason}"));
    let Some(Ok(certificate)) = solution.certificate() else { panic!("no bounds") };
    [whole[0], certificate.end[1][0]]
}

#[test]
fn bounds_are_not_less_than_the_distance() {
    let bounds = with(|proof| proof.proposed().unwrap_or_else(|error| panic!("{error}")));
    let bounds = bounds.unwrap_or_else(|reason| panic!("{reason}"));
    assert!((OFF..1.5 * OFF).contains(&bounds[0]), "{bounds:?}");
}

/// After 50 s a start that is 0.9 K to one side is left with 0.9 exp(-1/2) of that, and the
/// closing difference is 1 - exp(-1/2).
#[test]
fn a_missing_closing_difference_is_noticed() {
    let kept = (-0.5_f64).exp();
    with(|proof| {
        let [whole, alone] = ends(proof, 0.9 * OFF);
        let right = (0.9 * kept + (1.0 - kept)) * OFF;
        assert!((right..1.1 * right).contains(&whole), "{whole}");
        let fails = |end: f64| proof.not_shrunk(&[0.9 * OFF], &[end]).is_some();
        assert!(fails(whole));
        assert!(!fails(alone), "the mutant would not be noticed");
        assert!(!fails(alone + 0.5 * (whole - alone)), "nor one with half of it");
    });
    with(|proof| {
        let [whole, _] = ends(proof, 1.4 * OFF);
        assert!(proof.not_shrunk(&[1.4 * OFF], &[whole]).is_none(), "{whole}");
    });
}

#[test]
fn a_share_of_one_proves_nothing() {
    with(|proof| {
        assert!(proof.not_shrunk(&[1.0], &[1.0]).is_some());
        assert!(proof.not_shrunk(&[1.0], &[f64::NAN]).is_some());
        assert!(proof.not_shrunk(&[1.0], &[0.999]).is_none());
    });
}
