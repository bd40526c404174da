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
        let (mut all, mut room) = (x.to_vec(), vec![0.0; self.side()]);
        self.advance(fades, &mut all, &mut room);
        all
    }

    /// The same in place; `room` has at least one place for each row of the matrix.
    pub(super) fn advance(&self, fades: &[Fade], x: &mut [f64], room: &mut [f64]) {
        let d = self.side();
        for (i, out) in room.iter_mut().enumerate().take(d) {
            *out = self.row(i).iter().map(|(k, a)| a * x[*k]).sum();
        }
        x[..d].copy_from_slice(&room[..d]);
        x[d..].iter_mut().zip(fades).for_each(|(x, fade)| *x *= fade.left);
    }

    /// `T b T'` in place, symmetric as `b` is; `half` is room for T b.
    pub(super) fn carry(&self, fades: &[Fade], b: &mut [f64], half: &mut [f64]) {
        let (d, n) = (self.side(), b.len().isqrt());
        let half = &mut half[..d * n];
        half.fill(0.0);
        for (i, half) in half.chunks_exact_mut(n).enumerate() {
            self.row(i).iter().for_each(|(k, a)| add(half, *a, &b[k * n..][..n]));
        }
        for (i, half) in half.chunks_exact(n).enumerate() {
            for j in 0..=i {
                let sum = self.row(j).iter().map(|(k, a)| half[*k] * a).sum();
                (b[i * n + j], b[j * n + i]) = (sum, sum);
            }
            for j in d..n {
                let faded = half[j] * left(fades, j - d);
                (b[i * n + j], b[j * n + i]) = (faded, faded);
            }
        }
        for (i, row) in b.chunks_exact_mut(n).skip(d).enumerate() {
            let own = left(fades, i);
            let later = row[d..].iter_mut().enumerate();
            later.for_each(|(j, b)| *b *= own * left(fades, j));
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

#[cfg(test)]
mod tests {
    use super::{Fade, Transition};

    /// A matrix, a state that fades and one that stays: `T b T'` by hand.
    #[test]
    fn analytic_a_covariance_is_carried_by_matrix_and_fades() {
        let transition = Transition::of(&[1.0, 2.0, 0.0, 3.0]);
        let fades = [Fade { left: 0.5, variance: 0.0 }];
        let mut b = [
            [4.0, 1.0, 2.0, 8.0],
            [1.0, 5.0, 6.0, 3.0],
            [2.0, 6.0, 7.0, 10.0],
            [8.0, 3.0, 10.0, 9.0],
        ]
        .concat();
        transition.carry(&fades, &mut b, &mut [0.0; 16]);
        let expected = [
            [28.0, 33.0, 7.0, 14.0],
            [33.0, 45.0, 9.0, 9.0],
            [7.0, 9.0, 1.75, 5.0],
            [14.0, 9.0, 5.0, 9.0],
        ];
        assert_eq!(b, expected.concat());
    }
}
