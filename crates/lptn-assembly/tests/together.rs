//! Paths that are evaluated together give the heats, sums and errors of paths one by one.
#![allow(clippy::unwrap_used, reason = "tests")]

use lptn_assembly::ThermalSystem;
use lptn_network::{ConductorKind, HeatCapacity, NetworkBuilder, Path, Temperature};

use crate::networks::{flow, link, quantity, radiation, system};

/// Fifteen bodies in a row: each has a film to the air and one to the next, and some have more.
/// Expressions of one text are alike; blanks behind them make them as many texts.
fn row(film: &str, of_one_text: bool) -> ThermalSystem {
    let mut b = NetworkBuilder::new();
    let bodies: Vec<_> = (0..15)
        .map(|i| b.node(&format!("body{i}"), HeatCapacity(10.0 + i as f64), Temperature(300.0)))
        .collect();
    let (air, sky) =
        (b.boundary("air", Temperature(293.15)), b.boundary("sky", Temperature(250.0)));
    let mut count = 0;
    let mut path = |b: &mut NetworkBuilder, text: &str, ends| {
        count += 1;
        let blanks = if of_one_text { 0 } else { count };
        let h = link(b, &format!("{text}{:blanks$}", ""));
        let area = quantity(&format!("{} m^2", 0.1 + 0.013 * count as f64));
        b.conductor(&format!("path{count}"), ConductorKind::Convection, ends, Path::film(h, area));
    };
    for (i, body) in bodies.iter().enumerate() {
        path(&mut b, film, ((*body).into(), air.into()));
        if let Some(next) = bodies.get(i + 1) {
            path(
                &mut b,
                "7 [W/(m^2 K)] + 0.1 [W/(m^2 K^2)] * abs(dT)",
                ((*next).into(), (*body).into()),
            );
        }
        if i % 4 == 0 {
            radiation(&mut b, &format!("glow{i}"), (*body, sky), "0.3 m^2");
            path(
                &mut b,
                "if(dT > 3 [K], 3 [W/(m^2 K)], 4 [W/(m^2 K)])",
                ((*body).into(), air.into()),
            );
        }
    }
    system(b)
}

const NATURAL: &str = "1.32 [W/(m^2 K)] * (abs(dT) / 1 [K])^0.25";

fn temperatures(first: f64) -> Vec<f64> {
    (0..15).map(|i| first + 11.0 * (f64::from(i) * 1.7).sin()).collect()
}

fn boundary_heat(system: &ThermalSystem, y: &[f64]) -> Vec<f64> {
    let mut work = system.workspace();
    system.read_inputs(&mut work, 0.0, 0.0).unwrap();
    system.place(&mut work, y);
    let mut heat = vec![f64::NAN; 2];
    system.boundary_heat(&mut work, y, &mut heat).unwrap();
    heat
}

fn bits(values: &[f64]) -> Vec<u64> {
    values.iter().map(|value| value.to_bits()).collect()
}

/// The most paths that are alike.
fn most_alike(system: &ThermalSystem) -> usize {
    let network = system.network();
    network.alike(network.conductor_ids()).iter().map(|(_, ids)| ids.len()).max().unwrap()
}

#[test]
fn heats_and_their_sums_are_the_same_to_the_last_digit() {
    let (together, alone) = (row(NATURAL, true), row(NATURAL, false));
    assert_eq!([most_alike(&together), most_alike(&alone)], [15, 1]);
    for first in [260.0, 293.0, 350.0] {
        let y = temperatures(first);
        assert_eq!(bits(&flow(&together, 0.0, &y)), bits(&flow(&alone, 0.0, &y)), "{first}");
        let heats = [&together, &alone].map(|system| bits(&boundary_heat(system, &y)));
        assert_eq!(heats[0], heats[1], "{first}");
    }
}

/// A workspace keeps nothing of other temperatures.
#[test]
fn one_workspace_gives_the_same_wherever_it_was_before() {
    let system = row(NATURAL, true);
    let (mut work, mut found) = (system.workspace(), vec![f64::NAN; 15]);
    system.read_inputs(&mut work, 0.0, 0.0).unwrap();
    for first in [300.0, 350.0, 300.0] {
        let y = temperatures(first);
        system.flow(&mut work, &y, &mut found).unwrap();
        assert_eq!(bits(&found), bits(&flow(&system, 0.0, &y)), "{first}");
        let mut heat = vec![f64::NAN; 2];
        system.boundary_heat(&mut work, &y, &mut heat).unwrap();
        assert_eq!(bits(&heat), bits(&boundary_heat(&system, &y)), "{first}");
    }
}

/// The first path with an error is told by its name, as if it were alone; where no path has one, the
/// same workspace goes on.
#[test]
fn an_error_among_them_is_that_of_its_path() {
    let film = "3 [W/(m^2 K)] - 0.05 [W/(m^2 K^2)] * dT";
    let (together, alone) = (row(film, true), row(film, false));
    let mut hot = temperatures(300.0);
    (hot[7], hot[11]) = (400.0, 420.0);
    let error = |system: &ThermalSystem| {
        let (mut work, mut found) = (system.workspace(), vec![f64::NAN; 15]);
        system.read_inputs(&mut work, 0.0, 0.0).unwrap();
        let error = system.flow(&mut work, &hot, &mut found).unwrap_err();
        system.flow(&mut work, &temperatures(300.0), &mut found).unwrap();
        assert_eq!(bits(&found), bits(&flow(system, 0.0, &temperatures(300.0))));
        error.to_string()
    };
    assert_eq!(error(&together), error(&alone));
    assert!(error(&together).contains("path"), "{}", error(&together));
}
