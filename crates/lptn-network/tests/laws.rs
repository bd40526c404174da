//! Laws: the heat of every path by formulas written out here, its derivatives, its surface, and
//! values out of range.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common;
#[path = "laws/conductivity.rs"]
mod conductivity;

use std::f64::consts::PI;

use common::{all_near, celsius, cooled, link, near, own, power, quantity, time};
use lptn_network::{
    ConductorFlow, ConductorId, ConductorKind, Field, Formula, HeatCapacity, InputProblem, Item,
    Network, NetworkBuilder, Path, Surface, Temperature,
};

const SIGMA: f64 = 5.670_374_419e-8;

/// Two nodes x and y, a third one, a boundary, and one path from x to y.
fn path(kind: ConductorKind, path: impl Fn(&mut NetworkBuilder) -> Path) -> (Network, ConductorId) {
    let mut b = NetworkBuilder::new();
    let [x, y, _] = ["x", "y", "third"].map(|n| b.node(n, HeatCapacity(1.0), Temperature(300.0)));
    b.boundary("air", Temperature(290.0));
    let path = path(&mut b);
    let id = b.conductor("path", kind, (x.into(), y.into()), path);
    (b.build().unwrap(), id)
}

fn constant(kind: ConductorKind, of: impl Fn(&mut NetworkBuilder) -> Path) -> ConductorFlow {
    let (network, id) = path(kind, of);
    network.flow(id)
}

fn conductance(flow: ConductorFlow) -> f64 {
    let ConductorFlow::Conductance(g) = flow else { panic!("{flow:?}") };
    g
}

fn body(of: impl FnOnce(lptn_network::Input) -> Path) -> f64 {
    let path = of(quantity("15 W/(m K)"));
    conductance(constant(ConductorKind::Conduction, |_| path.clone()))
}

#[test]
fn constant_conductances() {
    near(
        conductance(constant(ConductorKind::Resistor, |_| Path::resistance(quantity("0.25 K/W")))),
        4.0,
    );
    near(
        conductance(constant(ConductorKind::Resistor, |_| Path::conductance(quantity("3 W/K")))),
        3.0,
    );
    let film = |_: &mut NetworkBuilder| Path::film(quantity("8 W/(m^2 K)"), quantity("0.5 m^2"));
    near(conductance(constant(ConductorKind::Convection, film)), 4.0);
    let (area, thickness) = (quantity("0.2 m^2"), quantity("30 mm"));
    near(body(|k| Path::new(Formula::Slab, [k, area, thickness])), 15.0 * 0.2 / 0.03);
    let (inner, outer) = (quantity("10 mm"), quantity("30 mm"));
    let cylinder =
        |k| Path::new(Formula::Cylinder, [k, inner.clone(), outer.clone(), quantity("0.4 m")]);
    near(body(cylinder), 2.0 * PI * 15.0 * 0.4 / 3.0_f64.ln());
    near(
        body(|k| Path::new(Formula::Sphere, [k, inner, outer])),
        4.0 * PI * 15.0 / (1.0 / 0.01 - 1.0 / 0.03),
    );
    let rod = |k| Path::new(Formula::Rod, [k, quantity("10 mm"), quantity("0.1 m")]);
    near(body(rod), 15.0 * PI * 1e-4 / 4.0 / 0.1);
}

#[test]
fn exchange_areas() {
    let area = |exchange: Path| {
        let flow = constant(ConductorKind::Radiation, |_| exchange.clone());
        let ConductorFlow::Radiation(area) = flow else { panic!("{flow:?}") };
        area
    };
    near(area(Path::radiation(quantity("0.3 m^2"))), 0.3);
    let of = |law, values: &[&str]| {
        Path::new(law, values.iter().copied().map(quantity).collect::<Vec<_>>())
    };
    near(area(of(Formula::GreySurfaces, &["0.9", "0.5 m^2", "0.8"])), 0.9 * 0.5 * 0.8);
    let plates = of(Formula::ParallelPlates, &["0.5", "0.25", "0.5 m^2", "0.8"]);
    near(area(plates), 0.4 / (1.0 / 0.5 + 1.0 / 0.25 - 1.0));
}

#[test]
fn constant_streams() {
    let rate = |of: &dyn Fn(&mut NetworkBuilder) -> Path| {
        let flow = constant(ConductorKind::Advection, |b| of(b));
        let ConductorFlow::Stream(rate) = flow else { panic!("{flow:?}") };
        rate
    };
    near(rate(&|_| Path::stream(quantity("-7 W/K"))), -7.0);
    near(rate(&|_| Path::stream(quantity("0 W/K"))), 0.0);
    let water = |b: &mut NetworkBuilder| {
        let density = own(b, "1000 [kg/m^3] - 0.5 [kg/(m^3 K)] * (T - 20 [degC])");
        b.fluid("water", Some(density), quantity("4180 J/(kg K)"), None)
    };
    near(rate(&|b| Path::of_fluid(Formula::MassFlow, water(b), [quantity("0.02 kg/s")])), 83.6);
    let volume = |b: &mut NetworkBuilder| {
        let fluid = water(b);
        Path::of_fluid(Formula::VolumeFlow, fluid, [quantity("2e-5 m^3/s"), celsius("60 degC")])
    };
    near(rate(&volume), 2e-5 * 980.0 * 4180.0);
}

/// Heat received by both ends at temperatures of x, y, third, air.
fn received(network: &Network, id: ConductorId, temperatures: [f64; 4]) -> [f64; 2] {
    network.exchange(id, &mut network.evaluation(), &temperatures).unwrap()
}

/// Checks the derivatives by each variable against central differences.
fn slopes_agree(network: &Network, id: ConductorId, temperatures: [f64; 4]) {
    let mut slopes = Vec::new();
    let mut scope = network.evaluation();
    let values = network.exchange_slopes(id, &mut scope, &temperatures, &mut slopes).unwrap();
    all_near(&values, &received(network, id, temperatures));
    let variables = network.conductor_variables(id);
    assert_eq!(slopes.len(), variables.len());
    for (slope, &variable) in slopes.iter().zip(&variables) {
        let at = |dt: f64| {
            let mut moved = temperatures;
            moved[variable as usize] += dt;
            received(network, id, moved)
        };
        let (up, down) = (at(1e-3), at(-1e-3));
        for k in 0..2 {
            let difference = (up[k] - down[k]) / 2e-3;
            assert!(
                (slope[k] - difference).abs() < 1e-6 * difference.abs().max(1.0),
                "{slope:?} {difference}"
            );
        }
    }
}

const T: [f64; 4] = [350.0, 310.0, 330.0, 290.0];

#[test]
fn conductances_of_temperatures() {
    let of = |text: &'static str| {
        path(ConductorKind::Resistor, move |b| Path::conductance(link(b, text)))
    };
    for (text, g, variables) in [
        ("1 [W/K] * kelvin(T_from) / 100 [K]", 3.5, vec![0, 1]),
        ("1 [W/K] * kelvin(T_to) / 100 [K]", 3.1, vec![0, 1]),
        ("1 [W/K] * kelvin(T_mean) / 100 [K]", 3.3, vec![0, 1]),
        ("1 [W/K] * dT / 100 [K]", 0.4, vec![0, 1]),
        ("1 [W/K] * (third.T - air.T) / 100 [K]", 0.4, vec![0, 1, 2, 3]),
        ("1 [W/K] * (third.T - y.T) / 100 [K]", 0.2, vec![0, 1, 2]),
    ] {
        let (network, id) = of(text);
        assert_eq!(network.flow(id), ConductorFlow::Variable, "{text}");
        assert_eq!(network.conductance(id), None);
        assert_eq!(network.conductor_variables(id).to_vec(), variables, "{text}");
        all_near(&received(&network, id, T), &[-40.0 * g, 40.0 * g]);
        slopes_agree(&network, id, T);
    }
}

#[test]
fn more_variables_than_one_pass_takes() {
    let mut b = NetworkBuilder::new();
    let nodes: Vec<_> =
        (0..11).map(|i| b.node(&format!("n{i}"), HeatCapacity(1.0), Temperature(300.0))).collect();
    let terms: Vec<String> = (1..10).map(|i| format!("{i} * (n{i}.T - n{}.T)", i + 1)).collect();
    let all = terms.join(" + ");
    let g = link(&b, &format!("1e-3 [W/K^2] * ({all})"));
    let id = b.resistor("path", nodes[0], nodes[1], Path::conductance(g));
    let p = power(&b, &format!("1 [W/K] * ({all})"));
    let source = b.source("source", nodes[0], p);
    let network = b.build().unwrap();
    let temperatures: Vec<f64> = (0..11).map(|i| 400.0 - f64::from(i * i)).collect();
    // n_i - n_(i+1) = 2i + 1
    let sum: f64 = (1..10).map(|i| f64::from(i * (2 * i + 1))).sum();
    let mut scope = network.evaluation();
    let mut slopes = Vec::new();
    let [from, to] = network.exchange_slopes(id, &mut scope, &temperatures, &mut slopes).unwrap();
    near(to, 1e-3 * sum);
    near(from, -1e-3 * sum);
    assert_eq!(slopes.len(), 11);
    near(slopes[0][1], 1e-3 * sum);
    let weight = |i: usize| if i == 10 { -9.0 } else { i as f64 - (i as f64 - 1.0) };
    near(slopes[1][1], -1e-3 * sum + 1e-3);
    for (i, slope) in slopes.iter().enumerate().skip(2) {
        all_near(slope, &[-1e-3 * weight(i), 1e-3 * weight(i)]);
    }
    let mut by_source = Vec::new();
    near(network.source_slopes(source, &mut scope, &temperatures, &mut by_source).unwrap(), sum);
    near(network.source_heat(source, &mut scope, &temperatures).unwrap(), sum);
    all_near(&by_source, &(1..11).map(weight).collect::<Vec<_>>());
    assert_eq!(network.source_variables(source), (1..11).collect::<Vec<u32>>());
}

#[test]
fn radiation_of_emissivities_that_change() {
    let (network, id) = path(ConductorKind::Radiation, |b| {
        let emissivity = link(b, "0.5 + (T_from - absolute(300 [K])) / 1000 [K]");
        Path::new(Formula::GreySurfaces, [emissivity, quantity("2 m^2"), quantity("0.5")])
    });
    let q = 0.55 * SIGMA * (350.0_f64.powi(4) - 310.0_f64.powi(4));
    all_near(&received(&network, id, T), &[-q, q]);
    slopes_agree(&network, id, T);
    let surface = network.surface(id, &mut network.evaluation(), &T).unwrap().unwrap();
    near(surface.conductance, q / 40.0);
    near(surface.area.unwrap(), 1.0);
}

#[test]
fn fluids_carry_their_heat_content() {
    // cp = 4 J/(kg K) T / 300 K, so that h(a) - h(b) = 2/300 (a^2 - b^2)
    let of = |flow: &'static str| {
        path(ConductorKind::Advection, move |b| {
            let cp = own(b, "4 [J/(kg K)] * kelvin(T) / 300 [K]");
            let fluid = b.fluid("gas", None, cp, None);
            Path::of_fluid(Formula::MassFlow, fluid, [quantity(flow)])
        })
    };
    let content = 2.0 / 300.0 * (350.0_f64.powi(2) - 310.0_f64.powi(2));
    let (network, id) = of("3 kg/s");
    let found = received(&network, id, T);
    assert!(found[0].abs() < 1e-12 && (found[1] / (3.0 * content) - 1.0).abs() < 1e-9, "{found:?}");
    slopes_agree(&network, id, T);
    let (network, id) = of("-3 kg/s");
    let found = received(&network, id, T);
    assert!(
        found[1].abs() < 1e-12 && (found[0] / (-3.0 * content) - 1.0).abs() < 1e-9,
        "{found:?}"
    );
}

#[test]
fn volumes_are_weighed_where_they_are_measured() {
    let (network, id) = path(ConductorKind::Advection, |b| {
        let density = own(b, "1000 [kg/m^3] - 1 [kg/(m^3 K)] * (T - absolute(300 [K]))");
        let fluid = b.fluid("oil", Some(density), quantity("2000 J/(kg K)"), None);
        Path::of_fluid(Formula::VolumeFlow, fluid, [quantity("1e-5 m^3/s"), link(b, "T_from")])
    });
    all_near(&received(&network, id, T), &[0.0, 1e-5 * 950.0 * 2000.0 * 40.0]);
    slopes_agree(&network, id, T);
}

#[test]
fn surfaces_give_off_heat_and_other_paths_have_none() {
    let of = |kind, path_of: &dyn Fn(&mut NetworkBuilder) -> Path| {
        let (network, id) = path(kind, path_of);
        network.surface(id, &mut network.evaluation(), &T).unwrap()
    };
    let film = |_: &mut NetworkBuilder| Path::film(quantity("8 W/(m^2 K)"), quantity("0.5 m^2"));
    for kind in [ConductorKind::Convection, ConductorKind::Contact] {
        assert_eq!(of(kind, &film), Some(Surface { conductance: 4.0, area: Some(0.5) }));
        let plain = of(kind, &|_| Path::conductance(quantity("3 W/K")));
        assert_eq!(plain, Some(Surface { conductance: 3.0, area: None }));
    }
    let glow = of(ConductorKind::Radiation, &|_| Path::radiation(quantity("0.3 m^2"))).unwrap();
    near(glow.conductance, 0.3 * SIGMA * (350.0_f64.powi(2) + 310.0_f64.powi(2)) * 660.0);
    assert_eq!(glow.area, None);
    assert_eq!(of(ConductorKind::Resistor, &|_| Path::conductance(quantity("3 W/K"))), None);
    let (network, id) = path(ConductorKind::Convection, |b| {
        Path::conductance(link(b, "1 [W/K^2] * (T_to - T_from)"))
    });
    let error = network.surface(id, &mut network.evaluation(), &T).unwrap_err();
    assert!(
        matches!(error.problem, InputProblem::NegativeConductance(g) if (g + 40.0).abs() < 1e-12),
        "{error}"
    );
}

fn fails(kind: ConductorKind, of: impl Fn(&mut NetworkBuilder) -> Path) -> (Field, InputProblem) {
    let (network, id) = path(kind, of);
    let mut scope = network.evaluation();
    let error = network.exchange(id, &mut scope, &T).unwrap_err();
    let again = network.exchange_slopes(id, &mut scope, &T, &mut Vec::new()).unwrap_err();
    assert_eq!((error.item, again.field), (Item::Conductor(id), error.field));
    assert_eq!(error.name, "path");
    (error.field, error.problem)
}

#[test]
fn values_that_their_field_cannot_have_are_named() {
    use ConductorKind::{Advection, Convection, Radiation, Resistor};
    let (field, problem) = fails(Resistor, |b| Path::conductance(link(b, "-1 [W/K^2] * dT")));
    assert!(
        field.key() == "G"
            && matches!(problem, InputProblem::NegativeConductance(g) if (g + 40.0).abs() < 1e-9)
    );
    let (field, problem) = fails(Resistor, |b| Path::resistance(link(b, "-1 [1/W] * dT")));
    assert!(
        field.key() == "R"
            && matches!(problem, InputProblem::NegativeConductance(g) if (g + 0.025).abs() < 1e-9)
    );
    let (field, problem) =
        fails(Convection, |b| Path::film(link(b, "-1 [W/(m^2 K^2)] * dT"), quantity("1 m^2")));
    assert!(field.key() == "h" && matches!(problem, InputProblem::Negative(_)));
    let emissive = |text: &'static str| {
        move |b: &mut NetworkBuilder| {
            Path::new(Formula::GreySurfaces, [link(b, text), quantity("1 m^2"), quantity("1")])
        }
    };
    for text in ["dT / 10 [K]", "-dT / 10 [K]"] {
        let (field, problem) = fails(Radiation, emissive(text));
        assert!(
            field.key() == "emissivity"
                && matches!(problem, InputProblem::NotAFraction(e) if (e.abs() - 4.0).abs() < 1e-12)
        );
    }
    let (network, id) = path(Radiation, emissive("dT / 40 [K]"));
    assert!(network.exchange(id, &mut network.evaluation(), &T).is_ok(), "1 is a fraction");
    let (network, id) = path(Radiation, emissive("(dT - 40 [K]) / 40 [K]"));
    all_near(&received(&network, id, T), &[0.0, 0.0]);
    let (_, problem) =
        fails(Resistor, |b| Path::conductance(link(b, "1 [W/K] / ((dT - 40 [K]) / 1 [K])")));
    assert!(
        matches!(problem, InputProblem::NotFinite(_) | InputProblem::Evaluation(_)),
        "{problem:?}"
    );
    let (field, problem) =
        fails(Advection, |b| Path::stream(link(b, "1 [W/K] * exp(dT * 1000 [1/K])")));
    assert!(
        field.key() == "mcp"
            && matches!(problem, InputProblem::NotFinite(_) | InputProblem::Evaluation(_))
    );
    let (field, problem) = fails(Advection, |b| {
        let fluid = b.fluid("oil", None, quantity("2000 J/(kg K)"), None);
        Path::of_fluid(Formula::VolumeFlow, fluid, [quantity("1e-5 m^3/s"), link(b, "T_from")])
    });
    assert!(field == Field::Fluid && matches!(problem, InputProblem::NoDensity));
    let (field, problem) = fails(Advection, |b| {
        let density = own(b, "1000 [kg/m^3] * kelvin(T) / 300 [K]");
        let fluid = b.fluid("oil", Some(density), quantity("2000 J/(kg K)"), None);
        let at = link(b, "T_from - 1000 [K]");
        Path::of_fluid(Formula::VolumeFlow, fluid, [quantity("1e-5 m^3/s"), at])
    });
    assert!(field.key() == "flow_T" && matches!(problem, InputProblem::BelowAbsoluteZero(_)));
}

#[test]
fn sources_of_temperatures_and_times() {
    let (mut b, a, _) = cooled();
    let p = power(&b, "2 [W/K] * (T - air.T) + 1 [W/s] * t");
    let warm = b.source("warm", a, p);
    let p = time(&b, "5 [W] + 1 [W/s] * t");
    let plain = b.source("plain", a, p);
    let network = b.build().unwrap();
    let mut scope = network.evaluation();
    scope.set_time(3.0, 3.0);
    near(network.source_heat(warm, &mut scope, &[310.0, 290.0]).unwrap(), 43.0);
    let mut slopes = vec![9.0; 7];
    near(network.source_slopes(warm, &mut scope, &[310.0, 290.0], &mut slopes).unwrap(), 43.0);
    all_near(&slopes, &[2.0, -2.0]);
    assert_eq!(network.source_variables(warm), [0, 1]);
    assert!(network.source_variables(plain).is_empty());
    let mut out = [7.0; 2];
    network.source_powers(&mut scope, &mut out).unwrap();
    all_near(&out, &[7.0, 8.0]);
    let mut out = [7.0];
    network.boundary_temperatures(&mut scope, &mut out).unwrap();
    all_near(&out, &[290.0]);
}

#[test]
fn inputs_that_fail_during_a_run_are_named() {
    let (mut b, a, _) = cooled();
    let t = time(&b, "absolute(10 [K]) - 1 [K/s] * t");
    b.boundary("falling", t);
    let p = power(&b, "1 [W] * sqrt((T - air.T) / 1 [K])");
    let root = b.source("root", a, p);
    let p = time(&b, "1 [W] * sqrt(4 - t / 1 [s])");
    b.source("ends", a, p);
    let network = b.build().unwrap();
    let mut scope = network.evaluation();
    scope.set_time(11.0, 11.0);
    let error = network.boundary_temperatures(&mut scope, &mut [0.0; 2]).unwrap_err();
    assert_eq!((error.name.as_str(), error.field), ("falling", Field::Temperature));
    assert!(matches!(error.problem, InputProblem::BelowAbsoluteZero(t) if (t + 1.0).abs() < 1e-12));
    let error = network.source_powers(&mut scope, &mut [0.0; 2]).unwrap_err();
    assert_eq!((error.name.as_str(), error.field), ("ends", Field::POWER));
    let error = network.source_heat(root, &mut scope, &[280.0, 290.0, 1.0]).unwrap_err();
    assert_eq!(error.name, "root");
    let error =
        network.source_slopes(root, &mut scope, &[280.0, 290.0, 1.0], &mut Vec::new()).unwrap_err();
    assert_eq!(error.name, "root");
    scope.set_time(10.0, 10.0);
    assert!(
        network.boundary_temperatures(&mut scope, &mut [0.0; 2]).is_ok(),
        "0 K is a temperature"
    );
}
