//! Property: intervals hold the truth as often as they say, and noise alone asks for nothing more.

use crate::records;

use records::{Truth, coverage};

/// 2000 records with noise that a plain AR(1) correction covers in 87 %, and independent samples in
/// 35 %.
#[test]
fn intervals_hold_the_truth_in_95_of_100_records() {
    let fits = Truth::PAPER.fits(2000);
    let covered = coverage(&Truth::PAPER, &fits);
    assert!(covered.iter().all(|part| (92.0..=98.0).contains(part)), "{covered:?}");
    // a second exponential is asked for where there is none in at most one record of a hundred
    let alarms = fits.iter().filter(|fit| fit.second.offer.is_some()).count();
    assert!(alarms <= 20, "{alarms}");
    // the logger's step is found in each
    assert!(fits.iter().all(|fit| fit.resolution.is_some_and(|step| (step - 0.1).abs() < 1e-9)));
    assert!(fits.iter().all(|fit| !fit.coarse && fit.extrapolates()));
}

/// Other noise, steps and lengths, with 150 records each: 95 % less four standard deviations of the
/// binomial distribution are 87.9 %. The example `coverage` has more of both.
#[test]
fn intervals_are_not_tuned_to_one_point() {
    let paper = Truth::PAPER;
    for truth in [
        Truth { rho: 0.5, step: 0.01, ..paper },
        Truth { rho: 0.99, ..paper },
        Truth { curve: [25.5, 92.7, 1150.0], ..paper },
        Truth { samples: 1500, spacing: 1.0, curve: [25.5, 92.7, 300.0], ..paper },
        // a hall that cycles, and few samples that follow each other
        Truth { drift: (0.1, 300.0), ..paper },
        // as slow as the record, so that the curve takes it up
        Truth { drift: (0.05, 1000.0), ..paper },
        Truth { samples: 30, spacing: 50.0, rho: 0.5, ..paper },
        Truth { tails: 3.0, ..paper },
    ] {
        let covered = coverage(&truth, &truth.fits(150));
        assert!(covered.iter().all(|part| (87.9..=100.0).contains(part)), "{truth:?}: {covered:?}");
    }
}

/// A logger's step of five deviations of slow noise: every record says that its residuals are little
/// more than rounding.
#[test]
fn a_coarse_record_says_so() {
    let truth = Truth { rho: 0.99, step: 0.5, ..Truth::PAPER };
    assert!(truth.fits(20).iter().all(|fit| fit.coarse));
}

/// A second exponential of 2 K and one minute is found in 30 records of 30, and its intervals hold
/// the truth.
#[test]
fn a_second_exponential_is_offered_where_there_is_one() {
    let truth = Truth { second: (-2.0, 60.0), ..Truth::PAPER };
    let fits = truth.fits(30);
    let offers: Vec<_> = fits.iter().filter_map(|fit| fit.second.offer.as_ref()).collect();
    assert_eq!(offers.len(), 30);
    let holds = |e: &lptn_fit::step::Estimated, v: f64| (e.value - v).abs() <= e.half_width;
    let inside = |what: &str, count: usize| assert!(count >= 24, "{what}: {count} of 30");
    inside("t_1", offers.iter().filter(|two| holds(&two.taus[0], 810.0)).count());
    inside("t_2", offers.iter().filter(|two| holds(&two.taus[1], 60.0)).count());
    inside("A_2", offers.iter().filter(|two| holds(&two.amplitudes[1], -2.0)).count());
    inside("T_f", offers.iter().filter(|two| holds(&two.settled, 92.7)).count());
}

/// Drift of 0.2 K over 1000 s is nearly as slow as the curve: records say that it may be there, and
/// their intervals are wider than the quantile of white noise makes them.
#[test]
fn slow_drift_is_counted() {
    let drifting = Truth { drift: (0.2, 1000.0), ..Truth::PAPER }.fits(40);
    let known = drifting.iter().filter(|fit| fit.noise.drifts());
    assert!(known.clone().count() >= 34, "{}", known.count());
    // as many degrees of freedom as 100 means have would be 97
    let few = known.clone().filter(|fit| fit.tau.degrees_of_freedom < 20.0).count();
    assert!(2 * few > known.count(), "{few}");
    // noise over 20 s is no such drift
    let fast = Truth { rho: 0.99, ..Truth::PAPER }.fits(40);
    assert!(fast.iter().filter(|fit| fit.noise.drifts()).count() <= 5);
}
