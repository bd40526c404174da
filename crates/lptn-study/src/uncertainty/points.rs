//! Points of a standard normal distribution in many dimensions.

use lptn_units::statistics::quantile;

/// Dimensions that the directions of the sequence are known for.
pub(crate) const MOST_DIMENSIONS: usize = sobol_burley::NUM_DIMENSIONS as usize;

/// The least number of samples.
pub(crate) const LEAST: usize = 64;

/// The longest sequence.
pub(crate) const MOST_POINTS: usize = 1 << 16;

/// One coordinate of one point of an Owen-scrambled Sobol sequence, between 0 and 1: the crate's
/// numbers are multiples of 2^-24 from 0, and the middle of each cell is taken.
pub(crate) fn uniform(index: usize, dimension: usize, seed: u32) -> f64 {
    const HALF_CELL: f64 = 1.0 / (1_u64 << 25) as f64;
    #[expect(clippy::cast_possible_truncation, reason = "both are below 2^16")]
    let uniform = sobol_burley::sample(index as u32, dimension as u32, seed);
    f64::from(uniform) + HALF_CELL
}

/// The same as a normal number: nothing lies beyond 5.5 standard deviations.
pub(crate) fn normal(index: usize, dimension: usize, seed: u32) -> f64 {
    quantile(uniform(index, dimension, seed))
}

#[cfg(test)]
mod tests {
    use super::normal;

    /// Sixteen points of a scrambled sequence have one in each sixteenth of every dimension: a
    /// property of every (0, 4, 1) net.
    #[test]
    fn every_dimension_is_filled_evenly() {
        for seed in [0, 1, 77] {
            for dimension in 0..40 {
                let mut numbers: Vec<f64> =
                    (0..16).map(|index| normal(index, dimension, seed)).collect();
                numbers.sort_by(f64::total_cmp);
                for (i, z) in numbers.iter().enumerate() {
                    let share = lptn_units::statistics::share_below(*z) * 16.0;
                    assert!(
                        (i as f64..=i as f64 + 1.0).contains(&share),
                        "{seed} {dimension} {i}: {share}"
                    );
                }
            }
        }
    }
}
