//! Laws of power over speed, against NumPy 2.4 and SciPy 1.17 on the same points (`linalg.lstsq`,
//! `curve_fit`, `stats.linregress`, leaving out by brute force), and against closed forms.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking, in its helpers too")]

use std::f64::consts::TAU;

use lptn_fit::law::{
    ALIKE, Fitted, LawError, LawFit, LawStudy, LossLaw, Outcome, Points, WrittenLaw,
};
use lptn_units::{Dimension, parse_quantity};

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

fn points() -> Points {
    Points::new(speeds(), POWERS.to_vec(), None).unwrap()
}

#[track_caller]
fn near(value: f64, expected: f64, relative: f64) {
    assert!((value - expected).abs() <= relative * expected.abs(), "{value} is not {expected}");
}

fn of<'a>(study: &'a LawStudy, law: &str) -> &'a LawFit {
    study.candidates.iter().find(|c| c.law.to_string() == law).unwrap()
}

fn fit<'a>(study: &'a LawStudy, law: &str) -> &'a Fitted {
    of(study, law).fitted().unwrap()
}

#[test]
fn sums_of_powers_are_those_of_numpy() {
    let study = LawStudy::new(points(), LossLaw::standard());
    let single = fit(&study, "omega^(5/3)");
    near(single.coefficients[0].value * RPM.powf(5.0 / 3.0), 8.718965528610733e-5, 1e-10);
    near(
        single.coefficients[0].standard_error.unwrap() * RPM.powf(5.0 / 3.0),
        2.692005309552697e-7,
        1e-9,
    );
    near(single.rmse, 1.3795021574440414, 1e-10);
    near(single.leave_one_out.unwrap(), 1.5696545662144378, 1e-9);
    near(single.aicc.unwrap(), 14.099144091873455, 1e-9);
    let two = fit(&study, "omega + omega^3");
    near(two.coefficients[0].value * RPM, 0.015849977255859623, 1e-9);
    near(two.coefficients[1].value * RPM.powi(3), 3.4136081783140606e-10, 1e-9);
    near(two.coefficients[1].standard_error.unwrap() * RPM.powi(3), 2.40316986541426e-11, 1e-8);
    near(two.leave_one_out.unwrap(), 6.262908296207679, 1e-8);
    near(two.aicc.unwrap(), 55.22788460691681, 1e-9);
    let three = fit(&study, "omega + omega^(5/3) + omega^3");
    near(three.coefficients[1].value * RPM.powf(5.0 / 3.0), 8.799827769647028e-5, 1e-8);
    near(three.rmse, 1.372536358280474, 1e-9);
}

#[test]
fn the_free_exponent_is_that_of_scipy() {
    let study = LawStudy::new(points(), LossLaw::standard());
    let free = fit(&study, "omega^n");
    near(free.coefficient("P_top").unwrap().value, 223.52153200943403, 1e-7);
    near(free.coefficient("n").unwrap().value, 1.6715872234345928, 1e-7);
    near(free.coefficient("n").unwrap().standard_error.unwrap(), 0.014082403376661466, 1e-5);
    near(free.correlation[0][1], 0.5924997957153797, 1e-5);
    near(free.leave_one_out.unwrap(), 1.7372774097779633, 1e-6);
    near(free.aicc.unwrap(), 17.26612669726394, 1e-8);
}

#[test]
fn standard_errors_weight_and_never_shrink() {
    let points = Points::new(speeds(), POWERS.to_vec(), Some(ERRORS.to_vec())).unwrap();
    let study = LawStudy::new(points, LossLaw::standard());
    let single = fit(&study, "omega^(5/3)");
    near(single.coefficients[0].value * RPM.powf(5.0 / 3.0), 8.703230736635238e-5, 1e-10);
    near(
        single.coefficients[0].standard_error.unwrap() * RPM.powf(5.0 / 3.0),
        4.311392225701061e-7,
        1e-9,
    );
    near(single.squares, 17.643455106910523, 1e-9);
    near(single.rmse, 1.397511323999774, 1e-10);
    near(single.leave_one_out.unwrap(), 1.5319394624093707, 1e-9);
    // chi^2 / 11 of the sum of all three
    near(study.dispersion, 17.301154435154366 / 11.0, 1e-8);
    // chi^2 over it, and two parameters: the coefficient and the dispersion
    let expected = 17.643455106910523 / (17.301154435154366 / 11.0) + 4.0 + 12.0 / 11.0;
    near(single.aicc.unwrap(), expected, 1e-8);
    // errors ten times as large leave no dispersion, and the standard errors are those given
    let wide =
        Points::new(speeds(), POWERS.to_vec(), Some(ERRORS.map(|e| 10.0 * e).to_vec())).unwrap();
    let study = LawStudy::new(wide, LossLaw::standard());
    near(study.dispersion, 1.0, 0.0);
    let single = fit(&study, "omega^(5/3)");
    let alone: f64 =
        SPEEDS.iter().zip(ERRORS).map(|(n, e)| n.powf(10.0 / 3.0) / (100.0 * e * e)).sum();
    near(
        single.coefficients[0].standard_error.unwrap() * RPM.powf(5.0 / 3.0),
        alone.sqrt().recip(),
        1e-9,
    );
    near(single.aicc.unwrap(), 0.17643455106910523 + 2.0 + 4.0 / 12.0, 1e-8);
}

#[test]
fn the_verdict_says_by_how_much() {
    let study = LawStudy::new(points(), LossLaw::standard());
    assert_eq!(study.best().unwrap().law.to_string(), "omega^(5/3)");
    assert!(study.rivals().is_empty());
    assert_eq!(study.verdict(), "omega^(5/3) is best: the next, omega^n, is 3.2 AICc behind");
    let single: Vec<String> = study.single_powers().iter().map(|c| c.law.to_string()).collect();
    assert_eq!(single, ["omega^(5/3)", "omega", "omega^3"]);
    near(study.behind(of(&study, "omega")).unwrap(), 92.23876499082125 - 14.099144091873455, 1e-8);
    assert_eq!(study.least_leave_one_out().unwrap().law.to_string(), "omega^(5/3)");
}

#[test]
fn a_negative_coefficient_is_said_and_never_wins() {
    let study = LawStudy::new(points(), LossLaw::standard());
    let both = of(&study, "omega + omega^(5/3)");
    assert!(both.fitted().unwrap().coefficients[0].value < 0.0);
    assert_eq!(both.remark().unwrap(), "a coefficient is negative");
    assert!(!both.eligible());
    // its misses are fewer than the winner's all the same
    assert!(both.fitted().unwrap().rmse < study.best().unwrap().fitted().unwrap().rmse);
}

#[test]
fn laws_that_points_cannot_tell_apart_are_said() {
    // three speeds near each other, where all powers look alike
    let rpm = [3000.0, 3050.0, 3100.0, 3000.0, 3050.0, 3100.0, 3025.0, 3075.0];
    let wave = [1.0, -1.0, 0.5, -0.5, 0.8, -0.9, 0.2, -0.1];
    let power =
        rpm.iter().zip(wave).map(|(n, w)| 87e-6 * f64::powf(*n, 5.0 / 3.0) + 3.0 * w).collect();
    let points = Points::new(rpm.iter().map(|n| n * RPM).collect(), power, None).unwrap();
    let study = LawStudy::new(points, LossLaw::standard());
    let rivals: Vec<String> = study.rivals().iter().map(|c| c.law.to_string()).collect();
    assert!(!rivals.is_empty());
    assert!(study.rivals().iter().all(|c| study.behind(c).unwrap() < ALIKE));
    assert!(study.verdict().contains("cannot be distinguished"), "{}", study.verdict());
}

#[test]
fn too_few_points_are_said_and_not_hidden() {
    let few = |n: usize| Points::new(speeds()[..n].to_vec(), POWERS[..n].to_vec(), None).unwrap();
    // two points at one speed
    let study = LawStudy::new(few(2), LossLaw::standard());
    let sum = of(&study, "omega + omega^3");
    assert!(matches!(sum.outcome, Outcome::TooFew { needed: 2, points: 2, speeds: 1 }));
    assert_eq!(sum.remark().unwrap(), "too few different speeds: 1 for 2 coefficients");
    let three = of(&study, "omega + omega^(5/3) + omega^3");
    assert_eq!(three.remark().unwrap(), "too few points: 2 for 3 coefficients");
    // one coefficient and the variance leave nothing for the correction
    let one = of(&study, "omega");
    assert!(one.fitted().unwrap().aicc.is_none());
    assert!(one.remark().unwrap().starts_with("too few points for AICc"));
    assert!(study.best().is_none());
    assert_eq!(study.verdict(), "2 points are too few to choose a law");
    // a single point has a coefficient and no standard error
    let alone = LawStudy::new(few(1), LossLaw::standard());
    let one = fit(&alone, "omega");
    near(one.coefficients[0].value * RPM, 9.4 / 1000.0, 1e-12);
    assert!(one.coefficients[0].standard_error.is_none() && one.leave_one_out.is_none());
}

#[test]
fn points_without_noise_give_their_law_back() {
    let exact = SPEEDS.iter().map(|n| 0.003 * n + 2e-10 * n.powi(3)).collect();
    let study = LawStudy::new(Points::new(speeds(), exact, None).unwrap(), LossLaw::standard());
    assert_eq!(study.best().unwrap().law.to_string(), "omega + omega^3");
    let found = fit(&study, "omega + omega^3");
    near(found.coefficients[0].value * RPM, 0.003, 1e-10);
    near(found.coefficients[1].value * RPM.powi(3), 2e-10, 1e-10);
    assert!(found.aicc.unwrap().is_finite());
}

fn written(text: &str, starts: &[(&str, &str)]) -> Result<WrittenLaw, LawError> {
    let starts: Vec<_> = starts
        .iter()
        .map(|(name, text)| ((*name).to_owned(), parse_quantity(text, None).unwrap()))
        .collect();
    WrittenLaw::new(text, &points(), &starts)
}

fn fit_written(text: &str, starts: &[(&str, &str)]) -> LawFit {
    let law = LossLaw::Written(Box::new(written(text, starts).unwrap()));
    LawStudy::new(points(), vec![law]).candidates.remove(0)
}

#[test]
fn a_written_sum_is_the_sum() {
    let found = fit_written("a * omega + b * omega^3", &[]);
    let fit = found.fitted().unwrap();
    near(fit.coefficient("a").unwrap().value * RPM, 0.015849977255859623, 1e-9);
    near(fit.coefficient("b").unwrap().value * RPM.powi(3), 3.4136081783140606e-10, 1e-9);
    near(fit.leave_one_out.unwrap(), 6.262908296207679, 1e-8);
}

#[test]
fn written_laws_that_are_not_linear_are_those_of_scipy() {
    // Padé and exponential; start values are found from the largest power and speed
    let growing = fit_written("a * omega * exp(omega / b)", &[]);
    let fit = growing.fitted().unwrap();
    near(fit.coefficient("a").unwrap().value * RPM, 0.012526046322451655, 1e-6);
    near(fit.coefficient("b").unwrap().value / RPM, 7366.396440433265, 1e-6);
    near(fit.coefficient("b").unwrap().standard_error.unwrap() / RPM, 445.069048249554, 1e-4);
    near(fit.rmse, 4.119715350957898, 1e-8);
    let pade =
        fit_written("a * omega / (1 + omega / b)", &[("a", "20 mW/rpm"), ("b", "-20000 rpm")]);
    let fit = pade.fitted().unwrap();
    near(fit.coefficient("b").unwrap().value / RPM, -13095.12881544125, 1e-6);
    near(fit.rmse, 5.795480749275263, 1e-8);
    // what a user writes may have any sign
    assert!(pade.eligible());
}

/// The points grow, so that `exp(-omega / b)` wants a negative b, and from a positive start the
/// search runs off to b = infinity.
#[test]
fn regression_a_search_that_runs_off_to_infinity_has_no_coefficients() {
    let lost = fit_written("a * omega * exp(-omega / b)", &[]);
    assert!(!matches!(lost.outcome, Outcome::Fitted(_)), "{:?}", lost.outcome);
    let led = fit_written("a * omega * exp(-omega / b)", &[("b", "-5000 rpm")]);
    near(led.fitted().unwrap().coefficient("b").unwrap().value / RPM, -7366.396440433265, 1e-6);
}

#[test]
fn a_constant_part_is_no_coefficient() {
    let found = fit_written("0.5 [W] + a * omega^(5/3)", &[]);
    let (mut product, mut square) = (0.0, 0.0);
    for (n, p) in SPEEDS.iter().zip(POWERS) {
        let x = n.powf(5.0 / 3.0);
        product += x * (p - 0.5);
        square += x * x;
    }
    near(
        found.fitted().unwrap().coefficients[0].value * RPM.powf(5.0 / 3.0),
        product / square,
        1e-12,
    );
}

#[test]
fn units_of_written_laws_are_checked() {
    let code = |text: &str| written(text, &[]).unwrap_err().code();
    assert_eq!(code("a * omgea^"), "units::syntax");
    assert_eq!(code("3 [K] + a * omega"), "units::operands");
    assert_eq!(code("a * b * omega"), "fit::law_open_unit");
    assert_eq!(code("2 [N m] * omega"), "fit::law_no_coefficient");
    let open = written("a * b * omega", &[]).unwrap_err();
    assert_eq!(
        open.help().unwrap(),
        "give it a start value with its unit, for example --start \"a = 20 mW/rpm\""
    );
    // one start value settles both
    let law = written("a * b * omega", &[("a", "20 mW/rpm")]).unwrap();
    assert_eq!(law.coefficients()[1], ("b".to_owned(), Dimension::NONE));
}

#[test]
fn points_out_of_range_are_refused() {
    let code = |speed: f64, power: f64, sigma: Option<f64>| {
        Points::new(vec![speed], vec![power], sigma.map(|s| vec![s])).unwrap_err().code()
    };
    assert_eq!(code(0.0, 1.0, None), "fit::law_speed");
    assert_eq!(code(-1.0, 1.0, None), "fit::law_speed");
    assert_eq!(code(1.0, f64::NAN, None), "fit::law_power");
    assert_eq!(code(1.0, 1.0, Some(0.0)), "fit::law_deviation");
    assert_eq!(Points::new(vec![], vec![], None).unwrap_err().code(), "fit::law_no_points");
    assert_eq!(Points::new(vec![1.0], vec![], None).unwrap_err().code(), "fit::law_lengths");
}
