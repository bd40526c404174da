//! Records that differ by more than their noise tells, as runs of a machine do that is mounted anew
//! each time.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use lptn_fit::network::{FittedParameter, NetworkFitTask, fit_network};
use lptn_netlist::parse_with;
use lptn_solve::{available_threads, in_parallel};
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64;

/// Of how many records, how far their resistance scatters about 0.3 K/W in parts of itself, and
/// their noise in K, drift over 1000 s beside it.
#[derive(Clone, Copy)]
struct Bench {
    records: usize,
    scatter: f64,
    noise: f64,
    drift: f64,
}

const EVEN: Bench = Bench { records: 8, scatter: 0.0, noise: 0.1, drift: 0.0 };

/// A body of 2659 J/K that 220.6 W heat, in records of 25 min.
fn records(seed: u32, bench: Bench) -> Vec<String> {
    const STEP: f64 = 15.0;
    let mut random = Pcg64::new(31 + u128::from(seed), 0x0a02_bdbf_7bb3_c0a7_ac28_fa16_a64a_bf96);
    let mut normal = || -> f64 { StandardNormal.sample(&mut random) };
    let decay = (-STEP / 1000.0_f64).exp();
    let mut record = || {
        let resistance = 0.3 * (1.0 + bench.scatter * normal());
        let mut drift = bench.drift * normal();
        let row = |k: i32| {
            let t = STEP * f64::from(k);
            let rise = -220.6 * resistance * f64::exp_m1(-t / (resistance * 2659.0));
            drift = decay * drift + bench.drift * (1.0 - decay * decay).sqrt() * normal();
            format!("{t},{}\n", 25.0 + rise + drift + bench.noise * normal())
        };
        format!("t [s],tc [degC]\n{}", (0..100).map(row).collect::<String>())
    };
    (0..bench.records).map(|_| record()).collect()
}

fn fitted(records: &[String]) -> Vec<FittedParameter> {
    let data: Vec<String> = (0..records.len()).map(|k| format!("\"{k}.csv\"")).collect();
    let text = format!(
        "format = 1\n[param]\nR = \"0.25 K/W\"\nC = \"2500 J/K\"\n[node]\nbody = {{ C = \"C\", T0 = \
         \"25 degC\" }}\n[boundary]\nroom = {{ T = \"25 degC\" }}\n[resistor]\nskin = {{ from = \
         \"body\", to = \"room\", R = \"R\" }}\n[source]\nheat = {{ into = \"body\", P = \"220.6 W\" \
         }}\n[fit.all]\ndata = [{}]\ncolumn = {{ tc = \"body.T\" }}\nvary = [\"R\", \"C\"]\n",
        data.join(", ")
    );
    let read = &mut |path: &std::path::Path| {
        let place: usize = path.file_stem().unwrap().to_str().unwrap().parse().unwrap();
        Ok(records[place].clone().into_bytes())
    };
    let netlist =
        parse_with("body.toml", &text, read).unwrap_or_else(|rejected| panic!("{rejected}"));
    let task = NetworkFitTask::of(&netlist, &netlist.studies.fits[0], 1).unwrap();
    fit_network(&task).unwrap().parameters
}

/// Each record tells equally much of R, so R is the mean of what each says alone, with the standard
/// error of a mean of eight.
#[test]
fn analytic_a_resistance_that_scatters_has_the_error_of_a_mean() {
    let records = records(1, Bench { scatter: 0.05, ..EVEN });
    let alone: Vec<f64> =
        records.iter().map(|record| fitted(std::slice::from_ref(record))[0].value).collect();
    let count = records.len() as f64;
    let mean = alone.iter().sum::<f64>() / count;
    let squares: f64 = alone.iter().map(|value| (value - mean).powi(2)).sum();
    let error = (squares / (count * (count - 1.0))).sqrt();
    let found = fitted(&records)[0].clone();
    assert!((found.value - mean).abs() < 0.2 * error, "{} {mean}", found.value);
    let between = found.between.unwrap();
    assert!(between.differ, "{between:?}");
    assert!((between.standard_error / error - 1.0).abs() < 0.1, "{between:?} {error}");
    assert!((between.degrees_of_freedom - 7.0).abs() < 0.1, "{between:?}");
    assert!((found.standard_error.unwrap() - between.standard_error).abs() < 1e-12);
    // 2.3646 is the quantile of Student's t with 7 degrees of freedom
    let wide = found.half_width.unwrap() / between.standard_error;
    assert!((wide - 2.364_6).abs() < 0.02, "{wide}");
}

/// In how many of 100 sets of records the intervals of R and C hold the truth, and in how many the
/// records are told to differ in R.
fn held(bench: Bench, sets: u32) -> [f64; 3] {
    let seeds: Vec<u32> = (0..sets).collect();
    let fits = in_parallel(&seeds, available_threads(), |&seed| {
        let found = fitted(&records(1000 + seed, bench));
        let held =
            |i: usize, truth: f64| (found[i].value - truth).abs() <= found[i].half_width.unwrap();
        [held(0, 0.3), held(1, 2659.0), found[0].between.is_some_and(|between| between.differ)]
    });
    let of = |k: usize| fits.iter().filter(|fit| fit[k]).count() as f64;
    [0, 1, 2].map(|k| 100.0 * of(k) / f64::from(sets))
}

#[test]
fn records_that_differ_are_told_and_others_are_not() {
    assert!(held(EVEN, 20)[2] <= 5.0);
    let apart = held(Bench { scatter: 0.02, ..EVEN }, 20);
    assert!(apart[2] >= 100.0 && apart[0] >= 85.0, "{apart:?}");
}

#[test]
#[ignore = "takes minutes: cargo test --release -p lptn-fit --test all between:: -- --ignored --nocapture"]
fn intervals_hold_where_records_differ_and_where_they_do_not() {
    let drifting = |records: usize| Bench { records, noise: 0.02, drift: 0.05, scatter: 0.0 };
    let mut all = vec![Bench { records: 2, ..EVEN }, drifting(2)];
    for records in [3, 4, 8, 14] {
        for scatter in [0.0, 0.001, 0.002, 0.005, 0.05] {
            all.push(Bench { records, scatter, ..EVEN });
        }
        all.push(drifting(records));
    }
    for bench in all {
        let held = held(bench, 1000);
        println!(
            "{:3} records, R scatters by {:.1} %, drift of {} K: R {:.1} %, C {:.1} %, told {:.1} %",
            bench.records,
            100.0 * bench.scatter,
            bench.drift,
            held[0],
            held[1],
            held[2]
        );
    }
}
