//! A client of the library: candidates of one netlist with their table, doubts and verdict, one of
//! them as JSON, a controller that steps a simulation, and the derivatives for other simulators.
//! `cargo run --release --example client`
#![allow(clippy::print_stdout)]

use std::sync::Arc;

use lptn::prelude::*;
use lptn::{Direction, EventIndicator};

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

    // a fan that a thermostat switches has no steady state
    let still = Input::read("networks/gearbox.toml")?;
    let steady = SteadyQuestion::default().ask(Arc::new(still), &Nobody)?;
    println!("--- steady state as JSON\n{}", steady.to_json());

    // a controller that the netlist does not know: less power if the steel is warm
    let input = Input::read("networks/gearbox_fan.toml")?;
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

    // for a simulator that integrates the states itself: events and exact derivatives
    for indicator in simulation.event_indicators()? {
        let EventIndicator { name, value, unit, positive, .. } = indicator;
        println!("{name:>10}{value:>8.2} {unit} above 0: {positive:?}");
    }
    let slopes = simulation.slopes(&["P_7000"])?;
    for (value, row, column) in slopes.jacobian().entries() {
        println!("d(rate {row})/d(state {column}) = {value:.6} 1/s");
    }
    let states = vec![0.0; simulation.states().len()];
    let along = slopes.along(&Direction { states, inputs: vec![1.0] })?;
    println!("1 W more: {:?} K/s", along.states);
    Ok(())
}
