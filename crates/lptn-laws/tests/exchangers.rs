//! Reference: heat exchangers against the Python package ht 1.2.0 (Caleb Bell, MIT licence), and in
//! their limits; fins.

use lptn_laws::{
    effectiveness_counterflow, effectiveness_crossflow, effectiveness_parallel, fin_efficiency,
    finned,
};
use lptn_units::Dual;

#[track_caller]
fn near(found: f64, expected: f64, relative: f64) {
    assert!((found - expected).abs() <= relative * expected.abs(), "{found} is not {expected}");
}

/// ht: effectiveness_from_NTU(5, 0.7), (0.3, 0.2) and (2, 1); the crossflow is its integral.
#[test]
fn exchangers_are_those_of_ht() {
    near(effectiveness_counterflow(5.0, 0.7), 0.920_670_368_605_110_8, 1e-14);
    near(effectiveness_parallel(5.0, 0.7), 0.588_115_606_841_758_5, 1e-14);
    near(effectiveness_crossflow(5.0, 0.7), 0.844_482_179_974_855, 1e-13);
    near(effectiveness_crossflow(0.3, 0.2), 0.252_626_344_509_073_95, 1e-13);
    near(effectiveness_crossflow(2.0, 1.0), 0.614_247_239_273_578, 1e-13);
}

/// Where one side boils all are 1 - exp(-N); small ones are N; equal streams against each other are N
/// / (1 + N), and nothing jumps there.
#[test]
fn exchangers_in_their_limits() {
    let laws: [fn(f64, f64) -> f64; 3] =
        [effectiveness_counterflow, effectiveness_parallel, effectiveness_crossflow];
    for law in laws {
        for n in [1e-9_f64, 0.1, 1.0, 5.0, 20.0] {
            near(law(n, 0.0), -(-n).exp_m1(), 1e-13);
            near(law(n, 1e-9), law(n, 0.0), 1e-7);
        }
        near(law(1e-9, 0.7), 1e-9, 1e-8);
        near(law(0.0, 0.7) + 1.0, 1.0, 0.0);
        for n in [0.02, 0.5, 3.0] {
            // both sides of where a series stands for a quotient
            for x in [0.01 / n, 1.0 - 0.01 / n] {
                near(law(n, x - 1e-12), law(n, x + 1e-12), 1e-11);
            }
        }
    }
    let [n, ratio] = [(0.0, 0), (1.0, 1)].map(|(x, i)| Dual::<2>::variable(x, i));
    for found in [
        effectiveness_counterflow(n, ratio),
        effectiveness_parallel(n, ratio),
        effectiveness_crossflow(n, ratio),
    ] {
        assert_eq!((found.value, found.derivatives), (0.0, [1.0, 0.0]), "at no size");
    }
    for n in [0.5, 5.0] {
        near(effectiveness_counterflow(n, 1.0), n / (1.0 + n), 1e-15);
        near(effectiveness_counterflow(n, 1.0 - 1e-9), n / (1.0 + n), 1e-8);
    }
}

/// tanh(1); short fins lose nothing; a fin of which the base is all.
#[test]
fn fins_are_as_good_as_they_conduct() {
    near(fin_efficiency(1.0), 1f64.tanh(), 1e-15);
    near(fin_efficiency(0.009_999), 0.009_999_f64.tanh() / 0.009_999, 1e-14);
    near(fin_efficiency(1e-9), 1.0, 1e-15);
    near(finned(10.0, [0.01, 0.2], 1e-9), 2.1, 1e-14);
    near(finned(10.0, [0.01, 0.2], 2.0), 0.1 + 2.0 * 2f64.tanh() / 2.0, 1e-14);
}
