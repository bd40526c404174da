//! Parameters that are not normal, or off together: against closed forms of one node.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common;

use common::{ONE_NODE, RISE, demand, near, parsed, sobol, sobol_with, task, within};
use lptn_netlist::{Netlist, parse};
use lptn_study::uncertainty::{Answer, Uncertainty, UncertaintyMethod, uncertain};
use lptn_study::{Demand, Doubt, Scatter, SizeTask, size};

const MANY: usize = 1024;

fn correlated(param: &str, correlation: &str) -> Netlist {
    parsed(&format!("{ONE_NODE}[uncertainty]\ncorrelation = {correlation}\n"), param)
}

fn linear(netlist: &Netlist) -> Uncertainty {
    task(netlist).linear().unwrap_or_else(|error| panic!("{error}"))
}

fn end(found: &Uncertainty) -> &Answer {
    &found.answers[0]
}

/// What one standard deviation of R (4 %), P (10 %) and T_amb (2 K) does to `T_amb + P R (1 -
/// e^-x)` after two time constants x.
fn effects() -> [f64; 3] {
    let decay = f64::exp(-2.0);
    [200.0 * (1.0 - 3.0 * decay) * 0.02, RISE * 20.0, 2.0]
}

const THREE: &str = "R = \"0.5 K/W ± 4 %\"\nP = \"200 ± 20 W\"\nT_amb = \"20 ± 2 degC\"";
const TIED: &str = "{ R = { P = -0.8 }, T_amb = { P = 0.3 } }";

/// ISO/IEC Guide 98-3, 5.2.2: twice the correlation times both effects for each pair. A share is
/// an effect times the sum of the effects, each with its correlation.
#[test]
fn analytic_straight_lines_add_correlated_effects_with_their_signs() {
    let found = linear(&correlated(THREE, TIED));
    let [r, p, t] = effects();
    let variance = r * r + p * p + t * t - 1.6 * r * p + 0.6 * p * t;
    let answer = end(&found);
    near(answer.deviation.value, variance.sqrt(), 1e-6);
    near(found.bands[0].deviation[50], variance.sqrt(), 1e-6);
    near(answer.high.value - answer.low.value, 2.0 * 1.959_964 * variance.sqrt(), 1e-6);
    let together = [r - 0.8 * p, p - 0.8 * r + 0.3 * t, t + 0.3 * p];
    for part in &answer.ranking {
        let share = effects()[part.input] * together[part.input] / variance;
        near(part.share.value, share, 1e-5);
        assert!(part.total.is_none());
    }
    assert!((answer.ranking.iter().map(|part| part.share.value).sum::<f64>() - 1.0).abs() < 1e-12);
}

/// Settled, T = T_amb + P R. Of correlated normal P and R the product has the mean `p r + rho a b`
/// and the variance `p^2 b^2 + r^2 a^2 + 2 rho p r a b + a^2 b^2 (1 + rho^2)` (a and b are their
/// deviations): 41.64 K^2 here, where it would be 201 K^2 with rho = 0.
#[test]
fn analytic_sampled_products_of_correlated_factors_have_their_variance() {
    let param = "R = \"0.5 ± 0.05 K/W\"\nP = \"200 ± 20 W\"\nT_amb = \"20 degC\"";
    let settled = ONE_NODE.replace("1000 s", "20000 s").replace("20 s", "200 s");
    let joint = "[uncertainty]\ncorrelation = { P = { R = -0.8 } }\n";
    let netlist = parsed(&format!("{settled}{joint}"), param);
    let found = sobol(&netlist, MANY);
    let answer = end(&found);
    let (a, b, rho) = (20.0, 0.05, -0.8);
    let variance = 200_f64.powi(2) * b * b
        + 0.25 * a * a
        + 2.0 * rho * 100.0 * a * b
        + a * a * b * b * (1.0 + rho * rho);
    assert!((variance - 41.64).abs() < 1e-9, "{variance}");
    within(answer.deviation, variance.sqrt(), 4.0);
    near(answer.deviation.value, variance.sqrt(), 0.02);
    // no Sobol index is claimed, and the runs for them are not made
    assert!(answer.ranking.iter().all(|part| part.total.is_none()));
    let UncertaintyMethod::Sobol { runs, .. } = found.method else { panic!("not sampled") };
    assert_eq!(runs, 2 * MANY + 1);
    // slopes at the mean, the other held: r a and p b
    let effect = |input: usize| answer.ranking.iter().find(|part| part.input == input).unwrap();
    near(effect(0).effect, 200.0 * 0.05, 0.03);
    near(effect(1).effect, 0.5 * 20.0, 0.03);
}

/// Both methods say the same of a result that is linear in what is correlated.
#[test]
fn analytic_sampling_and_straight_lines_agree_where_results_are_straight() {
    let param = "P = \"200 ± 20 W\"\nT_amb = \"20 ± 2 degC\"";
    let netlist = correlated(param, "{ P = { T_amb = 0.9 } }");
    let (lines, sampled) = (linear(&netlist), sobol(&netlist, MANY));
    let (p, t) = (RISE * 20.0, 2.0);
    let deviation = (p * p + t * t + 1.8 * p * t).sqrt();
    near(end(&lines).deviation.value, deviation, 1e-6);
    near(end(&sampled).deviation.value, deviation, 4e-3);
    for part in &end(&sampled).ranking {
        let line = end(&lines).ranking.iter().find(|other| other.input == part.input).unwrap();
        near(part.effect, line.effect, 1e-6);
        near(part.share.value, line.share.value, 1e-2);
    }
}

#[test]
fn samples_of_correlated_parameters_are_the_same_on_any_number_of_threads() {
    let netlist = correlated(THREE, TIED);
    let [one, three] = [1, 3].map(|threads| sobol_with(&netlist, (128, 5, threads)).unwrap());
    assert_eq!(one.bands, three.bands);
    for (a, b) in one.answers.iter().zip(&three.answers) {
        assert_eq!(
            (a.deviation, a.low, a.high, &a.ranking),
            (b.deviation, b.low, b.high, &b.ranking)
        );
    }
}

/// A rectangle of half-width a: 2.5 % below -0.95 a, one standard deviation a / sqrt(3).
#[test]
fn analytic_a_rectangle_stays_one() {
    let netlist = parsed(ONE_NODE, "P = \"200 ± 30 W (rectangle)\"\nT_amb = \"20 degC\"");
    let found = sobol(&netlist, MANY);
    let answer = end(&found);
    near(answer.deviation.value, RISE * 30.0 / 3_f64.sqrt(), 2e-3);
    near(answer.high.value - answer.value, RISE * 0.95 * 30.0, 5e-3);
    near(answer.value - answer.low.value, RISE * 0.95 * 30.0, 5e-3);
    near(end(&linear(&netlist)).deviation.value, RISE * 30.0 / 3_f64.sqrt(), 1e-6);
    // of two with the correlation 1/2 the variance is a^2 / 3 (1 + 1 + 1)
    let two = "a = \"0 ± 30 W (rectangle)\"\nb = \"200 ± 30 W (rectangle)\"\nP = \"a + b\"\n\
        T_amb = \"20 degC\"";
    let netlist = correlated(two, "{ a = { b = 0.5 } }");
    near(end(&linear(&netlist)).deviation.value, RISE * 30.0, 1e-6);
    let sampled = sobol(&netlist, MANY);
    within(end(&sampled).deviation, RISE * 30.0, 4.0);
    near(end(&sampled).deviation.value, RISE * 30.0, 1e-2);
}

/// A lognormal P of 100 W with 30 %: the median is 100 W, 95 % lie within factors of
/// exp(1.96 x 0.3), and the deviation is 100 W sqrt((e^s2 - 1) e^s2), s2 = 0.09.
#[test]
fn analytic_a_lognormal_parameter_is_a_factor() {
    let netlist = parsed(ONE_NODE, "P = \"100 W ± 30 % (lognormal)\"\nT_amb = \"20 degC\"");
    let found = sobol(&netlist, MANY);
    let answer = end(&found);
    let at = |z: f64| 293.15 + RISE * 100.0 * f64::exp(0.3 * z);
    near(answer.median.unwrap().value - 293.15, RISE * 100.0, 3e-3);
    near(answer.low.value - 293.15, at(-1.959_964) - 293.15, 1e-2);
    near(answer.high.value - 293.15, at(1.959_964) - 293.15, 1e-2);
    let variance = (f64::exp(0.09) - 1.0) * f64::exp(0.09);
    near(answer.deviation.value, RISE * 100.0 * variance.sqrt(), 2e-2);
    near(end(&linear(&netlist)).deviation.value, RISE * 30.0, 1e-6);
}

/// Two bodies of the same P = 200 ± 20 W behind 0.5 and 0.4 K/W: the peaks are known to 8.6 and 7.9
/// K, their difference P (r1 - r2) to 20 W times that of the rises.
#[test]
fn analytic_what_two_candidates_share_cancels_in_their_difference() {
    let scatter = |r: &str| {
        let param = format!("R = \"{r}\"\nP = \"200 ± 20 W\"\nT_amb = \"20 ± 2 degC\"");
        let netlist = parsed(ONE_NODE, &param);
        let (parameters, run) = (netlist.overrides(), netlist.run.clone().unwrap());
        Scatter::of_run(&netlist.network, (&parameters, &run), "block").unwrap().unwrap()
    };
    let (one, two) = (scatter("0.5 K/W"), scatter("0.4 K/W"));
    let rise = 0.4 * -f64::exp_m1(-2.5);
    near(one.peak, f64::hypot(RISE * 20.0, 2.0), 1e-6);
    near(two.peak, f64::hypot(rise * 20.0, 2.0), 1e-6);
    let above = one.above(&two);
    near(above.by, 200.0 * (RISE - rise), 1e-6);
    near(above.deviation, 20.0 * (RISE - rise), 1e-5);
    assert!(above.probability > 0.999_999);
    let same = one.above(&one);
    assert_eq!((same.by, same.deviation, same.probability), (0.0, 0.0, 0.0));
}

/// The margin 60 K - P / G of P = 100 ± 5 W and air of 20 ± 2 degC that are correlated by 0.6 has
/// the variance 25 / G^2 + 4 + 12 / G; kept by 1.6449 deviations, by Brent's method
/// (SciPy 1.10).
#[test]
fn a_size_counts_correlations() {
    let text = "format = 1\n[param]\nG = \"1 W/K\"\nP = \"100 ± 5 W\"\nT_air = \"20 ± 2 degC\"\n\
         [node]\nblock = { C = \"1 kJ/K\", T0 = \"20 degC\" }\n[boundary]\n\
         air = { T = \"T_air\" }\n[resistor]\n\
         skin = { from = \"block\", to = \"air\", G = \"G\" }\n[source]\n\
         loss = { into = \"block\", P = \"P\" }\n[uncertainty]\n\
         correlation = { P = { T_air = 0.6 } }\n[size.s]\nminimise = \"G\"\n\
         vary = { G = { from = \"0.5 W/K\", to = \"50 W/K\" } }\n\
         require = [\"block.T <= 80 [degC]\"]\nprobability = \"95 %\"\n";
    let netlist = parse("a.toml", text).unwrap_or_else(|rejected| panic!("{rejected}"));
    let inputs = uncertain(&netlist.network, &netlist.overrides()).unwrap();
    let doubt = Some(Doubt { probability: 0.95, inputs: Some(&inputs) });
    let study = &netlist.studies.sizes[0];
    let (parameter, range) = study.ranges(&netlist.network).unwrap()[0];
    let demand = Demand { doubt, ..demand(&netlist) };
    let found = size(&SizeTask { demand, parameter, range, goal: study.goal }).unwrap();
    near(found.trial.value, CORRELATED, 1e-9);
    assert!(found.trial.judged.left_out[0].abs() < 1e-9);
}

const CORRELATED: f64 = 1.882_098_471_571_654_2;
