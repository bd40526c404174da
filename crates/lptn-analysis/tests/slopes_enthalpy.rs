//! Derivatives of the rates of a body that melts, whose state is its enthalpy.

use crate::slopes::{assert_near, by_input, dense, quantity, simulation};

use lptn_analysis::{Simulation, SimulationError};
use lptn_network::{Conductance, Melting, NetworkBuilder, Properties, Size, Temperature, Time};
use lptn_solve::Direction;

/// Wax with c = 2000 J/(kg K), 2e5 J/kg of latent heat between 320 and 330 K, 2 kg; G = 5 W/K.
fn wax(start: f64) -> Simulation {
    let mut b = NetworkBuilder::new();
    b.parameter("m", quantity("2 kg"));
    b.parameter("T_air", Temperature(400.0));
    let (solidus, liquidus) = (Temperature(320.0).into(), Temperature(330.0).into());
    let melting = Melting { solidus, liquidus, heat: quantity("2e5 J/kg") };
    let properties = Properties {
        cp: Some(quantity("2000 J/(kg K)")),
        melting: Some(melting),
        ..Properties::default()
    };
    let material = b.material("wax", properties);
    let mass = b.expression("m", None).unwrap();
    let lump = b.lump(material, Size::Mass(mass.into())).unwrap();
    let body = b.node("body", lump, Temperature(start));
    let given = b.expression("T_air", None).unwrap();
    let air = b.boundary("air", given);
    b.resistor("skin", body, air, Conductance(5.0));
    simulation(&b.build().unwrap())
}

/// The state of a body that melts is `y = T0 + H / C0`: `dy/dt = q / C0` and `dT/dy = C0 / C`. In
/// the solid C = C0 = 4000 J/K, within the range of melting 4000 + 4e5 / 10 = 44000 J/K.
#[test]
fn the_state_of_a_body_that_melts_is_its_enthalpy() {
    let solid = wax(310.0);
    let of_solid = dense(&solid.slopes(&[]).unwrap())[0][0];
    assert_near(of_solid, -5.0 / 4000.0, 1e-9);
    let mut melting = solid;
    melting.advance(Time(1000.0), &[]).unwrap();
    let temperature = melting.temperature("body").unwrap().0;
    assert!((321.0..329.0).contains(&temperature), "{temperature}");
    let slopes = melting.slopes(&["T_air"]).unwrap();
    assert_near(dense(&slopes)[0][0], -5.0 / 44_000.0, 1e-6);
    let along = slopes.along(&Direction { states: vec![1.0], inputs: vec![0.0] }).unwrap();
    assert_near(along.nodes[0], 4000.0 / 44_000.0, 1e-6);
    assert_near(by_input(&slopes, 1, (1, 0)).states[0], 5.0 / 4000.0, 1e-9);
    let refused = melting.slopes(&["m"]);
    assert!(matches!(refused, Err(SimulationError::Melts { node }) if node == "body"));
}
