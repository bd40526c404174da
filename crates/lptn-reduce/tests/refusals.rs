//! Every way in which a reduction is refused: its code, and a help that can be followed.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking, in its helpers too")]

use crate::common;

use common::{assembled, chain};
use lptn_analysis::RunAnalysis;
use lptn_integrate::FactorError;
use lptn_network::{
    Acts, Conductance, Context, HeatCapacity, NetworkBuilder, Temperature, Thermostat, Time,
    UnknownName,
};
use lptn_reduce::{NortonEquivalent, ReduceError, Reduction, ReductionOptions, port};
use lptn_units::{Dimension, Type, parse_quantity};

/// One node on a boundary, with a fan that a thermostat switches.
fn switched() -> NetworkBuilder {
    let mut b = NetworkBuilder::new();
    let fan = b.control("fan");
    let node = b.node("a", HeatCapacity(1.0), Temperature(300.0));
    let air = b.boundary("air", Temperature(290.0));
    b.resistor("r", node, air, Conductance(1.0));
    let thermostat = Thermostat {
        sense: node.into(),
        acts: Acts::Cooling,
        on: Temperature(350.0).into(),
        off: Temperature(330.0).into(),
        start: false,
        min_dwell: Time(0.0).into(),
    };
    b.thermostat(fan, thermostat);
    let heat = b.expression_in(Context::Time, "7 [W] * (1 - fan)", None).unwrap();
    b.source("heat", node, heat);
    b
}

#[test]
fn a_network_that_switches_has_no_run_of_one_node() {
    let system = assembled(switched());
    let node = system.network().node("a").unwrap();
    let run = Some(RunAnalysis::until(Time(10.0)));
    let error =
        Reduction::new(&system, node, &ReductionOptions { run, ..Default::default() }).unwrap_err();
    assert_eq!(error.code(), "reduce::switches");
    assert!(
        error.to_string().contains("`fan`") && error.help().unwrap().contains("replace `fan` by")
    );
    // as it stands at the start it is linear: the fan is off, 7 W flow
    let still = Reduction::new(&system, node, &ReductionOptions::default()).unwrap();
    assert!((still.inputs.heat - 7.0).abs() < 1e-14);
    assert_eq!(still.network(&system, 0.0, None).unwrap_err().code(), "reduce::switches");
}

#[test]
fn what_is_not_linear_is_named_with_what_to_put_in_its_place() {
    let mut b = NetworkBuilder::new();
    let node = b.node("a", HeatCapacity(1.0), Temperature(300.0));
    let air = b.boundary("air", Temperature(290.0));
    let law = b.expression_in(Context::Link, "2 [W/K] * (1 + abs(dT) / 1 [K])", None).unwrap();
    b.resistor("film", node, air, lptn_network::Path::conductance(law));
    let error = NortonEquivalent::new(&assembled(b), node).unwrap_err();
    assert!(matches!(&error, ReduceError::NotLinear { name } if name == "film"), "{error:?}");
    assert!(error.help().unwrap().contains("replace `film` by"));
}

/// A capacity that no node can have: the error of the network that was to be built is told.
#[test]
fn an_equivalent_that_cannot_be_built_says_why() {
    let (system, nodes) = chain(&[1.0, 2.0], &[1.0, 1.0]);
    let reduction = Reduction::new(&system, nodes[1], &ReductionOptions::default()).unwrap();
    let mut pair = reduction.dynamics.as_ref().unwrap().pairs[0];
    pair.capacity = f64::INFINITY;
    let error = reduction.network(&system, 0.0, Some(&pair)).unwrap_err();
    assert_eq!(error.code(), "reduce::equivalent");
    assert!(error.to_string().contains("`n1`"), "{error}");
}

/// What a help tells to write can be written.
#[test]
fn helps_can_be_followed() {
    let (system, nodes) = chain(&[1.0, 1.0], &[1.0, 1.0]);
    let help = |error: ReduceError| error.help().unwrap_or_else(|| panic!("{error} has no help"));
    let network = system.network();
    let near = help(port(network, "n_0").unwrap_err());
    let name = near.split('`').nth(1).unwrap();
    assert_eq!(port(network, name).unwrap(), nodes[0]);
    let window = help(ReduceError::Window(0.0));
    let value = window.split('"').nth(1).unwrap();
    assert!(parse_quantity(value, Some(Type::of(Dimension::TIME))).is_ok(), "{value}");
    assert!(help(port(network, "end").unwrap_err()).contains("choose a node"));
    assert!(
        help(ReduceError::NoGround { names: vec!["x".into()] })
            .contains("add a path to a boundary")
    );
    assert!(help(FactorError::NotSymmetric.into()).contains("merging"));
    let nothing_near = UnknownName { name: "elsewhere".into(), suggestion: None };
    for error in [
        ReduceError::UnknownPort(nothing_near),
        ReduceError::Modes,
        ReduceError::Equivalent("x".into()),
    ] {
        assert_eq!(error.help(), None, "{error}");
    }
}

/// The codes are what scripts look for.
#[test]
fn codes_stay_as_they_are() {
    let codes = [
        (ReduceError::NoGround { names: Vec::new() }, "reduce::no_ground"),
        (ReduceError::NotLinear { name: String::new() }, "reduce::not_linear"),
        (FactorError::NotSymmetric.into(), "reduce::singular"),
        (ReduceError::Modes, "reduce::modes"),
        (ReduceError::OneWay, "reduce::one_way"),
        (ReduceError::Held { name: String::new() }, "reduce::held"),
        (ReduceError::Equivalent(String::new()), "reduce::equivalent"),
    ];
    for (error, code) in codes {
        assert_eq!(error.code(), code);
    }
}
