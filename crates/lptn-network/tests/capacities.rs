//! Capacities: sums of parts, lumps of materials, heat contents against integrals by hand, and
//! bodies.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common;

use common::{all_near, cooled, near, own, quantity, time};
use lptn_network::{
    Enthalpy, Field, HeatCapacity, Item, MaterialId, Melting, NetworkBuilder, NoMaterial,
    Properties, Size, Temperature,
};
use lptn_units::{Dimension, Interpolation, LookupTable, Outside, Table1, TableSymbol, Type};

fn steel(b: &mut NetworkBuilder) -> MaterialId {
    let k = Some(own(b, "50 [W/(m K)] - 0.02 [W/(m K^2)] * (T - absolute(300 [K]))"));
    let (density, cp) = (Some(quantity("8000 kg/m^3")), Some(quantity("500 J/(kg K)")));
    b.material("steel", Properties { density, cp, k, ..Properties::default() })
}

#[test]
fn capacities_and_masses_are_sums_of_parts() {
    let (mut b, a, _) = cooled();
    let steel = steel(&mut b);
    let by_mass = b.lump(steel, Size::Mass(quantity("3 kg"))).unwrap();
    let by_volume = b.lump(steel, Size::Volume(quantity("1e-3 m^3"))).unwrap();
    let [x, y] = ["x", "y"].map(|n| b.node_of_parts(n, Temperature(300.0)));
    b.capacitor("one", x, by_mass.clone());
    b.capacitor("two", x, by_volume.clone());
    b.capacitor("three", y, by_volume);
    b.capacitor("four", y, HeatCapacity(7.0));
    let z = b.node("z", by_mass, Temperature(310.0));
    b.length(z, quantity("5 mm"));
    let network = b.build().unwrap();
    near(network.capacity(x), 1500.0 + 4000.0);
    near(network.capacity(y), 4007.0);
    near(network.capacity(z), 1500.0);
    near(network.mass(x).unwrap(), 3.0 + 8.0);
    near(network.mass(z).unwrap(), 3.0);
    assert_eq!((network.mass(y), network.mass(a)), (None, None));
    assert_eq!(network.material_of(x), Ok(steel));
    assert_eq!(network.material_of(z), Ok(steel));
    assert_eq!(network.material_of(y), Err(NoMaterial::Unnamed));
    assert_eq!(network.material_of(a), Err(NoMaterial::Unnamed));
    assert_eq!((network.length(z), network.length(a)), (Some(0.005), None));
    assert!(network.node_ids().all(|id| network.enthalpy(id).is_none()));
    assert_eq!(network.first_nonlinear(), None);
    assert_eq!(
        (network.materials().len(), network.material_ids().len(), network.capacitor_ids().len()),
        (1, 1, 4)
    );
    let mut scope = network.evaluation();
    let mut property = |field, t| network.property((steel, field), t, &mut scope);
    near(property(Field::Density, 300.0).unwrap(), 8000.0);
    near(property(Field::SpecificHeat, 300.0).unwrap(), 500.0);
    near(property(Field::Conductivity, 400.0).unwrap(), 48.0);
    assert_eq!(property(Field::Conductivity, 3000.0), None, "below 0 it is not known");
    assert_eq!(property(Field::of_law("emissivity").unwrap(), 300.0), None);
}

#[test]
fn parts_of_two_materials_have_none_in_common() {
    let mut b = NetworkBuilder::new();
    let first = steel(&mut b);
    let density = Some(quantity("1 kg/m^3"));
    let second = b.material(
        "gas",
        Properties { density, cp: Some(quantity("1 J/(kg K)")), ..Properties::default() },
    );
    let x = b.node_of_parts("x", Temperature(300.0));
    for (name, material) in [("one", first), ("two", second)] {
        let lump = b.lump(material, Size::Mass(quantity("1 kg"))).unwrap();
        b.capacitor(name, x, lump);
    }
    assert!(b.conductivity(second).is_none());
    assert_eq!(b.conductivity(first).unwrap().ty(), Type::of(Dimension::CONDUCTIVITY));
    let network = b.build().unwrap();
    assert_eq!(network.material_of(x), Err(NoMaterial::Several));
    near(network.mass(x).unwrap(), 2.0);
}

fn near_to(found: f64, expected: f64, tolerance: f64) {
    assert!(
        (found - expected).abs() <= tolerance * expected.abs().max(1.0),
        "{found} is not {expected}"
    );
}

/// Heat content, capacity and temperature agree with an integral by hand.
fn agrees(
    curve: &Enthalpy,
    range: (f64, f64),
    heat: impl Fn(f64) -> f64,
    capacity: impl Fn(f64) -> f64,
) {
    for k in 0..=20 {
        let t = range.0 + (range.1 - range.0) * f64::from(k) / 20.0;
        near_to(curve.heat(t).unwrap(), heat(t), 1e-9);
        near_to(curve.capacity(t).unwrap(), capacity(t), 1e-8);
        let back = curve.temperature(heat(t)).unwrap();
        near_to(back.temperature, t, 1e-9);
    }
}

#[test]
fn a_capacity_that_rises_with_temperature() {
    let mut b = NetworkBuilder::new();
    let c = own(
        &b,
        "10 [J/K] + 0.02 [J/K^2] * (T - absolute(300 [K])) + 1e-4 [J/K^3] * (T - absolute(300 \
         [K]))^2",
    );
    let x = b.node("x", c, Temperature(350.0));
    let network = b.build().unwrap();
    near(network.capacity(x), 10.0 + 1.0 + 0.25);
    assert_eq!(network.first_nonlinear(), Some(Item::Node(x)));
    let from = |t: f64| {
        let u = t - 300.0;
        10.0 * u + 0.01 * u * u + 1e-4 / 3.0 * u.powi(3)
    };
    let heat = |t: f64| from(t) - from(350.0);
    let capacity = |t: f64| {
        let u = t - 300.0;
        10.0 + 0.02 * u + 1e-4 * u * u
    };
    let curve = network.enthalpy(x).unwrap();
    agrees(curve, (250.0, 900.0), heat, capacity);
    assert!(curve.range().0 < 250.0 && curve.range().1 > 900.0);
}

#[test]
fn an_exponential_capacity_and_one_of_two_parts() {
    let mut b = NetworkBuilder::new();
    let c = own(&b, "20 [J/K] * exp((T - absolute(300 [K])) / 150 [K])");
    let x = b.node("x", c, Temperature(300.0));
    let c = own(&b, "20 [J/K] * exp((T - absolute(300 [K])) / 150 [K])");
    let y = b.node("y", c, Temperature(330.0));
    b.capacitor("more", y, HeatCapacity(5.0));
    let network = b.build().unwrap();
    let exp = |t: f64| ((t - 300.0) / 150.0).exp();
    agrees(
        network.enthalpy(x).unwrap(),
        (260.0, 600.0),
        |t| 3000.0 * (exp(t) - 1.0),
        |t| 20.0 * exp(t),
    );
    let heat = |t: f64| 3000.0 * (exp(t) - exp(330.0)) + 5.0 * (t - 330.0);
    agrees(network.enthalpy(y).unwrap(), (260.0, 600.0), heat, |t| 20.0 * exp(t) + 5.0);
    near(network.capacity(y), 20.0 * exp(330.0) + 5.0);
}

#[test]
fn a_capacity_of_a_table_bends_at_its_points() {
    let mut b = NetworkBuilder::new();
    let points = Table1::new(
        vec![280.0, 320.0, 400.0],
        vec![10.0, 30.0, 14.0],
        Interpolation::Linear,
        Outside::Hold,
    );
    let table = LookupTable::One(points.unwrap()).into();
    b.table(
        "c",
        TableSymbol {
            table,
            arguments: vec![common::ABSOLUTE],
            ty: Type::of(Dimension::CAPACITY),
            units: Vec::new(),
        },
    );
    let c = own(&b, "c(T)");
    let x = b.node("x", c, Temperature(320.0));
    let network = b.build().unwrap();
    let heat = |t: f64| match t - 320.0 {
        u if t < 280.0 => -800.0 + 10.0 * (u + 40.0),
        u if t < 320.0 => 30.0 * u + 0.25 * u * u,
        u if t < 400.0 => 30.0 * u - 0.1 * u * u,
        u => 1760.0 + 14.0 * (u - 80.0),
    };
    let capacity = |t: f64| match t {
        t if t < 280.0 => 10.0,
        t if t < 320.0 => 10.0 + 0.5 * (t - 280.0),
        t if t < 400.0 => 30.0 - 0.2 * (t - 320.0),
        _ => 14.0,
    };
    agrees(network.enthalpy(x).unwrap(), (263.0, 457.0), heat, capacity);
}

fn wax(b: &mut NetworkBuilder, solidus: f64, liquidus: f64) -> MaterialId {
    let (solidus, liquidus) = (Temperature(solidus).into(), Temperature(liquidus).into());
    let melting = Some(Melting { solidus, liquidus, heat: quantity("2e5 J/kg") });
    let (density, cp) = (Some(quantity("900 kg/m^3")), Some(quantity("2000 J/(kg K)")));
    b.material("wax", Properties { density, cp, melting, ..Properties::default() })
}

#[test]
fn wax_takes_up_its_latent_heat() {
    let mut b = NetworkBuilder::new();
    let material = wax(&mut b, 320.0, 330.0);
    let c = b.lump(material, Size::Mass(quantity("0.5 kg"))).unwrap();
    let x = b.node("x", c, Temperature(300.0));
    let network = b.build().unwrap();
    let curve = network.enthalpy(x).unwrap();
    // 1000 J/K, and 1e5 J between 320 K and 330 K
    let heat = |t: f64| 1000.0 * (t - 300.0) + 1e5 * ((t - 320.0) / 10.0).clamp(0.0, 1.0);
    let capacity = |t: f64| if t > 320.0 && t < 330.0 { 11_000.0 } else { 1000.0 };
    agrees(curve, (290.5, 350.3), heat, capacity);
}

#[test]
fn a_pure_substance_melts_at_one_temperature() {
    let mut b = NetworkBuilder::new();
    let material = wax(&mut b, 320.0, 320.0);
    let c = b.lump(material, Size::Volume(quantity("1e-3 m^3"))).unwrap();
    let solid = b.node("solid", c.clone(), Temperature(310.0));
    let amid = b.node("amid", c, Temperature(320.0));
    b.molten(amid, 0.25);
    let network = b.build().unwrap();
    let curve = network.enthalpy(solid).unwrap();
    // 0.9 kg: 1800 J/K, 1.8e5 J
    for (heat, t) in [
        (0.0, 310.0),
        (9000.0, 315.0),
        (18_000.0, 320.0),
        (1e5, 320.0),
        (198_000.0, 320.0),
        (207_000.0, 325.0),
    ] {
        near_to(curve.temperature(heat).unwrap().temperature, t, 1e-10);
    }
    near_to(curve.melted(18_000.0 + 0.3 * 1.8e5).unwrap(), 0.3, 1e-9);
    let curve = network.enthalpy(amid).unwrap();
    near_to(curve.temperature(0.75 * 1.8e5 + 1800.0).unwrap().temperature, 321.0, 1e-10);
    near_to(curve.temperature(-0.25 * 1.8e5 - 1800.0).unwrap().temperature, 319.0, 1e-10);
    near_to(curve.melted(0.0).unwrap(), 0.25, 1e-9);
    near_to(curve.temperature(1000.0).unwrap().temperature, 320.0, 1e-10);
}

#[test]
fn a_start_that_follows_from_parameters() {
    let mut b = NetworkBuilder::new();
    let start = b.parameter("T_start", Temperature(310.0));
    let t = time(&b, "T_start + 5 [K]");
    let c = own(&b, "2 [J/K] * (kelvin(T) / 315 [K])");
    let x = b.node("x", c, t);
    let network = b.build().unwrap();
    near(network.initial(x), 315.0);
    near(network.capacity(x), 2.0);
    let mut other = network.overrides();
    other.set(start, 625.0);
    let other = network.with(&other).unwrap();
    all_near(&[other.initial(x), other.capacity(x)], &[630.0, 4.0]);
    let junction = {
        let (mut b, a, _) = cooled();
        let j = b.massless("j");
        b.resistor("r", a, j, lptn_network::Conductance(1.0));
        let network = b.build().unwrap();
        (network.initial(j), network.capacity(j))
    };
    assert!(junction.0.is_nan() && junction.1 == 0.0);
}
