//! A gearbox on a mill bed with places for sensors, and records of it.

use lptn_fit::network::NetworkFitTask;
use lptn_fit::network::design::{Design, DesignTask, design};
use lptn_fit::network::fit_network;
use lptn_netlist::{Netlist, parse_with};
use lptn_solve::{Proceed, available_threads, in_parallel};
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64;

/// What a record is like.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Truth {
    /// Number of samples, and their distance in s.
    pub(crate) samples: usize,
    pub(crate) every: f64,
    /// Standard deviations in K of the fast noise and of the drift, and its time in s.
    pub(crate) noise: f64,
    pub(crate) drift: (f64, f64),
    /// Standard deviation of the sensors' offsets in K.
    pub(crate) offset: f64,
}

impl Truth {
    /// What many values of a drift leave in their mean, as independent ones of so much would.
    fn sigma(&self) -> f64 {
        let (white, drift) = (self.noise.powi(2), self.drift.0.powi(2));
        let kept = (-self.every / self.drift.1).exp();
        (white + drift * (1.0 + kept) / (1.0 - kept)).sqrt()
    }
}

/// Steel on aluminium on a bed, 7000 rpm.
fn network(truth: &Truth) -> String {
    let offset = match truth.offset > 0.0 {
        true => format!("offset = \"0 ± {} K\"", truth.offset),
        false => String::new(),
    };
    format!(
        "format = 1\n[param]\nalpha = \"87 uW/rpm^(5/3)\"\nomega = \"7000 rpm\"\n\
         R_internal = \"7.7 mK/W\"\nR_skin = \"0.36 K/W\"\n[default]\nT0 = \"25.5 degC\"\n\
         [node]\nsteel = {{ C = \"1235 J/K\" }}\naluminium = {{ C = \"1424 J/K\" }}\n\
         bed = {{ C = \"1670 J/K\" }}\n[boundary]\nroom = {{ T = \"25.5 degC\" }}\n[resistor]\n\
         internal = {{ from = \"steel\", to = \"aluminium\", R = \"R_internal\" }}\n\
         fixture = {{ from = \"aluminium\", to = \"bed\", R = \"1.05 K/W\" }}\n\
         mill = {{ from = \"bed\", to = \"room\", R = \"2.16 K/W\" }}\n\
         skin = {{ from = \"aluminium\", to = \"room\", R = \"R_skin\" }}\n\
         [source]\nP_disp = {{ into = \"steel\", P = \"alpha * omega^(5/3)\" }}\n\
         [sensor]\nring = {{ {offset} }}\nhouse = {{ {offset} }}\n"
    )
}

fn parsed(text: &str, csv: &str) -> Netlist {
    parse_with("gearbox.toml", text, &mut |_| Ok(csv.as_bytes().to_vec()))
        .unwrap_or_else(|rejected| panic!("{rejected}"))
}

fn planned(truth: &Truth) -> Netlist {
    let drift = match truth.drift.0 > 0.0 {
        true => format!("drift = \"{} K\"\ndrift_time = \"{} s\"\n", truth.drift.0, truth.drift.1),
        false => String::new(),
    };
    let seconds = (truth.samples - 1) as f64 * truth.every;
    let text = format!(
        "{}[plan.next]\nknow = {{ alpha = \"0.0001 %\" }}\nvary = [\"R_internal\", \"R_skin\"]\n\
         noise = \"{} K\"\n{drift}every = \"{} s\"\nduration = \"{seconds} s\"\n\
         place = {{ ring = {{ of = \"steel.T\", sensor = \"ring\" }}, \
         house = {{ of = \"aluminium.T\", sensor = \"house\" }} }}\n",
        network(truth),
        truth.noise,
        truth.every
    );
    parsed(&text, "")
}

/// What is predicted for both sensors: standard errors of alpha, R_internal and R_skin.
pub(crate) fn predicted(truth: &Truth) -> Vec<f64> {
    let netlist = planned(truth);
    let study = &netlist.studies.plans[0];
    let task = DesignTask::of(&netlist, study, (2, &|_, _| Proceed::Continue)).unwrap();
    let design: Design = design(&task, &|_, _| Proceed::Continue).unwrap();
    design.sets[1].errors[..3].to_vec()
}

/// The temperatures of steel and aluminium over the room, by steps of Runge and Kutta of order 4.
fn course(truth: &Truth) -> Vec<[f64; 2]> {
    let omega = 7000.0_f64;
    let power = 87e-6 * omega.powf(5.0 / 3.0);
    let rate = |t: [f64; 3]| {
        let inside = (t[0] - t[1]) / 7.7e-3;
        let bed = (t[1] - t[2]) / 1.05;
        [
            (power - inside) / 1235.0,
            (inside - bed - t[1] / 0.36) / 1424.0,
            (bed - t[2] / 2.16) / 1670.0,
        ]
    };
    let steps = (truth.every / 0.5).ceil();
    let h = truth.every / steps;
    let moved = |t: [f64; 3], k: [f64; 3], by: f64| std::array::from_fn(|i| t[i] + by * k[i]);
    let mut t = [0.0; 3];
    let mut rows = vec![[0.0; 2]];
    for _ in 1..truth.samples {
        for _ in 0..steps as usize {
            let a = rate(t);
            let b = rate(moved(t, a, h / 2.0));
            let c = rate(moved(t, b, h / 2.0));
            let d = rate(moved(t, c, h));
            t = std::array::from_fn(|i| t[i] + h / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]));
        }
        rows.push([t[0], t[1]]);
    }
    rows
}

/// A record of it; each seed has its own offsets and noise.
fn record(truth: &Truth, course: &[[f64; 2]], seed: u32) -> String {
    let mut random = Pcg64::new(19 + u128::from(seed), 0x0a02_bdbf_7bb3_c0a7_ac28_fa16_a64a_bf96);
    let mut normal = || -> f64 { StandardNormal.sample(&mut random) };
    let offsets = [truth.offset * normal(), truth.offset * normal()];
    let mut drift = [truth.drift.0 * normal(), truth.drift.0 * normal()];
    let kept = if truth.drift.0 > 0.0 { (-truth.every / truth.drift.1).exp() } else { 0.0 };
    let mut csv = String::from("t [s],ring [degC],house [degC]\n");
    for (k, row) in course.iter().enumerate() {
        let read: [f64; 2] =
            std::array::from_fn(|i| 25.5 + row[i] + offsets[i] + drift[i] + truth.noise * normal());
        csv += &format!("{},{},{}\n", k as f64 * truth.every, read[0], read[1]);
        let new = (1.0 - kept * kept).sqrt() * truth.drift.0;
        drift = drift.map(|before| kept * before + new * normal());
    }
    csv
}

/// The scatter of what so many fits of such records find of alpha, R_internal and R_skin.
pub(crate) fn scatter(truth: &Truth, count: u32) -> Vec<f64> {
    let sigma = truth.sigma();
    let text = format!(
        "{}[fit.all]\ndata = \"r.csv\"\ncolumn = {{ ring = {{ of = \"steel.T\", sensor = \"ring\" }}, \
         house = {{ of = \"aluminium.T\", sensor = \"house\" }} }}\nsigma = \"{sigma} K\"\n\
         vary = [\"alpha\", \"R_internal\", \"R_skin\"]\n",
        network(truth)
    );
    let course = course(truth);
    let seeds: Vec<u32> = (0..count).collect();
    let found = in_parallel(&seeds, available_threads(), |&seed| {
        let netlist = parsed(&text, &record(truth, &course, seed));
        let task = NetworkFitTask::of(&netlist, &netlist.studies.fits[0], 1).unwrap();
        let fit = fit_network(&task).unwrap();
        fit.parameters[..3].iter().map(|parameter| parameter.value).collect::<Vec<f64>>()
    });
    let spread = |i: usize| {
        let mean = found.iter().map(|fit| fit[i]).sum::<f64>() / f64::from(count);
        let squares: f64 = found.iter().map(|fit| (fit[i] - mean).powi(2)).sum();
        (squares / f64::from(count - 1)).sqrt()
    };
    (0..3).map(spread).collect()
}

/// Fast noise, a drift, offsets of sensors, and all of them.
pub(crate) const KINDS: [Truth; 4] = [
    Truth { samples: 151, every: 10.0, noise: 0.1, drift: (0.0, 1.0), offset: 0.0 },
    Truth { samples: 301, every: 5.0, noise: 0.1, drift: (0.05, 120.0), offset: 0.0 },
    Truth { samples: 151, every: 10.0, noise: 0.1, drift: (0.0, 1.0), offset: 1.7 },
    Truth { samples: 301, every: 5.0, noise: 0.1, drift: (0.05, 120.0), offset: 1.7 },
];
