//! Quantiles of Student's t and of chi-square.

use std::f64::consts::{FRAC_1_SQRT_2, FRAC_2_SQRT_PI};

use super::NORMAL_95;

/// The t that a variable of Student's distribution exceeds in size with probability 5 %: 1.96 for
/// many degrees of freedom, 12.7 for one, the fewest. Relative error 1e-4 from two degrees on;
/// below, between the two exact values.
///
/// G. W. Hill, Algorithm 396, Communications of the ACM 13 (1970) 619.
pub fn student_95(degrees: f64) -> f64 {
    const ONE: f64 = 12.706_204_736_174_698;
    const TWO: f64 = 4.302_652_729_749_464;
    let n = degrees.max(1.0);
    if n <= 2.0 {
        return (ONE.ln() + (n - 1.0) * (TWO / ONE).ln()).exp();
    }
    if n.is_infinite() {
        return NORMAL_95;
    }
    let a = 1.0 / (n - 0.5);
    let b = 48.0 / (a * a);
    let mut c = ((20700.0 * a / b - 98.0) * a - 16.0) * a + 96.36;
    let d = ((94.5 / (b + c) - 3.0) / b + 1.0) * (a * std::f64::consts::FRAC_PI_2).sqrt() * n;
    let mut y = (0.05 * d).powf(2.0 / n);
    if y > 0.05 + a {
        let x = -NORMAL_95;
        y = x * x;
        if n < 5.0 {
            c += 0.3 * (n - 4.5) * (x + 0.6);
        }
        c += (((0.05 * d * x - 5.0) * x - 7.0) * x - 2.0) * x + b;
        y = (((((0.4 * y + 6.3) * y + 36.0) * y + 94.5) / c - y - 3.0) / b + 1.0) * x;
        y = (a * y * y).exp_m1();
    } else {
        let inner = ((n + 6.0) / (n * y) - 0.089 * d - 0.822) * (n + 2.0) * 3.0;
        y = ((1.0 / inner + 0.5 / (n + 4.0)) * y - 1.0) * (n + 1.0) / (n + 2.0) + 1.0 / y;
    }
    (n * y).sqrt()
}

/// The value that chi-square with this number of degrees of freedom exceeds with a probability of
/// 0.1 %; relative error 3 % (E. B. Wilson, M. M. Hilferty, Proc. Natl. Acad. Sci. 17 (1931) 684).
pub fn chi_square_999(degrees: f64) -> f64 {
    const NORMAL_999: f64 = 3.090_232_306_167_813;
    let part = 2.0 / (9.0 * degrees);
    degrees * (1.0 - part + NORMAL_999 * part.sqrt()).powi(3)
}

/// Steps of Newton's method; some ten are usual.
const MOST_STEPS: usize = 200;

/// The size that a variable exceeds with probability 5 %. It is normal with one of these standard
/// deviations, each after its probability.
///
/// The probability beyond a size is convex: Newton's method, from 0, comes from below and never
/// passes the result.
pub fn mixed_95(parts: &[(f64, f64)]) -> f64 {
    let wide: Vec<(f64, f64)> = parts.iter().copied().filter(|part| part.1 > 0.0).collect();
    let mut size = 0.0;
    for _ in 0..MOST_STEPS {
        let (excess, slope) = tail(&wide, size);
        let step = excess / slope;
        if step.is_nan() || step <= f64::EPSILON * size {
            break;
        }
        size += step;
    }
    size
}

/// The probability beyond a size less 5 %, and how fast it falls with the size.
fn tail(parts: &[(f64, f64)], size: f64) -> (f64, f64) {
    let (mut beyond, mut slope) = (-0.05, 0.0);
    for (weight, deviation) in parts {
        let x = size / deviation * FRAC_1_SQRT_2;
        beyond += weight * libm::erfc(x);
        slope += weight * (-x * x).exp() * FRAC_2_SQRT_PI * FRAC_1_SQRT_2 / deviation;
    }
    (beyond, slope)
}

/// The degrees of freedom for which Student's t exceeds `t` in size with probability 5 %: 1 for
/// 12.7 and more, infinite for 1.96 and less.
pub fn degrees_of(t: f64) -> f64 {
    if t <= NORMAL_95 {
        return f64::INFINITY;
    }
    let (mut low, mut high): (f64, f64) = (0.0, 20.0);
    for _ in 0..50 {
        let middle = 0.5 * (low + high);
        if student_95(middle.exp()) > t {
            low = middle;
        } else {
            high = middle;
        }
    }
    (0.5 * (low + high)).exp()
}

#[cfg(test)]
mod tests {
    use super::{chi_square_999, degrees_of, mixed_95};

    /// Tables of chi-square at 0.1 %: 10.828, 13.816, 29.588.
    #[test]
    fn reference_chi_square_is_that_of_tables() {
        for (degrees, expected) in [(1.0, 10.828), (2.0, 13.816), (10.0, 29.588)] {
            let found = chi_square_999(degrees);
            assert!((found - expected).abs() < 0.035 * expected, "{found} {expected}");
        }
    }

    /// The mixture by bisection on the `erfc` of Python, the quantile of t from tables.
    #[test]
    fn quantiles_are_those_of_tables() {
        let near = |found: f64, expected: f64| {
            assert!((found / expected - 1.0).abs() < 1e-3, "{found} is not {expected}");
        };
        near(mixed_95(&[(1.0, 2.0)]), 3.919_928);
        near(mixed_95(&[(0.8, 1.0), (0.2, 5.0)]), MIXED);
        // the far part alone: erfc(x / (1e6 sqrt(2))) = 0.05 / 0.1, the quantile of 75 %
        near(mixed_95(&[(0.9, 1.0), (0.1, 1e6)]), 674_489.750);
        near(mixed_95(&[(0.9, 0.0), (0.1, 1e6)]), 674_489.750);
        assert_eq!(mixed_95(&[(0.96, 0.0), (0.04, 3.0)]).to_bits(), 0);
        assert_eq!(mixed_95(&[(1.0, 0.0)]).to_bits(), 0);
        near(degrees_of(2.228_139), 10.0);
        assert!(degrees_of(1.9).is_infinite());
    }

    const MIXED: f64 = 5.751_747;
}
