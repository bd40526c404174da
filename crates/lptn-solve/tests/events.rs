//! Events against closed forms: thermostats, comparisons of temperatures, limits.
//!
//! One node with capacity C joined to an ambient at Ta by G and heated by P obeys
//! `T = Te + (T0 - Te) exp(-t/tau)` with `tau = C/G` and `Te = Ta + P/G`: it takes
//! `tau ln((Te - T1)/(Te - T2))` from T1 to T2.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking, in its helpers too")]

use lptn_assembly::ThermalSystem;
use lptn_network::{
    Acts, Conductance, Context, End, HeatCapacity, HeatFlow, Input, Network, NetworkBuilder, Path,
    Temperature, Thermostat, Time,
};
use lptn_solve::{Event, EventKind, Solution, StopReason, Transient, TransientError, Unbounded};

const AMBIENT: f64 = 293.15;
const TAU: f64 = 200.0; // 600 J/K over 3 W/K
const RISE: f64 = 80.0; // 240 W over 3 W/K

/// Time in s from one temperature above the ambient to another, heated or not.
fn takes(from: f64, to: f64, heated: bool) -> f64 {
    let end = if heated { RISE } else { 0.0 };
    TAU * ((end - from) / (end - to)).ln()
}

/// A heater of 240 W on one node, switched by `heater`; temperatures in K above the ambient.
struct Heater {
    start_at: f64,
    start_on: bool,
    on_below: &'static str,
    off_above: &'static str,
    dwell: f64,
}

impl Heater {
    fn usual() -> Self {
        let (on_below, off_above) = ("58 [degC]", "62 [degC]");
        Self { start_at: 0.0, start_on: true, on_below, off_above, dwell: 0.0 }
    }

    fn network(&self) -> Network {
        let mut b = NetworkBuilder::new();
        let heater = b.control("heater");
        let body = b.node("body", HeatCapacity(600.0), Temperature(AMBIENT + self.start_at));
        let air = b.boundary("air", Temperature(AMBIENT));
        b.resistor("skin", body, air, Conductance(3.0));
        let power = b.expression_in(Context::Source, "240 [W] * heater", None).unwrap();
        b.source("element", body, power);
        let threshold =
            |text: &str| Input::from(b.expression_in(Context::Control, text, None).unwrap());
        let (on, off) = (threshold(self.on_below), threshold(self.off_above));
        let min_dwell = Time(self.dwell).into();
        let sense = body.into();
        b.thermostat(
            heater,
            Thermostat { sense, acts: Acts::Heating, on, off, start: self.start_on, min_dwell },
        );
        b.build().unwrap()
    }

    fn run(&self, stop: f64, tolerance: f64) -> Solution {
        run(&self.network(), stop, tolerance).unwrap()
    }
}

fn run(network: &Network, stop: f64, tolerance: f64) -> Result<Solution, TransientError> {
    let system = ThermalSystem::assemble(network).unwrap();
    Transient::until(Time(stop)).tolerance(tolerance).solve(&system)
}

/// Times and states after each switch of controls and comparisons.
fn switched(solution: &Solution) -> Vec<(f64, u8)> {
    let limit = |event: &&Event| !matches!(event.kind, EventKind::Limit(_));
    solution.events().iter().filter(limit).map(|event| (event.time, event.after)).collect()
}

#[track_caller]
fn assert_times(found: &[(f64, u8)], expected: &[(f64, u8)], tolerance: f64) {
    assert_eq!(found.len(), expected.len(), "{found:?}, not {expected:?}");
    for (found, expected) in found.iter().zip(expected) {
        assert!((found.0 - expected.0).abs() <= tolerance, "{found:?}, not {expected:?}");
        assert_eq!(found.1, expected.1);
    }
}

/// The switches of a heater between two temperatures above the ambient, which begins on at `t`, up
/// to `stop`.
fn cycle((mut t, from): (f64, f64), (low, high): (f64, f64), stop: f64) -> Vec<(f64, u8)> {
    let mut expected = Vec::new();
    let (mut at, mut on) = (from, true);
    loop {
        let to = if on { high } else { low };
        t += takes(at, to, on);
        if t > stop {
            return expected;
        }
        on = !on;
        at = to;
        expected.push((t, u8::from(on)));
    }
}

#[test]
fn thermostat_switches_at_the_times_of_the_closed_form() {
    for tolerance in [1e-3, 1e-5, 1e-7] {
        let solution = Heater::usual().run(2000.0, tolerance);
        let expected = cycle((0.0, 0.0), (38.0, 42.0), 2000.0);
        assert!(expected.len() > 80);
        // a shift of one switch shifts the next ones: said, not hidden, where there are more than a
        // hundred
        let said = (expected.len() > 100).then_some(Unbounded::Switches { count: expected.len() });
        assert_eq!(solution.why_unbounded(), said);
        // ten tolerances at the slope of 0.2 K/s at the switches; rounding decides at 1e-7 K
        assert_times(&switched(&solution), &expected, (50.0 * tolerance).max(1e-4));
        assert!(
            solution.ledger().relative_residual().unwrap().abs() < 1e-8,
            "{:?}",
            solution.ledger()
        );
    }
}

/// A heater of 60 W on a block of 200 J/K with 0.5 W/K to 20 degC, felt by a sensor of 40 J/K
/// behind 0.2 W/K: on below 60 degC, off above 62 degC. An error of the sensor moves the block by
/// far more, switch after switch. Numbers of the closed form (two exponentials between the
/// switches, each switch by bisection) with 50 digits of mpmath 1.3.
#[test]
fn a_hundred_switches_of_a_remote_sensor_stay_within_ten_tolerances() {
    let mut b = NetworkBuilder::new();
    let heater = b.control("heater");
    let start = Temperature(AMBIENT);
    let block = b.node("block", HeatCapacity(200.0), start);
    let sensor = b.node("sensor", HeatCapacity(40.0), start);
    let air = b.boundary("air", start);
    b.resistor("skin", block, air, Conductance(0.5));
    b.resistor("stem", block, sensor, Conductance(0.2));
    let power = b.expression_in(Context::Source, "60 [W] * heater", None).unwrap();
    b.source("element", block, power);
    let threshold =
        |text: &str| Input::from(b.expression_in(Context::Control, text, None).unwrap());
    let (on, off) = (threshold("60 [degC]"), threshold("62 [degC]"));
    let min_dwell = Time(0.0).into();
    let sense = sensor.into();
    b.thermostat(
        heater,
        Thermostat { sense, acts: Acts::Heating, on, off, start: true, min_dwell },
    );
    let network = b.build().unwrap();
    // time in s, switches until then, block and sensor in degC
    let exact = [
        (4600.0, 24, 59.348_101_220_660_03, 59.212_624_577_921_21),
        (17_780.0, 100, 63.357_506_283_718_62, 59.427_952_625_475_86),
    ];
    for tolerance in [1e-3, 2e-5, 1e-5] {
        for (stop, count, hot, felt) in exact {
            let solution = run(&network, stop, tolerance).unwrap();
            assert_eq!((switched(&solution).len(), solution.error_is_bounded()), (count, true));
            for (node, celsius) in [(block, hot), (sensor, felt)] {
                let found = *solution.temperature(node).unwrap().last().unwrap();
                let error = (found - 273.15 - celsius).abs();
                assert!(
                    error <= 10.0 * tolerance,
                    "{error} K after {count} switches at {tolerance} K"
                );
            }
        }
    }
}

#[test]
fn control_that_starts_beyond_its_threshold_switches_at_once() {
    let heater = Heater { start_at: 60.0, ..Heater::usual() };
    let mut expected = vec![(0.0, 0), (takes(60.0, 38.0, false), 1)];
    expected.extend(cycle((expected[1].0, 38.0), (38.0, 42.0), 200.0));
    assert_times(&switched(&heater.run(200.0, 1e-7)), &expected, 1e-4);
}

#[test]
fn inside_the_dead_band_the_start_decides() {
    for (start_on, first) in [(true, takes(40.0, 42.0, true)), (false, takes(40.0, 38.0, false))] {
        let heater = Heater { start_at: 40.0, start_on, ..Heater::usual() };
        let found = switched(&heater.run(20.0, 1e-7));
        assert_times(&found[..1], &[(first, u8::from(!start_on))], 1e-4);
    }
}

#[test]
fn start_exactly_at_the_threshold_is_not_missed() {
    // heated, at the very temperature at which it has to go off
    let heater = Heater { start_at: 42.0, ..Heater::usual() };
    let found = switched(&heater.run(100.0, 1e-7));
    assert!(found[0].0.abs() < 1e-6, "{found:?}");
    assert_times(&found[1..2], &[(takes(42.0, 38.0, false), 1)], 1e-4);
}

#[test]
fn dwell_that_swallows_a_crossing_is_caught_up() {
    // a cycle takes 20 s + 20 s; it has to stay for 30 s
    let heater = Heater { dwell: 30.0, ..Heater::usual() };
    let off = takes(0.0, 42.0, true);
    // 30 s after it went off it is colder than 38 K already, and goes on at once
    let at = 42.0 * (-30.0 / TAU).exp();
    assert!(at < 38.0);
    let after = RISE + (at - RISE) * (-30.0 / TAU).exp();
    assert!(after > 42.0);
    let expected = [(off, 0), (off + 30.0, 1), (off + 60.0, 0), (off + 90.0, 1)];
    assert_times(&switched(&heater.run(off + 100.0, 1e-7)), &expected, 1e-4);
}

#[test]
fn thresholds_that_jump_switch_at_the_jump_and_those_that_move_where_they_meet() {
    let jumps = Heater {
        on_below: "if(t < 300 [s], 58 [degC], 68 [degC])",
        off_above: "if(t < 300 [s], 62 [degC], 72 [degC])",
        ..Heater::usual()
    };
    let before = cycle((0.0, 0.0), (38.0, 42.0), 300.0);
    let last = *before.last().unwrap();
    let found = switched(&jumps.run(320.0, 1e-7));
    assert_times(&found[..before.len()], &before, 1e-4);
    if last.1 == 0 {
        assert_times(&found[before.len()..][..1], &[(300.0, 1)], 1e-9);
    }
    // 42 K less 0.02 K/s: 80 (1 - exp(-t/200)) = 42 - 0.02 t, solved here by bisection
    let moves = Heater {
        off_above: "62 [degC] - 0.02 [K/s] * t",
        on_below: "20 [degC]",
        ..Heater::usual()
    };
    let (mut low, mut high) = (100.0_f64, 200.0);
    for _ in 0..60 {
        let t = 0.5 * (low + high);
        if RISE * (1.0 - (-t / TAU).exp()) < 42.0 - 0.02 * t { low = t } else { high = t }
    }
    assert_times(&switched(&moves.run(200.0, 1e-7)), &[(low, 0)], 1e-4);
}

/// A node at `start` above the ambient, heated by an expression.
fn heated_by(power: &str, start: f64) -> Network {
    let mut b = NetworkBuilder::new();
    let body = b.node("body", HeatCapacity(600.0), Temperature(AMBIENT + start));
    let air = b.boundary("air", Temperature(AMBIENT));
    b.resistor("skin", body, air, Conductance(3.0));
    let power = b.expression_in(Context::Source, power, None).unwrap();
    b.source("element", body, power);
    b.build().unwrap()
}

#[test]
fn comparison_of_a_temperature_changes_where_it_is_reached() {
    for power in ["if(T < 50 [degC], 240 [W], 120 [W])", "if(50 [degC] > body.T, 240 [W], 120 [W])"]
    {
        let solution = run(&heated_by(power, 0.0), 600.0, 1e-7).unwrap();
        let at = takes(0.0, 30.0, true);
        assert_times(&switched(&solution), &[(at, 0)], 1e-4);
        // afterwards towards 40 K above the ambient
        let end = 40.0 - 10.0 * (-(600.0 - at) / TAU).exp();
        let last = solution.temperature(solution.network().node("body").unwrap()).unwrap()[300];
        assert!((last - AMBIENT - end).abs() < 1e-6, "{last}");
        assert!(solution.ledger().relative_residual().unwrap().abs() < 1e-9);
    }
}

#[test]
fn peak_between_two_steps_is_noticed() {
    // a comparison that holds for a moment only: the peak of a pulse is just above it
    let mut b = NetworkBuilder::new();
    let body = b.node("body", HeatCapacity(600.0), Temperature(AMBIENT));
    let air = b.boundary("air", Temperature(AMBIENT));
    b.resistor("skin", body, air, Conductance(3.0));
    let swing =
        b.expression_in(Context::Source, "240 [W] * sin(t / 200 [s] * 1 [rad])", None).unwrap();
    b.source("element", body, swing);
    let level = AMBIENT + highest() - 1e-5;
    let watch = format!("if(T > absolute({level} [K]), 1e-9 [W], 0 [W])");
    let watch = b.expression_in(Context::Source, &watch, None).unwrap();
    b.source("watch", body, watch);
    let solution = run(&b.build().unwrap(), 600.0, 1e-8).unwrap();
    assert_eq!(
        switched(&solution).iter().map(|event| event.1).collect::<Vec<_>>(),
        [1, 0],
        "{:?}",
        solution.events()
    );
}

/// The highest temperature above the ambient under 240 W sin(t/tau): 40 (sin x - cos x + exp(-x)),
/// x = t/tau, whose slope cos x + sin x - exp(-x) is zero there.
fn highest() -> f64 {
    let (mut low, mut high) = (1.0_f64, 3.0_f64);
    for _ in 0..60 {
        let x = 0.5 * (low + high);
        if x.cos() + x.sin() - (-x).exp() > 0.0 { low = x } else { high = x }
    }
    40.0 * (low.sin() - low.cos() + (-low).exp())
}

#[test]
fn chatter_is_reported_with_its_cause() {
    let network = heated_by("if(T < 50 [degC], 240 [W], 0 [W])", 0.0);
    let error = run(&network, 600.0, 1e-5).unwrap_err();
    assert_eq!(error.code(), "run::chatter");
    assert!(error.help().unwrap().contains("[control]"));
    let TransientError::Stopped { time, reason: StopReason::Chatter { name, .. }, partial } = error
    else {
        panic!("stopped");
    };
    assert_eq!(name, "element.P");
    assert!((time - takes(0.0, 30.0, true)).abs() < 0.1, "{time}");
    assert!(partial.times().len() > 40);
}

#[test]
fn control_that_feels_a_massless_node_needs_a_dwell() {
    let build = |dwell: f64| {
        let mut b = NetworkBuilder::new();
        let heater = b.control("heater");
        let body = b.node("body", HeatCapacity(600.0), Temperature(AMBIENT));
        let skin = b.massless("skin");
        let air = b.boundary("air", Temperature(AMBIENT));
        b.resistor("inner", body, skin, Conductance(3.0));
        b.resistor("outer", skin, air, Conductance(3.0));
        let power = b.expression_in(Context::Source, "240 [W] * heater", None).unwrap();
        b.source("element", skin, power);
        let at = |k: f64| Temperature(AMBIENT + k).into();
        let (on, off, min_dwell) = (at(20.0), at(22.0), Time(dwell).into());
        let sense = End::Node(skin);
        b.thermostat(
            heater,
            Thermostat { sense, acts: Acts::Heating, on, off, start: true, min_dwell },
        );
        b.build().unwrap()
    };
    // 240 W lift the skin by 40 K at once: beyond both thresholds
    let error = run(&build(0.0), 100.0, 1e-5).unwrap_err();
    assert_eq!(error.code(), "run::restless");
    let solution = run(&build(10.0), 100.0, 1e-5).unwrap();
    let expected: Vec<(f64, u8)> =
        (0..10).map(|k| (10.0 * f64::from(k), u8::from(k % 2 == 1))).collect();
    assert_times(&switched(&solution)[..10], &expected, 1e-9);
}

#[test]
fn conductance_that_a_control_opens_is_followed() {
    // a fan: 3 W/K, or 12 W/K above 40 K, until below 35 K
    let mut b = NetworkBuilder::new();
    let fan = b.control("fan");
    let body = b.node("body", HeatCapacity(600.0), Temperature(AMBIENT));
    let air = b.boundary("air", Temperature(AMBIENT));
    let g = b.expression_in(Context::Link, "3 [W/K] + 9 [W/K] * fan", None).unwrap();
    b.resistor("skin", body, air, Path::conductance(g));
    b.source("loss", body, HeatFlow(240.0));
    let at = |k: f64| Temperature(AMBIENT + k).into();
    let (on, off, min_dwell) = (at(40.0), at(35.0), Time(0.0).into());
    let sense = body.into();
    b.thermostat(fan, Thermostat { sense, acts: Acts::Cooling, on, off, start: false, min_dwell });
    let solution = run(&b.build().unwrap(), 400.0, 1e-7).unwrap();
    let mut expected = vec![(takes(0.0, 40.0, true), 1)];
    let down = 50.0 * (20.0_f64 / 15.0).ln(); // towards 20 K with 600/12 s
    while let Some(&(t, on)) = expected.last() {
        let next = t + if on == 1 { down } else { takes(35.0, 40.0, true) };
        if next > 400.0 {
            break;
        }
        expected.push((next, 1 - on));
    }
    assert!(expected.len() > 10);
    assert_times(&switched(&solution), &expected, 1e-4);
    let fan = solution.control(solution.network().control_ids().next().unwrap());
    let row = |t: f64| solution.times().iter().position(|&time| (time - t).abs() < 0.7).unwrap();
    assert!(fan[row(expected[0].0 - 2.0)] < 0.5 && fan[row(expected[0].0 + 2.0)] > 0.5);
    assert!(solution.ledger().relative_residual().unwrap().abs() < 1e-9);
}

#[test]
fn run_that_goes_on_with_the_controls_of_another_switches_as_one_that_was_not_parted() {
    let whole = Heater { dwell: 30.0, ..Heater::usual() };
    let expected = switched(&whole.run(400.0, 1e-8));
    let first = whole.run(170.0, 1e-8); // off for some 20 s, and to stay so for 10 more
    assert!(!first.controls()[0].on);
    let body = first.network().node("body").unwrap();
    let reached = *first.temperature(body).unwrap().last().unwrap() - AMBIENT;
    let network = Heater { start_at: reached, start_on: true, ..whole }.network();
    let system = ThermalSystem::assemble(&network).unwrap();
    let second = Transient {
        start: 170.0,
        controls: first.controls().to_vec(),
        ..Transient::until(Time(400.0))
    };
    let second = Transient { output: lptn_network::OutputTimes::Every(1.0), ..second };
    let second = switched(&second.tolerance(1e-8).solve(&system).unwrap());
    let parts: Vec<(f64, u8)> = switched(&first).into_iter().chain(second).collect();
    assert_times(&parts, &expected, 1e-4);
}

#[test]
fn comparison_that_changes_often_over_a_long_run_with_two_rows_is_no_chatter() {
    // 60 swings of an ambient by 20 K drive the node to and fro
    let mut b = NetworkBuilder::new();
    let body = b.node("body", HeatCapacity(600.0), Temperature(AMBIENT));
    let air = b
        .expression_in(Context::Time, "20 [degC] + 20 [K] * sin(t / 100 [s] * 1 [rad])", None)
        .unwrap();
    let air = b.boundary("air", air);
    b.resistor("skin", body, air, Conductance(30.0));
    let power = b.expression_in(Context::Source, "if(T > 22 [degC], 0 [W], 1 [W])", None).unwrap();
    b.source("element", body, power);
    let network = b.build().unwrap();
    let system = ThermalSystem::assemble(&network).unwrap();
    let stop = 60.0 * 100.0 * std::f64::consts::TAU;
    let solution = Transient::until(Time(stop)).at(&[]).solve(&system).unwrap();
    assert_eq!(solution.times().len(), 2);
    assert_eq!(solution.events().len(), 120);
}
