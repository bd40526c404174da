//! Property: the 95 % intervals of fits of networks hold the truth as often as they say.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::body;

use body::Noise;
use lptn_fit::network::{FittedParameter, NetworkFitTask, fit_network};
use lptn_netlist::parse_with;
use lptn_solve::{available_threads, in_parallel};
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64;

const TRUTH: [f64; 2] = [0.3, 2659.0];

const fn noise(kept: f64) -> Noise {
    Noise::kept(kept)
}

/// In how many percent of so many fits the interval of each parameter holds the truth.
fn covered(count: u32, samples: (u32, f64), noise: Noise) -> [f64; 2] {
    let seeds: Vec<u32> = (0..count).collect();
    let fits = in_parallel(&seeds, available_threads(), |&seed| {
        body::fitted(seed, TRUTH, (samples, noise))
    });
    let holds = |p: &FittedParameter, truth: f64| (p.value - truth).abs() <= p.half_width.unwrap();
    std::array::from_fn(|k| {
        let inside = fits.iter().filter(|fit| holds(&fit[k], TRUTH[k])).count();
        100.0 * inside as f64 / f64::from(count)
    })
}

/// 95 % less four standard deviations of the binomial distribution of 200 records are 88.8 %.
#[test]
fn intervals_hold_the_truth() {
    for (samples, noise) in [
        ((8, 200.0), noise(0.0)),
        ((60, 25.0), noise(0.0)),
        ((300, 5.0), noise(0.9)),
        ((300, 5.0), Noise { drift: (0.05, 1000.0), ..noise(0.0) }),
    ] {
        let covered = covered(200, samples, noise);
        let inside = covered.iter().all(|part| (88.8..=100.0).contains(part));
        assert!(inside, "{samples:?}: {covered:?}");
    }
}

/// The same for 1000 records each: `cargo test --release -p lptn-fit --test all network_intervals:: --
/// --ignored --nocapture`.
#[test]
#[ignore = "takes a minute"]
fn intervals_of_a_thousand_records() {
    let rounded = |step: f64, kept: f64| Noise { step, ..noise(kept) };
    let drift = |kelvin: f64, seconds: f64| Noise { drift: (kelvin, seconds), ..rounded(0.1, 0.6) };
    for (samples, noise) in [
        // over 2 s, and for 1.3 time constants
        ((1500, 1.0), noise(0.6)),
        ((1000, 1.0), noise(0.6)),
        ((300, 5.0), Noise { tails: true, ..noise(0.5) }),
        // a hall that cycles, and drift as slow as the record
        ((1500, 1.0), drift(0.1, 300.0)),
        ((1500, 1.0), drift(0.05, 1000.0)),
        ((300, 5.0), noise(0.9)),
        ((1500, 1.0), noise(0.99)),
        // as loggers round
        ((300, 5.0), rounded(0.1, 0.5)),
        ((300, 5.0), rounded(0.5, 0.5)),
        ((30, 50.0), rounded(0.5, 0.0)),
        ((8, 200.0), noise(0.0)),
        ((30, 50.0), noise(0.0)),
        ((30, 50.0), noise(0.5)),
        // noise that grows, and that falls
        ((300, 5.0), Noise { halves: (0.5, 3.0), ..noise(0.0) }),
        ((300, 5.0), Noise { halves: (3.0, 0.5), ..noise(0.0) }),
        ((1500, 1.0), Noise { halves: (0.5, 3.0), ..noise(0.9) }),
        ((1500, 1.0), Noise { halves: (3.0, 0.5), ..noise(0.9) }),
    ] {
        let covered = covered(1000, samples, noise);
        println!("{samples:?} {noise:?}: {covered:?}");
        assert!(covered.iter().all(|part| (92.0..=100.0).contains(part)), "{covered:?}");
    }
}

/// At least 95 % less four standard deviations of the binomial distribution. Without what columns
/// share eight of them held 82 to 84 %.
#[test]
fn intervals_count_what_columns_share() {
    for (count, columns, noise) in [(120, 8, SHARED), (80, 3, SLOW), (40, 4, ALONE)] {
        let found = shared(count, columns, noise);
        let least = 95.0 - 400.0 * (0.05 * 0.95 / f64::from(count)).sqrt();
        assert!(found.held.iter().all(|part| *part >= least), "{columns} columns: {found:?}");
        if noise == ALONE {
            // independent columns stay as good as they are
            assert!(found.told <= 2 && found.errors.iter().all(|e| *e < 1.1), "{found:?}");
        } else if noise == SHARED {
            assert_eq!(found.told, 120);
        }
    }
}

/// The same for 1000 records each, and for more columns and fewer rows.
#[test]
#[ignore = "takes minutes"]
fn intervals_of_a_thousand_records_with_shared_noise() {
    for (columns, noise) in [
        (2, SHARED),
        (3, SHARED),
        (8, SHARED),
        (2, SLOW),
        (8, SLOW),
        (2, ALONE),
        (8, ALONE),
        (8, Columns { rows: 30, ..SHARED }),
        (8, Columns { rows: 30, ..ALONE }),
        (8, Columns { rows: 8, ..ALONE }),
        (3, Columns { rows: 1500, ..SLOW }),
    ] {
        let found = shared(1000, columns, noise);
        println!("{columns} columns, {noise:?}: {found:?}");
        assert!(found.held.iter().all(|part| (92.0..=98.9).contains(part)), "{found:?}");
    }
}

/// What the columns of one record of a body are read with.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Columns {
    rows: u32,
    /// Standard deviation in K of what is common to all, and what is kept of it from row to row.
    common: (f64, f64),
    /// That of each column alone.
    own: f64,
}

const SHARED: Columns = Columns { rows: 150, common: (0.2, 0.0), own: 0.05 };
const SLOW: Columns = Columns { rows: 150, common: (0.1, 0.8), own: 0.2 };
const ALONE: Columns = Columns { rows: 150, common: (0.0, 0.0), own: 0.2 };

/// How the intervals of R and C came out.
#[derive(Debug)]
struct Found {
    /// In percent.
    held: [f64; 2],
    /// The mean standard error over that of the best estimate that independent columns allow.
    errors: [f64; 2],
    /// In how many fits it was told that columns are off together.
    told: usize,
}

fn shared(count: u32, columns: usize, noise: Columns) -> Found {
    let seeds: Vec<u32> = (0..count).collect();
    let fits = in_parallel(&seeds, available_threads(), |&seed| of_columns(seed, columns, noise));
    let parameter = |k: usize| fits.iter().map(move |(parameters, _)| &parameters[k]);
    let holds = |k: usize| {
        parameter(k).filter(move |p| (p.value - TRUTH[k]).abs() <= p.half_width.unwrap())
    };
    let best = deviations(noise).map(|d| d / (columns as f64).sqrt());
    let errors = |k: usize| parameter(k).map(|p| p.standard_error.unwrap()).sum::<f64>();
    Found {
        held: std::array::from_fn(|k| 100.0 * holds(k).count() as f64 / f64::from(count)),
        errors: std::array::from_fn(|k| errors(k) / f64::from(count) / best[k]),
        told: fits.iter().filter(|(_, told)| *told).count(),
    }
}

/// Over the record: 1500 s.
fn time(row: u32, rows: u32) -> f64 {
    1500.0 * f64::from(row) / f64::from(rows - 1)
}

/// Of R and C from one column with noise of its own, by the derivatives of the closed form.
fn deviations(noise: Columns) -> [f64; 2] {
    let [r, c] = TRUTH;
    let [mut rr, mut rc, mut cc] = [0.0; 3];
    for row in 0..noise.rows {
        let x = time(row, noise.rows) / (r * c);
        let decay = f64::exp(-x);
        let by = [150.0 * (1.0 - decay - x * decay), -150.0 * r * x * decay / c];
        (rr, rc, cc) = (rr + by[0] * by[0], rc + by[0] * by[1], cc + by[1] * by[1]);
    }
    let determinant = rr * cc - rc * rc;
    [cc, rr].map(|other| noise.own * (other / determinant).sqrt())
}

/// The fit of a body with so many columns of its temperature, and whether shared noise is told.
fn of_columns(seed: u32, columns: usize, noise: Columns) -> (Vec<FittedParameter>, bool) {
    use std::fmt::Write as _;
    let mut random = Pcg64::new(991 + u128::from(seed), 0x0a02_bdbf_7bb3_c0a7_ac28_fa16_a64a_bf96);
    let mut normal = || -> f64 { StandardNormal.sample(&mut random) };
    let (deviation, kept) = noise.common;
    let mut common = normal();
    let mut csv = "t [s]".to_owned();
    (0..columns).for_each(|i| write!(csv, ",x{i} [degC]").unwrap());
    for row in 0..noise.rows {
        let t = time(row, noise.rows);
        let rise = 150.0 * TRUTH[0] * -f64::exp_m1(-t / (TRUTH[0] * TRUTH[1]));
        write!(csv, "\n{t}").unwrap();
        for _ in 0..columns {
            write!(csv, ",{}", 25.0 + rise + deviation * common + noise.own * normal()).unwrap();
        }
        common = kept * common + (1.0 - kept * kept).sqrt() * normal();
    }
    let said: String = (0..columns).map(|i| format!("x{i} = \"body.T\", ")).collect();
    let text = format!(
        "format = 1\n[param]\nR = \"0.25 K/W\"\nC = \"2 kJ/K\"\n[node]\nbody = {{ C = \"C\", T0 = \"25 \
         degC\" }}\n[boundary]\nroom = {{ T = \"25 degC\" }}\n[resistor]\nskin = {{ from = \"body\", \
         to = \"room\", R = \"R\" }}\n[source]\nheat = {{ into = \"body\", P = \"150 W\" }}\n[fit.all]\n\
         data = \"r.csv\"\ncolumn = {{ {} }}\nvary = [\"R\", \"C\"]\n",
        said.trim_end_matches(", ")
    );
    let netlist = parse_with("body.toml", &text, &mut |_| Ok(csv.clone().into_bytes()))
        .unwrap_or_else(|rejected| panic!("{rejected}"));
    let task = NetworkFitTask::of(&netlist, &netlist.studies.fits[0], 1).unwrap();
    let fit = fit_network(&task).unwrap();
    (fit.parameters, !fit.shared_noise.is_empty())
}
