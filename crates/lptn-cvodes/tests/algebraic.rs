//! Algebraic unknowns, states carried as another variable, and the way out of a bad symmetric
//! Jacobian.
#![allow(clippy::unwrap_used, reason = "a test may")]

use crate::algebraic_helper as algebraic;

use algebraic::{Melting, Stream, Surfaces};
use lptn_cvodes::Cvodes;
use lptn_integrate::{
    FactorError, IntegrateError, Integrator, LinearSolver, LinearSolverKind, OdeSystem, Options,
    Pattern, Retry,
};

/// Stefan-Boltzmann-like factor, surroundings, conductance between surfaces.
const SURFACE: (f64, f64, f64) = (5e-9, 293.15, 0.5);

fn options(tolerance: f64, linear_solver: LinearSolver) -> Options {
    Options { tolerance, linear_solver, ..Options::default() }
}

fn run_to<S: OdeSystem>(integrator: &mut Cvodes<S>, stop: f64) {
    integrator.set_stop(stop);
    while !integrator.step().unwrap().at_stop {}
}

fn assert_near(y: &[f64], expected: &[f64], allowed: f64) {
    for (i, (y, expected)) in y.iter().zip(expected).enumerate() {
        assert!((y - expected).abs() <= allowed, "component {i}: {y} instead of {expected}");
    }
}

/// Analytic. With `e = s (z^4 - a^4)` the balance is `y = z + e(z)` and `y' = -e`, so that `t` is
/// the integral of `(1 + e') / e` over `z`: inverted in Python (scipy 1.17.1: `quad`, `brentq`),
/// and confirmed to 1e-11 by `solve_ivp` with DOP853 at rtol 1e-12.
#[test]
fn a_radiating_skin_follows_its_closed_form() {
    for tolerance in [1e-3, 1e-4, 1e-5] {
        let system = Surfaces::new(1, SURFACE, true);
        let mut integrator =
            Cvodes::new(system, 0.0, &[1000.0], &options(tolerance, LinearSolver::Auto)).unwrap();
        for (t, y) in
            [(0.5, 815.600_867_826_83), (2.0, 530.107_395_710_599), (5.0, 359.937_629_452_359)]
        {
            run_to(&mut integrator, t);
            assert_near(integrator.state(), &[y], 10.0 * tolerance);
        }
    }
}

/// Tolerance. The numbers are `solve_ivp`'s (scipy 1.17.1) with DOP853 at rtol 1e-11; Radau at 1e-9
/// agrees to 3e-10.
#[test]
fn coupled_surfaces_agree_with_another_program_by_every_solver() {
    let expected = [518.756_915_845_6, 415.379_864_661_1, 324.552_706_845_6];
    let solvers = [
        (true, LinearSolver::Dense, LinearSolverKind::DenseCholesky),
        (true, LinearSolver::Cholesky, LinearSolverKind::SparseCholesky),
        (false, LinearSolver::Dense, LinearSolverKind::DenseLu),
        (false, LinearSolver::Lu, LinearSolverKind::SparseLu),
    ];
    for (symmetric, solver, kind) in solvers {
        let system = Surfaces::new(3, SURFACE, symmetric);
        let mut integrator =
            Cvodes::new(system, 0.0, &[1000.0, 600.0, 300.0], &options(1e-6, solver)).unwrap();
        assert_eq!(integrator.linear_solver(), kind);
        run_to(&mut integrator, 2.0);
        assert_near(integrator.state(), &expected, 1e-5);
        assert_eq!(integrator.statistics().switched_to_lu, None);
    }
}

/// Property. The Jacobian is exact, so Cholesky and LU are the same Newton method: the same steps,
/// the same state.
#[test]
fn cholesky_and_lu_agree_on_extended_matrices() {
    for n in [4, 40] {
        let run = |symmetric| {
            let y0: Vec<f64> = (0..n).map(|i| 300.0 + 17.0 * (i % 11) as f64).collect();
            let system = Surfaces::new(n, SURFACE, symmetric);
            let mut integrator = Cvodes::new(system, 0.0, &y0, &Options::default()).unwrap();
            run_to(&mut integrator, 10.0);
            (integrator.state().to_vec(), integrator.statistics())
        };
        let ((cholesky, a), (lu, b)) = (run(true), run(false));
        assert_eq!((a.steps, a.newton_iterations), (b.steps, b.newton_iterations));
        assert_eq!(a.newton_failures, 0);
        assert_near(&cholesky, &lu, 1e-9);
    }
}

/// Conservation.
#[test]
fn books_close_with_algebraic_unknowns() {
    for n in [1, 5, 60] {
        let y0 = vec![900.0; n];
        let system = Surfaces::new(n, SURFACE, true);
        let mut integrator = Cvodes::new(system, 0.0, &y0, &Options::default()).unwrap();
        run_to(&mut integrator, 20.0);
        let lost: f64 = y0.iter().zip(integrator.state()).map(|(a, b)| a - b).sum();
        let booked = integrator.quadratures().unwrap()[0];
        assert!((lost - booked).abs() < 1e-8 * booked, "{:e}", (lost - booked) / booked);
    }
}

/// Analytic. The body warms to 0 as an exponential, melts at constant power and warms on as an
/// exponential.
#[test]
fn melting_follows_its_closed_form() {
    let (latent, hot, k, y0) = (80.0, 100.0_f64, 0.5, -50.0);
    let melts = ((hot - y0) / hot).ln() / k;
    let molten = melts + latent / (k * hot);
    let exact = |t: f64| match t {
        t if t <= melts => hot - (hot - y0) * (-k * t).exp(),
        t if t <= molten => k * hot * (t - melts),
        t => latent + hot * (1.0 - (-k * (t - molten)).exp()),
    };
    for (symmetric, tolerance) in [(true, 1e-3), (true, 1e-5), (false, 1e-5)] {
        let system = Melting::new(1, (latent, hot, k), symmetric);
        let mut integrator =
            Cvodes::new(system, 0.0, &[y0], &options(tolerance, LinearSolver::Auto)).unwrap();
        for t in [0.5, melts, 1.5, molten, 4.0, 10.0] {
            run_to(&mut integrator, t);
            assert_near(integrator.state(), &[exact(t)], 10.0 * tolerance);
            integrator.restart(None).unwrap();
        }
        let booked = integrator.quadratures().unwrap()[0];
        assert!((integrator.state()[0] - y0 - booked).abs() < 1e-7 * booked);
    }
}

/// Conservation. Kinks are met unannounced, by dense and by sparse factors.
#[test]
fn a_melting_row_keeps_its_books() {
    for n in [5, 45] {
        let system = Melting::new(n, (80.0, 100.0, 20.0), true);
        let mut integrator =
            Cvodes::new(system, 0.0, &vec![-50.0; n], &Options::default()).unwrap();
        run_to(&mut integrator, 10.0);
        let gained: f64 = integrator.state().iter().map(|y| y + 50.0).sum();
        let booked = integrator.quadratures().unwrap()[0];
        assert!((gained - booked).abs() < 1e-8 * booked, "{:e}", (gained - booked) / booked);
        let temperatures: Vec<f64> =
            integrator.state().iter().map(|&y| integrator.system().temperature(y)).collect();
        assert!(temperatures.windows(2).all(|pair| pair[0] >= pair[1]), "{temperatures:?}");
    }
}

/// Analytic. A row of equal cells answers `sin t`, once its start is forgotten, with the gain
/// `(1 + 1 / k^2)^(-i / 2)` and the lag `i atan(1 / k)` at the `i`-th cell. `hold` is 0: Newton
/// diverges; -1: the matrix is not positive definite. The first step is long enough that three
/// reductions by four do not help.
#[test]
fn a_bad_symmetric_jacobian_is_left_for_lu() {
    let k = 1e6_f64;
    for (n, kind) in [(3, LinearSolverKind::DenseLu), (40, LinearSolverKind::SparseLu)] {
        for hold in [0.0, -1.0] {
            let options = Options { initial_step: Some(1.0), ..Options::default() };
            let system = Stream::new(n, k, hold, f64::sin);
            let mut integrator = Cvodes::new(system, 0.0, &vec![0.0; n], &options).unwrap();
            run_to(&mut integrator, 3.0);
            let statistics = integrator.statistics();
            assert_eq!(statistics.switched_to_lu, Some(0.0));
            assert_eq!((integrator.linear_solver(), integrator.system().left_at), (kind, 1));
            assert_eq!(statistics.restarts, 0);
            let cell = |i: i32| {
                (1.0 + 1.0 / (k * k)).powf(-f64::from(i) / 2.0)
                    * (3.0 - f64::from(i) * (1.0 / k).atan()).sin()
            };
            let expected: Vec<f64> = (1..).map(cell).take(n).collect();
            assert_near(integrator.state(), &expected, 1e-4);
            let stored: f64 = integrator.state().iter().sum();
            let q = integrator.quadratures().unwrap();
            assert!((stored - q[0] + q[1]).abs() < 1e-9 * q[0], "{:e}", stored - q[0] + q[1]);
        }
    }
}

/// Analytic. No step fails three times, but the wrong Jacobian lets Newton converge for steps below
/// `1 / k` only: 10 328 steps to 0.5 before such a stall was recognised.
#[test]
fn a_crawl_under_a_bad_symmetric_jacobian_is_left_too() {
    let k = 1e4_f64;
    let mut integrator =
        Cvodes::new(Stream::new(3, k, 0.0, f64::sin), 0.0, &[0.0; 3], &Options::default()).unwrap();
    run_to(&mut integrator, 3.0);
    let statistics = integrator.statistics();
    assert!(statistics.switched_to_lu.unwrap() > 0.0 && statistics.steps < 1000, "{statistics:?}");
    let cell = |i: f64| (1.0 + 1.0 / (k * k)).powf(-i / 2.0) * (3.0 - i * (1.0 / k).atan()).sin();
    assert_near(integrator.state(), &[1.0, 2.0, 3.0].map(cell), 1e-4);
    let stored: f64 = integrator.state().iter().sum();
    let q = integrator.quadratures().unwrap();
    assert!((stored - q[0] + q[1]).abs() < 1e-9 * q[0], "{:e}", stored - q[0] + q[1]);
}

/// Property. In the middle of a run the running integrals go on, and time and state stay those of
/// the last good step.
#[test]
fn leaving_symmetry_in_the_middle_keeps_the_books() {
    let inlet = |t: f64| if t > 1.0 { 100.0 } else { 0.0 };
    let mut integrator =
        Cvodes::new(Stream::new(3, 1e6, 0.0, inlet), 0.0, &[0.0; 3], &Options::default()).unwrap();
    run_to(&mut integrator, 1.0);
    assert_eq!(integrator.statistics().switched_to_lu, None);
    let before = integrator.statistics();
    run_to(&mut integrator, 2.0);
    let after = integrator.statistics();
    let time = after.switched_to_lu.unwrap();
    assert!((1.0..2.0).contains(&time), "{time}");
    assert!(after.steps > before.steps && after.newton_failures > before.newton_failures);
    assert_near(integrator.state(), &[100.0; 3], 1e-4);
    let stored: f64 = integrator.state().iter().sum();
    let q = integrator.quadratures().unwrap();
    assert!((stored - q[0] + q[1]).abs() < 1e-9 * q[0], "{:e}", stored - q[0] + q[1]);
}

/// One state and one unknown with the given entries of the mass.
struct Masses(Vec<f64>, Pattern, Vec<f64>);

impl OdeSystem for Masses {
    fn size(&self) -> usize {
        1
    }
    fn mass(&self) -> &[f64] {
        &self.0
    }
    fn flow(&mut self, _t: f64, y: &[f64], f: &mut [f64]) -> Result<(), Retry> {
        f[0] = -y[0];
        Ok(())
    }
    fn pattern(&self) -> &Pattern {
        &self.1
    }
    fn symmetric(&self) -> bool {
        false
    }
    fn slope(&self) -> Option<&[f64]> {
        Some(&self.2)
    }
    /// The unknown is in no balance: singular.
    fn jacobian(&mut self, _t: f64, _y: &[f64], values: &mut [f64]) -> Result<(), Retry> {
        values.fill(0.0);
        Ok(())
    }
}

#[test]
fn what_new_and_step_refuse_of_algebraic_rows() {
    let start = |mass: &[f64], slope: &[f64]| {
        let system = Masses(mass.to_vec(), Pattern::new(2, std::iter::empty()), slope.to_vec());
        Cvodes::new(system, 0.0, &[1.0], &Options::default())
    };
    let refused = |mass: &[f64], slope: &[f64]| start(mass, slope).map(|_| ()).unwrap_err();
    for wrong in [1.0, -1.0, f64::NAN] {
        let error = refused(&[1.0, wrong], &[1.0; 2]);
        assert!(matches!(error, IntegrateError::AlgebraicMass { row: 1, .. }), "{error:?}");
        assert!(error.to_string().contains("of algebraic row 1 is not 0"), "{error}");
    }
    assert!(matches!(refused(&[0.0; 2], &[1.0; 2]), IntegrateError::InvalidMass { index: 0, .. }));
    let error = refused(&[1.0], &[1.0; 2]);
    assert!(matches!(error, IntegrateError::WrongLength { what: "mass", expected: 2, found: 1 }));
    let error = refused(&[1.0, 0.0], &[1.0]);
    assert!(matches!(error, IntegrateError::WrongLength { what: "slope", expected: 2, found: 1 }));

    let error = start(&[1.0, 0.0], &[1.0; 2]).unwrap().step().unwrap_err();
    let singular = FactorError::Singular { index: 1 };
    assert!(
        matches!(error, IntegrateError::Linear { cause, .. } if cause == singular),
        "{error:?}"
    );
    let error = start(&[1.0, 0.0], &[f64::NAN, 1.0]).unwrap().step().unwrap_err();
    assert!(matches!(error, IntegrateError::NotFinite { index: 0, .. }), "{error:?}");
}
