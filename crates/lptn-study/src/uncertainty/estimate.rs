//! Numbers that were computed from samples, with their own error.

use lptn_units::statistics;

/// A number, and one standard error of it if it comes from samples.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// The number, from all samples.
    pub value: f64,
    /// One standard error; `None` for a number that is not sampled.
    pub error: Option<f64>,
}

impl Estimate {
    /// A number without an error of sampling.
    pub fn exact(value: f64) -> Self {
        Self { value, error: None }
    }

    /// `of(None)` of all samples, with the error that leaving out one independent group after the
    /// other shows, `of(Some(g))` (delete-a-group jackknife: J. Shao and C. F. J. Wu, Ann. Statist.
    /// 17 (1989) 1176; right for quantiles too, since whole groups are left out).
    pub(crate) fn jackknife(groups: usize, of: impl Fn(Option<usize>) -> f64) -> Self {
        let parts: Vec<f64> = (0..groups).map(|group| of(Some(group))).collect();
        Self { value: of(None), error: Some(statistics::jackknife(&parts)) }
    }
}

/// Mean and standard deviation of a sample; the deviation with the divisor n - 1, zero for fewer
/// than two numbers.
pub(crate) fn moments(values: &[f64]) -> (f64, f64) {
    let free = (values.len() as f64 - 1.0).max(1.0);
    (statistics::mean(values), (statistics::squares_about_mean(values) / free).sqrt())
}

/// The quantile of an ascending sample: linear between its order statistics, of which the first is
/// at 0 and the last at 1 (type 7 of R. J. Hyndman and Y. Fan, Am. Stat. 50 (1996) 361). NaN
/// without a sample.
pub(crate) fn quantile(ascending: &[f64], share: f64) -> f64 {
    let Some(last) = ascending.len().checked_sub(1) else { return f64::NAN };
    let place = share * last as f64;
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "between 0 and the length"
    )]
    let below = (place.floor() as usize).min(last);
    let (low, high) = (ascending[below], ascending[(below + 1).min(last)]);
    low + (place - below as f64) * (high - low)
}

#[cfg(test)]
mod tests {
    use super::{Estimate, moments, quantile};

    /// `numpy.quantile([1, 2, 4, 8], q)` and `numpy.std(…, ddof=1)`, NumPy 2.4.6.
    #[test]
    fn quantiles_and_deviations_are_those_of_numpy() {
        let sample = [1.0, 2.0, 4.0, 8.0];
        for (share, value) in [(0.0, 1.0), (0.025, 1.075), (0.5, 3.0), (0.975, 7.7), (1.0, 8.0)] {
            assert!((quantile(&sample, share) - value).abs() < 1e-12, "{share}");
        }
        assert!((moments(&sample).1 - 3.095_695_936_834_452).abs() < 1e-15);
        assert!(quantile(&[], 0.5).is_nan());
    }

    /// The jackknife of a mean is the usual standard error of the groups' means: here of 1, 2, 4
    /// and 8.
    #[test]
    fn the_jackknife_of_a_mean_is_its_standard_error() {
        let groups = [1.0, 2.0, 4.0, 8.0];
        let mean = |left_out: Option<usize>| {
            let kept: Vec<f64> =
                (0..4).filter(|g| Some(*g) != left_out).map(|g| groups[g]).collect();
            kept.iter().sum::<f64>() / kept.len() as f64
        };
        let estimate = Estimate::jackknife(4, mean);
        assert!((estimate.value - 3.75).abs() < 1e-15);
        assert!((estimate.error.unwrap() - 3.095_695_936_834_452 / 2.0).abs() < 1e-15);
    }
}
