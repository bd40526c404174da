//! Steps, stop times, restarts, dense output, the error norm, and integrators beside each other.
#![allow(clippy::unwrap_used, reason = "a test may")]

use crate::common;

use common::{Linear, equal_times, plate, sample};
use lptn_cvodes::{Cvodes, linked};
use lptn_integrate::{IntegrateError, Integrator, LinearSolver, Options};

/// One cell with the time constant 1 and a source of 50 that is on from time 1.
fn switched() -> Linear {
    let source = |t: f64, b: &mut [f64]| b[0] = if t > 1.0 { 50.0 } else { 0.0 };
    Linear::network(vec![1.0], &[(0, None, 1.0)], Box::new(source))
}

fn exact(t: f64) -> f64 {
    10.0 * (-t).exp() + if t > 1.0 { 50.0 * (1.0 - (1.0 - t).exp()) } else { 0.0 }
}

#[test]
fn never_steps_across_the_stop_time() {
    let mut integrator = Cvodes::new(switched(), 0.0, &[10.0], &Options::default()).unwrap();
    for stop in [1.0, 3.0] {
        integrator.set_stop(stop);
        loop {
            let before = integrator.time();
            let step = integrator.step().unwrap();
            assert!((step.from - before).abs() <= 0.0 && step.to > step.from && step.to <= stop);
            assert!((step.to - integrator.time()).abs() <= 0.0);
            if step.at_stop {
                break;
            }
        }
        assert!((integrator.time() - stop).abs() <= 0.0);
        assert!((integrator.state()[0] - exact(stop)).abs() < 1e-4);
        integrator.restart(None).unwrap();
    }
    // The jump is met by a restart, not by a search.
    assert!(integrator.statistics().error_test_failures <= 10);
    let again = integrator.step().unwrap();
    assert!(again.at_stop && (again.to - again.from).abs() <= 0.0);
    integrator.set_stop(2.0);
    assert!(matches!(integrator.step(), Err(IntegrateError::StopBehind { .. })));
    integrator.set_stop(f64::NAN);
    assert!(matches!(integrator.step(), Err(IntegrateError::InvalidOption { .. })));
}

#[test]
fn runs_on_without_a_stop_time() {
    let mut integrator = Cvodes::new(plate(3, 1.0), 5.0, &[0.0; 9], &Options::default()).unwrap();
    integrator.set_stop(6.0);
    while !integrator.step().unwrap().at_stop {}
    integrator.set_stop(f64::INFINITY);
    while integrator.time() < 1e6 {
        assert!(!integrator.step().unwrap().at_stop);
    }
}

#[test]
fn interpolates_inside_the_last_step_only() {
    let mut integrator = Cvodes::new(switched(), 0.0, &[10.0], &Options::default()).unwrap();
    let mut y = [0.0];
    integrator.interpolate(0.0, &mut y).unwrap();
    assert!((y[0] - 10.0).abs() <= 0.0);
    integrator.set_stop(1.0);
    for _ in 0..20 {
        let step = integrator.step().unwrap();
        for k in 0..=8 {
            let t = step.from + (step.to - step.from) * f64::from(k) / 8.0;
            integrator.interpolate(t, &mut y).unwrap();
            assert!((y[0] - exact(t)).abs() < 1e-4);
        }
        for t in [step.from - 1e-3, step.to + 1e-3, f64::NAN] {
            assert!(matches!(
                integrator.interpolate(t, &mut y),
                Err(IntegrateError::OutsideLastStep { .. })
            ));
        }
    }
    assert!(matches!(
        integrator.interpolate(0.0, &mut [0.0; 2]),
        Err(IntegrateError::WrongLength { .. })
    ));
    integrator.restart(None).unwrap();
    let now = integrator.time();
    assert!(integrator.interpolate(now, &mut y).is_ok());
    assert!(integrator.interpolate(now - 1e-9, &mut y).is_err());
}

#[test]
fn idle_components_change_nothing() {
    let run = |idle: usize| {
        let ladder = |_| {
            let source = |t: f64, b: &mut [f64]| b[2] = 40.0 * (0.3 * t).sin();
            let links = [(0, Some(1), 2.0), (1, Some(2), 0.1), (0, None, 1.0)];
            Linear::network(vec![1.0, 0.01, 5.0], &links, Box::new(source))
        };
        let mut y0 = vec![7.0; 3 + idle];
        y0[3..].fill(300.0);
        let options = Options { linear_solver: LinearSolver::Cholesky, ..Options::default() };
        let mut integrator = Cvodes::new(ladder(()).with_idle(idle), 0.0, &y0, &options).unwrap();
        let mut seen = Vec::new();
        sample(&mut integrator, &equal_times(50.0, 20), |_, y| seen.extend_from_slice(&y[..3]))
            .unwrap();
        (integrator.statistics().steps, seen)
    };
    let (steps, alone) = run(0);
    for idle in [100, 10_000] {
        let (with_idle, crowd) = run(idle);
        assert_eq!(with_idle, steps);
        assert!(alone.iter().zip(&crowd).all(|(a, b)| (a - b).abs() < 1e-9));
    }
}

/// Steps to 100 and returns all times and the last state.
fn whole_run(size: usize) -> (Vec<f64>, Vec<f64>) {
    let mut integrator = started(size);
    let mut times = Vec::new();
    while integrator.time() < 100.0 {
        times.push(integrator.step().unwrap().to);
    }
    (times, integrator.state().to_vec())
}

fn started(size: usize) -> Cvodes<Linear> {
    let mut integrator =
        Cvodes::new(plate(size, 50.0), 0.0, &vec![20.0; size * size], &Options::default()).unwrap();
    integrator.set_stop(100.0);
    integrator
}

#[test]
fn two_integrators_in_one_thread_do_not_disturb_each_other() {
    let (small, large) = (whole_run(4), whole_run(9));
    let (mut a, mut b) = (started(4), started(9));
    let (mut at, mut bt) = (Vec::new(), Vec::new());
    while a.time() < 100.0 || b.time() < 100.0 {
        if a.time() < 100.0 {
            at.push(a.step().unwrap().to);
        }
        if b.time() < 100.0 {
            bt.push(b.step().unwrap().to);
        }
    }
    assert_eq!((at, a.state().to_vec()), small);
    assert_eq!((bt, b.state().to_vec()), large);
}

#[test]
fn two_integrators_in_two_threads_do_not_disturb_each_other() {
    let alone = [whole_run(5), whole_run(8)];
    let threads: Vec<_> =
        [5, 8, 5, 8].map(|size| std::thread::spawn(move || whole_run(size))).into_iter().collect();
    for (k, thread) in threads.into_iter().enumerate() {
        assert_eq!(thread.join().unwrap(), alone[k % 2]);
    }
}

#[test]
fn statistics_add_up_over_restarts() {
    let mut integrator = started(4);
    let mut steps = 0;
    for stop in [10.0, 20.0, 30.0] {
        integrator.set_stop(stop);
        while integrator.time() < stop {
            integrator.step().unwrap();
            steps += 1;
        }
        integrator.restart(None).unwrap();
    }
    let statistics = integrator.statistics();
    assert_eq!((statistics.steps, statistics.restarts), (steps, 3));
    assert!(statistics.last_order >= 1 && statistics.last_step > 0.0);
    assert!(statistics.newton_iterations >= statistics.steps);
    // At every start CVODES asks for one Jacobian; it is constant in between.
    assert_eq!(statistics.jacobian_evaluations, 3);
    assert_eq!(statistics.linear_setups, statistics.factorizations);
}

#[test]
fn the_system_comes_back() {
    let mut integrator = started(3);
    integrator.step().unwrap();
    integrator.system_mut().mass[0] = 2.0;
    assert!((integrator.system().mass[0] - 2.0).abs() <= 0.0);
    assert!((integrator.into_system().mass[0] - 2.0).abs() <= 0.0);
}

#[test]
fn options_are_obeyed() {
    let options =
        Options { initial_step: Some(1e-3), max_step_size: Some(0.5), ..Options::default() };
    let mut integrator = Cvodes::new(plate(3, 1.0), 0.0, &[0.0; 9], &options).unwrap();
    integrator.set_stop(20.0);
    let first = integrator.step().unwrap();
    assert!(first.to <= 1e-3 * 1.000_001);
    while integrator.time() < 20.0 {
        let step = integrator.step().unwrap();
        assert!(step.to - step.from <= 0.5 * 1.000_001);
    }
}

#[test]
fn the_version_is_that_of_the_headers() {
    let linked = linked();
    assert_eq!(linked.version, linked.headers);
    assert!(linked.version.starts_with(['6', '7']));
}

/// Steps of a cell with a time constant of 1 us, far from 0 where doubles are 0.016 s apart, are
/// those from 0.
#[test]
fn a_start_far_from_zero_changes_no_step() {
    let run = |start: f64| {
        let cell = Linear::network(vec![1e-6], &[(0, None, 1.0)], Box::new(|_, b| b[0] = 50.0));
        let mut integrator = Cvodes::new(cell, start, &[0.0], &Options::default()).unwrap();
        integrator.set_stop(start + 0.015_625);
        let mut last = start;
        while !integrator.step().unwrap().at_stop {
            assert!(integrator.time() >= last && integrator.time() < start + 0.015_625);
            last = integrator.time();
        }
        assert!((integrator.time() - start - 0.015_625).abs() <= 0.0);
        (integrator.statistics(), integrator.state()[0].to_bits())
    };
    assert_eq!(run(0.0), run(1e14));
}

#[test]
fn the_longest_step_may_change_on_the_way() {
    let mut integrator = Cvodes::new(plate(3, 1.0), 0.0, &[0.0; 9], &Options::default()).unwrap();
    integrator.set_stop(1000.0);
    while integrator.time() < 1000.0 {
        let longest = if integrator.time() < 300.0 { 5.0 } else { 0.25 };
        integrator.set_longest_step(longest);
        let step = integrator.step().unwrap();
        assert!(step.to - step.from <= longest * 1.000_001, "{step:?}");
        assert_eq!(step.at_stop, step.to >= 1000.0);
    }
}
