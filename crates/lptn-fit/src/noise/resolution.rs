//! The step of an instrument's numbers.

/// The largest step of which all differences of the values are multiples, in their unit: 0.1 K for
/// a logger that prints one decimal. `None` if there is none above 1e-7 of the largest value, or if
/// fewer than three values differ.
pub fn resolution(values: &[f64]) -> Option<f64> {
    let mut sorted: Vec<f64> = values.iter().copied().filter(|v| v.is_finite()).collect();
    sorted.sort_by(f64::total_cmp);
    let largest = sorted.last()?.abs().max(sorted[0].abs());
    let rounding = 1e-10 * largest;
    let mut step = 0.0;
    let mut steps = 0;
    for pair in sorted.windows(2) {
        let apart = pair[1] - pair[0];
        if apart > rounding {
            steps += 1;
            step = common(apart, step, 100.0 * rounding);
            if step <= 1e-7 * largest {
                return None;
            }
        }
    }
    // the mean over the whole range is better than one difference
    let range = sorted[sorted.len() - 1] - sorted[0];
    (steps >= 2 && step > 0.0).then(|| range / (range / step).round())
}

/// The greatest common divisor of two lengths that are known to `rounding` (Euclid).
fn common(mut a: f64, mut b: f64, rounding: f64) -> f64 {
    while b > rounding {
        let rest = a - b * (a / b).round();
        (a, b) = (b, rest.abs());
    }
    a
}
