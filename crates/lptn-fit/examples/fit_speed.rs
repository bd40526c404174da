//! How long a fit of 4 parameters to 2 columns of 7500 values takes: the gearbox for 25 min at 5
//! Hz.
//!
//! `cargo run --release -p lptn-study --example fit_speed`, under `time` for the CPU.
#![allow(clippy::print_stdout, reason = "an example")]

use lptn_analysis::RunAnalysis;
use lptn_fit::network::{
    Measurand, MeasuredColumn, MeasuredRun, NetworkFitTask, Varied, fit_network,
};
use lptn_netlist::parse;
use lptn_network::Time;
use lptn_units::{Correlations, Type};

const GEARBOX: &str = "format = 1
[param]
R = \"0.01 K/W\"
G = \"3 W/K\"
Cs = \"1000 J/K\"
Ca = \"1600 J/K\"
[node]
steel = { C = \"Cs\", T0 = \"25.5 degC\" }
alum = { C = \"Ca\", T0 = \"25.5 degC\" }
[boundary]
bed = { T = \"25.5 degC\" }
[resistor]
internal = { from = \"steel\", to = \"alum\", R = \"R\" }
outside = { from = \"alum\", to = \"bed\", G = \"G\" }
[source]
loss = { into = \"steel\", P = \"220.6 W\" }
";

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let netlist = parse("gearbox", GEARBOX)?;
    let network = &netlist.network;
    let times: Vec<f64> = (0..7500).map(|k| 0.2 * f64::from(k)).collect();
    // another curve than the network's own, rounded to 0.1 K as by a logger
    let column = |node: &str, lag: f64| -> Result<MeasuredColumn, Box<dyn std::error::Error>> {
        let rise = |t: f64| 66.0 * (1.0 - f64::exp(-t / 790.0)) + lag * (1.0 - f64::exp(-t / 25.0));
        let shown =
            |t: &f64| (10.0 * (25.5 + rise(*t) + 0.3 * (0.11 * t).sin())).round() / 10.0 + 273.15;
        let of = vec![(network.node(node)?, 1.0)];
        Ok(MeasuredColumn {
            name: node.into(),
            of: Measurand::Temperatures(of),
            ty: Type::ABSOLUTE_TEMPERATURE,
            sensor: None,
            sigma: Some(0.1),
            values: times.iter().map(shown).collect(),
        })
    };
    let varied =
        |(name, from, to): (&str, f64, f64)| -> Result<Varied, Box<dyn std::error::Error>> {
            Ok(Varied { parameter: network.parameter(name)?, bounds: (from, to), prior: None })
        };
    let ranges = [("R", 1e-3, 0.1), ("G", 1.0, 10.0), ("Cs", 50.0, 5000.0), ("Ca", 300.0, 5000.0)];
    let task = NetworkFitTask {
        network: network.clone(),
        parameters: ranges.into_iter().map(varied).collect::<Result<_, _>>()?,
        correlations: Correlations::none(ranges.len()),
        sensors: Vec::new(),
        runs: vec![MeasuredRun {
            name: "record".into(),
            parameters: network.overrides(),
            signals: Vec::new(),
            initial: Vec::new(),
            settings: RunAnalysis::until(Time(1500.0)),
            columns: vec![column("steel", 1.7)?, column("alum", 0.0)?],
            times: times.clone(),
        }],
        more_starts: 4,
        threads: 1,
    };
    let fit = fit_network(&task)?;
    for ((name, _, _), parameter) in ranges.iter().zip(&fit.parameters) {
        println!(
            "{name:3} {:12.6} ± {:.3e}",
            parameter.value,
            parameter.standard_error.unwrap_or(f64::NAN)
        );
    }
    println!(
        "{} values, rms {:.4} K, {} evaluations, {:?}",
        fit.samples(),
        fit.rms,
        fit.evaluations,
        fit.starts
    );
    Ok(())
}
