//! Property: the 95 % intervals of fits of networks hold the truth as often as they say.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

#[path = "support/body.rs"]
mod body;

use body::Noise;
use lptn_fit::network::FittedParameter;
use lptn_solve::{available_threads, in_parallel};

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

/// The same for 1000 records each: `cargo test --release -p lptn-fit --test network_intervals --
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
