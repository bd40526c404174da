//! Derivatives of the state by parameters against those of closed forms.
#![allow(clippy::unwrap_used, reason = "a test may")]

use crate::common;
use crate::matrix;
use crate::sensitive;

use common::equal_times;
use lptn_cvodes::Cvodes;
use lptn_integrate::{
    IntegrateError, Integrator, LinearSolver, LinearSolverKind, OdeSystem, Options, Retry,
};
use sensitive::{Body, Quadratic, Row, Skins};

/// Error of values against exact ones, in units of the tolerance over the scale of each block.
fn in_tolerances(found: &[f64], exact: &[f64], scales: &[f64], tolerance: f64) -> f64 {
    assert_eq!(found.len(), exact.len());
    let length = found.len() / scales.len();
    let pairs = found.iter().zip(exact).enumerate();
    pairs.fold(0.0, |most: f64, (i, (a, b))| {
        most.max((a - b).abs() * scales[i / length] / tolerance)
    })
}

fn options(tolerance: f64, scales: &[f64]) -> Options {
    Options { tolerance, sensitivity_scales: scales.to_vec(), ..Options::default() }
}

fn run_to<S: OdeSystem>(integrator: &mut Cvodes<S>, stop: f64) {
    integrator.set_stop(stop);
    while !integrator.step().unwrap().at_stop {}
}

/// The gearbox of the paper as one node: K/W, J/K, W, K.
const BODY: (f64, f64, f64) = (0.3046, 2659.0, 220.6);

fn body(t0: f64, tolerance: f64) -> Cvodes<Body> {
    let scales = [BODY.0, BODY.1, BODY.2, 10.0];
    let system = Body::new(BODY.0, BODY.1, BODY.2);
    let mut integrator = Cvodes::new(system, 0.0, &[t0], &options(tolerance, &scales)).unwrap();
    integrator.set_sensitivities(&[0.0, 0.0, 0.0, 1.0]).unwrap();
    integrator
}

/// Analytic, tolerance: a step response by R, C, P and T0, between the steps as well.
#[test]
fn a_step_response_by_its_parameters() {
    for tolerance in [1e-3, 1e-4, 1e-5, 1e-7] {
        let mut integrator = body(20.0, tolerance);
        assert_eq!(integrator.sensitivities().unwrap(), [0.0, 0.0, 0.0, 1.0]);
        integrator.set_stop(4000.0);
        let mut s = [0.0; 4];
        let mut worst = 0.0_f64;
        for t in equal_times(4000.0, 97) {
            while integrator.time() < t {
                integrator.step().unwrap();
            }
            integrator.interpolate_sensitivities(t, &mut s).unwrap();
            let (_, exact) = integrator.system().exact(20.0, t);
            worst =
                worst.max(in_tolerances(&s, &exact, &[BODY.0, BODY.1, BODY.2, 10.0], tolerance));
        }
        assert!(worst < 10.0, "{worst} tolerances at {tolerance:e}");
        assert_eq!(integrator.statistics().restarts, 0);
        let (_, exact) = integrator.system().exact(20.0, 4000.0);
        let at_end = in_tolerances(integrator.sensitivities().unwrap(), &exact, &[1.0; 4], 1e-2);
        assert!(at_end < 1.0);
    }
}

/// Analytic: the derivative of the matrix exponential is a block of the exponential of a larger
/// matrix (C. Van Loan, IEEE Trans. Autom. Control 23 (1978) 395).
#[test]
fn two_nodes_agree_with_the_derivative_of_the_matrix_exponential() {
    let (g, out, power, c) = (130.0, 3.4, 220.0, 1300.0);
    let (t, y0, scales) = (700.0, [5.0, -3.0], [g, out, power, c]);
    let exact = |i| matrix::two_nodes_by(i, (g, out, power, c), (t, y0));
    for tolerance in [1e-4, 1e-6] {
        for symmetric in [true, false] {
            let system = Row::new(2, (g, out, power, c), symmetric);
            let mut integrator =
                Cvodes::new(system, 0.0, &y0, &options(tolerance, &scales)).unwrap();
            run_to(&mut integrator, t);
            let found = integrator.sensitivities().unwrap();
            let expected: Vec<f64> = (0..4).flat_map(exact).collect();
            let off = in_tolerances(found, &expected, &scales, tolerance);
            assert!(off < 10.0, "{off} tolerances at {tolerance:e}: {found:?} {expected:?}");
        }
    }
}

/// Analytic: `y = y0 / (1 + k y0 t)`.
#[test]
fn a_quadratic_decay_by_its_rate_and_its_start() {
    let (k, y0, scales) = (0.01, 300.0, [0.01, 300.0]);
    for tolerance in [1e-4, 1e-6, 1e-8] {
        let mut integrator =
            Cvodes::new(Quadratic::new(k), 0.0, &[y0], &options(tolerance, &scales)).unwrap();
        integrator.set_sensitivities(&[0.0, 1.0]).unwrap();
        for t in [0.1, 1.0, 10.0, 100.0] {
            run_to(&mut integrator, t);
            let spread = 1.0 + k * y0 * t;
            let exact = [-y0 * y0 * t / (spread * spread), 1.0 / (spread * spread)];
            let off =
                in_tolerances(integrator.sensitivities().unwrap(), &exact, &scales, tolerance);
            assert!(off < 10.0, "{off} tolerances at {tolerance:e} and {t}");
        }
    }
}

/// Analytic, by all four direct solvers. With `0 = y - z - a z^4` and `y' = -a z^4`, the time from
/// `z0` down to `z` is `(z^-3 - z0^-3) / (3 a) - 4 ln(z / z0)`; differentiated by `a` with `z0(a)`,
/// and `y = z + a z^4`.
#[test]
fn radiating_skins_by_their_emissivity_with_algebraic_unknowns() {
    let (a, y0, t, tolerance) = (5e-9, 900.0, 3.0, 1e-6);
    let exact = |system: &Skins| {
        let z0 = system.skin(y0);
        let time = |z: f64| (z.powi(-3) - z0.powi(-3)) / (3.0 * a) - 4.0 * (z / z0).ln();
        let (mut low, mut high) = (1.0, z0);
        for _ in 0..200 {
            let middle = 0.5 * (low + high);
            if time(middle) > t { low = middle } else { high = middle }
        }
        let z = low;
        let start_by_a = -z0.powi(4) / (1.0 + 4.0 * a * z0.powi(3));
        let by_a = -(z.powi(-3) - z0.powi(-3)) / (3.0 * a * a);
        let by_start = z0.powi(-4) / a + 4.0 / z0;
        let by_z = -z.powi(-4) / a - 4.0 / z;
        let z_by_a = -(by_a + by_start * start_by_a) / by_z;
        z.powi(4) + (1.0 + 4.0 * a * z.powi(3)) * z_by_a
    };
    let solvers = [
        (1, true, LinearSolver::Auto, LinearSolverKind::DenseCholesky),
        (1, false, LinearSolver::Auto, LinearSolverKind::DenseLu),
        (20, true, LinearSolver::Auto, LinearSolverKind::SparseCholesky),
        (20, false, LinearSolver::Auto, LinearSolverKind::SparseLu),
        (20, true, LinearSolver::Pcg, LinearSolverKind::Pcg),
    ];
    for (n, symmetric, linear_solver, kind) in solvers {
        let options = Options { linear_solver, ..options(tolerance, &[a]) };
        let system = Skins::new(n, a, symmetric);
        let expected = vec![exact(&system); n];
        let mut integrator = Cvodes::new(system, 0.0, &vec![y0; n], &options).unwrap();
        run_to(&mut integrator, t);
        assert_eq!(integrator.linear_solver(), kind);
        let off = in_tolerances(integrator.sensitivities().unwrap(), &expected, &[a], tolerance);
        assert!(off < 10.0, "{off} tolerances by {kind:?}");
    }
}

/// Analytic: a power that jumps at a time which is the parameter. Behind it `T` moves with
/// `(P1 - P2) / C` times what is left of it.
#[test]
fn a_jump_whose_time_is_a_parameter_makes_the_sensitivity_jump() {
    let (r, c, first, second, jump) = (0.3, 2700.0, 200.0, 50.0, 500.0);
    let tolerance = 1e-6;
    let mut integrator =
        Cvodes::new(Body::new(r, c, first), 0.0, &[0.0], &options(tolerance, &[1.0; 4])).unwrap();
    run_to(&mut integrator, jump);
    let before = integrator.sensitivities().unwrap().to_vec();
    integrator.system_mut().p = second;
    integrator.restart(None).unwrap();
    assert_eq!(integrator.sensitivities().unwrap(), before);
    // The block of T0 serves for the time of the jump: its flow has no direct part.
    let mut s = before.clone();
    s[3] = (first - second) / c;
    integrator.set_sensitivities(&s).unwrap();
    assert_eq!(integrator.statistics().restarts, 1);
    assert_eq!(integrator.sensitivities().unwrap(), s);
    run_to(&mut integrator, 1500.0);
    let decay = (-(1500.0 - jump) / (r * c)).exp();
    let expected = (first - second) / c * decay;
    assert!((integrator.sensitivities().unwrap()[3] - expected).abs() < 10.0 * tolerance);
    // R and C act before and behind the jump.
    let (start, [by_r, by_c, by_p, _]) = Body::new(r, c, first).exact(0.0, jump);
    let (_, then) = Body::new(r, c, second).exact(start, 1500.0 - jump);
    let expected = [then[0] + decay * by_r, then[1] + decay * by_c, then[2] + decay * by_p];
    let found = &integrator.sensitivities().unwrap()[..3];
    assert!(in_tolerances(found, &expected, &[1.0; 3], tolerance) < 10.0, "{found:?} {expected:?}");
}

/// Analytic. In the middle of a run, new sensitivities are a new start, which is counted; the books
/// go on.
#[test]
fn new_sensitivities_between_steps_begin_anew() {
    let mut integrator = body(20.0, 1e-6);
    run_to(&mut integrator, 700.0);
    integrator.set_sensitivities(&[0.0, 0.0, 0.0, 1.0]).unwrap();
    assert_eq!(integrator.statistics().restarts, 1);
    let (start, system) = (integrator.state()[0], Body::new(BODY.0, BODY.1, BODY.2));
    run_to(&mut integrator, 2000.0);
    let (_, exact) = system.exact(start, 1300.0);
    let scales = [BODY.0, BODY.1, BODY.2, 10.0];
    assert!(in_tolerances(integrator.sensitivities().unwrap(), &exact, &scales, 1e-6) < 10.0);
    let stored = BODY.1 * (integrator.state()[0] - 20.0);
    let q = integrator.quadratures().unwrap();
    assert!((stored - q[0] + q[1]).abs() < 1e-10 * q[0]);
}

/// Analytic: at a root, back inside the step before it, and on from there.
#[test]
fn roots_and_a_rewind_leave_the_sensitivities_right() {
    let scales = [BODY.0, BODY.1, BODY.2, 10.0];
    let mut system = Body::new(BODY.0, BODY.1, BODY.2);
    system.levels = vec![40.0, 60.0];
    let mut integrator = Cvodes::new(system, 0.0, &[20.0], &options(1e-7, &scales)).unwrap();
    integrator.set_sensitivities(&[0.0, 0.0, 0.0, 1.0]).unwrap();
    integrator.set_stop(5000.0);
    let off = |integrator: &mut Cvodes<Body>| {
        let (_, exact) = integrator.system().exact(20.0, integrator.time());
        in_tolerances(integrator.sensitivities().unwrap(), &exact, &scales, 1e-7)
    };
    let mut met = 0;
    loop {
        let step = integrator.step().unwrap();
        assert!(off(&mut integrator) < 10.0);
        if step.at_stop {
            break;
        }
        if step.roots {
            met += 1;
            let back = 0.3 * step.from + 0.7 * step.to;
            let mut there = [0.0; 4];
            integrator.interpolate_sensitivities(back, &mut there).unwrap();
            if met == 2 {
                integrator.rewind(back).unwrap();
                assert!((integrator.time() - back).abs() <= 0.0);
                assert_eq!(integrator.sensitivities().unwrap(), there);
                assert!(off(&mut integrator) < 10.0);
                let again = integrator.interpolate_sensitivities(step.to, &mut there);
                assert!(matches!(again, Err(IntegrateError::OutsideLastStep { .. })));
            }
        }
    }
    assert_eq!(met, 3);
}

/// Analytic: a stop time inside the internal step that a root interrupted makes CVODES begin anew
/// at the root.
#[test]
fn a_stop_inside_an_interrupted_step_keeps_the_sensitivities() {
    let scales = [BODY.0, BODY.1, BODY.2, 10.0];
    let mut system = Body::new(BODY.0, BODY.1, BODY.2);
    system.levels = vec![30.0, 40.0, 50.0, 60.0];
    let mut integrator = Cvodes::new(system, 0.0, &[20.0], &options(1e-6, &scales)).unwrap();
    integrator.set_sensitivities(&[0.0, 0.0, 0.0, 1.0]).unwrap();
    for _ in 0..4 {
        integrator.set_stop(f64::INFINITY);
        while !integrator.step().unwrap().roots {}
        let stop = integrator.time() + 1e-3;
        run_to(&mut integrator, stop);
        let (_, exact) = integrator.system().exact(20.0, stop);
        assert!(in_tolerances(integrator.sensitivities().unwrap(), &exact, &scales, 1e-6) < 10.0);
    }
}

/// Property: the largest component rules, so that idle nodes change neither steps nor values; a
/// mean over all of them would.
#[test]
fn idle_nodes_do_not_dilute_the_error_of_sensitivities() {
    let run = |idle: usize| {
        let system = Row::new(2, (130.0, 3.4, 220.0, 1300.0), true).with_idle(idle);
        let y0 = vec![0.0; 2 + idle];
        // nothing but the sensitivities is asked to be accurate
        let options = options(1.0, &[1.3e8, 3.4e6, 2.2e8, 1.3e9]);
        let mut integrator = Cvodes::new(system, 0.0, &y0, &options).unwrap();
        run_to(&mut integrator, 1000.0);
        let s = integrator.sensitivities().unwrap().to_vec();
        (
            integrator.statistics().steps,
            s.chunks_exact(2 + idle).map(|block| block[0]).collect::<Vec<_>>(),
        )
    };
    let ((alone, values), (among, same)) = (run(0), run(5000));
    assert_eq!(alone, among);
    let close = |(a, b): (&f64, &f64)| (a - b).abs() < 1e-9 * a.abs();
    assert!(values.iter().zip(&same).all(close), "{values:?} {same:?}");
}

/// Tolerance: a larger scale asks for a smaller error, and gets it with more steps.
#[test]
fn scales_say_how_accurate_each_sensitivity_is() {
    let (p, t) = ((130.0, 3.4, 220.0, 1300.0), 1000.0);
    let run = |scale: f64| {
        let system = Row::new(2, p, true);
        let options = options(1e-4, &[1e-9, scale, 1e-9, 1e-9]);
        let mut integrator = Cvodes::new(system, 0.0, &[0.0; 2], &options).unwrap();
        run_to(&mut integrator, t);
        let exact = matrix::two_nodes_by(1, p, (t, [0.0; 2]));
        let found = &integrator.sensitivities().unwrap()[2..4];
        let off = (found[0] - exact[0]).abs().max((found[1] - exact[1]).abs());
        (integrator.statistics().steps, off)
    };
    let mut before = run(1e-9).0;
    for scale in [1e2, 1e4] {
        let (steps, off) = run(scale);
        assert!(steps > before && off < 10.0 * 1e-4 / scale, "{steps} after {before}, off {off:e}");
        before = steps;
    }
}

/// Conservation: books close as without sensitivities.
#[test]
fn books_close_beside_sensitivities() {
    for n in [2, 50] {
        let mut system = Row::new(n, (130.0, 3.4, 220.0, 13.0), true);
        system.books = true;
        let mut integrator =
            Cvodes::new(system, 0.0, &vec![0.0; n], &options(1e-5, &[130.0, 3.4, 220.0, 13.0]))
                .unwrap();
        run_to(&mut integrator, 300.0);
        let stored: f64 = integrator.state().iter().map(|y| 13.0 * y).sum();
        let q = integrator.quadratures().unwrap()[0];
        assert!((stored - q).abs() < 1e-11 * q.abs(), "{:e}", (stored - q) / q);
    }
}

/// A stream into one cell at `k`, held to be symmetric with the Jacobian 0: see
/// `common/algebraic.rs`. Its parameter is the size of the inlet.
struct Held {
    rate: f64,
    left: bool,
    pattern: lptn_integrate::Pattern,
}

impl OdeSystem for Held {
    fn size(&self) -> usize {
        1
    }
    fn mass(&self) -> &[f64] {
        &[1.0]
    }
    fn flow(&mut self, t: f64, y: &[f64], f: &mut [f64]) -> Result<(), Retry> {
        f[0] = self.rate * (2.0 * t.sin() - y[0]);
        Ok(())
    }
    fn pattern(&self) -> &lptn_integrate::Pattern {
        &self.pattern
    }
    fn symmetric(&self) -> bool {
        true
    }
    fn leave_symmetry(&mut self) {
        self.left = true;
    }
    fn jacobian(&mut self, _t: f64, _y: &[f64], values: &mut [f64]) -> Result<(), Retry> {
        values[0] = if self.left { -self.rate } else { 0.0 };
        Ok(())
    }
    fn sensitivity_count(&self) -> usize {
        1
    }
    fn sensitivity_flow(
        &mut self,
        t: f64,
        _y: &[f64],
        s: &[f64],
        g: &mut [f64],
    ) -> Result<(), Retry> {
        g[0] = self.rate * (t.sin() - s[0]);
        Ok(())
    }
}

/// Analytic: the state is 2 times its derivative, and
/// `y = 2 k (k sin t - cos t + e^(-k t)) / (1 + k^2)`.
#[test]
fn leaving_symmetry_keeps_the_sensitivities() {
    for k in [1e4_f64, 1e6] {
        let system = Held {
            rate: k,
            left: false,
            pattern: lptn_integrate::Pattern::new(1, std::iter::empty()),
        };
        let mut integrator = Cvodes::new(system, 0.0, &[0.0], &options(1e-6, &[2.0])).unwrap();
        run_to(&mut integrator, 3.0);
        assert!(integrator.statistics().switched_to_lu.is_some());
        let exact = k * (k * 3.0_f64.sin() - 3.0_f64.cos()) / (1.0 + k * k);
        let found = integrator.sensitivities().unwrap()[0];
        assert!((found - exact).abs() < 1e-5, "{found} {exact}");
    }
}

#[test]
fn statistics_count_calls_and_no_sensitivities_are_no_blocks() {
    let mut integrator = body(20.0, 1e-5);
    run_to(&mut integrator, 1000.0);
    let statistics = integrator.statistics();
    assert!(statistics.sensitivity_evaluations >= statistics.steps);
    assert!(statistics.linear_solves >= 5 * statistics.steps);
    let mut plain =
        Cvodes::new(common::plate(3, 1.0), 0.0, &[0.0; 9], &Options::default()).unwrap();
    run_to(&mut plain, 10.0);
    assert_eq!(plain.statistics().sensitivity_evaluations, 0);
    assert!(plain.sensitivities().unwrap().is_empty());
    plain.interpolate_sensitivities(10.0, &mut []).unwrap();
    plain.set_sensitivities(&[]).unwrap();
}
