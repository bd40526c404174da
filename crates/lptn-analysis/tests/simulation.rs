//! Simulations that are stepped from outside, against closed forms.

use lptn_analysis::{Simulation, SimulationError};
use lptn_network::{
    Conductance, Context, HeatCapacity, HeatFlow, IntegratorChoice, Network, NetworkBuilder,
    OutputTimes, RunSettings, StateLaw, Temperature, Time,
};
use lptn_units::Expression;

const C: f64 = 1000.0;
const ZERO: f64 = 273.15;

fn settings() -> RunSettings {
    RunSettings {
        stop: 1000.0,
        output: OutputTimes::Every(100.0),
        integrator: IntegratorChoice::Auto,
        ..RunSettings::cycle(None, 1000.0)
    }
}

/// A body of 1 kJ/K at 20 degC with a heater of `P` and a path of `G` to air at 20 degC.
fn body() -> Network {
    let mut b = NetworkBuilder::new();
    b.parameter("P", HeatFlow(0.0));
    b.parameter("G", Conductance(2.0));
    let body = b.node("body", HeatCapacity(C), Temperature::celsius(20.0));
    let air = b.boundary("air", Temperature::celsius(20.0));
    let g = b.expression_in(Context::Link, "G", None).unwrap();
    b.resistor("skin", body, air, lptn_network::Path::conductance(g));
    let power = b.expression_in(Context::Source, "P", None).unwrap();
    b.source("heater", body, power);
    b.build().unwrap()
}

fn celsius(simulation: &Simulation) -> f64 {
    simulation.temperature("body").unwrap().0 - ZERO
}

/// The temperature in degC after a time in s under constant inputs, from one in degC.
fn after(from: f64, time: f64, power: f64, g: f64) -> f64 {
    let settled = 20.0 + power / g;
    settled + (from - settled) * (-time * g / C).exp()
}

/// At the start, after a step, and after an input is set: the heats are those of the temperatures.
#[test]
fn heats_are_those_of_the_present_state() {
    let mut simulation = Simulation::new(&body(), &settings()).unwrap();
    simulation.set("P", 40.0).unwrap();
    let step = simulation.advance(Time(500.0), &[]).unwrap();
    let rise = after(20.0, 500.0, 40.0, 2.0) - 20.0;
    let close = |a: f64, b: f64, within: f64| assert!((a - b).abs() < within, "{a} for {b}");
    // 2 W/K, and twice as much after the conductance is set
    for g in [2.0, 4.0] {
        simulation.set("G", g).unwrap();
        let at = simulation.snapshot().unwrap();
        close(at.temperatures[0] - ZERO, 20.0 + rise, 1e-4);
        close(at.received[0][1], g * rise, 1e-3);
        close(at.source_heat[0], 40.0, 1e-12);
        close(at.boundary_heat[0], -g * rise, 1e-3);
        close(at.stored(simulation.network())[0], 40.0 - g * rise, 1e-3);
    }
    let heats = step.ledger().heats(step.network());
    let found: Vec<_> = heats.iter().map(|(part, name, _)| (*part, name.as_ref())).collect();
    let expected = [("sources", "heater"), ("boundaries", "air"), ("stored", "body")];
    assert_eq!(found, expected);
    let joules = [40.0 * 500.0, C * rise - 40.0 * 500.0, C * rise];
    for ((.., heat), joules) in heats.iter().zip(joules) {
        close(*heat, joules, 0.5);
    }
}

#[test]
fn inputs_that_are_set_between_steps_are_met_exactly() {
    let mut simulation = Simulation::new(&body(), &settings()).unwrap();
    let mut expected = 20.0;
    assert!((celsius(&simulation) - 20.0).abs() < 1e-12);
    let steps = [(50.0, 100.0, 2.0), (20.0, 0.0, 2.0), (300.0, 40.0, 0.5), (7.0, 40.0, 9.0)];
    for (length, power, g) in steps {
        simulation.set("P", power).unwrap();
        simulation.set("G", g).unwrap();
        let to = simulation.time() + length;
        let middle = to - 0.5 * length;
        let step = simulation.advance(Time(to), &[middle]).unwrap();
        let row = step.temperature(step.network().node("body").unwrap()).unwrap();
        let half = after(expected, 0.5 * length, power, g);
        assert!((row[1] - ZERO - half).abs() < 1e-4, "{} for {half}", row[1] - ZERO);
        expected = after(expected, length, power, g);
        assert!((celsius(&simulation) - expected).abs() < 1e-4, "{expected}");
        let rate = (power - g * (expected - 20.0)) / C;
        assert!((simulation.rates().unwrap().states[0] - rate).abs() < 1e-6, "{rate}");
    }
}

#[test]
fn a_boundary_has_its_temperature() {
    let simulation = Simulation::new(&body(), &settings()).unwrap();
    assert!((simulation.temperature("air").unwrap().0 - ZERO - 20.0).abs() < 1e-12);
    assert!(simulation.temperature("water").is_err());
}

#[test]
fn what_was_saved_goes_on_to_the_same_bits() {
    let mut one = Simulation::new(&body(), &settings()).unwrap();
    one.set("P", 80.0).unwrap();
    one.advance(Time(100.0), &[]).unwrap();
    let saved = one.save();
    let mut other = Simulation::new(&body(), &settings()).unwrap();
    other.restore(&saved).unwrap();
    assert_eq!(other.save(), saved);
    for simulation in [&mut one, &mut other] {
        simulation.advance(Time(250.0), &[]).unwrap();
        simulation.release("P").unwrap();
        simulation.advance(Time(400.0), &[]).unwrap();
    }
    assert_eq!(celsius(&one).to_bits(), celsius(&other).to_bits());
    let warm = after(after(20.0, 250.0, 80.0, 2.0), 150.0, 0.0, 2.0);
    assert!((celsius(&one) - warm).abs() < 1e-4, "{} for {warm}", celsius(&one));
    let mut foreign = saved.clone();
    foreign.carried.push(300.0);
    assert!(matches!(other.restore(&foreign), Err(SimulationError::Foreign)));
}

#[test]
fn what_cannot_be_set_leaves_everything_as_it_was() {
    let mut simulation = Simulation::new(&body(), &settings()).unwrap();
    let before = simulation.save();
    assert!(matches!(simulation.set("body", 1.0), Err(SimulationError::NotAnInput(_))));
    assert!(matches!(simulation.set("Q", 1.0), Err(SimulationError::Unknown(_))));
    assert!(matches!(simulation.set("G", -1.0), Err(SimulationError::Refused(_))));
    assert!(simulation.advance(Time(-1.0), &[]).is_err());
    assert_eq!(simulation.save(), before);
}

/// A controller of the client's own: a heater that a thread switches every 10 s.
#[test]
fn it_is_sent_to_another_thread() {
    let mut simulation = Simulation::new(&body(), &settings()).unwrap();
    let stepped = std::thread::spawn(move || {
        for step in 1..=20 {
            let warm = celsius(&simulation) > 25.0;
            simulation.set("P", if warm { 0.0 } else { 200.0 }).unwrap();
            simulation.advance(Time(10.0 * f64::from(step)), &[]).unwrap();
        }
        celsius(&simulation)
    });
    let mut expected = 20.0;
    for _ in 0..20 {
        let power = if expected > 25.0 { 0.0 } else { 200.0 };
        expected = after(expected, 10.0, power, 2.0);
    }
    assert!((stepped.join().unwrap() - expected).abs() < 1e-3, "{expected}");
}

/// A battery of 2 Ah that 1 A discharges: `2 - t / 3600 s` in Ah, and the current set from outside.
#[test]
fn a_state_is_read_by_its_name() {
    let quantity = |text: &str| lptn_units::parse_quantity(text, None).unwrap();
    let mut b = NetworkBuilder::new();
    b.parameter("I", quantity("1 A"));
    let full = quantity("2 A h");
    let id = b.state("charge", full.ty, full.value);
    let (start, empty) =
        (Expression::literal(full.value, full.ty), Expression::literal(0.0, full.ty));
    let (rate, bounds) = (Expression::parse("-I").unwrap(), [Some(&empty), None]);
    b.state_law(id, StateLaw { start: &start, rate: &rate, every: None, bounds }).unwrap();
    let cell = b.node("cell", HeatCapacity(C), Temperature::celsius(20.0));
    let air = b.boundary("air", Temperature::celsius(20.0));
    b.resistor("skin", cell, air, Conductance(0.1));
    let network = b.build().unwrap();
    let mut simulation = Simulation::new(&network, &settings()).unwrap();
    let charge = |simulation: &Simulation| simulation.state("charge").unwrap() / 3600.0;
    assert!((charge(&simulation) - 2.0).abs() < 1e-12);
    simulation.advance(Time(1800.0), &[]).unwrap();
    assert!((charge(&simulation) - 1.5).abs() < 1e-6);
    simulation.set("I", 4.0).unwrap();
    simulation.advance(Time(2700.0), &[]).unwrap();
    assert!((charge(&simulation) - 0.5).abs() < 1e-6);
    assert!(simulation.state("charg").is_err());
}
