//! Whether laws of rise, time constant and power agree: against closed forms of the seed paper's
//! numbers, and against SciPy 1.17 (`stats.linregress`, `curve_fit`, the jackknife written out).
#![allow(clippy::unwrap_used, reason = "a test fails by panicking, in its helpers too")]

use std::f64::consts::TAU;

use lptn_fit::law::{Consistency, LawOf, Measured, StatedLaw};
use lptn_fit::step::Capacity;

const RPM: f64 = TAU / 60.0;

const SPEEDS: [f64; 14] = [
    1000.0, 1000.0, 2000.0, 2000.0, 3000.0, 3000.0, 4000.0, 4000.0, 5000.0, 5000.0, 6000.0, 6000.0,
    7000.0, 7000.0,
];

/// Close to 87 uW/rpm^(5/3).
const POWERS: [f64; 14] =
    [9.4, 8.1, 26.9, 28.6, 54.2, 53.0, 90.1, 86.5, 127.3, 126.0, 171.9, 175.2, 225.0, 221.4];

const ERRORS: [f64; 14] = [0.5, 0.5, 0.6, 0.6, 0.8, 0.8, 1.2, 1.2, 1.8, 1.8, 2.5, 2.5, 3.0, 3.0];

fn speeds() -> Vec<f64> {
    SPEEDS.iter().map(|n| n * RPM).collect()
}

#[track_caller]
fn near(value: f64, expected: f64, relative: f64) {
    assert!((value - expected).abs() <= relative * expected.abs(), "{value} is not {expected}");
}

fn stated(of: LawOf, text: &str) -> StatedLaw {
    StatedLaw::parse(of, text).unwrap()
}

/// The seed paper: Figures 7, 8, 9 and section 3.3.
fn paper(capacity: Option<Capacity>) -> Consistency {
    Consistency::of_laws(
        &stated(LawOf::Rise, "0.0084 ± 0.0011 K/rpm"),
        &stated(LawOf::TimeConstant, "18.6 ± 3.8 min"),
        &stated(LawOf::Power, "87 ± 15 uW/rpm^(5/3)"),
        capacity,
        (1000.0 * RPM, 7000.0 * RPM),
    )
    .unwrap()
}

const C_EQ: Capacity = Capacity { value: 2659.0, deviation: 0.0 };

/// peers.md 5.3, computed here from the paper's four numbers.
#[test]
fn the_papers_fits_contradict_each_other() {
    let found = paper(Some(C_EQ));
    near(found.implied.value, 1.0, 1e-12);
    near(found.power.value, 5.0 / 3.0, 1e-12);
    near(found.difference.value, -2.0 / 3.0, 1e-12);
    for (at, n) in [(found.at[0], 1000.0), (found.at[2], 7000.0)] {
        let power = 87e-6 * f64::powf(n, 5.0 / 3.0);
        near(at.rise, 0.0084 * n, 1e-12);
        near(at.time_constant, 18.6 * 60.0, 1e-12);
        near(at.implied, 2659.0 * 0.0084 * n / (18.6 * 60.0), 1e-12);
        near(at.power, power, 1e-12);
        near(at.needed, 2659.0 * 0.0084 * n / power, 1e-12);
    }
    // 20 and 140 W against 8.7 and 222.9 W; 43 and 11.7 min
    assert_eq!(found.at.map(|at| at.implied.round() as i64), [20, 53, 140]);
    near(found.at[0].power, 8.7, 1e-3);
    near(found.at[2].power, 222.85, 1e-4);
    near(found.at[0].needed / 60.0, 42.785, 1e-4);
    near(found.at[2].needed / 60.0, 11.69, 1e-3);
    // 7^(1/3): no common factor brings the ends closer
    near(found.spread(), 7_f64.cbrt(), 1e-12);
    assert!(found.exponents_contradict() && !found.agrees());
    // in the middle they agree within their errors
    let level = found.level.unwrap();
    let relative = f64::hypot(f64::hypot(0.0011 / 0.0084, 3.8 / 18.6), 15.0 / 87.0);
    near(level.relative_error.unwrap(), relative, 1e-12);
    assert!(!found.levels_contradict());
}

#[test]
fn without_a_capacity_the_exponents_still_contradict() {
    let found = paper(None);
    assert!(found.level.is_none() && found.exponents_contradict());
    near(found.at[1].implied, found.at[1].power, 1e-12);
    near(found.at[2].power / found.at[2].implied, 7_f64.cbrt(), 1e-12);
}

#[test]
fn laws_that_belong_together_agree() {
    let range = (1000.0 * RPM, 7000.0 * RPM);
    let rise = stated(LawOf::Rise, "0.026499 mK/rpm^(5/3)");
    let power = stated(LawOf::Power, "87 uW/rpm^(5/3)");
    let constant = stated(LawOf::TimeConstant, "809.9 s");
    let found = Consistency::of_laws(&rise, &constant, &power, Some(C_EQ), range).unwrap();
    assert!(found.agrees(), "{found:?}");
    // with a time constant that falls as the paper's would have to
    let falling = stated(LawOf::TimeConstant, "4278.5 min rpm^(2/3)");
    let rise = stated(LawOf::Rise, "0.0084 [K/rpm] * omega");
    let found = Consistency::of_laws(&rise, &falling, &power, Some(C_EQ), range).unwrap();
    near(found.time_constant.value, -2.0 / 3.0, 1e-12);
    near(found.rise.value, 1.0, 1e-12);
    assert!(found.agrees(), "{found:?}");
}

#[test]
fn a_wrong_capacity_shows_in_the_level() {
    let range = (1000.0 * RPM, 7000.0 * RPM);
    let laws = (
        stated(LawOf::Rise, "0.026499 ± 0.001 mK/rpm^(5/3)"),
        stated(LawOf::TimeConstant, "809.9 s"),
        stated(LawOf::Power, "87 uW/rpm^(5/3)"),
    );
    let capacity = Some(Capacity { value: 2.0 * 2659.0, deviation: 0.1 * 2659.0 });
    let found = Consistency::of_laws(&laws.0, &laws.1, &laws.2, capacity, range).unwrap();
    assert!(!found.exponents_contradict() && found.levels_contradict());
    near(found.level.unwrap().ratio, 2.0, 1e-4);
}

#[test]
fn laws_of_the_wrong_kind_are_refused() {
    let code = |of: LawOf, text: &str| StatedLaw::parse(of, text).unwrap_err().code();
    assert_eq!(code(LawOf::Rise, "0.0084 W/rpm"), "fit::law_dimension");
    assert_eq!(code(LawOf::TimeConstant, "18.6 K"), "fit::law_dimension");
    assert_eq!(code(LawOf::Power, "87 [uW/rpm] * omega^(5/3)"), "units::dimension");
    let same = stated(LawOf::TimeConstant, "18.6 min");
    let rise = stated(LawOf::Rise, "0.0084 K/rpm");
    let power = stated(LawOf::Power, "10 [W] - 0.01 [W/rpm] * omega");
    let range = (1000.0 * RPM, 7000.0 * RPM);
    let error = Consistency::of_laws(&rise, &same, &power, None, range).unwrap_err();
    assert_eq!(error.code(), "fit::law_not_positive");
    let power = stated(LawOf::Power, "10 W");
    let error = Consistency::of_laws(&rise, &same, &power, None, (7.0, 7.0)).unwrap_err();
    assert_eq!(error.code(), "fit::law_range");
}

const RISES: [f64; 14] =
    [2.7, 2.4, 7.9, 8.5, 16.2, 16.0, 26.9, 26.2, 38.7, 38.0, 51.6, 52.9, 67.9, 66.5];

const MINUTES: [f64; 14] =
    [13.1, 13.8, 13.6, 13.2, 13.4, 13.9, 13.3, 13.5, 13.6, 13.1, 13.4, 13.7, 13.2, 13.6];

/// SciPy 1.17: `stats.linregress` of the logarithms, the jackknife written out, `stats.t.sf`.
#[test]
fn points_are_compared_by_their_exponents() {
    let (speed, tau) = (speeds(), MINUTES.map(|t| 60.0 * t));
    let measured =
        Measured { speed: &speed, rise: &RISES, time_constant: &tau, power: &POWERS, errors: None };
    let found = Consistency::of_points(&measured, Some(C_EQ)).unwrap();
    near(found.rise.value, 1.684710603519554, 1e-9);
    near(found.rise.standard_error.unwrap(), 0.01279293371969863, 1e-9);
    near(found.time_constant.standard_error.unwrap(), 0.00835084230577686, 1e-9);
    near(found.power.value, 1.6667379065946584, 1e-9);
    near(found.difference.value, 0.01851097325214912, 1e-7);
    near(found.difference.standard_error.unwrap(), 0.00735844740527052, 1e-9);
    near(found.exponents.unwrap().probability, 0.02712706774086985, 1e-6);
    near(found.level.unwrap().ratio, 0.9848380093018377, 1e-9);
    near(found.level.unwrap().relative_error.unwrap(), 0.005422497779121122, 1e-9);
    assert!(!found.derived && found.exponents_contradict());
    // is the time constant constant, is the rise linear?
    assert!(found.claim(found.time_constant, 0.0).unwrap().probability > 0.9);
    assert!(found.claim(found.rise, 1.0).unwrap().probability < 1e-10);
}

const RISE_EXPONENT: (f64, f64) = (1.6817313258757811, 0.011853417026877288);
const POWER_EXPONENT: (f64, f64) = (1.669575585199757, 0.012876702894795103);

/// SciPy 1.17: `optimize.curve_fit` of the logarithms with `sigma` the relative errors and
/// `absolute_sigma`; chi^2 is 1.4 times the degrees of freedom, so that errors are larger by the
/// root of that.
#[test]
fn known_errors_weight_the_exponents() {
    let (speed, tau) = (speeds(), MINUTES.map(|t| 60.0 * t));
    let of_rise = RISES.map(|rise| 0.1 + 0.01 * rise);
    let of_tau = tau.map(|tau| 0.03 * tau);
    let errors = Some([&of_rise[..], &of_tau[..], &ERRORS[..]]);
    let measured =
        Measured { speed: &speed, rise: &RISES, time_constant: &tau, power: &POWERS, errors };
    let found = Consistency::of_points(&measured, Some(C_EQ)).unwrap();
    near(found.rise.value, RISE_EXPONENT.0, 1e-6);
    near(found.rise.standard_error.unwrap(), RISE_EXPONENT.1, 1e-6);
    near(found.power.value, POWER_EXPONENT.0, 1e-6);
    near(found.power.standard_error.unwrap(), POWER_EXPONENT.1, 1e-6);
}

#[test]
fn a_power_that_was_computed_from_the_others_tells_nothing() {
    let (speed, tau) = (speeds(), MINUTES.map(|t| 60.0 * t));
    let power: Vec<f64> = RISES.iter().zip(tau).map(|(rise, tau)| 2659.0 * rise / tau).collect();
    let measured =
        Measured { speed: &speed, rise: &RISES, time_constant: &tau, power: &power, errors: None };
    let found = Consistency::of_points(&measured, Some(C_EQ)).unwrap();
    assert!(found.derived && found.agrees() && found.exponents.is_none());
    near(found.level.unwrap().ratio, 1.0, 1e-9);
    let few = Measured {
        speed: &speed[..4],
        rise: &RISES[..4],
        time_constant: &tau[..4],
        power: &power[..4],
        errors: None,
    };
    assert_eq!(Consistency::of_points(&few, None).unwrap_err().code(), "fit::law_too_few");
}
