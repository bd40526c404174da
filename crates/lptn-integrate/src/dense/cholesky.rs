//! `A = L L'` of symmetric positive definite matrices.

use pulp::{Arch, NullaryFnOnce};

use super::columns::{Columns, add, dot};

/// Columns that are eliminated before the others follow: those stay in the cache.
const AT_ONCE: usize = 16;

/// Below this many rows, to ask for the processor takes longer than to factor.
const FEW: usize = 8;

/// L in the lower triangle of A, which alone is read; `None` if a pivot is not positive.
pub(super) fn factor(a: Columns<f64>) -> Option<Columns<f64>> {
    if a.rows < FEW {
        return Factor(a).call();
    }
    Arch::new().dispatch(Factor(a))
}

struct Factor(Columns<f64>);

impl NullaryFnOnce for Factor {
    type Output = Option<Columns<f64>>;

    #[inline(always)]
    fn call(self) -> Self::Output {
        let n = self.0.rows;
        let mut l = self.0;
        for from in (0..n).step_by(AT_ONCE) {
            let to = n.min(from + AT_ONCE);
            for j in from..n {
                let (done, rest) = l.split(j);
                let column = &mut rest[j..n];
                let before = done[from * n..].chunks_exact(n).take(to - from);
                before.for_each(|left| take(column, &left[j..]));
                if j < to {
                    finish(column)?;
                }
            }
        }
        Some(l)
    }
}

/// `column -= left[0] * left`, from the diagonal down.
#[inline(always)]
fn take(column: &mut [f64], left: &[f64]) {
    let by = left[0];
    column.iter_mut().zip(left).for_each(|(x, l)| *x -= by * l);
}

#[inline(always)]
fn finish(column: &mut [f64]) -> Option<()> {
    let pivot = column[0];
    if pivot.is_nan() || pivot <= 0.0 {
        return None;
    }
    let root = pivot.sqrt();
    column.iter_mut().for_each(|x| *x /= root);
    Some(())
}

/// `x = (L L')^-1 x`
pub(super) fn solve(l: &Columns<f64>, x: &mut [f64]) {
    let n = x.len();
    for k in 0..n {
        x[k] /= l[(k, k)];
        let (head, tail) = x.split_at_mut(k + 1);
        add(tail, -head[k], &l.column(k)[k + 1..]);
    }
    for k in (0..n).rev() {
        let below = dot(&l.column(k)[k + 1..], &x[k + 1..]);
        x[k] = (x[k] - below) / l[(k, k)];
    }
}
