//! Runs at several speeds whose rises and time constants are known.

use std::f64::consts::TAU;

use lptn_fit::law::{LossLaw, Run, RunReference, RunsSettings};
use lptn_fit::step::{Capacity, Sensor};
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64;

pub(crate) const RPM: f64 = TAU / 60.0;

pub(crate) fn random(seed: u128) -> Pcg64 {
    Pcg64::new(0xcafe_f00d_d15e_a5e5 + seed, 0x0a02_bdbf_7bb3_c0a7_ac28_fa16_a64a_bf96)
}

/// What a column does from 25 degC on.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Course {
    /// In K.
    pub(crate) rise: f64,
    /// In s.
    pub(crate) time_constant: f64,
    /// Standard deviation in K of independent noise.
    pub(crate) noise: f64,
}

/// A record of 40 min at a speed in rad/s, one row in 40 s.
pub(crate) fn record(speed: f64, columns: &[(&str, Course)], seed: u128) -> Run {
    let times: Vec<f64> = (0..60).map(|i| 40.0 * f64::from(i)).collect();
    let mut random = random(seed);
    let mut column = |(name, course): &(&str, Course)| {
        let at = |t: &f64| {
            let noise: f64 = StandardNormal.sample(&mut random);
            let risen = course.rise * (1.0 - (-t / course.time_constant).exp());
            298.15 + risen + course.noise * noise
        };
        ((*name).to_owned(), times.iter().map(at).collect())
    };
    let columns = columns.iter().map(&mut column).collect();
    Run { name: format!("{speed} rad/s"), speed, times: times.clone(), columns }
}

pub(crate) fn settings(columns: &[&str], laws: Vec<LossLaw>) -> RunsSettings {
    RunsSettings {
        columns: columns.iter().map(|name| (*name).to_owned()).collect(),
        capacity: Capacity { value: 2659.0, deviation: 0.0 },
        reference: RunReference::Initial,
        sensor: Sensor { class: 0.0, gain: 0.0 },
        unweighted: true,
        laws,
        threads: 2,
    }
}
