//! Student's distribution, and how even a histogram is.

/// The probability that Student's t with so many degrees of freedom is below `t`: by the
/// continued fraction of the incomplete beta function (M. Abramowitz, I. A. Stegun, Handbook of
/// Mathematical Functions, 26.5.8 and 26.7.1).
pub(crate) fn below(t: f64, degrees: f64) -> f64 {
    if degrees > 1e6 {
        return 0.5 * libm::erfc(-t * std::f64::consts::FRAC_1_SQRT_2);
    }
    let tail = 0.5 * beta(degrees / (degrees + t * t), 0.5 * degrees, 0.5);
    if t > 0.0 { 1.0 - tail } else { tail }
}

fn beta(x: f64, a: f64, b: f64) -> f64 {
    if x > (a + 1.0) / (a + b + 2.0) {
        return 1.0 - beta(1.0 - x, b, a);
    }
    let front = libm::lgamma(a + b) - libm::lgamma(a) - libm::lgamma(b);
    let front = (front + a * x.ln() + b * (1.0 - x).ln()).exp() / a;
    // Lentz's method
    let (mut c, mut d) = (1.0, 1.0 / (1.0 - (a + b) * x / (a + 1.0)));
    let mut fraction = d;
    for m in 1..200 {
        let m = f64::from(m);
        let even = m * (b - m) * x / ((a + 2.0 * m - 1.0) * (a + 2.0 * m));
        let odd = -(a + m) * (a + b + m) * x / ((a + 2.0 * m) * (a + 2.0 * m + 1.0));
        for part in [even, odd] {
            d = 1.0 / (1.0 + part * d);
            c = 1.0 + part / c;
            fraction *= c * d;
        }
    }
    front * fraction
}

/// Pearson's chi-square of ranks in 0..1 over 20 bins that are equally likely: 19 degrees of
/// freedom. Beyond [`ONE_PERCENT`] p is below 0.01.
pub(crate) fn unevenness(ranks: &[f64]) -> f64 {
    let mut bins = [0_u32; 20];
    for rank in ranks {
        let bin = (0..20).take_while(|&k| f64::from(k) / 20.0 <= *rank).count();
        bins[bin.max(1) - 1] += 1;
    }
    let expected = ranks.len() as f64 / 20.0;
    bins.iter().map(|&n| (f64::from(n) - expected).powi(2) / expected).sum()
}

/// SciPy 1.17.1: `stats.chi2.ppf(0.99, 19)`.
pub(crate) const ONE_PERCENT: f64 = 36.190_869_129_270_05;
