//! What is asked of dense matrices, by faer. Each is compiled here once: faer is generic, and a
//! crate that calls it compiles its decompositions anew, ten seconds of them.

use faer::linalg::solvers::{Solve as _, SolveLstsq as _};
use faer::{Mat, MatRef, Side};

/// Eigenvalues of a symmetric matrix, ascending, and its orthonormal eigenvectors in the columns
/// that go with them; the lower triangle is read. `None` where they are not found.
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

/// A complex number.
pub type Complex = faer::c64;

/// Eigenvalues of a square matrix with their vectors in the columns that go with them; those of a
/// pair stand beside each other, the one with the positive imaginary part first.
pub struct GeneralEigen {
    /// Eigenvalues.
    pub values: Vec<Complex>,
    /// Right eigenvectors of length 1.
    pub vectors: Mat<Complex>,
}

impl GeneralEigen {
    /// Brings the smallest magnitudes to the front.
    pub fn sort(&mut self) {
        let mut order: Vec<usize> = (0..self.values.len()).collect();
        let key = |k: usize| (self.values[k].norm(), -self.values[k].im);
        order.sort_by(|&a, &b| key(a).0.total_cmp(&key(b).0).then(key(a).1.total_cmp(&key(b).1)));
        self.values = order.iter().map(|&k| self.values[k]).collect();
        let rows = self.vectors.nrows();
        self.vectors = Mat::from_fn(rows, order.len(), |i, k| self.vectors[(i, order[k])]);
    }
}

/// Eigenvalues and right eigenvectors of a square matrix. `None` where they are not found.
#[must_use]
pub fn general_eigen(a: MatRef<'_, f64>) -> Option<GeneralEigen> {
    let eigen = a.eigen().ok()?;
    let values = eigen.S().column_vector().iter().copied().collect();
    Some(GeneralEigen { values, vectors: eigen.U().to_owned() })
}

/// The inverse of a square matrix. `None` where it is singular to rounding.
#[must_use]
pub fn complex_inverse(a: &Mat<Complex>) -> Option<Mat<Complex>> {
    let size = a.nrows();
    let inverse = a.partial_piv_lu().solve(Mat::<Complex>::identity(size, size));
    let finite = (0..size).all(|j| (0..size).all(|i| inverse[(i, j)].norm().is_finite()));
    finite.then_some(inverse)
}

/// `A^-1 B` for a square matrix. `None` where it is singular to rounding.
#[must_use]
pub fn solve(a: MatRef<'_, f64>, b: MatRef<'_, f64>) -> Option<Mat<f64>> {
    let x = a.partial_piv_lu().solve(b);
    let finite = (0..x.ncols()).all(|j| (0..x.nrows()).all(|i| x[(i, j)].is_finite()));
    finite.then_some(x)
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

/// The diagonal of the Cholesky factor of a symmetric matrix, of which the lower triangle is read.
/// `None` where it is not positive definite.
#[must_use]
pub fn cholesky_diagonal(a: MatRef<'_, f64>) -> Option<Vec<f64>> {
    let factor = a.llt(Side::Lower).ok()?;
    Some((0..a.nrows()).map(|j| factor.L()[(j, j)]).collect())
}

/// The triangular factor R of `A = Q R`, with as many rows as the smaller side of A.
#[must_use]
pub fn triangle(a: MatRef<'_, f64>) -> Mat<f64> {
    a.qr().thin_R().to_owned()
}

/// The x that makes `|A x - b|` least, for A with at least as many rows as columns, by QR.
#[must_use]
pub fn least_squares(a: MatRef<'_, f64>, b: MatRef<'_, f64>) -> Mat<f64> {
    a.qr().solve_lstsq(b)
}

/// `A = U diag(values) V^T`
pub struct Singular {
    /// Orthonormal columns, one per value.
    pub u: Mat<f64>,
    /// Largest first, as many as the smaller side of A.
    pub values: Vec<f64>,
    /// Orthonormal columns, one per value.
    pub v: Mat<f64>,
}

/// The singular values of a matrix with their vectors. `None` where they are not found.
#[must_use]
pub fn singular(a: MatRef<'_, f64>) -> Option<Singular> {
    let svd = a.thin_svd().ok()?;
    let values = svd.S().column_vector().iter().copied().collect();
    Some(Singular { u: svd.U().to_owned(), values, v: svd.V().to_owned() })
}
