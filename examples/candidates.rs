//! Which joint between steel and aluminium is good enough? One network, many values: nothing is
//! parsed twice. `cargo run --release --example candidates`
#![allow(clippy::print_stdout)]

use lptn::prelude::*;

const NETWORK: &str = r#"
format = 1
title = "Gearbox with an unknown joint"
[param]
R_joint = "7.7 mK/W"
T_amb = "25.5 degC"
[default]
T0 = "T_amb"
[node]
steel = { C = "1235 J/K" }
aluminium = { C = "1424 J/K" }
[boundary]
ambient = { T = "T_amb" }
[resistor]
joint = { from = "steel", to = "aluminium", R = "R_joint" }
outer = { from = "aluminium", to = "ambient", R = "0.297 K/W" }
[source]
losses = { into = "steel", P = "220.6 W" }
"#;

fn main() -> Result<(), lptn::Error> {
    let network = lptn::parse("candidates", NETWORK)?.network;
    let (steel, system) = (network.node("steel")?, ThermalSystem::assemble(&network)?);
    println!("{:>12}{:>14}{:>14}", "R_joint", "at 25 min", "steady");
    for joint in ["2 mK/W", "7.7 mK/W", "20 mK/W", "50 mK/W", "0.1 K/W"] {
        let candidate = system.with(&network.overrides().with("R_joint", joint)?)?;
        let steady = SteadyState::solve(&candidate, 0.0)?[steel];
        let end = Transient::until(Time::minutes(25.0)).solve(&candidate)?.at_end(steel)?;
        let [end, steady] = [end, steady].map(|t| Temperature(t).in_celsius());
        println!("{joint:>12}{end:>9.2} degC{steady:>9.2} degC");
    }
    Ok(())
}
