//! Heat and derivatives of single elements against formulas by hand, both forms of the Jacobian,
//! and tangents.
#![allow(clippy::unwrap_used, reason = "tests")]

use crate::networks;

use lptn_assembly::{JacobianForm, ThermalSystem};
use lptn_network::{
    Conductance, ConductorId, ConductorKind, End, HeatCapacity, NetworkBuilder, ParameterId, Path,
    Temperature, Variable,
};
use networks::{SIGMA, dense, flow, link, power, quantity, radiation, stream, system};

/// One of each kind between x and y, in an order that mixes them.
fn all_kinds() -> (ThermalSystem, Vec<ConductorId>) {
    let mut b = NetworkBuilder::new();
    let [x, y] = ["x", "y"].map(|n| b.node(n, HeatCapacity(1.0), Temperature(300.0)));
    let air = b.boundary("air", Temperature(290.0));
    let g = link(&b, "2 [W/K] * kelvin(T_mean) / 300 [K]");
    let ids = vec![
        stream(&mut b, "forward", (x, y), quantity("5 W/K")),
        radiation(&mut b, "glow", (x, y), "0.4 m^2"),
        b.resistor("r", x, y, Conductance(3.0)),
        stream(&mut b, "backward", (x, y), quantity("-6 W/K")),
        b.resistor("g", x, y, Path::conductance(g)),
        radiation(&mut b, "out", (y, air), "0.1 m^2"),
        b.convection("film", y, air, Path::film(quantity("8 W/(m^2 K)"), quantity("0.5 m^2"))),
    ];
    let p = power(&b, "1 [W/K] * (x.T - y.T)");
    b.source("p", x, p);
    (system(b), ids)
}

#[test]
fn both_ends_of_every_conductor_receive_their_heat() {
    let (system, ids) = all_kinds();
    let mut work = system.workspace();
    system.read_inputs(&mut work, 0.0, 0.0).unwrap();
    let (x, y) = (350.0_f64, 310.0_f64);
    system.recover(&mut work, &[x, y]);
    let glow = 0.4 * SIGMA * (x.powi(4) - y.powi(4));
    let out = 0.1 * SIGMA * (y.powi(4) - 290.0_f64.powi(4));
    let varying = 2.0 * 330.0 / 300.0 * 40.0;
    let expected = [
        [0.0, 200.0],
        [-glow, glow],
        [-120.0, 120.0],
        [6.0 * -40.0, 0.0],
        [-varying, varying],
        [-out, out],
        [-80.0, 80.0],
    ];
    for (id, expected) in ids.iter().zip(expected) {
        let found = system.received(&mut work, *id).unwrap();
        for (f, e) in found.into_iter().zip(expected) {
            assert!((f - e).abs() < 1e-10, "{id:?}: {found:?} {expected:?}");
            assert!(f != 0.0 || f.is_sign_positive(), "no -0 is printed: {found:?}");
        }
    }
    let surface = |k: usize| system.surface(&mut system_work(&system), ids[k]).unwrap();
    let film = surface(6).unwrap();
    assert!((film.conductance - 4.0).abs() < 1e-12 && film.area == Some(0.5));
    assert!(surface(2).is_none());
    let mut heat = [f64::NAN; 2];
    system.stream_heat(&mut work, &mut heat).unwrap();
    assert!((heat[0] - 200.0).abs() < 1e-10 && (heat[1] + 240.0).abs() < 1e-10, "{heat:?}");
}

fn system_work(system: &ThermalSystem) -> lptn_assembly::Workspace {
    let mut work = system.workspace();
    system.read_inputs(&mut work, 0.0, 0.0).unwrap();
    system.recover(&mut work, &[350.0, 310.0]);
    work
}

#[test]
fn streams_at_rest_and_reversed_temperatures_receive_no_negative_zero() {
    let (system, ids) = all_kinds();
    let mut work = system_work(&system);
    for y in [[300.0, 300.0], [300.0, 310.0], [310.0, 300.0]] {
        system.recover(&mut work, &y);
        for id in [ids[0], ids[3]] {
            for q in system.received(&mut work, id).unwrap() {
                assert!(q != 0.0 || q.is_sign_positive(), "{y:?}");
            }
        }
    }
}

/// Derivatives of the stream by hand: what arrives has the temperature of where it comes from.
#[test]
fn a_stream_has_the_slopes_of_its_direction() {
    let jacobian = |rate: &str| {
        let mut b = NetworkBuilder::new();
        let [x, y] = ["x", "y"].map(|n| b.node(n, HeatCapacity(1.0), Temperature(300.0)));
        stream(&mut b, "s", (x, y), quantity(rate));
        dense(&system(b), 0.0, &[320.0, 300.0], JacobianForm::Exact)
    };
    assert_eq!(jacobian("5 W/K"), [[0.0, 0.0], [5.0, -5.0]]);
    assert_eq!(jacobian("-5 W/K"), [[-5.0, 5.0], [0.0, 0.0]]);
}

type Add = dyn Fn(&mut NetworkBuilder, End, End);

/// The Jacobian of two nodes with one element between `a` and `b`, and an element to a boundary if
/// asked for.
fn forms(add: &Add, ends: [&str; 2], y: &[f64]) -> [Vec<Vec<f64>>; 2] {
    let mut b = NetworkBuilder::new();
    let x = b.node("x", HeatCapacity(1.0), Temperature(300.0));
    let z = b.node("z", HeatCapacity(1.0), Temperature(300.0));
    let air = b.boundary("air", Temperature(280.0));
    b.resistor("hold", x, z, Conductance(0.25));
    let end = |name: &str| match name {
        "x" => x.into(),
        "z" => z.into(),
        _ => air.into(),
    };
    add(&mut b, end(ends[0]), end(ends[1]));
    let system = system(b);
    assert!(system.is_symmetric());
    [JacobianForm::Exact, JacobianForm::Symmetric].map(|form| dense(&system, 0.0, y, form))
}

fn close(found: f64, expected: f64) {
    assert!(
        (found - expected).abs() <= 1e-12 * expected.abs().max(1.0),
        "{found} is not {expected}"
    );
}

/// q = g T_mean^2 dT with g such that both slopes differ much: between nodes the mean, towards a
/// boundary the exact one.
#[test]
fn the_symmetric_form_is_the_mean_of_both_slopes_or_the_exact_one() {
    let add: &Add = &|b, from, to| {
        let g = link(b, "2 [W/K] * (kelvin(T_mean) / 300 [K])^2");
        b.resistor("g", from, to, Path::conductance(g));
    };
    let slopes = |from: f64, to: f64| {
        let (mean, dt) = (0.5 * (from + to) / 300.0, (from - to) / 300.0);
        // d/d from, d/d to of 2 mean^2 (from - to)
        [2.0 * mean * mean + 2.0 * mean * dt, -2.0 * mean * mean + 2.0 * mean * dt]
    };
    let y = [420.0, 310.0];
    let [exact, symmetric] = forms(add, ["x", "z"], &y);
    let [by_from, by_to] = slopes(420.0, 310.0);
    close(exact[0][0], -by_from - 0.25);
    close(exact[0][1], -by_to + 0.25);
    close(exact[1][0], by_from + 0.25);
    close(exact[1][1], by_to - 0.25);
    let g = 0.5 * (by_from - by_to) + 0.25;
    [[-g, g], [g, -g]].iter().zip(&symmetric).for_each(|(e, f)| {
        close(f[0], e[0]);
        close(f[1], e[1]);
    });
    let [_, symmetric] = forms(add, ["x", "air"], &y);
    close(symmetric[0][0], -slopes(420.0, 280.0)[0] - 0.25);
    close(symmetric[1][1], -0.25);
    let [_, symmetric] = forms(add, ["air", "x"], &y);
    close(symmetric[0][0], slopes(280.0, 420.0)[1] - 0.25);
    close(symmetric[0][1], 0.25);
}

#[test]
fn a_conductance_that_falls_steeply_is_left_out_of_the_symmetric_form() {
    // q = 5 exp(-dT / 10 K) dT falls beyond 10 K
    let add: &Add = &|b, from, to| {
        let g = link(b, "5 [W/K] * exp(-abs(dT) / 10 [K])");
        b.resistor("g", from, to, Path::conductance(g));
    };
    let [exact, symmetric] = forms(add, ["x", "z"], &[340.0, 300.0]);
    let slope = 5.0 * (-4.0_f64).exp() * (1.0 - 4.0);
    close(exact[1][0], slope + 0.25);
    for (row, signs) in symmetric.iter().zip([[-1.0, 1.0], [1.0, -1.0]]) {
        row.iter().zip(signs).for_each(|(f, sign)| close(*f, 0.25 * sign));
    }
}

#[test]
fn radiation_of_a_boundary_is_exact_in_both_forms() {
    for ends in [["x", "air"], ["air", "x"]] {
        let add: &Add = &|b, from, to| {
            let path = Path::radiation(quantity("2 m^2"));
            b.conductor("glow", ConductorKind::Radiation, (from, to), path);
        };
        let slope = 4.0 * 2.0 * SIGMA * 420.0_f64.powi(3);
        for matrix in forms(add, ends, &[420.0, 310.0]) {
            close(matrix[0][0], -slope - 0.25);
            close(matrix[1][1], -0.25);
        }
        // an iterate below 0 K keeps the matrix definite in the symmetric form
        let [exact, symmetric] = forms(add, ends, &[-420.0, 310.0]);
        close(exact[0][0], slope - 0.25);
        close(symmetric[0][0], -0.25);
    }
}

#[test]
fn an_element_that_fails_is_named_by_every_question() {
    let mut b = NetworkBuilder::new();
    let x = b.node("x", HeatCapacity(1.0), Temperature(300.0));
    let air = b.boundary("air", Temperature(280.0));
    let g = link(&b, "1 [W/K^2] * (T_from - absolute(300 [K]))");
    let id = b.resistor("wrong", x, air, Path::conductance(g));
    let system = system(b);
    let mut work = system.workspace();
    system.read_inputs(&mut work, 0.0, 0.0).unwrap();
    let y = [290.0];
    let mut values = vec![0.0; system.pattern().entries()];
    let mut out = [0.0];
    system.recover(&mut work, &y);
    let errors = [
        system.flow(&mut work, &y, &mut out).unwrap_err(),
        system.boundary_heat(&mut work, &y, &mut out).unwrap_err(),
        system.jacobian_at(&mut work, &y, JacobianForm::Exact, &mut values).unwrap_err(),
        system.received(&mut work, id).unwrap_err(),
    ];
    for error in errors {
        assert_eq!(error.name, "wrong");
    }
}

/// Parameters of every kind of value, around a junction that hands on what it feels.
fn with_parameters() -> (ThermalSystem, Vec<ParameterId>) {
    let mut b = NetworkBuilder::new();
    let ids =
        [("G", "2 W/K"), ("P", "40 W"), ("T_air", "280 K"), ("A", "0.3 m^2"), ("R", "0.5 K/W")]
            .map(|(name, text)| {
                let quantity = if name == "T_air" {
                    lptn_units::parse_quantity(text, Some(networks::ABSOLUTE)).unwrap().into()
                } else {
                    quantity(text)
                };
                b.parameter(name, quantity)
            });
    let value = |b: &NetworkBuilder, text: &str| b.expression(text, None).unwrap().into();
    let [x, y] = ["x", "y"].map(|n| b.node(n, HeatCapacity(1.0), Temperature(300.0)));
    let joint = b.massless("joint");
    let t_air: lptn_network::Input = value(&b, "T_air");
    let air = b.boundary("air", t_air);
    let (g, r, p, area) = (value(&b, "G"), value(&b, "R"), value(&b, "P"), value(&b, "A"));
    b.resistor("g", x, joint, Path::conductance(g));
    b.resistor("r", joint, y, Path::resistance(r));
    b.resistor("tie", joint, air, Conductance(1.5));
    b.conductor("glow", ConductorKind::Radiation, (y.into(), air.into()), Path::radiation(area));
    let half: lptn_network::Input = value(&b, "P / 2");
    b.shared_source("p", &[(joint, 0.5), (y, 0.5)], p);
    b.source("half", x, half);
    (system(b), ids.to_vec())
}

/// At held unknowns the flows change with a parameter as the tangent heat says, and so does the
/// junction.
#[test]
fn tangents_are_the_derivatives_of_flows_and_of_eliminated_temperatures() {
    let (system, ids) = with_parameters();
    let y = [350.0, 320.0];
    let vertices = 4;
    let mut work = system.workspace();
    system.read_inputs(&mut work, 0.0, 0.0).unwrap();
    system.recover(&mut work, &y);
    let mut tangents = system.network().tangents(&ids).unwrap();
    let mut heat = vec![f64::NAN; vertices * ids.len()];
    system.tangent_heat(&mut tangents, &work, &mut heat).unwrap();
    let along = [0.7, -0.4];
    for (block, id) in heat.chunks(vertices).zip(&ids) {
        let own = system.network().parameter_value(*id);
        let h = 1e-4 * own;
        let seen = |sign: f64| {
            let mut other = system.network().overrides();
            other.set(*id, own + sign * h);
            let moved = ThermalSystem::assemble(&system.network().with(&other).unwrap()).unwrap();
            let shifted = [y[0] + sign * h * along[0], y[1] + sign * h * along[1]];
            let mut work = moved.workspace();
            moved.read_inputs(&mut work, 0.0, 0.0).unwrap();
            moved.recover(&mut work, &shifted);
            (flow(&moved, 0.0, &y), moved.node_temperatures(&work)[2])
        };
        let ((up, joint_up), (down, joint_down)) = (seen(1.0), seen(-1.0));
        for k in 0..2 {
            let slope = (up[k] - down[k]) / (2.0 * h);
            assert!(
                (block[k] - slope).abs() <= 1e-6 * slope.abs().max(1e-3),
                "{id:?} {block:?} {slope}"
            );
        }
        let mut all = [f64::NAN; 4];
        system.recover_tangent(block, &along, &mut all);
        assert!((all[0] - along[0]).abs() < 1e-15 && (all[1] - along[1]).abs() < 1e-15, "{all:?}");
        let slope = (joint_up - joint_down) / (2.0 * h);
        assert!((all[2] - slope).abs() <= 1e-6 * slope.abs().max(1e-3), "{id:?} {all:?} {slope}");
        assert!(all[3] == 0.0, "boundaries are given");
    }
    assert!(tangents.variables().iter().copied().eq(ids.iter().copied().map(Variable::Parameter)));
}
