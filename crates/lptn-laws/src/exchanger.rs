//! Effectiveness of heat exchangers between two streams, from their size.
//!
//! Source of all: Incropera et al., Fundamentals of Heat and Mass Transfer, 6th edition, tables 11.3
//! and 11.4. Example 11.3 there reads 2.1 transfer units for e = 0.75 and C_r = 0.45 off a chart.
//!
//! * `ntu`: number of transfer units, U A over the smaller capacity rate, at least 0
//! * `ratio`: C_r, the smaller capacity rate over the larger, 0 (one side condenses or boils) to 1
//!
//! The effectiveness is the heat over the most that could flow:
//! q = e C_min (T_hot,in - T_cold,in).

use lptn_units::Scalar;

/// Below this the difference in a quotient would cancel, and a series replaces it.
const SMALL: f64 = 1e-2;

/// (1 - exp(-x)) / x, 1 at 0.
fn mean_of_decay<S: Scalar>(x: S) -> S {
    let one = S::from_f64(1.0);
    if x.value().abs() < SMALL {
        let term = |rest: S, n: f64| one - x / S::from_f64(n) * rest;
        return [7.0, 6.0, 5.0, 4.0, 3.0, 2.0].into_iter().fold(one, term);
    }
    (one - (-x).exp()) / x
}

/// Effectiveness of two streams in opposite directions.
///
/// e = (1 - exp(-N (1 - C_r))) / (1 - C_r exp(-N (1 - C_r))); for C_r = 1 it is N / (1 + N)
///
/// ```
/// // the library ht (Caleb Bell) prints 0.920670
/// assert!((lptn_laws::effectiveness_counterflow(5.0, 0.7) - 0.920_670).abs() < 5e-7);
/// assert!((lptn_laws::effectiveness_counterflow(5.0, 1.0) - 5.0 / 6.0).abs() < 1e-15);
/// ```
pub fn effectiveness_counterflow<S: Scalar>(ntu: S, ratio: S) -> S {
    // both sides over 1 - C_r: (1 - E)/(1 - C_r) = N d, 1 - C_r E = (1 - C_r) (1 + C_r N d)
    let one = S::from_f64(1.0);
    let gained = ntu * mean_of_decay(ntu * (one - ratio));
    gained / (one + ratio * gained)
}

/// Effectiveness of two parallel streams.
///
/// e = (1 - exp(-N (1 + C_r))) / (1 + C_r)
///
/// ```
/// assert!((lptn_laws::effectiveness_parallel(5.0, 0.7) - 0.588_116).abs() < 5e-7);
/// ```
pub fn effectiveness_parallel<S: Scalar>(ntu: S, ratio: S) -> S {
    let one = S::from_f64(1.0);
    ntu * mean_of_decay(ntu * (one + ratio))
}

/// Effectiveness of two streams that cross, neither of them mixed: the exact solution.
///
/// e = 1/(C_r N) sum over n from 0 of (1 - exp(-N) sum_{m<=n} N^m/m!)
/// (1 - exp(-C_r N) sum_{m<=n} (C_r N)^m/m!)
///
/// Terms are added until they no longer count, some N + 10 sqrt(N) of them. Source: J. L. Mason,
/// Heat transfer in crossflow, Proceedings of the 2nd US National Congress of Applied Mechanics
/// (1954) 801; it is the value of the integral that the library ht (Caleb Bell) takes.
///
/// ```
/// assert!((lptn_laws::effectiveness_crossflow(5.0, 0.7) - 0.844_482).abs() < 5e-7);
/// ```
pub fn effectiveness_crossflow<S: Scalar>(ntu: S, ratio: S) -> S {
    let (hot, cold, one) = (ntu, ratio * ntu, S::from_f64(1.0));
    // the rest of 1 after the terms up to now of each exponential series; the second over C_r N
    let mut rest = [hot * mean_of_decay(hot), mean_of_decay(cold)];
    let mut power = [(-hot).exp() * hot, (-cold).exp()];
    let mut sum = rest[0] * rest[1];
    for n in 2..MOST_TERMS {
        rest = [rest[0] - power[0], rest[1] - power[1]];
        let term = rest[0] * rest[1];
        if term.value() <= f64::EPSILON * 1e-3 * sum.value() {
            break;
        }
        sum = sum + term;
        let next = one / S::from_f64(f64::from(n));
        power = [power[0] * hot * next, power[1] * cold * next];
    }
    sum
}

/// More than are needed for 1000 transfer units.
const MOST_TERMS: u32 = 2000;

/// Effectiveness of a shell with one pass and tubes with two, four, … passes.
///
/// e = 2 / (1 + C_r + s (1 + exp(-N s)) / (1 - exp(-N s))), s = sqrt(1 + C_r^2)
///
/// ```
/// // the library ht (Caleb Bell) prints 0.683498
/// assert!((lptn_laws::effectiveness_shell(5.0, 0.7) - 0.683_498).abs() < 5e-7);
/// ```
pub fn effectiveness_shell<S: Scalar>(ntu: S, ratio: S) -> S {
    let [one, two] = [1.0, 2.0].map(S::from_f64);
    let root = (one + ratio * ratio).sqrt();
    // (1 - exp(-N s)) / s
    let gained = ntu * mean_of_decay(ntu * root);
    let left = (-(ntu * root)).exp();
    two * gained / ((one + ratio) * gained + one + left)
}

/// Effectiveness if the other side has one temperature: it boils, condenses or is a bath.
///
/// e = 1 - exp(-N), for any C_r
///
/// ```
/// assert!((lptn_laws::effectiveness_one_stream(5.0, 0.0) - 0.993_262).abs() < 5e-7);
/// ```
pub fn effectiveness_one_stream<S: Scalar>(ntu: S, _: S) -> S {
    ntu * mean_of_decay(ntu)
}
