//! Lines of rise and time constant over the speed, and the differences between columns: against
//! NumPy 2.4 and SciPy 1.17 on the rises and time constants that the records were made of
//! (`stats.linregress`, `stats.ttest_rel`; least squares, HC2 and the degrees of freedom of Bell and
//! McCaffrey with whole matrices).
#![allow(clippy::unwrap_used, reason = "a test fails by panicking, in its helpers too")]

use crate::runs;

use lptn_fit::law::{Estimate, RunsStudy};

use runs::{Course, RPM, record, settings};

const SPEEDS: [f64; 7] = [1000.0, 2000.0, 3000.0, 4000.0, 5000.0, 6000.0, 7000.0];
const RING: ([f64; 7], [f64; 7]) =
    ([9.1, 15.5, 27.0, 31.0, 44.5, 48.2, 61.0], [17.0, 21.5, 16.2, 19.8, 22.4, 15.1, 18.2]);
const HOUSING: ([f64; 7], [f64; 7]) =
    ([8.0, 13.1, 24.2, 27.0, 40.1, 42.3, 53.5], [16.1, 20.2, 15.9, 18.1, 21.3, 13.8, 17.5]);

/// Rises of the ring are these much larger.
fn study(speeds: &[f64], more: f64, noise: f64) -> RunsStudy {
    let course = |of: ([f64; 7], [f64; 7]), i: usize, more: f64| Course {
        rise: of.0[i] + more,
        time_constant: 60.0 * of.1[i],
        noise,
    };
    let run = |(i, speed): (usize, &f64)| {
        let columns = [("ring", course(RING, i, more)), ("housing", course(HOUSING, i, 0.0))];
        record(speed * RPM, &columns, i as u128)
    };
    let runs: Vec<_> = speeds.iter().enumerate().map(run).collect();
    let columns = ["ring", "housing"];
    RunsStudy::new(&runs, settings(&columns, vec![])).unwrap()
}

/// Value, standard error, half width and probability, times a scale.
#[track_caller]
fn is(found: Option<Estimate>, scale: f64, [value, error, half, chance]: [f64; 4]) {
    let found = found.unwrap();
    let near = |found: f64, expected: f64, of: f64| {
        assert!((found - expected).abs() <= 1e-3 * of.abs(), "{found} is not {expected}");
    };
    near(found.value * scale, value, error);
    near(found.standard_error * scale, error, error);
    near(found.half_width * scale, half, half);
    near(found.probability, chance, 3.0 * chance);
}

#[test]
fn reference_lines_of_columns_are_those_of_scipy() {
    let found = study(&SPEEDS, 0.0, 1e-4);
    let [ring, housing] = &found.lines[..] else { panic!("{:?}", found.lines) };
    assert_eq!((&*ring.column, &*housing.column), ("ring", "housing"));
    is(
        ring.rise,
        RPM,
        [0.008455714285714287, 0.00018151291627735528, 0.0006470758206026685, 1.7015968e-5],
    );
    is(
        housing.rise,
        RPM,
        [0.0074542857142857145, 0.0001905737845217406, 0.000633424236677589, 2.39315629e-5],
    );
    let minutes = 1.0 / 60.0;
    is(ring.time_constant, minutes, [18.6, 1.0353283353143397, 2.53335717350686, 1.9128958e-6]);
    is(
        ring.time_slope,
        RPM * minutes,
        [-0.00010714285714285754, 0.0005650446975276218, 0.001595141287729612, 0.8570655614],
    );
}

/// Both columns of a run share its scatter, which is out of the differences.
#[test]
fn reference_differences_are_paired_as_in_scipy() {
    let found = study(&SPEEDS, 0.0, 1e-4);
    let [difference] = &found.differences[..] else { panic!("{:?}", found.differences) };
    assert_eq!((&*difference.of, &*difference.less), ("ring", "housing"));
    is(
        difference.rise,
        RPM,
        [0.0010014285714285717, 3.142857142857144e-5, 0.00012089995551896558, 7.50021949e-5],
    );
    is(
        difference.time_constant,
        1.0 / 60.0,
        [1.042857142857142, 0.17300859166271387, 0.4233367732893969, 0.00094142781],
    );
}

/// `stats.linregress` of logarithms, and Student's t of its slope less 1.
#[test]
fn reference_a_rise_that_is_no_proportion_is_told() {
    let exponent = |more: f64| study(&SPEEDS, more, 1e-4).lines[0].exponent.unwrap();
    let (possible, chance) = exponent(0.0);
    assert!((possible.value - 0.9810773988).abs() < 1e-4, "{possible:?}");
    assert!((chance.probability - 0.69708994).abs() < 1e-3, "{chance:?}");
    let (refuted, chance) = exponent(12.0);
    assert!((refuted.value - 0.6391861175).abs() < 1e-4, "{refuted:?}");
    assert!((chance.probability / 6.6187635e-4 - 1.0).abs() < 1e-2, "{chance:?}");
}

/// Runs without scatter are no proof of a slope without error: that of the noise of each run.
#[test]
fn analytic_errors_are_no_less_than_the_noise_of_the_records() {
    let runs: Vec<_> = (1..=7)
        .map(|i| {
            let speed = 1000.0 * f64::from(i) * RPM;
            let course = Course { rise: 0.01 / RPM * speed, time_constant: 900.0, noise: 0.0 };
            record(speed, &[("ring", course)], 0)
        })
        .collect();
    let mut noisy = runs.clone();
    // the same noise in every run: slopes scatter by far less than each of them is uncertain
    let noise = record(RPM, &[("ring", Course { rise: 0.0, time_constant: 900.0, noise: 0.2 })], 5);
    for run in &mut noisy {
        let noise = &noise.columns[0].1;
        run.columns[0].1.iter_mut().zip(noise).for_each(|(t, n)| *t += n - 298.15);
    }
    let found = RunsStudy::new(&noisy, settings(&["ring"], vec![])).unwrap();
    let fits = &found.columns[0].fits;
    let known: f64 = fits.iter().map(|f| f.fit.tau.standard_error.powi(2)).sum();
    let mean = found.lines[0].time_constant.unwrap();
    assert!(mean.standard_error >= 0.999 * known.sqrt() / 7.0, "{mean:?} {known}");
    let squares: f64 = found.runs.iter().map(|run| run.1 * run.1).sum();
    let known = fits.iter().zip(&found.runs).map(|(f, run)| (run.1 * f.power.rise.random).powi(2));
    let slope = found.lines[0].rise.unwrap();
    assert!(slope.standard_error >= 0.999 * known.sum::<f64>().sqrt() / squares, "{slope:?}");
}

#[test]
fn two_runs_and_one_speed_have_no_slope() {
    let two = study(&SPEEDS[..2], 0.0, 1e-4);
    assert!(two.lines[0].rise.is_none() && two.lines[0].time_slope.is_none());
    assert!(two.differences[0].rise.is_none() && two.lines[0].exponent.is_none());
    assert!(two.lines[0].time_constant.is_some() && two.differences[0].time_constant.is_some());
    let same = study(&[3000.0; 5], 0.0, 1e-4);
    assert!(same.lines[0].rise.is_none() && same.lines[0].time_slope.is_none());
    assert!(same.lines[0].time_constant.is_some());
    let one = study(&SPEEDS[..1], 0.0, 1e-4);
    assert!(one.lines[0].time_constant.is_none());
}
