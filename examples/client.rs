//! A client of the library: candidates of one netlist with their table, doubts and limits as JSON,
//! and a controller of its own that steps a simulation. `cargo run --release --example client`
#![allow(clippy::print_stdout)]

use lptn::analysis::{LimitResult, RunAnalysis, Simulation};
use lptn::answer::{bound, limits, trust};
use lptn::network::Item;
use lptn::prelude::*;
use lptn::solve::{Proceed, RecordedNodes};

fn main() -> Result<(), lptn::Error> {
    let netlist = lptn::read("networks/gearbox_fan.toml".as_ref())?;
    let (network, unit) = (&netlist.network, &netlist.temperature_unit);
    let Some(settings) = &netlist.run else { return Ok(()) };
    let steel = network.node("steel")?;
    let columns = Selection::of(network, |item| item == Item::Node(steel));

    for fan in ["0 W/K", "1.5 W/K", "2.5 W/K"] {
        let system = ThermalSystem::of(network, &netlist.overrides().with("G_fan", fan)?)?;
        let run = RunAnalysis::of(system.network(), settings).every(Time::minutes(30.0));
        let run = run.keeping(RecordedNodes::All).watching([steel]);
        let answer = run.solve(&system, &mut |_| Proceed::Continue)?;
        println!("G_fan = {fan}");
        lptn::report::write_csv(&Table::of_solution(&answer, &columns, unit), std::io::stdout())?;
        for doubt in
            trust::doubts(&netlist, &answer.trust, true).iter().chain(&bound::doubts(&answer))
        {
            println!("doubt [{}]: {}", doubt.code, doubt.message);
        }
        let fared: Vec<LimitResult> = answer.limits().iter().map(LimitResult::of_run).collect();
        let members = limits::members(system.network(), &fared, unit).unwrap_or_default();
        for (limit, member) in members {
            println!("{limit}: {member}");
        }
    }

    // a controller that the netlist does not know: less power where the steel is warm
    let mut simulation = Simulation::new(network, settings)?;
    println!("{:>8}{:>12}{:>10}", "time", "steel", "power");
    for minute in 1..=60 {
        let warm = simulation.temperature("steel")?.in_celsius();
        let power = 220.6 * ((80.0 - warm) / 10.0).clamp(0.2, 1.0);
        simulation.set("P_7000", power)?;
        simulation.advance(Time::minutes(f64::from(minute)), &[])?;
        if minute % 10 == 0 {
            println!("{minute:>4} min{warm:>7.2} degC{power:>8.1} W");
        }
    }
    Ok(())
}
