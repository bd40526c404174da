//! Closed forms of the pages of joints.

use super::{Closed, relaxed, root};

pub(crate) fn contact() -> Vec<Closed> {
    let g = 5000.0 * 8e-4;
    vec![
        ("seat.Q", "5 s", 60.0 * (1.0 - (-5.0 * g / 40.0_f64).exp())),
        ("chip.T", "5 s", relaxed(30.0, 30.0 + 60.0 / g, 5.0, 40.0 / g)),
        ("chip.T", "steady", 30.0 + 60.0 / g),
        ("sink.T", "steady", 30.0 + 60.0 / (touching(167.0, 390.0, 1.5e-6, 2e6) * 8e-4)),
    ]
}

/// 1.25 ks m / sigma (p / H)^0.95 with m = 0.15 and H = 1.1 GPa.
fn touching(k1: f64, k2: f64, sigma: f64, pressure: f64) -> f64 {
    1.25 * 2.0 / (1.0 / k1 + 1.0 / k2) * 0.15 / sigma * (pressure / 1.1e9).powf(0.95)
}

pub(crate) fn press_fit() -> Vec<Closed> {
    let interference = |hub: f64| 78e-6 - 0.1 * (23.6e-6 * (hub - 25.0) - 12e-6 * 15.0);
    // Lamé with radii of 50 and 65 mm
    let hub = (65.0_f64.powi(2) + 50.0_f64.powi(2)) / (65.0_f64.powi(2) - 50.0_f64.powi(2));
    let given = 0.1 * ((hub + 0.33) / 70e9 + (1.0 - 0.3) / 210e9);
    let heat = |t: f64| {
        let area = std::f64::consts::PI * 0.1 * 0.03;
        touching(167.0, 45.0, 1e-6, interference(t).max(0.0) / given) * area * (t - 40.0)
    };
    let hub = root(40.0, 45.0, |t| heat(t) - 300.0);
    vec![
        ("hub.T", "steady", hub),
        ("ring_fit.margin", "steady", interference(hub) / (0.1 * 11.6e-6)),
    ]
}
