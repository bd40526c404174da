//! Inputs as Legendre series on a panel, and the response of a mode to them in closed form.
//!
//! A mode of rate `r` responds to `u = sum c_n P_n(x)`, x from -1 to 1 over a panel of length h,
//! with `int exp(-r (h - s)) u(s) ds = h sum c_n w_n(r h / 2)`, where `w_n(a) = exp(-a) i_n(a)` and
//! i_n is the modified spherical Bessel function of the first kind: from
//! `2 i_n(a) = int exp(a x) P_n(x) dx` over (-1, 1) (Abramowitz and Stegun, Handbook of
//! Mathematical Functions, 10.2.36, DLMF 10.60.8, with the orthogonality of P_n). The kernel is
//! integrated exactly, so a panel may be as long as the input is smooth, however fast the mode.

/// Points of the Gauss-Legendre rule and terms of the series.
pub(crate) const TERMS: usize = 16;

/// The Gauss-Legendre rule with [`TERMS`] points.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Rule {
    pub(crate) points: [f64; TERMS],
    weights: [f64; TERMS],
}

impl Rule {
    /// Zeros of P_n by Newton's method and weights `2 / ((1 - x^2) P_n'(x)^2)` (Abramowitz and
    /// Stegun 25.4.29).
    pub(crate) fn new() -> Self {
        let mut rule = Self { points: [0.0; TERMS], weights: [0.0; TERMS] };
        for k in 0..TERMS {
            let mut x = -(std::f64::consts::PI * (k as f64 + 0.75) / (TERMS as f64 + 0.5)).cos();
            let mut slope = 1.0;
            for _ in 0..10 {
                let p = polynomials::<{ TERMS + 1 }>(x);
                slope = TERMS as f64 * (x * p[TERMS] - p[TERMS - 1]) / (x * x - 1.0);
                x -= p[TERMS] / slope;
            }
            rule.points[k] = x;
            rule.weights[k] = 2.0 / ((1.0 - x * x) * slope * slope);
        }
        rule
    }

    /// Coefficients of the series through the values at the points.
    pub(crate) fn series(&self, values: &[f64; TERMS]) -> [f64; TERMS] {
        let mut series = [0.0; TERMS];
        for ((&x, weight), value) in self.points.iter().zip(&self.weights).zip(values) {
            for (n, p) in polynomials::<TERMS>(x).iter().enumerate() {
                series[n] += (n as f64 + 0.5) * weight * p * value;
            }
        }
        series
    }
}

/// `P_0(x) …`
fn polynomials<const N: usize>(x: f64) -> [f64; N] {
    let mut p = [1.0; N];
    p[1] = x;
    for n in 2..N {
        let m = n as f64;
        p[n] = ((2.0 * m - 1.0) * x * p[n - 1] - (m - 1.0) * p[n - 2]) / m;
    }
    p
}

/// The series at `x`.
pub(crate) fn value(series: &[f64], x: f64) -> f64 {
    polynomials::<TERMS>(x).iter().zip(series).map(|(p, c)| p * c).sum()
}

/// Above this the recurrence for [`responses`] is run upwards: it loses at most `exp(n^2 / a)`,
/// less than two digits.
const LARGE: f64 = 60.0;

/// Terms above [`TERMS`] at which the downward recurrence starts: the error at the start has
/// decayed by `exp(-n^2 / a)`, 1e-40 at [`LARGE`].
const MARGIN: usize = 60;

/// `w_n(a) = exp(-a) i_n(a)` for n below the length of `out`, a >= 0.
pub(crate) fn responses(a: f64, out: &mut [f64]) {
    let first = if a > 0.0 { -(-2.0 * a).exp_m1() / (2.0 * a) } else { 1.0 };
    out.fill(0.0);
    out[0] = first;
    if out.len() == 1 || a == 0.0 {
        return;
    }
    if a > LARGE {
        out[1] = (0.5 + 0.5 * (-2.0 * a).exp() - first) / a;
        for n in 1..out.len() - 1 {
            out[n + 1] = out[n - 1] - (2.0 * n as f64 + 1.0) / a * out[n];
        }
        return;
    }
    // ratios i_n / i_(n-1), downwards: they cannot overflow (Gautschi, SIAM Review 9 (1967) 24)
    let mut ratio = 0.0;
    for n in (1..out.len() + MARGIN).rev() {
        ratio = a / (2.0 * n as f64 + 1.0 + a * ratio);
        if n < out.len() {
            out[n] = ratio;
        }
    }
    for n in 1..out.len() {
        out[n] *= out[n - 1];
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rule_is_the_published_one() {
        // Abramowitz and Stegun, table 25.4, n = 16: first and last positive abscissa and their
        // weights
        let rule = Rule::new();
        assert!((rule.points[8] - 0.095_012_509_837_637_44).abs() < 1e-15);
        assert!((rule.weights[8] - 0.189_450_610_455_068_5).abs() < 1e-14);
        assert!((rule.points[15] - 0.989_400_934_991_649_9).abs() < 1e-15);
        assert!((rule.weights[15] - 0.027_152_459_411_754_1).abs() < 1e-14);
    }

    #[test]
    fn a_polynomial_is_its_own_series() {
        let rule = Rule::new();
        let cubic = |x: f64| 2.0 - x + 0.5 * x * x * x; // x^3 = (3 P_1 + 2 P_3) / 5
        let series = rule.series(&rule.points.map(cubic));
        for (n, expected) in [(0, 2.0), (1, -0.7), (2, 0.0), (3, 0.2), (4, 0.0)] {
            assert!((series[n] - expected).abs() < 1e-14, "{series:?}");
        }
        assert!((value(&series, 0.3) - cubic(0.3)).abs() < 1e-14);
    }

    #[test]
    fn responses_are_those_of_mpmath() {
        // exp(-a) sqrt(pi / 2a) I_(n+1/2)(a) by mpmath 1.3 with 60 digits, n = 0, 1, 5, 15
        for (a, expected) in EXPECTED {
            let mut out = [0.0; TERMS];
            responses(a, &mut out);
            for (n, expected) in [0, 1, 5, 15].into_iter().zip(expected) {
                assert!(
                    (out[n] - expected).abs() <= 2e-14 * expected.abs() + 1e-300,
                    "{a} {n}: {}",
                    out[n]
                );
            }
        }
    }

    #[test]
    fn a_mode_without_rate_adds_up_its_heat() {
        let mut out = [1.0; 4];
        responses(0.0, &mut out);
        assert_eq!(out.map(f64::to_bits), [1.0_f64, 0.0, 0.0, 0.0].map(f64::to_bits));
    }

    const EXPECTED: [(f64, [f64; 4]); 8] = [
        (25.0, [0.02, 0.0192, 0.010_868_848_64, 0.000_173_839_083_213_244_25]),
        (
            1e-6,
            [
                0.999_999_000_000_666_7,
                3.333_330_000_001_999_6e-7,
                9.620_000_000_005_178e-35,
                5.211_075_231_179_55e-108,
            ],
        ),
        (
            0.3,
            [
                0.751_980_606_509_955_9,
                0.074_750_705_123_524_23,
                1.737_786_486_384_45e-7,
                5.546_901_453_139_527e-26,
            ],
        ),
        (
            5.0,
            [
                0.099_995_460_007_023_75,
                0.080_005_447_991_571_5,
                0.005_020_719_682_061_537,
                1.558_753_502_621_037_7e-9,
            ],
        ),
        (
            59.0,
            [
                0.008_474_576_271_186_44,
                0.008_330_939_385_234_128,
                0.006_558_967_149_507_145,
                0.001_102_613_038_734_145_3,
            ],
        ),
        (
            61.0,
            [
                0.008_196_721_311_475_41,
                0.008_062_348_830_959_42,
                0.006_397_814_254_810_903,
                0.001_139_992_809_418_305_4,
            ],
        ),
        (1000.0, [5.0e-4, 4.995e-4, 0.000_492_552_290_472_027_4, 0.000_443_434_652_264_131_25]),
        (1e8, [5.0e-9, 4.99999995e-9, 4.999_999_250_000_053e-9, 4.999_994_000_003_57e-9]),
    ];
}
