//! What sensitivities may do wrong, and that an integration can go on once the reason is gone.
#![allow(clippy::unwrap_used, reason = "a test may")]

use crate::sensitive;

use lptn_cvodes::Cvodes;
use lptn_integrate::{Callback, IntegrateError, Integrator, Options};
use sensitive::{Body, Fault};

fn started(fault: Option<(f64, Fault)>) -> Cvodes<Body> {
    let mut system = Body::new(0.3, 2700.0, 200.0);
    system.fault = fault;
    let options =
        Options { sensitivity_scales: vec![0.3, 2700.0, 200.0, 10.0], ..Options::default() };
    let mut integrator = Cvodes::new(system, 0.0, &[20.0], &options).unwrap();
    integrator.set_sensitivities(&[0.0, 0.0, 0.0, 1.0]).unwrap();
    integrator.set_stop(1000.0);
    integrator
}

fn failure(integrator: &mut Cvodes<Body>) -> IntegrateError {
    loop {
        if let Err(error) = integrator.step() {
            return error;
        }
    }
}

const FAULTS: [Fault; 4] = [Fault::Panic, Fault::NotFinite, Fault::Retry, Fault::Stop];

#[test]
fn every_fault_is_reported_with_its_callback_and_time() {
    for from in [0.0, 100.0] {
        for fault in FAULTS {
            let mut integrator = started(Some((from, fault)));
            let error = failure(&mut integrator);
            let (callback, time) = match (fault, error) {
                (Fault::Panic, IntegrateError::Panic { callback, time, message }) => {
                    assert_eq!(message, "deliberate");
                    (callback, time)
                }
                (Fault::NotFinite, IntegrateError::NotFinite { callback, time, index: 2 })
                | (Fault::Retry, IntegrateError::Refused { callback, time })
                | (Fault::Stop, IntegrateError::Stopped { callback, time }) => (callback, time),
                (fault, other) => panic!("{fault:?}: {other:?}"),
            };
            assert_eq!(callback, Callback::Sensitivity);
            assert!(time >= from && integrator.time() <= from + 1e-6);
            let text = failure(&mut integrator).to_string();
            assert!(text.contains("sensitivity"), "{text}");
        }
    }
}

/// Analytic: in the first step, and later. State, sensitivities and books are those of the last
/// good step, and the rest of the run is right.
#[test]
fn a_run_goes_on_when_the_fault_is_gone() {
    for from in [0.0, 1e-3, 100.0] {
        for fault in FAULTS {
            let mut integrator = started(Some((from, fault)));
            failure(&mut integrator);
            for again in [false, true] {
                if again {
                    integrator.system_mut().fault = None;
                    while !integrator.step().unwrap().at_stop {}
                }
                let (y, exact) = integrator.system().exact(20.0, integrator.time());
                assert!((integrator.state()[0] - y).abs() < 1e-4);
                let found = integrator.sensitivities().unwrap();
                let scales = [0.3, 2700.0, 200.0, 10.0];
                let close = |i: usize| (found[i] - exact[i]).abs() * scales[i] < 1e-4;
                assert!(
                    (0..4).all(close),
                    "{fault:?} from {from}, again {again}: {found:?} {exact:?}"
                );
            }
            let stored = 2700.0 * (integrator.state()[0] - 20.0);
            let q = integrator.quadratures().unwrap();
            assert!((stored - q[0] + q[1]).abs() < 1e-10 * q[0]);
        }
    }
}

#[test]
fn what_is_refused_of_sensitivities() {
    let start = |sensitivity_scales: Vec<f64>| {
        let options = Options { sensitivity_scales, ..Options::default() };
        Cvodes::new(Body::new(0.3, 2700.0, 200.0), 0.0, &[20.0], &options)
    };
    let error = start(vec![1.0; 3]).map(|_| ()).unwrap_err();
    assert!(matches!(
        error,
        IntegrateError::WrongLength { what: "sensitivity_scales", expected: 4, found: 3 }
    ));
    for wrong in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let error = start(vec![1.0, wrong, 1.0, 1.0]).map(|_| ()).unwrap_err();
        assert!(matches!(
            error,
            IntegrateError::InvalidOption { option: "sensitivity_scales", .. }
        ));
    }
    let mut integrator = start(Vec::new()).unwrap();
    let error = integrator.set_sensitivities(&[0.0; 3]).unwrap_err();
    assert!(matches!(
        error,
        IntegrateError::WrongLength { what: "sensitivities", expected: 4, found: 3 }
    ));
    let error = integrator.set_sensitivities(&[0.0, 0.0, f64::NAN, 0.0]).unwrap_err();
    assert!(matches!(error, IntegrateError::InvalidState { index: 2, .. }));
    let error = integrator.interpolate_sensitivities(0.0, &mut [0.0; 3]).unwrap_err();
    assert!(matches!(error, IntegrateError::WrongLength { .. }));
    let error = integrator.interpolate_sensitivities(1.0, &mut [0.0; 4]).unwrap_err();
    assert!(matches!(error, IntegrateError::OutsideLastStep { .. }));
    assert_eq!(integrator.sensitivities().unwrap(), [0.0; 4]);
}
