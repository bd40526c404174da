//! Iterations with an incomplete factor: conjugate gradients for symmetric matrices,
//! BiCGStab for others.

use super::incomplete::{Incomplete, Work};
use crate::kernels;

/// More iterations than this cost more than exact factors.
const MOST: usize = 1000;

/// Squares below this have lost digits to underflow.
const LEAST: f64 = f64::MIN_POSITIVE;

/// Limits of the iterations.
#[derive(Clone, Copy, Debug)]
pub(super) struct End {
    /// Largest residual allowed, over the diagonal.
    pub(super) allowed: f64,
    /// Largest square allowed of the last correction in the energy norm `x' A x`, for conjugate
    /// gradients. The residual alone does not see smooth errors.
    pub(super) energy: f64,
    /// Largest number of iterations.
    pub(super) most: usize,
}

/// Predicts from a square when it is worth computing the residual: by and large the square falls as
/// that does.
struct Watch {
    size: f64,
    square: f64,
}

impl Watch {
    /// True if the residual is at most `allowed`; `left` is the residual times `(I + L)^-1`.
    fn sees_the_end(
        &mut self,
        (matrix, allowed): (&Incomplete, f64),
        square: f64,
        left: &[f64],
        work: &mut [f64],
    ) -> bool {
        if self.size * self.size * square > allowed * allowed * self.square {
            return false;
        }
        (self.size, self.square) = (matrix.left_over(left, work), square);
        self.size <= allowed
    }
}

/// Conjugate gradients (M. R. Hestenes and E. Stiefel, J. Res. Natl. Bur. Stand. 49 (1952) 409),
/// after [`Incomplete::begin`]; the number of iterations, and true if they reached the end.
pub(super) fn conjugate(
    matrix: &Incomplete,
    work: &mut Work,
    size: f64,
    end: End,
) -> (usize, bool) {
    let Work { solution, left, direction, step, product, .. } = work;
    matrix.precondition(left);
    direction.clone_from(left);
    step.clone_from(left);
    let mut square = kernels::dot(left, left);
    if square < LEAST && size <= end.allowed {
        return (0, true); // its square is lost to underflow
    }
    let mut watch = Watch { size, square };
    for count in 1..=end.most.min(MOST) {
        matrix.apply(direction, step, product);
        let length = square / kernels::dot(product, direction);
        if length.is_nan() || length <= 0.0 {
            return (count, false); // not positive definite
        }
        kernels::scale_and_add(1.0, solution, length, step);
        kernels::scale_and_add(1.0, left, -length, product);
        let next = kernels::dot(left, left);
        // the square of the correction in the energy norm, which is that of the error before it less
        // that of the error after it
        let small = length * square <= end.energy || next < LEAST;
        if small && watch.sees_the_end((matrix, end.allowed), next, left, product) {
            return (count, true);
        }
        let share = next / square;
        let all = direction.iter_mut().zip(&mut *step).zip(&*left);
        for ((direction, step), left) in all {
            *direction = left + share * *direction;
            *step = *direction;
        }
        square = next;
    }
    (end.most.min(MOST), false)
}

/// BiCGStab (H. A. van der Vorst, SIAM J. Sci. Stat. Comput. 13 (1992) 631), like [`conjugate`].
pub(super) fn stabilized(
    matrix: &Incomplete,
    work: &mut Work,
    size: f64,
    end: End,
) -> (usize, bool) {
    let Work { solution, left, direction, step, product, more: [first, second] } = work;
    matrix.precondition(left);
    first.clone_from(left);
    direction.clone_from(left);
    step.clone_from(left);
    second.clone_from(left);
    let mut along = kernels::dot(first, left);
    let mut watch = Watch { size, square: along };
    for count in 1..=end.most.min(MOST) {
        matrix.apply(direction, step, product);
        let length = along / kernels::dot(first, product);
        kernels::scale_and_add(1.0, solution, length, step);
        kernels::scale_and_add(1.0, left, -length, product);
        // the same once more, along the residual
        step.copy_from_slice(left);
        matrix.apply(left, step, second);
        let further = kernels::dot(second, left) / kernels::dot(second, second);
        let further = if further.is_nan() { 0.0 } else { further };
        kernels::scale_and_add(1.0, solution, further, step);
        kernels::scale_and_add(1.0, left, -further, second);
        let square = kernels::dot(left, left);
        if watch.sees_the_end((matrix, end.allowed), square, left, second) {
            return (count, true);
        }
        let next = kernels::dot(first, left);
        let share = next / along * (length / further);
        if !share.is_finite() {
            return (count, false);
        }
        let all = direction.iter_mut().zip(&mut *step).zip(&*left).zip(&*product);
        for (((direction, step), left), product) in all {
            *direction = left + share * (*direction - further * product);
            *step = *direction;
        }
        along = next;
    }
    (end.most.min(MOST), false)
}
