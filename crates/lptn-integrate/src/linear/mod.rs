//! Solvers for `A x = b` with one sparsity pattern and many sets of values.
//!
//! They serve the Newton matrices `M - gamma J` of the integrator, and steady states `G x = b`. The
//! analysis of the pattern happens once, in `new`; [`Factorization::factorize`] and
//! [`Factorization::solve_in_place`] work in memory kept between calls.
//!
//! Up to 30 unknowns the solver is dense, for one and two unknowns too. A closed form for these is
//! not built: the whole process for the gearbox with 7500 rows takes a few milliseconds of CPU
//! time. Most of that is the start of the process and the printing of numbers
//! (docs/performance.md).

mod cholesky;
mod columns;
mod cost;
mod counts;
mod dense;
mod diagonal;
mod either;
mod fallback;
mod incomplete;
mod krylov;
mod lu;
mod methods;
mod multigrid;
mod row_by_row;
mod shape;
mod sweeps;

pub use cholesky::SparseCholesky;
pub use dense::Dense;
pub use diagonal::Diagonal;
pub use either::Either;
pub use krylov::Krylov;
pub use lu::SparseLu;
pub use multigrid::Multigrid;

use std::sync::Mutex;

use faer::MatMut;
use faer::dyn_stack::{MemBuffer, StackReq};

use crate::{FactorError, Pattern, kernels};

/// Largest size for which [`LinearSolver::Auto`] takes a dense solver: below it the bookkeeping of
/// sparse factors costs more than the arithmetic.
pub const DENSE_LIMIT: usize = 30;

/// Solution components of the probe in [`Factorization::check`] above which a matrix counts as
/// singular.
const SINGULAR: f64 = 1e15;

/// The share of the probe that may remain: only the size of the solution matters.
const PROBED: f64 = 1e-3;

/// Choice of the solver.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LinearSolver {
    /// Dense up to [`DENSE_LIMIT`] components, else the cheapest for the use of the matrix: exact
    /// sparse factors or iterations.
    #[default]
    Auto,
    /// Dense Cholesky for symmetric matrices, else dense LU with partial pivoting.
    Dense,
    /// Sparse Cholesky; an error for matrices that are not symmetric.
    Cholesky,
    /// Sparse LU.
    Lu,
    /// Preconditioned conjugate gradients; an error for matrices that are not symmetric.
    Pcg,
}

/// The solver in use.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LinearSolverKind {
    /// Dense Cholesky.
    DenseCholesky,
    /// Dense LU with partial pivoting.
    DenseLu,
    /// One division a row.
    Diagonal,
    /// Sparse Cholesky, approximate minimum degree ordering.
    SparseCholesky,
    /// Sparse LU, column approximate minimum degree ordering.
    SparseLu,
    /// Conjugate gradients with an incomplete Cholesky factor.
    Pcg,
    /// Conjugate gradients with a multigrid method.
    Multigrid,
    /// BiCGStab with an incomplete LU factor.
    BiCgStab,
}

/// A matrix that can be factorised again and again with other values in the same pattern.
pub trait Factorization {
    /// Number of rows.
    fn size(&self) -> usize;

    /// Kind of this solver.
    fn kind(&self) -> LinearSolverKind;

    /// Numbers stored for the factors (for sparse LU: of the matrix, its factors being sized on the
    /// fly).
    fn fill(&self) -> usize;

    /// Iterations of all solves up to now; 0 for exact factors.
    fn iterations(&self) -> u64 {
        0
    }

    /// A solver for other matrices with the same pattern, without factors yet. The analysis of the
    /// pattern is shared.
    ///
    /// # Errors
    /// [`FactorError::OutOfMemory`].
    fn sibling(&self) -> Result<Box<dyn Factorization>, FactorError>;

    /// Factorises the matrix with these values, one per slot of the pattern; Cholesky reads the
    /// lower triangle only.
    ///
    /// # Errors
    /// [`FactorError::NotPositiveDefinite`] (Cholesky), [`FactorError::Singular`] (LU), a wrong
    /// length. There are then no factors to solve with.
    fn factorize(&mut self, values: &[f64]) -> Result<(), FactorError>;

    /// Replaces `b` by the solution of `A x = b`.
    ///
    /// # Errors
    /// [`FactorError::NotFactorized`], a wrong length, or [`FactorError::Singular`] with the first
    /// component of the solution that is not finite.
    fn solve_in_place(&mut self, b: &mut [f64]) -> Result<(), FactorError>;

    /// Writes the solution of `A x = b` to `x`, which contains a guess. Solvers that iterate begin
    /// there and stop when every component of `b - A x` is at most `allowed` of the diagonal entry
    /// of its row (for a network: `allowed` is in K). Conjugate gradients also correct until a
    /// correction is smaller, in the energy norm of `A`, than `allowed` everywhere. The others
    /// solve exactly.
    ///
    /// # Errors
    /// Those of [`Factorization::solve_in_place`].
    fn solve_from(&mut self, b: &[f64], x: &mut [f64], allowed: f64) -> Result<(), FactorError> {
        let _ = allowed;
        expect_length(x.len(), b.len())?;
        x.copy_from_slice(b);
        self.solve_in_place(x)
    }

    /// Replaces `b` by a solution of `A x = b` for a Newton iteration that errs itself. Solvers
    /// that iterate stop when every component of the residual, over the diagonal, is at most this
    /// share of the largest of `b`; the others solve exactly.
    ///
    /// # Errors
    /// Those of [`Factorization::solve_in_place`].
    fn solve_share(&mut self, b: &mut [f64], share: f64) -> Result<(), FactorError> {
        let _ = share;
        self.solve_in_place(b)
    }

    /// Checks that the factors are usable: sparse elimination may pass a singular matrix with a
    /// pivot of rounding errors only. Solves once, with the diagonal as right side, so that the
    /// solution is of the order of 1 for a matrix that is dominated by its diagonal.
    ///
    /// # Errors
    /// [`FactorError::Singular`] with the largest component: for a network one of an island
    /// without a path to ground.
    fn check(&mut self, pattern: &Pattern, values: &[f64]) -> Result<(), FactorError> {
        probe(pattern, values, |b| self.solve_share(b, PROBED))
    }
}

/// See [`Factorization::check`].
fn probe(
    pattern: &Pattern,
    values: &[f64],
    mut solve: impl FnMut(&mut [f64]) -> Result<(), FactorError>,
) -> Result<(), FactorError> {
    let mut probe: Vec<f64> = pattern.diagonal().iter().map(|&slot| values[slot].abs()).collect();
    solve(&mut probe)?;
    let index = kernels::worst(&probe, &vec![1.0; probe.len()]);
    match probe.get(index) {
        Some(largest) if largest.abs() > SINGULAR => Err(FactorError::Singular { index }),
        _ => Ok(()),
    }
}

/// True if [`new`] returns a dense solver.
pub fn is_dense(choice: LinearSolver, size: usize) -> bool {
    choice == LinearSolver::Dense || (choice == LinearSolver::Auto && size <= DENSE_LIMIT)
}

/// Analyses the pattern for the chosen solver.
///
/// # Errors
/// [`FactorError::NotSymmetric`] if Cholesky is asked for and `symmetric` is false; no memory.
pub fn new(
    pattern: &Pattern,
    symmetric: bool,
    choice: LinearSolver,
) -> Result<Box<dyn Factorization>, FactorError> {
    if matches!(choice, LinearSolver::Cholesky | LinearSolver::Pcg) && !symmetric {
        return Err(FactorError::NotSymmetric);
    }
    if choice == LinearSolver::Pcg {
        return Ok(Box::new(Krylov::new(pattern, true)));
    }
    if is_dense(choice, pattern.size()) {
        return Ok(Box::new(Dense::new(pattern, symmetric)));
    }
    if choice == LinearSolver::Auto
        && let Some(diagonal) = Diagonal::of(pattern, symmetric)
    {
        return Ok(Box::new(diagonal));
    }
    if symmetric && choice != LinearSolver::Lu {
        return Ok(Box::new(SparseCholesky::new(pattern)?));
    }
    Ok(Box::new(SparseLu::new(pattern)?))
}

/// Like [`new`], for the matrices `M - gamma J` of a multistep method, which change with every step
/// size: [`LinearSolver::Auto`] takes [`Krylov`] if exact factors would cost more.
///
/// # Errors
/// As [`new`].
pub fn for_steps(
    pattern: &Pattern,
    symmetric: bool,
    choice: LinearSolver,
) -> Result<Box<dyn Factorization>, FactorError> {
    cheapest(pattern, symmetric, (choice, cost::NEWTON))
}

/// Like [`new`], for the matrices of a one-step method with few step sizes, each of which serves
/// many calls of [`Factorization::solve_from`].
///
/// # Errors
/// As [`new`].
pub fn for_stages(
    pattern: &Pattern,
    symmetric: bool,
    choice: LinearSolver,
) -> Result<Box<dyn Factorization>, FactorError> {
    cheapest(pattern, symmetric, (choice, cost::STAGES))
}

/// Like [`new`], for the symmetric matrix of a steady state, which is badly conditioned:
/// [`LinearSolver::Auto`] takes [`Krylov`] or [`Multigrid`] if exact factors would cost more.
///
/// # Errors
/// As [`new`].
pub fn for_steady(
    pattern: &Pattern,
    choice: LinearSolver,
) -> Result<Box<dyn Factorization>, FactorError> {
    if choice == LinearSolver::Auto && !is_dense(choice, pattern.size()) {
        return cost::steady(pattern);
    }
    new(pattern, true, choice)
}

fn cheapest(
    pattern: &Pattern,
    symmetric: bool,
    (choice, demand): (LinearSolver, cost::Demand),
) -> Result<Box<dyn Factorization>, FactorError> {
    if choice != LinearSolver::Auto || is_dense(choice, pattern.size()) {
        return new(pattern, symmetric, choice);
    }
    let cheapest = if symmetric { cost::cheapest } else { cost::not_symmetric };
    cheapest(pattern, demand)
}

/// Number of rows from which the exact Jacobians of Newton's method are checked for symmetry: below
/// it LU takes little time.
const LARGE: usize = 2000;

/// Like [`new`], for exact Jacobians: not symmetric in general, but often by their values.
///
/// # Errors
/// As [`new`].
pub fn for_exact(pattern: &Pattern) -> Result<Box<dyn Factorization>, FactorError> {
    if pattern.size() < LARGE {
        return new(pattern, false, LinearSolver::Auto);
    }
    Ok(Box::new(Either::new(pattern)))
}

/// Solves `A x = b` with `steps` steps of iterative refinement, for which `A` (pattern and values)
/// is needed in addition to its factors. Writes the solution to `x` and returns the largest
/// remaining `|b - A x|`.
///
/// # Errors
/// Those of [`Factorization::solve_in_place`].
pub fn solve_refined(
    factors: &mut dyn Factorization,
    (pattern, values): (&Pattern, &[f64]),
    b: &[f64],
    x: &mut [f64],
    steps: usize,
) -> Result<f64, FactorError> {
    expect_length(pattern.len(), values.len())?;
    expect_length(pattern.size(), b.len())?;
    expect_length(pattern.size(), x.len())?;
    x.copy_from_slice(b);
    factors.solve_in_place(x)?;
    let mut residual = vec![0.0; b.len()];
    for _ in 0..steps {
        write_residual(pattern, values, (b, x), &mut residual);
        factors.solve_in_place(&mut residual)?;
        kernels::scale_and_add(1.0, x, 1.0, &residual);
    }
    write_residual(pattern, values, (b, x), &mut residual);
    Ok(kernels::max_norm(&residual))
}

fn write_residual(
    pattern: &Pattern,
    values: &[f64],
    (b, x): (&[f64], &[f64]),
    residual: &mut [f64],
) {
    pattern.multiply(values, x, residual);
    kernels::scale_and_add(-1.0, residual, 1.0, b);
}

fn expect_length(expected: usize, found: usize) -> Result<(), FactorError> {
    if expected == found { Ok(()) } else { Err(FactorError::WrongLength { expected, found }) }
}

/// Solves with factors of this size if they are `ready`, with the checks that every solve has.
fn checked(
    (size, ready): (usize, bool),
    b: &mut [f64],
    solve: impl FnOnce(&mut [f64]),
) -> Result<(), FactorError> {
    expect_length(size, b.len())?;
    if !ready {
        return Err(FactorError::NotFactorized);
    }
    solve(b);
    kernels::first_not_finite(b).map_or(Ok(()), |index| Err(FactorError::Singular { index }))
}

/// One right side as faer takes it.
fn column(b: &mut [f64]) -> MatMut<'_, f64> {
    let rows = b.len();
    MatMut::from_column_major_slice_mut(b, rows, 1)
}

/// Memory in which faer can work.
fn allocated(needed: StackReq) -> Result<MemBuffer, FactorError> {
    MemBuffer::try_new(needed).map_err(|_| FactorError::OutOfMemory)
}

/// Takes the item of a shelf that siblings share; `None` if another one has it.
fn taken<T>(shelf: &Mutex<Option<T>>) -> Option<T> {
    shelf.lock().ok().and_then(|mut shelf| shelf.take())
}

fn put<T>(shelf: &Mutex<Option<T>>, item: T) {
    if let Ok(mut shelf) = shelf.lock() {
        *shelf = Some(item);
    }
}
