//! Writes the SYNTHETIC records of `networks/records/synthetic_gearbox`: two thermocouples and the
//! mill bed, 14 runs of 25 min at 1000 to 7000 rpm, from the exact solution of
//! `networks/paper_bed.toml`. The README there states the truth.
//! `cargo run --release --example synthetic_records`
#![allow(clippy::print_stdout)]

use std::error::Error;
use std::fmt::Write as _;

use lptn::ExactSolution;
use rand_distr::{Distribution as _, StandardNormal, Uniform};
use rand_pcg::Pcg64;

const ROOT: &str = env!("CARGO_MANIFEST_DIR");
const SEED: u128 = 2026;
/// The class of the thermocouples in K: each is off by one number up to it, the same in all runs.
const CLASS: f64 = 3.0;
/// Standard deviation of the noise in K, and how much of it is left after one sample.
const NOISE: (f64, f64) = (0.1, 0.9);
const SENSORS: [(&str, &str); 3] =
    [("ring_gear", "steel"), ("housing", "aluminium"), ("mill_bed", "bed")];

/// By how much each sensor is off, in K.
pub(crate) fn offsets() -> Result<[f64; 3], Box<dyn Error>> {
    let (mut random, even) = (Pcg64::new(SEED, 0), Uniform::new(-CLASS, CLASS)?);
    Ok([(); 3].map(|()| even.sample(&mut random)))
}

/// The file of one run, 0 or 1 of a speed in rpm: 5 Hz for 25 min, written with the 0.1 K of the
/// logger.
pub(crate) fn record(rpm: u32, run: u32) -> Result<String, Box<dyn Error>> {
    let mut netlist = lptn::read(format!("{ROOT}/networks/paper_bed.toml").as_ref())?;
    netlist.set(&[format!("omega={rpm} rpm")])?;
    let times: Vec<f64> = (0..=7500).map(|i| f64::from(i) / 5.0).collect();
    let exact = ExactSolution::solve(&netlist.network, 0.0, &times)?;
    let mut text = format!("# SYNTHETIC, see README.md\n# omega = {rpm} rpm\nt [s]");
    let mut columns = Vec::new();
    for (stream, ((name, node), offset)) in (1..).zip(SENSORS.iter().zip(offsets()?)) {
        write!(text, ",{name} [degC]")?;
        let mut random = Pcg64::new(SEED, u128::from(rpm + 10 * run) * 10 + stream);
        let mut normal = move || -> f64 { StandardNormal.sample(&mut random) };
        let ((deviation, rest), mut noise) = (NOISE, NOISE.0 * normal());
        columns.push(exact.temperature(netlist.network.node(node)?).into_iter().map(
            move |kelvin| {
                let read = kelvin - 273.15 + offset + noise;
                noise = rest * noise + deviation * f64::sqrt(1.0 - rest * rest) * normal();
                read
            },
        ));
    }
    for time in times {
        write!(text, "\n{time:.1}")?;
        columns
            .iter_mut()
            .filter_map(Iterator::next)
            .try_for_each(|read| write!(text, ",{read:.1}"))?;
    }
    Ok(text + "\n")
}

fn main() -> Result<(), Box<dyn Error>> {
    for (rpm, run) in (1..8).flat_map(|k| [(1000 * k, 0), (1000 * k, 1)]) {
        let name =
            format!("networks/records/synthetic_gearbox/{rpm}rpm_{}.csv", ["a", "b"][run as usize]);
        std::fs::write(format!("{ROOT}/{name}"), record(rpm, run)?)?;
    }
    println!("wrote 14 records; the sensors are off by {:.3?} K", offsets()?);
    Ok(())
}
