//! The linear solvers against each other and against systems solved by hand.
#![allow(clippy::unwrap_used, reason = "a test may")]

use crate::common;

use common::{chain, cube, matrix, numbers, random_network};
use lptn_integrate::linear::{Dense, Factorization, SparseCholesky, SparseLu, solve_refined};
use lptn_integrate::{FactorError, LinearSolver, LinearSolverKind, Pattern, linear};

/// All four solvers.
fn solvers(pattern: &Pattern) -> Vec<Box<dyn Factorization>> {
    vec![
        Box::new(Dense::new(pattern, true)),
        Box::new(Dense::new(pattern, false)),
        Box::new(SparseCholesky::new(pattern).unwrap()),
        Box::new(SparseLu::new(pattern).unwrap()),
    ]
}

#[test]
fn pattern_is_closed_sorted_and_whole() {
    let pattern = Pattern::new(4, [(2, 0), (2, 0), (0, 2), (3, 1)].into_iter());
    assert_eq!(pattern.column_pointers(), [0, 2, 4, 6, 8]);
    assert_eq!(pattern.row_indices(), [0, 2, 1, 3, 0, 2, 1, 3]);
    assert_eq!(pattern.diagonal(), [0, 2, 5, 7]);
    assert_eq!((pattern.size(), pattern.len()), (4, 8));
    assert_eq!(
        (pattern.slot(2, 0), pattern.slot(0, 2), pattern.slot(0, 1)),
        (Some(1), Some(4), None)
    );
    assert_eq!((pattern.slot(9, 0), pattern.slot(0, 9)), (None, None));
    assert_eq!(pattern, Pattern::new(4, [(1, 3), (0, 2)].into_iter()));
    assert!(Pattern::new(0, std::iter::empty()).is_empty());
}

#[test]
fn solved_by_hand() {
    // 4 x + y = 9, x + 3 y = 5, z / 2 = 4.
    let (pattern, values) =
        matrix(3, &[(0, 0, 4.0), (0, 1, 1.0), (1, 0, 1.0), (1, 1, 3.0), (2, 2, 0.5)]);
    for mut solver in solvers(&pattern) {
        solver.factorize(&values).unwrap();
        let mut b = [9.0, 5.0, 4.0];
        solver.solve_in_place(&mut b).unwrap();
        assert!(b.iter().zip([2.0, 1.0, 8.0]).all(|(x, exact)| (x - exact).abs() < 1e-14), "{b:?}");
    }
}

#[test]
fn rows_are_exchanged_where_they_must_be() {
    let (pattern, values) = matrix(2, &[(0, 1, 2.0), (1, 0, 4.0), (1, 1, 1.0)]);
    let solvers: [Box<dyn Factorization>; 2] =
        [Box::new(Dense::new(&pattern, false)), Box::new(SparseLu::new(&pattern).unwrap())];
    for mut solver in solvers {
        solver.factorize(&values).unwrap();
        let mut b = [6.0, 11.0];
        solver.solve_in_place(&mut b).unwrap();
        assert!(b.iter().zip([2.0, 3.0]).all(|(x, exact)| (x - exact).abs() < 1e-14), "{b:?}");
    }
}

#[test]
fn all_solvers_agree() {
    for n in [1, 2, 3, 7, 30, 31, 200, 900] {
        for upwind in [false, true] {
            let (pattern, values) = random_network(n, upwind);
            let mut next = numbers(99);
            let exact: Vec<f64> = (0..n).map(|_| 300.0 * next()).collect();
            let mut b = vec![0.0; n];
            pattern.multiply(&values, &exact, &mut b);
            let solvers = solvers(&pattern).into_iter().filter(|s| {
                !upwind
                    || matches!(s.kind(), LinearSolverKind::DenseLu | LinearSolverKind::SparseLu)
            });
            for mut solver in solvers {
                assert_eq!(solver.size(), n);
                assert!(solver.fill() >= n);
                // Twice: the second time in used memory.
                for _ in 0..2 {
                    solver.factorize(&values).unwrap();
                    solver.check(&pattern, &values).unwrap();
                    let mut x = vec![0.0; n];
                    let left =
                        solve_refined(solver.as_mut(), (&pattern, &values), &b, &mut x, 1).unwrap();
                    assert!(left < 1e-9, "{:?}, {n}: residual {left:e}", solver.kind());
                    let error =
                        x.iter().zip(&exact).map(|(x, e)| (x - e).abs()).fold(0.0, f64::max);
                    assert!(error < 1e-8, "{:?}, {n}: error {error:e}", solver.kind());
                }
            }
        }
    }
}

#[test]
fn a_network_without_a_boundary_is_found_out() {
    for n in [2, 5, 40] {
        let (pattern, values) = chain(n, 0.0);
        for mut solver in solvers(&pattern) {
            let outcome = solver.factorize(&values).and_then(|()| solver.check(&pattern, &values));
            assert!(
                matches!(
                    outcome,
                    Err(FactorError::Singular { .. } | FactorError::NotPositiveDefinite { .. })
                ),
                "{:?}, {n}: {outcome:?}",
                solver.kind()
            );
        }
        let (pattern, values) = chain(n, 1e-6);
        for mut solver in solvers(&pattern) {
            solver.factorize(&values).and_then(|()| solver.check(&pattern, &values)).unwrap();
        }
    }
}

#[test]
fn a_negative_pivot_is_reported_by_its_row() {
    for n in [3, 40, 400] {
        for bad in [0, n / 2, n - 1] {
            // No links: the row is that of the entry in any order of elimination.
            let entries: Vec<_> =
                (0..n).map(|i| (i, i, if i == bad { -1.0 } else { 1.0 })).collect();
            let (pattern, values) = matrix(n, &entries);
            let mut solver = SparseCholesky::new(&pattern).unwrap();
            assert_eq!(
                solver.factorize(&values),
                Err(FactorError::NotPositiveDefinite { index: bad })
            );
            assert_eq!(solver.solve_in_place(&mut vec![1.0; n]), Err(FactorError::NotFactorized));
            let mut solver = Dense::new(&pattern, true);
            assert_eq!(
                solver.factorize(&values),
                Err(FactorError::NotPositiveDefinite { index: bad })
            );
        }
    }
}

#[test]
fn a_negative_pivot_in_a_supernode_is_reported_by_its_row() {
    // Dense enough that faer takes its supernodal code; every row but one is dominated by its
    // diagonal.
    let n = 300;
    for bad in [0, 123, n - 1] {
        let mut entries: Vec<_> =
            (0..n).map(|i| (i, i, if i == bad { -1e6 } else { 1e6 })).collect();
        entries.extend(
            (0..n).flat_map(|i| (0..n).filter(move |&j| i != j).map(move |j| (i, j, -1.0))),
        );
        let (pattern, values) = matrix(n, &entries);
        let mut solver = SparseCholesky::new(&pattern).unwrap();
        assert_eq!(solver.factorize(&values), Err(FactorError::NotPositiveDefinite { index: bad }));
    }
}

#[test]
fn misuse_is_an_error() {
    let (pattern, values) = chain(4, 1.0);
    for mut solver in solvers(&pattern) {
        assert_eq!(solver.solve_in_place(&mut [1.0; 4]), Err(FactorError::NotFactorized));
        let wrong = FactorError::WrongLength { expected: values.len(), found: 3 };
        assert_eq!(solver.factorize(&values[..3]), Err(wrong));
        solver.factorize(&values).unwrap();
        assert!(matches!(
            solver.solve_in_place(&mut [1.0; 5]),
            Err(FactorError::WrongLength { .. })
        ));
        assert!(solver.solve_in_place(&mut [1.0, f64::NAN, 0.0, 0.0]).is_err());
    }
    assert!(matches!(
        linear::new(&pattern, false, LinearSolver::Cholesky),
        Err(FactorError::NotSymmetric)
    ));
}

#[test]
fn values_decide_between_cholesky_and_lu() {
    let (pattern, values) = cube(13, 1.0);
    let mut solver = linear::for_exact(&pattern).unwrap();
    let mut next = numbers(3);
    let exact: Vec<f64> = (0..pattern.size()).map(|_| next()).collect();
    // symmetric, then with one entry that is not, then negative: LU serves the last two
    let mut skew = values.clone();
    skew[pattern.slot(1, 0).unwrap()] = -0.5;
    let negative: Vec<f64> = values.iter().map(|v| -v).collect();
    let kinds =
        [LinearSolverKind::SparseCholesky, LinearSolverKind::SparseLu, LinearSolverKind::SparseLu];
    for (values, kind) in [values, skew, negative].into_iter().zip(kinds) {
        let mut b = vec![0.0; pattern.size()];
        pattern.multiply(&values, &exact, &mut b);
        solver.factorize(&values).unwrap();
        assert_eq!(solver.kind(), kind);
        solver.solve_in_place(&mut b).unwrap();
        let error = b.iter().zip(&exact).map(|(x, e)| (x - e).abs()).fold(0.0, f64::max);
        assert!(error < 1e-12, "{kind:?}: {error:e}");
    }
}

#[test]
fn siblings_share_the_analysis_and_nothing_else() {
    let (pattern, values) = cube(6, 0.1);
    let twice: Vec<f64> = values.iter().map(|v| 2.0 * v).collect();
    let pcg = linear::new(&pattern, true, LinearSolver::Pcg).unwrap();
    let others = [linear::for_exact(&pattern).unwrap(), pcg];
    for mut first in solvers(&pattern).into_iter().chain(others) {
        first.factorize(&values).unwrap();
        let mut second = first.sibling().unwrap();
        assert!(second.solve_in_place(&mut vec![1.0; 216]).is_err(), "nothing is factorised");
        second.factorize(&twice).unwrap();
        let (mut a, mut b) = (vec![1.0; 216], vec![1.0; 216]);
        first.solve_in_place(&mut a).unwrap();
        second.solve_in_place(&mut b).unwrap();
        let error = a.iter().zip(&b).map(|(a, b)| (a - 2.0 * b).abs()).fold(0.0, f64::max);
        assert!(error < 1e-12, "{:?}: {error:e}", first.kind());
    }
}

/// One division a row; what has an entry beside the diagonal, and what is small, goes elsewhere.
#[test]
fn a_diagonal_matrix_is_divided_by() {
    let diagonal = Pattern::new(40, std::iter::empty());
    let values: Vec<f64> = (0..40).map(|i| 3.0 + f64::from(i)).collect();
    for symmetric in [true, false] {
        let mut solver = linear::new(&diagonal, symmetric, LinearSolver::Auto).unwrap();
        assert_eq!((solver.kind(), solver.fill()), (LinearSolverKind::Diagonal, 40));
        assert!(solver.solve_in_place(&mut [1.0; 40]).is_err(), "nothing is factorised");
        solver.factorize(&values).unwrap();
        solver.check(&diagonal, &values).unwrap();
        let mut b: Vec<f64> = values.iter().map(|value| 2.5 * value).collect();
        solver.solve_in_place(&mut b).unwrap();
        assert_eq!(b, vec![2.5; 40]);
        let sibling = solver.sibling().unwrap().solve_in_place(&mut [1.0; 40]);
        assert_eq!(sibling, Err(FactorError::NotFactorized));
        for wrong in [0.0, f64::NAN] {
            let mut values = values.clone();
            values[7] = wrong;
            let error = match symmetric {
                true => FactorError::NotPositiveDefinite { index: 7 },
                false => FactorError::Singular { index: 7 },
            };
            assert_eq!(solver.factorize(&values), Err(error), "{wrong}");
            assert!(solver.solve_in_place(&mut [1.0; 40]).is_err());
        }
        let negative: Vec<f64> = values.iter().map(|value| -value).collect();
        assert_eq!(solver.factorize(&negative).is_ok(), !symmetric);
        assert!(solver.factorize(&values[1..]).is_err());
    }
    let kind = |pattern: &Pattern, choice| linear::new(pattern, false, choice).unwrap().kind();
    let beside = Pattern::new(40, [(3, 2)].into_iter());
    assert_eq!(kind(&beside, LinearSolver::Auto), LinearSolverKind::SparseLu);
    assert_eq!(kind(&diagonal, LinearSolver::Lu), LinearSolverKind::SparseLu);
    let small = Pattern::new(30, std::iter::empty());
    assert_eq!(kind(&small, LinearSolver::Auto), LinearSolverKind::DenseLu);
}
