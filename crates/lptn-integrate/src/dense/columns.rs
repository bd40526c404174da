//! A matrix stored column after column, and loops along its columns. The loops are compiled
//! for the vectors that a processor has; the order of every sum is the same for all.

use std::ops::{Index, IndexMut};

use faer::{Mat, MatRef};
use pulp::Arch;

use crate::kernels::dot_in;

const LANES: usize = 8;

#[derive(Clone, Debug)]
pub(super) struct Columns<T> {
    pub(super) rows: usize,
    pub(super) count: usize,
    values: Vec<T>,
}

impl<T: Copy> Columns<T> {
    pub(super) fn from_fn(rows: usize, count: usize, of: impl Fn(usize, usize) -> T) -> Self {
        let all = (0..count).flat_map(|j| (0..rows).map(move |i| (i, j)));
        Self { rows, count, values: all.map(|(i, j)| of(i, j)).collect() }
    }

    pub(super) fn column(&self, j: usize) -> &[T] {
        &self.values[j * self.rows..(j + 1) * self.rows]
    }

    pub(super) fn column_mut(&mut self, j: usize) -> &mut [T] {
        &mut self.values[j * self.rows..(j + 1) * self.rows]
    }

    /// Those before column `j`, and the others, as long slices.
    pub(super) fn split(&mut self, j: usize) -> (&mut [T], &mut [T]) {
        self.values.split_at_mut(j * self.rows)
    }
}

impl Columns<f64> {
    pub(super) fn of(a: MatRef<'_, f64>) -> Self {
        Self::from_fn(a.nrows(), a.ncols(), |i, j| a[(i, j)])
    }

    pub(super) fn zeros(rows: usize, count: usize) -> Self {
        Self { rows, count, values: vec![0.0; rows * count] }
    }

    pub(super) fn identity(size: usize) -> Self {
        Self::from_fn(size, size, |i, j| f64::from(u8::from(i == j)))
    }

    pub(super) fn matrix(&self) -> Mat<f64> {
        Mat::from_fn(self.rows, self.count, |i, j| self[(i, j)])
    }

    /// The largest magnitude; infinity or not a number if an element is.
    pub(super) fn largest(&self) -> f64 {
        self.values.iter().fold(0.0, |most, x| if x.abs() <= most { most } else { x.abs() })
    }

    pub(super) fn is_finite(&self) -> bool {
        self.values.iter().all(|x| x.is_finite())
    }
}

impl<T> Index<(usize, usize)> for Columns<T> {
    type Output = T;

    fn index(&self, (i, j): (usize, usize)) -> &T {
        &self.values[j * self.rows + i]
    }
}

impl<T> IndexMut<(usize, usize)> for Columns<T> {
    fn index_mut(&mut self, (i, j): (usize, usize)) -> &mut T {
        &mut self.values[j * self.rows + i]
    }
}

/// `y += by * x`
pub(super) fn add(y: &mut [f64], by: f64, x: &[f64]) {
    Arch::new().dispatch(|| y.iter_mut().zip(x).for_each(|(y, x)| *y += by * x));
}

/// Sum of `x[i] y[i]`.
pub(super) fn dot(x: &[f64], y: &[f64]) -> f64 {
    Arch::new().dispatch(|| dot_in::<LANES>(x, y))
}

/// `x = c x + s y`, `y = c y - s x`
pub(super) fn turn(x: &mut [f64], y: &mut [f64], (c, s): (f64, f64)) {
    Arch::new().dispatch(|| {
        for (x, y) in x.iter_mut().zip(y) {
            (*x, *y) = (c * *x + s * *y, c * *y - s * *x);
        }
    });
}
