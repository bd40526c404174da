//! A client of the library: candidates of one netlist with their table, doubts and verdict, one of
//! them as JSON, and a controller of its own that steps a simulation.
//! `cargo run --release --example client`
#![allow(clippy::print_stdout)]

use std::sync::Arc;

use lptn::prelude::*;

fn main() -> Result<(), lptn::Error> {
    let question = RunQuestion { select: vec!["*.T".into()], ..RunQuestion::default() };
    for fan in ["0 W/K", "1.5 W/K", "2.5 W/K"] {
        let input = Input::read("networks/gearbox_fan.toml")?.set(&[&format!("G_fan = {fan}")])?;
        let answer = question.ask(Arc::new(input), &Nobody)?;
        println!("--- G_fan = {fan}\n{}", answer.to_table());
        for doubt in answer.doubts() {
            println!("doubt [{}]: {}", doubt.code, doubt.message);
        }
        match answer.exit() {
            Exit::Done => println!("keeps its limits"),
            _ => answer.verdict().broken.iter().for_each(|broken| println!("{broken}")),
        }
    }

    let fans = "networks/gearbox_fan.toml";
    let steady = SteadyQuestion::default().ask(Arc::new(Input::read(fans)?), &Nobody)?;
    println!("--- steady state as JSON\n{}", steady.to_json());

    // a controller that the netlist does not know: less power if the steel is warm
    let input = Input::read(fans)?;
    let Some(settings) = &input.netlist.run else { return Ok(()) };
    let mut simulation = Simulation::new(&input.netlist.network, settings)?;
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
