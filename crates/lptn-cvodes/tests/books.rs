//! The running integrals agree with what the state has gained.
#![allow(clippy::unwrap_used, reason = "a test may")]

use crate::common;
use crate::radiation;

use common::{Linear, plate};
use lptn_cvodes::Cvodes;
use lptn_integrate::{Integrator, OdeSystem, Options};
use radiation::Radiating;

/// Largest difference between stored and booked, relative to `turnover` per unit of time.
fn mismatch(system: Linear, end: f64, turnover: f64, options: &Options) -> f64 {
    let y0 = vec![20.0; system.size()];
    let before = system.total_heat(&y0);
    let mut integrator = Cvodes::new(system, 0.0, &y0, options).unwrap();
    integrator.set_stop(end);
    let mut worst = 0.0_f64;
    while integrator.time() < end {
        integrator.step().unwrap();
        let stored = integrator.system().total_heat(integrator.state()) - before;
        let booked = integrator.quadratures().unwrap()[0];
        worst = worst.max((stored - booked).abs() / (turnover * integrator.time()).max(turnover));
    }
    worst
}

#[test]
fn linear_books_close_small_and_large() {
    for (n, end) in [(3, 100.0), (40, 2e3)] {
        for tolerance in [1e-3, 1e-5, 1e-7] {
            let mut system = plate(n, 300.0);
            system.books = true;
            let options = Options { tolerance, ..Options::default() };
            let off = mismatch(system, end, 300.0, &options);
            assert!(off < 1e-11, "{n} by {n} cells at {tolerance:e}: {off:e}");
        }
    }
}

#[test]
fn books_close_over_restarts() {
    let mut system = plate(40, 300.0);
    system.books = true;
    let y0 = vec![20.0; system.size()];
    let before = system.total_heat(&y0);
    let mut integrator = Cvodes::new(system, 0.0, &y0, &Options::default()).unwrap();
    let mut added = 0.0;
    for k in 1..=10 {
        integrator.set_stop(f64::from(k) * 7.0);
        while !integrator.step().unwrap().at_stop {}
        let mut y = integrator.state().to_vec();
        y[5] += 1.0;
        added += 1.0;
        integrator.restart((k % 2 == 0).then_some(&y)).unwrap();
        added -= f64::from(k % 2);
    }
    let stored = integrator.system().total_heat(integrator.state()) - before;
    let booked = integrator.quadratures().unwrap()[0];
    assert!(
        (stored - booked - added).abs() < 1e-11 * 300.0 * 70.0,
        "{:e}",
        stored - booked - added
    );
    assert_eq!(integrator.statistics().restarts, 10);
}

#[test]
fn nonlinear_books_close() {
    for (rows, columns) in [(2, 3), (1, 200), (20, 20)] {
        for (tolerance, allowed) in [(1e-3, 1e-6), (1e-5, 1e-8)] {
            let system = Radiating::plate(rows, columns, 1000.0, 5e-9);
            let y0 = vec![293.15; system.size()];
            let options = Options { tolerance, ..Options::default() };
            let mut integrator = Cvodes::new(system, 0.0, &y0, &options).unwrap();
            integrator.set_stop(100.0);
            while !integrator.step().unwrap().at_stop {}
            let stored: f64 = integrator.state().iter().zip(&y0).map(|(y, y0)| y - y0).sum();
            let q = integrator.quadratures().unwrap();
            let off = (stored - q[0] - q[1]).abs() / (q[0] + q[2]);
            assert!(off < allowed, "{rows} by {columns} at {tolerance:e}: {off:e}");
        }
    }
}

#[test]
fn no_quadratures_is_an_empty_slice() {
    let mut integrator = Cvodes::new(plate(3, 1.0), 0.0, &[0.0; 9], &Options::default()).unwrap();
    integrator.step().unwrap();
    assert!(integrator.quadratures().unwrap().is_empty());
}
