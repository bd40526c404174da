//! The heat of every kind, by its formula.

use std::f64::consts::PI;

use super::case::{Case, Element, Kind, factor, most};
use crate::features::{Feature, ZERO};

/// Stefan and Boltzmann's constant in W/(m^2 K^4).
const SIGMA: f64 = 5.670_374_419e-8;

/// Area of all surfaces in m^2, and thickness of all slabs in m.
pub(crate) const AREA: f64 = 0.05;
pub(crate) const THICKNESS: f64 = 0.01;

/// Inner and outer radius in m of tubes and shells, and length of tubes and rods.
pub(crate) const RADII: [f64; 2] = [0.02, 0.03];
pub(crate) const LENGTH: f64 = 0.1;
pub(crate) const DIAMETER: f64 = 0.02;

/// Of a bearing and a gear: speed in rpm, mean diameters in mm.
pub(crate) const RPM: f64 = 1500.0;
pub(crate) const BEARING: f64 = 60.0;
pub(crate) const GEAR: f64 = 200.0;
pub(crate) const F1: f64 = 4e-4;

/// Of two spur gears: teeth, module and width in mm, roughness in um, density in kg/m^3.
pub(crate) const TEETH: [f64; 2] = [20.0, 60.0];
pub(crate) const MODULE: f64 = 3.0;
pub(crate) const WIDTH: f64 = 30.0;
pub(crate) const ROUGH: f64 = 0.5;
pub(crate) const DENSITY: f64 = 860.0;

/// Viscosity in mm^2/s.
pub(crate) const OIL: f64 = 60.0;

/// Emissivity of the second plate.
pub(crate) const SECOND: f64 = 0.7;

/// Specific heat of streams in J/(kg K).
pub(crate) const CP: f64 = 2000.0;

/// The joint under pressure: pressure and hardness in Pa, slope, roughness in m, conductivities in
/// W/(m K).
pub(crate) const PRESSURE: f64 = 1e6;
pub(crate) const HARDNESS: f64 = 1e9;
pub(crate) const SLOPE: f64 = 0.15;
pub(crate) const ROUGHNESS: f64 = 1.5e-6;
pub(crate) const K: [f64; 2] = [167.0, 390.0];

/// The capacity rate of the other stream of a cooler, in sizes.
pub(crate) const OTHER: f64 = 3.0;
pub(crate) const FAR_MORE: f64 = 60.0;

/// Radians per second.
pub(crate) fn omega() -> f64 {
    RPM * 2.0 * PI / 60.0
}

/// The conductance in W/K of a body of a shape with 1 W/(m K).
pub(crate) fn of_shape(kind: Kind) -> f64 {
    match kind {
        Kind::Rod => PI * DIAMETER.powi(2) / (4.0 * LENGTH),
        Kind::MaterialCylinder => 2.0 * PI * LENGTH / (RADII[1] / RADII[0]).ln(),
        Kind::MaterialSphere => 4.0 * PI / (RADII[0].recip() - RADII[1].recip()),
        _ => AREA / THICKNESS,
    }
}

/// The emissivity without features, such that it is at most 0.95 with them.
pub(crate) fn emissivity(features: &[Feature]) -> f64 {
    0.95 / most(features)
}

/// The exchange area in m^2 that conducts 1 W/K around 350 K.
pub(crate) fn exchange_area() -> f64 {
    (4.0 * SIGMA * 350.0_f64.powi(3)).recip()
}

/// The area of the joint under pressure in m^2 that conducts 1 W/K.
pub(crate) fn joint() -> f64 {
    let k = 2.0 * K[0] * K[1] / (K[0] + K[1]);
    (1.25 * k * SLOPE / ROUGHNESS * (PRESSURE / HARDNESS).powf(0.95)).recip()
}

/// The factor f0 of a bearing of 1 W, and how far a gear dips in for that.
pub(crate) fn of_one_watt() -> [f64; 2] {
    let bearing = 1e-10 * (OIL * RPM).powf(2.0 / 3.0) * BEARING.powi(3) * omega();
    let gear = 1.474e-23 / 0.2 * OIL * RPM.powi(3) * GEAR.powf(5.7);
    [bearing.recip(), gear.recip()]
}

/// The torque of a pinion in N m that loses so many W in its mesh: 1.2 powers of it.
pub(crate) fn torque(watts: f64) -> f64 {
    let alpha = 20.0_f64.to_radians();
    let [r1, r2] = TEETH.map(|z| 0.5 * z * MODULE);
    let contact = |r: f64| {
        let beyond = ((r + MODULE).powi(2) - (r * alpha.cos()).powi(2)).sqrt() - r * alpha.sin();
        beyond / (PI * MODULE * alpha.cos())
    };
    let (e1, e2) = (contact(r1), contact(r2));
    let lost = PI * (TEETH[0] + TEETH[1]) / (TEETH[0] * TEETH[1]);
    let lost = lost * (1.0 - e1 - e2 + e1 * e1 + e2 * e2);
    let line_load = 1e3 / (r1 * alpha.cos()) / WIDTH;
    let speed = 2.0 * omega() * 1e-3 * r1 * alpha.sin();
    let radius = r1 * r2 / (r1 + r2) * alpha.sin();
    let oil = OIL * 1e-3 * DENSITY;
    let friction = 0.048 * (line_load / (speed * radius)).powf(0.2) * oil.powf(-0.05);
    (watts / (omega() * friction * ROUGH.powf(0.25) * lost)).powf(1.2_f64.recip())
}

impl Element {
    /// The heat in W that leaves `from` and that enters `to`.
    pub(crate) fn heat(&self, celsius: &[f64]) -> [f64; 2] {
        let difference = celsius[self.from] - celsius[self.to];
        let x = match self.kind.is_property() {
            true => self.mean(celsius[self.from], celsius[self.to]),
            false => factor(&self.features, self.number(celsius)),
        };
        match self.kind {
            kind if kind.heats() => [0.0, self.loss(x)],
            kind if kind.is_stream() => [0.0, self.size * x * difference],
            Kind::Emissivity | Kind::Plates | Kind::ExchangeArea => {
                let [from, to] = [self.from, self.to].map(|v| (celsius[v] + ZERO).powi(4));
                [SIGMA * self.seen(x) * (from - to); 2]
            }
            _ => [self.conductance(x) * difference; 2],
        }
    }

    fn loss(&self, x: f64) -> f64 {
        match self.kind {
            Kind::BearingOil => self.size * x.powf(2.0 / 3.0),
            Kind::Mesh => self.size * x.powf(1.2),
            _ => self.size * x,
        }
    }

    fn conductance(&self, x: f64) -> f64 {
        match self.kind {
            Kind::Resistance | Kind::FilmResistance => self.size / x,
            Kind::Pressure => self.size * x.powf(0.95),
            Kind::CoolerCounter | Kind::CoolerParallel | Kind::CoolerOne | Kind::CoolerShell => {
                self.size * effectiveness(self.kind, x, OTHER.recip())
            }
            // 2 sizes over x sizes
            Kind::CoolerFlow => {
                self.size * x * effectiveness(Kind::CoolerCounter, 2.0 / x, x / FAR_MORE)
            }
            _ => self.size * x,
        }
    }

    /// Exchange area in m^2.
    fn seen(&self, x: f64) -> f64 {
        let area = self.size * exchange_area();
        let e = emissivity(&self.features) * x;
        match self.kind {
            Kind::Emissivity => e * area,
            Kind::Plates => area / (e.recip() + SECOND.recip() - 1.0),
            _ => area * x,
        }
    }

    /// The mean of a property between two temperatures in degC.
    fn mean(&self, from: f64, to: f64) -> f64 {
        if (from - to).abs() < 1e-9 {
            return factor(&self.features, 0.5 * (from + to));
        }
        let sum: f64 = self.features.iter().map(|feature| feature.integral(to, from)).sum();
        1.0 + sum / (from - to)
    }
}

/// Heat over the most that could flow, of so many transfer units and a ratio of capacity rates.
fn effectiveness(kind: Kind, units: f64, ratio: f64) -> f64 {
    match kind {
        Kind::CoolerParallel => -(-units * (1.0 + ratio)).exp_m1() / (1.0 + ratio),
        Kind::CoolerOne => -(-units).exp_m1(),
        Kind::CoolerShell => {
            let s = (1.0 + ratio * ratio).sqrt();
            let e = (-units * s).exp();
            2.0 / (1.0 + ratio + s * (1.0 + e) / (1.0 - e))
        }
        _ => {
            let e = (-units * (1.0 - ratio)).exp();
            (1.0 - e) / (1.0 - ratio * e)
        }
    }
}

impl Case {
    /// The heat in W that every vertex receives.
    pub(crate) fn heats(&self, celsius: &[f64], blows: bool) -> Vec<f64> {
        let mut heats = vec![0.0; celsius.len()];
        for element in &self.elements {
            let [leaves, enters] = element.heat(celsius);
            heats[element.from] -= leaves;
            heats[element.to] += enters;
        }
        if let Some(fan) = self.fan.as_ref().filter(|_| blows) {
            heats[fan.node] -= fan.more * (celsius[fan.node] - celsius[self.air()]);
        }
        heats
    }
}
