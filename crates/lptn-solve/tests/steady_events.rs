//! Steady states of networks that switch: every temperature from the closed form of one node, P/G
//! above the ambient.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking, in its helpers too")]

use lptn_assembly::ThermalSystem;
use lptn_network::{
    Acts, Conductance, Context, ControlId, End, HeatCapacity, Input, NetworkBuilder, NodeId, Path,
    Temperature, Thermostat, Time,
};
use lptn_solve::{SteadyError, SteadyState};

const AMBIENT: f64 = 293.15;

fn kelvin_above(k: f64) -> Input {
    Temperature(AMBIENT + k).into()
}

/// A node of 600 J/K with its ambient.
fn node(b: &mut NetworkBuilder, name: &str) -> NodeId {
    b.node(name, HeatCapacity(600.0), Temperature(AMBIENT))
}

fn source(b: &mut NetworkBuilder, name: &str, into: NodeId, power: &str) {
    let power = b.expression_in(Context::Source, power, None).unwrap();
    b.source(name, into, power);
}

fn thermostat(
    b: &mut NetworkBuilder,
    id: ControlId,
    (sense, acts): (NodeId, Acts),
    (on, off): (f64, f64),
    start: bool,
) {
    let (on, off, min_dwell) = (kelvin_above(on), kelvin_above(off), Time(5.0).into());
    b.thermostat(id, Thermostat { sense: End::Node(sense), acts, on, off, start, min_dwell });
}

fn solve(b: NetworkBuilder) -> Result<SteadyState, SteadyError> {
    SteadyState::solve(&ThermalSystem::assemble(&b.build().unwrap()).unwrap(), 0.0)
}

/// 240 W on 3 W/K, or on 12 W/K with the fan: 80 K or 20 K above the ambient.
fn with_fan(thresholds: (f64, f64), start: bool) -> Result<SteadyState, SteadyError> {
    with_fan_from(0.0, thresholds, start)
}

/// The same from so many K above the ambient.
fn with_fan_from(
    from: f64,
    thresholds: (f64, f64),
    start: bool,
) -> Result<SteadyState, SteadyError> {
    let mut b = NetworkBuilder::new();
    let fan = b.control("fan");
    let body = b.node("body", HeatCapacity(600.0), Temperature(AMBIENT + from));
    let air = b.boundary("air", Temperature(AMBIENT));
    let g = b.expression_in(Context::Link, "3 [W/K] + 9 [W/K] * fan", None).unwrap();
    b.resistor("skin", body, air, Path::conductance(g));
    source(&mut b, "loss", body, "240 [W]");
    thermostat(&mut b, fan, (body, Acts::Cooling), thresholds, start);
    solve(b)
}

#[test]
fn steady_state_agrees_with_its_control() {
    let steady = with_fan((40.0, 15.0), false).unwrap();
    assert_eq!(steady.positions.controls, [true]);
    assert!((steady.temperatures[0] - AMBIENT - 20.0).abs() < 1e-9);
    let steady = with_fan((90.0, 85.0), true).unwrap();
    assert_eq!(steady.positions.controls, [false]);
    assert!((steady.temperatures[0] - AMBIENT - 80.0).abs() < 1e-9);
}

#[test]
fn where_both_positions_agree_the_start_decides() {
    // below 15 K a fan that is on goes off at once, and 80 K never switches it on again
    for (from, start, expected) in
        [(50.0, false, 80.0), (50.0, true, 20.0), (0.0, true, 80.0), (100.0, false, 20.0)]
    {
        let steady = with_fan_from(from, (90.0, 15.0), start).unwrap();
        assert!((steady.temperatures[0] - AMBIENT - expected).abs() < 1e-9);
    }
}

#[test]
fn network_that_cycles_has_no_steady_state() {
    let error = with_fan((40.0, 35.0), false).unwrap_err();
    assert_eq!(error.code(), "steady::cycles");
    let SteadyError::Cycles { names, tried } = &error else { panic!("{error}") };
    assert_eq!((names.as_slice(), *tried), (["fan".to_owned()].as_slice(), 2));
    assert!(error.to_string().starts_with("no steady state: in each of"), "{error}");
}

#[test]
fn comparisons_of_temperatures_agree_too() {
    for (power, expected) in [
        ("if(T < 50 [degC], 240 [W], 120 [W])", 40.0), // 20 degC + 40 K is not below 50 degC
        ("if(T < 110 [degC], 240 [W], 120 [W])", 80.0),
        ("if(body.T > 110 [degC], 120 [W], 240 [W])", 80.0),
    ] {
        let mut b = NetworkBuilder::new();
        let body = node(&mut b, "body");
        let air = b.boundary("air", Temperature(AMBIENT));
        b.resistor("skin", body, air, Conductance(3.0));
        source(&mut b, "element", body, power);
        let steady = solve(b).unwrap();
        assert!((steady.temperatures[0] - AMBIENT - expected).abs() < 1e-9, "{power}");
    }
}

#[test]
fn positions_that_the_start_does_not_lead_to_are_found() {
    // each heater is on while the other one's node is cold: from both off, both go on, and off
    // again
    let mut b = NetworkBuilder::new();
    let controls = ["first", "second"].map(|name| b.control(name));
    let nodes = ["a", "b"].map(|name| node(&mut b, name));
    let air = b.boundary("air", Temperature(AMBIENT));
    for (i, node) in nodes.into_iter().enumerate() {
        b.resistor(["skin_a", "skin_b"][i], node, air, Conductance(3.0));
        source(&mut b, ["heat_a", "heat_b"][i], node, ["30 [W] * first", "30 [W] * second"][i]);
    }
    for i in 0..2 {
        thermostat(&mut b, controls[i], (nodes[1 - i], Acts::Heating), (5.0, 6.0), false);
    }
    let steady = solve(b).unwrap();
    assert_eq!(steady.positions.controls, [true, false]);
    assert!((steady.temperatures[0] - AMBIENT - 10.0).abs() < 1e-9);
    assert!((steady.temperatures[1] - AMBIENT).abs() < 1e-9);
}

#[test]
fn of_many_controls_at_most_64_positions_are_tried() {
    // seven fans, each of which cycles by itself
    let mut b = NetworkBuilder::new();
    let fans: Vec<ControlId> = (0..7).map(|i| b.control(&format!("fan{i}"))).collect();
    let air = b.boundary("air", Temperature(AMBIENT));
    for (i, fan) in fans.into_iter().enumerate() {
        let body = node(&mut b, &format!("body{i}"));
        let g = format!("3 [W/K] + 9 [W/K] * fan{i}");
        let g = b.expression_in(Context::Link, &g, None).unwrap();
        b.resistor(&format!("skin{i}"), body, air, Path::conductance(g));
        source(&mut b, &format!("loss{i}"), body, "240 [W]");
        thermostat(&mut b, fan, (body, Acts::Cooling), (40.0, 35.0), false);
    }
    let error = solve(b).unwrap_err();
    assert!(
        matches!(&error, SteadyError::Cycles { tried: 64, names } if names.len() == 7),
        "{error}"
    );
    assert!(error.to_string().ends_with("`fan0`, `fan1` and 5 more things"), "{error}");
}
