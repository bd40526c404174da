//! The one-step method: analytic solutions at all tolerances, books, events, counters.
#![allow(clippy::unwrap_used, reason = "tests")]
#![allow(clippy::float_cmp, reason = "what is compared is the same number")]

use lptn_integrate::{
    IntegrateError, Integrator, LinearSolver, OdeSystem, OneStep, Options, Pattern, Retry,
};
use std::f64::consts::PI;

/// Rods of equal cells between two walls, with a heat `q + r t` in every cell; walls at 0. Its
/// eigenvectors are sines. The running integrals are the heat put in and that of both walls.
struct Rods {
    cells: usize,
    mass: Vec<f64>,
    /// Of each rod in turn.
    conductance: Vec<f64>,
    heat: f64,
    ramp: f64,
    pattern: Pattern,
}

impl Rods {
    fn new(cells: usize, conductance: &[f64]) -> Self {
        let size = cells * conductance.len();
        let inner = move |&i: &usize| (i + 1) % cells != 0;
        let pairs = (0..size).filter(inner).map(|i| (i, i + 1));
        let pattern = Pattern::new(size, pairs);
        let conductance = conductance.to_vec();
        Self { cells, mass: vec![1.0; size], conductance, heat: 0.0, ramp: 0.0, pattern }
    }

    fn rate(&self, rod: usize, mode: usize) -> f64 {
        let angle = PI * mode as f64 / (self.cells as f64 + 1.0);
        2.0 * self.conductance[rod] * (1.0 - angle.cos())
    }

    fn shape(&self, mode: usize, cell: usize) -> f64 {
        (PI * (mode * (cell + 1)) as f64 / (self.cells as f64 + 1.0)).sin()
    }
}

impl OdeSystem for Rods {
    fn size(&self) -> usize {
        self.mass.len()
    }

    fn mass(&self) -> &[f64] {
        &self.mass
    }

    fn flow(&mut self, t: f64, y: &[f64], f: &mut [f64]) -> Result<(), Retry> {
        for (rod, &g) in self.conductance.iter().enumerate() {
            for cell in 0..self.cells {
                let i = rod * self.cells + cell;
                let before = if cell > 0 { y[i - 1] } else { 0.0 };
                let after = if cell + 1 < self.cells { y[i + 1] } else { 0.0 };
                f[i] = self.heat + self.ramp * t + g * (before - y[i]) + g * (after - y[i]);
            }
        }
        Ok(())
    }

    fn pattern(&self) -> &Pattern {
        &self.pattern
    }

    fn symmetric(&self) -> bool {
        true
    }

    fn jacobian(&mut self, _: f64, _: &[f64], values: &mut [f64]) -> Result<(), Retry> {
        for (rod, &g) in self.conductance.iter().enumerate() {
            for column in rod * self.cells..(rod + 1) * self.cells {
                for slot in self.pattern.column(column) {
                    let diagonal = self.pattern.row_indices()[slot] == column;
                    values[slot] = if diagonal { -2.0 * g } else { g };
                }
            }
        }
        Ok(())
    }

    fn jacobian_is_constant(&self) -> bool {
        true
    }

    fn quadrature_count(&self) -> usize {
        2
    }

    fn quadrature(&mut self, t: f64, y: &[f64], q: &mut [f64]) -> Result<(), Retry> {
        q[0] = (self.heat + self.ramp * t) * self.mass.len() as f64;
        let ends = |rod: usize| y[rod * self.cells] + y[(rod + 1) * self.cells - 1];
        q[1] = -self.conductance.iter().enumerate().map(|(rod, g)| g * ends(rod)).sum::<f64>();
        Ok(())
    }
}

fn options(tolerance: f64) -> Options {
    Options { tolerance, ..Options::default() }
}

/// The amplitudes of the modes of a constant over the cells: `a(mode)` with
/// `sum of a(mode) shape(mode, cell) = 1`.
fn amplitude(cells: usize, mode: usize) -> f64 {
    let angle = 0.5 * PI * mode as f64 / (cells as f64 + 1.0);
    if mode.is_multiple_of(2) { 0.0 } else { 2.0 / ((cells as f64 + 1.0) * angle.tan()) }
}

/// Of one rod that starts at `start` everywhere and is heated by `q + r t` in each cell.
fn exact(rods: &Rods, (start, q, r): (f64, f64, f64), (rod, cell): (usize, usize), t: f64) -> f64 {
    let modes = (1..=rods.cells).map(|mode| {
        let l = rods.rate(rod, mode);
        let gone = -(-l * t).exp_m1();
        let value = start * (-l * t).exp() + q * gone / l + r * (t - gone / l) / l;
        value * amplitude(rods.cells, mode) * rods.shape(mode, cell)
    });
    modes.sum()
}

/// The largest error at many times inside the steps, and the integrator.
fn run(rods: Rods, start: f64, stop: f64, options: &Options) -> (f64, OneStep<Rods>) {
    let (q, r, cells) = (rods.heat, rods.ramp, rods.cells);
    let mut stepper = OneStep::new(rods, 0.0, &vec![start; cells], options).unwrap();
    stepper.set_stop(stop);
    let mut worst = 0.0_f64;
    let mut y = vec![0.0; cells];
    while stepper.time() < stop {
        let step = stepper.step().unwrap();
        for k in 0..=4 {
            let t = step.from + (step.to - step.from) * f64::from(k) / 4.0;
            stepper.interpolate(t, &mut y).unwrap();
            for cell in [0, cells / 3, cells / 2] {
                let error = y[cell] - exact(stepper.system(), (start, q, r), (0, cell), t);
                worst = worst.max(error.abs());
            }
        }
    }
    (worst, stepper)
}

/// Heat, a ramp and a far start, from 1e-2 to 1e-9 of a tolerance, on a rod whose rates differ by
/// 1e5 and on a dense one: the error stays below three tolerances everywhere inside the steps.
#[test]
fn a_rod_cools_as_its_sines_do() {
    for cells in [7, 200] {
        for exponent in [-2, -4, -6, -9] {
            let tolerance = 10.0_f64.powi(exponent);
            for (start, heat, ramp) in [(100.0, 0.0, 0.0), (0.0, 3.0, 0.0), (20.0, 0.0, 0.7)] {
                let mut rods = Rods::new(cells, &[40.0]);
                (rods.heat, rods.ramp) = (heat, ramp);
                let (error, _) = run(rods, start, 50.0, &options(tolerance));
                assert!(
                    error < 3.0 * tolerance + 1e-11,
                    "{cells} cells, {tolerance}, start {start}: {error}"
                );
            }
        }
    }
}

/// With conjugate gradients the same.
#[test]
fn solvers_that_iterate_keep_the_tolerance() {
    for tolerance in [1e-2, 1e-5, 1e-8] {
        let mut rods = Rods::new(200, &[40.0]);
        (rods.heat, rods.ramp) = (3.0, 0.7);
        let options = Options { linear_solver: LinearSolver::Pcg, ..options(tolerance) };
        let (error, stepper) = run(rods, 20.0, 50.0, &options);
        assert!(error < 3.0 * tolerance, "{tolerance}: {error}");
        assert!(stepper.linear_solver() == lptn_integrate::LinearSolverKind::Pcg);
    }
}

/// What is stored is what was put in, less what the walls took, at any time: to rounding for exact
/// factors and for solvers that iterate.
#[test]
fn the_books_close_to_rounding() {
    for linear_solver in [LinearSolver::Auto, LinearSolver::Pcg] {
        for tolerance in [1.0, 1e-6] {
            let mut rods = Rods::new(60, &[40.0, 1e4]);
            (rods.heat, rods.ramp) = (3.0, 0.7);
            let options = Options { linear_solver, ..options(tolerance) };
            let mut stepper = OneStep::new(rods, 0.0, &[20.0; 120], &options).unwrap();
            for stop in [0.37, 0.4, 7.1, 50.0] {
                stepper.set_stop(stop);
                while stepper.time() < stop {
                    let step = stepper.step().unwrap();
                    if step.to > 20.0 && step.to < 21.0 {
                        stepper.rewind(0.5 * (step.from + step.to)).unwrap();
                    }
                }
                let stored = stepper.state().iter().map(|y| y - 20.0).sum::<f64>();
                let booked = stepper.quadratures().unwrap();
                let turned_over = booked.iter().map(|q| q.abs()).sum::<f64>() + stored.abs();
                let open = booked[0] + booked[1] - stored;
                assert!(open.abs() < 1e-12 * turned_over, "{linear_solver:?}: {open}");
                let heat = 120.0 * stop * (3.0 + 0.5 * 0.7 * stop);
                assert!((booked[0] - heat).abs() < 1e-11 * heat);
                stepper.system_mut().heat += 0.0;
                stepper.restart(None).unwrap();
            }
        }
    }
}

/// Inputs that jump at times that are on no grid: the steps reach beyond, the state at the jump is
/// within the tolerance, and all of them together take a few factors.
#[test]
fn jumps_at_odd_times_share_their_factors() {
    let rods = Rods::new(100, &[40.0]);
    let tolerance = 1e-5;
    let mut stepper = OneStep::new(rods, 0.0, &[0.0; 100], &options(tolerance)).unwrap();
    let (mut time, mut worst) = (0.0, 0.0_f64);
    let mut jumps = Vec::new();
    for k in 1..=60_u32 {
        let heat = f64::from(k * 7 % 5);
        jumps.push((time, heat - stepper.system().heat));
        stepper.system_mut().heat = heat;
        stepper.restart(None).unwrap();
        let stop = time + 0.1 + 3.0 * f64::from(k * 37 % 59) / 59.0;
        stepper.set_stop(stop);
        while stepper.time() < stop {
            stepper.step().unwrap();
        }
        time = stop;
        let part =
            |&(at, by): &(f64, f64)| exact(stepper.system(), (0.0, by, 0.0), (0, 50), time - at);
        worst = worst.max((stepper.state()[50] - jumps.iter().map(part).sum::<f64>()).abs());
    }
    let statistics = stepper.statistics();
    assert!(worst < 3.0 * tolerance, "{worst}");
    assert!(statistics.factorizations <= 10, "{statistics:?}");
    assert!(statistics.steps <= 600, "{statistics:?}");
}

/// A step that went too far is taken back: the same state, books and time as if it had ended there.
#[test]
fn a_step_is_taken_back() {
    let mut rods = Rods::new(30, &[40.0]);
    rods.heat = 2.0;
    let mut stepper = OneStep::new(rods, 5.0, &[0.0; 30], &options(1e-7)).unwrap();
    stepper.set_stop(60.0);
    let step = stepper.step().unwrap();
    assert_eq!(step.from, 5.0);
    let middle = 0.5 * (step.from + step.to);
    let mut y = vec![0.0; 30];
    stepper.interpolate(middle, &mut y).unwrap();
    stepper.rewind(middle).unwrap();
    assert_eq!(stepper.time(), middle);
    assert_eq!(stepper.state(), &y);
    let booked = stepper.quadratures().unwrap().to_vec();
    let stored: f64 = y.iter().sum();
    assert!((booked[0] + booked[1] - stored).abs() < 1e-12 * stored);
    let outside = stepper.interpolate(step.to, &mut y).unwrap_err();
    assert!(matches!(outside, IntegrateError::OutsideLastStep { .. }), "{outside}");
    assert_eq!(stepper.statistics().restarts, 1);
}

/// What is asked for at the stop, behind it or with the wrong length is said, not done.
#[test]
fn wrong_calls_are_refused() {
    let fresh = || OneStep::new(Rods::new(3, &[1.0]), 0.0, &[1.0; 3], &options(1e-3)).unwrap();
    let mut stepper = fresh();
    stepper.set_stop(0.0);
    assert!(stepper.step().unwrap().at_stop);
    stepper.set_stop(-1.0);
    assert!(matches!(stepper.step(), Err(IntegrateError::StopBehind { .. })));
    assert!(matches!(
        stepper.interpolate(0.0, &mut [0.0; 2]),
        Err(IntegrateError::WrongLength { .. })
    ));
    assert!(matches!(
        stepper.restart(Some(&[1.0, f64::NAN, 1.0])),
        Err(IntegrateError::InvalidState { index: 1, .. })
    ));
    let mut short = OneStep::new(
        Rods::new(3, &[1.0]),
        0.0,
        &[1.0; 3],
        &Options { max_steps: 1, ..options(1e-9) },
    )
    .unwrap();
    short.set_stop(1e9);
    let refused = (0..100).find_map(|_| short.step().err()).unwrap();
    assert!(matches!(refused, IntegrateError::TooManySteps { steps: 1, .. }), "{refused}");
    let none = OneStep::new(Rods::new(3, &[1.0]), 0.0, &[1.0; 3], &options(0.0));
    assert!(matches!(none, Err(IntegrateError::InvalidOption { option: "tolerance", .. })));
}

/// Far from time 0 the same steps are taken: a step may be shorter than the distance of doubles.
#[test]
fn the_time_of_the_start_does_not_matter() {
    let steps = |start: f64| {
        let mut rods = Rods::new(50, &[1e6]);
        rods.heat = 1e5;
        let mut stepper = OneStep::new(rods, start, &[0.0; 50], &options(1e-6)).unwrap();
        stepper.set_stop(start + 64.0);
        while stepper.time() < start + 64.0 {
            stepper.step().unwrap();
        }
        (stepper.statistics(), stepper.state()[25])
    };
    assert_eq!(steps(0.0), steps(2.0_f64.powi(40)));
}
