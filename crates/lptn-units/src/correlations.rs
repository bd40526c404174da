//! Correlations between values.

use std::f64::consts::PI;

use crate::spread::Distribution;

/// The correlations of several values, by default 0.
#[derive(Clone, Debug, PartialEq)]
pub struct Correlations {
    count: usize,
    /// Row by row.
    values: Vec<f64>,
}

/// A pivot of a correlation matrix that is less than this is rounding.
const ROUNDING: f64 = 1e-13;

impl Correlations {
    /// No correlations between `count` values.
    pub fn none(count: usize) -> Self {
        let value = |at: usize| f64::from(u8::from(at / count.max(1) == at % count.max(1)));
        Self { count, values: (0..count * count).map(value).collect() }
    }

    /// Number of values.
    pub fn count(&self) -> usize {
        self.count
    }

    /// The correlation of values `i` and `j`.
    pub fn between(&self, i: usize, j: usize) -> f64 {
        self.values[i * self.count + j]
    }

    /// Sets the correlation of values `i` and `j`; no effect if they are the same.
    pub fn set(&mut self, i: usize, j: usize, value: f64) {
        if i != j {
            self.values[i * self.count + j] = value;
            self.values[j * self.count + i] = value;
        }
    }

    /// True if two of them are correlated.
    pub fn any(&self) -> bool {
        (0..self.count).any(|i| self.tied(i))
    }

    /// True if value `i` is correlated with another.
    pub fn tied(&self, i: usize) -> bool {
        (0..self.count).any(|j| j != i && self.between(i, j).abs() > 0.0)
    }

    /// The correlations of normal numbers of which these values are functions, each rising with its
    /// own (A. Der Kiureghian, P.-L. Liu, J. Eng. Mech. 112 (1986) 85). For a lognormal value it is
    /// the correlation of its logarithm, which is normal. For two rectangles it is
    /// `2 sin(pi r / 6)`, for a rectangle and a normal value `r sqrt(pi / 3)`.
    #[must_use]
    pub fn of_scores(&self, distributions: &[Distribution]) -> Self {
        let mut scores = self.clone();
        let is_rectangle = |i: usize| distributions[i] == Distribution::Rectangle;
        for i in 0..self.count {
            for j in 0..i {
                let r = self.between(i, j);
                scores.set(
                    i,
                    j,
                    match (is_rectangle(i), is_rectangle(j)) {
                        (true, true) => 2.0 * (PI * r / 6.0).sin(),
                        (false, false) => r,
                        _ => r * (PI / 3.0).sqrt(),
                    },
                );
            }
        }
        scores
    }

    /// The lower triangle L with `L L^T` equal to these correlations, row by row (A.-L. Cholesky);
    /// plain sums, the same on every processor.
    ///
    /// # Errors
    /// The place of the first value that the values before it determine completely: such
    /// correlations are impossible.
    pub fn factor(&self) -> Result<Vec<f64>, usize> {
        let n = self.count;
        let mut l = vec![0.0; n * n];
        for i in 0..n {
            for j in 0..=i {
                let known: f64 = (0..j).map(|k| l[i * n + k] * l[j * n + k]).sum();
                let left = self.between(i, j) - known;
                if i != j {
                    l[i * n + j] = left / l[j * n + j];
                } else if left > ROUNDING {
                    l[i * n + i] = left.sqrt();
                } else {
                    return Err(i);
                }
            }
        }
        Ok(l)
    }
}

#[cfg(test)]
mod tests {
    use super::Correlations;
    use crate::spread::Distribution::{Lognormal, Normal, Rectangle};

    fn three(a: f64, b: f64, c: f64) -> Correlations {
        let mut all = Correlations::none(3);
        all.set(1, 0, a);
        all.set(0, 2, b);
        all.set(2, 1, c);
        all
    }

    /// `numpy.linalg.cholesky([[1, .5, -.2], [.5, 1, .3], [-.2, .3, 1]])`, NumPy 1.24.2.
    #[test]
    fn the_factor_is_that_of_numpy() {
        let factor = three(0.5, -0.2, 0.3).factor().unwrap();
        let rows = [
            [1.0, 0.0, 0.0],
            [0.5, 0.866_025_403_784_438_6, 0.0],
            [-0.2, 0.461_880_215_351_700_6, 0.864_098_759_787_714_7],
        ];
        for (found, wanted) in factor.iter().zip(rows.concat()) {
            assert!((found - wanted).abs() < 1e-15, "{found} {wanted}");
        }
        assert_eq!(three(0.9, 0.9, -0.9).factor(), Err(2));
        assert_eq!(Correlations::none(2).factor().unwrap(), [1.0, 0.0, 0.0, 1.0]);
    }

    /// The scores of two rectangles with the correlation 0.5: 2 sin(pi / 12); of a rectangle and a
    /// normal value with 0.3: 0.3 sqrt(pi / 3).
    #[test]
    fn rectangles_are_functions_of_normal_numbers() {
        let scores = three(0.5, 0.3, -0.4).of_scores(&[Rectangle, Rectangle, Normal]);
        assert!((scores.between(0, 1) - 0.517_638_090_205_041_5).abs() < 1e-15);
        assert!((scores.between(0, 2) - 0.306_998_012_383_946_5).abs() < 1e-15);
        let scores = three(0.5, 0.3, -0.4).of_scores(&[Lognormal, Normal, Normal]);
        assert_eq!(scores, three(0.5, 0.3, -0.4));
    }
}
