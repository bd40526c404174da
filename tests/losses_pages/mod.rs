//! Closed forms of the pages of losses, in the units of the published formulas: mm, rpm, mm^2/s.

use std::f64::consts::PI;

use super::{Closed, relaxed};

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

/// Gears of the page of meshes, in mm, N m, rpm, mPa s and um.
struct Gears {
    teeth: [f64; 2],
    module: f64,
    width: f64,
    /// Helix angle in degrees.
    helix: f64,
    /// Of the wheel in modules, negative in a ring.
    addendum: f64,
    torque: f64,
    speed: f64,
    viscosity: f64,
    roughness: f64,
}

const PAIR: Gears = Gears {
    teeth: [20.0, 60.0],
    module: 3.0,
    width: 30.0,
    helix: 15.0,
    addendum: 1.0,
    torque: 50.0,
    speed: 1500.0,
    viscosity: 51.6,
    roughness: 0.5,
};

impl Gears {
    /// Pitch diameters, and the angles alpha_t and beta_b.
    fn transverse(&self) -> ([f64; 2], f64, f64) {
        let (alpha, beta) = (20f64.to_radians(), self.helix.to_radians());
        let alpha_t = (alpha.tan() / beta.cos()).atan();
        let beta_b = (beta.tan() * alpha_t.cos()).atan();
        (self.teeth.map(|z| z * self.module / beta.cos()), alpha_t, beta_b)
    }

    fn line_load(&self) -> f64 {
        let (d, alpha_t, _) = self.transverse();
        self.torque * 1e3 / (0.5 * d[0]) / alpha_t.cos() / self.width
    }

    fn friction(&self) -> f64 {
        let (d, alpha_t, beta_b) = self.transverse();
        let speed = 2.0 * omega(self.speed) * 0.5e-3 * d[0] * alpha_t.sin();
        let ratio = self.teeth[1] / self.teeth[0];
        let joined = ratio + self.addendum.signum();
        let radius = 0.5 * d[0] * alpha_t.sin() * ratio / (beta_b.cos() * joined);
        0.048
            * (self.line_load() / (speed * radius)).powf(0.2)
            * self.viscosity.powf(-0.05)
            * self.roughness.powf(0.25)
    }

    fn lost(&self) -> f64 {
        let (d, alpha_t, beta_b) = self.transverse();
        let contact = |d: f64, addendum: f64| {
            let (tip, base) = (d + 2.0 * addendum * self.module, d * alpha_t.cos());
            let beyond = 0.5 * (tip * tip - base * base).sqrt() - 0.5 * d * alpha_t.sin();
            let step = PI * self.module / self.helix.to_radians().cos() * alpha_t.cos();
            addendum.signum() * beyond / step
        };
        let (e1, e2) = (contact(d[0], 1.0), contact(d[1], self.addendum));
        let [z1, z2] = self.teeth;
        let factor = PI * (z2 + self.addendum.signum() * z1) / (z1 * z2 * beta_b.cos())
            * (1.0 - (e1 + e2) + e1 * e1 + e2 * e2);
        self.torque * omega(self.speed) * self.friction() * factor
    }

    /// Blok's flash temperature in K where spur teeth come into mesh with a third of the load: the
    /// highest on the path of these.
    fn flash(&self) -> f64 {
        let (d, alpha, _) = self.transverse();
        let side = self.addendum.signum();
        let [r1, r2] = d.map(|d| 0.5e-3 * d);
        let tip = r2 + 1e-3 * self.addendum * self.module;
        let rho2 = (tip * tip - (r2 * alpha.cos()).powi(2)).sqrt();
        let rho1 = r1 * alpha.sin() - side * (rho2 - r2 * alpha.sin());
        let load = self.line_load() * 1e3 / 3.0;
        let radius = rho1 * rho2 / (rho2 + side * rho1);
        let half = (8.0 * load * radius * (1.0 - 0.09) / (PI * 206e9)).sqrt();
        let first = omega(self.speed) * rho1;
        let second = omega(self.speed) * self.teeth[0] / self.teeth[1] * rho2;
        let difference = (first.sqrt() - second.sqrt()).abs();
        1.11 * self.friction() * load * difference / (48.7 * 3.8e6 * 2.0 * half).sqrt()
    }
}

/// Loss of 16 and 24 teeth of 4.5 mm whose shafts are 91.5 mm apart, from circles and the line of
/// action in mm: 200 N m at 1500 rpm.
fn shifted() -> f64 {
    let angle = 20f64.to_radians();
    let bases = [36.0, 54.0].map(|radius| radius * angle.cos());
    let tips = [36.0 + 4.5 * 1.1817, 54.0 + 4.5 * 1.1715];
    let working = ((bases[0] + bases[1]) / 91.5).acos();
    let step = PI * 4.5 * angle.cos();
    let reach = |i: usize| f64::sqrt(tips[i] * tips[i] - bases[i] * bases[i]);
    let [e1, e2] = [0, 1].map(|i| (reach(i) - bases[i] * working.tan()) / step);
    let factor = PI * 40.0 / (16.0 * 24.0) * (1.0 - e1 - e2 + e1 * e1 + e2 * e2);
    let [rho1, rho2] = bases.map(|base| base * working.tan());
    let (load, speed) = (200e3 / bases[0] / 14.0, 2e-3 * omega(1500.0) * rho1);
    let radius = rho1 * rho2 / (rho1 + rho2);
    let friction = 0.048
        * (load / (speed * radius)).powf(0.2)
        * (15.12 * 0.878_f64).powf(-0.05)
        * 0.355_f64.powf(0.25)
        * 0.846;
    200.0 * omega(1500.0) * friction * factor
}

pub(crate) fn mesh() -> Vec<Closed> {
    let stage = Gears { helix: 0.0, addendum: -0.9, ..PAIR }.lost();
    let fast = Gears {
        teeth: [25.0, 37.0],
        module: 4.0,
        width: 20.0,
        helix: 0.0,
        torque: 300.0,
        speed: 3000.0,
        viscosity: 20.0,
        roughness: 0.4,
        ..PAIR
    };
    let planet = Gears { helix: 0.0, addendum: -0.7, ..PAIR };
    let (pair, mineral) = (PAIR.lost(), 33.0 * 220f64.ln());
    let [fast_flash, planet_flash] = [fast.flash(), planet.flash()];
    let gears = 20.0 + fast.lost() / 20.0;
    vec![
        ("pair.P", "steady", pair),
        ("stage.P", "steady", stage),
        ("pinion.T", "steady", 20.0 + 0.6 * pair),
        ("wheel.T", "steady", 20.0 + 0.4 * pair / 2.0),
        ("ring.T", "steady", 20.0 + stage / 4.0),
        ("fast.flash", "steady", fast_flash),
        ("fast.contact", "steady", gears + fast_flash),
        ("fast.scuffing", "steady", 118.0 + mineral),
        ("fast.margin", "steady", 118.0 + mineral - gears - fast_flash),
        ("shifted.P", "steady", shifted()),
        ("planet.margin", "steady", 150.0 - (20.0 + planet.lost() / 4.0) - planet_flash),
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
