//! Modes near a state and of large networks, against closed forms.

#![allow(
    clippy::unwrap_used,
    clippy::float_cmp,
    reason = "helpers of tests; numbers that are exact"
)]

use crate::elements_helper as elements;

use elements::{quantity, radiation, stream, system};
use lptn_assembly::ThermalSystem;
use lptn_network::{Conductance, HeatCapacity, NetworkBuilder, Temperature};
use lptn_solve::{LinearisedError, Modes, ModesError, SteadyState};

/// A capacity rate in W/K.
fn rate(flow: f64) -> lptn_network::Input {
    quantity(&format!("{flow} W/K"))
}

/// A ring of `count` equal cells that a stream of capacity rate `flow` goes around, each with a
/// path `loss` to the air: circulant, so that its rates are
/// `(loss + flow (1 - exp(-2 pi i k / count))) / C`.
fn ring(count: usize, flow: f64, loss: f64) -> ThermalSystem {
    let mut b = NetworkBuilder::new();
    let air = b.boundary("air", Temperature::celsius(20.0));
    let start = Temperature::celsius(60.0);
    let cells: Vec<_> =
        (0..count).map(|i| b.node(&format!("cell{i}"), HeatCapacity(50.0), start)).collect();
    for i in 0..count {
        stream(&mut b, &format!("hose{i}"), (cells[i], cells[(i + 1) % count]), rate(flow));
        if loss > 0.0 {
            b.resistor(&format!("skin{i}"), cells[i], air, Conductance(loss));
        }
    }
    system(b)
}

#[test]
fn a_ring_of_streams_swings_as_its_closed_form_does() {
    for (count, flow, loss) in [(3, 10.0, 2.0), (24, 80.0, 0.5), (40, 0.3, 4.0)] {
        let modes = Modes::of(&ring(count, flow, loss), None, count).unwrap();
        let exact = |k: usize| {
            let angle = std::f64::consts::TAU * k as f64 / count as f64;
            ((loss + flow * (1.0 - angle.cos())) / 50.0, flow * angle.sin() / 50.0)
        };
        assert_eq!(modes.all(), count / 2 + 1);
        for (k, mode) in modes.modes().iter().enumerate() {
            let (rate, omega) = exact(k);
            assert!((mode.rate / rate - 1.0).abs() < 1e-10, "{k}: {} {rate}", mode.rate);
            let size = rate.hypot(omega);
            assert!((mode.omega - omega.abs()).abs() < 1e-10 * size, "{k}: {}", mode.omega);
            // every cell takes the same part, and each is ahead of the next by the same angle
            for part in &mode.participation {
                assert!((part * count as f64 - 1.0).abs() < 1e-9, "{part}");
            }
            assert!(mode.shape.iter().all(|x| (x - 1.0).abs() < 1e-9 || mode.omega == 0.0));
        }
    }
}

#[test]
fn a_ring_that_loses_nothing_keeps_its_mean_for_ever() {
    let modes = Modes::of(&ring(5, 10.0, 0.0), None, 9).unwrap();
    assert_eq!(modes.modes()[0].rate, 0.0);
    assert!(modes.modes()[1].rate > 0.0);
}

#[test]
fn a_chain_of_equal_cells_has_no_modes() {
    let mut b = NetworkBuilder::new();
    let inlet = b.boundary("inlet", Temperature::celsius(20.0));
    let start = Temperature::celsius(60.0);
    let mut before = lptn_network::End::from(inlet);
    for i in 0..6 {
        let cell = b.node(&format!("cell{i}"), HeatCapacity(50.0), start);
        stream(&mut b, &format!("hose{i}"), (before, cell), rate(10.0));
        before = cell.into();
    }
    let refused = Modes::of(&system(b), None, 9).unwrap_err();
    assert!(matches!(refused, ModesError::Defective), "{refused}");
}

/// A ball that glows at a temperature T has the rate 4 sigma A T^3 / C there.
#[test]
fn a_glowing_ball_has_the_rate_of_its_slope() {
    let mut b = NetworkBuilder::new();
    let ball = b.node("ball", HeatCapacity(500.0), Temperature(900.0));
    let space = b.boundary("space", Temperature(300.0));
    radiation(&mut b, "glow", (ball, space), "0.05 m^2");
    b.source("heater", ball, lptn_network::HeatFlow(1000.0));
    let system = system(b);
    let steady = SteadyState::solve(&system, 0.0).unwrap();
    let modes = Modes::of(&system, Some(&steady), 1).unwrap();
    let sigma = 5.670_374_419e-8;
    let hot = (300.0_f64.powi(4) + 1000.0 / (sigma * 0.05)).powf(0.25);
    let rate = 4.0 * sigma * 0.05 * hot.powi(3) / 500.0;
    assert!((modes.modes()[0].rate / rate - 1.0).abs() < 1e-9, "{}", modes.modes()[0].rate);
    // off by the rest of the binomial: 6 T^2 x^2 + 4 T x^3 + x^4 at x = 10 K
    let rest = sigma * 0.05 * (6.0 * hot * hot * 100.0 + 4.0 * hot * 1e3 + 1e4);
    let tried = modes.tried().unwrap();
    assert!((tried.heat / rest - 1.0).abs() < 1e-6, "{} {rest}", tried.heat);
    assert!((tried.share / (rest / (rate * 500.0 * 10.0)) - 1.0).abs() < 1e-6);
    let refused = Modes::of(&system, None, 1).unwrap_err();
    assert!(
        matches!(refused, ModesError::Linearised(LinearisedError::NotLinear { .. })),
        "{refused}"
    );
}

/// Cells of a square plate with one insulated pair of edges; its eigenvalues are sums of those
/// of two rows, and many of them come in pairs.
#[test]
fn a_plate_of_2500_cells_has_all_of_its_slowest_modes() {
    let (n, g, c, skin) = (50_usize, 2.0, 3.0, 0.04);
    let mut b = NetworkBuilder::new();
    let air = b.boundary("air", Temperature::celsius(20.0));
    let start = Temperature::celsius(60.0);
    let cells: Vec<_> =
        (0..n * n).map(|i| b.node(&format!("cell{i}"), HeatCapacity(c), start)).collect();
    for i in 0..n * n {
        b.resistor(&format!("skin{i}"), cells[i], air, Conductance(skin));
        if i % n + 1 < n {
            b.resistor(&format!("x{i}"), cells[i], cells[i + 1], Conductance(g));
        }
        if i + n < n * n {
            b.resistor(&format!("y{i}"), cells[i], cells[i + n], Conductance(g));
        }
    }
    let modes = Modes::of(&system(b), None, 12).unwrap();
    let row = |k: usize| 4.0 * (std::f64::consts::PI * k as f64 / (2 * n) as f64).sin().powi(2);
    let mut exact: Vec<f64> =
        (0..8).flat_map(|a| (0..8).map(move |b| (g * (row(a) + row(b)) + skin) / c)).collect();
    exact.sort_by(f64::total_cmp);
    assert_eq!((modes.all(), modes.modes().len()), (n * n, 12));
    for (mode, exact) in modes.modes().iter().zip(&exact) {
        assert!((mode.rate / exact - 1.0).abs() < 1e-10, "{} {exact}", mode.rate);
    }
}

/// Nothing leads out: the mean lasts for ever, the others are known.
#[test]
fn a_row_of_2100_cells_without_an_outside_keeps_its_mean() {
    let n = 2100;
    let mut b = NetworkBuilder::new();
    let start = Temperature::celsius(60.0);
    let cells: Vec<_> =
        (0..n).map(|i| b.node(&format!("cell{i}"), HeatCapacity(3.0), start)).collect();
    for pair in cells.windows(2) {
        b.resistor(&format!("r{}", pair[0].index()), pair[0], pair[1], Conductance(2.0));
    }
    let modes = Modes::of(&system(b), None, 5).unwrap();
    for (k, mode) in modes.modes().iter().enumerate() {
        let angle = std::f64::consts::PI * k as f64 / (2 * n) as f64;
        let exact = 2.0 * 4.0 * angle.sin().powi(2) / 3.0;
        assert!((mode.rate - exact).abs() <= 1e-8 * exact, "{k}: {} {exact}", mode.rate);
    }
}
