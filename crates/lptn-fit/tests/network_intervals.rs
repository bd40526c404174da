//! Property: the 95 % intervals of fits of networks hold the truth as often as they say.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use lptn_fit::network::{FittedParameter, NetworkFitTask, fit_network};
use lptn_netlist::{Netlist, parse_with};
use lptn_solve::{available_threads, in_parallel};
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64;

const TRUTH: [f64; 2] = [0.3, 2659.0];

/// A body of 0.3 K/W and 2659 J/K, heated by 220.6 W, read with noise of 0.1 K that is `kept` from
/// one sample to the next.
fn netlist(seed: u32, (samples, spacing): (u32, f64), kept: f64) -> Netlist {
    let mut random = Pcg64::new(77 + u128::from(seed), 0x0a02_bdbf_7bb3_c0a7_ac28_fa16_a64a_bf96);
    let mut normal = || -> f64 { StandardNormal.sample(&mut random) };
    let mut noise = 0.1 * normal();
    let mut csv = String::from("t [s],ring [degC]\n");
    for t in (0..samples).map(|k| f64::from(k) * spacing) {
        let rise = 220.6 * TRUTH[0] * (1.0 - f64::exp(-t / (TRUTH[0] * TRUTH[1])));
        csv += &format!("{t},{}\n", 25.0 + rise + noise);
        noise = kept * noise + (1.0 - kept * kept).sqrt() * 0.1 * normal();
    }
    let text = "format = 1\n[param]\nR = \"0.25 K/W\"\nC = \"2 kJ/K\"\n[node]\nbody = { C = \"C\", \
        T0 = \"25 degC\" }\n[boundary]\nroom = { T = \"25 degC\" }\n[resistor]\nskin = { from = \
        \"body\", to = \"room\", R = \"R\" }\n[source]\nheat = { into = \"body\", P = \"220.6 W\" \
        }\n[fit.all]\ndata = \"r.csv\"\ncolumn = { ring = \"body.T\" }\nvary = [\"R\", \"C\"]\n";
    parse_with("body.toml", text, &mut |_| Ok(csv.clone().into_bytes()))
        .unwrap_or_else(|rejected| panic!("{rejected}"))
}

/// In how many percent of so many fits the interval of each parameter holds the truth.
fn covered(count: u32, samples: (u32, f64), kept: f64) -> [f64; 2] {
    let seeds: Vec<u32> = (0..count).collect();
    let fits = in_parallel(&seeds, available_threads(), |&seed| {
        let netlist = netlist(seed, samples, kept);
        let task = NetworkFitTask::of(&netlist, &netlist.studies.fits[0], 1).unwrap();
        fit_network(&task).unwrap().parameters
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
    for (samples, kept) in [((8, 200.0), 0.0), ((60, 25.0), 0.0), ((300, 5.0), 0.9)] {
        let covered = covered(200, samples, kept);
        let inside = covered.iter().all(|part| (88.8..=100.0).contains(part));
        assert!(inside, "{samples:?}: {covered:?}");
    }
}

/// The same for 1000 records each: `cargo test --release -p lptn-fit --test network_intervals --
/// --ignored --nocapture`.
#[test]
#[ignore = "takes a minute"]
fn intervals_of_a_thousand_records() {
    for (samples, kept) in [
        ((8, 200.0), 0.0),
        ((30, 50.0), 0.0),
        ((30, 50.0), 0.5),
        ((300, 5.0), 0.9),
        ((1500, 1.0), 0.99),
    ] {
        let covered = covered(1000, samples, kept);
        println!("{samples:?} {kept}: {covered:?}");
        assert!(covered.iter().all(|part| (92.0..=100.0).contains(part)));
    }
}
