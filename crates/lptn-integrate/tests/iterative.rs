//! The solvers that iterate against exact factors, and when which of them is taken.
#![allow(clippy::unwrap_used, reason = "a test may")]

use crate::common;

use common::{chain, cube, matrix, numbers, random_network};
use lptn_integrate::linear::{Factorization, SparseCholesky, SparseLu, solve_refined};
use lptn_integrate::{FactorError, LinearSolver, LinearSolverKind, Pattern, linear};

#[test]
fn conjugate_gradients_solve_what_cholesky_solves() {
    let networks = [1, 2, 30, 900].map(|n| random_network(n, false));
    let cubes = [1.0, 1e-2, 1e-4].map(|mass| cube(12, mass));
    for (pattern, values) in networks.into_iter().chain(cubes) {
        let n = pattern.size();
        let mut next = numbers(7);
        let exact: Vec<f64> = (0..n).map(|_| next() - 0.5).collect();
        let mut b = vec![0.0; n];
        pattern.multiply(&values, &exact, &mut b);
        let mut solver = linear::new(&pattern, true, LinearSolver::Pcg).unwrap();
        assert_eq!(solver.kind(), LinearSolverKind::Pcg);
        assert!(solver.solve_in_place(&mut b.clone()).is_err(), "nothing is factorised");
        for _ in 0..2 {
            solver.factorize(&values).unwrap();
            let mut x = vec![0.0; n];
            let left = solve_refined(solver.as_mut(), (&pattern, &values), &b, &mut x, 1).unwrap();
            assert!(
                left < 1e-12 * values.iter().fold(1.0, |most: f64, v| most.max(v.abs())),
                "{n}: {left:e}"
            );
        }
        let mut nothing = vec![0.0; n];
        solver.solve_in_place(&mut nothing).unwrap();
        assert!(nothing.iter().all(|x| *x == 0.0));
    }
    assert!(matches!(
        linear::new(&Pattern::new(1, std::iter::empty()), false, LinearSolver::Pcg),
        Err(FactorError::NotSymmetric)
    ));
}

#[test]
fn exact_factors_take_over_where_conjugate_gradients_do_not_converge() {
    // a right side that an island without a boundary cannot take: no iteration can be right
    let (pattern, values) = cube(6, 0.0);
    let mut solver = linear::new(&pattern, true, LinearSolver::Pcg).unwrap();
    solver.factorize(&values).unwrap();
    let mut b = vec![1.0; pattern.size()];
    match solver.solve_in_place(&mut b) {
        // rounding may leave the last pivot of a singular matrix a little above zero
        Ok(()) => assert!(b.iter().any(|x| x.abs() > 1e9)),
        Err(error) => assert!(
            matches!(error, FactorError::NotPositiveDefinite { .. } | FactorError::Singular { .. }),
            "{error:?}"
        ),
    }
}

/// `M + G` of a square of `n` by `n` cells, links of 1 between neighbours, masses of 1.
fn square(n: usize) -> (Pattern, Vec<f64>) {
    let mut entries = Vec::new();
    for cell in 0..n * n {
        entries.push((cell, cell, 1.0));
        for (stride, place) in [(1, cell % n), (n, cell / n)] {
            if place + 1 < n {
                let next = cell + stride;
                entries.extend([
                    (cell, cell, 1.0),
                    (next, next, 1.0),
                    (cell, next, -1.0),
                    (next, cell, -1.0),
                ]);
            }
        }
    }
    matrix(n * n, &entries)
}

#[test]
fn a_run_takes_what_costs_least() {
    use LinearSolverKind::{Pcg, SparseCholesky};
    let kinds = |pattern: &Pattern| {
        let steps = linear::for_steps(pattern, true, LinearSolver::Auto).unwrap().kind();
        (steps, linear::for_stages(pattern, true, LinearSolver::Auto).unwrap().kind())
    };
    assert_eq!(kinds(&chain(10_000, 1.0).0), (SparseCholesky, SparseCholesky));
    assert_eq!(kinds(&random_network(40, false).0), (SparseCholesky, SparseCholesky));
    assert_eq!(kinds(&square(32).0), (SparseCholesky, SparseCholesky));
    assert_eq!(kinds(&square(150).0), (Pcg, Pcg));
    assert_eq!(kinds(&cube(5, 1.0).0), (SparseCholesky, SparseCholesky));
    assert_eq!(kinds(&cube(10, 1.0).0), (Pcg, Pcg));
    assert_eq!(kinds(&cube(32, 1.0).0), (Pcg, Pcg));
}

#[test]
fn exact_factors_take_over_where_iterations_have_cost_as_much() {
    // nearly no mass: some forty iterations a solve
    let (pattern, values) = cube(10, 1e-6);
    let mut solver = linear::for_stages(&pattern, true, LinearSolver::Auto).unwrap();
    solver.factorize(&values).unwrap();
    let light = solver.fill();
    let solved = |solver: &mut dyn Factorization| {
        let mut x: Vec<f64> = (0..1000).map(|i| f64::from(i % 7) - 3.0).collect();
        solver.solve_in_place(&mut x).unwrap();
        x
    };
    let iterated = solved(solver.as_mut());
    for _ in 0..20 {
        solved(solver.as_mut());
    }
    assert!(solver.fill() > 3 * light, "exact factors are kept beside");
    let (spent, exact) = (solver.iterations(), solved(solver.as_mut()));
    assert_eq!(solver.iterations(), spent);
    assert!(spent < 400, "{spent}");
    let largest = exact.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    assert!(iterated.iter().zip(&exact).all(|(a, b)| (a - b).abs() < 1e-6 * largest));
    // other values begin anew
    solver.factorize(&values).unwrap();
    assert_eq!(solver.fill(), light);
}

#[test]
fn a_good_guess_saves_iterations() {
    let (pattern, values) = cube(12, 1.0);
    let n = pattern.size();
    let mut next = numbers(5);
    let exact: Vec<f64> = (0..n).map(|_| 300.0 + next()).collect();
    let mut b = vec![0.0; n];
    pattern.multiply(&values, &exact, &mut b);
    let mut solver = linear::new(&pattern, true, LinearSolver::Pcg).unwrap();
    solver.factorize(&values).unwrap();
    let mut count = 0;
    let mut solved = |x: &mut [f64], allowed| {
        solver.solve_from(&b, x, allowed).unwrap();
        let mut product = vec![0.0; n];
        pattern.multiply(&values, x, &mut product);
        let left = |i: usize| (b[i] - product[i]).abs() / values[pattern.diagonal_slot(i)];
        assert!((0..n).all(|i| left(i) <= 1.001 * allowed));
        let before = std::mem::replace(&mut count, solver.iterations());
        count - before
    };
    let (mut cold, mut warm) = (vec![0.0; n], vec![300.0; n]);
    let (coarse, near) = (solved(&mut cold, 1e-3), solved(&mut warm, 1e-3));
    assert!(near < coarse && coarse <= 20, "{near} {coarse}");
    assert!(solved(&mut warm, 1e-3) <= 1, "it was good enough");
    assert!(solved(&mut warm, 1e-9) > 0);
    let error = warm.iter().zip(&exact).map(|(x, e)| (x - e).abs()).fold(0.0, f64::max);
    assert!(error < 1e-6, "{error:e}");
    // exact solvers take the guess as nothing
    let mut cholesky = SparseCholesky::new(&pattern).unwrap();
    cholesky.factorize(&values).unwrap();
    cholesky.solve_from(&b, &mut cold, 1.0).unwrap();
    let error = cold.iter().zip(&exact).map(|(x, e)| (x - e).abs()).fold(0.0, f64::max);
    assert!(error < 1e-8, "{error:e}");
}

/// Squares of residuals this small are lost to underflow; the solution needs no exact factors.
#[test]
fn tiny_right_sides_are_solved_by_iterations() {
    let (pattern, values) = cube(16, 1e-3);
    let mut solver = linear::for_stages(&pattern, true, LinearSolver::Auto).unwrap();
    solver.factorize(&values).unwrap();
    let light = solver.fill();
    for right in [1e-100, 1e-155, 1e-170, 1e-200, 1e-307] {
        let mut b = vec![0.0; pattern.size()];
        b[1234] = right;
        let mut x = vec![0.0; b.len()];
        solver.solve_from(&b, &mut x, 1e-6).unwrap();
        assert!(x.iter().all(|x| x.abs() < 1e-90) && solver.fill() == light, "{right:e}");
    }
}

/// A guess that errs by the same amount everywhere leaves hardly a residual in a body with little
/// mass. The error is corrected all the same.
#[test]
fn smooth_errors_of_a_guess_are_corrected() {
    let (pattern, values) = cube(16, 1e-3);
    let n = pattern.size();
    let exact: Vec<f64> = (0..n).map(|i| 300.0 + (i % 16) as f64).collect();
    let mut b = vec![0.0; n];
    pattern.multiply(&values, &exact, &mut b);
    let mut solver = linear::new(&pattern, true, LinearSolver::Pcg).unwrap();
    solver.factorize(&values).unwrap();
    for (shift, allowed) in [(1.0, 1e-3), (0.1, 1e-2), (-5.0, 0.1)] {
        let mut x: Vec<f64> = exact.iter().map(|x| x + shift).collect();
        solver.solve_from(&b, &mut x, allowed).unwrap();
        let error = x.iter().zip(&exact).map(|(x, e)| (x - e).abs()).fold(0.0, f64::max);
        assert!(error < 2.0 * allowed, "{shift}, {allowed}: {error:e}");
    }
}

/// Most cells of a body in steady state have no path to ground: their rows add up to roundings.
/// Iterations end all the same.
#[test]
fn cells_without_a_path_to_ground_need_no_exact_factors() {
    let (pattern, mut values) = cube(14, 0.0);
    let n = pattern.size();
    // conductances that are not binary fractions leave roundings
    values.iter_mut().for_each(|value| *value *= 0.7);
    (0..14 * 14).for_each(|cell| values[pattern.diagonal_slot(cell)] += 0.3);
    let exact: Vec<f64> = (0..n).map(|i| 300.0 + (i % 14) as f64).collect();
    let mut b = vec![0.0; n];
    pattern.multiply(&values, &exact, &mut b);
    let mut solver = linear::new(&pattern, true, LinearSolver::Pcg).unwrap();
    solver.factorize(&values).unwrap();
    let light = solver.fill();
    for allowed in [1e-3, 1e-6, 1e-9] {
        let mut x: Vec<f64> = exact.iter().map(|x| x + 1.0).collect();
        solver.solve_from(&b, &mut x, allowed).unwrap();
        let error = x.iter().zip(&exact).map(|(x, e)| (x - e).abs()).fold(0.0, f64::max);
        assert!(error < 10.0 * allowed && solver.fill() == light, "{allowed}: {error:e}");
    }
    assert!(solver.iterations() < 200, "{}", solver.iterations());
}

/// A network of links `(from, to, conductance)` and paths to ground.
fn network(
    n: usize,
    links: &[(usize, usize, f64)],
    ground: &[(usize, f64)],
) -> (Pattern, Vec<f64>) {
    let mut entries: Vec<_> = ground.iter().map(|&(i, g)| (i, i, g)).collect();
    for &(i, j, g) in links {
        entries.extend([(i, i, g), (j, j, g), (i, j, -g), (j, i, -g)]);
    }
    matrix(n, &entries)
}

/// A body of cells whose links spread over so many decades.
fn spread(n: usize, axes: u32, decades: f64) -> (Pattern, Vec<f64>) {
    let size = n.pow(axes);
    let mut next = numbers(size as u64);
    let mut links = Vec::new();
    for cell in 0..size {
        for axis in 0..axes {
            if cell / n.pow(axis) % n + 1 < n {
                links.push((cell + n.pow(axis), cell, 10_f64.powf(decades * (next() - 0.5))));
            }
        }
    }
    let ground: Vec<_> = (0..size).filter(|cell| cell % n == 0).map(|cell| (cell, 0.1)).collect();
    network(size, &links, &ground)
}

/// Cycles that the solution takes, checked against exact factors.
fn cycles((pattern, values): &(Pattern, Vec<f64>), tolerance: f64) -> u64 {
    let mut next = numbers(17);
    let b: Vec<f64> = (0..pattern.size()).map(|_| next() - 0.3).collect();
    let mut solver = linear::Multigrid::new(pattern);
    solver.factorize(values).unwrap();
    solver.check(pattern, values).unwrap();
    let mut exact = SparseCholesky::new(pattern).unwrap();
    exact.factorize(values).unwrap();
    let (mut x, mut y) = (vec![0.0; b.len()], vec![0.0; b.len()]);
    solve_refined(&mut solver, (pattern, values), &b, &mut x, 1).unwrap();
    solve_refined(&mut exact, (pattern, values), &b, &mut y, 1).unwrap();
    let largest = y.iter().fold(0.0, |most: f64, y| most.max(y.abs()));
    let error = x.iter().zip(&y).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max);
    assert!(error <= tolerance * largest, "{error:e} of {largest:e}");
    solver.iterations()
}

#[test]
fn cycles_hardly_grow_with_the_body() {
    let counts = [10, 20, 30].map(|n| cycles(&spread(n, 3, 2.0), 1e-12));
    assert!(counts.iter().all(|&count| count > 10 && count <= 40), "{counts:?}");
    let counts = [30, 100, 200].map(|n| cycles(&spread(n, 2, 2.0), 1e-11));
    assert!(counts.iter().all(|&count| count > 10 && count <= 42), "{counts:?}");
}

#[test]
fn a_uniform_body_has_levels_down_to_a_few_rows() {
    for (pattern, values) in [cube(40, 1e-4), square(200)] {
        let mut solver = linear::Multigrid::new(&pattern);
        solver.factorize(&values).unwrap();
        let fill = solver.fill() as f64 / pattern.size() as f64;
        assert!(fill < 25.0, "{fill}");
        let mut x: Vec<f64> = (0..pattern.size()).map(|i| (i % 17) as f64 - 3.0).collect();
        solver.solve_in_place(&mut x).unwrap();
        assert!(solver.iterations() <= 22, "{}", solver.iterations());
    }
}

#[test]
fn cycles_stand_what_networks_are_like() {
    // links over up to eight decades
    for decades in [3.0, 6.0, 8.0] {
        let count = cycles(&spread(16, 3, decades), 1e-7);
        assert!(count <= 40, "{decades}: {count}");
    }
    // a casing that half of all cells are linked to, and a star
    let n = 4000;
    let mut next = numbers(4);
    let mut links: Vec<_> = (1..n).map(|i| (i, i - 1, 0.1 + next())).collect();
    links.extend((0..n).step_by(2).map(|i| (n, i, 0.01 + next())));
    assert!(cycles(&network(n + 1, &links, &[(n, 1.0)]), 1e-9) <= 60);
    let star: Vec<_> = (1..n).map(|i| (i, 0, 10_f64.powf(4.0 * next() - 2.0))).collect();
    assert!(cycles(&network(n, &star, &[(0, 1e-3)]), 1e-7) <= 60);
    // parts that are linked with nothing but the ground, and nearly rigid ones
    let mut links: Vec<_> =
        (1..n).filter(|i| i % 10 != 0).map(|i| (i, i - 1, 10_f64.powf(10.0 * next()))).collect();
    links.extend((0..n - 2000).map(|i| (i + 2000, i, 1e-3)));
    let ground: Vec<_> = (0..n).step_by(10).map(|i| (i, 1.0)).collect();
    // (what their rounding leaves of the paths to ground is known to five digits)
    assert!(cycles(&network(n, &links, &ground), 1e-4) <= 50);
}

#[test]
fn a_hub_costs_no_more_than_its_links() {
    // quadratic work in the links of the hub would take minutes
    let n = 200_000;
    let mut next = numbers(8);
    let mut links: Vec<_> = (1..n).map(|i| (i, i - 1, 0.1 + next())).collect();
    links.extend((0..n).map(|i| (n, i, 0.1 + next())));
    let (pattern, values) = network(n + 1, &links, &[(n, 1.0)]);
    let solvers: [Box<dyn Factorization>; 3] = [
        linear::for_steps(&pattern, true, LinearSolver::Auto).unwrap(),
        Box::new(linear::Krylov::new(&pattern, true)),
        Box::new(linear::Multigrid::new(&pattern)),
    ];
    for mut solver in solvers {
        solver.factorize(&values).unwrap();
        let mut x = vec![0.0; n + 1];
        pattern.multiply(&values, &vec![1.0; n + 1], &mut x);
        solver.solve_in_place(&mut x).unwrap();
        let error = x.iter().map(|x| (x - 1.0).abs()).fold(0.0, f64::max);
        assert!(error < 1e-6, "{:?}: {error:e}", solver.kind());
    }
}

#[test]
fn a_steady_state_takes_what_costs_least() {
    let kind = |pattern: &Pattern| linear::for_steady(pattern, LinearSolver::Auto).unwrap().kind();
    assert_eq!(kind(&square(150).0), LinearSolverKind::SparseCholesky);
    assert_eq!(kind(&cube(14, 1.0).0), LinearSolverKind::SparseCholesky);
    assert_eq!(kind(&cube(25, 1.0).0), LinearSolverKind::Pcg);
    assert_eq!(kind(&cube(40, 1.0).0), LinearSolverKind::Pcg);
}

/// A cube of cells with paths of 1 to 0 at all its faces, and a mode of it: `A v = rate v`.
fn mode(n: usize) -> ((Pattern, Vec<f64>), Vec<f64>, f64) {
    let wave = std::f64::consts::PI / (n + 1) as f64;
    let place = |cell: usize, axis: u32| cell / n.pow(axis) % n;
    let sine = |cell, axis| (wave * (place(cell, axis) + 1) as f64).sin();
    let size = n.pow(3);
    let (mut links, mut ground) = (Vec::new(), Vec::new());
    for cell in 0..size {
        for axis in 0..3 {
            match place(cell, axis) + 1 < n {
                true => links.push((cell + n.pow(axis), cell, 1.0)),
                false => ground.push((cell, 1.0)),
            }
            if place(cell, axis) == 0 {
                ground.push((cell, 1.0));
            }
        }
    }
    let shape = (0..size).map(|cell| (0..3).map(|axis| sine(cell, axis)).product()).collect();
    (network(size, &links, &ground), shape, 6.0 * (1.0 - wave.cos()))
}

#[test]
fn a_mode_of_a_cube_is_what_it_is() {
    let ((pattern, values), shape, rate) = mode(32);
    let steady = linear::for_steady(&pattern, LinearSolver::Auto).unwrap();
    assert_eq!(steady.kind(), LinearSolverKind::Pcg);
    for mut solver in [steady, Box::new(linear::Multigrid::new(&pattern))] {
        solver.factorize(&values).unwrap();
        let mut x: Vec<f64> = shape.iter().map(|v| rate * v).collect();
        solver.solve_in_place(&mut x).unwrap();
        let error = x.iter().zip(&shape).map(|(x, v)| (x - v).abs()).fold(0.0, f64::max);
        assert!(error < 1e-7, "{:?}: {error:e}", solver.kind());
    }
}

#[test]
fn cycles_find_out_a_body_without_a_boundary() {
    let (pattern, values) = cube(12, 0.0);
    let mut solver = linear::Multigrid::new(&pattern);
    let outcome = solver.factorize(&values).and_then(|()| solver.check(&pattern, &values));
    assert!(
        matches!(
            outcome,
            Err(FactorError::NotPositiveDefinite { .. } | FactorError::Singular { .. })
        ),
        "{outcome:?}"
    );
}

/// A body of cells along which a stream carries heat: `speed` over the conductances, upwind.
fn stream(n: usize, speed: f64) -> (Pattern, Vec<f64>) {
    let mut next = numbers(n as u64);
    let mut entries = Vec::new();
    for cell in 0..n.pow(3) {
        entries.push((cell, cell, 1e-3));
        for axis in 0..3 {
            if cell / n.pow(axis) % n + 1 < n {
                let (other, g) = (cell + n.pow(axis), 0.5 + next());
                entries.extend([(cell, cell, g), (other, other, g)]);
                entries.extend([(cell, other, -g), (other, cell, -g)]);
                if axis == 0 {
                    entries.extend([(other, other, speed), (other, cell, -speed)]);
                }
            }
        }
    }
    matrix(n.pow(3), &entries)
}

#[test]
fn iterations_solve_what_lu_solves() {
    for speed in [0.1, 10.0, 1000.0] {
        let (pattern, values) = stream(12, speed);
        let n = pattern.size();
        let mut next = numbers(11);
        let exact: Vec<f64> = (0..n).map(|_| next() - 0.5).collect();
        let mut b = vec![0.0; n];
        pattern.multiply(&values, &exact, &mut b);
        let mut solver = linear::Krylov::new(&pattern, false);
        let mut lu = SparseLu::new(&pattern).unwrap();
        lu.factorize(&values).unwrap();
        solver.factorize(&values).unwrap();
        let (mut x, mut y) = (vec![0.0; n], vec![0.0; n]);
        solve_refined(&mut solver, (&pattern, &values), &b, &mut x, 1).unwrap();
        solve_refined(&mut lu, (&pattern, &values), &b, &mut y, 1).unwrap();
        let error = x.iter().zip(&y).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max);
        assert!(error < 1e-9, "{speed}: {error:e}");
        assert!(solver.iterations() > 0 && solver.iterations() < 120, "{}", solver.iterations());
        // from a guess that is good enough there is nothing to do
        let spent = solver.iterations();
        solver.solve_from(&b, &mut x, 1e-6).unwrap();
        assert_eq!(solver.iterations(), spent);
        // a sibling has factors of its own
        let mut other = solver.sibling();
        other.factorize(&values.iter().map(|v| 2.0 * v).collect::<Vec<_>>()).unwrap();
        other.solve_in_place(&mut b).unwrap();
        let error = b.iter().zip(&exact).map(|(x, e)| (2.0 * x - e).abs()).fold(0.0, f64::max);
        assert!(error < 1e-5, "{speed}: {error:e}");
    }
}

#[test]
fn lu_takes_over_where_iterations_fail() {
    // a rotation in every pair of rows: nothing that conductances and streams make
    let n = 400;
    let entries: Vec<_> = (0..n)
        .flat_map(|i| {
            let (other, sign) = if i % 2 == 0 { (i + 1, 1e4) } else { (i - 1, -1e4) };
            [(i, i, 1.0), (i, other, sign), (i, (i + 7) % n, 0.1)]
        })
        .collect();
    let (pattern, values) = matrix(n, &entries);
    let mut solver = linear::Krylov::new(&pattern, false);
    solver.factorize(&values).unwrap();
    let exact: Vec<f64> = (0..n).map(|i| f64::from(i as u32 % 5)).collect();
    let mut b = vec![0.0; n];
    pattern.multiply(&values, &exact, &mut b);
    solver.solve_in_place(&mut b).unwrap();
    let error = b.iter().zip(&exact).map(|(x, e)| (x - e).abs()).fold(0.0, f64::max);
    assert!(error < 1e-8, "{error:e}");
}

#[test]
fn large_bodies_with_streams_are_iterated() {
    let kind = |n| {
        let pattern = cube(n, 1.0).0;
        linear::for_steps(&pattern, false, LinearSolver::Auto).unwrap().kind()
    };
    assert_eq!(kind(12), LinearSolverKind::SparseLu);
    assert_eq!(kind(25), LinearSolverKind::BiCgStab);
    let pattern = square(100).0;
    let kind = linear::for_steps(&pattern, false, LinearSolver::Auto).unwrap().kind();
    assert_eq!(kind, LinearSolverKind::SparseLu);
}
