//! The solution of a linear system inside a step, as a series of Laguerre polynomials.
//!
//! With `z = h J / M` and `v = 1 / (1 - g z)`, the generating function of the Laguerre polynomials
//! (Abramowitz and Stegun, table 22.9, 22.9.15, at `t = -g z v`) is
//!
//! ```text
//! exp(s z) - 1 = sum over n >= 1 of (-1)^n (L_n(s/g) - L_(n-1)(s/g)) (g z)^n v^n
//! ```
//!
//! so that, with the terms `u_1 = v (h y' + g h^2 y'')` and `u_(n+1) = (v - 1) u_n`, the solution
//! after a share `s` of the step is a weighted sum of terms, each of which takes one solve with the
//! same matrix `M - g h J`. `|v - 1| < 1` for every decaying mode however fast, so errors of a term
//! do not grow in the next ones. The sum truncated after `n` terms is the restricted Padé
//! approximation of S. P. Nørsett (SIAM J. Numer. Anal. 15 (1978) 1008): of order `n`, but at
//! infinity it is `L_n(1/g)`. The last weight is changed such that this is 0. The order is then
//! `n - 1`, and modes that are too fast for the step are gone after it.

/// The pole g: a power of two, so that `g h` is exact. With this value the sums of 4 to 12
/// terms damp all decaying modes (the tests sample them).
pub(super) const POLE: f64 = 0.125;

/// The fewest terms of a step: with three some modes would grow, and with fewer the energy balance
/// does not close, see [`mean`].
pub(super) const FEWEST: usize = 4;

/// The most terms of a step.
pub(super) const MOST: usize = 12;

/// One weight per term.
pub(super) type Weights = [f64; MOST];

/// `L_0` to `L_(MOST + 1)` at `x`, as far as `last`. They are needed in every row of a run, so
/// nothing is divided.
const fn laguerre(x: f64, last: usize) -> [f64; MOST + 2] {
    let mut values = [1.0; MOST + 2];
    values[1] = 1.0 - x;
    let mut k = 1;
    while k < last {
        let [a, b] = STEPS[k];
        values[k + 1] = (b - a * x) * values[k] - (b - 1.0) * values[k - 1];
        k += 1;
    }
    values
}

/// For each `n` the numbers of `L_(n+1) = (b - a x) L_n - (b - 1) L_(n-1)`: `a = 1 / (n + 1)` and
/// `b = (2 n + 1) / (n + 1)`.
const STEPS: [[f64; 2]; MOST + 1] = {
    let mut steps = [[0.0; 2]; MOST + 1];
    let (mut n, mut k) = (0.0, 0);
    while k <= MOST {
        steps[k] = [1.0 / (n + 1.0), (2.0 * n + 1.0) / (n + 1.0)];
        n += 1.0;
        k += 1;
    }
    steps
};

/// Remainder of an infinitely fast mode at the end of a step of the series that is only truncated,
/// by the number of its terms.
const AT_INFINITY: [f64; MOST + 2] = laguerre(1.0 / POLE, MOST + 1);

/// Alternating: -1 for odd n.
fn sign(n: usize) -> f64 {
    if n.is_multiple_of(2) { 1.0 } else { -1.0 }
}

/// The weights with which `terms` terms add up to the change of the state over a share of the step
/// from 0 to 1.
pub(super) fn change(terms: usize, share: f64) -> Weights {
    let values = laguerre(share / POLE, terms);
    let mut weights = [0.0; MOST];
    let mut factor = POLE;
    for (weight, ends) in weights[..terms].iter_mut().zip(values.windows(2)) {
        factor = -factor;
        *weight = factor * (ends[1] - ends[0]);
    }
    // rounding of the polynomial would be a rate outside the energy balance
    weights[0] = share;
    let smooth = share * share * (3.0 - 2.0 * share);
    weights[terms - 1] -= POLE * sign(terms) * AT_INFINITY[terms] * smooth;
    weights
}

/// The weights of the change of the *mean* state over a share of the step, above 0 to 1, for which
/// the flow in the middle of that time is exactly the change of `M y` over the time, so that the
/// energy balance closes.
///
/// It follows from `(g z) u_(n+1) v = …`: dividing the series by `z` takes a term into the mean of
/// itself and the one before. Valid from three terms on, whose first two weights are exact.
pub(super) fn mean(terms: usize, share: f64) -> Weights {
    let change = change(terms, share);
    let mut weights = [0.0; MOST];
    weights[0] = POLE;
    for n in 2..=terms {
        let part = POLE * change[n - 1] / share;
        weights[n - 1] += part;
        weights[n - 2] += part;
    }
    weights
}

/// The weights of the rate of change after a share of the step, times its length, for the series
/// that is only truncated.
pub(super) fn rate(terms: usize, share: f64) -> Weights {
    let values = laguerre(share / POLE, terms);
    let mut weights = [0.0; MOST];
    for n in 1..=terms {
        weights[n - 1] = -sign(n) * values[n - 1]; // (L_n - L_(n-1))' = -L_(n-1)
    }
    weights
}

/// The error of a step over the size of its last term, by the number of terms: the change of the
/// last weight or the first two that are left out, whichever is largest. So no zero of a polynomial
/// feigns an accuracy.
pub(super) fn error_constants() -> [f64; MOST + 1] {
    let values = AT_INFINITY.map(f64::abs);
    let mut constants = [POLE; MOST + 1];
    for n in 1..=MOST {
        constants[n] = POLE * values[n].max(0.5 * values[n - 1]).max(0.5 * values[n + 1]);
    }
    constants
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The factor of a mode over a share of a step.
    fn factor(z: f64, terms: usize, share: f64) -> f64 {
        let v = 1.0 / (1.0 - POLE * z);
        let mut term = v * z;
        let mut sum = 1.0;
        for weight in &change(terms, share)[..terms] {
            sum += weight * term;
            term *= v - 1.0;
        }
        sum
    }

    #[test]
    fn slow_modes_follow_the_exponential_by_the_order() {
        for terms in FEWEST..=MOST {
            for share in [0.25_f64, 0.7, 1.0] {
                let error = |z: f64| (factor(z, terms, share) - (share * z).exp()).abs();
                let order = (error(-0.4) / error(-0.2)).log2();
                assert!(
                    error(-0.2) < 1e-12 || order > f64::from(terms as u32) - 0.7,
                    "{terms} terms, share {share}: order {order}"
                );
            }
        }
    }

    #[test]
    fn all_decaying_modes_are_damped_and_fast_ones_are_gone() {
        for terms in FEWEST..=MOST {
            for k in -40..80 {
                let z = -10.0_f64.powf(f64::from(k) / 8.0);
                let size = factor(z, terms, 1.0).abs();
                assert!(size < 1.0, "{terms} terms, z = {z}: {size}");
            }
            assert!(factor(-1e9, terms, 1.0).abs() < 1e-6, "{terms}");
        }
    }

    /// `y' = lambda (y - c - d t)`, for which the mean has to give the change exactly.
    #[test]
    fn the_mean_closes_the_books() {
        let (z, drift) = (-3.7, 0.9); // over a step of length 1
        for terms in FEWEST..=MOST {
            for share in [0.1, 0.5, 1.0] {
                let (start, rate) = (2.0, z * 2.0);
                let v = 1.0 / (1.0 - POLE * z);
                let mut term = v * (rate + POLE * drift);
                let (mut end, mut middle) = (start, start);
                let (change, mean) = (change(terms, share), mean(terms, share));
                for n in 0..terms {
                    end += change[n] * term;
                    middle += mean[n] * term;
                    term = if n == 0 { v * (term + POLE * drift) - term } else { (v - 1.0) * term };
                }
                let flow = z * middle + drift * 0.5 * share;
                assert!((end - start - share * flow).abs() < 1e-13, "{terms} {share}");
            }
        }
    }
}
