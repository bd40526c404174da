//! The capacity whose one exponential is nearest to a step response, by least squares.

use crate::step::StepResponse;

/// `C_eq` in J/K for which the integral of `(z(t) - R (1 - exp(-t / (R C))))^2` from 0 to `window` [s] is least,
/// with R held at `R_eq`.
///
/// With `a = 1/(R C)` and `z = R - sum r_i exp(-l_i t)` the derivative by a vanishes where
/// `R K(2a) = sum r_i K(a + l_i)`, K(s) being the integral of `t exp(-s t)` over the window: closed forms, no
/// sampling. All minima are found on a grid of a and the lowest is taken: 0 where none is lower than the limit
/// for C to 0, which happens at massless ports only, where much of the rise comes at once.
pub(crate) fn least_squares(step: &StepResponse, window: f64) -> f64 {
    const PER_DECADE: f64 = 20.0;
    let (least, most) = step.span();
    let from = (1e-6 / most.max(window)).ln();
    let to = (1e3 / least.min(window)).ln();
    let count = ((to - from) / std::f64::consts::LN_10 * PER_DECADE).ceil();
    let at = |k: f64| (from + (to - from) * k / count).exp();
    let mut best: Option<(f64, f64)> = None;
    let mut k = 0.0;
    while k < count {
        let (a, b) = (at(k), at(k + 1.0));
        if slope(step, window, a) > 0.0 && slope(step, window, b) <= 0.0 {
            let rate = root(step, window, (a, b));
            let cost = cost(step, window, rate);
            if best.is_none_or(|(least, _)| cost < least) {
                best = Some((cost, rate));
            }
        }
        k += 1.0;
    }
    match best {
        // a cost of 0 is that of no capacity
        Some((cost, rate)) if cost < 0.0 => 1.0 / (step.resistance * rate),
        _ if step.direct > 0.0 => 0.0,
        // so short a window that all slopes are lost in rounding: the port warms alone
        _ => step.terms.iter().map(|t| t.resistance / t.tau).sum::<f64>().recip(),
    }
}

/// Positive where a larger rate is better.
fn slope(step: &StepResponse, window: f64, rate: f64) -> f64 {
    let own = step.resistance * ramp(2.0 * rate, window);
    own - step.terms.iter().map(|t| t.resistance * ramp(rate + 1.0 / t.tau, window)).sum::<f64>()
}

/// The squared error less what does not depend on the rate.
fn cost(step: &StepResponse, window: f64, rate: f64) -> f64 {
    let area = |s: f64| -f64::exp_m1(-s * window) / s;
    let cross: f64 = step.terms.iter().map(|t| t.resistance * area(rate + 1.0 / t.tau)).sum();
    step.resistance * (step.resistance * area(2.0 * rate) - 2.0 * cross)
}

fn root(step: &StepResponse, window: f64, (mut a, mut b): (f64, f64)) -> f64 {
    loop {
        let middle = 0.5 * (a + b);
        if middle <= a || middle >= b {
            return middle;
        }
        if slope(step, window, middle) > 0.0 {
            a = middle;
        } else {
            b = middle;
        }
    }
}

/// Integral of `t exp(-s t)` from 0 to `window`: `(1 - exp(-x)(1 + x)) / s^2` with `x = s window`, by its series
/// where the difference would lose digits.
fn ramp(s: f64, window: f64) -> f64 {
    let x = s * window;
    if x > 0.5 {
        return (1.0 - (-x).exp() * (1.0 + x)) / (s * s);
    }
    // sum over k >= 0 of (-x)^k / (k! (k + 2)), times window^2
    let (mut sum, mut power) = (0.0, 1.0);
    for k in 0..20 {
        let k = f64::from(k);
        sum += power / (k + 2.0);
        power *= -x / (k + 1.0);
    }
    sum * window * window
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::step::Term;

    #[test]
    fn the_two_forms_of_the_integral_meet() {
        for x in [0.3_f64, 0.499_999, 0.500_001, 0.9] {
            let closed = (1.0 - (-x).exp() * (1.0 + x)) / (x * x);
            assert!((ramp(x, 1.0) / closed - 1.0).abs() < 1e-14, "{x}");
        }
        assert!((ramp(0.0, 3.0) - 4.5).abs() < 1e-15);
    }

    /// `z = 1 - r exp(-t)` at a massless port, over a window so long that the cost is, less what does not depend on
    /// a, `1/(2a) - 2r/(a + 1)`. Its derivative vanishes where `(a + 1)^2 = 4 r a^2`, `a = 1/(2 sqrt(r) - 1)`, and the
    /// cost there is `-(2 sqrt(r) - 1)^2 / 2`, lower than that of C = 0; for r <= 1/4 there is no such place.
    #[test]
    fn no_capacity_is_nearest_to_a_port_that_answers_at_once() {
        for r in [0.02_f64, 0.249, 0.26, 0.5, 0.99] {
            let term = Term { tau: 1.0, resistance: r, error: 0.0 };
            let step = StepResponse { resistance: 1.0, direct: 1.0 - r, terms: vec![term], residual: 0.0 };
            let expected = (2.0 * r.sqrt() - 1.0).max(0.0);
            let found = least_squares(&step, 1e4);
            assert!((found - expected).abs() < 1e-10, "{r}: {found} is not {expected}");
        }
    }

    #[test]
    fn one_exponential_is_found_again() {
        let term = Term { tau: 60.0, resistance: 0.3, error: 0.0 };
        let step = StepResponse { resistance: 0.3, direct: 0.0, terms: vec![term], residual: 0.0 };
        for window in [1.0, 60.0, 1e5] {
            assert!((least_squares(&step, window) / 200.0 - 1.0).abs() < 1e-11, "{window}");
        }
    }
}
