//! `P A = L U` with partial pivoting, of real and of complex matrices.

use std::ops::{Div, Mul, Range, SubAssign};

use pulp::{Arch, NullaryFnOnce};

use super::Complex;
use super::columns::Columns;

/// Columns that are eliminated before the others follow: those stay in the cache.
const AT_ONCE: usize = 16;

/// Type of the elements of a matrix.
pub(super) trait Number: Copy + Mul<Output = Self> + Div<Output = Self> + SubAssign {
    /// Magnitude by which a pivot is chosen.
    fn size(self) -> f64;
}

impl Number for f64 {
    fn size(self) -> f64 {
        self.abs()
    }
}

impl Number for Complex {
    fn size(self) -> f64 {
        self.re.abs() + self.im.abs()
    }
}

/// `A^-1 B` for a square matrix A; not finite if it is singular.
pub(super) fn solve<T: Number>(a: Columns<T>, b: Columns<T>) -> Columns<T> {
    Arch::new().dispatch(Solve { a, b, rows: Vec::new() })
}

struct Solve<T> {
    a: Columns<T>,
    b: Columns<T>,
    /// The row that became row `k`.
    rows: Vec<usize>,
}

impl<T: Number> NullaryFnOnce for Solve<T> {
    type Output = Columns<T>;

    #[inline(always)]
    fn call(mut self) -> Columns<T> {
        let n = self.a.rows;
        for from in (0..n).step_by(AT_ONCE) {
            self.panel(from..n.min(from + AT_ONCE));
        }
        let (_, all) = self.b.split(0);
        all.chunks_mut((AT_ONCE * n).max(1)).for_each(|some| backwards(&self.a, some));
        self.b
    }
}

impl<T: Number> Solve<T> {
    /// Eliminates some columns.
    #[inline(always)]
    fn panel(&mut self, panel: Range<usize>) {
        let n = self.a.rows;
        for k in panel.clone() {
            let (done, rest) = self.a.split(k);
            let column = &mut rest[..n];
            follow(column, panel.start..k, (&done[panel.start * n..], &self.rows));
            let larger = |best: usize, i: usize| {
                if column[i].size() > column[best].size() { i } else { best }
            };
            let row = (k + 1..n).fold(k, larger);
            column.swap(k, row);
            self.rows.push(row);
            let pivot = column[k];
            column[k + 1..].iter_mut().for_each(|x| *x = *x / pivot);
        }
        let (done, rest) = self.a.split(panel.end);
        let factors = (&done[panel.start * n..], &self.rows[..]);
        let later = rest.chunks_exact_mut(n);
        later.for_each(|column| follow(column, panel.clone(), factors));
        for j in 0..self.b.count {
            follow(self.b.column_mut(j), panel.clone(), factors);
        }
    }
}

/// A column through the steps of a panel, whose columns begin with its first: rows are swapped, and
/// `column[k + 1..] -= column[k] * factors`
#[inline(always)]
fn follow<T: Number>(column: &mut [T], panel: Range<usize>, (done, rows): (&[T], &[usize])) {
    for (k, factors) in panel.zip(done.chunks_exact(column.len())) {
        column.swap(k, rows[k]);
        let by = column[k];
        column[k + 1..].iter_mut().zip(&factors[k + 1..]).for_each(|(x, l)| *x -= by * *l);
    }
}

/// `x = U^-1 x` for some columns.
#[inline(always)]
fn backwards<T: Number>(a: &Columns<T>, some: &mut [T]) {
    for k in (0..a.rows).rev() {
        for x in some.chunks_exact_mut(a.rows) {
            let (above, rest) = x.split_at_mut(k);
            let by = rest[0] / a[(k, k)];
            rest[0] = by;
            above.iter_mut().zip(a.column(k)).for_each(|(x, u)| *x -= by * *u);
        }
    }
}
