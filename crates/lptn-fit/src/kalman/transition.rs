//! Transitions of states: the first by a matrix, each of the others by itself.

use lptn_integrate::vectors::add;

/// A square matrix without its zeros.
#[derive(Clone, Debug, PartialEq)]
pub struct Transition {
    /// Index at which each row begins, and at which the last ends.
    starts: Vec<usize>,
    entries: Vec<(usize, f64)>,
}

/// Transition of a state that no other changes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fade {
    /// The part of it that is left.
    pub left: f64,
    /// The variance that is added.
    pub variance: f64,
}

impl Fade {
    /// The state stays as it is.
    pub const NONE: Self = Self { left: 1.0, variance: 0.0 };
}

impl Transition {
    /// From a matrix, row by row.
    pub fn of(matrix: &[f64]) -> Self {
        let side = matrix.len().isqrt();
        let mut own = Self { starts: vec![0], entries: Vec::new() };
        for row in matrix.chunks_exact(side.max(1)) {
            let there = row.iter().copied().enumerate().filter(|(_, value)| value.abs() > 0.0);
            own.entries.extend(there);
            own.starts.push(own.entries.len());
        }
        own
    }

    /// The number of rows.
    pub fn side(&self) -> usize {
        self.starts.len() - 1
    }

    fn row(&self, i: usize) -> &[(usize, f64)] {
        &self.entries[self.starts[i]..self.starts[i + 1]]
    }

    /// `T x`, with a T that fades the states after the matrix.
    pub(crate) fn advanced(&self, fades: &[Fade], x: &[f64]) -> Vec<f64> {
        let d = self.side();
        let one = |i: usize| self.row(i).iter().map(|(k, a)| a * x[*k]).sum();
        let mut all: Vec<f64> = (0..d).map(one).collect();
        all.extend(x[d..].iter().enumerate().map(|(i, x)| left(fades, i) * x));
        all
    }

    /// `T b T'`, symmetric as `b` is, into `out`; `half` is T b.
    pub(super) fn carried(&self, fades: &[Fade], b: &[f64], (half, out): (&mut [f64], &mut [f64])) {
        let (d, n) = (self.side(), b.len().isqrt());
        half.fill(0.0);
        for (i, half) in half.chunks_exact_mut(n).enumerate() {
            match i.checked_sub(d) {
                None => self.row(i).iter().for_each(|(k, a)| add(half, *a, &b[k * n..][..n])),
                Some(behind) => add(half, left(fades, behind), &b[i * n..][..n]),
            }
        }
        for i in 0..n {
            let half = &half[i * n..][..n];
            for j in 0..=i {
                let sum = match j.checked_sub(d) {
                    None => self.row(j).iter().map(|(k, a)| half[*k] * a).sum(),
                    Some(behind) => half[j] * left(fades, behind),
                };
                (out[i * n + j], out[j * n + i]) = (sum, sum);
            }
        }
    }

    /// The transposed matrix.
    pub fn transposed(&self) -> Self {
        let d = self.side();
        let mut dense = vec![0.0; d * d];
        for i in 0..d {
            self.row(i).iter().for_each(|(k, a)| dense[k * d + i] = *a);
        }
        Self::of(&dense)
    }
}

/// The part that is left of a state after the matrix.
fn left(fades: &[Fade], behind: usize) -> f64 {
    fades.get(behind).map_or(1.0, |fade| fade.left)
}
