//! Bodies whose paths are evaluated together against means of straight lines by hand.

use crate::networks;

use lptn_assembly::{JacobianForm, ThermalSystem};
use lptn_network::{GridBlock, NetworkBuilder, Substance, Temperature};
use networks::{dense, flow, own, quantity, system};

/// Conductivity in W/(m K) at a temperature in K.
fn conductivity(t: f64) -> f64 {
    20.0 * (1.0 + 0.001 * (t - 300.0))
}

/// A rod of 1 m and 0.01 m^2 in 40 cells, joined to nothing.
fn rod(k: &str) -> ThermalSystem {
    let mut b = NetworkBuilder::new();
    let k = own(&b, k);
    b.grid(
        "rod",
        GridBlock {
            size: ["1 m", "0.1 m", "0.1 m"].map(quantity),
            cells: vec![40],
            conductivity: [k.clone(), k.clone(), k],
            substance: Substance::Properties {
                density: quantity("1000 kg/m^3"),
                cp: quantity("1000 J/(kg K)"),
            },
            initial: Some(Temperature(300.0).into()),
        },
    );
    system(b)
}

const LINEAR: &str = "20 [W/(m K)] * (1 + 0.001 [1/K] * (kelvin(T) - 300 [K]))";

/// Temperatures in K that rise and fall along the rod, over several blocks of panels.
fn temperatures() -> Vec<f64> {
    (0..40).map(|i| 330.0 + 90.0 * (0.9 * f64::from(i)).sin() + f64::from(i)).collect()
}

/// The mean of a straight line is its value in the middle.
#[test]
fn heat_between_the_cells_of_a_body() {
    let t = temperatures();
    let found = flow(&rod(LINEAR), 0.0, &t);
    let heat = |i: usize| 0.4 * conductivity(0.5 * (t[i] + t[i + 1])) * (t[i] - t[i + 1]);
    for (i, found) in found.iter().enumerate() {
        let inward = if i > 0 { heat(i - 1) } else { 0.0 };
        let outward = if i < 39 { heat(i) } else { 0.0 };
        assert!((found - (inward - outward)).abs() < 1e-10, "{i}: {found}");
    }
}

/// Each end feels the conductivity at its own temperature; the symmetric form has the mean of both.
#[test]
fn derivatives_between_the_cells_of_a_body() {
    let (system, t) = (rod(LINEAR), temperatures());
    let exact = dense(&system, 0.0, &t, JacobianForm::Exact);
    let symmetric = dense(&system, 0.0, &t, JacobianForm::Symmetric);
    for i in 1..39 {
        let own = 0.4 * conductivity(t[i]);
        let mean = 0.2 * (conductivity(t[i]) + conductivity(t[i + 1]));
        let expected = [(exact[i][i], -2.0 * own), (exact[i + 1][i], own)];
        let further = [(exact[i - 1][i], own), (symmetric[i][i + 1], mean)];
        for (found, expected) in expected.into_iter().chain(further) {
            assert!((found - expected).abs() < 1e-10, "{i}: {found} {expected}");
        }
    }
}

/// A cell at which the conductivity is not known names its path.
#[test]
fn a_body_with_a_cell_too_hot_says_where() {
    let system = rod("20 [W/(m K)] * sqrt(5 - kelvin(T) / 100 [K])");
    let mut t = temperatures();
    let mut work = system.workspace();
    system.read_inputs(&mut work, 0.0, 0.0).unwrap();
    let mut flow = vec![0.0; 40];
    system.flow(&mut work, &t, &mut flow).unwrap();
    t[20] = 600.0;
    let error = system.flow(&mut work, &t, &mut flow).unwrap_err();
    assert_eq!(error.name, "rod.x[20]");
}
