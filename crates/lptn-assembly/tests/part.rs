//! Parts of a system against formulas by hand.

use crate::networks;

use lptn_assembly::JacobianForm;
use lptn_assembly::ThermalSystem;
use lptn_network::{
    Conductance, ConductorKind, Formula, HeatCapacity, NetworkBuilder, Path, Temperature,
};
use networks::{SIGMA, dense, flow, link, own, power, quantity, radiation, system};

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

/// Forty cells in a row, each with a massless surface behind half a cell and natural convection from
/// it; the conductivity is `20 W/(m K) (1 + 0.001 (T - 300 K))`.
fn cells_with_surfaces() -> ThermalSystem {
    let mut b = NetworkBuilder::new();
    let air = b.boundary("air", Temperature(290.0));
    let slab = |b: &NetworkBuilder, thickness: &str| {
        let k = own(b, "20 [W/(m K)] * (1 + 0.001 [1/K] * (kelvin(T) - 300 [K]))");
        Path::new(Formula::Slab, [k, quantity("0.01 m^2"), quantity(thickness)])
    };
    let cells: Vec<_> = (0..40)
        .map(|i| b.node(&format!("cell{i}"), HeatCapacity(10.0), Temperature(300.0)))
        .collect();
    for (i, &cell) in cells.iter().enumerate() {
        let surface = b.massless(&format!("surface{i}"));
        let half = slab(&b, "5 mm");
        let ends = (cell.into(), surface.into());
        b.conductor(&format!("half{i}"), ConductorKind::Conduction, ends, half);
        if let Some(&next) = cells.get(i + 1) {
            let whole = slab(&b, "10 mm");
            let ends = (cell.into(), next.into());
            b.conductor(&format!("whole{i}"), ConductorKind::Conduction, ends, whole);
        }
        let h = link(&b, "1.32 [W/(m^2 K)] * (abs(dT) / 1 [K])^0.25");
        let area = quantity(&format!("{} m^2", 0.01 + 0.001 * i as f64));
        let ends = (surface.into(), air.into());
        b.conductor(&format!("film{i}"), ConductorKind::Convection, ends, Path::film(h, area));
    }
    system(b)
}

/// A body and a group of films in a part give the balance of each surface as by hand, whichever
/// system was asked before with the same workspace; and the derivatives of the whole system.
#[test]
fn surfaces_of_a_body_are_balanced_as_by_hand() {
    let system = cells_with_surfaces();
    let y: Vec<f64> = (0..80).map(|i| 330.0 + 40.0 * (0.7 * f64::from(i)).sin()).collect();
    let surfaces: Vec<usize> = (40..80).collect();
    let part = system.part(&surfaces);
    let mut work = system.workspace();
    system.read_inputs(&mut work, 0.0, 0.0).unwrap();
    let mut others = vec![f64::NAN; 80];
    system.flow(&mut work, &vec![350.0; 80], &mut others).unwrap();
    let mut found = vec![f64::NAN; 80];
    system.flow_of(&part, &mut work, &y, &mut found).unwrap();
    let whole = flow(&system, 0.0, &y);
    for i in 0..40 {
        let (cell, surface) = (y[i], y[40 + i]);
        let k = 20.0 * (1.0 + 0.001 * (0.5 * (cell + surface) - 300.0));
        let over = surface - 290.0;
        let film = 1.32 * over.abs().powf(0.25) * (0.01 + 0.001 * i as f64) * over;
        let exact = k * 0.01 / 0.005 * (cell - surface) - film;
        assert!((found[40 + i] - exact).abs() < 1e-9, "{i}: {} {exact}", found[40 + i]);
        assert!((whole[40 + i] - exact).abs() < 1e-9, "{i}: {} {exact}", whole[40 + i]);
    }
    let mut values = vec![f64::NAN; system.pattern().entries()];
    system.jacobian_of(&part, &mut work, &y, &mut values).unwrap();
    let exact = dense(&system, 0.0, &y, JacobianForm::Exact);
    let [columns, rows, _] = system.pattern().symbolic();
    for column in 40..80 {
        for slot in columns[column]..columns[column + 1] {
            let exact = exact[rows[slot]][column];
            assert!((values[slot] - exact).abs() < 1e-10 * (1.0 + exact.abs()), "{column}");
        }
    }
}
