//! The capacity whose one exponential is nearest to a step response, by least squares.
//!
//! The derivative of the squared error vanishes at most once. If the port follows its slowest mode
//! closely enough, it never vanishes, and no capacity is nearest.

use crate::step::StepResponse;

/// `C_eq` in J/K that minimises the integral of `(z(t) - R (1 - exp(-t / (R C))))^2` from 0 to
/// `window` [s], with R fixed at `R_eq`.
///
/// With `a = 1/(R C)` and `z = R - sum r_i exp(-l_i t)` the derivative by a vanishes if
/// `R K(2a) = sum r_i K(a + l_i)`, where K(s) is the integral of `t exp(-s t)` over the window:
/// closed forms, no sampling. There is at most one such rate: with M(s) the mean of t under the
/// weight `t exp(-s t)`, the logarithm of `K(a + l) / K(2a)` rises by `2 M(2a) - M(a + l) > 0`,
/// since M falls with s while `s M(s)` rises. From `sum r_i K(l_i) / K(0) < R` at a = 0 the sum
/// rises to `4 sum r_i`. If that is not above R, no capacity is nearest and the result is 0, which
/// needs a massless port and three quarters of the rise at once.
pub(crate) fn least_squares(step: &StepResponse, window: f64) -> f64 {
    let slow: f64 = step.terms.iter().map(|t| t.resistance).sum();
    if 4.0 * slow <= step.resistance {
        return 0.0;
    }
    if step.direct <= 0.0 && window < 1e-8 * step.span().0 {
        // the port warms alone, while the slopes would be lost in rounding
        return step.terms.iter().map(|t| t.resistance / t.tau).sum::<f64>().recip();
    }
    let mut fast = 1.0 / window;
    while slope(step, window, fast) > 0.0 {
        fast *= 2.0;
    }
    1.0 / (step.resistance * root(step, window, (0.0, fast)))
}

/// Positive if a larger rate is better.
fn slope(step: &StepResponse, window: f64, rate: f64) -> f64 {
    let own = step.resistance * ramp(2.0 * rate, window);
    own - step.terms.iter().map(|t| t.resistance * ramp(rate + 1.0 / t.tau, window)).sum::<f64>()
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

/// Integral of `t exp(-s t)` from 0 to `window`: `(1 - exp(-x)(1 + x)) / s^2` with `x = s window`,
/// or its series if the difference would lose digits.
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
    use crate::step::ResponseTerm;

    #[test]
    fn the_two_forms_of_the_integral_meet() {
        for x in [0.3_f64, 0.499_999, 0.500_001, 0.9] {
            let closed = (1.0 - (-x).exp() * (1.0 + x)) / (x * x);
            assert!((ramp(x, 1.0) / closed - 1.0).abs() < 1e-14, "{x}");
        }
        assert!((ramp(0.0, 3.0) - 4.5).abs() < 1e-15);
    }

    /// `z = 1 - r exp(-t)` at a massless port, over a window so long that the cost is
    /// `1/(2a) - 2r/(a + 1)` plus a constant. Its derivative vanishes if `(a + 1)^2 = 4 r a^2`,
    /// `a = 1/(2 sqrt(r) - 1)`, and the cost there is `-(2 sqrt(r) - 1)^2 / 2`, lower than that of
    /// C = 0; for r <= 1/4 there is no such rate.
    #[test]
    fn no_capacity_is_nearest_to_a_port_that_answers_at_once() {
        for r in [0.02_f64, 0.249, 0.25, 0.2501, 0.26, 0.5, 0.99] {
            let term = ResponseTerm { tau: 1.0, resistance: r, error: 0.0 };
            let step =
                StepResponse { resistance: 1.0, direct: 1.0 - r, terms: vec![term], residual: 0.0 };
            let expected = (2.0 * r.sqrt() - 1.0).max(0.0);
            let found = least_squares(&step, 1e4);
            assert!((found - expected).abs() < 1e-10, "{r}: {found} is not {expected}");
            assert_eq!(found > 0.0, r > 0.25, "{r}: {found}");
        }
    }

    #[test]
    fn one_exponential_is_found_again() {
        let term = ResponseTerm { tau: 60.0, resistance: 0.3, error: 0.0 };
        let step = StepResponse { resistance: 0.3, direct: 0.0, terms: vec![term], residual: 0.0 };
        for window in [1.0, 60.0, 1e5] {
            assert!((least_squares(&step, window) / 200.0 - 1.0).abs() < 1e-11, "{window}");
        }
    }

    /// Far below every time constant a port rises as t over its own capacity: rates `r/tau` add to
    /// `1/C`.
    #[test]
    fn in_a_short_window_the_port_warms_alone() {
        let terms = vec![
            ResponseTerm { tau: 800.0, resistance: 0.3, error: 0.0 },
            ResponseTerm { tau: 40.0, resistance: 0.1, error: 0.0 },
        ];
        let step = StepResponse { resistance: 0.4, direct: 0.0, terms, residual: 0.0 };
        let alone = 1.0 / (0.3 / 800.0 + 0.1 / 40.0);
        for (window, within) in [(1e-200, 1e-15), (1e-12, 1e-15), (1e-6, 1e-6), (1e-4, 1e-5)] {
            let found = least_squares(&step, window);
            assert!((found / alone - 1.0).abs() < within, "{window}: {found} is not {alone}");
        }
    }

    /// A massless port jumps to `z = d` at once. Over a short window W, `1 - exp(-a t)` is nearest
    /// to it if the integral of `(d - 1 + exp(-a t)) t exp(-a t)` vanishes: for x = a W,
    /// `(1 - d) k(x) = k(2 x)` with `k(x) = (1 - (1 + x) exp(-x)) / x^2`.
    #[test]
    fn in_a_short_window_a_massless_port_has_jumped() {
        let step = StepResponse {
            resistance: 1.0,
            direct: 0.5,
            terms: vec![ResponseTerm { tau: 1.0, resistance: 0.5, error: 0.0 }],
            residual: 0.0,
        };
        let window = 1e-9;
        let x = window / least_squares(&step, window);
        let k = |x: f64| (1.0 - (1.0 + x) * (-x).exp()) / (x * x);
        assert!((0.5 * k(x) / k(2.0 * x) - 1.0).abs() < 1e-8 && x > 1.0, "{x}");
    }
}
