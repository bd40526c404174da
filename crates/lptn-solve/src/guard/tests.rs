//! The guard along given time histories.
#![allow(
    clippy::unwrap_used,
    clippy::float_cmp,
    reason = "a test that cannot go on has failed; numbers that are given"
)]

use lptn_integrate::Integrator;

use super::*;
use crate::scripted::{Scripted, bodies};

/// A bell of 2 K about 340 K, of so little heat that it hardly drives anything.
const BELL: &str = "100 [W] + 1e-3 [W] * exp(-((T - absolute(340 [K])) / 2 [K])^2)";

/// A kink at 310 K, of 10 W/K.
const KINK: &str = "10 [W/K] * max(T - absolute(310 [K]), 0 [K])";

/// A body of 100 J/K with a heat along a time history, guarded to a tolerance in K from 0 s on.
fn guarded<T>(
    heat: &str,
    (tolerance, course): (f64, impl Fn(f64) -> f64 + 'static),
    then: impl FnOnce(&mut Guard, &mut Scripted<'_>) -> T,
) -> T {
    let system = ThermalSystem::assemble(&bodies(&[(100.0, heat)], None)).unwrap();
    let mut guard = Guard::of(&system, tolerance).unwrap();
    let mut integrator = Scripted::new(&system, 0.0, move |time| vec![course(time)]);
    guard.begin(&mut integrator);
    then(&mut guard, &mut integrator)
}

fn near(found: f64, expected: f64, error: f64) {
    assert!((found - expected).abs() <= error, "{found} for {expected}");
}

#[test]
fn networks_of_straight_laws_have_no_guard() {
    let system =
        ThermalSystem::assemble(&bodies(&[(100.0, "3 [W/K] * (T - absolute(300 [K]))")], None));
    assert!(Guard::of(&system.unwrap(), 1e-3).is_none());
}

/// At 300 K the body gets 100 W and rises by 1 K/s: the bell is 40 s away.
#[test]
fn the_first_step_ends_where_the_bell_is_at_the_rate_of_the_start() {
    guarded(BELL, (1e-3, |t| 300.0 + t), |guard, integrator| {
        near(guard.end_of_step(integrator), 40.0, 0.5);
        assert!(!guard.met_narrow());
        guard.longest = 3.0;
        near(guard.end_of_step(integrator), 3.0, 1e-12);
        guard.kink = 2.0;
        near(guard.end_of_step(integrator), 2.0, 1e-12);
        // no nearer than rounding
        integrator.goes_to(1e6);
        guard.kink = 1e6;
        let end = guard.end_of_step(integrator) - 1e6;
        near(end, 512.0 * f64::EPSILON * 1e6, 1e-9);
    });
}

/// After a step the rates are those of the step, and of its last twentieth if something turns
/// within the next four.
#[test]
fn the_next_step_is_as_long_as_the_last_one_tells() {
    let course = |t: f64| 300.0 + t + 0.01 * t * t;
    guarded(BELL, (1e-3, course), |guard, integrator| {
        let step = integrator.goes_to(4.0);
        assert_eq!(guard.judge(integrator, &step), Verdict::Stands);
        // 35.84 K to go at 1.04 K/s are 34 s
        assert!(integrator.looks.is_empty());
        near(guard.rates[0], 1.04, 1e-9);
        near(guard.end_of_step(integrator), 4.0 + 35.84 / 1.04, 0.5);
        let step = integrator.goes_to(14.0);
        assert_eq!(guard.judge(integrator, &step), Verdict::Stands);
        // 24.04 K to go: at the mean rate of 1.18 K/s 20 s, within four steps of 10 s
        assert_eq!(integrator.looks.len(), 1);
        near(integrator.looks[0], 13.5, 1e-9);
        near(guard.rates[0], 1.0 + 0.01 * 27.5, 1e-9);
        near(guard.end_of_step(integrator), 14.0 + 24.04 / 1.275, 0.5);
        // a step that cannot be read keeps its mean rate
        integrator.from = 1e9;
        let step = integrator.goes_to(15.0);
        assert_eq!(guard.judge(integrator, &step), Verdict::Stands);
        near(guard.rates[0], 1.29, 1e-9);
    });
}

/// A step that went past the bell is taken back to where the bell is, up to forty times.
#[test]
fn a_step_past_a_turn_is_taken_back() {
    guarded(BELL, (1e-3, |t| 300.0 + t), |guard, integrator| {
        guard.end_of_step(integrator);
        let step = integrator.goes_to(80.0);
        for _ in 0..40 {
            assert_eq!(guard.judge(integrator, &step), Verdict::Back);
            near(guard.longest, 40.0, 0.5);
            assert_eq!(guard.unresolved(), None);
        }
        assert_eq!(guard.judge(integrator, &step), Verdict::Stands);
        assert_eq!(guard.unresolved(), Some(0.0));
        near(guard.longest, 60.0, 0.8);
        assert_eq!(guard.attempts, 0);
    });
}

/// A limited step grows by a half from step to step.
#[test]
fn a_step_that_was_held_short_grows_by_a_half() {
    guarded(BELL, (1e-3, |t| 300.0 + 1e-3 * t), |guard, integrator| {
        guard.longest = 2.0;
        for k in 1..4 {
            let step = integrator.goes_to(f64::from(k));
            assert_eq!(guard.judge(integrator, &step), Verdict::Stands);
            near(guard.longest, 2.0 * 1.5_f64.powi(k), 1e-12);
            assert!(guard.last == 1.0 && !guard.fresh);
        }
        guard.begin(integrator);
        assert!(guard.last == 0.0 && guard.fresh);
    });
}

/// The kink is met at 10 s: the step is taken back, ends there, and the integrator restarts.
#[test]
fn a_kink_ends_a_step_and_begins_the_next() {
    guarded(KINK, (1e-3, |t| 300.0 + t), |guard, integrator| {
        assert!(guard.end_of_step(integrator).is_infinite());
        let step = integrator.goes_to(20.0);
        assert_eq!(guard.judge(integrator, &step), Verdict::Back);
        near(guard.kink, 10.0, 1e-9);
        let kink = guard.kink;
        integrator.rewind(0.0).unwrap();
        guard.begin(integrator);
        near(guard.end_of_step(integrator), kink, 1e-12);
        let step = integrator.goes_to(kink);
        assert_eq!(guard.judge(integrator, &step), Verdict::BeginsAnew);
        assert!(guard.kink.is_infinite() && guard.unresolved().is_none());
        guard.begin(integrator);
        let step = integrator.goes_to(15.0);
        assert_eq!(guard.judge(integrator, &step), Verdict::Stands);
    });
    // a step that is given up on gives its time
    guarded(KINK, (1e-3, |t| 300.0 + t), |guard, integrator| {
        let step = integrator.goes_to(20.0);
        for _ in 0..40 {
            assert_eq!(guard.judge(integrator, &step), Verdict::Back);
        }
        assert_ne!(guard.judge(integrator, &step), Verdict::Back);
        assert_eq!(guard.unresolved(), Some(0.0));
    });
    // a kink that was passed is forgotten
    guarded(KINK, (1e-3, |t| 300.0 + t), |guard, integrator| {
        guard.kink = 5.0;
        guard.begin(integrator);
        assert!(guard.kink == 5.0);
        integrator.goes_to(5.0);
        guard.begin(integrator);
        assert!(guard.kink.is_infinite());
    });
}

/// Errors are followed if there are several states: the heat of the first rises by 3 W/K where 2
/// W/K are lost.
#[test]
fn errors_of_single_states_are_followed() {
    let heats = [(100.0, "3 [W/K] * (T - absolute(300 [K]))"), (100.0, KINK)];
    let system = ThermalSystem::assemble(&bodies(&heats, None)).unwrap();
    let mut guard = Guard::of(&system, 1e-3).unwrap();
    let mut integrator = Scripted::new(&system, 0.0, |t| vec![300.0 + t, 300.0]);
    guard.begin(&mut integrator);
    near(guard.grown(), 1.0, 0.0);
    for k in 1..4 {
        let step = integrator.goes_to(10.0 * f64::from(k));
        guard.judge(&mut integrator, &step);
        near(guard.grown(), (0.1 * f64::from(k)).exp(), 1e-9);
    }
    guarded(KINK, (1e-3, |t| 300.0 + t), |guard, _| near(guard.grown(), 1.0, 0.0));
}

/// The speed of a single state shows how its error grows, so that the guard does not follow it.
#[test]
fn errors_of_a_single_state_are_left_to_its_speed() {
    let heat = "3 [W/K] * (T - absolute(300 [K])) + 1e-3 [W/K] * max(T - absolute(390 [K]), 0 [K])";
    guarded(heat, (1e-3, |t| 300.0 + t), |guard, integrator| {
        for k in 1..4 {
            let step = integrator.goes_to(10.0 * f64::from(k));
            guard.judge(integrator, &step);
            near(guard.grown(), 1.0, 0.0);
        }
    });
}

/// If nothing turns and no kink was passed, an error is evaluated in every sixteenth step: its
/// rate, -0.02 1/s at 300 K and 0.04 1/s at 303 K, is taken from there.
#[test]
fn errors_are_not_looked_at_in_every_step() {
    let heats = [(100.0, "1 [W/K^2] * (T - absolute(300 [K]))^2"), (100.0, KINK)];
    let system = ThermalSystem::assemble(&bodies(&heats, None)).unwrap();
    let mut guard = Guard::of(&system, 1e-3).unwrap();
    let mut integrator = Scripted::new(&system, 0.0, |t| vec![300.0 + 3.0 * t.min(1.0), 300.0]);
    guard.begin(&mut integrator);
    for k in 1..=16 {
        near(guard.grown(), 1.0, 0.0);
        let step = integrator.goes_to(f64::from(k));
        assert_eq!(guard.judge(&mut integrator, &step), Verdict::Stands);
    }
    near(guard.grown(), (0.5 * 16.0 * (-0.02 + 0.04_f64)).exp(), 1e-9);
}

/// The share of a step that went past a turn is one of its length, whenever it began.
#[test]
fn a_later_step_past_a_turn_is_taken_back_as_far() {
    guarded(BELL, (1e-3, |t| 300.0 + t), |guard, integrator| {
        guard.end_of_step(integrator);
        let step = integrator.goes_to(30.0);
        assert_eq!(guard.judge(integrator, &step), Verdict::Stands);
        let step = integrator.goes_to(50.0);
        assert_eq!(guard.judge(integrator, &step), Verdict::Back);
        near(guard.longest, 10.0, 0.5);
    });
}

/// A step without a length does not show how fast temperatures change.
#[test]
fn a_step_without_a_length_keeps_the_rates() {
    guarded(BELL, (1e-3, |t| 300.0 + t + 0.01 * t * t), |guard, integrator| {
        for to in [4.0, 4.0] {
            let step = integrator.goes_to(to);
            assert_eq!(guard.judge(integrator, &step), Verdict::Stands);
            near(guard.rates[0], 1.04, 1e-9);
        }
    });
}
