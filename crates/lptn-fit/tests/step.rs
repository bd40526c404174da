//! Analytic and diagnostics: the step fit against closed forms, the paper's arithmetic and SciPy.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use lptn_analysis::RunAnalysis;
use lptn_assembly::ThermalSystem;
use lptn_fit::step::{
    Capacity, Lack, ModelBias, Power, ReferenceTemperature, Sensor, StepError, StepFit,
};
use lptn_netlist::parse;
use lptn_network::Time;
use lptn_reduce::port;

#[track_caller]
fn near(found: f64, expected: f64, relative: f64) {
    assert!((found - expected).abs() <= relative * expected.abs(), "{found:e} is not {expected:e}");
}

fn times(count: u32, spacing: f64) -> Vec<f64> {
    (0..count).map(|i| f64::from(i) * spacing).collect()
}

fn curve(times: &[f64], [initial, settled, tau]: [f64; 3]) -> Vec<f64> {
    times.iter().map(|t| settled + (initial - settled) * (-t / tau).exp()).collect()
}

/// A fixed zigzag in place of noise: its sum is about 0, and it has no slow part.
fn zigzag(values: &[f64], size: f64) -> Vec<f64> {
    values.iter().enumerate().map(|(i, v)| v + [size, -size, -size, size][i % 4]).collect()
}

/// The paper's numbers at 7000 rpm: 2659 J/K and 13.5 min are 0.3046 K/W, and 67.2 K are 220.6 W.
fn paper() -> (Vec<f64>, StepFit) {
    let t = times(301, 5.0);
    let fit = StepFit::new(&t, &zigzag(&curve(&t, [25.5, 92.7, 810.0]), 1e-7)).unwrap();
    (t, fit)
}

const C_EQ: Capacity = Capacity { value: 2659.0, deviation: 0.0 };

#[test]
fn the_papers_arithmetic() {
    let (_, fit) = paper();
    near(fit.tau.value, 810.0, 1e-8);
    near(fit.initial.value, 25.5, 1e-8);
    near(fit.settled.value, 92.7, 1e-8);
    let power = Power::new(&fit, C_EQ, &ReferenceTemperature::Initial, Sensor::default()).unwrap();
    near(power.resistance.value, 0.3046, 1e-4);
    near(power.rise.value, 67.2, 1e-7);
    near(power.power.value, 220.6, 1e-4);
    near(power.power.value, 67.2 * 2659.0 / 810.0, 1e-7);
    // 58.8 K above the bed, as the fitted slope of 0.0084 K/rpm has it, are 12.5 % less
    let bed = Power::new(&fit, C_EQ, &ReferenceTemperature::Value(92.7 - 58.8), Sensor::default())
        .unwrap();
    near(bed.power.value / power.power.value, 0.875, 1e-6);
    assert_eq!((power.reference.as_str(), bed.reference.as_str()), ("initial", "value"));
}

#[test]
fn a_record_says_how_long_it_is() {
    let (t, fit) = paper();
    near(fit.time_constants(), 1500.0 / 810.0, 1e-8);
    assert!(fit.extrapolates());
    near(fit.beyond, 67.2 * (-1500.0_f64 / 810.0).exp(), 1e-6);
    let settled = StepFit::new(&t, &zigzag(&curve(&t, [25.5, 92.7, 300.0]), 1e-3)).unwrap();
    assert!(!settled.extrapolates());
}

/// Only the first time and the differences of times matter; cells without a value are left out.
#[test]
fn time_is_counted_from_the_first_row_and_gaps_are_left_out() {
    let (t, fit) = paper();
    let mut values = zigzag(&curve(&t, [25.5, 92.7, 810.0]), 1e-7);
    for i in [0, 1, 40, 41, 42, 43, 200] {
        values[i] = f64::NAN;
    }
    let later: Vec<f64> = t.iter().map(|t| t + 7200.0).collect();
    let again = StepFit::new(&later, &values).unwrap();
    assert_eq!((again.gaps, again.samples), (7, 294));
    near(again.initial.value, fit.initial.value, 1e-8);
    near(again.tau.value, 810.0, 1e-8);
}

/// The errors of P = C (T_f - T_i) / t_RC by hand, from the covariance of the three numbers.
#[test]
fn random_and_systematic_errors_stand_apart() {
    let t = times(301, 5.0);
    let fit = StepFit::new(&t, &zigzag(&curve(&t, [25.5, 92.7, 810.0]), 0.1)).unwrap();
    let capacity = Capacity { value: 2659.0, deviation: 0.05 * 2659.0 };
    let sensor = Sensor { class: 3.0, gain: 0.0 };
    let power = Power::new(&fit, capacity, &ReferenceTemperature::Initial, sensor).unwrap();
    let (rise, tau) = (fit.settled.value - fit.initial.value, fit.tau.value);
    let gradient = [-2659.0 / tau, 2659.0 / tau, -2659.0 * rise / (tau * tau)];
    let covariance = |i: usize, j: usize| fit.covariance().between(i, j).unwrap();
    let variance: f64 =
        (0..9).map(|at| gradient[at / 3] * covariance(at / 3, at % 3) * gradient[at % 3]).sum();
    near(power.power.random, variance.sqrt(), 1e-10);
    near(power.resistance.random, fit.tau.standard_error / 2659.0, 1e-12);
    // one sensor's offset drops out of T_f - T_i: the capacity alone is systematic
    near(power.power.systematic, 0.05 * power.power.value, 1e-12);
    near(power.rise.systematic, 0.0, 1e-12);
    // a rectangle of ± 3 K on two sensors: sqrt(2) 3 / sqrt(3) K
    let bed = vec![25.5; t.len()];
    let column = ReferenceTemperature::Column { name: "bed".into(), times: &t, temperatures: &bed };
    let apart = Power::new(&fit, capacity, &column, sensor).unwrap();
    near(apart.rise.systematic, 6_f64.sqrt(), 1e-12);
    let offset = 6_f64.sqrt() * 2659.0 / tau;
    near(apart.power.systematic, (0.05 * apart.power.value).hypot(offset), 1e-12);
    assert_eq!(apart.reference, "bed");
    near(apart.rise.value, fit.settled.value - 25.5, 1e-12);
}

/// A bed that warms by 8 K: its mean over the record is the reference, and its drift is told.
#[test]
fn the_mean_of_a_column_is_the_reference() {
    let (t, fit) = paper();
    let mut bed: Vec<f64> = t.iter().map(|t| 25.5 + 8.0 * t / 1500.0).collect();
    bed[17] = f64::NAN;
    bed[283] = f64::NAN;
    let column =
        ReferenceTemperature::Column { name: "mill_bed".into(), times: &t, temperatures: &bed };
    let power = Power::new(&fit, C_EQ, &column, Sensor::default()).unwrap();
    near(power.reference_temperature, 29.5, 1e-12);
    near(power.drift, 8.0, 1e-10);
    near(power.rise.value, 63.2, 1e-7);
    let empty = vec![f64::NAN; t.len()];
    let column =
        ReferenceTemperature::Column { name: "empty".into(), times: &t, temperatures: &empty };
    assert_eq!(
        Power::new(&fit, C_EQ, &column, Sensor::default()).unwrap_err().code(),
        "fit::no_reference"
    );
    let none = Capacity { value: 0.0, deviation: 0.0 };
    assert_eq!(
        Power::new(&fit, none, &ReferenceTemperature::Initial, Sensor::default())
            .unwrap_err()
            .code(),
        "fit::capacity"
    );
}

/// The shipped gearbox at 5 Hz for 25 minutes. The expected fit is SciPy's (`least_squares`, method
/// lm) of the closed form of the two nodes (eigenvectors by NumPy); C_sum R_eq = 2659 J/K x 67.2 K
/// / 220.6 W = 810 s.
#[test]
fn the_method_is_biased_on_the_gearbox() {
    let text = include_str!("../../../networks/gearbox.toml");
    let netlist = parse("gearbox.toml", text).unwrap_or_else(|rejected| panic!("{rejected}"));
    let system = ThermalSystem::assemble(&netlist.network).unwrap();
    let steel = port(system.network(), "steel").unwrap();
    let run = RunAnalysis::until(Time(60.0)).within(1e-7);
    // the record's clock does not matter
    let record: Vec<f64> = times(7501, 0.2).iter().map(|t| t + 36_000.0).collect();
    let bias = ModelBias::new(&system, steel, &run, (36_000.0, &record)).unwrap();
    near(bias.capacity, 2659.0, 1e-12);
    near(bias.tau.real, 2659.0 * 67.2 / 220.6, 1e-10);
    near(bias.tau.fitted, 793.011_775_25, 1e-7);
    near(bias.settled.real - 273.15, 92.7, 1e-10);
    near(bias.settled.fitted - 273.15, 92.671_840_67, 1e-7);
    near(bias.initial.real - 273.15, 25.5, 1e-10);
    near(bias.initial.fitted - 273.15, 25.957_759_48, 1e-6);
    near(bias.power.real, 220.6, 1e-10);
    near(bias.power.fitted, 223.694_965_76, 1e-7);
    near(bias.tau.bias(), 793.011_775_25 - 809.994_560_29, 1e-6);
    near(bias.rms, 0.019_202_63, 1e-5);
}

/// Regression: the times of a record that is cut were moved to the start of the run. From 900 s on
/// the fast mode of the gearbox (5.07 s) is gone, and the slow one is 793.952 560 57 s (eigenvalues
/// by NumPy, fit by SciPy's `curve_fit`).
#[test]
fn regression_a_record_that_is_cut_is_compared_with_the_same_part_of_the_run() {
    let text = include_str!("../../../networks/gearbox.toml");
    let netlist = parse("gearbox.toml", text).unwrap_or_else(|rejected| panic!("{rejected}"));
    let system = ThermalSystem::assemble(&netlist.network).unwrap();
    let steel = port(system.network(), "steel").unwrap();
    let record: Vec<f64> = times(301, 2.0).iter().map(|t| t + 36_900.0).collect();
    // the clock of the run does not matter either
    for start in [0.0, 17.3] {
        let run = RunAnalysis::until(Time(start + 60.0)).lasting(start, start + 60.0);
        let run = run.within(1e-7);
        let bias = ModelBias::new(&system, steel, &run, (36_000.0, &record)).unwrap();
        near(bias.tau.bias(), -16.041_999_72, 1e-4);
        near(bias.tau.fitted, 793.952_560_57, 1e-6);
        assert!(bias.settled.bias().abs() < 1e-4 && bias.initial.bias().abs() < 1e-5);
        near(bias.initial.real - 273.15, 71.223_811_50, 1e-6);
        // 2659 J/K x 67.2 K / t_RC: of the step, not of what is left of it
        near(bias.power.fitted, 225.057_275_3, 1e-5);
        assert!(bias.rms < 1e-5);
    }
}

fn refused(times: &[f64], values: &[f64]) -> StepError {
    StepFit::new(times, values).unwrap_err()
}

#[test]
fn bad_records_are_refused() {
    let t = times(400, 5.0);
    let rising = curve(&t, [25.5, 92.7, 810.0]);
    assert_eq!(refused(&t[..3], &rising[..3]).code(), "fit::too_few_points");
    assert_eq!(refused(&t, &[25.5; 400]).code(), "fit::flat");
    let straight: Vec<f64> = t.iter().map(|t| 25.5 + 0.01 * t).collect();
    let error = refused(&t, &straight);
    assert_eq!(error.code(), "fit::no_curvature");
    assert!(error.help().unwrap().contains("longer record"));
    let mut reversed = t.clone();
    reversed.swap(10, 11);
    assert_eq!(refused(&reversed, &rising).code(), "fit::not_a_record");
    assert_eq!(refused(&t, &rising[..7]).code(), "fit::not_a_record");
    assert_eq!(refused(&t, &[f64::NAN; 400]).code(), "fit::too_few_points");
    assert_eq!(refused(&[], &[]).code(), "fit::too_few_points");
}

/// An instrument that ends at 80 degC, and one that was started before the step.
#[test]
fn an_instrument_at_the_end_of_its_range_is_told() {
    let t = times(400, 5.0);
    let rising = curve(&t, [25.5, 92.7, 810.0]);
    let clipped: Vec<f64> = rising.iter().map(|v| v.min(80.0)).collect();
    let error = refused(&t, &clipped);
    assert_eq!(error.code(), "fit::saturated");
    // 80 degC is reached at 810 s ln(67.2 / 12.7)
    let StepError::Saturated { value, from, to, samples } = error else { panic!("{error}") };
    near(value, 80.0, 1e-15);
    assert_eq!((from, to, samples), (1350.0, 1995.0, 130));
    let late: Vec<f64> =
        t.iter().map(|t| curve(&[(t - 200.0_f64).max(0.0)], [25.5, 92.7, 810.0])[0]).collect();
    assert_eq!(refused(&t, &late).code(), "fit::saturated");
    // settled to within the logger's step: not saturated
    let settled: Vec<f64> =
        curve(&t, [25.5, 92.7, 150.0]).iter().map(|v| (v * 10.0).round() / 10.0).collect();
    let fit = StepFit::new(&t, &settled).unwrap();
    near(fit.resolution.unwrap(), 0.1, 1e-9);
    assert!(fit.coarse);
}

/// Fixed numbers between -1 and 1 that look like white noise: the fractional parts of 1e4 sin(i).
fn white(count: u32) -> Vec<f64> {
    (1..=count).map(|i| 2.0 * (1e4 * f64::from(i).sin()).rem_euclid(1.0) - 1.0).collect()
}

/// Regression: noise, and a jump between two samples, had a time constant.
#[test]
fn regression_what_tells_no_time_constant_has_none() {
    let t = times(301, 5.0);
    // ± 3.2 % of 810 s at 0.1 K of noise on 67.2 K by the covariance of independent samples, so 32
    // times as much noise is no time constant any more
    let noisy = |size: f64| -> Vec<f64> {
        curve(&t, [25.5, 92.7, 810.0]).iter().zip(white(301)).map(|(v, w)| v + size * w).collect()
    };
    assert!(StepFit::new(&t, &noisy(0.17)).is_ok());
    for seen in [noisy(100.0), white(301)] {
        match refused(&t, &seen) {
            error @ StepError::Undetermined { tau, lack: Lack::Interval { half_width } } => {
                assert!(half_width >= tau, "{error}");
                assert!(error.to_string().contains("does not determine t_RC"), "{error}");
            }
            StepError::Fit(error) => assert_eq!(error.code(), "fit::no_curvature"),
            error => panic!("{error}"),
        }
    }
    let jump = zigzag(&curve(&t, [20.0, 80.0, 0.8]), 0.05);
    let error = refused(&t, &jump);
    let StepError::Undetermined { tau, lack: Lack::Spacing { spacing } } = error else {
        panic!("{error}")
    };
    assert!(tau < 2.0 && (spacing - 5.0).abs() < 1e-12);
    assert!(error.to_string().contains("shorter than the distance of the samples"), "{error}");
    assert_eq!(error.code(), "fit::undetermined");
    assert!(error.help().unwrap().contains("more often"));
}
