//! Periods: of repeated signals together, and whether inputs really repeat themselves.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common;

use common::{cooled, link, near, time};
use lptn_network::{
    AfterEnd, Conductance, Course, Field, HeatCapacity, Item, Network, NetworkBuilder, Path,
    Temperature,
};
use lptn_units::{Dimension, Type};

fn repeated(b: &mut NetworkBuilder, name: &str, period: f64) {
    let (times, values) = (vec![0.0, 0.3 * period], vec![1.0, 5.0]);
    b.signal(
        name,
        Type::of(Dimension::POWER),
        Course::Steps { times, values, after: AfterEnd::Repeat(period) },
    );
}

fn with(texts: &[&str], periods: &[f64]) -> Network {
    let (mut b, a, _) = cooled();
    for (i, period) in periods.iter().enumerate() {
        repeated(&mut b, &format!("s{i}"), *period);
    }
    for (i, text) in texts.iter().enumerate() {
        let p = time(&b, text);
        b.source(&format!("p{i}"), a, p);
    }
    b.build().unwrap()
}

#[test]
fn the_period_of_all_signals_that_are_used() {
    assert_eq!(with(&["s0"], &[60.0]).repeat_period(), Ok(Some(60.0)));
    near(with(&["s0", "s1"], &[60.0, 90.0]).repeat_period().unwrap().unwrap(), 180.0);
    near(
        with(&["s0 + s1 * s2 / 1 [W]"], &[60.0, 90.0, 50.0]).repeat_period().unwrap().unwrap(),
        900.0,
    );
    assert_eq!(
        with(&["s0"], &[60.0, 90.0]).repeat_period(),
        Ok(Some(60.0)),
        "nothing uses the other"
    );
    assert_eq!(with(&["1 [W]"], &[60.0]).repeat_period(), Ok(None));
    // in a comparison too
    assert_eq!(with(&["if(s0 > 2 [W], 1 [W], 2 [W])"], &[60.0]).repeat_period(), Ok(Some(60.0)));
    let error = with(&["s0 + s1"], &[60.0, 60.001]).repeat_period().unwrap_err();
    assert_eq!(error.names, ["s0", "s1"]);
    assert_eq!(error.signals.map(|id| id.index()), [0, 1]);
    common::all_near(&error.periods, &[60.0, 60.001]);
}

#[test]
fn inputs_that_repeat_themselves_and_others() {
    let checked =
        |text: &str, period: f64| with(&[text], &[60.0]).check_period(3.0, period).unwrap();
    assert_eq!(checked("s0", 60.0), Ok(()));
    assert_eq!(checked("s0", 120.0), Ok(()));
    assert_eq!(checked("7 [W] * sin(2 * pi * t / 60 [s])", 60.0), Ok(()));
    assert_eq!(checked("if(t < 1000 [s], 5 [W], 6 [W])", 60.0), Ok(()));
    assert!(checked("s0", 45.0).is_err());
    assert!(checked("if(t < 100 [s], 5 [W], 6 [W])", 60.0).is_err());
    assert!(checked("s0 + 1e-6 [W/s] * t", 60.0).is_err());
    assert_eq!(checked("s0 + 1e-13 [W/s] * t", 60.0), Ok(()), "rounding");
    let found = checked("5 [W] + 1 [W/s] * t", 60.0).unwrap_err();
    assert_eq!(
        (found.name.as_str(), found.field, found.unit.as_deref()),
        ("p0", Field::POWER, Some("W"))
    );
    assert!(matches!(found.item, Item::Source(_)));
    near(found.period, 60.0);
    assert!(found.time >= 3.0 && found.time <= 63.0);
    near(found.values[0].unwrap(), 5.0 + found.time);
    near(found.values[1].unwrap(), 65.0 + found.time);
}

/// A difference that lasts a millisecond, in the first period or in the one after it, is looked at:
/// each stretch between two breakpoints is.
#[test]
fn a_short_difference_is_seen() {
    let checked = |text: &str| with(&[text], &[60.0]).check_period(3.0, 60.0).unwrap();
    for from in [3.0, 50.0, 62.99, 63.0, 110.0, 122.99] {
        let text = format!("if(t < {from} [s], 5 [W], if(t < {} [s], 6 [W], 5 [W]))", from + 1e-3);
        assert!(checked(&text).is_err(), "{text}");
    }
    for from in [1.0, 123.0, 200.0] {
        let text = format!("if(t < {from} [s], 5 [W], if(t < {} [s], 6 [W], 5 [W]))", from + 1e-3);
        assert_eq!(checked(&text), Ok(()), "{text}");
    }
    // the same short pulse in both
    let pulse = "if(t < 50 [s], 0 [W], if(t < 50.001 [s], 1 [W], 0 [W]))";
    let later = "if(t < 110 [s], 0 [W], if(t < 110.001 [s], 1 [W], 0 [W]))";
    assert_eq!(checked(&format!("{pulse} + {later}")), Ok(()));
}

#[test]
fn a_value_that_ends_is_not_the_same_one_period_later() {
    let (mut b, a, _) = cooled();
    let p = time(&b, "1 [W] * (80 - t / 1 [s])^0.5 / (80 - t / 1 [s])^0.5");
    b.source("ends", a, p);
    let found = b.build().unwrap().check_period(0.0, 50.0).unwrap().unwrap_err();
    assert_eq!(found.name, "ends");
    assert!(found.time < 50.0 && found.time + 50.0 > 80.0);
    assert!(found.values[0].is_some() && found.values[1].is_none());
}

#[test]
fn fields_have_their_units_and_values_of_temperatures_are_compared_too() {
    let of = |add: &dyn Fn(&mut NetworkBuilder, lptn_network::NodeId, lptn_network::BoundaryId)| {
        let mut b = NetworkBuilder::new();
        let a = b.node("a", HeatCapacity(1.0), Temperature(300.0));
        let air = b.boundary("air", Temperature(290.0));
        b.resistor("r", a, air, Conductance(1.0));
        add(&mut b, a, air);
        b.build()
            .unwrap()
            .check_period(0.0, 60.0)
            .unwrap()
            .map_err(|found| (found.name, found.unit))
    };
    let unit = |name: &str, unit: &str| Err((name.to_owned(), Some(unit.to_owned())));
    assert_eq!(of(&|_, _, _| {}), Ok(()));
    let sky = of(&|b, _, _| {
        let t = time(b, "absolute(200 [K]) + 1 [K/s] * t");
        b.boundary("sky", t);
    });
    assert_eq!(sky, unit("sky", "K"));
    let g = of(&|b, a, air| {
        let g = link(b, "1 [W/K] + 1e-3 [W/(K^2 s)] * t * abs(dT)");
        b.resistor("g", a, air, Path::conductance(g));
    });
    assert_eq!(g, unit("g", "W/K"));
    let r = of(&|b, a, air| {
        let r = link(b, "1 [K/W] + 1e-3 [K/(W s)] * t");
        b.resistor("x", a, air, Path::resistance(r));
    });
    assert_eq!(r, unit("x", "K/W"));
    let h = of(&|b, a, air| {
        let h = link(b, "1 [W/(m^2 K)] * (1 + t / 1 [s])");
        b.convection("h", a, air, Path::film(h, common::quantity("1 m^2")));
    });
    assert_eq!(h, unit("h", "W/(m^2 K)"));
    let same = of(&|b, a, air| {
        let g = link(b, "1 [W/K] + 0.1 [W/K] * sin(2 * pi * t / 60 [s]) * abs(dT) / 1 [K]");
        b.resistor("g", a, air, Path::conductance(g));
    });
    assert_eq!(same, Ok(()));
}
