//! Cholesky factors row by row, with the columns that reach each row listed once.
//!
//! faer lists them and sorts the entries again for each matrix, which is most of the work if
//! columns are short. The order of sums is the same, and so is each digit of the factors.

use faer::sparse::SymbolicSparseColMat;
use faer::sparse::linalg::cholesky::simplicial::SymbolicSimplicialCholesky;
use faer::sparse::linalg::cholesky::{SymbolicCholesky, SymbolicCholeskyRaw};

/// Entries and columns of each row of factors that are stored column by column.
pub(super) struct Rows {
    /// Entries of each row up to the diagonal: their column and the slot of their value.
    entries: Lists<(u32, u32)>,
    /// The columns that have a number in each row, in the order in which they are subtracted.
    reach: Lists<u32>,
}

/// Lists one after another.
#[derive(Default)]
struct Lists<T> {
    ends: Vec<usize>,
    items: Vec<T>,
}

/// Memory of a factorisation.
#[derive(Default)]
pub(super) struct Memory {
    /// The row at hand.
    row: Vec<f64>,
    /// The last position that is filled of each column.
    ends: Vec<usize>,
}

impl Rows {
    /// `None` for factors that faer takes several columns at a time. `source` has the slot of each
    /// entry of the lower triangle.
    pub(super) fn of(
        symbolic: &SymbolicCholesky<usize>,
        lower: &SymbolicSparseColMat<usize>,
        source: &[usize],
    ) -> Option<Self> {
        let SymbolicCholeskyRaw::Simplicial(factor) = symbolic.raw() else { return None };
        let inverse = symbolic.perm().map(|order| order.arrays().1);
        let place = |index: usize| inverse.map_or(index, |inverse| inverse[index]);
        let mut entries = Vec::with_capacity(source.len());
        for column in 0..lower.ncols() {
            let slots = lower.col_ptr()[column]..lower.col_ptr()[column + 1];
            for slot in slots {
                let ends = [place(column), place(lower.row_idx()[slot])];
                let [low, high] = [ends[0].min(ends[1]), ends[0].max(ends[1])];
                entries.push((high, (small(low)?, small(source[slot])?)));
            }
        }
        entries.sort_by_key(|(row, _)| *row); // keeps the order in a row
        let mut lists = Lists::default();
        let mut entries = entries.as_slice();
        for k in 0..factor.ncols() {
            let (own, others) = entries.split_at(entries.partition_point(|(row, _)| *row == k));
            lists.push(own.iter().map(|(_, entry)| *entry));
            entries = others;
        }
        let reach = reach(factor, &lists)?;
        Some(Self { entries: lists, reach })
    }

    /// Factors of a matrix with these values.
    ///
    /// # Errors
    /// The position of a pivot that is not positive.
    pub(super) fn factorize(
        &self,
        symbolic: &SymbolicCholesky<usize>,
        values: &[f64],
        factors: &mut [f64],
        memory: &mut Memory,
    ) -> Result<(), usize> {
        let SymbolicCholeskyRaw::Simplicial(factor) = symbolic.raw() else { return Err(0) };
        let (starts, rows) = (factor.col_ptr(), factor.row_idx());
        let Memory { row: x, ends } = memory;
        x.clear();
        x.resize(factor.ncols(), 0.0);
        ends.clear();
        ends.extend_from_slice(&starts[..factor.ncols()]);
        for k in 0..factor.ncols() {
            for &(column, slot) in self.entries.get(k) {
                x[column as usize] += values[slot as usize];
            }
            let mut pivot = std::mem::take(&mut x[k]);
            for &column in self.reach.get(k) {
                let (first, end) = (starts[column as usize], &mut ends[column as usize]);
                let own = std::mem::take(&mut x[column as usize]) * factors[first].recip();
                let above = first + 1..*end + 1;
                for (&row, number) in rows[above.clone()].iter().zip(&factors[above]) {
                    x[row] -= number * own;
                }
                pivot -= own * own;
                *end += 1;
                factors[*end] = own;
            }
            if pivot.is_nan() || pivot <= 0.0 {
                return Err(k);
            }
            factors[starts[k]] = pivot.sqrt();
        }
        Ok(())
    }
}

impl<T> Lists<T> {
    fn push(&mut self, list: impl Iterator<Item = T>) {
        self.items.extend(list);
        self.ends.push(self.items.len());
    }

    fn get(&self, list: usize) -> &[T] {
        let first = list.checked_sub(1).map_or(0, |before| self.ends[before]);
        &self.items[first..self.ends[list]]
    }
}

/// The columns with a number in each row: from each of its entries along the elimination tree, the
/// path of the last entry first.
fn reach(
    factor: &SymbolicSimplicialCholesky<usize>,
    entries: &Lists<(u32, u32)>,
) -> Option<Lists<u32>> {
    let (starts, rows) = (factor.col_ptr(), factor.row_idx());
    let mut seen = vec![usize::MAX; factor.ncols()];
    let mut reach = Lists::default();
    for k in 0..factor.ncols() {
        seen[k] = k;
        let (mut found, mut paths) = (Vec::new(), vec![0]);
        for &(column, _) in entries.get(k) {
            let mut at = column as usize;
            while seen[at] != k {
                seen[at] = k;
                found.push(small(at)?);
                at = rows[starts[at] + 1]; // the first row below the diagonal is the parent
            }
            paths.push(found.len());
        }
        reach.push(paths.windows(2).rev().flat_map(|ends| found[ends[0]..ends[1]].iter().copied()));
    }
    Some(reach)
}

fn small(index: usize) -> Option<u32> {
    u32::try_from(index).ok()
}

#[cfg(test)]
mod tests {
    use faer::sparse::linalg::cholesky::CholeskySymbolicParams;
    use faer::sparse::linalg::cholesky::{SymmetricOrdering, factorize_symbolic_cholesky};
    use faer::sparse::{SparseColMatRef, SymbolicSparseColMat};
    use faer::{Par, Side, Spec, dyn_stack::MemBuffer, dyn_stack::MemStack};

    use super::{Memory, Rows};

    /// The lower triangle of a tree of `n` nodes with chords, and its values.
    fn tree(n: usize, chords: usize) -> (SymbolicSparseColMat<usize>, Vec<f64>) {
        let mut seed = 7_usize;
        let mut next = |below: usize| {
            seed = (seed * 1103 + 12345) % 65_521;
            seed % below
        };
        let mut ends: Vec<(usize, usize)> = (1..n).map(|i| (next(i), i)).collect();
        ends.extend((0..chords).map(|_| (next(n), next(n))).map(|(a, b)| (a.min(b), a.max(b))));
        ends.extend((0..n).map(|i| (i, i)));
        ends.sort_unstable();
        ends.dedup();
        let starts = (0..=n).map(|column| ends.partition_point(|end| end.0 < column)).collect();
        let value = |&(a, b): &(usize, usize)| match a == b {
            true => 30.0 + a as f64 / 3.0,
            false => -1.0 / (1.0 + a as f64 + 2.0 * b as f64),
        };
        let values = ends.iter().map(value).collect();
        let rows = ends.into_iter().map(|end| end.1).collect();
        (SymbolicSparseColMat::new_checked(n, n, starts, None, rows), values)
    }

    /// faer is the other program.
    #[test]
    fn factors_have_the_digits_of_faer() {
        for (n, chords) in [(1, 0), (9, 0), (60, 0), (60, 20), (200, 60)] {
            let (lower, mut values) = tree(n, chords);
            let (by, params) = (SymmetricOrdering::Amd, CholeskySymbolicParams::default());
            let symbolic = factorize_symbolic_cholesky(lower.as_ref(), Side::Lower, by, params);
            let symbolic = symbolic.unwrap();
            let source: Vec<usize> = (0..values.len()).collect();
            let rows = Rows::of(&symbolic, &lower, &source).unwrap();
            let faer = |values: &[f64]| {
                let mut factors = vec![0.0; symbolic.len_val()];
                let scratch =
                    symbolic.factorize_numeric_llt_scratch::<f64>(Par::Seq, Spec::default());
                let mut memory = MemBuffer::new(scratch);
                let matrix = SparseColMatRef::new(lower.as_ref(), values);
                let (par, stack) = (Par::Seq, MemStack::new(&mut memory));
                let done = symbolic.factorize_numeric_llt(
                    &mut factors,
                    matrix,
                    Side::Lower,
                    Default::default(),
                    par,
                    stack,
                    Spec::default(),
                );
                done.is_ok().then_some(factors)
            };
            let mut memory = Memory::default();
            let mut own = |values: &[f64]| {
                let mut factors = vec![0.0; symbolic.len_val()];
                rows.factorize(&symbolic, values, &mut factors, &mut memory).ok()?;
                Some(factors)
            };
            assert_eq!(own(&values), faer(&values), "{n} {chords}");
            values[lower.col_ptr()[n / 2]] = -1.0;
            assert_eq!((own(&values), faer(&values)), (None, None));
        }
    }
}
