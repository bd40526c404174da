//! How often the 95 % intervals of `fit step` hold the truth, over kinds of noise, steps of the
//! logger and lengths: `cargo run --release -p lptn-fit --example coverage 1000`.

#![allow(clippy::print_stdout)]

#[path = "../tests/support/records.rs"]
mod records;

use records::{Truth, coverage};

fn main() {
    let count = std::env::args().nth(1).and_then(|n| n.parse().ok()).unwrap_or(200);
    let paper = Truth::PAPER;
    let with_tau = |tau: f64, truth: Truth| Truth { curve: [25.5, 92.7, tau], ..truth };
    let mut cases = vec![paper];
    cases.extend([0.0, 0.5, 0.99, 0.999].map(|rho| Truth { rho, ..paper }));
    cases.extend([0.0, 0.01, 0.5].map(|step| Truth { step, ..paper }));
    cases.extend([0.02, 0.5].map(|deviation| Truth { deviation, ..paper }));
    cases.extend([1150.0, 300.0].map(|tau| with_tau(tau, paper)));
    cases.push(Truth { rho: 0.99, step: 0.5, ..paper });
    cases.push(with_tau(300.0, Truth { rho: 0.99, step: 0.5, ..paper }));
    cases.push(with_tau(300.0, Truth { deviation: 0.02, step: 0.5, ..paper }));
    cases.extend([(1500, 1.0), (300, 5.0)].map(|(samples, spacing)| Truth {
        samples,
        spacing,
        ..paper
    }));
    cases.push(Truth { samples: 50, spacing: 30.0, rho: 0.5, ..paper });
    let drifts =
        [(0.1, 300.0), (0.3, 300.0), (0.1, 100.0), (0.1, 30.0), (0.05, 1000.0), (0.2, 1000.0)];
    cases.extend(drifts.map(|drift| Truth { drift, ..paper }));
    cases.push(Truth { tails: 3.0, ..paper });
    cases.push(Truth { samples: 30, spacing: 50.0, rho: 0.0, step: 0.0, ..paper });
    cases.push(Truth { samples: 30, spacing: 50.0, rho: 0.5, ..paper });
    for (samples, spacing, rho) in [(300, 5.0, 0.0), (300, 5.0, 0.6), (1500, 1.0, 0.9)] {
        cases.extend([(0.5, 3.0), (3.0, 0.5)].map(|halves| Truth {
            samples,
            spacing,
            rho,
            halves,
            step: 0.0,
            ..paper
        }));
    }
    let head = "samples  L/t_RC    rho   sd [K]  step [K]  drift [K, s] halves |   T_i   T_f  t_RC [%] | coarse  second   drift [%]";
    println!("{head}");
    for truth in cases {
        let fits = truth.fits(count);
        let [initial, settled, tau] = coverage(&truth, &fits);
        let part = |is: fn(&lptn_fit::step::StepFit) -> bool| {
            100.0 * fits.iter().filter(|fit| is(fit)).count() as f64 / fits.len() as f64
        };
        let length = truth.samples as f64 * truth.spacing / truth.curve[2];
        println!(
            "{:7} {length:7.2} {:6} {:8} {:9} {:6} {:6} {:?} | {initial:5.1} {settled:5.1} {tau:5.1}    | {:6.0} \
             {:8.1} {:7.0}",
            truth.samples,
            truth.rho,
            truth.deviation,
            truth.step,
            truth.drift.0,
            truth.drift.1,
            truth.halves,
            part(|fit| fit.coarse),
            part(|fit| fit.second.offer.is_some()),
            part(|fit| fit.noise.drifts()),
        );
    }
}
