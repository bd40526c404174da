//! Paths that are alike are found, and evaluated together to the last digit of each alone.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use lptn_network::{
    ConductorId, ConductorKind, Formula, HeatCapacity, Network, NetworkBuilder, Path, Temperature,
};

use crate::common::{cooled, link, power, quantity, time};

/// Bodies in a row over one boundary, each with the path that `of` gives.
fn row(count: usize, of: impl Fn(&mut NetworkBuilder, usize) -> (ConductorKind, Path)) -> Network {
    let mut b = NetworkBuilder::new();
    let air = b.boundary("air", Temperature(293.15));
    for i in 0..count {
        let body = b.node(&format!("body{i}"), HeatCapacity(10.0), Temperature(300.0));
        let (kind, path) = of(&mut b, i);
        b.conductor(&format!("path{i}"), kind, (body.into(), air.into()), path);
    }
    b.build().unwrap()
}

fn film(b: &NetworkBuilder, text: &str, area: usize) -> (ConductorKind, Path) {
    let area = quantity(&format!("{} m^2", 0.1 + 0.03 * area as f64));
    (ConductorKind::Convection, Path::film(link(b, text), area))
}

/// The ids of every group, and that the heats of every group are those of its members alone.
fn groups(network: &Network, temperatures: &[f64]) -> Vec<Vec<usize>> {
    let (mut scope, mut heats) = (network.evaluation(), Vec::new());
    scope.set_time(3.0, 3.0);
    let mut found = Vec::new();
    for (alike, members) in network.alike(network.conductor_ids()) {
        alike.heats(&mut scope, temperatures, &mut heats);
        assert_eq!(heats.len(), members.len());
        for (&id, heat) in members.iter().zip(&heats) {
            alone(network, id, temperatures, *heat);
        }
        found.push(members.iter().map(|id| id.index()).collect());
    }
    found
}

fn alone(network: &Network, id: ConductorId, temperatures: &[f64], together: f64) {
    let mut scope = network.evaluation();
    scope.set_time(3.0, 3.0);
    let [from, to] = network.exchange(id, &mut scope, temperatures).unwrap();
    assert_eq!(to.to_bits(), together.to_bits(), "{id:?}");
    assert_eq!(from.to_bits(), (-together).to_bits(), "{id:?}");
}

/// Of a row: different everywhere, some colder than the boundary.
fn temperatures(count: usize) -> Vec<f64> {
    (0..count).map(|i| 280.0 + 7.3 * i as f64).chain([293.15]).collect()
}

const NATURAL: &str = "1.32 [W/(m^2 K)] * (abs(dT) / 1 [K])^0.25";

#[test]
fn films_of_one_expression_are_a_group_whatever_their_areas() {
    let network = row(19, |b, i| film(b, NATURAL, i));
    assert_eq!(groups(&network, &temperatures(19)), [(0..19).collect::<Vec<_>>()]);
}

#[test]
fn expressions_and_laws_tell_groups_apart() {
    let network = row(12, |b, i| match i % 4 {
        0 => film(b, NATURAL, i),
        1 => film(b, "1.42 [W/(m^2 K)] * (abs(dT) / 1 [K])^0.25", i),
        2 => (ConductorKind::Resistor, Path::conductance(link(b, "1 [W/K] + 1 [W/K^2] * abs(dT)"))),
        _ => (
            ConductorKind::Convection,
            Path::film(quantity("3 W/(m^2 K)"), link(b, "1 [m^2] + 0.01 [m^2/K] * abs(dT)")),
        ),
    });
    let expected: Vec<Vec<usize>> = (0..4).map(|k| vec![k, k + 4, k + 8]).collect();
    assert_eq!(groups(&network, &temperatures(12)), expected);
}

/// The mean and the time count, and so does radiation, which is linear in the fourth powers.
#[test]
fn every_slot_of_a_path_is_read() {
    let network =
        row(9, |b, i| film(b, "2 [W/(m^2 K^2)] * kelvin(T_mean) + 1 [W/(m^2 K s)] * t", i));
    assert_eq!(groups(&network, &temperatures(9)).len(), 1);
    let network = row(9, |b, _| {
        let ends = "0.2 [W/K^3] * kelvin(T_from) * kelvin(T_to)";
        (ConductorKind::Resistor, Path::conductance(link(b, ends)))
    });
    assert_eq!(groups(&network, &temperatures(9)).len(), 1);
    let network = row(9, |b, i| {
        let emissivity = link(b, "0.3 + 0.001 [1/K] * kelvin(T_mean)");
        let area = quantity(&format!("{} m^2", 1 + i));
        let law = Path::new(Formula::GreySurfaces, [emissivity, area, quantity("0.8")]);
        (ConductorKind::Radiation, law)
    });
    assert_eq!(groups(&network, &temperatures(9)).len(), 1);
}

#[test]
fn what_cannot_be_evaluated_together_is_left_out() {
    let network = row(3, |b, i| match i {
        0 => film(b, "if(dT > 0 [K], 3 [W/(m^2 K)], 4 [W/(m^2 K)])", i),
        1 => (ConductorKind::Advection, Path::stream(time(b, "1 [W/K] + 1 [W/(K s)] * t"))),
        _ => (ConductorKind::Resistor, Path::conductance(quantity("3 W/K"))),
    });
    assert!(groups(&network, &temperatures(3)).is_empty());
}

/// Heats behind an error, or a negative conductance, are left to the paths alone.
#[test]
fn neighbours_of_an_error_are_not_known() {
    // negative where a body is 60 K warmer: the last ones of twenty
    let network = row(20, |b, i| film(b, "3 [W/(m^2 K)] - 0.05 [W/(m^2 K^2)] * dT", i));
    let (mut scope, mut heats) = (network.evaluation(), Vec::new());
    let temperatures = temperatures(20);
    let (alike, members) = network.alike(network.conductor_ids()).pop().unwrap();
    alike.heats(&mut scope, &temperatures, &mut heats);
    let known = heats.iter().take_while(|heat| !heat.is_nan()).count();
    assert_eq!(known, 8, "those of the first lanes: {heats:?}");
    assert!(heats[8..].iter().all(|heat| heat.is_nan()));
    let alone = |id: &ConductorId| network.exchange(*id, &mut scope, &temperatures).is_ok();
    let right: Vec<bool> = members.iter().map(alone).collect();
    assert!(right[..10].iter().all(|is| *is) && !right[19], "{right:?}");
}

/// A source that varies with time alone is read at every time.
#[test]
fn sources_that_vary_with_time_alone_are_told() {
    let (mut b, a, _) = cooled();
    let ramp = time(&b, "1 [W] + 2 [W/s] * t");
    let warm = power(&b, "1 [W/K] * (T - absolute(280 [K])) + 1 [W/s] * t");
    let steady = power(&b, "3 [W] * 2");
    b.source("steady", a, steady);
    let ramp = b.source("ramp", a, ramp);
    b.source("warm", a, warm);
    b.source("number", a, quantity("7 W"));
    assert_eq!(b.build().unwrap().timed_sources(), [ramp]);
}
