//! What is asked of dense matrices, by faer. Each is compiled here once: faer is generic, and a crate
//! that calls it compiles its decompositions anew, ten seconds of them.

use faer::linalg::solvers::Solve as _;
use faer::{Mat, MatRef, Side};

/// Eigenvalues of a symmetric matrix, ascending, and its orthonormal eigenvectors in the columns that
/// go with them; the lower triangle is read. `None` where they are not found.
#[must_use]
pub fn symmetric_eigen(a: MatRef<'_, f64>) -> Option<(Vec<f64>, Mat<f64>)> {
    let eigen = a.self_adjoint_eigen(Side::Lower).ok()?;
    Some((eigen.S().column_vector().iter().copied().collect(), eigen.U().to_owned()))
}

/// Magnitudes of the eigenvalues of a square matrix. `None` where they are not found.
#[must_use]
pub fn eigenvalue_magnitudes(a: MatRef<'_, f64>) -> Option<Vec<f64>> {
    Some(a.eigenvalues().ok()?.iter().map(|z| z.re.hypot(z.im)).collect())
}

/// `A^-1 B` for a symmetric matrix A, of which the lower triangle is read. `None` where it is not
/// positive definite.
#[must_use]
pub fn cholesky_solve(a: MatRef<'_, f64>, b: MatRef<'_, f64>) -> Option<Mat<f64>> {
    Some(a.llt(Side::Lower).ok()?.solve(b))
}

/// `A B`
#[must_use]
pub fn product(a: MatRef<'_, f64>, b: MatRef<'_, f64>) -> Mat<f64> {
    a * b
}
