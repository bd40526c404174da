//! ESDIRK against closed forms: tolerances, order, kinks, the energy balance inside steps.
#![allow(clippy::unwrap_used, reason = "tests")]

use lptn_integrate::{Esdirk, IntegrateError, Integrator, OdeSystem, Options, Pattern, Retry};

/// `m y' = f(t, y)` of one component, with its slope by `y`, and the integral of `f`.
struct One<F, D> {
    mass: [f64; 1],
    flow: F,
    slope: D,
    pattern: Pattern,
}

impl<F: Fn(f64, f64) -> f64, D: Fn(f64, f64) -> f64> One<F, D> {
    fn new(mass: f64, flow: F, slope: D) -> Self {
        Self { mass: [mass], flow, slope, pattern: Pattern::new(1, std::iter::empty()) }
    }
}

impl<F: Fn(f64, f64) -> f64, D: Fn(f64, f64) -> f64> OdeSystem for One<F, D> {
    fn size(&self) -> usize {
        1
    }

    fn mass(&self) -> &[f64] {
        &self.mass
    }

    fn flow(&mut self, t: f64, y: &[f64], f: &mut [f64]) -> Result<(), Retry> {
        f[0] = (self.flow)(t, y[0]);
        if f[0].is_finite() { Ok(()) } else { Err(Retry::SmallerStep) }
    }

    fn pattern(&self) -> &Pattern {
        &self.pattern
    }

    fn symmetric(&self) -> bool {
        true
    }

    fn jacobian(&mut self, t: f64, y: &[f64], values: &mut [f64]) -> Result<(), Retry> {
        values[0] = (self.slope)(t, y[0]);
        Ok(())
    }

    fn quadrature_count(&self) -> usize {
        1
    }

    fn quadrature(&mut self, t: f64, y: &[f64], q: &mut [f64]) -> Result<(), Retry> {
        q[0] = (self.flow)(t, y[0]);
        Ok(())
    }
}

fn options(tolerance: f64) -> Options {
    Options { tolerance, ..Options::default() }
}

/// The largest error at and inside the steps up to `stop`, and the steps.
fn error<S: OdeSystem>(run: &mut Esdirk<S>, stop: f64, exact: impl Fn(f64) -> f64) -> (f64, u64) {
    run.set_stop(stop);
    let (mut worst, mut y) = (0.0_f64, [0.0]);
    while run.time() < stop {
        let step = run.step().unwrap();
        for share in [0.2, 0.5, 0.7, 1.0] {
            let time = step.from + share * (step.to - step.from);
            run.interpolate(time, &mut y).unwrap();
            worst = worst.max((y[0] - exact(time)).abs());
        }
    }
    (worst, run.statistics().steps)
}

#[test]
fn errors_stay_below_ten_tolerances() {
    for tolerance in [1e-2, 1e-4, 1e-6, 1e-8] {
        // a stiff body after a source of one frequency
        for rate in [0.1, 1.0, 1e3, 1e6] {
            let system = One::new(
                2.0,
                |t: f64, y| 2.0 * (t.cos() - rate * (y - t.sin())),
                |_, _| -2.0 * rate,
            );
            let mut run = Esdirk::new(system, 0.0, &[0.0], &options(tolerance)).unwrap();
            let (worst, _) = error(&mut run, 20.0, f64::sin);
            assert!(worst < 10.0 * tolerance, "rate {rate}: {worst} at {tolerance}");
        }
        // a conductance that changes with time
        let system = One::new(1.0, |t: f64, y| -(1.0 + t.cos()) * y, |t: f64, _| -1.0 - t.cos());
        let mut run = Esdirk::new(system, 0.0, &[1.0], &options(tolerance)).unwrap();
        let (worst, _) = error(&mut run, 20.0, |t| (-t - t.sin()).exp());
        assert!(worst < 10.0 * tolerance, "{worst} at {tolerance}");
        // a body that glows: y' = -y^4, 1 / y^3 = 1 + 3 t
        let system = One::new(1.0, |_, y: f64| -y.powi(4), |_, y: f64| -4.0 * y.powi(3));
        let mut run = Esdirk::new(system, 0.0, &[1.0], &options(tolerance)).unwrap();
        let (worst, _) = error(&mut run, 100.0, |t| (1.0 + 3.0 * t).cbrt().recip());
        assert!(worst < 10.0 * tolerance, "{worst} at {tolerance}");
    }
}

/// Half the step, a sixteenth of the error.
#[test]
fn it_is_of_order_four() {
    let worst = |step: f64| {
        let system = One::new(1.0, |t: f64, y| t.cos() - (y - t.sin()), |_, _| -1.0);
        let chosen =
            Options { initial_step: Some(step), max_step_size: Some(step), ..options(1.0) };
        error(&mut Esdirk::new(system, 0.0, &[0.0], &chosen).unwrap(), 4.0, f64::sin).0
    };
    let orders = [0.5, 0.25, 0.125].map(|step| (worst(step) / worst(0.5 * step)).log2());
    assert!(orders.iter().all(|order| (3.7..4.5).contains(order)), "{orders:?}");
}

/// A source that jumps every second: a step from jump to jump, and no small ones behind them.
#[test]
fn a_new_start_costs_no_small_steps() {
    let tau = 50.0;
    let source = |k: u32| if k.is_multiple_of(2) { 1.0 } else { -0.5 };
    let system = std::cell::Cell::new(source(0));
    let mut run = {
        let flow = |_, y: f64| system.get() - y / tau;
        Esdirk::new(One::new(1.0, flow, |_, _| -1.0 / tau), 0.0, &[0.0], &options(1e-6)).unwrap()
    };
    let mut expected = 0.0;
    for k in 0..500 {
        system.set(source(k));
        if k > 0 {
            run.restart(None).unwrap();
        }
        run.set_stop(f64::from(k) + 1.0);
        while run.time() < f64::from(k) + 1.0 {
            run.step().unwrap();
        }
        let rest = tau * source(k);
        expected = rest + (expected - rest) * (-1.0 / tau).exp();
        assert!((run.state()[0] - expected).abs() < 1e-5, "{k}");
    }
    let counts = run.statistics();
    assert!(counts.steps < 550 && counts.factorizations < 20, "{counts:?}");
}

/// The integral of the flow is the change of the state times its mass, at the ends of steps and at
/// every time that is gone back to.
#[test]
fn the_balance_closes_inside_steps() {
    let system = One::new(
        3.0,
        |t: f64, y: f64| 5.0 * (2.0 * t).sin() - y - 1e-3 * y.powi(3),
        |_, y: f64| -1.0 - 3e-3 * y * y,
    );
    let mut run = Esdirk::new(system, 0.0, &[4.0], &options(1e-4)).unwrap();
    run.set_stop(30.0);
    for k in 0..40 {
        let step = run.step().unwrap();
        if k % 3 == 1 {
            let (share, mut y) = (f64::from(k) / 40.0, [0.0]);
            let back = step.from + share * (step.to - step.from);
            run.interpolate(back, &mut y).unwrap();
            run.rewind(back).unwrap();
            assert!((run.state()[0] - y[0]).abs() < 1e-14 && (run.time() - back).abs() < 1e-12);
        }
        let stored = 3.0 * (run.state()[0] - 4.0);
        let gained = run.quadratures().unwrap()[0];
        assert!((stored - gained).abs() < 1e-7, "{k}: {stored} {gained}");
    }
}

/// What one step cannot do, a shorter one may; what none can is an error with its time.
#[test]
fn a_state_that_ends_is_an_error() {
    // y' = -1 / y ends at t = 0.5
    let flow = |_, y: f64| if y > 0.0 { -1.0 / y } else { f64::NAN };
    let system = One::new(1.0, flow, |_, y: f64| 1.0 / (y * y));
    let mut run = Esdirk::new(system, 0.0, &[1.0], &options(1e-6)).unwrap();
    run.set_stop(1.0);
    let failed = loop {
        if let Err(error) = run.step() {
            break error;
        }
    };
    assert!(matches!(failed, IntegrateError::Stalled { .. }), "{failed}");
    assert!((run.time() - 0.5).abs() < 1e-3, "{}", run.time());
    let at = run.time();
    let outside = run.interpolate(at + 1.0, &mut [0.0]).unwrap_err();
    assert!(matches!(outside, IntegrateError::OutsideLastStep { .. }), "{outside}");
}
