//! Property: truths drawn from what is thought possible stand anywhere in the stated distributions
//! (simulation-based calibration: S. Talts, M. Betancourt, D. Simpson, A. Vehtari, A. Gelman,
//! arXiv:1804.06788, 2018).
//!
//! A fit states Student's t about each value, with its standard error and degrees of freedom. The
//! rank of the truth is the probability below it; ranks of many records are uniform where the
//! stated distributions are right, high in the middle where they are too wide, at the ends where
//! they are too narrow.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]
#![allow(clippy::print_stdout, reason = "the figures of the pages")]

use crate::body;
use crate::records;
use crate::student;

use lptn_fit::network::FittedParameter;
use lptn_fit::step::{Estimated, StepFit};
use lptn_solve::{available_threads, in_parallel};
use rand_distr::{Distribution, StandardNormal, StandardUniform};
use rand_pcg::Pcg64;
use records::Truth;

fn random(seed: u32) -> Pcg64 {
    Pcg64::new(1804 + u128::from(seed), 0x0a02_bdbf_7bb3_c0a7_ac28_fa16_a64a_bf96)
}

/// A number between two others, even in its logarithm.
fn even(random: &mut Pcg64, (low, high): (f64, f64)) -> f64 {
    let share: f64 = StandardUniform.sample(random);
    low * (high / low).powf(share)
}

/// SciPy 1.17.1, `stats.t.cdf`.
#[test]
fn the_distribution_is_scipys() {
    for (t, degrees, expected) in
        [(1.0, 3.5, 0.809_331_373_2), (-2.0, 12.0, 0.034_327_507_0), (0.3, 1.0, 0.592_773_579_1)]
    {
        let found = student::below(t, degrees);
        assert!((found - expected).abs() < 1e-8, "{t} {degrees}: {found}");
    }
}

/// Steps of 20 to 90 K and 300 to 1200 s with noise of 0.02 to 0.3 K that lasts 0.2 to 20 s, 25 min
/// at 5 Hz; half of them drift too, by as much as that over 20 s to the length of the record.
fn of_steps(seed: u32) -> Truth {
    let mut random = random(seed);
    let deviation = even(&mut random, (0.02, 0.3));
    let lasts = even(&mut random, (0.2, 20.0));
    let initial: f64 = StandardNormal.sample(&mut random);
    let curve = [25.0 + 3.0 * initial, 0.0, even(&mut random, (300.0, 1200.0))];
    let rise = even(&mut random, (20.0, 90.0));
    let drift = (even(&mut random, (0.02, 0.3)), even(&mut random, (20.0, 1500.0)));
    let drift = if seed.is_multiple_of(2) { (0.0, 1.0) } else { drift };
    let curve = [curve[0], curve[0] + rise, curve[2]];
    Truth { curve, deviation, rho: f64::exp(-0.2 / lasts), drift, step: 0.0, ..Truth::PAPER }
}

/// Ranks of `T_i`, `T_f` and `t_RC`.
fn ranks_of_steps(count: u32) -> [Vec<f64>; 3] {
    let seeds: Vec<u32> = (0..count).collect();
    let fits = in_parallel(&seeds, available_threads(), |&seed| {
        let truth = of_steps(seed);
        let (times, values) = truth.record(u128::from(seed));
        (truth, StepFit::new(&times, &values).unwrap())
    });
    let rank = |e: &Estimated, truth: f64| {
        student::below((truth - e.value) / e.standard_error, e.degrees_of_freedom)
    };
    std::array::from_fn(|k| {
        let of = |fit: &StepFit| [fit.initial, fit.settled, fit.tau][k];
        fits.iter().map(|(truth, fit)| rank(&of(fit), truth.curve[k])).collect()
    })
}

/// Bodies of 0.1 to 1 K/W and 500 to 5000 J/K, read 60 times over two to five time constants with
/// noise of 0.02 to 0.5 K, of which up to nine tenths stay from one value to the next.
fn ranks_of_bodies(count: u32) -> [Vec<f64>; 2] {
    let seeds: Vec<u32> = (0..count).collect();
    let fits = in_parallel(&seeds, available_threads(), |&seed| {
        let mut random = random(seed);
        let truth = [even(&mut random, (0.1, 1.0)), even(&mut random, (500.0, 5000.0))];
        let spacing = even(&mut random, (2.0, 5.0)) * truth[0] * truth[1] / 60.0;
        let deviation = even(&mut random, (0.02, 0.5));
        let kept = if seed.is_multiple_of(2) { 0.0 } else { even(&mut random, (0.1, 0.9)) };
        let noise = body::Noise { deviation, ..body::Noise::kept(kept) };
        (truth, body::fitted(seed, truth, ((60, spacing), noise)))
    });
    let rank = |p: &FittedParameter, truth: f64| {
        let degrees = p.degrees_of_freedom.unwrap();
        student::below((truth - p.value) / p.standard_error.unwrap(), degrees)
    };
    std::array::from_fn(|k| fits.iter().map(|(truth, fit)| rank(&fit[k], truth[k])).collect())
}

fn demand(ranks: &[Vec<f64>]) {
    let found: Vec<f64> = ranks.iter().map(|ranks| student::unevenness(ranks)).collect();
    println!(
        "chi-square with 19 degrees of freedom, at most {}: {found:.1?}",
        student::ONE_PERCENT
    );
    assert!(found.iter().all(|chi| *chi < student::ONE_PERCENT), "{found:?}");
}

#[test]
fn truths_stand_anywhere_in_what_fits_of_steps_state() {
    demand(&ranks_of_steps(100));
}

#[test]
fn truths_stand_anywhere_in_what_fits_of_networks_state() {
    demand(&ranks_of_bodies(100));
}

/// 1000 each: `cargo test --release -p lptn-fit --test all calibration:: -- --ignored --nocapture`.
#[test]
#[ignore = "takes a minute"]
fn ranks_of_a_thousand_fits() {
    demand(&ranks_of_bodies(1000));
    demand(&ranks_of_steps(1000));
}
