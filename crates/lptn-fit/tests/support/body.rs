//! Fits of one heated body to records whose truth is known.

use lptn_fit::network::{FittedParameter, NetworkFitTask, fit_network};
use lptn_netlist::{Netlist, parse_with};
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64;

/// What the record is read with.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Noise {
    /// Standard deviation in K.
    pub(crate) deviation: f64,
    /// What is kept of it from one value to the next.
    pub(crate) kept: f64,
    /// Step of the logger in K; 0 for none.
    pub(crate) step: f64,
    /// Standard deviation in K and time in s of a drift beside it.
    pub(crate) drift: (f64, f64),
    /// What the standard deviation is multiplied by in the first and the second half.
    pub(crate) halves: (f64, f64),
    /// Whether what drives the noise is Student's t of 3 degrees of freedom, of variance 1.
    pub(crate) tails: bool,
}

impl Noise {
    /// Noise of 0.1 K that is `kept` from one value to the next.
    pub(crate) const fn kept(kept: f64) -> Self {
        Self {
            deviation: 0.1,
            kept,
            step: 0.0,
            drift: (0.0, 1.0),
            halves: (1.0, 1.0),
            tails: false,
        }
    }
}

/// A body of some K/W and J/K in a room of 25 degC, heated by 220.6 W.
fn netlist(
    seed: u32,
    [resistance, capacity]: [f64; 2],
    ((samples, spacing), of): ((u32, f64), Noise),
) -> Netlist {
    let mut random = Pcg64::new(77 + u128::from(seed), 0x0a02_bdbf_7bb3_c0a7_ac28_fa16_a64a_bf96);
    let mut normal = || -> f64 { StandardNormal.sample(&mut random) };
    let mut noise = of.deviation * normal();
    let mut drift = if of.drift.0 > 0.0 { of.drift.0 * normal() } else { 0.0 };
    let left = f64::exp(-spacing / of.drift.1);
    let mut csv = String::from("t [s],ring [degC]\n");
    for k in 0..samples {
        let t = f64::from(k) * spacing;
        let factor = if 2 * k < samples { of.halves.0 } else { of.halves.1 };
        let rise = 220.6 * resistance * (1.0 - f64::exp(-t / (resistance * capacity)));
        let exact = 25.0 + rise + factor * noise + drift;
        let read = if of.step > 0.0 { (exact / of.step).round() * of.step } else { exact };
        csv += &format!("{t},{read}\n");
        let driven = match of.tails {
            true => normal() / (0..3).map(|_| normal().powi(2)).sum::<f64>().sqrt(),
            false => normal(),
        };
        noise = of.kept * noise + (1.0 - of.kept * of.kept).sqrt() * of.deviation * driven;
        if of.drift.0 > 0.0 {
            drift = left * drift + (1.0 - left * left).sqrt() * of.drift.0 * normal();
        }
    }
    let text = "format = 1\n[param]\nR = \"0.25 K/W\"\nC = \"2 kJ/K\"\n[node]\nbody = { C = \"C\", \
        T0 = \"25 degC\" }\n[boundary]\nroom = { T = \"25 degC\" }\n[resistor]\nskin = { from = \
        \"body\", to = \"room\", R = \"R\" }\n[source]\nheat = { into = \"body\", P = \"220.6 W\" \
        }\n[fit.all]\ndata = \"r.csv\"\ncolumn = { ring = \"body.T\" }\nvary = [\"R\", \"C\"]\n";
    parse_with("body.toml", text, &mut |_| Ok(csv.clone().into_bytes()))
        .unwrap_or_else(|rejected| panic!("{rejected}"))
}

/// The fit of R and C to a record of so many values, so many seconds apart.
pub(crate) fn fitted(
    seed: u32,
    truth: [f64; 2],
    record: ((u32, f64), Noise),
) -> Vec<FittedParameter> {
    let netlist = netlist(seed, truth, record);
    let task = NetworkFitTask::of(&netlist, &netlist.studies.fits[0], 1).unwrap();
    fit_network(&task).unwrap().parameters
}
