//! A level of a multigrid method and its cycle.

use std::sync::Arc;

use super::super::Factorization;
use super::super::SparseCholesky;
use super::super::shape::Triangle;
use super::super::sweeps::Lower;
use crate::kernels;

/// A second step on a coarser level is skipped if the first left less of the residual than this.
const ENOUGH: f64 = 0.25;

/// One level: a matrix scaled to a diagonal of 1.
pub(super) struct Level {
    pub(super) triangle: Arc<Triangle>,
    /// The entries of its lower triangle.
    pub(super) entries: Vec<f64>,
    /// The node of the next level that corrects each row, and with which weight: 0 for none.
    pub(super) group: Vec<u32>,
    pub(super) weight: Vec<f64>,
    /// True if the next level is small enough to be visited twice.
    pub(super) twice: bool,
    pub(super) work: Vec<f64>,
    pub(super) coarse: Coarse,
}

/// Vectors of the next level: the right side, the two steps of its solution and their products with
/// its matrix.
#[derive(Default)]
pub(super) struct Coarse {
    right: Vec<f64>,
    steps: [Vec<f64>; 2],
    products: [Vec<f64>; 2],
}

impl Coarse {
    pub(super) fn new(size: usize, twice: bool) -> Self {
        let vector = || vec![0.0; size];
        let more = || if twice { vector() } else { Vec::new() };
        Self { right: vector(), steps: [vector(), more()], products: [more(), more()] }
    }
}

impl Level {
    pub(super) fn lower(&self) -> Lower<'_> {
        Lower::new(&self.triangle, &self.entries)
    }
}

/// Writes an approximation of the solution of `A x = r` on the first of these levels to `x`: a
/// sweep of Gauss and Seidel, a correction by the next level, and a sweep backwards.
pub(super) fn cycle(levels: &mut [Level], last: &mut SparseCholesky, r: &[f64], x: &mut [f64]) {
    let Some((level, rest)) = levels.split_first_mut() else {
        x.copy_from_slice(r);
        if last.solve_in_place(x).is_err() {
            x.fill(f64::NAN);
        }
        return;
    };
    let mut work = std::mem::take(&mut level.work);
    let mut coarse = std::mem::take(&mut level.coarse);
    level.lower().descend(r, x, &mut work);
    coarse.right.fill(0.0);
    for ((&group, weight), left) in level.group.iter().zip(&level.weight).zip(&work) {
        coarse.right[group as usize] += weight * left;
    }
    correct(rest, last, &mut coarse, level.twice);
    let correction = &coarse.steps[0];
    for ((x, &group), weight) in x.iter_mut().zip(&level.group).zip(&level.weight) {
        *x += weight * correction[group as usize];
    }
    work.copy_from_slice(r);
    level.lower().ascend(x, &mut work);
    (level.work, level.coarse) = (work, coarse);
}

/// Solves on a coarser level, with one or two steps of conjugate gradients (Y. Notay and P. S.
/// Vassilevski, Numer. Linear Algebra Appl. 15 (2008) 473).
fn correct(levels: &mut [Level], last: &mut SparseCholesky, coarse: &mut Coarse, twice: bool) {
    let Coarse { right, steps: [first, second], products: [of_first, of_second] } = coarse;
    cycle(levels, last, right, first);
    let (true, Some(level)) = (twice, levels.first()) else { return };
    level.lower().multiply(first, of_first);
    let (length, along) = (kernels::dot(first, of_first), kernels::dot(first, right));
    let step = along / length;
    if !step.is_finite() {
        return; // nothing is left over here
    }
    let before = kernels::dot(right, right);
    kernels::scale_and_add(1.0, right, -step, of_first);
    let after = kernels::dot(right, right);
    if after <= ENOUGH * ENOUGH * before || after.is_nan() {
        return first.iter_mut().for_each(|x| *x *= step);
    }
    cycle(levels, last, right, second);
    let Some(level) = levels.first() else { return };
    level.lower().multiply(second, of_second);
    let (shared, own) = (kernels::dot(second, of_first), kernels::dot(second, of_second));
    let rest = own - shared * shared / length;
    let further = kernels::dot(second, right) / rest;
    let both =
        if further.is_finite() { (step - shared * further / length, further) } else { (step, 0.0) };
    kernels::scale_and_add(both.0, first, both.1, second);
}
