//! Enclosures of grey surfaces against the radiosity equations, solved here as a dense system, and
//! against closed forms.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::support;

use faer::Mat;
use faer::linalg::solvers::Solve;
use lptn::prelude::*;
use support::{Numbers, celsius, close, heat, parsed, settled, transient};

const SIGMA: f64 = 5.670_374_419e-8;

/// Surfaces at given temperatures, with symmetric A F, so that the rows sum to 1.
struct Case {
    kelvin: Vec<f64>,
    emissivity: Vec<f64>,
    exchange: Vec<Vec<f64>>,
}

impl Case {
    fn random(count: usize, random: &mut Numbers) -> Self {
        let all: Vec<f64> = (0..count * count).map(|_| random.between(0.01, 1.01)).collect();
        let row = |i: usize| (0..count).map(|j| all[i.min(j) * count + i.max(j)]).collect();
        let exchange = (0..count).map(row).collect();
        let kelvin = (0..count).map(|_| random.between(250.0, 850.0)).collect();
        // every fourth surface is black
        let emissivity = |i| if i % 4 == 3 { 1.0 } else { random.between(0.05, 0.95) };
        Self { kelvin, emissivity: (0..count).map(emissivity).collect(), exchange }
    }

    fn area(&self, i: usize) -> f64 {
        self.exchange[i].iter().sum()
    }

    fn text(&self) -> String {
        let count = self.kelvin.len();
        let mut text =
            "format = 1\n[node]\nfree = { T0 = \"20 degC\", C = \"1 J/K\" }\n[boundary]\n"
                .to_owned();
        for (i, kelvin) in self.kelvin.iter().enumerate() {
            text += &format!("s{i} = {{ T = \"{kelvin} K\" }}\n");
        }
        text += "[resistor]\nr = { from = \"free\", to = \"s0\", R = \"1 K/W\" }\n[enclosure.box.surfaces]\n";
        for i in 0..count {
            let (area, emissivity) = (self.area(i), self.emissivity[i]);
            text += &format!("s{i} = {{ area = \"{area} m^2\", emissivity = {emissivity:?} }}\n");
        }
        text += "[enclosure.box]\nview_factors = [";
        for i in 0..count {
            for j in i..count {
                text += &format!("[\"s{i}\", \"s{j}\", {}], ", self.exchange[i][j] / self.area(i));
            }
        }
        text + "]\n"
    }

    /// Net heat of each surface: q_i = sum of A_i F_ij (J_i - J_j), with the radiosities of
    /// J_i - (1 - e_i) sum of F_ij J_j = e_i sigma T_i^4 (Siegel and Howell, net-radiation method).
    fn net(&self) -> Vec<f64> {
        let count = self.kelvin.len();
        let factor = |i: usize, j: usize| self.exchange[i][j] / self.area(i);
        let matrix = Mat::from_fn(count, count, |i, j| {
            f64::from(u8::from(i == j)) - (1.0 - self.emissivity[i]) * factor(i, j)
        });
        let right =
            Mat::from_fn(count, 1, |i, _| self.emissivity[i] * SIGMA * self.kelvin[i].powi(4));
        let j = matrix.partial_piv_lu().solve(&right);
        let net =
            |i: usize| (0..count).map(|k| self.exchange[i][k] * (j[(i, 0)] - j[(k, 0)])).sum();
        (0..count).map(net).collect()
    }
}

#[test]
fn random_enclosures_obey_the_radiosity_equations() {
    let mut random = Numbers(20_261_127);
    for count in [2, 3, 4, 5, 8, 12] {
        for _ in 0..10 {
            let case = Case::random(count, &mut random);
            let (netlist, steady) = settled(&case.text());
            let scale = case.net().iter().fold(0.0_f64, |a, b| a.max(b.abs()));
            for (i, exact) in case.net().into_iter().enumerate() {
                if case.emissivity[i] < 1.0 {
                    close(heat(&netlist, &steady, &format!("box.s{i}")), exact, 1e-7 * scale);
                }
            }
            // a boundary gives what its surface loses
            let ids = netlist.network.boundary_ids().zip(case.net());
            for (id, exact) in ids.skip(1) {
                close(steady.boundary_heat[id.index()], exact, 1e-7 * scale);
            }
        }
    }
}

/// A rod in a furnace: q = A sigma (T_2^4 - T_1^4) / (1/e_1 + (A_1/A_2)(1/e_2 - 1)) (Incropera,
/// 6th edition, table 13.3, concentric), 5 kg of steel that warm up, and an emissivity as parameter.
const ROD: &str = r#"
format = 1
[param]
e = 0.8
[node]
rod = { C = "2.3 kJ/K", T0 = "20 degC" }
[boundary]
furnace = { T = "900 degC" }
[enclosure.gap]
surfaces = { rod = { area = "0.1 m^2", emissivity = "e" }, furnace = { area = "0.4 m^2", emissivity = "50 %" } }
view_factors = [["rod", "furnace", 1], ["furnace", "furnace", 0.75]]
[run]
stop = "5 min"
"#;

#[test]
fn two_grey_surfaces_are_the_closed_form() {
    let (mut netlist, _) = parsed(ROD);
    // `rank` and others change one field of a path: none may be an emissivity beside its area
    assert!(!netlist.expanded().contains("emissivity"));
    for e in [0.8, 0.3] {
        netlist.set(&[format!("e={e}")]).unwrap();
        let system = ThermalSystem::assemble(&netlist.network).unwrap();
        let run = transient(&netlist).tolerance(1e-7).solve(&system).unwrap();
        assert!(run.ledger().closes());
        let last = *run.temperature(netlist.network.node("rod").unwrap()).unwrap().last().unwrap();
        // t = C / (4 sigma Gr E^3) (ln((E + T)(E - T0) / ((E - T)(E + T0))) + 2 atan T/E - 2 atan T0/E)
        let exchange = 0.1 / (1.0 / e + 0.25 * (1.0 / 0.5 - 1.0));
        let (hot, cold) = (1173.15_f64, 293.15_f64);
        let time = |kelvin: f64| {
            let log = ((hot + kelvin) * (hot - cold) / ((hot - kelvin) * (hot + cold))).ln();
            let angle = 2.0 * ((kelvin / hot).atan() - (cold / hot).atan());
            2300.0 / (4.0 * SIGMA * exchange * hot.powi(3)) * (log + angle)
        };
        close(time(last), 300.0, 1e-4);
    }
}

/// Incropera, 6th edition, example 13.4 in its kind: a long duct of a hot plate, a cold plate and an
/// insulated wall. The wall takes and gives nothing, so that
/// q = A sigma (T_1^4 - T_2^4) / ((1 - e)/e + 1/(F_12 + 1/(1/F_1R + 1/F_2R)) + (1 - e)/e).
#[test]
fn a_surface_that_reradiates() {
    let (netlist, steady) = settled(
        r#"
format = 1
[node]
wall = { C = "100 J/K", T0 = "300 degC" }
[boundary]
hot = { T = "1200 K" }
cold = { T = "500 K" }
[enclosure.duct]
surfaces = { hot = { area = "1 m^2", emissivity = 0.8 }, cold = { area = "1 m^2", emissivity = 0.4 }, wall = { area = "1 m^2", emissivity = 0.8 } }
view_factors = [["hot", "cold", 0.5], ["hot", "wall", 0.5], ["cold", "wall", 0.5]]
"#,
    );
    let through = 1.0 / (0.5 + 1.0 / (1.0 / 0.5 + 1.0 / 0.5));
    let resistance = (1.0 - 0.8) / 0.8 + through + (1.0 - 0.4) / 0.4;
    let exact = SIGMA * (1200.0_f64.powi(4) - 500.0_f64.powi(4)) / resistance;
    close(heat(&netlist, &steady, "duct.hot"), exact, 1e-6 * exact);
    close(heat(&netlist, &steady, "duct.cold"), -exact, 1e-6 * exact);
    close(heat(&netlist, &steady, "duct.wall"), 0.0, 1e-6 * exact);
    // the radiosities of both plates meet at the wall in equal parts
    let (j1, j2) =
        (SIGMA * 1200.0_f64.powi(4) - exact * 0.25, SIGMA * 500.0_f64.powi(4) + exact * 1.5);
    let kelvin = ((j1 + j2) / 2.0 / SIGMA).powf(0.25);
    close(celsius(&netlist, &steady, "wall"), kelvin - 273.15, 1e-6);
}

/// Each use of a template has an enclosure of its own.
#[test]
fn an_enclosure_in_a_template() {
    let (netlist, steady) = settled(
        r#"
format = 1
[boundary]
space = { T = "3 K" }
[template.box]
port = ["out"]
param = { e = 0.7 }
[template.box.node]
card = { C = "50 J/K", T0 = "20 degC" }
[template.box.source]
loss = { into = "card", P = "20 W" }
[template.box.enclosure.inside]
surfaces = { card = { area = "0.1 m^2", emissivity = "e" }, out = { area = "0.1 m^2", emissivity = 1 } }
view_factors = [["card", "out", 1]]
[use.box]
template = "box"
count = 2
set = { e = [0.7, 0.35] }
connect = { out = "space" }
"#,
    );
    for (name, e) in [("box[1]", 0.7), ("box[2]", 0.35)] {
        let kelvin = (20.0 / (SIGMA * e * 0.1) + 81.0_f64).powf(0.25);
        close(celsius(&netlist, &steady, &format!("{name}.card")), kelvin - 273.15, 1e-6);
    }
}
