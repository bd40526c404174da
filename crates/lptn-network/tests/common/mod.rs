//! Small networks and values for the tests.
#![allow(
    dead_code,
    unreachable_pub,
    clippy::unwrap_used,
    reason = "each test file uses a part of it"
)]

use lptn_network::{
    Acts, BoundaryId, Conductance, Context, HeatCapacity, Input, NetworkBuilder, NodeId,
    Temperature, Thermostat, Time,
};
use lptn_units::{Type, parse_quantity};

pub const ABSOLUTE: Type = Type::ABSOLUTE_TEMPERATURE;

/// A written quantity; temperatures are differences.
pub fn quantity(text: &str) -> Input {
    parse_quantity(text, None).unwrap().into()
}

/// A written temperature.
pub fn celsius(text: &str) -> Input {
    parse_quantity(text, Some(ABSOLUTE)).unwrap().into()
}

/// An expression for a place.
pub fn expression(b: &NetworkBuilder, context: Context, text: &str) -> Input {
    b.expression_in(context, text, None).unwrap_or_else(|e| panic!("{text}: {e:?}")).into()
}

pub fn time(b: &NetworkBuilder, text: &str) -> Input {
    expression(b, Context::Time, text)
}

pub fn own(b: &NetworkBuilder, text: &str) -> Input {
    expression(b, Context::Own, text)
}

pub fn link(b: &NetworkBuilder, text: &str) -> Input {
    expression(b, Context::Link, text)
}

pub fn power(b: &NetworkBuilder, text: &str) -> Input {
    expression(b, Context::Source, text)
}

/// A node `a` of 10 J/K at 300 K, 2 W/K to `air` at 290 K through `cool`.
pub fn cooled() -> (NetworkBuilder, NodeId, BoundaryId) {
    let mut b = NetworkBuilder::new();
    let a = b.node("a", HeatCapacity(10.0), Temperature(300.0));
    let air = b.boundary("air", Temperature(290.0));
    b.resistor("cool", a, air, Conductance(2.0));
    (b, a, air)
}

/// The codes of everything that is wrong with a network.
pub fn codes(b: NetworkBuilder) -> Vec<&'static str> {
    b.build()
        .err()
        .map_or_else(Vec::new, |errors| errors.0.iter().map(|error| error.code()).collect())
}

pub fn near(found: f64, expected: f64) {
    assert!(
        (found - expected).abs() <= 1e-12 * expected.abs().max(1.0),
        "{found} is not {expected}"
    );
}

pub fn all_near(found: &[f64], expected: &[f64]) {
    assert_eq!(found.len(), expected.len(), "{found:?} {expected:?}");
    found.iter().zip(expected).for_each(|(f, e)| near(*f, *e));
}

/// Puts one fault into the network of [`cooled`].
pub type Fault = fn(&mut NetworkBuilder, NodeId, BoundaryId);

/// Each fault has these codes, without `network::`.
pub fn every(faults: &[(&str, Fault)]) {
    for (expected, fault) in faults {
        let (mut b, a, air) = cooled();
        fault(&mut b, a, air);
        let found = codes(b);
        let expected: Vec<String> =
            expected.split_whitespace().map(|code| format!("network::{code}")).collect();
        assert_eq!(found, expected);
    }
}

/// A control of this node.
pub fn thermostat(a: NodeId, acts: Acts, on: f64, off: f64) -> Thermostat<Input> {
    let (on, off) = (Temperature(on).into(), Temperature(off).into());
    Thermostat { sense: a.into(), acts, on, off, start: false, min_dwell: Time(5.0).into() }
}
