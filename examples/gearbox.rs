//! The gearbox of the paper: read its netlist, run it, say where the heat went.
//! `cargo run --release --example gearbox`
#![allow(clippy::print_stdout)]

use lptn::prelude::*;

fn main() -> Result<(), lptn::Error> {
    let netlist = lptn::read("networks/gearbox.toml".as_ref())?;
    let network = &netlist.network;
    let system = ThermalSystem::assemble(network)?;
    let steady = SteadyState::solve(&system, 0.0)?;
    let solution = Transient::until(Time::minutes(25.0)).every(Time(5.0)).solve(&system)?;

    println!("{:<12}{:>10}{:>10}", "node", "25 min", "steady");
    for id in network.node_ids() {
        let [end, steady] = [solution.at_end(id)?, steady[id]].map(|t| Temperature(t).in_celsius());
        println!("{:<12}{end:>10.2}{steady:>10.2} degC", network.nodes()[id.index()].name);
    }
    let ledger = solution.ledger();
    for (source, heat) in network.sources().iter().zip(&ledger.sources) {
        println!("{:<12}{:>10.1} kJ in", source.name(), heat / 1e3);
    }
    println!("{:<12}{:>10.1} kJ", "stored", ledger.stored.iter().sum::<f64>() / 1e3);
    for (boundary, heat) in network.boundaries().iter().zip(&ledger.boundaries) {
        println!("{:<12}{:>10.1} kJ out", boundary.name, -heat / 1e3);
    }
    Ok(())
}
