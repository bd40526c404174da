//! Solutions known in closed form, and the promise that the error stays below ten times the
//! tolerance.
#![allow(clippy::unwrap_used, reason = "a test may")]

use crate::common;

use common::{Linear, equal_times, largest_error, sample};
use faer::Side;
use lptn_cvodes::Cvodes;
use lptn_integrate::{
    Integrator, LinearSolver, LinearSolverKind, OdeSystem, Options, Pattern, Retry,
};

const TOLERANCES: [f64; 3] = [1e-3, 1e-4, 1e-5];

fn none() -> common::Source {
    Box::new(|_, _| {})
}

/// Checks the promise at all tolerances.
fn keeps_its_promise(
    make: impl Fn() -> Linear,
    y0: &[f64],
    times: &[f64],
    exact: impl Fn(f64) -> Vec<f64>,
) {
    for tolerance in TOLERANCES {
        let error = largest_error(make(), y0, (times, tolerance), &exact);
        assert!(error <= 10.0 * tolerance, "error {error:e} at tolerance {tolerance:e}");
    }
}

#[test]
fn scalar_decay() {
    let make = || Linear::network(vec![2.0], &[(0, None, 0.5)], none());
    keeps_its_promise(make, &[100.0], &equal_times(40.0, 100), |t| vec![100.0 * (-t / 4.0).exp()]);
}

#[test]
fn two_by_two_with_time_constants_a_million_apart() {
    // Eigenvectors (1, 1) and (1, -1) with the eigenvalues -1 and -(1 + 2 g).
    let g = 1e6;
    let make = || {
        Linear::network(vec![1.0; 2], &[(0, Some(1), g), (0, None, 1.0), (1, None, 1.0)], none())
    };
    keeps_its_promise(make, &[100.0, 40.0], &equal_times(5.0, 60), |t| {
        let (slow, fast) = (70.0 * (-t).exp(), 30.0 * (-(1.0 + 2.0 * g) * t).exp());
        vec![slow + fast, slow - fast]
    });
}

/// The modes of a symmetric network: `y = sum of c_k(t) v_k / sqrt(M)`.
struct Modes {
    rates: Vec<f64>,
    vectors: faer::Mat<f64>,
    mass: Vec<f64>,
}

impl Modes {
    fn of(system: &Linear) -> Self {
        let n = system.size();
        let scaled = |i: usize, j: usize| {
            let entry = system.pattern().slot(i, j).map_or(0.0, |slot| system.matrix[slot]);
            entry / (system.mass[i] * system.mass[j]).sqrt()
        };
        let eigen = faer::Mat::from_fn(n, n, scaled).self_adjoint_eigen(Side::Lower).unwrap();
        let rates = (0..n).map(|k| -eigen.S()[k]).collect();
        Self { rates, vectors: eigen.U().to_owned(), mass: system.mass.clone() }
    }

    /// The state at `t` from rest at zero, with the source `amplitude sin(w t)` on the last
    /// component.
    fn driven(&self, t: f64, amplitude: f64, w: f64) -> Vec<f64> {
        let n = self.mass.len();
        let mut y = vec![0.0; n];
        for (k, &rate) in self.rates.iter().enumerate() {
            let drive = amplitude * self.vectors[(n - 1, k)] / self.mass[n - 1].sqrt();
            let response = (rate * (w * t).sin() - w * (w * t).cos() + w * (-rate * t).exp())
                / (rate * rate + w * w);
            for (i, y) in y.iter_mut().enumerate() {
                *y += drive * response * self.vectors[(i, k)] / self.mass[i].sqrt();
            }
        }
        y
    }
}

#[test]
fn stiff_ladder_with_a_sine_source() {
    let (n, w, amplitude) = (60, 0.7, 30.0);
    let make = || {
        let mass: Vec<f64> = (0..n).map(|i| 10_f64.powi(-(i % 7))).collect();
        let mut links: Vec<_> =
            (1..n as usize).map(|i| (i - 1, Some(i), 10_f64.powi(i as i32 % 4))).collect();
        links.push((0, None, 5.0));
        let source = move |t: f64, b: &mut [f64]| b[n as usize - 1] = amplitude * (w * t).sin();
        Linear::network(mass, &links, Box::new(source))
    };
    let modes = Modes::of(&make());
    assert!(modes.rates.iter().copied().fold(0.0, f64::max) > 1e6);
    keeps_its_promise(make, &vec![0.0; n as usize], &equal_times(20.0, 80), |t| {
        modes.driven(t, amplitude, w)
    });
}

/// A chain of equal cells between two boundaries at zero, started in its slowest mode, `sin(pi x)`.
fn chain(n: usize) -> (Linear, Vec<f64>, f64) {
    let mut links: Vec<_> = (1..n).map(|i| (i - 1, Some(i), 1.0)).collect();
    links.extend([(0, None, 1.0), (n - 1, None, 1.0)]);
    let angle = std::f64::consts::PI / (n + 1) as f64;
    let y0 = (1..=n).map(|i| 80.0 * (angle * i as f64).sin()).collect();
    let rate = 4.0 * (angle / 2.0).sin().powi(2);
    (Linear::network(vec![1.0; n], &links, none()), y0, rate)
}

#[test]
fn chain_of_a_thousand_cells_in_its_slowest_mode() {
    let (_, y0, rate) = chain(1000);
    let exact = |t: f64| y0.iter().map(|y| y * (-rate * t).exp()).collect::<Vec<_>>();
    keeps_its_promise(|| chain(1000).0, &y0, &equal_times(4.0 / rate, 50), exact);
}

#[test]
fn all_linear_solvers_give_the_same_solution() {
    let mut results = Vec::new();
    for linear_solver in [LinearSolver::Dense, LinearSolver::Cholesky, LinearSolver::Lu] {
        let (system, y0, rate) = chain(40);
        let options = Options { linear_solver, ..Options::default() };
        let mut integrator = Cvodes::new(system, 0.0, &y0, &options).unwrap();
        sample(&mut integrator, &[1.0 / rate], |_, _| {}).unwrap();
        results.push((
            integrator.state().to_vec(),
            integrator.statistics().steps,
            integrator.linear_solver(),
        ));
    }
    assert_eq!(results[0].2, LinearSolverKind::DenseCholesky);
    assert_eq!(results[1].2, LinearSolverKind::SparseCholesky);
    assert_eq!(results[2].2, LinearSolverKind::SparseLu);
    for result in &results[1..] {
        assert_eq!(result.1, results[0].1);
        assert!(result.0.iter().zip(&results[0].0).all(|(a, b)| (a - b).abs() < 1e-9));
    }
}

#[test]
fn automatic_choice() {
    let kind = |n, symmetric| {
        let (mut system, y0, _) = chain(n);
        system.symmetric = symmetric;
        Cvodes::new(system, 0.0, &y0, &Options::default()).unwrap().linear_solver()
    };
    assert_eq!(kind(30, true), LinearSolverKind::DenseCholesky);
    assert_eq!(kind(30, false), LinearSolverKind::DenseLu);
    assert_eq!(kind(31, true), LinearSolverKind::SparseCholesky);
    assert_eq!(kind(31, false), LinearSolverKind::SparseLu);
}

/// Robertson's reaction, the standard test of stiff codes. The components are scaled by a million,
/// since the tolerance is absolute and the second component is of the order of 1e-5.
struct Robertson {
    pattern: Pattern,
    mass: [f64; 3],
}

const SCALE: f64 = 1e6;

impl OdeSystem for Robertson {
    fn size(&self) -> usize {
        3
    }
    fn mass(&self) -> &[f64] {
        &self.mass
    }
    fn flow(&mut self, _t: f64, y: &[f64], f: &mut [f64]) -> Result<(), Retry> {
        let (a, b, c) = (y[0] / SCALE, y[1] / SCALE, y[2] / SCALE);
        f[0] = SCALE * (-0.04 * a + 1e4 * b * c);
        f[2] = SCALE * 3e7 * b * b;
        f[1] = -f[0] - f[2];
        Ok(())
    }
    fn pattern(&self) -> &Pattern {
        &self.pattern
    }
    fn symmetric(&self) -> bool {
        false
    }
    fn jacobian(&mut self, _t: f64, y: &[f64], values: &mut [f64]) -> Result<(), Retry> {
        let (b, c) = (y[1] / SCALE, y[2] / SCALE);
        // By columns.
        let first = [-0.04, 0.04, 0.0];
        let second = [1e4 * c, -1e4 * c - 6e7 * b, 6e7 * b];
        let third = [1e4 * b, -1e4 * b, 0.0];
        values.copy_from_slice(&[first, second, third].concat());
        Ok(())
    }
}

/// As printed by SUNDIALS' example `cvRoberts_dns`, which has four digits or so.
const PUBLISHED: [(f64, [f64; 3]); 8] = [
    (0.4, [9.851641e-1, 3.386242e-5, 1.480205e-2]),
    (4.0, [9.055097e-1, 2.240338e-5, 9.446793e-2]),
    (40.0, [7.157952e-1, 9.183486e-6, 2.841956e-1]),
    (400.0, [4.505420e-1, 3.222963e-6, 5.494548e-1]),
    (4e3, [1.831878e-1, 8.941319e-7, 8.168113e-1]),
    (4e4, [3.897868e-2, 1.621567e-7, 9.610212e-1]),
    (4e5, [4.940023e-3, 1.985716e-8, 9.950600e-1]),
    (4e6, [5.165107e-4, 2.067097e-9, 9.994835e-1]),
];

#[test]
fn robertson_as_published() {
    for linear_solver in [LinearSolver::Dense, LinearSolver::Lu] {
        let pattern = Pattern::new(3, [(0, 1), (0, 2), (1, 2)].into_iter());
        let system = Robertson { pattern, mass: [1.0; 3] };
        let options = Options { tolerance: 1e-4, linear_solver, ..Options::default() };
        let mut integrator = Cvodes::new(system, 0.0, &[SCALE, 0.0, 0.0], &options).unwrap();
        let times: Vec<f64> = PUBLISHED.iter().map(|row| row.0).collect();
        let mut rows = PUBLISHED.iter();
        sample(&mut integrator, &times, |t, y| {
            for (y, published) in y.iter().zip(rows.next().unwrap().1) {
                let relative = (y / SCALE / published - 1.0).abs();
                assert!(relative < 2e-3, "{relative:e} at {t}, {linear_solver:?}");
            }
        })
        .unwrap();
    }
}
