//! Controls and comparisons of temperatures: where they stand, how far they are from switching, and
//! what reads them.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common;

use common::{cooled, expression, link, near, power, time};
use lptn_network::{
    Acts, ConductorKind, Context, End, Field, Input, InputProblem, Item, NetworkBuilder, Path,
    Positions, Temperature, Thermostat, Time,
};

fn thermostat(sense: End, acts: Acts, on: Input, off: Input) -> Thermostat<Input> {
    Thermostat { sense, acts, on, off, start: true, min_dwell: Time(30.0).into() }
}

fn kelvin(t: f64) -> Input {
    Temperature(t).into()
}

#[test]
fn excess_is_positive_beyond_the_threshold_that_counts() {
    let (mut b, a, air) = cooled();
    let (fan, heater, out) = (b.control("fan"), b.control("heater"), b.control("out"));
    b.thermostat(fan, thermostat(a.into(), Acts::Cooling, kelvin(350.0), kelvin(340.0)));
    b.thermostat(heater, thermostat(a.into(), Acts::Heating, kelvin(300.0), kelvin(305.0)));
    b.thermostat(
        out,
        Thermostat {
            start: false,
            ..thermostat(air.into(), Acts::Cooling, kelvin(299.0), kelvin(280.0))
        },
    );
    let network = b.build().unwrap();
    assert!(network.has_events());
    let begin = network.initial_positions();
    assert_eq!(begin, Positions { controls: vec![true, true, false], switches: vec![] });
    assert_eq!(network.evaluation().positions(), begin);
    assert_eq!(network.control_ids().len(), 3);
    assert_eq!((network.dead_band(fan), network.dead_band(heater)), (Some(10.0), Some(5.0)));
    assert!((network.min_dwell(fan) - 30.0).abs() < 1e-15);
    let mut scope = network.evaluation();
    let mut excess = |controls: [bool; 3]| {
        scope.set_positions(&Positions { controls: controls.to_vec(), switches: vec![] });
        assert_eq!(scope.positions().controls, controls);
        [fan, heater, out].map(|id| {
            assert_eq!(scope.is_on(id), controls[id.index()]);
            near(scope.control(id), f64::from(u8::from(controls[id.index()])));
            network.control_excess(id, &mut scope, &[347.0, 290.0]).unwrap()
        })
    };
    for (found, expected) in [
        (excess([true, true, true]), [-7.0, 42.0, -10.0]),
        (excess([false, false, false]), [-3.0, -47.0, -9.0]),
    ] {
        found.into_iter().zip(expected).for_each(|(f, e)| near(f, e));
    }
}

#[test]
fn thresholds_may_depend_on_time_and_temperatures() {
    let (mut b, a, _) = cooled();
    let fan = b.control("fan");
    let on = expression(&b, Context::Control, "air.T + 20 [K] + 1 [K/s] * t");
    let off = expression(&b, Context::Control, "air.T + 40 [K] - 1 [K/s] * t");
    b.thermostat(fan, thermostat(a.into(), Acts::Cooling, on, off));
    let network = b.build().unwrap();
    assert_eq!(network.dead_band(fan), None);
    let mut scope = network.evaluation();
    let error = network.control_excess(fan, &mut scope, &[300.0, 290.0]).unwrap_err();
    assert_eq!((error.item, error.field), (Item::Control(fan), Field::OnAbove));
    assert!(
        matches!(error.problem, InputProblem::ThresholdsCrossed { on, off } if (on, off) == (310.0, 330.0)),
        "{error}"
    );
    scope.set_time(15.0, 15.0);
    near(network.control_excess(fan, &mut scope, &[300.0, 290.0]).unwrap(), 315.0 - 300.0);
    scope.set_positions(&Positions { controls: vec![false], switches: vec![] });
    near(network.control_excess(fan, &mut scope, &[300.0, 280.0]).unwrap(), 300.0 - 315.0);
}

#[test]
fn the_name_of_a_control_is_0_or_1() {
    let (mut b, a, _) = cooled();
    let fan = b.control("fan");
    b.thermostat(fan, thermostat(a.into(), Acts::Cooling, kelvin(350.0), kelvin(340.0)));
    let p = time(&b, "10 [W] + 5 [W] * fan");
    b.source("p", a, p);
    let network = b.build().unwrap();
    let mut scope = network.evaluation();
    let mut powers = |on: bool| {
        scope.set_positions(&Positions { controls: vec![on], switches: vec![] });
        let mut out = [f64::NAN];
        network.source_powers(&mut scope, &mut out).unwrap();
        out[0]
    };
    near(powers(true), 15.0);
    near(powers(false), 10.0);
    assert!(!network.has_time_dependent_inputs());
}

/// Each comparison of temperatures is a switch: its truth stands still until it is set.
#[test]
fn comparisons_of_temperatures_are_held() {
    let (mut b, a, air) = cooled();
    let p =
        power(&b, "if(T > absolute(310 [K]), if(air.T < absolute(280 [K]), 3 [W], 5 [W]), 4 [W])");
    let source = b.source("p", a, p);
    let g = link(&b, "if(2 * dT >= 15 [K] - 1 [K/s] * t, 5 [W/K], 1 [W/K])");
    let path =
        b.conductor("g", ConductorKind::Resistor, (a.into(), air.into()), Path::conductance(g));
    let network = b.build().unwrap();
    assert_eq!((network.switches().len(), network.switch_ids().len()), (3, 3));
    let items: Vec<Item> = network.switches().iter().map(|switch| switch.item).collect();
    assert_eq!(items, [Item::Source(source), Item::Source(source), Item::Conductor(path)]);
    assert_eq!(network.switches()[2].field.key(), "G");
    let mut scope = network.evaluation();
    scope.set_time(2.0, 2.0);
    let at = [304.0, 290.0];
    let found: Vec<(f64, f64)> = network
        .switch_ids()
        .map(|id| network.switch_difference(id, &mut scope, &at).unwrap())
        .collect();
    for ((difference, slope), (d, s)) in
        found.into_iter().zip([(-6.0, 1.0), (10.0, 1.0), (15.0, 4.0)])
    {
        near(difference, d);
        near(slope, s);
    }
    let holds = |k: usize, d: f64| network.switches()[k].holds(d);
    assert!(holds(0, 1.0) && !holds(0, -1.0) && !holds(0, 0.0));
    assert!(holds(1, -1.0) && !holds(1, 1.0));
    assert!(holds(2, 1.0) && holds(2, 0.0) && !holds(2, -1.0));
    let mut heat = |switches: [bool; 3]| {
        scope.set_positions(&Positions { controls: vec![], switches: switches.to_vec() });
        assert_eq!(scope.positions().switches, switches);
        let q = network.source_heat(source, &mut scope, &at).unwrap();
        (q, network.exchange(path, &mut scope, &at).unwrap()[1])
    };
    assert_eq!(heat([true, true, true]), (3.0, 70.0));
    assert_eq!(heat([true, false, false]), (5.0, 14.0));
    assert_eq!(heat([false, true, false]), (4.0, 14.0));
    // the comparison itself is gone from the values: it does not switch where the sides do
    let (b, ..) = cooled();
    assert!(!b.build().unwrap().has_events());
}

#[test]
fn a_control_compared_with_time_switches_too() {
    let (mut b, a, _) = cooled();
    let fan = b.control("fan");
    b.thermostat(fan, thermostat(a.into(), Acts::Cooling, kelvin(350.0), kelvin(340.0)));
    let p = time(&b, "if(t > 10 [s] * (1 + fan), 1 [W], 2 [W])");
    b.source("late", a, p);
    let p = time(&b, "if(fan > 0.5, 1 [W], 2 [W])");
    b.source("plain", a, p);
    let network = b.build().unwrap();
    assert_eq!(network.switches().len(), 1);
    let mut scope = network.evaluation();
    scope.set_time(13.0, 13.0);
    let id = network.switch_ids().next().unwrap();
    let (difference, slope) = network.switch_difference(id, &mut scope, &[300.0, 290.0]).unwrap();
    near(difference, 13.0 - 20.0);
    near(slope, 0.0);
}

#[test]
fn a_control_that_nothing_describes_never_switches() {
    let mut b = NetworkBuilder::new();
    b.node("a", lptn_network::HeatCapacity(1.0), Temperature(300.0));
    let network = b.build().unwrap();
    assert!(network.controls().is_empty() && network.initial_positions() == Positions::default());
}
