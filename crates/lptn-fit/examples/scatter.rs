//! Whether the errors that a plan predicts are those of fits: draws what is not known from its `±`,
//! makes the planned records with noise, fits them and compares:
//! `cargo run --release -p lptn-fit --example scatter -- FILE 500`. The first plan of the file is
//! taken, and the records that are there already are left out.

#![allow(clippy::print_stdout, clippy::unwrap_used, reason = "a tool for developers")]

use lptn_fit::network::design::{DesignTask, design};
use lptn_fit::network::fit_network;
use lptn_netlist::read;
use lptn_solve::{Proceed, available_threads, in_parallel};
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64;

fn main() {
    let mut words = std::env::args().skip(1);
    let file = words.next().unwrap();
    let count: u32 = words.next().and_then(|n| n.parse().ok()).unwrap_or(500);
    let netlist = read(std::path::Path::new(&file)).unwrap();
    let study = &netlist.studies.plans[0];
    let threads = available_threads();
    let task = DesignTask::of(&netlist, study, (threads, &|_, _| Proceed::Continue)).unwrap();
    let plan = design(&task, &|_, _| Proceed::Continue).unwrap().plan.unwrap();
    let seeds: Vec<u32> = (0..count).collect();
    let off = in_parallel(&seeds, threads, |&seed| missed(&task, (&plan.places, &plan.runs), seed));
    let found: Vec<&Vec<f64>> = off.iter().flatten().collect();
    println!("{} of {count} fits found a minimum", found.len());
    let mut why: Vec<&String> = off.iter().filter_map(|off| off.as_ref().err()).collect();
    why.sort();
    why.dedup();
    why.iter().for_each(|why| println!("else: {why}"));
    for (i, unknown) in task.unknowns.iter().enumerate().filter(|(_, u)| u.sensor().is_none()) {
        let mut off: Vec<f64> = found.iter().map(|off| off[i].abs()).collect();
        off.sort_by(f64::total_cmp);
        let scatter = (off.iter().map(|off| off * off).sum::<f64>() / off.len() as f64).sqrt();
        let predicted = plan.errors[i];
        // one that a normal error exceeds as often as its deviation, and the largest
        let inner = off[(0.6827 * off.len() as f64) as usize];
        let [all, inner, most] = [scatter, inner, off[off.len() - 1]].map(|x| x / predicted);
        println!("{:16} {predicted:.4e} rms {all:.3} 68 % {inner:.3} most {most:.3}", unknown.name);
    }
}

/// By how much a fit of records of this seed misses every unknown; without a minimum why.
fn missed(
    task: &DesignTask,
    planned: (&[usize], &[(usize, usize)]),
    seed: u32,
) -> Result<Vec<f64>, String> {
    let mut random = Pcg64::new(41 + u128::from(seed), 0x0a02_bdbf_7bb3_c0a7_ac28_fa16_a64a_bf96);
    let mut normal = || -> f64 { StandardNormal.sample(&mut random) };
    let mut truth = task.clone();
    for (value, unknown) in truth.values.iter_mut().zip(&task.unknowns) {
        *value += unknown.prior.unwrap_or(0.0) * normal();
    }
    let mut fit = truth.records(planned).map_err(|error| error.to_string())?;
    fit.threads = 1;
    for run in &mut fit.runs {
        for (column, &place) in run.columns.iter_mut().zip(planned.0) {
            let place = &task.places[place];
            let slow = place.deviation * place.correlated.sqrt();
            let fast = place.deviation * (1.0 - place.correlated).sqrt();
            let mut drift = slow * normal();
            for value in &mut column.values {
                *value += drift + fast * normal();
                drift = place.decay * drift + (1.0 - place.decay.powi(2)).sqrt() * slow * normal();
            }
        }
    }
    let found = fit_network(&fit).map_err(|error| error.to_string())?;
    let own = fit.unknowns();
    let miss = |(unknown, value): (&lptn_fit::network::Unknown, &f64)| {
        let place = own.iter().position(|own| own.of == unknown.of);
        place.map_or(f64::NAN, |place| found.parameters[place].value - value)
    };
    match found.not_converged {
        Some(stop) => Err(stop.text().to_owned()),
        None => Ok(task.unknowns.iter().zip(&truth.values).map(miss).collect()),
    }
}
