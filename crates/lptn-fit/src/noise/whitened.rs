//! A record as independent values of unit variance.

use lptn_integrate::vectors::take_off;

use super::likelihood::{Gains, Shape, orthonormal};
use super::{Noise, local, stretches};

/// The noise of a record is `L n`, with independent n of unit variance and the lower triangular
/// root L of its covariance: n of the residuals, and its effect on a fit.
#[derive(Clone, Debug)]
pub(crate) struct Whitened {
    /// The times of the means in s.
    pub(crate) times: Vec<f64>,
    /// `L^-1` times the residuals, less the part that the fitted parameters could absorb: the
    /// actual n, up to a factor.
    pub(crate) residuals: Vec<f64>,
    /// `L^T` times the derivatives, for each parameter in turn: the contribution of each n to `J^T
    /// r`. The products of two are those of [`Middle`](super::Middle).
    pub(crate) loads: Vec<Vec<f64>>,
}

impl Noise {
    /// Whitens the residuals and derivatives from which the noise was estimated.
    pub(crate) fn whitened(
        &self,
        times: &[f64],
        (residuals, jacobian): (&[f64], &[f64]),
    ) -> Whitened {
        let even = |values: &[f64]| local::even(&self.strengths, values).into_owned();
        let means =
            |columns: &[f64]| stretches::means_of_columns(columns, times.len(), self.stretch);
        let residuals = means(&even(residuals));
        let slopes = means(&even(jacobian));
        let felt = means(&local::uneven(&self.strengths, jacobian));
        let times = stretches::means(times, self.stretch);
        let shape = Shape { correlated: self.means.correlated, time: self.means.time };
        let gains = Gains::new(&times, shape);
        let count = times.len().max(1);
        let white: Vec<f64> =
            slopes.chunks(count).flat_map(|slope| filtered(&gains, slope)).collect();
        let mut residuals = filtered(&gains, &residuals);
        take_off(&mut residuals, &orthonormal(&white, count));
        let scale = self.means.deviation * self.stretch as f64;
        let load = |slope: &[f64]| turned(&gains, slope).into_iter().map(|x| x * scale).collect();
        Whitened { residuals, loads: felt.chunks(count).map(load).collect(), times }
    }
}

/// `L^-1` times a column: each value less its prediction by those before, over the deviation of
/// that.
fn filtered(gains: &Gains, column: &[f64]) -> Vec<f64> {
    let mut state = 0.0;
    let one = |(&value, &[decay, gain, weight]): (&f64, &[f64; 3])| {
        let predicted = decay * state;
        state = predicted + gain * (value - predicted);
        (value - predicted) * weight
    };
    column.iter().zip(&gains.steps).map(one).collect()
}

/// `L^T` times a column: the filter's adjoint, from the last value to the first.
fn turned(gains: &Gains, column: &[f64]) -> Vec<f64> {
    let mut ahead = 0.0;
    let mut all: Vec<f64> = Vec::with_capacity(column.len());
    for (&value, &[decay, gain, weight]) in column.iter().zip(&gains.steps).rev() {
        all.push((value + gain * ahead) / weight);
        ahead = decay * (value + ahead);
    }
    all.reverse();
    all
}

#[cfg(test)]
mod tests {
    use super::{Gains, Shape, filtered, turned};
    use crate::noise::middle::product;

    /// `(L^T J)^T (L^T J) = J^T V J`, whose V is written out, and `L^-1` undoes L.
    #[test]
    fn loads_are_a_root_of_what_the_sandwich_holds() {
        let times = [0.0, 1.0, 2.0, 3.5, 3.9, 7.0];
        let jacobian = [1.0, -2.0, 0.5, 3.0, 0.1, 1.0, 0.3, 0.2, -1.0, 0.0, 2.0, 1.5];
        let shape = Shape { correlated: 0.7, time: 2.0 };
        let gains = Gains::new(&times, shape);
        let loads: Vec<Vec<f64>> = jacobian.chunks(6).map(|j| turned(&gains, j)).collect();
        let covariance = |i: usize, j: usize| {
            let apart = f64::abs(times[i] - times[j]);
            if i == j { 1.0 } else { 0.7 * f64::exp(-apart / 2.0) }
        };
        let known = product(&times, &jacobian, shape);
        for (at, (a, b)) in [(0, 0), (0, 1), (1, 0), (1, 1)].into_iter().enumerate() {
            let dot: f64 = loads[a].iter().zip(&loads[b]).map(|(x, y)| x * y).sum();
            let mut written = 0.0;
            for i in 0..6 {
                let row: f64 = (0..6).map(|j| covariance(i, j) * jacobian[b * 6 + j]).sum();
                written += jacobian[a * 6 + i] * row;
            }
            assert!((dot - written).abs() < 1e-12 * written.abs().max(1.0), "{dot} {written}");
            assert!((known[at] - written).abs() < 1e-12 * written.abs().max(1.0));
        }
        let white = filtered(&gains, &jacobian[..6]);
        let back: f64 = white.iter().zip(&loads[1]).map(|(x, y)| x * y).sum();
        let direct: f64 = jacobian[..6].iter().zip(&jacobian[6..]).map(|(x, y)| x * y).sum();
        assert!((back - direct).abs() < 1e-12);
    }
}
