//! Laguerre polynomials and bounds on them, for steps of the one-step method.

use lptn_integrate::SeriesStep;

/// The pole of the method.
const POLE: f64 = SeriesStep::POLE;

/// Most terms of a step.
pub(super) const MOST: usize = SeriesStep::MOST;

/// Parts of a step for which largest values are known.
const PARTS: usize = 32;

/// Parts of each of them in which a polynomial is bounded.
const FINE: usize = 8;

/// `L_0(x)` to `L_MOST(x)` (Abramowitz and Stegun, 22.7.12).
fn laguerre(x: f64) -> [f64; MOST + 1] {
    let mut values = [1.0; MOST + 1];
    values[1] = 1.0 - x;
    for n in 1..MOST {
        let order = n as f64;
        let next = (2.0 * order + 1.0 - x) * values[n] - order * values[n - 1];
        values[n + 1] = next / (order + 1.0);
    }
    values
}

/// The weights of the terms of a series that is only truncated, after a share of a step:
/// `g (-1)^n (L_n(s/g) - L_(n-1)(s/g))`.
pub(super) fn weights(share: f64) -> [f64; MOST] {
    let values = laguerre(share / POLE);
    let mut factor = POLE;
    let mut weights = std::array::from_fn(|n| {
        factor = -factor;
        factor * (values[n + 1] - values[n])
    });
    weights[0] = share;
    weights
}

/// `L_n(1/g)`, with which the method changes the weight of its last term.
pub(super) fn at_end(n: usize) -> f64 {
    laguerre(POLE.recip())[n]
}

/// Bounds on `|L_n(s/g)|` for shares `s` of a step from 0 on.
pub(super) struct Peaks(Vec<[f64; MOST + 1]>);

impl Peaks {
    pub(super) fn new() -> Self {
        let half = 0.5 / POLE / (PARTS * FINE) as f64;
        let mut most = [1.0_f64; MOST + 1];
        let mut part = |part: usize| {
            for place in part * FINE..(part + 1) * FINE {
                let middle = half * (2 * place + 1) as f64;
                let values = laguerre(middle);
                // L_n' = -(L_0 + … + L_(n-1)), and |L_n''(x)| <= n (n - 1)/2 exp(x/2)
                // (22.8.6 and 22.14.13)
                let bend = 0.25 * half * half * (0.5 * (middle + half)).exp();
                let mut sum = 0.0_f64;
                for (n, value) in values.iter().enumerate() {
                    let rest = bend * (n * n) as f64;
                    most[n] = most[n].max(value.abs() + half * sum.abs() + rest);
                    sum += value;
                }
            }
            most
        };
        Self((0..PARTS).map(&mut part).collect())
    }

    /// From 0 up to this share.
    pub(super) fn up_to(&self, share: f64) -> &[f64; MOST + 1] {
        let part = (share * PARTS as f64).ceil().max(1.0) as usize;
        &self.0[part.min(PARTS) - 1]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `L_3(x) = (6 - 18 x + 9 x^2 - x^3)/6` (Abramowitz and Stegun, table 22.10).
    #[test]
    fn largest_values_are_bounded_closely() {
        let peaks = Peaks::new();
        let third = |x: f64| (6.0 - 18.0 * x + 9.0 * x * x - x * x * x) / 6.0;
        for share in [0.1_f64, 0.3, 0.61, 1.0] {
            let places = (0..=1000).map(|i| third(8.0 * share * f64::from(i) / 1000.0).abs());
            let (bound, right) = (peaks.up_to(share)[3], places.fold(0.0, f64::max));
            assert!(right <= bound && bound < 1.4 * right, "{share}: {right} {bound}");
        }
        assert!((laguerre(2.5)[3] - third(2.5)).abs() < 1e-14);
    }
}
