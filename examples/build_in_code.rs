//! A network without a file: a chip on a heat sink that is switched on and off, against its closed
//! form. `cargo run --release --example build_in_code`
#![allow(clippy::print_stdout)]

use lptn::prelude::*;

fn main() -> Result<(), lptn::Error> {
    let ambient = Temperature::celsius(40.0);
    let mut b = NetworkBuilder::new();
    let sink = b.node("sink", HeatCapacity(180.0), ambient);
    let junction = b.massless("junction"); // stores next to nothing: follows at once
    let air = b.boundary("air", ambient);
    b.resistor("package", junction, sink, Resistance(0.4));
    b.convection("fins", sink, air, Resistance(1.2));
    let pulse = b.expression("if(t < 120 [s], 25 [W], 0 [W])", None)?;
    b.source("losses", junction, pulse);

    let system = ThermalSystem::assemble(&b.build()?)?;
    let solution = Transient::until(Time(360.0)).every(Time(60.0)).solve(&system)?;
    let (sink, junction) = (solution.series(sink)?, solution.series(junction)?);
    println!("{:>6}{:>12}{:>12}{:>12}", "t [s]", "sink", "exact", "junction");
    for (row, &t) in solution.times().iter().enumerate() {
        let [sink, junction] = [sink[row], junction[row]].map(|t| Temperature(t).in_celsius());
        println!("{t:>6}{sink:>12.4}{:>12.4}{junction:>12.4} degC", exact(t));
    }
    Ok(())
}

/// One node, `P R = 30 K`, time constant `R C = 216 s`; the pulse ends at 120 s.
fn exact(t: f64) -> f64 {
    let rise = |t: f64| 30.0 * (1.0 - f64::exp(-t / 216.0));
    40.0 + if t <= 120.0 { rise(t) } else { rise(120.0) * f64::exp((120.0 - t) / 216.0) }
}
