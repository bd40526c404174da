//! Products of matrices. Every element is the sum of its products in their order.

use pulp::{Arch, NullaryFnOnce};

use super::columns::Columns;

/// Columns of the left factor that are added at once.
const AT_ONCE: usize = 8;

/// Numbers of rows and columns of the left factor that stay in the cache.
const ROWS: usize = 256;
const DEPTH: usize = 128;

/// `A B`
pub(super) fn product(a: &Columns<f64>, b: &Columns<f64>) -> Columns<f64> {
    let mut sum = Columns::zeros(a.rows, b.count);
    for from in (0..a.count).step_by(DEPTH) {
        let to = a.count.min(from + DEPTH);
        for top in (0..a.rows).step_by(ROWS) {
            let rows = top..a.rows.min(top + ROWS);
            let columns: Vec<&[f64]> = (from..to).map(|k| &a.column(k)[rows.clone()]).collect();
            for j in 0..b.count {
                let sum = &mut sum.column_mut(j)[rows.clone()];
                Arch::new().dispatch(Gather {
                    sum,
                    factors: &b.column(j)[from..to],
                    columns: &columns,
                });
            }
        }
    }
    sum
}

/// `sum += factors[k] * columns[k]` for every k, one after the other.
struct Gather<'a> {
    sum: &'a mut [f64],
    factors: &'a [f64],
    columns: &'a [&'a [f64]],
}

impl NullaryFnOnce for Gather<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let rows = self.sum.len();
        let (chunks, rest) = self.factors.as_chunks::<AT_ONCE>();
        let (groups, last) = self.columns.as_chunks::<AT_ONCE>();
        for (factors, columns) in chunks.iter().zip(groups) {
            let [a, b, c, d, e, f, g, h] = columns.map(|column| &column[..rows]);
            for (i, sum) in self.sum.iter_mut().enumerate() {
                let first = *sum + factors[0] * a[i] + factors[1] * b[i] + factors[2] * c[i];
                let then = first + factors[3] * d[i] + factors[4] * e[i] + factors[5] * f[i];
                *sum = then + factors[6] * g[i] + factors[7] * h[i];
            }
        }
        for (factor, column) in rest.iter().zip(last) {
            self.sum.iter_mut().zip(*column).for_each(|(sum, x)| *sum += factor * x);
        }
    }
}
