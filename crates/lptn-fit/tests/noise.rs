//! Reference: noise against a dense restricted likelihood and SciPy's quantiles.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use lptn_fit::Covariance;
use lptn_fit::noise::{Noise, resolution};
use lptn_units::statistics::student_95;

/// 60 samples, 2 s apart with a gap of 22 s before the 36th: noise around a straight line.
const SAMPLES: [f64; 60] = [
    7.04, 4.12, 5.20, 4.67, 4.57, 4.68, 3.27, 4.03, 3.76, 7.10, 6.24, 5.72, 5.51, 5.05, 4.48, 4.70,
    5.45, 5.27, 6.25, 5.80, 5.89, 7.15, 6.99, 6.21, 6.11, 6.58, 7.93, 6.88, 6.54, 7.32, 6.13, 6.11,
    6.96, 7.12, 6.91, 7.48, 4.92, 6.83, 5.92, 5.06, 6.16, 6.96, 6.53, 5.93, 6.52, 6.69, 8.03, 8.21,
    8.01, 8.72, 8.01, 7.16, 7.92, 8.21, 7.77, 7.15, 7.65, 5.62, 7.24, 7.70,
];

/// Times, what the straight line of least squares misses, and its derivatives.
fn line() -> (Vec<f64>, Vec<f64>, Vec<f64>) {
    let times: Vec<f64> =
        (0..60).map(|i| f64::from(2 * i + if i >= 35 { 20 } else { 0 })).collect();
    let (t, v) = (times.iter().sum::<f64>() / 60.0, SAMPLES.iter().sum::<f64>() / 60.0);
    let square: f64 = times.iter().map(|x| (x - t) * (x - t)).sum();
    let product: f64 = times.iter().zip(SAMPLES).map(|(x, y)| (x - t) * (y - v)).sum();
    let residuals =
        times.iter().zip(SAMPLES).map(|(x, y)| v + product / square * (x - t) - y).collect();
    let jacobian = std::iter::repeat_n(1.0, 60).chain(times.iter().copied()).collect();
    (times, residuals, jacobian)
}

#[track_caller]
fn near(found: f64, expected: f64, relative: f64) {
    assert!((found / expected - 1.0).abs() < relative, "{found} is not {expected}");
}

/// NumPy 2.4.6 and SciPy 1.17.1: the restricted likelihood with dense Cholesky factors, minimised
/// by Nelder-Mead to 1e-9; then the sandwich with the dense covariance. Here the likelihood is
/// maximised to 1e-3 of its logarithm, which moves its flat maximum by some per cent.
#[test]
fn noise_is_that_of_a_dense_likelihood() {
    let (times, residuals, jacobian) = line();
    let noise = Noise::estimate(&times, &residuals, &jacobian);
    assert_eq!((noise.samples, noise.stretch), (60, 1));
    near(noise.deviation, 0.948_597_906, 1e-8);
    near(noise.means.time, 6.044_700, 0.03);
    near(noise.means.correlated, 0.624_605, 0.03);
    near(noise.means.deviation, 0.991_607_261, 0.01);
    near(noise.effective, 14.391_361, 0.03);
    let bread = Covariance::inverse(&jacobian, 60, &[0, 1]).unwrap();
    let covariance = bread.sandwich(&noise.middle(&times, &jacobian).values);
    near(covariance.standard_error(0).unwrap(), 0.459_012_48, 0.02);
    near(covariance.standard_error(1).unwrap(), 0.005_661_39, 0.02);
    // slow noise leaves fewer degrees of freedom than samples
    let degrees = noise.middle(&times, &jacobian).degrees_of_freedom(&bread, &[0.0, 1.0]);
    assert!((2.0..30.0).contains(&degrees), "{degrees}");
}

/// Residuals that alternate are not slow noise; white noise has the plain covariance.
#[test]
fn fast_noise_is_white() {
    let times: Vec<f64> = (0..200).map(f64::from).collect();
    let residuals: Vec<f64> = (0..200).map(|i| if i % 2 == 0 { 0.3 } else { -0.3 }).collect();
    let jacobian = vec![1.0; 200];
    let noise = Noise::estimate(&times, &residuals, &jacobian);
    near(noise.deviation, 0.3 * (200.0_f64 / 199.0).sqrt(), 1e-12);
    assert!(noise.means.time.abs() < 1e-12 && noise.means.correlated.abs() < 1e-12, "{noise:?}");
    let middle = noise.middle(&times, &jacobian);
    near(middle.values[0], 200.0 * 0.09 * 200.0 / 199.0, 1e-12);
    let bread = Covariance::inverse(&jacobian, 200, &[0]).unwrap();
    near(middle.degrees_of_freedom(&bread, &[1.0]), 199.0, 1e-12);
}

/// Residuals that are all 0 have no noise, and nothing breaks.
#[test]
fn a_perfect_fit_has_no_noise() {
    let (times, _, jacobian) = line();
    let noise = Noise::estimate(&times, &[0.0; 60], &jacobian);
    assert!(noise.deviation.abs() < 1e-300 && noise.means.deviation.abs() < 1e-300, "{noise:?}");
    assert!(noise.middle(&times, &jacobian).values.iter().all(|v| v.abs() < 1e-300));
}

/// `scipy.stats.t.ppf(0.975, n)`, SciPy 1.17.1.
#[test]
fn quantiles_are_those_of_scipy() {
    for (degrees, expected) in [
        (1.0, 12.706_204_736),
        (2.0, 4.302_652_729_7),
        (2.5, 3.574_654_842_0),
        (3.0, 3.182_446_305_3),
        (4.0, 2.776_445_105_2),
        (5.0, 2.570_581_835_6),
        (7.0, 2.364_624_251_6),
        (10.0, 2.228_138_852_0),
        (30.0, 2.042_272_456_3),
        (100.0, 1.983_971_518_5),
        (1e4, 1.960_201_239_9),
        (f64::INFINITY, 1.959_963_984_5),
    ] {
        near(student_95(degrees), expected, if degrees < 3.0 { 3e-3 } else { 1e-4 });
    }
}

#[test]
fn the_step_of_a_logger_is_found() {
    let rounded = |step: f64| -> Vec<f64> {
        (0..500)
            .map(|i| {
                (60.0 * (1.0 - f64::from(-i).exp2().powf(0.01)) / step).round() * step + 273.15
            })
            .collect()
    };
    for step in [0.01, 0.1, 0.25, 0.5, 1.0 / 1.8] {
        near(resolution(&rounded(step)).unwrap(), step, 1e-9);
    }
    assert_eq!(resolution(&(0..500).map(|i| f64::from(i).sqrt()).collect::<Vec<f64>>()), None);
    assert_eq!(resolution(&[1.0, 1.0, 1.0]), None);
    assert_eq!(resolution(&[]), None);
    // gaps are not values
    near(resolution(&[1.0, f64::NAN, 1.5, 2.5]).unwrap(), 0.5, 1e-12);
}
