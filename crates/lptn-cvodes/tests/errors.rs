//! Every error can be reached, and none of them aborts, leaks or prints.
#![allow(clippy::unwrap_used, reason = "a test may")]

use crate::common;

use std::rc::Rc;

use common::{Linear, plate};
use lptn_cvodes::Cvodes;
use lptn_integrate::{
    Callback, FactorError, IntegrateError, Integrator, LinearSolver, OdeSystem, Options, Pattern,
    Retry,
};

/// What goes wrong, from time 1 on.
#[derive(Clone, Copy, PartialEq)]
enum Fault {
    Panic,
    NotFinite,
    Retry,
    Stop,
}

/// `y' = -y` twice, with a fault in one of the callbacks.
struct Faulty {
    pattern: Pattern,
    fault: Fault,
    place: Callback,
    /// Counts owners, to see whether the system is dropped.
    alive: Rc<()>,
}

impl Faulty {
    fn act(&self, place: Callback, t: f64, out: &mut [f64]) -> Result<(), Retry> {
        if place != self.place || t < 1.0 {
            return Ok(());
        }
        match self.fault {
            Fault::Panic => panic!("deliberate, at {place}"),
            Fault::NotFinite => out[1] = f64::NAN,
            Fault::Retry => return Err(Retry::SmallerStep),
            Fault::Stop => return Err(Retry::Stop),
        }
        Ok(())
    }
}

impl OdeSystem for Faulty {
    fn size(&self) -> usize {
        2
    }
    fn mass(&self) -> &[f64] {
        &[1.0, 1.0]
    }
    fn flow(&mut self, t: f64, y: &[f64], f: &mut [f64]) -> Result<(), Retry> {
        f.copy_from_slice(&[-y[0], -y[1]]);
        self.act(Callback::Flow, t, f)
    }
    fn pattern(&self) -> &Pattern {
        &self.pattern
    }
    fn symmetric(&self) -> bool {
        true
    }
    fn jacobian(&mut self, t: f64, _y: &[f64], values: &mut [f64]) -> Result<(), Retry> {
        values.fill(-1.0);
        self.act(Callback::Jacobian, t, values)
    }
    fn quadrature_count(&self) -> usize {
        2
    }
    fn quadrature(&mut self, t: f64, y: &[f64], q: &mut [f64]) -> Result<(), Retry> {
        q.copy_from_slice(y);
        self.act(Callback::Quadrature, t, q)
    }
}

/// The error, and whether the system was dropped afterwards.
fn failure(place: Callback, fault: Fault) -> IntegrateError {
    let alive = Rc::new(());
    let system = Faulty {
        pattern: Pattern::new(2, std::iter::empty()),
        fault,
        place,
        alive: Rc::clone(&alive),
    };
    let mut integrator = Cvodes::new(system, 0.0, &[100.0, 50.0], &Options::default()).unwrap();
    integrator.set_stop(10.0);
    let error = loop {
        if let Err(error) = integrator.step() {
            break error;
        }
        assert!(integrator.time() <= 1.5);
    };
    assert!(integrator.state().iter().all(|y| y.is_finite()));
    assert!(integrator.time() <= 1.0 + 1e-9);
    let system = integrator.into_system();
    assert_eq!(Rc::strong_count(&system.alive), 2);
    drop(system);
    assert_eq!(Rc::strong_count(&alive), 1);
    error
}

const PLACES: [Callback; 3] = [Callback::Flow, Callback::Jacobian, Callback::Quadrature];

#[test]
fn a_panic_in_any_callback_is_an_error() {
    for place in PLACES {
        match failure(place, Fault::Panic) {
            IntegrateError::Panic { callback, time, message } => {
                assert_eq!(callback, place);
                assert!(time >= 1.0 && message.contains("deliberate"));
            }
            other => panic!("{other:?}"),
        }
    }
}

#[test]
fn a_value_that_is_not_finite_is_an_error() {
    for place in PLACES {
        match failure(place, Fault::NotFinite) {
            IntegrateError::NotFinite { callback, time, index } => {
                assert_eq!((callback, index), (place, 1));
                assert!(time >= 1.0);
            }
            other => panic!("{place}: {other:?}"),
        }
    }
}

#[test]
fn refusing_and_stopping_are_told_apart() {
    for place in PLACES {
        assert!(
            matches!(failure(place, Fault::Retry), IntegrateError::Refused { callback, .. } if callback == place)
        );
        assert!(
            matches!(failure(place, Fault::Stop), IntegrateError::Stopped { callback, .. } if callback == place)
        );
    }
}

#[test]
fn dropping_in_the_middle_frees_the_system() {
    let alive = Rc::new(());
    let pattern = Pattern::new(2, std::iter::empty());
    let system = Faulty {
        pattern,
        fault: Fault::Stop,
        place: Callback::LinearSolver,
        alive: Rc::clone(&alive),
    };
    let mut integrator = Cvodes::new(system, 0.0, &[1.0, 2.0], &Options::default()).unwrap();
    integrator.step().unwrap();
    drop(integrator);
    assert_eq!(Rc::strong_count(&alive), 1);
}

#[test]
fn a_passing_nan_costs_a_smaller_step_only() {
    // The flow is not finite above 11; the solution stays at or below 10, only a first step that is
    // too long looks there.
    struct Touchy(Pattern);
    impl OdeSystem for Touchy {
        fn size(&self) -> usize {
            1
        }
        fn mass(&self) -> &[f64] {
            &[1.0]
        }
        fn flow(&mut self, _t: f64, y: &[f64], f: &mut [f64]) -> Result<(), Retry> {
            f[0] = if y[0] > 11.0 { f64::NAN } else { 10.0 * (10.0 - y[0]) };
            Ok(())
        }
        fn pattern(&self) -> &Pattern {
            &self.0
        }
        fn symmetric(&self) -> bool {
            true
        }
        fn jacobian(&mut self, _t: f64, _y: &[f64], values: &mut [f64]) -> Result<(), Retry> {
            values.fill(-10.0);
            Ok(())
        }
    }
    let options = Options { initial_step: Some(1.0), ..Options::default() };
    let mut integrator =
        Cvodes::new(Touchy(Pattern::new(1, std::iter::empty())), 0.0, &[0.0], &options).unwrap();
    integrator.set_stop(5.0);
    while !integrator.step().unwrap().at_stop {}
    assert!((integrator.state()[0] - 10.0).abs() < 1e-4);
    assert!(
        integrator.statistics().newton_failures + integrator.statistics().error_test_failures > 0
    );
}

#[test]
fn a_start_close_to_where_no_flow_can_be_had() {
    // CVODES guesses its first step from the flow ahead, and left the state that it looked at last
    // in the output.
    struct Walled(Pattern, f64);
    impl OdeSystem for Walled {
        fn size(&self) -> usize {
            1
        }
        fn mass(&self) -> &[f64] {
            &[1.0]
        }
        fn flow(&mut self, t: f64, _y: &[f64], f: &mut [f64]) -> Result<(), Retry> {
            f[0] = 1.0;
            if t > self.1 { Err(Retry::SmallerStep) } else { Ok(()) }
        }
        fn pattern(&self) -> &Pattern {
            &self.0
        }
        fn symmetric(&self) -> bool {
            true
        }
        fn jacobian(&mut self, _t: f64, _y: &[f64], values: &mut [f64]) -> Result<(), Retry> {
            values.fill(0.0);
            Ok(())
        }
    }
    for gap in [1e-3, 1e-6, 1e-9] {
        let system = Walled(Pattern::new(1, std::iter::empty()), gap);
        let mut integrator = Cvodes::new(system, 0.0, &[0.0], &Options::default()).unwrap();
        integrator.set_stop(1e6);
        let error = (0..1000).find_map(|_| integrator.step().err()).unwrap();
        assert!(
            matches!(error, IntegrateError::Refused { callback: Callback::Flow, .. }),
            "{error:?}"
        );
        let time = integrator.time();
        assert!(time > 0.05 * gap, "no step at all from {gap} in front");
        assert!((integrator.state()[0] - time).abs() <= 1e-12 * gap, "{:?}", integrator.state());
    }
}

#[test]
fn too_many_steps() {
    let options = Options { max_steps: 7, ..Options::default() };
    let mut integrator = Cvodes::new(plate(3, 1.0), 0.0, &[20.0; 9], &options).unwrap();
    integrator.set_stop(1e3);
    let error = (0..8).find_map(|_| integrator.step().err()).unwrap();
    assert!(matches!(error, IntegrateError::TooManySteps { steps: 7, time } if time > 0.0));
}

#[test]
fn a_matrix_that_is_not_positive_definite() {
    // Growth with a rate far above one over the first step: ten reductions by four do not help.
    for (n, linear_solver) in [(3, LinearSolver::Dense), (40, LinearSolver::Cholesky)] {
        let entries: Vec<_> = (0..n).map(|i| (i, i, if i == 1 { 1e14 } else { -1.0 })).collect();
        let system = Linear::new(vec![1.0; n], &entries, Box::new(|_, _| {}));
        let options = Options { initial_step: Some(1.0), linear_solver, ..Options::default() };
        let mut integrator = Cvodes::new(system, 0.0, &vec![1.0; n], &options).unwrap();
        integrator.set_stop(10.0);
        let error = integrator.step().unwrap_err();
        let expected = FactorError::NotPositiveDefinite { index: 1 };
        assert!(
            matches!(error, IntegrateError::Linear { cause, .. } if cause == expected),
            "{error:?}"
        );
    }
}

#[test]
fn a_wrong_jacobian_is_a_newton_failure() {
    struct Wrong(Linear);
    impl OdeSystem for Wrong {
        fn size(&self) -> usize {
            self.0.size()
        }
        fn mass(&self) -> &[f64] {
            &self.0.mass
        }
        fn flow(&mut self, t: f64, y: &[f64], f: &mut [f64]) -> Result<(), Retry> {
            self.0.flow(t, y, f)
        }
        fn pattern(&self) -> &Pattern {
            &self.0.pattern
        }
        fn symmetric(&self) -> bool {
            true
        }
        fn jacobian(&mut self, _t: f64, _y: &[f64], values: &mut [f64]) -> Result<(), Retry> {
            values.fill(0.0);
            Ok(())
        }
    }
    let entries = [(0, 0, -1.0), (1, 1, -1e14), (2, 2, -1.0)];
    let system = Wrong(Linear::new(vec![1.0; 3], &entries, Box::new(|_, _| {})));
    let options = Options { initial_step: Some(1.0), ..Options::default() };
    let mut integrator = Cvodes::new(system, 0.0, &[1.0; 3], &options).unwrap();
    integrator.set_stop(10.0);
    let error = integrator.step().unwrap_err();
    assert!(matches!(error, IntegrateError::Newton { step, .. } if step > 0.0), "{error:?}");
}

#[test]
fn a_tolerance_below_rounding() {
    let options = Options { tolerance: 1e-18, ..Options::default() };
    let mut integrator = Cvodes::new(plate(3, 1.0), 0.0, &[20.0; 9], &options).unwrap();
    integrator.set_stop(1e3);
    let error = (0..10_000).find_map(|_| integrator.step().err()).unwrap();
    assert!(matches!(error, IntegrateError::ToleranceTooSmall { .. }), "{error:?}");
}

#[test]
fn a_jump_that_no_step_passes() {
    // The source jumps without a stop time, by more than the smallest step forgives.
    let source = |t: f64, b: &mut [f64]| b[0] = if t >= 1.0 { 1e30 } else { 0.0 };
    let system = Linear::network(vec![1.0], &[(0, None, 1.0)], Box::new(source));
    let mut integrator = Cvodes::new(system, 0.0, &[1.0], &Options::default()).unwrap();
    integrator.set_stop(10.0);
    let error = (0..10_000).find_map(|_| integrator.step().err()).unwrap();
    assert!(
        matches!(error, IntegrateError::Stalled { time, index: 0, .. } if time < 1.0),
        "{error:?}"
    );
}

#[test]
fn noise_that_no_step_resolves() {
    let source = |t: f64, b: &mut [f64]| b[1] = if t > 0.0 { 1e30 * (1e15 * t).sin() } else { 0.0 };
    let system = Linear::network(vec![1.0; 2], &[(0, None, 1.0), (1, None, 1.0)], Box::new(source));
    let options = Options { initial_step: Some(1e-3), ..Options::default() };
    let mut integrator = Cvodes::new(system, 0.0, &[1.0, 1.0], &options).unwrap();
    integrator.set_stop(10.0);
    let error = (0..10_000).find_map(|_| integrator.step().err()).unwrap();
    assert!(matches!(error, IntegrateError::ErrorTest { index: 1, .. }), "{error:?}");
    assert!(error.to_string().contains("component 1"));
}

#[test]
fn what_new_refuses() {
    let start = |system: Linear, y0: &[f64], options: &Options| {
        Cvodes::new(system, 0.0, y0, options).map(|_| ()).unwrap_err()
    };
    let good = Options::default();
    assert!(matches!(
        start(plate(2, 1.0), &[0.0; 3], &good),
        IntegrateError::WrongLength { what: "y0", .. }
    ));
    let nan = [0.0, f64::NAN, 0.0, 0.0];
    assert!(matches!(
        start(plate(2, 1.0), &nan, &good),
        IntegrateError::InvalidState { index: 1, .. }
    ));
    let mut massless = plate(2, 1.0);
    massless.mass[3] = 0.0;
    assert!(matches!(
        start(massless, &[0.0; 4], &good),
        IntegrateError::InvalidMass { index: 3, .. }
    ));
    for tolerance in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let options = Options { tolerance, ..Options::default() };
        let error = start(plate(2, 1.0), &[0.0; 4], &options);
        assert!(matches!(error, IntegrateError::InvalidOption { option: "tolerance", .. }));
    }
    let mut upwind = plate(2, 1.0);
    upwind.symmetric = false;
    let options = Options { linear_solver: LinearSolver::Cholesky, ..Options::default() };
    let error = start(upwind, &[0.0; 4], &options);
    assert!(matches!(error, IntegrateError::Linear { cause: FactorError::NotSymmetric, .. }));
    assert!(matches!(
        start(Linear::new(vec![], &[], Box::new(|_, _| {})), &[], &good),
        IntegrateError::InvalidOption { .. }
    ));
}

#[test]
fn restart_refuses_bad_states() {
    let mut integrator = Cvodes::new(plate(2, 1.0), 0.0, &[0.0; 4], &Options::default()).unwrap();
    assert!(matches!(integrator.restart(Some(&[0.0; 3])), Err(IntegrateError::WrongLength { .. })));
    let bad = [0.0, 0.0, f64::INFINITY, 0.0];
    assert!(matches!(
        integrator.restart(Some(&bad)),
        Err(IntegrateError::InvalidState { index: 2, .. })
    ));
    integrator.restart(Some(&[1.0; 4])).unwrap();
    assert!((integrator.state()[0] - 1.0).abs() <= 0.0);
}
