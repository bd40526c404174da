//! Steps that end at roots: when, which way, and what the books say there.
#![allow(clippy::unwrap_used, reason = "a test may")]

use crate::algebraic_helper as algebraic;
use crate::rooted;

use std::f64::consts::PI;

use algebraic::Stream;
use lptn_cvodes::Cvodes;
use lptn_integrate::{Callback, IntegrateError, Integrator, Options, Retry};
use rooted::{Root, level, next_root, node, off, started};

/// `T = 80 exp(-t/2)` crosses L at `t = 2 ln(80/L)`.
#[test]
fn a_decay_crosses_levels_at_the_times_of_the_closed_form() {
    for (tolerance, allowed) in [(1e-5, 1e-2), (1e-7, 1e-4), (1e-9, 1e-6)] {
        let levels = [70.0, 40.0, 20.0, 5.0, 1.0];
        let mut integrator = started(node(|_| 0.0, levels.map(level).into()), 80.0, tolerance);
        for (i, crossed) in levels.iter().enumerate() {
            let step = next_root(&mut integrator);
            let exact = 2.0 * (80.0_f64 / crossed).ln();
            assert!(
                (step.to - exact).abs() < allowed,
                "{crossed} at {tolerance:e}: {}",
                step.to - exact
            );
            assert!(step.roots && (integrator.time() - step.to).abs() <= 0.0);
            assert!((integrator.state()[0] - crossed).abs() < 1e-12);
            let expected: Vec<_> = (0..levels.len()).map(|k| -i32::from(k == i)).collect();
            assert_eq!(integrator.root_directions(), expected);
            assert!(off(&mut integrator, 80.0).abs() < 1e-11);
        }
        assert!(next_root(&mut integrator).at_stop);
    }
}

/// Going on costs no step and changes no result: the roots are cut out of the steps that are taken
/// anyway.
#[test]
fn going_on_without_a_restart_takes_the_rest_of_the_same_step() {
    let mut plain = started(node(|_| 0.0, vec![]), 80.0, 1e-7);
    let mut cut = started(node(|_| 0.0, [70.0, 40.0, 39.99, 5.0].map(level).into()), 80.0, 1e-7);
    let (mut met, mut y) = (0, [0.0]);
    while plain.time() < 20.0 {
        let whole = plain.step().unwrap();
        let mut from = whole.from;
        while from < whole.to {
            let part = cut.step().unwrap();
            assert!((part.from - from).abs() <= 0.0 && part.to > part.from);
            for t in [part.from, 0.5 * (part.from + part.to), part.to] {
                cut.interpolate(t, &mut y).unwrap();
                assert!((y[0] - 80.0 * (-0.5 * t).exp()).abs() < 1e-6);
            }
            let outside = cut.interpolate(0.9 * part.from - 0.1, &mut y);
            assert!(matches!(outside, Err(IntegrateError::OutsideLastStep { .. })));
            met += u32::from(part.roots);
            assert_eq!(part.roots, part.to < whole.to);
            assert!(off(&mut cut, 80.0).abs() < 1e-11);
            from = part.to;
        }
        assert!((from - whole.to).abs() <= 0.0);
        assert_eq!(plain.state(), cut.state());
        assert_eq!(plain.quadratures().unwrap(), cut.quadratures().unwrap());
    }
    assert_eq!(met, 4);
    assert_eq!(plain.statistics(), cut.statistics());
    assert_eq!(cut.statistics().restarts, 0);
}

/// Heater of 100 W with hysteresis between 40 and 60 K, time constant 2 s, from 0 K: heating from a
/// to b takes `2 ln((100 - a) / (100 - b))`, cooling from b to a takes `2 ln(b / a)`; here both
/// `2 ln 1.5`.
#[test]
fn a_thermostat_switches_at_the_times_of_the_closed_form() {
    let run = |tolerance: f64| {
        let mut integrator = started(node(|_| 100.0, vec![level(60.0)]), 0.0, tolerance);
        integrator.set_stop(f64::INFINITY);
        let mut exact = 2.0 * (100.0_f64 / 40.0).ln();
        let mut worst = 0.0_f64;
        for k in 0..30 {
            let step = next_root(&mut integrator);
            worst = worst.max((step.to - exact).abs());
            let heats = k % 2 == 1;
            assert_eq!(integrator.root_directions(), [if heats { -1 } else { 1 }]);
            let system = integrator.system_mut();
            system.power = Box::new(move |_| if heats { 100.0 } else { 0.0 });
            system.roots[0] = level(if heats { 60.0 } else { 40.0 });
            integrator.restart(None).unwrap();
            exact += 2.0 * 1.5_f64.ln();
            assert!(off(&mut integrator, 0.0).abs() < 1e-9);
        }
        // On for 1.83 s, then off and on for 0.81 s each: 15 times off, 14 times on again.
        let on = 2.0 * (2.5_f64.ln() + 14.0 * 1.5_f64.ln());
        assert!((integrator.quadratures().unwrap()[0] - 100.0 * on).abs() < 1e4 * worst.max(1e-12));
        assert_eq!(integrator.statistics().restarts, 30);
        worst
    };
    assert!(run(1e-7) < 1e-4);
    assert!(run(1e-9) < 1e-6);
}

/// `T = 80 exp(-t/2)` and the time: all three functions are zero at `t = 2 ln 2`.
#[test]
fn several_roots_at_once() {
    let functions: Vec<Root> = vec![
        level(40.0),
        Box::new(|_, y| 40.0 - y),
        Box::new(|_, y| (y - 40.0).powi(3)),
        level(-1.0),
    ];
    let mut integrator = started(node(|_| 0.0, functions), 80.0, 1e-9);
    let step = next_root(&mut integrator);
    assert!((step.to - 2.0 * 2.0_f64.ln()).abs() < 1e-6);
    assert_eq!(integrator.root_directions(), [-1, 1, -1, 0]);
    assert!(next_root(&mut integrator).at_stop);
    assert_eq!(integrator.root_directions(), [-1, 1, -1, 0]);
}

/// `T = sin t` as the answer to `P = T + 2 cos t`: every half period a zero, up and down in turn.
#[test]
fn directions_alternate_on_a_sine() {
    let system = node(|t| t.sin() + 2.0 * t.cos(), vec![level(0.0)]);
    let mut integrator = started(system, 0.0, 1e-9);
    for k in 1..=6 {
        let step = next_root(&mut integrator);
        assert!((step.to - f64::from(k) * PI).abs() < 1e-6, "{k}: {}", step.to);
        assert_eq!(integrator.root_directions(), [if k % 2 == 0 { 1 } else { -1 }]);
    }
    assert!(next_root(&mut integrator).at_stop);
}

#[test]
fn a_root_at_the_start_is_not_reported() {
    let mut integrator = started(node(|_| 0.0, vec![level(80.0), level(10.0)]), 80.0, 1e-7);
    let step = next_root(&mut integrator);
    assert_eq!(integrator.root_directions(), [0, -1]);
    assert!((step.to - 2.0 * 8.0_f64.ln()).abs() < 1e-4);
    // Nor at a restart at the root.
    integrator.restart(None).unwrap();
    assert!(next_root(&mut integrator).at_stop);
}

/// A function that was exactly zero at a start takes part again after the next one, in the very
/// first step.
#[test]
fn a_function_that_was_idle_is_taken_up_at_a_restart() {
    let mut integrator = started(node(|_| 0.0, vec![Box::new(|_, _| 0.0)]), 80.0, 1e-3);
    let step = integrator.step().unwrap();
    assert!(!step.roots);
    let crossed = integrator.state()[0] * (1.0 - 1e-9);
    integrator.system_mut().roots[0] = level(crossed);
    integrator.restart(None).unwrap();
    assert!(integrator.step().unwrap().roots);
}

/// A function of time alone has its root at the stop time itself, by rounding a little before or
/// behind it.
#[test]
fn a_root_at_the_stop_time() {
    for stop in [1.0, 0.1, 1e-3, PI, 17.3] {
        for shift in [-2.0, -1.0, -0.5, 0.0] {
            let place = stop * (1.0 + shift * f64::EPSILON);
            let system = node(|_| 0.0, vec![Box::new(move |t, _| t - place), level(0.0)]);
            let mut integrator = started(system, 80.0, 1e-7);
            integrator.set_stop(stop);
            let step = next_root(&mut integrator);
            assert!(step.roots && step.at_stop, "{stop} {shift}: {step:?}");
            assert!((integrator.time() - stop).abs() <= 0.0);
            assert_eq!(integrator.root_directions(), [1, 0]);
            // It is not found again, whether with a restart or without.
            integrator.set_stop(20.0);
            if shift < -1.0 {
                integrator.restart(None).unwrap();
            }
            let end = next_root(&mut integrator);
            assert!(end.at_stop && !end.roots, "{stop} {shift}: {end:?}");
            assert!((integrator.state()[0] - 80.0 * (-10.0_f64).exp()).abs() < 1e-6);
            assert!(off(&mut integrator, 80.0).abs() < 1e-10);
        }
    }
}

/// After a root CVODES stands behind it; a stop time set in between is obeyed all the same.
#[test]
fn a_stop_between_the_root_and_the_end_of_its_step() {
    let mut integrator = started(node(|_| 0.0, vec![level(1.0)]), 80.0, 1e-3);
    let root = next_root(&mut integrator).to;
    let stop = root + 1e-3;
    integrator.set_stop(stop);
    let step = next_root(&mut integrator);
    assert!(step.at_stop && !step.roots && (step.to - stop).abs() <= 0.0);
    assert!((integrator.state()[0] - (-0.5e-3_f64).exp()).abs() < 1e-4);
    assert!(off(&mut integrator, 80.0).abs() < 1e-10);
    integrator.set_stop(20.0);
    assert!(next_root(&mut integrator).at_stop);
}

/// A restart a rounding error before the stop, where CVODES would refuse to start, is at the stop.
#[test]
fn a_start_within_rounding_of_the_stop() {
    let mut integrator = started(node(|_| 0.0, vec![level(40.0)]), 80.0, 1e-7);
    let root = next_root(&mut integrator).to;
    integrator.restart(None).unwrap();
    integrator.set_stop(root.next_up());
    let step = integrator.step().unwrap();
    assert!(step.at_stop && (integrator.time() - root.next_up()).abs() <= 0.0);
    integrator.set_stop(20.0);
    assert!(next_root(&mut integrator).at_stop);
    assert!((integrator.state()[0] - 80.0 * (-10.0_f64).exp()).abs() < 1e-6);
    assert!(off(&mut integrator, 80.0).abs() < 1e-10);
}

/// A function that does not cross zero but stays there is noticed at the end of the step, once.
#[test]
fn a_function_that_rests_at_zero_is_met_once() {
    let mut integrator =
        started(node(|_| 0.0, vec![Box::new(|_, y| (y - 40.0).max(0.0))]), 80.0, 1e-7);
    let step = next_root(&mut integrator);
    let exact = 2.0 * 2.0_f64.ln();
    assert!(step.roots && step.from < exact && step.to >= exact);
    assert_eq!(integrator.root_directions(), [-1]);
    let end = next_root(&mut integrator);
    assert!(end.at_stop && !end.roots);
    assert!((integrator.state()[0] - 80.0 * (-10.0_f64).exp()).abs() < 1e-6);
    assert!(off(&mut integrator, 80.0).abs() < 1e-10);
}

#[test]
fn rewinding_goes_back_with_state_and_books() {
    let mut integrator = started(node(f64::sin, vec![]), 80.0, 1e-8);
    let mut y = [0.0];
    for k in 1..20 {
        let t = f64::from(k);
        while integrator.time() < t {
            integrator.step().unwrap();
        }
        integrator.interpolate(t, &mut y).unwrap();
        integrator.rewind(t).unwrap();
        assert!(
            (integrator.time() - t).abs() <= 0.0 && (integrator.state()[0] - y[0]).abs() <= 0.0
        );
        assert!(off(&mut integrator, 80.0).abs() < 1e-10);
        assert!(matches!(integrator.rewind(t - 1e-9), Err(IntegrateError::OutsideLastStep { .. })));
    }
    while !integrator.step().unwrap().at_stop {}
    assert_eq!(integrator.statistics().restarts, 19);
    // T = A exp(-t/2) + (sin t - 2 cos t) / 5 with A = 80.4.
    let exact = |t: f64| 80.4 * (-0.5 * t).exp() + (t.sin() - 2.0 * t.cos()) / 5.0;
    assert!((integrator.state()[0] - exact(20.0)).abs() < 1e-6);
    // The integral of sin t.
    assert!((integrator.quadratures().unwrap()[0] - (1.0 - 20.0_f64.cos())).abs() < 1e-6);
}

#[test]
fn rewinding_from_a_root_and_to_the_ends() {
    let mut integrator = started(node(|_| 0.0, vec![level(40.0)]), 80.0, 1e-7);
    assert!(integrator.rewind(1.0).is_err());
    integrator.rewind(0.0).unwrap();
    let step = next_root(&mut integrator);
    for t in [step.to.next_up(), step.from - 1e-9, f64::NAN] {
        assert!(matches!(integrator.rewind(t), Err(IntegrateError::OutsideLastStep { .. })));
    }
    // Behind the root lies the rest of the step of CVODES, but that is not the last step.
    integrator.rewind(step.to).unwrap();
    assert!((integrator.state()[0] - 40.0).abs() < 1e-12);
    let next = integrator.step().unwrap();
    integrator.rewind(next.from).unwrap();
    assert!((integrator.state()[0] - 40.0).abs() < 1e-6);
    assert!(off(&mut integrator, 80.0).abs() < 1e-10);
}

/// Two crossings inside one step are not seen as roots, but the caller finds them by interpolation
/// and goes back.
#[test]
fn a_crossing_that_comes_and_goes_inside_a_step() {
    // T = 80 exp(-t/2) with a function that is negative from 3 to 3.01 only.
    let gap: Root = Box::new(|t, _| (t - 3.0) * (t - 3.01));
    let mut integrator = started(node(|_| 0.0, vec![gap]), 80.0, 1e-3);
    let step = loop {
        let step = integrator.step().unwrap();
        assert!(!step.roots);
        if step.to > 3.01 {
            break step;
        }
    };
    assert!(step.from < 3.0);
    integrator.rewind(3.005).unwrap();
    let found = next_root(&mut integrator);
    assert!(found.roots && (found.to - 3.01).abs() < 1e-12);
    assert_eq!(integrator.root_directions(), [1]);
}

/// The third of three cells swings as `a sin(t - p)` with `a = (1 + 1/k^2)^-1.5` and
/// `p = 3 atan(1/k)`; the symmetric matrices are given up on the way.
#[test]
fn roots_are_found_before_and_after_the_switch_to_lu() {
    let k = 1e4_f64;
    let mut system = Stream::new(3, k, 0.0, f64::sin);
    system.levels = vec![0.0, 1e-5, 0.5];
    let options = Options { tolerance: 1e-7, ..Options::default() };
    let mut integrator = Cvodes::new(system, 0.0, &[0.0; 3], &options).unwrap();
    integrator.set_stop(3.0);
    let (mut times, mut directions) = (Vec::new(), Vec::new());
    while integrator.time() < 3.0 {
        let step = integrator.step().unwrap();
        if step.roots {
            times.push(step.to);
            directions.push(integrator.root_directions().to_vec());
        }
    }
    let switched = integrator.statistics().switched_to_lu.unwrap();
    let (size, delay) = ((1.0 + 1.0 / (k * k)).powf(-1.5), 3.0 * (1.0 / k).atan());
    let half = (0.5 / size).asin();
    let expected = [delay + 1e-5 / size, delay + half, delay + PI - half];
    assert_eq!(directions, [[0, 1, 0], [0, 0, 1], [0, 0, -1]]);
    for (found, exact) in times.iter().zip(expected).skip(1) {
        assert!((found - exact).abs() < 1e-5, "{found} {exact}");
    }
    assert!(switched < times[1], "{switched}");
}

#[test]
fn what_roots_may_do_wrong() {
    let failure = |root: Root, fault: Option<Retry>| {
        let mut system = node(|_| 0.0, vec![root]);
        system.fault = fault;
        let mut integrator = started(system, 80.0, 1e-7);
        let error = loop {
            if let Err(error) = integrator.step() {
                break error;
            }
        };
        // Time, state and books are those of the last good step.
        let t = integrator.time();
        assert!(t <= 1.0 && (integrator.state()[0] - 80.0 * (-0.5 * t).exp()).abs() < 1e-6);
        assert!(off(&mut integrator, 80.0).abs() < 1e-10);
        error
    };
    for fault in [Retry::Stop, Retry::SmallerStep] {
        let error = failure(level(40.0), Some(fault));
        assert!(
            matches!(error, IntegrateError::Stopped { callback: Callback::Roots, time } if time > 1.0),
            "{error:?}"
        );
    }
    let error = failure(Box::new(|t, y| if t > 1.0 { f64::NAN } else { y }), None);
    assert!(
        matches!(error, IntegrateError::NotFinite { callback: Callback::Roots, index: 0, .. }),
        "{error:?}"
    );
    let error = failure(Box::new(|t, y| if t > 1.0 { panic!("deliberate") } else { y }), None);
    assert!(
        matches!(error, IntegrateError::Panic { callback: Callback::Roots, ref message, .. } if message == "deliberate")
    );
    let at_once = failure(Box::new(|_, _| f64::INFINITY), None);
    assert!(matches!(at_once, IntegrateError::NotFinite { time: 0.0, .. }), "{at_once:?}");
    // It may go on once the reason is gone.
    let mut system = node(|_| 0.0, vec![level(40.0)]);
    system.fault = Some(Retry::Stop);
    let mut integrator = started(system, 80.0, 1e-7);
    while integrator.step().is_ok() {}
    integrator.system_mut().fault = None;
    let step = next_root(&mut integrator);
    assert!((step.to - 2.0 * 2.0_f64.ln()).abs() < 1e-4);
}
