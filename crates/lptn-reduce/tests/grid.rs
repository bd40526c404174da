//! A plate of cells, one corner heated, one side cooled, as ten nodes.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking, in its helpers too")]

use crate::common;

use common::{assembled, near};
use lptn_assembly::ThermalSystem;
use lptn_network::{Conductance, HeatCapacity, NetworkBuilder, NodeId, Temperature};
use lptn_reduce::{Allowed, Kept, KeptReference, Nodes, NortonEquivalent, Projected, StepResponse};

/// `n` x `n` cells of 1 J/K, 1 W/K between them and 2 W/K from each of one side to the boundary.
fn plate(n: usize) -> (ThermalSystem, Vec<NodeId>) {
    let zero = Temperature::celsius(0.0);
    let mut b = NetworkBuilder::new();
    let cells: Vec<NodeId> =
        (0..n * n).map(|k| b.node(&format!("n{k}"), HeatCapacity(1.0), zero)).collect();
    let end = b.boundary("end", zero);
    for i in 0..n {
        for j in 0..n {
            if i + 1 < n {
                let name = format!("x{i}_{j}");
                b.resistor(&name, cells[i * n + j], cells[(i + 1) * n + j], Conductance(1.0));
            }
            if j + 1 < n {
                let name = format!("y{i}_{j}");
                b.resistor(&name, cells[i * n + j], cells[i * n + j + 1], Conductance(1.0));
            }
        }
        b.resistor(&format!("out{i}"), cells[(n - 1) * n + i], end, Conductance(2.0));
    }
    (assembled(b), cells)
}

/// The largest error in shares of the rise from `1e-3 tau_1` on, and at all times.
fn check(n: usize, (resistance, tau): (f64, f64)) -> (f64, f64) {
    let (system, cells) = plate(n);
    let norton = NortonEquivalent::new(&system, cells[0]).unwrap();
    let step = StepResponse::new(&system, &norton).unwrap().unwrap();
    near(norton.resistance, resistance, 1e-10);
    near(step.slowest().tau, tau, 1e-10);
    let ten = Nodes::of(&step, 10).unwrap();
    assert_eq!(ten.count(), 10);
    let error = |time: f64| (ten.foster.step(time) - step.value(time)).abs() / norton.resistance;
    let largest = |from: f64| {
        (0..4000).map(|k| error(tau * from * 10_f64.powf(f64::from(k) / 400.0))).fold(0.0, f64::max)
    };
    assert!(ten.worst.most() < 1e-3 * norton.resistance, "{ten:?}");
    (largest(1e-3), largest(1e-7))
}

/// Resistance and time constant by SciPy: splu of the balances, and the eigenvalue in closed form,
/// `1 / (4 sin^2(pi / (4 n)))`: one side closed, the other half a cell from the boundary.
#[test]
fn a_plate_is_ten_nodes() {
    let quarter = std::f64::consts::FRAC_PI_4;
    let tau = 1.0 / (4.0 * (quarter / 20.0).sin().powi(2));
    let (late, all) = check(20, (2.387156088023507, tau));
    assert!(late < 1e-4 && all < 1e-4, "{late} {all}");
}

#[test]
fn a_large_plate_is_ten_nodes() {
    let quarter = std::f64::consts::FRAC_PI_4;
    let tau = 1.0 / (4.0 * (quarter / 100.0).sin().powi(2));
    let (late, all) = check(100, (3.41167636849099, tau));
    assert!(late < 1e-3, "{late}");
    assert!(all < 1e-4, "{all}");
}

/// Between two nodes ten modes do what ten nodes with positive elements do not.
#[test]
fn two_corners_of_a_plate_are_ten_modes() {
    let (system, cells) = plate(40);
    let asked = [cells[0], cells[39]];
    let reference = KeptReference::new(&system, &asked, (None, Allowed::default())).unwrap();
    let (kept, errors) = Kept::new(&system, &reference, 10).unwrap();
    let model = Projected::new(&system, &reference, 10).unwrap();
    assert_eq!((kept.count(), model.tau.len()), (10, 10));
    let (nodes, modes) = (errors.share(), model.errors.share());
    assert!(modes < 0.03 && modes < 0.2 * nodes, "{modes} {nodes}");
}
