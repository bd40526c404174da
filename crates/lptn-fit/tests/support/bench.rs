//! One body whose power goes over time, and the records of a thermometer on it, by closed forms.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]
#![allow(dead_code, reason = "each test takes what it needs")]

use lptn_fit::infer::{InferError, InferTask, Inferred, infer};
use lptn_netlist::{Netlist, parse_with};
use lptn_solve::Proceed;
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64;

pub(crate) fn parse(text: &str, csv: &str) -> Netlist {
    parse_with("infer.toml", text, &mut |_| Ok(csv.as_bytes().to_vec()))
        .unwrap_or_else(|rejected| panic!("{rejected}"))
}

pub(crate) fn inferred(netlist: &Netlist) -> Result<Inferred, InferError> {
    let task = InferTask::of(netlist, &netlist.studies.infers[0])?;
    infer(&task, &|_| Proceed::Continue)
}

/// One body of 2659 J/K on 0.3 K/W in a room of 25 degC, whose power is `power` between each two of
/// many short steps, read every `every` s with noise.
#[derive(Clone, Copy)]
pub(crate) struct Bench {
    pub(crate) every: f64,
    pub(crate) rows: u32,
    pub(crate) sigma: f64,
}

pub(crate) const TAU: f64 = 0.3 * 2659.0;

pub(crate) fn noise(seed: u32) -> impl FnMut() -> f64 {
    let mut random = Pcg64::new(500 + u128::from(seed), 0x0a02_bdbf_7bb3_c0a7_ac28_fa16_a64a_bf96);
    move || StandardNormal.sample(&mut random)
}

impl Bench {
    /// Time, power and temperature over 25 degC of every row.
    pub(crate) fn course(&self, mut power: impl FnMut(f64) -> f64) -> Vec<(f64, f64, f64)> {
        const PARTS: u32 = 20;
        let step = self.every / f64::from(PARTS);
        let (mut rise, mut all) = (0.0, Vec::new());
        for k in 0..self.rows {
            let time = f64::from(k) * self.every;
            all.push((time, power(time), rise));
            for part in 0..PARTS {
                let heat = power(time + (f64::from(part) + 0.5) * step);
                rise = 0.3 * heat + (rise - 0.3 * heat) * f64::exp(-step / TAU);
            }
        }
        all
    }

    pub(crate) fn csv(&self, course: &[(f64, f64, f64)], seed: u32) -> String {
        let mut noise = noise(seed);
        let row = |(t, _, rise): &(f64, f64, f64)| {
            format!("{t},{}\n", 25.0 + rise + self.sigma * noise())
        };
        format!("t [s],tc [degC]\n{}", course.iter().map(row).collect::<String>())
    }
}

/// Noise of which 1/e is left after `time` s, beside white noise, and the step of the logger.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Slow {
    pub(crate) deviation: f64,
    pub(crate) time: f64,
    pub(crate) step: f64,
}

impl Bench {
    pub(crate) fn slow_csv(&self, course: &[(f64, f64, f64)], seed: u32, slow: Slow) -> String {
        let (mut white, mut more) = (noise(seed), noise(1_000_000 + seed));
        let left = f64::exp(-self.every / slow.time);
        let mut now = more();
        let row = |(t, _, rise): &(f64, f64, f64)| {
            now = left * now + (1.0 - left * left).sqrt() * more();
            let read = 25.0 + rise + self.sigma * white() + slow.deviation * now;
            let read = if slow.step > 0.0 { (read / slow.step).round() * slow.step } else { read };
            format!("{t},{read}\n")
        };
        format!("t [s],tc [degC]\n{}", course.iter().map(row).collect::<String>())
    }
}

pub(crate) fn body(study: &str, csv: &str) -> Netlist {
    let text = format!(
        "format = 1\n[signal]\nP = \"100 W\"\n[node]\nbody = {{ C = \"2659 J/K\", T0 = \"25 degC\" }}\n\
         [boundary]\nroom = {{ T = \"25 degC\" }}\n[resistor]\nskin = {{ from = \"body\", to = \
         \"room\", R = \"0.3 K/W\" }}\n[source]\nheat = {{ into = \"body\", P = \"P\" }}\n\
         [infer.power]\ndata = \"r.csv\"\ncolumn = {{ tc = \"body.T\" }}\n{study}\n"
    );
    parse(&text, csv)
}

/// Steps, a ramp and a drive cycle, 50 minutes.
pub(crate) fn driven(t: f64) -> f64 {
    let minutes = t / 60.0;
    match minutes {
        m if m < 5.0 => 120.0,
        m if m < 10.0 => 220.0,
        m if m < 15.0 => 60.0,
        m if m < 25.0 => 60.0 + 16.0 * (m - 15.0),
        m => {
            let fast = f64::sin(1.9 * m) + 0.6 * f64::sin(4.1 * m + 1.0);
            160.0 + 40.0 * fast + if m % 4.0 < 1.5 { 50.0 } else { 0.0 }
        }
    }
}

/// A bench that holds one load after the other, 5 minutes each at least.
pub(crate) fn held(t: f64) -> f64 {
    let loads = [100.0, 220.0, 220.0, 60.0, 150.0, 150.0, 200.0, 30.0, 30.0, 120.0];
    loads[((t / 300.0) as usize).min(9)]
}
