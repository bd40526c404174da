//! Parts of a system against formulas by hand.

use crate::networks;

use lptn_assembly::ThermalSystem;
use lptn_network::{Conductance, HeatCapacity, NetworkBuilder, Path, Temperature};
use networks::{SIGMA, link, power, radiation, system};

/// A surface among a body and air, and two bodies joined by a path without heat below 200 K.
fn surface() -> ThermalSystem {
    let mut b = NetworkBuilder::new();
    let [body, far, further] =
        ["body", "far", "further"].map(|n| b.node(n, HeatCapacity(1.0), Temperature(300.0)));
    let surface = b.massless("surface");
    let air = b.boundary("air", Temperature(290.0));
    let fails = link(&b, "1 [W/K] * sqrt(kelvin(T_mean) / 200 [K] - 1)");
    b.resistor("bad", far, further, Path::conductance(fails));
    b.resistor("r", body, surface, Conductance(3.0));
    b.resistor("tie", surface, air, Conductance(0.5));
    b.resistor("beside", body, far, Conductance(7.0));
    radiation(&mut b, "glow", (surface, air), "0.4 m^2");
    let p = power(&b, "2 [W/K] * (body.T - surface.T)");
    b.source("p", further, p);
    system(b)
}

#[test]
fn a_part_reads_nothing_beside_it() {
    let system = surface();
    let (body, far, further, surface) = (350.0, 100.0, 120.0, 310.0_f64);
    let y = [body, far, further, surface];
    let mut work = system.workspace();
    system.read_inputs(&mut work, 0.0, 0.0).unwrap();
    let mut whole = [0.0; 4];
    assert!(system.flow(&mut work, &y, &mut whole).is_err(), "the law of another path fails");
    let part = system.part(&[3]);
    let mut flow = [f64::NAN; 4];
    system.flow_of(&part, &mut work, &y, &mut flow).unwrap();
    let glow = 0.4 * SIGMA * (surface.powi(4) - 290.0_f64.powi(4));
    let expected = 3.0 * (body - surface) - 0.5 * (surface - 290.0) - glow;
    assert!((flow[3] - expected).abs() < 1e-11, "{flow:?} {expected}");
}

#[test]
fn a_part_has_all_derivatives_by_its_unknowns() {
    let system = surface();
    let y = [350.0, 100.0, 120.0, 310.0_f64];
    let mut work = system.workspace();
    system.read_inputs(&mut work, 0.0, 0.0).unwrap();
    let mut values = vec![f64::NAN; system.pattern().entries()];
    system.jacobian_of(&system.part(&[3]), &mut work, &y, &mut values).unwrap();
    let [columns, rows, _] = system.pattern().symbolic();
    let own = -3.5 - 4.0 * 0.4 * SIGMA * 310.0_f64.powi(3);
    for slot in columns[3]..columns[4] {
        let expected = match rows[slot] {
            0 => 3.0,
            2 => -2.0,
            3 => own,
            other => panic!("{other} does not feel it"),
        };
        assert!((values[slot] - expected).abs() < 1e-12, "{} {expected}", values[slot]);
    }
}
