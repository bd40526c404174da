//! Probability of a result by chance alone.

/// The probability that Student's t with this number of degrees of freedom (at least 1; infinite: a
/// standard normal variable) is further from 0 than `z`.
///
/// M. Abramowitz, I. A. Stegun, Handbook of Mathematical Functions, 26.7.1 and 26.5.2.
pub fn two_sided(z: f64, degrees_of_freedom: f64) -> f64 {
    if degrees_of_freedom.is_infinite() {
        return libm::erfc(z.abs() * std::f64::consts::FRAC_1_SQRT_2);
    }
    let degrees = degrees_of_freedom.max(1.0);
    // 1 / (1 + z^2 / degrees), without overflow of z^2
    let x = (1.0 + z * (z / degrees)).recip();
    if x > (0.5 * degrees + 1.0) / (0.5 * degrees + 2.5) {
        1.0 - beta((1.0 - x, x), 0.5, 0.5 * degrees)
    } else {
        beta((x, 1.0 - x), 0.5 * degrees, 0.5)
    }
}

/// The incomplete beta function at `x`, which `rest` makes 1, below `(a + 1) / (a + b + 2)`: by its
/// continued fraction (ibidem, 26.5.8).
fn beta((x, rest): (f64, f64), a: f64, b: f64) -> f64 {
    const TERMS: u32 = 200;
    if x <= 0.0 {
        return 0.0;
    }
    let front = libm::lgamma(a + b) - libm::lgamma(a) - libm::lgamma(b);
    let front = (front + a * x.ln() + b * rest.ln()).exp() / a;
    // Lentz's method
    let (mut c, mut d) = (1.0, 1.0 / (1.0 - (a + b) * x / (a + 1.0)));
    let mut fraction = d;
    for m in 1..TERMS {
        let m = f64::from(m);
        let even = m * (b - m) * x / ((a + 2.0 * m - 1.0) * (a + 2.0 * m));
        let odd = -(a + m) * (a + b + m) * x / ((a + 2.0 * m) * (a + 2.0 * m + 1.0));
        for part in [even, odd] {
            d = 1.0 / (1.0 + part * d);
            c = 1.0 + part / c;
            fraction *= c * d;
        }
    }
    (front * fraction).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::two_sided;

    fn near(a: f64, b: f64) {
        assert!((a - b).abs() < 1e-9, "{a} {b}");
    }

    /// SciPy 1.17: 2 * stats.norm.sf(z), 2 * stats.t.sf(t, nu).
    #[test]
    fn probabilities_are_those_of_scipy() {
        near(two_sided(1.959963984540054, f64::INFINITY), 0.05);
        near(two_sided(-3.0, f64::INFINITY), 0.0026997960632601866);
        near(two_sided(2.0, 1.0), 0.2951672353008665);
        near(two_sided(2.0, 2.0), 0.18350341907227405);
        near(two_sided(2.0, 3.0), 0.13932596855884295);
        near(two_sided(2.0, 12.0), 0.06865501403808597);
        near(two_sided(2.0, 13.0), 0.06684035764825418);
        near(two_sided(0.0, 5.0), 1.0);
        near(two_sided(2.0, 5.2676), 0.09904338999815267);
        near(two_sided(1.3, 1.5), 0.35802939120158084);
        near(two_sided(-0.1, 2.27), 0.92848932000229);
        near(two_sided(1e-3, 7.5), 0.9992281986746556);
        let far = two_sided(12.0, 40.0);
        assert!((far / 7.82417130425598e-15 - 1.0).abs() < 1e-9, "{far}");
        near(two_sided(f64::INFINITY, 3.0), 0.0);
    }
}
