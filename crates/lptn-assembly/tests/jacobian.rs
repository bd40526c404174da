//! Tolerance: the Jacobian of every law against central differences of the heat flows, and where it
//! must stay finite.
#![allow(clippy::unwrap_used, reason = "tests")]

use crate::networks;

use lptn_assembly::{JacobianForm, ThermalSystem};
use lptn_network::{
    ConductorKind, End, Formula, HeatCapacity, Network, NetworkBuilder, NodeId, Path, Temperature,
};
use lptn_units::{Dimension, Interpolation};
use networks::{
    ABSOLUTE, Random, dense, flow, link, map, of, own, power, quantity, radiation, stream, table,
};

/// Central differences with two step lengths, extrapolated.
fn differences(system: &ThermalSystem, time: f64, y: &[f64], column: usize) -> Vec<f64> {
    let slope = |h: f64| -> Vec<f64> {
        let at = |dt: f64| {
            let mut moved = y.to_vec();
            moved[column] += dt;
            flow(system, time, &moved)
        };
        at(h).iter().zip(at(-h)).map(|(up, down)| (up - down) / (2.0 * h)).collect()
    };
    let (coarse, fine) = (slope(2e-3), slope(1e-3));
    fine.iter().zip(coarse).map(|(f, c)| (4.0 * f - c) / 3.0).collect()
}

fn check(system: &ThermalSystem, time: f64, y: &[f64]) {
    let matrix = dense(system, time, y, JacobianForm::Exact);
    for column in 0..y.len() {
        let expected = differences(system, time, y, column);
        for row in 0..y.len() {
            let (found, expected) = (matrix[row][column], expected[row]);
            let scale = matrix[row].iter().fold(0.0, |m: f64, v| m.max(v.abs())).max(1e-3);
            assert!(
                (found - expected).abs() <= 1e-6 * expected.abs() + 2e-8 * scale,
                "({row}, {column}): {found} {expected} at {time} s, {y:?}"
            );
        }
    }
}

/// Adds one element between `a` and `c`; others may be named in it.
type Add = fn(&mut NetworkBuilder, [End; 2]);

fn conductor(b: &mut NetworkBuilder, kind: ConductorKind, ends: [End; 2], path: Path) {
    b.conductor("element", kind, (ends[0], ends[1]), path);
}

fn oil(b: &mut NetworkBuilder) -> lptn_network::FluidId {
    let density = own(b, "900 [kg/m^3] * (1 - 7e-4 [1/K] * (T - 20 [degC]))");
    let cp = own(
        b,
        "1900 [J/(kg K)] + 4 [J/(kg K^2)] * (T - 20 [degC]) + 0.004 [J/(kg K^3)] * (T - 20 \
         [degC])^2",
    );
    b.fluid("oil", Some(density), cp, None)
}

const ELEMENTS: [(&str, Add); 24] = [
    ("resistance of T_mean", |b, ends| {
        let r = link(b, "0.2 [K/W] + 1e-3 [1/W] * (T_mean - 20 [degC])");
        conductor(b, ConductorKind::Resistor, ends, Path::resistance(r));
    }),
    ("table over T_mean", |b, ends| {
        let x = [10.0, 250.0, 300.0, 420.0, 600.0, 3000.0];
        let symbol = table(
            &x,
            &[1.0, 2.0, 5.0, 4.0, 8.0, 9.0],
            Interpolation::Linear,
            (ABSOLUTE, of(Dimension::CONDUCTANCE)),
        );
        b.table("of_mean", symbol);
        let g = link(b, "of_mean(T_mean)");
        conductor(b, ConductorKind::Resistor, ends, Path::conductance(g));
    }),
    ("pchip table over T_from", |b, ends| {
        let x = [10.0, 250.0, 300.0, 420.0, 600.0, 3000.0];
        let symbol = table(
            &x,
            &[1.0, 2.0, 5.0, 4.0, 8.0, 9.0],
            Interpolation::Pchip,
            (ABSOLUTE, of(Dimension::CONDUCTANCE)),
        );
        b.table("of_from", symbol);
        let g = link(b, "of_from(T_from)");
        conductor(b, ConductorKind::Resistor, ends, Path::conductance(g));
    }),
    ("table of two over T_to and dT", |b, ends| {
        let z = [1.0, 2.0, 4.0, 3.0, 6.0, 5.0];
        let types = (ABSOLUTE, of(Dimension::TEMPERATURE), of(Dimension::CONDUCTANCE));
        b.table("of_two", map(&[10.0, 3000.0], &[-3000.0, 1.5, 3000.0], &z, types));
        let g = link(b, "of_two(T_to, dT)");
        conductor(b, ConductorKind::Resistor, ends, Path::conductance(g));
    }),
    ("natural convection", |b, ends| {
        let h = link(b, "1.3 [W/(m^2 K^1.25)] * abs(dT)^0.25");
        conductor(b, ConductorKind::Convection, ends, Path::film(h, quantity("2 m^2")));
    }),
    ("natural convection of a root", |b, ends| {
        let h = link(b, "1.3 [W/(m^2 K^1.5)] * sqrt(abs(dT))");
        conductor(b, ConductorKind::Convection, ends, Path::film(h, quantity("2 m^2")));
    }),
    ("forced convection at zero speed", |b, ends| {
        let h = link(b, "3 [W/(m^2 K)] * (speed / 1 [m/s])^0.8");
        conductor(b, ConductorKind::Convection, ends, Path::film(h, quantity("2 m^2")));
    }),
    ("slab with k(T)", |b, ends| {
        let shape = |k| Path::new(Formula::Slab, [k, quantity("0.1 m^2"), quantity("20 mm")]);
        let k = own(b, "15 [W/(m K)] + 0.02 [W/(m K^2)] * (T - 20 [degC])");
        conductor(b, ConductorKind::Conduction, ends, shape(k));
    }),
    ("cylinder with k(T)", |b, ends| {
        let (inner, outer) = (quantity("10 mm"), quantity("30 mm"));
        let k = own(b, "15 [W/(m K)] * exp((T - 20 [degC]) / 900 [K])");
        let shape = |k| Path::new(Formula::Cylinder, [k, inner, outer, quantity("0.4 m")]);
        conductor(b, ConductorKind::Conduction, ends, shape(k));
    }),
    ("sphere with k(T)", |b, ends| {
        let k = own(b, "15 [W/(m K)] * kelvin(T) / 300 [K]");
        let shape = |k| Path::new(Formula::Sphere, [k, quantity("10 mm"), quantity("30 mm")]);
        conductor(b, ConductorKind::Conduction, ends, shape(k));
    }),
    ("rod with k(T)", |b, ends| {
        let k = own(b, "15 [W/(m K)] * (kelvin(T) / 300 [K])^0.5");
        let shape = |k| Path::new(Formula::Rod, [k, quantity("10 mm"), quantity("0.1 m")]);
        conductor(b, ConductorKind::Conduction, ends, shape(k));
    }),
    ("contact", |b, ends| {
        let h = link(b, "2000 [W/(m^2 K)] * (kelvin(T_mean) / 300 [K])^0.95");
        conductor(b, ConductorKind::Contact, ends, Path::film(h, quantity("4 cm^2")));
    }),
    ("radiation by area", |b, ends| {
        radiation(b, "element", (ends[0], ends[1]), "0.3 m^2");
    }),
    ("radiation of parallel plates with emissivity(T)", |b, ends| {
        let warm = link(b, "0.5 + 1e-4 [1/K] * (T_from - 20 [degC])");
        let surfaces = Path::new(
            Formula::ParallelPlates,
            [warm, quantity("0.6"), quantity("0.4 m^2"), quantity("0.9")],
        );
        conductor(b, ConductorKind::Radiation, ends, surfaces);
    }),
    ("stream", |b, ends| {
        stream(b, "element", (ends[0], ends[1]), quantity("12 W/K"));
    }),
    ("stream backwards", |b, ends| {
        stream(b, "element", (ends[0], ends[1]), quantity("-12 W/K"));
    }),
    ("stream over time", |b, ends| {
        let rate = link(b, "8 [W/K] * (t / 1 [s] - 1)");
        stream(b, "element", (ends[0], ends[1]), rate);
    }),
    ("stream of a temperature", |b, ends| {
        let rate = link(b, "8 [W/K] * (third.T - 20 [degC]) / 100 [K]");
        stream(b, "element", (ends[0], ends[1]), rate);
    }),
    ("fluid with cp(T)", |b, ends| {
        let fluid = oil(b);
        let path = Path::of_fluid(Formula::MassFlow, fluid, [quantity("-0.02 kg/s")]);
        conductor(b, ConductorKind::Advection, ends, path);
    }),
    ("fluid by volume at a temperature of its own", |b, ends| {
        let fluid = oil(b);
        let path =
            Path::of_fluid(Formula::VolumeFlow, fluid, [quantity("1.5 l/min"), link(b, "T_from")]);
        conductor(b, ConductorKind::Advection, ends, path);
    }),
    ("source of its own T", |b, ends| {
        let End::Node(node) = ends[1] else { return };
        let p = power(b, "40 [W] * exp((T - 20 [degC]) / 300 [K])");
        b.source("element", node, p);
    }),
    ("shared source of others", |b, ends| {
        let into: Vec<(NodeId, f64)> = ends
            .into_iter()
            .filter_map(|end| match end {
                End::Node(node) => Some(node),
                End::Boundary(_) => None,
            })
            .zip([0.3, 0.7])
            .collect();
        if into.len() == 2 {
            let p = power(b, "5 [W] * ((a.T - c.T) / 10 [K])^2 + 2 [W/K] * (third.T - room.T)");
            b.shared_source("element", &into, p);
        }
    }),
    ("conductance of six temperatures", |b, ends| {
        let g = link(
            b,
            "1 [W/K] + 1e-3 [W/K^2] * (abs(a.T - c.T) + abs(third.T - fourth.T) + abs(fifth.T - \
             room.T)) + 1e-4 [W/K^2] * kelvin(sixth.T)",
        );
        conductor(b, ConductorKind::Resistor, ends, Path::conductance(g));
    }),
    ("power law of dT", |b, ends| {
        let g = link(b, "0.01 [W/K^3] * dT^2");
        conductor(b, ConductorKind::Resistor, ends, Path::conductance(g));
    }),
];

/// A ring of six nodes with one element between two of them, or between a node and a boundary.
fn network(add: Add, to_boundary: bool, massless: bool) -> Option<Network> {
    let mut b = NetworkBuilder::new();
    let start = Temperature(300.0);
    b.signal_expression("speed", b.expression("2 [m/s^2] * t", None).unwrap());
    let a = b.node("a", HeatCapacity(100.0), start);
    let c = if massless { b.massless("c") } else { b.node("c", HeatCapacity(50.0), start) };
    let others =
        ["third", "fourth", "fifth", "sixth"].map(|n| b.node(n, HeatCapacity(20.0), start));
    let room = b.boundary("room", start);
    let ring = [a, others[0], others[1], others[2], others[3]];
    for (i, pair) in ring.windows(2).enumerate() {
        b.resistor(&format!("r{i}"), pair[0], pair[1], lptn_network::Conductance(1.0));
    }
    b.resistor("tie", a, room, lptn_network::Conductance(1.0));
    b.resistor("hold", a, c, lptn_network::Conductance(0.5));
    let second = if to_boundary { room.into() } else { c.into() };
    add(&mut b, [a.into(), second]);
    b.build().ok()
}

fn every_element(mut test: impl FnMut(&str, &ThermalSystem)) {
    for (name, add) in ELEMENTS {
        for (boundary, massless) in [(false, false), (true, false), (false, true)] {
            let network =
                network(add, boundary, massless).unwrap_or_else(|| panic!("{name} does not build"));
            test(name, &ThermalSystem::assemble(&network).unwrap());
        }
    }
}

#[test]
fn every_jacobian_is_that_of_the_heat_flows_at_random_states() {
    let mut random = Random(7);
    every_element(|_, system| {
        for time in [0.3, 2.0] {
            for _ in 0..4 {
                let y: Vec<f64> =
                    system.unknowns().iter().map(|_| random.between(255.0, 520.0)).collect();
                check(system, time, &y);
            }
        }
    });
}

#[test]
fn every_jacobian_is_finite_at_rest_reversed_and_without_flow() {
    every_element(|name, system| {
        let count = system.unknowns().len();
        // all at ambient; two equal, others not; reversed; 1e-9 K apart
        let mut states = vec![vec![300.0; count]; 4];
        states[1][2] = 320.0;
        states[2][0] = 280.0;
        states[3][0] = 300.0 + 1e-9;
        for time in [0.0, 1.0, 2.0] {
            for y in &states {
                let matrix = dense(system, time, y, JacobianForm::Exact);
                let heat = flow(system, time, y);
                let all = matrix.iter().flatten().chain(&heat);
                assert!(
                    all.clone().all(|v| v.is_finite()),
                    "{name} at {time} s, {y:?}: {matrix:?}"
                );
            }
        }
    });
}

#[test]
fn the_symmetric_form_is_symmetric_and_never_warms_what_gives_heat() {
    let mut random = Random(99);
    every_element(|name, system| {
        if !system.is_symmetric() {
            return;
        }
        let y: Vec<f64> = system.unknowns().iter().map(|_| random.between(255.0, 520.0)).collect();
        let matrix = dense(system, 2.0, &y, JacobianForm::Symmetric);
        for (i, row) in matrix.iter().enumerate() {
            for (j, value) in row.iter().enumerate() {
                assert!(value.to_bits() == matrix[j][i].to_bits(), "{name} ({i}, {j})");
                assert!(i == j || *value >= 0.0, "{name} ({i}, {j}): {value}");
            }
        }
    });
}
