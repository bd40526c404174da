//! Stability of small disturbances of a few temperatures, to the last digit that counts.
//!
//! The trapezoidal rule `M x' + A x = 0` takes a disturbance from one step to the next by `B = (M +
//! h/2 A)^-1 (M - h/2 A)`; whatever the length h, its eigenvalues are within the unit circle
//! exactly when those of `M x' = -A x` decay. B is squared again and again. As soon as a norm of a
//! power is below 1, every disturbance dies, however it turns. As soon as the trace of one is above
//! the number of unknowns, one of its eigenvalues is above 1, and some disturbance grows.

/// The most squarings: 2^60 steps.
const SQUARINGS: usize = 60;

/// A norm beyond the transient growth of any disturbance that dies.
const BEYOND: f64 = 1e100;

/// A dense square matrix by columns.
pub(crate) struct Square {
    size: usize,
    values: Vec<f64>,
}

impl Square {
    pub(crate) fn zero(size: usize) -> Self {
        Self { size, values: vec![0.0; size * size] }
    }

    pub(crate) fn column(&self, j: usize) -> &[f64] {
        &self.values[j * self.size..(j + 1) * self.size]
    }

    pub(crate) fn column_mut(&mut self, j: usize) -> &mut [f64] {
        &mut self.values[j * self.size..(j + 1) * self.size]
    }

    fn squared(&self) -> Self {
        let mut square = Self::zero(self.size);
        for j in 0..self.size {
            let out = &mut square.values[j * self.size..(j + 1) * self.size];
            for (k, &factor) in self.column(j).iter().enumerate() {
                if factor != 0.0 {
                    out.iter_mut().zip(self.column(k)).for_each(|(out, a)| *out += factor * a);
                }
            }
        }
        square
    }

    fn norm(&self) -> f64 {
        self.values.iter().map(|a| a * a).sum::<f64>().sqrt()
    }

    fn trace(&self) -> f64 {
        (0..self.size).map(|i| self.column(i)[i]).sum()
    }

    /// Index of the largest entry that the powers of this matrix enlarge, if they enlarge anything.
    pub(crate) fn grows(mut self) -> Option<usize> {
        let mut known = false;
        for _ in 0..SQUARINGS {
            let norm = self.norm();
            known |= self.trace().abs() > self.size as f64 || norm > BEYOND;
            if known {
                return Some(self.largest());
            }
            if norm < 1.0 || norm.is_nan() {
                return None;
            }
            self = self.squared();
        }
        None
    }

    /// The row of the largest entry in the largest column.
    fn largest(&self) -> usize {
        let size = |column: &[f64]| column.iter().map(|a| a * a).sum::<f64>();
        let place = |items: &mut dyn Iterator<Item = f64>| {
            items.enumerate().max_by(|a, b| a.1.total_cmp(&b.1)).map_or(0, |(i, _)| i)
        };
        let column = place(&mut (0..self.size).map(|j| size(self.column(j))));
        place(&mut self.column(column).iter().map(|a| a.abs()))
    }

    /// The sign of the determinant: 0 if it is singular to rounding.
    pub(crate) fn sign(mut self) -> f64 {
        let mut sign = 1.0;
        for k in 0..self.size {
            let below = k..self.size;
            let Some(pivot) =
                below.max_by(|&a, &b| self.column(k)[a].abs().total_cmp(&self.column(k)[b].abs()))
            else {
                break;
            };
            let value = self.column(k)[pivot];
            if value == 0.0 {
                return 0.0;
            }
            sign *= value.signum() * if pivot == k { 1.0 } else { -1.0 };
            let factors: Vec<f64> = {
                let column = self.column_mut(k);
                column.swap(k, pivot);
                column[k + 1..].iter().map(|a| a / value).collect()
            };
            for j in k + 1..self.size {
                let column = self.column_mut(j);
                column.swap(k, pivot);
                let top = column[k];
                column[k + 1..].iter_mut().zip(&factors).for_each(|(a, factor)| *a -= factor * top);
            }
        }
        sign
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::float_cmp, reason = "numbers that are given")]

    use super::Square;

    fn matrix(rows: &[&[f64]]) -> Square {
        let mut square = Square::zero(rows.len());
        for (i, row) in rows.iter().enumerate() {
            row.iter().enumerate().for_each(|(j, a)| square.column_mut(j)[i] = *a);
        }
        square
    }

    /// A rotation by 1 rad that shrinks or grows by a part in 1e9 in each step, in skew
    /// coordinates: its norm goes up and down by a factor of 1e6 at every turn.
    #[test]
    fn a_rotation_is_judged_by_what_is_left_after_many_turns() {
        let turn = |factor: f64| {
            let (sine, cosine) = (1.0_f64.sin() * factor, 1.0_f64.cos() * factor);
            matrix(&[&[cosine, -1e3 * sine], &[1e-3 * sine, cosine]])
        };
        assert_eq!(turn(1.0 - 1e-9).grows(), None);
        assert_eq!(turn(1.0 + 1e-9).grows(), Some(0));
    }

    /// A triangle with eigenvalues of 0.9 first enlarges some disturbances by 9e5.
    #[test]
    fn what_grows_at_first_and_dies_later_is_stable() {
        assert_eq!(matrix(&[&[0.9, 1e6], &[0.0, 0.9]]).grows(), None);
        assert_eq!(matrix(&[&[1.001, 1e6], &[0.0, 0.9]]).grows(), Some(0));
    }

    #[test]
    fn a_matrix_is_squared_column_by_column() {
        let square = matrix(&[&[1.0, 2.0, 0.0], &[3.0, -4.0, 5.0], &[0.5, 0.0, -2.0]]).squared();
        let exact = matrix(&[&[7.0, -6.0, 10.0], &[-6.5, 22.0, -30.0], &[-0.5, 1.0, 4.0]]);
        assert_eq!(square.values, exact.values);
        assert!((square.trace() - 33.0).abs() < 1e-12);
        assert!((matrix(&[&[3.0, 0.0], &[0.0, -4.0]]).norm() - 5.0).abs() < 1e-12);
    }

    /// By its trace above the number of unknowns, and by its norm if the trace is 0.
    #[test]
    fn what_grows_moves_the_place_that_moves_most() {
        let turns = |a: f64, b: f64| matrix(&[&[0.1, 0.0, 0.0], &[0.0, 0.2, a], &[0.0, -b, 0.2]]);
        assert_eq!((turns(8.0, 9.0).grows(), turns(9.0, 8.0).grows()), (Some(1), Some(2)));
        assert_eq!(matrix(&[&[1.5, 0.0], &[0.0, -1.6]]).grows(), Some(1));
        assert_eq!(matrix(&[&[0.0, 1e101], &[0.0, 0.0]]).grows(), Some(0));
        assert_eq!(matrix(&[&[0.0, 0.0], &[-3e101, 0.0]]).grows(), Some(1));
        assert_eq!(matrix(&[&[f64::NAN]]).grows(), None);
        // a matrix that neither grows nor dies does not grow
        assert_eq!(matrix(&[&[1.0, 0.0], &[0.0, 1.0]]).grows(), None);
        assert_eq!(matrix(&[&[0.0, 1.0], &[1.0, 0.0]]).grows(), None);
    }

    #[test]
    fn determinants_have_their_sign() {
        for (rows, sign) in [
            ([[2.0, 1.0], [1.0, 2.0]], 1.0),
            ([[0.0, 1.0], [1.0, 0.0]], -1.0),
            ([[1.0, 2.0], [2.0, 1.0]], -1.0),
            ([[1.0, 2.0], [2.0, 4.0]], 0.0),
        ] {
            let rows: Vec<&[f64]> = rows.iter().map(|row| &row[..]).collect();
            assert!((matrix(&rows).sign() - sign).abs() < 0.5, "{rows:?}");
        }
        let sign = |rows: [[f64; 3]; 3]| matrix(&rows.each_ref().map(|row| &row[..])).sign();
        let third: [[f64; 3]; 3] = [[0.0, 2.0, 1.0], [4.0, -1.0, 3.0], [-2.0, 5.0, 7.0]];
        let [a, b, c] = third;
        let exact = a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
            + a[2] * (b[0] * c[1] - b[1] * c[0]);
        assert!((sign(third) - exact.signum()).abs() < 0.5);
        let turned = third.map(|row| row.map(|a| -a));
        assert!((sign(turned) + exact.signum()).abs() < 0.5);
        assert!((sign([a, c, b]) + exact.signum()).abs() < 0.5);
        // two large ones before a small one of the other sign
        assert!((sign([[3.0, 0.0, 0.0], [0.0, 5.0, 1.0], [0.0, 5.0, 0.9]]) + 1.0).abs() < 0.5);
        assert!((sign([[3.0, 1.0, 0.0], [3.0, 1.1, 0.0], [0.0, 0.0, -4.0]]) + 1.0).abs() < 0.5);
    }
}
