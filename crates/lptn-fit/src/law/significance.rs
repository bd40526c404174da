//! How likely chance alone is.

/// The probability that a standard normal variable, or Student's t with so many degrees of freedom
/// (at least 1), is further from 0 than `z`.
///
/// Student's t in closed form: M. Abramowitz, I. A. Stegun, Handbook of Mathematical Functions,
/// 26.7.3 and 26.7.4.
pub(crate) fn two_sided(z: f64, degrees_of_freedom: Option<usize>) -> f64 {
    match degrees_of_freedom {
        None => libm::erfc(z.abs() * std::f64::consts::FRAC_1_SQRT_2),
        Some(freedom) => (1.0 - inside(z.abs(), freedom.max(1))).clamp(0.0, 1.0),
    }
}

/// The probability that Student's t is nearer to 0 than `t`.
fn inside(t: f64, freedom: usize) -> f64 {
    let angle = (t / (freedom as f64).sqrt()).atan();
    let (sine, cosine) = angle.sin_cos();
    let odd = freedom % 2 == 1;
    let (mut term, mut sum) = (if odd { cosine } else { 1.0 }, 0.0);
    // powers of the cosine up to freedom - 2, each with a quotient of products of every second
    // number
    let mut k = if odd { 1 } else { 0 };
    while k + 2 <= freedom {
        sum += term;
        term *= cosine * cosine * (k + 1) as f64 / (k + 2) as f64;
        k += 2;
    }
    if odd { std::f64::consts::FRAC_2_PI * (angle + sine * sum) } else { sine * sum }
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
        near(two_sided(1.959963984540054, None), 0.05);
        near(two_sided(-3.0, None), 0.0026997960632601866);
        near(two_sided(2.0, Some(1)), 0.2951672353008665);
        near(two_sided(2.0, Some(2)), 0.18350341907227405);
        near(two_sided(2.0, Some(3)), 0.13932596855884295);
        near(two_sided(2.0, Some(12)), 0.06865501403808597);
        near(two_sided(2.0, Some(13)), 0.06684035764825418);
        near(two_sided(0.0, Some(5)), 1.0);
    }
}
