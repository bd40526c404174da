//! The settled cycle of a motor on duty, found and waited for: states, work, CPU.
//!
//! `cargo run --release -p lptn-solve --example settled_cycle [TOLERANCE]`
//!
//! Winding, core and housing with radiation, free convection and a capacity that grows with
//! temperature; the slowest time constant is ten cycles. The tolerance is in K.
#![allow(clippy::print_stdout)]

use std::error::Error;

use lptn_assembly::ThermalSystem;
use lptn_network::{
    AfterEnd, Conductance, ConductorKind, Context, Course, HeatCapacity, NetworkBuilder, Path,
    Temperature, Time,
};
use lptn_solve::{Periodic, Transient};
use lptn_units::{Dimension, Type, parse_quantity};

type Outcome<T> = Result<T, Box<dyn Error>>;

const PERIOD: f64 = 560.0;

fn main() -> Outcome<()> {
    let tolerance = std::env::args().nth(1).map_or(Ok(1e-8), |text| text.parse())?;
    let system = motor()?;
    let settings = Transient::until(Time(PERIOD)).tolerance(tolerance);

    let begun = cpu()?;
    let found = Periodic::find(&system, &settings)?;
    let search = cpu()? - begun;

    let begun = cpu()?;
    let wait = Transient { stop: 200.0 * PERIOD, ..settings }.at(&[]);
    let waited = wait.solve(&system)?;
    let waiting = cpu()? - begun;

    let (steps, all) = (found.steps, waited.statistics().steps);
    println!("found:  {} cycles, {steps} steps, {search:.3} s CPU", found.cycles);
    println!("waited: 200 cycles, {all} steps, {waiting:.3} s CPU");
    println!(
        "ratio:  {:.3} of the steps, {:.3} of the CPU",
        steps as f64 / all as f64,
        search / waiting
    );
    println!("states: differ by {:.1e} K", found.state.distance(waited.last_state()));
    Ok(())
}

fn motor() -> Outcome<ThermalSystem> {
    let quantity = |text| parse_quantity(text, None).map_err(|error| format!("{error:?}"));
    let mut b = NetworkBuilder::new();
    let course = Course::Steps {
        times: vec![0.0, 190.0],
        values: vec![150.0, 0.0],
        after: AfterEnd::Repeat(PERIOD),
    };
    b.signal("duty", Type::of(Dimension::POWER), course);
    let in_context = |b: &NetworkBuilder, context, text| {
        b.expression_in(context, text, None).map_err(|error| format!("{text}: {error:?}"))
    };
    let winding = b.node("winding", HeatCapacity(300.0), Temperature(300.0));
    let capacity =
        in_context(&b, Context::Own, "2500 [J/K] * (1 + (T - absolute(300 [K])) / 1000 [K])")?;
    let core = b.node("core", capacity, Temperature(300.0));
    let housing = b.node("housing", HeatCapacity(1500.0), Temperature(300.0));
    let air = b.boundary("air", Temperature(300.0));
    b.resistor("slot", winding, core, Conductance(3.0));
    b.resistor("fit", core, housing, Conductance(5.0));
    let film = in_context(&b, Context::Link, "2.2 [W/(m^2 K^1.25)] * abs(dT)^0.25")?;
    b.convection("film", housing, air, Path::film(film, quantity("0.05 m^2")?));
    let glow = Path::radiation(quantity("0.04 m^2")?);
    b.conductor("glow", ConductorKind::Radiation, (housing.into(), air.into()), glow);
    let load = in_context(&b, Context::Source, "duty")?;
    b.source("load", winding, load);
    let network = b.build().map_err(|errors| format!("{errors:?}"))?;
    Ok(ThermalSystem::assemble(&network)?)
}

/// CPU time of this thread in s (Linux).
fn cpu() -> Outcome<f64> {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat")?;
    let nanoseconds: f64 = text.split_whitespace().next().ok_or("no time")?.parse()?;
    Ok(1e-9 * nanoseconds)
}
