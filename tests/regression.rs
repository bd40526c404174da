//! One test for each fixed mistake.

mod support;

use lptn::prelude::*;
use lptn::solve::{End, TransientError, Watch};
use support::assembled;

/// The ledger of a run that broke off held no heat of sources and boundaries at all.
#[test]
fn ledger_of_a_broken_run_holds_what_was_done() {
    let mut b = NetworkBuilder::new();
    let node = b.node("mass", HeatCapacity(100.0), Temperature::celsius(20.0));
    let air = b.boundary("air", Temperature::celsius(20.0));
    b.resistor("path", node, air, Conductance(1.0));
    let heat = b.expression("1 [W/s^0.5] * (300 [s] - t)^0.5", None).unwrap();
    b.source("fading", node, heat);
    let error = Transient::until(Time(400.0)).every(Time(10.0)).solve(&assembled(b)).unwrap_err();
    let TransientError::Stopped { time, partial, .. } = error else { panic!("{error}") };
    assert!(time > 250.0 && time <= 300.0, "stopped at {time} s");
    assert_eq!(partial.end(), End::Failed(time));
    let ledger = partial.ledger();
    let exact = (300_f64.powf(1.5) - (300.0 - time).powf(1.5)) * 2.0 / 3.0;
    assert!((ledger.sources[0] - exact).abs() < 1e-3 * exact, "{} J of {exact} J", ledger.sources[0]);
    assert!(ledger.relative_residual().unwrap().abs() < 1e-8);
}

/// Watches of a network without state kept the temperature of the start as peak and end.
#[test]
fn watches_of_a_network_without_state_see_peak_and_end() {
    let mut b = NetworkBuilder::new();
    let middle = b.massless("middle");
    let swing = b.expression("20 [degC] + 10 [K] * sin(2 * pi * t / 100 [s])", None).unwrap();
    let (left, right) = (b.boundary("left", swing), b.boundary("right", Temperature::celsius(20.0)));
    b.resistor("a", left, middle, Conductance(1.0));
    b.resistor("b", middle, right, Conductance(1.0));
    let mut run = Transient::until(Time(60.0)).every(Time(10.0));
    run.watch = vec![Watch { node: middle, level: Some(273.15 + 22.0) }];
    let seen = run.solve(&assembled(b)).unwrap().seen()[0];
    let omega = std::f64::consts::PI / 50.0;
    assert!((seen.peak.0 - 298.15).abs() < 1e-3 && (seen.peak.1 - 25.0).abs() < 0.1, "{seen:?}");
    assert!((seen.last() - 293.15 - 5.0 * (omega * 60.0).sin()).abs() < 1e-9);
    assert!((seen.crossed.unwrap() - 0.4_f64.asin() / omega).abs() < 0.01);
}

/// A massless node that leaps at a jump of its source crosses its level at that time, not before.
#[test]
fn a_leap_over_a_level_has_the_time_of_the_jump() {
    let mut b = NetworkBuilder::new();
    let sink = b.node("sink", HeatCapacity(1000.0), Temperature::celsius(20.0));
    let junction = b.massless("junction");
    let air = b.boundary("air", Temperature::celsius(20.0));
    b.resistor("package", junction, sink, Resistance(1.0));
    b.resistor("fins", sink, air, Resistance(1.0));
    let step = b.expression("if(t < 100 [s], 0 [W], 30 [W])", None).unwrap();
    b.source("step", junction, step);
    let mut run = Transient::until(Time(200.0)).every(Time(50.0));
    run.watch = vec![Watch { node: junction, level: Some(273.15 + 40.0) }];
    let seen = run.solve(&assembled(b)).unwrap().seen()[0];
    assert!((seen.crossed.unwrap() - 100.0).abs() < 1e-9, "{seen:?}");
}
