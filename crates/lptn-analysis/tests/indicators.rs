//! Event indicators of a simulation against the closed form of one body.
//!
//! A body with capacity C joined to air by G and heated by P obeys `T = Te + (T0 - Te) exp(-t G/C)`
//! with `Te = T_air + P/G`.

use lptn_analysis::{Simulation, SimulationError};
use lptn_network::{
    Acts, Bound, Conductance, Context, Functional, HeatCapacity, IntegratorChoice, LimitSeverity,
    Network, NetworkBuilder, OutputTimes, OverTime, RunSettings, Temperature, Thermostat, Time,
};
use lptn_solve::{EventIndicator, EventKind, PositiveSide, Unsolved};
use lptn_units::Type;

const C: f64 = 600.0;
const G: f64 = 3.0;
const AIR: f64 = 293.15;
/// Rise in K of a steady state with 240 W.
const RISE: f64 = 80.0;
const TOLERANCE: f64 = 1e-7;

/// Time in s from one rise above the air to another under full power.
fn takes(from: f64, to: f64) -> f64 {
    C / G * ((RISE - from) / (RISE - to)).ln()
}

/// A heater that is on below 38 K above the air and off above 42 K, a fan by a comparison at 30 K,
/// and limits of 40 K, of a heat flow and of a mean.
fn network(dwell: f64) -> Network {
    let mut b = NetworkBuilder::new();
    let heater = b.control("heater");
    let body = b.node("body", HeatCapacity(C), Temperature(AIR));
    let air = b.boundary("air", Temperature(AIR));
    b.resistor("skin", body, air, Conductance(G));
    let power = b.expression_in(Context::Source, "240 [W] * heater", None).unwrap();
    b.source("element", body, power);
    // no heat, but a comparison
    let fan = "if(body.T < 50 [degC], 0 [W], 0 [W] * (body.T - 0 [degC]) / 1 [K])";
    let fan = b.expression_in(Context::Source, fan, None).unwrap();
    b.source("fan", body, fan);
    let kelvin = |rise: f64| Temperature(AIR + rise).into();
    let sense = body.into();
    let (on, off, min_dwell) = (kelvin(38.0), kelvin(42.0), Time(dwell).into());
    let acts = Acts::Heating;
    b.thermostat(heater, Thermostat { sense, acts, on, off, start: true, min_dwell });
    let result = |b: &mut NetworkBuilder, text: &str| b.post_expression(text, None).unwrap();
    let (of, value) = (result(&mut b, "body.T"), result(&mut b, "60 [degC]"));
    let error = LimitSeverity::Error;
    b.limit("warm", (of.into(), "body.T"), (Bound::Below, value.into()), error);
    let (of, value) = (result(&mut b, "skin.Q"), result(&mut b, "10 [W]"));
    b.limit("flow", (of.into(), "skin.Q"), (Bound::Above, value.into()), error);
    let (of, value) = (result(&mut b, "body.T"), result(&mut b, "60 [degC]"));
    let mean = b.limit("usual", (of.into(), "body.T"), (Bound::Below, value.into()), error);
    let of_ty = Type::ABSOLUTE_TEMPERATURE;
    let functional = Functional::Mean;
    b.limit_over_time(mean, OverTime { functional, of_ty, life: None });
    b.build().unwrap()
}

fn settings() -> RunSettings {
    RunSettings {
        stop: 1000.0,
        output: OutputTimes::Every(100.0),
        integrator: IntegratorChoice::Auto,
        tolerance: TOLERANCE,
        ..RunSettings::cycle(None, 1000.0)
    }
}

fn simulation(dwell: f64) -> Simulation {
    Simulation::new(&network(dwell), &settings()).unwrap()
}

fn named(simulation: &Simulation, name: &str) -> EventIndicator {
    let all = simulation.event_indicators().unwrap();
    all.into_iter().find(|indicator| indicator.name == name).unwrap()
}

#[track_caller]
fn assert_near(found: f64, expected: f64) {
    assert!((found - expected).abs() < 10.0 * TOLERANCE, "{found}, not {expected}");
}

#[test]
fn each_has_its_name_unit_and_side() {
    let simulation = simulation(0.0);
    let found = simulation.event_indicators().unwrap();
    let told: Vec<(&str, &str, PositiveSide)> =
        found.iter().map(|one| (&*one.name, &*one.unit, one.positive)).collect();
    let expected = [
        ("heater", "K", PositiveSide::SwitchesOff),
        ("fan.P", "K", PositiveSide::IsTrue),
        ("warm", "K", PositiveSide::Kept),
        ("flow", "W", PositiveSide::Kept),
    ];
    assert_eq!(told, expected);
    for (indicator, expected) in found.iter().zip([-42.0, 30.0, 40.0, -10.0]) {
        assert_near(indicator.value, expected);
        assert_eq!(indicator.stays_until, None);
    }
    assert!(matches!(found[0].kind, EventKind::Control(_)));
    assert!(matches!(found[1].kind, EventKind::Comparison(_)));
    assert!(matches!(found[2].kind, EventKind::Limit(_)));
}

#[test]
fn a_thermostat_has_zero_at_its_event_and_then_waits_for_the_other_threshold() {
    let off_at = takes(0.0, 42.0);
    let mut at_event = simulation(0.0);
    at_event.advance(Time(off_at), &[]).unwrap();
    // at this time the run has just switched, or is just about to
    let there = named(&at_event, "heater");
    let value = if there.positive == PositiveSide::SwitchesOff { 0.0 } else { -4.0 };
    assert_near(there.value, value);
    let mut simulation = simulation(0.0);
    simulation.advance(Time(off_at - 1.0), &[]).unwrap();
    let before = named(&simulation, "heater");
    let rise = |t: f64| RISE * (1.0 - (-t * G / C).exp());
    assert_eq!(before.positive, PositiveSide::SwitchesOff);
    assert_near(before.value, rise(off_at - 1.0) - 42.0);
    let run = simulation.advance(Time(off_at + 1.0), &[]).unwrap();
    let switched: Vec<f64> = run
        .events()
        .iter()
        .filter(|event| matches!(event.kind, EventKind::Control(_)))
        .map(|event| event.time)
        .collect();
    assert!(switched.len() == 1 && (switched[0] - off_at).abs() < 1e-5, "{switched:?}");
    let after = named(&simulation, "heater");
    assert_eq!(after.positive, PositiveSide::SwitchesOn);
    assert_near(after.value, 38.0 - 42.0 * (-G / C).exp());
    // the heater is off, so the body cools: the rates know it
    assert_near(simulation.rates().unwrap().states[0], -G / C * 42.0 * (-G / C).exp());
}

/// States around an event, with the position from before. A simulator that integrates itself sees
/// these.
#[test]
fn the_indicator_goes_through_zero_with_the_position_from_before() {
    let simulation = simulation(0.0);
    let mut last = f64::NEG_INFINITY;
    for by in [-1.0, -1e-3, 0.0, 1e-3, 1.0] {
        let mut saved = simulation.save();
        saved.carried[0] = AIR + 42.0 + by;
        let mut other = simulation.clone();
        other.restore(&saved).unwrap();
        let value = named(&other, "heater").value;
        assert!((value - by).abs() < 1e-12 && value > last, "{value} for {by}");
        last = value;
        assert_near(other.rates().unwrap().states[0], (240.0 - G * (42.0 + by)) / C);
    }
}

#[test]
fn comparisons_and_limits_have_zero_at_their_events() {
    let at = |rise: f64| {
        let mut simulation = simulation(0.0);
        simulation.advance(Time(takes(0.0, rise)), &[]).unwrap();
        simulation
    };
    let compared = 323.15 - AIR;
    assert_near(named(&at(compared), "fan.P").value, 0.0);
    assert_near(named(&at(compared + 1.0), "fan.P").value, -1.0);
    assert_near(named(&at(40.0), "warm").value, 0.0);
    assert_near(named(&at(41.0), "warm").value, -1.0);
    // 3 W/K times its rise
    let margin = named(&at(10.0 / G), "flow").value;
    assert!(margin.abs() < 10.0 * G * TOLERANCE, "{margin}");
}

#[test]
fn a_control_says_how_long_it_stays() {
    let mut simulation = simulation(500.0);
    let off_at = takes(0.0, 42.0);
    simulation.advance(Time(off_at + 100.0), &[]).unwrap();
    let stays = named(&simulation, "heater");
    // it cooled below 38 K, and may not switch on yet
    assert_eq!(stays.positive, PositiveSide::SwitchesOn);
    assert!(stays.value > 0.0);
    let until = stays.stays_until.unwrap();
    assert!((until - off_at - 500.0).abs() < 1e-5, "{until}");
    simulation.advance(Time(off_at + 501.0), &[]).unwrap();
    let on = named(&simulation, "heater");
    assert_eq!(on.positive, PositiveSide::SwitchesOff);
    assert!(on.stays_until.is_some());
}

/// A massless node that is warm only while a comparison says that it is cold.
#[test]
fn comparisons_without_a_truth_are_told() {
    let mut b = NetworkBuilder::new();
    let node = b.massless("node");
    let air = b.boundary("air", Temperature(AIR));
    b.resistor("skin", node, air, Conductance(G));
    let power = "if(node.T < 50 [degC], 240 [W], 0 [W])";
    let power = b.expression_in(Context::Source, power, None).unwrap();
    b.source("element", node, power);
    let refused = Simulation::new(&b.build().unwrap(), &settings());
    let Err(SimulationError::Rates(Unsolved::Restless { names })) = refused else {
        panic!("{refused:?}")
    };
    assert_eq!(names, ["element.P"]);
}
