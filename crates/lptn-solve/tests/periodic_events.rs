//! Periodic states of networks that switch, against cycles that are waited for.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking, in its helpers too")]

use lptn_assembly::ThermalSystem;
use lptn_network::{
    Acts, AfterEnd, Context, Course, End, HeatCapacity, Network, NetworkBuilder, Path, Temperature,
    Thermostat, Time,
};
use lptn_solve::{ControlState, Periodic, PeriodicError, State, Transient};
use lptn_units::{Dimension, Type};

const AMBIENT: f64 = 293.15;
const PERIOD: f64 = 600.0;

/// A gearbox of two nodes under a load of 250 s in 600 s, with a fan that goes on above and off
/// below a temperature.
fn network((on, off): (f64, f64), dwell: f64) -> Network {
    let mut b = NetworkBuilder::new();
    let fan = b.control("fan");
    let gears = b.node("gears", HeatCapacity(500.0), Temperature(AMBIENT));
    let housing = b.node("housing", HeatCapacity(2500.0), Temperature(AMBIENT));
    let air = b.boundary("air", Temperature(AMBIENT));
    let inner = b.expression_in(Context::Link, "8 [W/K]", None).unwrap();
    b.resistor("inner", gears, housing, Path::conductance(inner));
    let g = b.expression_in(Context::Link, "2 [W/K] + 10 [W/K] * fan", None).unwrap();
    b.resistor("skin", housing, air, Path::conductance(g));
    let (times, values) = (vec![0.0, 250.0], vec![600.0, 0.0]);
    let load = Course::Steps { times, values, after: AfterEnd::Repeat(PERIOD) };
    b.signal("load", Type::of(Dimension::POWER), load);
    let load = b.expression_in(Context::Source, "load", None).unwrap();
    b.source("loss", gears, load);
    let (on, off) = (Temperature(AMBIENT + on).into(), Temperature(AMBIENT + off).into());
    let (sense, min_dwell) = (End::Node(housing), Time(dwell).into());
    b.thermostat(fan, Thermostat { sense, acts: Acts::Cooling, on, off, start: false, min_dwell });
    b.build().unwrap()
}

/// The end of so many cycles, one after the other, with the controls there.
fn wait(system: &ThermalSystem, cycles: usize, tolerance: f64) -> (State, Vec<ControlState>, u64) {
    let mut state = State::initial(system);
    let mut settings = Transient::until(Time(PERIOD)).at(&[]).tolerance(tolerance);
    let mut steps = 0;
    for _ in 0..cycles {
        let solution =
            settings.solve_from(system, &state, &mut |_| lptn_solve::Proceed::Continue).unwrap();
        steps += solution.statistics().steps;
        state = solution.last_state().clone();
        let back = |c: &ControlState| ControlState { since: c.since - PERIOD, ..*c };
        settings.controls = solution.controls().iter().map(back).collect();
    }
    (state, settings.controls.clone(), steps)
}

#[test]
fn the_cycle_of_a_fan_is_that_of_200_waited_cycles() {
    for (thresholds, dwell) in [((32.0, 28.0), 0.0), ((32.0, 28.0), 250.0)] {
        let network = network(thresholds, dwell);
        let system = ThermalSystem::assemble(&network).unwrap();
        let found =
            Periodic::find(&system, &Transient::until(Time(PERIOD)).tolerance(1e-8)).unwrap();
        let (waited, controls, steps) = wait(&system, 200, 1e-8);
        assert!(found.state.distance(&waited) < 1e-6, "{} K", found.state.distance(&waited));
        assert_eq!(found.solution.controls()[0].on, controls[0].on);
        assert!(found.solution.events().len() >= 2, "{:?}", found.solution.events());
        assert!(
            found.steps * 10 <= steps,
            "{} of {steps} steps, {} cycles",
            found.steps,
            found.cycles
        );
    }
}

#[test]
fn controls_with_a_rhythm_of_their_own_are_no_cycle() {
    // a fan that goes on and off every 100 s or so, whatever the load
    let network = network((12.0, 11.0), 0.0);
    let system = ThermalSystem::assemble(&network).unwrap();
    let error =
        Periodic::find(&system, &Transient::until(Time(PERIOD)).tolerance(1e-5)).unwrap_err();
    assert!(["periodic::switches", "periodic::not_found"].contains(&error.code()), "{error}");
}

#[test]
fn dwell_times_that_do_not_fit_into_a_cycle_are_no_cycle() {
    // on and off take 350 s each at least, the load comes every 600 s
    let network = network((32.0, 28.0), 350.0);
    let system = ThermalSystem::assemble(&network).unwrap();
    let error =
        Periodic::find(&system, &Transient::until(Time(PERIOD)).tolerance(1e-4)).unwrap_err();
    assert_eq!(error.code(), "periodic::switches");
}

/// A state that adds up a heat never repeats: 10 K and 1 W/K for 60 s are 600 J a cycle. The body
/// forgets its start in 1 s, which is 1 J for each K.
#[test]
fn a_state_that_adds_up_is_named() {
    let text = r#"
format = 1
[node]
a = { C = "1 J/K", T0 = "20 degC" }
[boundary]
air = { T = "20 degC" }
[resistor]
r = { from = "a", to = "air", R = "1 K/W" }
[source]
h = { into = "a", P = "10 W" }
[state]
e = { rate = "1 [W/K] * (a.T - air.T)", start = "0 J", size = "100 J" }
"#;
    let network = lptn_netlist::parse("net.toml", text).unwrap().network;
    let system = ThermalSystem::assemble(&network).unwrap();
    let error = Periodic::find(&system, &Transient::until(Time(60.0)).tolerance(1e-4)).unwrap_err();
    let PeriodicError::NotFound { name, change, unit, .. } = &error else { panic!("{error}") };
    assert_eq!((name.as_str(), unit.as_str()), ("e", "J"));
    assert!((change - 600.0).abs() < 6.0, "{error}");
}
