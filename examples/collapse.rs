//! When is C_steel + C_aluminium the capacity of the gearbox? The paper's collapse, from lptn's own
//! runs. `cargo run --release --example collapse`
#![allow(clippy::print_stdout)]

use lptn::prelude::*;
use lptn::{Definition, NodeId, Reduction, ReductionOptions, fit_exponential};

const POWER: f64 = 220.6;

fn main() -> Result<(), lptn::Error> {
    println!(
        "largest error of a step at the steel node in % of its rise, and the order in R_int/R_amb"
    );
    println!("{:>12}{:>16}{:>16}{:>16}", "R_int/R_amb", "sum", "first_moment", "dominant_pole");
    let mut before: Option<[f64; 3]> = None;
    for decade in -4..=0 {
        let ratio = 10_f64.powi(decade);
        let (system, steel, _) = gearbox(ratio * 0.3)?;
        let reduction = Reduction::new(&system, steel, &ReductionOptions::default())?;
        let pairs = reduction.dynamics.expect("the gearbox stores heat").pairs;
        let error = |definition: Definition| {
            let pair = pairs.iter().find(|pair| pair.definition == definition);
            let step = pair.and_then(|pair| pair.step).and_then(|step| step.relative);
            step.expect("a network without streams has the error of a step for each definition")
        };
        let now = [Definition::Sum, Definition::FirstMoment, Definition::DominantPole].map(error);
        let order =
            |i: usize| before.map_or(String::new(), |b| format!("{:.2}", (now[i] / b[i]).log10()));
        let cell = |i: usize| format!("{:.4} ({:>4})", 100.0 * now[i], order(i));
        println!("{ratio:>12}{:>16}{:>16}{:>16}", cell(0), cell(1), cell(2));
        before = Some(now);
    }
    println!("\none exponential through 25 min of each node: t_RC in min");
    println!("{:>12}{:>10}{:>12}{:>16}", "R_int [K/W]", "steel", "aluminium", "steel hotter by");
    for internal in [1.7 / POWER, 0.03, 0.1, 0.3] {
        let (system, steel, aluminium) = gearbox(internal)?;
        let run = Transient::until(Time::minutes(25.0)).every(Time(0.2)).solve(&system)?;
        let tau = |node: NodeId| -> Result<f64, lptn::Error> {
            Ok(fit_exponential(run.times(), &run.series(node)?)?.tau / 60.0)
        };
        let apart = internal * POWER;
        println!("{internal:>12.4}{:>10.2}{:>12.2}{apart:>14.1} K", tau(steel)?, tau(aluminium)?);
    }
    Ok(())
}

/// Steel 1235 J/K, aluminium 1424 J/K, 0.3 K/W to ambient at 25.5 degC.
fn gearbox(internal: f64) -> Result<(ThermalSystem, NodeId, NodeId), lptn::Error> {
    let ambient = Temperature::celsius(25.5);
    let mut b = NetworkBuilder::new();
    let steel = b.node("steel", HeatCapacity(1235.0), ambient);
    let aluminium = b.node("aluminium", HeatCapacity(1424.0), ambient);
    let bed = b.boundary("bed", ambient);
    b.resistor("internal", steel, aluminium, Resistance(internal));
    b.resistor("outer", aluminium, bed, Resistance(0.3));
    b.source("P_disp", steel, HeatFlow(POWER));
    Ok((ThermalSystem::assemble(&b.build()?)?, steel, aluminium))
}
