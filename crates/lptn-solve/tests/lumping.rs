//! Analytic: Biot numbers and diffusion times against the numbers of a textbook and sums by hand.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use lptn_assembly::ThermalSystem;
use lptn_network::{
    ConductorKind, Context, End, Formula, HeatCapacity, HeatFlow, Input, NetworkBuilder, NodeId,
    Path, Properties, Resistance, Size, Temperature, Time,
};
use lptn_solve::{Lumping, NotChecked, RecordedNodes, Solution, Transient};
use lptn_units::parse_quantity;

fn quantity(text: &str) -> Input {
    parse_quantity(text, None).unwrap().into()
}

fn kelvin(celsius: f64) -> Temperature {
    Temperature(celsius + 273.15)
}

#[track_caller]
fn close(a: f64, b: f64) {
    assert!((a - b).abs() <= 1e-12 * b.abs(), "{a} {b}");
}

/// A node of 20 W/(m K), 8500 kg/m^3 and 400 J/(kg K), with its characteristic length.
fn body(b: &mut NetworkBuilder, volume: &str, length: &str) -> NodeId {
    let material = b.material(
        "alloy",
        Properties {
            density: Some(quantity("8500 kg/m^3")),
            cp: Some(quantity("400 J/(kg K)")),
            k: Some(quantity("20 W/(m K)")),
            ..Properties::default()
        },
    );
    let capacity = b.lump(material, Size::Volume(quantity(volume))).unwrap();
    let node = b.node("body", capacity, kelvin(25.0));
    b.length(node, quantity(length));
    node
}

fn film(h: &str, area: &str) -> Path {
    Path::film(quantity(h), quantity(area))
}

fn at_start(b: NetworkBuilder) -> Lumping {
    let system = ThermalSystem::assemble(&b.build().unwrap()).unwrap();
    Lumping::at_start(&system, 0.0, None).unwrap()
}

fn run(b: NetworkBuilder, stop: f64) -> Solution {
    let system = ThermalSystem::assemble(&b.build().unwrap()).unwrap();
    Transient::until(Time(stop)).solve(&system).unwrap()
}

/// Incropera, 6th edition, example 5.1: a sphere of 0.706 mm in gas of 400 W/(m^2 K).
fn thermocouple() -> NetworkBuilder {
    let mut b = NetworkBuilder::new();
    let bead = body(&mut b, "0.184251e-9 m^3", "0.117667 mm");
    let gas = b.boundary("gas", kelvin(200.0));
    b.convection("film", bead, gas, film("400 W/(m^2 K)", "1.5659 mm^2"));
    b
}

#[test]
fn the_bead_of_a_thermocouple_is_a_lump() {
    let lumping = at_start(thermocouple());
    let check = lumping.checks[0];
    let biot = check.biot.unwrap();
    close(biot.number, 400.0 * 0.117667e-3 / 20.0);
    close(biot.coefficient, 400.0);
    close(biot.conductivity, 20.0);
    close(check.diffusion.unwrap(), 0.117667e-3 * 0.117667e-3 * 8500.0 * 400.0 / 20.0);
    assert!(lumping.too_thick().is_empty() && lumping.too_slow().is_empty());
    let lumping = Lumping::of_run(&run(thermocouple(), 8.0));
    assert!(lumping.too_slow().is_empty());
    close(lumping.shortest.unwrap().to, 8.0);
    // 2.4 ms to spread are not a tenth of 20 ms
    let short = Lumping::of_run(&run(thermocouple(), 0.02));
    assert_eq!(short.too_slow().len(), 1);
}

#[test]
fn surfaces_share_a_skin_or_lie_side_by_side() {
    let mut b = NetworkBuilder::new();
    let node = body(&mut b, "1 L", "30 mm");
    let air = b.boundary("air", kelvin(25.0));
    let wall = b.boundary("wall", kelvin(25.0));
    // two faces of air, which radiate; and a foot on the ground
    b.convection("front", node, air, film("10 W/(m^2 K)", "0.03 m^2"));
    b.convection("back", air, node, film("20 W/(m^2 K)", "0.02 m^2"));
    let exchange = Path::new(
        Formula::GreySurfaces,
        [Input::number(0.8), quantity("0.1 m^2"), Input::number(0.4)],
    );
    let ends = |to| (End::Node(node), End::Boundary(to));
    b.conductor("glow", ConductorKind::Radiation, ends(wall), exchange);
    b.conductor("foot", ConductorKind::Contact, ends(wall), film("500 W/(m^2 K)", "0.01 m^2"));
    // no surface of the body
    b.resistor("bolt", node, wall, Resistance(2.0));
    let glow = 0.8 * 0.1 * 0.4 * 5.670_374_419e-8 * 4.0 * f64::powi(298.15, 3);
    let conductance = 0.3 + 0.4 + glow + 5.0;
    let lumping = at_start(b);
    close(lumping.checks[0].biot.unwrap().coefficient, conductance / (0.05 + 0.01));
    let (check, biot) = lumping.too_thick()[0];
    assert_eq!(check.node, node);
    close(biot.number, conductance / 0.06 * 0.03 / 20.0);
}

/// h = 2 W/(m^2 K) times (dT / 1 K)^0.5 of a body that is heated from the temperature of the air.
fn plume() -> NetworkBuilder {
    let mut b = NetworkBuilder::new();
    let node = body(&mut b, "1 mL", "2 mm");
    let idle = b.node("idle", HeatCapacity(1.0), kelvin(25.0));
    let air = b.boundary("air", kelvin(25.0));
    let text = "2 [W/(m^2 K)] * (abs(dT) / 1 [K])^0.5";
    let h = b.expression_in(Context::Link, text, None).unwrap();
    b.convection("plume", node, air, Path::film(h, quantity("3 cm^2")));
    b.resistor("tie", idle, air, Resistance(1.0));
    b.source("heat", node, HeatFlow(0.5));
    b
}

#[test]
fn the_largest_number_of_a_run_counts() {
    let start = at_start(plume()).checks[0].biot.unwrap();
    assert!(start.coefficient.abs() < 1e-12, "nothing moves yet");
    let solution = run(plume(), 60.0);
    let node = solution.recorded()[0];
    let end = solution.temperature(node).unwrap().pop().unwrap();
    let lumping = Lumping::of_run(&solution);
    let biot = lumping.checks[0].biot.unwrap();
    close(biot.coefficient, 2.0 * (end - 298.15).sqrt());
    close(biot.time, 60.0);
    assert_eq!(lumping.without_length.len(), 1);
    // where only another node was recorded, start and end are looked at
    let system = ThermalSystem::assemble(&plume().build().unwrap()).unwrap();
    let mut transient = Transient::until(Time(60.0));
    transient.record = RecordedNodes::Nodes(lumping.without_length.clone());
    let part = Lumping::of_run(&transient.solve(&system).unwrap());
    assert!((part.checks[0].biot.unwrap().number - biot.number).abs() < 1e-6 * biot.number);
}

#[test]
fn what_cannot_be_checked_has_a_reason() {
    let mut b = NetworkBuilder::new();
    let node = body(&mut b, "1 L", "20 mm");
    let air = b.boundary("air", kelvin(25.0));
    let plain = b.node("plain", HeatCapacity(1.0), kelvin(25.0));
    b.length(plain, quantity("20 mm"));
    b.convection("known", plain, air, film("1 W/(m^2 K)", "1 m^2"));
    let skin = b.convection("skin", node, air, Resistance(2.0));
    let junction = b.massless("junction");
    b.resistor("to_junction", junction, plain, Resistance(1.0));
    let lumping = at_start(b);
    assert_eq!(lumping.checks[0].biot, Err(NotChecked::NoArea(skin)));
    assert!(lumping.checks[0].diffusion.is_ok(), "that takes no surface");
    assert_eq!(lumping.checks[1].biot, Err(NotChecked::NoMaterial));
    assert_eq!(lumping.checks[1].diffusion, Err(NotChecked::NoMaterial));
    assert!(lumping.without_length.is_empty(), "a junction is not a body");
    assert_eq!(lumping.shortest, None);
}

#[test]
fn the_shortest_stretch_lies_between_jumps_not_between_kinks() {
    let mut b = NetworkBuilder::new();
    let node = body(&mut b, "1 L", "20 mm");
    let air = b.boundary("air", kelvin(25.0));
    b.convection("skin", node, air, film("10 W/(m^2 K)", "0.05 m^2"));
    // a ramp up to 100 s, then pulses of 30 s
    let text =
        "if(t < 300 [s], 10 [W] * min(t, 100 [s]) / 100 [s], if(t < 330 [s], 50 [W], 0 [W]))";
    let heat = b.expression(text, None).unwrap();
    b.source("heat", node, heat);
    let network = b.build().unwrap();
    let system = ThermalSystem::assemble(&network).unwrap();
    let lumping = Lumping::at_start(&system, 0.0, Some(900.0)).unwrap();
    let stretch = lumping.shortest.unwrap();
    close(stretch.from, 300.0);
    close(stretch.to, 330.0);
    // 68 s for 2 cm
    close(lumping.too_slow()[0].1, 4e-4 * 8500.0 * 400.0 / 20.0);
}
