//! Closed forms of the pages of losses, in the units of the published formulas: mm, rpm, mm^2/s.

use std::f64::consts::PI;

use crate::{Closed, relaxed};

fn omega(rpm: f64) -> f64 {
    rpm * PI / 30.0
}

pub(crate) fn bearing() -> Vec<Closed> {
    let (n, nu, w) = (1500.0_f64, 60.0_f64, omega(1500.0));
    let spin = 1e-10 * 2.0 * (nu * n).powf(2.0 / 3.0) * 60f64.powi(3) * w;
    let roll = 4e-4 * 2000.0 * 0.06 * w;
    // 30 x 62 mm with 1 kN radially and 200 N axially, C0 11.2 kN
    let (sum, wall, d_m) = (92.0, 32.0_f64, 46.0_f64);
    let sine = (24.6 * (200.0_f64 / 11.2e3).powf(0.24)).to_radians().sin();
    let rolling = 4.3e-7 * d_m.powf(1.96) * (1000.0 + 1.7 / sine * 200.0).powf(0.54);
    let heating = 1.0 / (1.0 + 1.84e-9 * (n * d_m).powf(1.28) * nu.powf(0.64));
    let starved = (-3e-8 * nu * n * sum * (3.1 / (2.0 * wall)).sqrt()).exp();
    let axial = 4.25 * d_m.powf(1.5) / sine * 200f64.powi(4);
    let sliding = 4.63e-3 * d_m.powf(-0.145) * (1e15 + axial).cbrt();
    let mixed = (-2.6e-8 * (n * nu).powf(1.4) * d_m).exp();
    let friction = mixed * 0.12 + (1.0 - mixed) * 0.05;
    let moment = heating * starved * rolling * (nu * n).powf(0.6) + sliding * friction;
    let small = 1e-3 * moment * w;
    let end = 25.0 + spin + roll + small;
    vec![
        ("spin.P", "steady", spin),
        ("roll.P", "steady", roll),
        ("small.P", "steady", small),
        ("housing.T", "steady", end),
        ("housing.T", "10 min", relaxed(25.0, end, 600.0, 800.0)),
    ]
}

pub(crate) fn seal() -> Vec<Closed> {
    let w = omega(1000.0);
    let all = [7.69e-6 * 2500.0 * 1000.0, 3.737e-3 * 50.0 * w, 2.429e-3 * 50.0 * w];
    vec![
        ("plain.P", "steady", all[0]),
        ("viton.P", "steady", all[1]),
        ("buna.P", "steady", all[2]),
        ("cover.T", "steady", 20.0 + all.iter().sum::<f64>() / 2.0),
    ]
}

/// 20 teeth with 60, or in a ring of 60, of 3 mm and 30 mm width, 50 N m at 1500 rpm in 60 mm^2/s
/// and 860 kg/m^3, Ra 0.5 um.
fn lost(helix: f64, ring: bool) -> f64 {
    let (side, alpha, beta) = (if ring { -1.0 } else { 1.0 }, 20f64.to_radians(), helix);
    let alpha_t = (alpha.tan() / beta.cos()).atan();
    let beta_b = (beta.tan() * alpha_t.cos()).atan();
    let d = [20.0, 60.0].map(|z| z * 3.0 / beta.cos());
    let contact = |d: f64, side: f64| {
        let (tip, base) = (d + side * 6.0, d * alpha_t.cos());
        let beyond = 0.5 * (tip * tip - base * base).sqrt() - 0.5 * d * alpha_t.sin();
        side * beyond / (PI * 3.0 / beta.cos() * alpha_t.cos())
    };
    let (e1, e2) = (contact(d[0], 1.0), contact(d[1], side));
    let factor =
        PI * (3.0 + side) / (20.0 * 3.0 * beta_b.cos()) * (1.0 - (e1 + e2) + e1 * e1 + e2 * e2);
    let line_load = 50e3 / (0.5 * d[0]) / alpha_t.cos() / 30.0;
    let speed = 2.0 * omega(1500.0) * 0.5e-3 * d[0] * alpha_t.sin();
    let radius = 0.5 * d[0] * alpha_t.sin() * 3.0 / (beta_b.cos() * (3.0 + side));
    let eta = 60.0 * 860.0 * 1e-3_f64;
    let friction =
        0.048 * (line_load / (speed * radius)).powf(0.2) * eta.powf(-0.05) * 0.5_f64.powf(0.25);
    50.0 * omega(1500.0) * friction * factor
}

pub(crate) fn mesh() -> Vec<Closed> {
    let (pair, stage) = (lost(15f64.to_radians(), false), lost(0.0, true));
    vec![
        ("pair.P", "steady", pair),
        ("stage.P", "steady", stage),
        ("pinion.T", "steady", 20.0 + 0.6 * pair),
        ("wheel.T", "steady", 20.0 + 0.4 * pair / 2.0),
        ("ring.T", "steady", 20.0 + stage / 4.0),
    ]
}

pub(crate) fn churning() -> Vec<Closed> {
    let lost = |constant: f64, dip: f64, diameter: f64, exponent: f64| {
        constant * 1e-23 / 0.2 * dip * 60.0 * 1500f64.powi(3) * diameter.powf(exponent)
    };
    let shaft = lost(7.37, 1.0, 50.0, 4.7) * 80.0;
    let web = lost(1.474, 0.5, 120.0, 5.7);
    let rough = (7.93 - 4.648 / 3.0) / 15f64.to_radians().tan().sqrt();
    let teeth = lost(7.37, 0.5, 120.0, 4.7) * 30.0 * rough;
    vec![
        ("shaft.P", "steady", shaft),
        ("web.P", "steady", web),
        ("teeth.P", "steady", teeth),
        ("sump.T", "steady", 20.0 + (shaft + web + teeth) / 2.0),
    ]
}
