//! Sampled bands, probabilities and shares of the variance, against closed forms and NumPy.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common;

use common::{ONE_NODE, RADIATING, RISE, near, parsed, sobol, sobol_with, task, within};
use lptn_study::uncertainty::{Answer, Uncertainty, UncertaintyError, UncertaintyMethod};

/// Points with sampling errors of a few thousandths.
const MANY: usize = 1024;

/// The end of the first node.
fn end(found: &Uncertainty) -> &Answer {
    &found.answers[0]
}

fn part(answer: &Answer, input: usize) -> lptn_study::uncertainty::Contribution {
    *answer.ranking.iter().find(|part| part.input == input).unwrap()
}

/// T(t) = T_amb + P R (1 - exp(-t / R C)) is linear in P and T_amb: their normal distributions pass
/// through.
#[test]
fn analytic_a_result_linear_in_its_parameters_is_normal() {
    let netlist = parsed(ONE_NODE, "P = \"200 ± 20 W\"\nT_amb = \"20 ± 2 degC\"");
    let found = sobol(&netlist, MANY);
    let effects = [RISE * 20.0, 2.0];
    let deviation = f64::hypot(effects[0], effects[1]);
    let answer = end(&found);
    near(answer.value, 293.15 + 200.0 * RISE, 1e-7);
    near(answer.deviation.value, deviation, 3e-3);
    for (found, side) in [(answer.low, -1.0), (answer.high, 1.0)] {
        within(found, answer.value + side * 1.959_964 * deviation, 4.0);
        near(found.value - answer.value, side * 1.959_964 * deviation, 0.04);
    }
    for (input, effect) in effects.into_iter().enumerate() {
        let (part, share) = (part(answer, input), effect * effect / (deviation * deviation));
        near(part.effect, effect, 1e-2);
        within(part.share, share, 4.0);
        within(part.total.unwrap(), share, 4.0);
    }
    // half way up the rise is what one time constant makes of it
    let bands = &found.bands[0];
    let row = found.times.iter().position(|time| *time >= 500.0).unwrap();
    let rise = 0.5 * -f64::exp_m1(-found.times[row] / 500.0);
    near(bands.deviation[row], f64::hypot(rise * 20.0, 2.0), 5e-3);
    near(bands.high[row] - bands.low[row], 2.0 * 1.959_964 * f64::hypot(rise * 20.0, 2.0), 2e-2);
}

/// Var(a b) = ma^2 sb^2 + mb^2 sa^2 + sa^2 sb^2: of independent factors, the last term belongs to
/// both together.
#[test]
fn analytic_the_variance_of_a_product_has_a_share_of_both_together() {
    let netlist =
        parsed(ONE_NODE, "a = \"2 ± 1\"\nb = \"100 ± 30 W\"\nP = \"a * b\"\nT_amb = \"20 degC\"");
    let found = sobol(&netlist, MANY);
    let (a, b, both) = (100.0 * 100.0, 2.0 * 2.0 * 30.0 * 30.0, 30.0 * 30.0);
    let variance = a + b + both;
    let answer = end(&found);
    near(answer.deviation.value, RISE * f64::sqrt(variance), 5e-3);
    for (input, alone) in [a, b].into_iter().enumerate() {
        let part = part(answer, input);
        within(part.share, alone / variance, 4.0);
        within(part.total.unwrap(), (alone + both) / variance, 4.0);
    }
    assert_eq!(answer.ranking[0].input, 0, "a matters most: {:?}", answer.ranking);
}

/// A node that radiates 100 ± 30 W over Gr = 0.02 ± 0.004 m^2 towards 293.15 K, settled: T^4 =
/// T_s^4 + P / (sigma Gr). NumPy 2.4.6, 2e7 draws of `default_rng(20261121)`, sigma =
/// 5.670374419e-8: standard deviation, quantiles of 2.5, 50 and 97.5 %, share above 600 K, then
/// first-order and total index of P and of Gr by pick and freeze.
#[test]
fn reference_a_radiating_node_is_as_a_plain_monte_carlo_run_says() {
    const DEVIATION: f64 = 50.403;
    const QUANTILES: [f64; 3] = [452.755, 556.026, 652.427];
    const HOT: f64 = 0.172_446;
    const INDICES: [[f64; 2]; 2] = [[0.692_8, 0.697_0], [0.302_4, 0.306_2]];
    let found = sobol(&parsed(RADIATING, "P = \"100 ± 30 W\"\nGr = \"0.02 ± 0.004 m^2\""), MANY);
    let answer = end(&found);
    within(answer.deviation, DEVIATION, 4.0);
    for (found, expected) in
        [answer.low, answer.median.unwrap(), answer.high].into_iter().zip(QUANTILES)
    {
        within(found, expected, 4.0);
        assert!((found.value - expected).abs() < 0.06 * DEVIATION, "{found:?} is not {expected}");
    }
    let margin = found.answers.last().unwrap();
    within(margin.below_zero, HOT, 4.0);
    near(margin.below_zero.value, HOT, 0.1);
    for (input, [share, total]) in INDICES.into_iter().enumerate() {
        within(part(answer, input).share, share, 4.0);
        within(part(answer, input).total.unwrap(), total, 4.0);
        near(part(answer, input).total.unwrap().value, total, 0.05);
    }
}

#[test]
fn determinism_threads_change_nothing_and_seeds_do() {
    let netlist = parsed(RADIATING, "P = \"100 ± 30 W\"\nGr = \"0.02 ± 0.004 m^2\"");
    let text = |threads, seed| {
        let found = sobol_with(&netlist, (64, seed, threads)).unwrap();
        format!("{:?} {:?} {:?}", found.method, found.bands, found.answers)
    };
    let first = text(1, 1);
    assert_eq!(first, text(3, 1));
    assert_eq!(first, text(1, 1));
    assert_ne!(first, text(1, 2));
}

/// A resistance of 0.5 ± 0.25 K/W is negative with 2.275 %, and refused there:
/// `scipy.stats.norm.cdf(-2)`.
#[test]
fn what_the_network_refuses_is_counted_and_named() {
    let netlist = parsed(ONE_NODE, "R = \"0.5 ± 0.25 K/W\"\nP = \"200 W\"\nT_amb = \"20 degC\"");
    let found = sobol(&netlist, 1024);
    let UncertaintyMethod::Sobol { samples, lost, .. } = &found.method else {
        panic!("{:?}", found.method)
    };
    assert_eq!(*samples, 1024);
    let [lost] = lost.as_slice() else { panic!("{lost:?}") };
    assert!(lost.refused && lost.message.contains("skin"), "{lost}");
    // of two base runs each; mixed runs are made where both have a result, and take R from one of
    // them
    near(lost.count as f64, 0.02275 * 2048.0, 0.1);
    assert!(found.bands[0].low.iter().all(|low| low.is_finite()));
}

/// A node that is cooled by more than there is falls below 0 K, and the run breaks off: P < -586.3
/// W with 2.275 %.
#[test]
fn a_run_that_fails_is_counted_and_named() {
    let netlist = parsed(ONE_NODE, "P = \"0 ± 339.2 W\"\nT_amb = \"20 degC\"");
    let found = sobol(&netlist, 1024);
    let UncertaintyMethod::Sobol { lost, runs, .. } = &found.method else {
        panic!("{:?}", found.method)
    };
    let [lost] = lost.as_slice() else { panic!("{lost:?}") };
    assert_eq!((lost.refused, lost.code), (false, "solve::below_absolute_zero"));
    assert!((5..runs / 10).contains(&lost.count), "{lost} of {runs}");
}

#[test]
fn what_cannot_be_sampled_has_a_code() {
    let code = |outcome: Result<Uncertainty, UncertaintyError>| outcome.unwrap_err().code();
    let certain = parsed(ONE_NODE, "P = \"200 W\"\nT_amb = \"20 degC\"");
    assert_eq!(code(sobol_with(&certain, (64, 1, 1))), "uncertainty::no_deviation");
    let netlist = parsed(ONE_NODE, "P = \"200 ± 1 W\"\nT_amb = \"20 degC\"");
    assert_eq!(code(sobol_with(&netlist, (63, 1, 1))), "uncertainty::samples");
    assert_eq!(code(sobol_with(&netlist, (70_000, 1, 1))), "uncertainty::samples");
    let mut large = task(&netlist);
    large.run = large.run.every(lptn_network::Time(1e-3));
    assert_eq!(code(common::sample(&large, (4096, 1, 1))), "uncertainty::too_large");
    let nonsense = parsed(ONE_NODE, "P = \"200 W\"\nT_amb = \"20 degC\"\nR = \"0.01 ± 50 K/W\"");
    let outcome = sobol_with(&nonsense, (64, 1, 1)).unwrap();
    assert!(
        matches!(outcome.method, UncertaintyMethod::Sobol { ref lost, .. } if lost[0].count > 30)
    );
}

/// `--set` with `±` takes the place of the file's, and one without leaves it.
#[test]
fn a_value_that_is_set_may_bring_its_own_deviation() {
    let mut netlist = parsed(ONE_NODE, "P = \"200 ± 20 W\"\nT_amb = \"20 degC\"");
    netlist.set(&["P=100W".to_owned()]).unwrap();
    near(end(&sobol(&netlist, 64)).ranking[0].effect, RISE * 20.0, 1e-4);
    netlist.set(&["P=100 ± 5 W".to_owned()]).unwrap();
    near(end(&sobol(&netlist, 64)).ranking[0].effect, RISE * 5.0, 1e-4);
    netlist.set(&["P=100 ± 0 W".to_owned()]).unwrap();
    assert_eq!(sobol_with(&netlist, (64, 1, 1)).unwrap_err().code(), "uncertainty::no_deviation");
}
