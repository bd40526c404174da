//! Proven bounds on errors against exact solutions.

#![allow(unused, 
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "helpers of tests; the measured figures, shown with --nocapture"
)]

use crate::common;

use common::{gearbox, nafems_t3, random, rc_ladder, stiff, two_masses};
use lptn_assembly::ThermalSystem;
use lptn_network::{Network, Time};
use lptn_solve::{ExactSolution, Transient};

/// Bound over error of every node and row, with the error of the exact solution added to the
/// bound.
fn ratios(network: &Network, tolerance: f64, stop: f64) -> Vec<f64> {
    let system = ThermalSystem::assemble(network).unwrap();
    let mut settings = Transient::until(Time(stop)).every(Time(stop / 20.0)).tolerance(tolerance);
    settings.certify = true;
    let solution = settings.solve(&system).unwrap();
    if let Some(Err(reason)) = solution.certificate() {
        println!("{reason}");
        return Vec::new();
    }
    let exact = ExactSolution::solve(network, 0.0, solution.times()).unwrap();
    let own = exact.own_error() + exact.quadrature_error().unwrap_or(0.0);
    let mut ratios = Vec::new();
    for id in network.node_ids() {
        let found = solution.temperature(id).unwrap();
        let bounds = solution.bounds(id).unwrap();
        assert_eq!(bounds.len(), found.len());
        for ((t, right), bound) in found.iter().zip(exact.temperature(id)).zip(bounds) {
            let error = (t - right).abs();
            if error > bound + own { println!("EXCEEDED {error:e} {bound:e} own {own:e}"); }
            if error > 10.0 * own.max(1e-12) {
                ratios.push(bound / error);
            }
        }
    }
    ratios.sort_by(f64::total_cmp);
    ratios
}


pub fn shown() {
    for (name, network, stop) in [("gearbox", gearbox(), 3600.0), ("ladder", rc_ladder(), 300.0), ("stiff", stiff(), 300.0), ("masses", two_masses(), 5.0), ("nafems", nafems_t3(), 32.0)] {
        for tolerance in [1e-3, 1e-5, 1e-7] {
            let r = ratios(&network, tolerance, stop);
            if r.is_empty() { println!("{name} {tolerance:e} none"); continue; }
            println!("{name} {tolerance:e}: least {:.2} median {:.2} 95% {:.2} most {:.1e} of {}", r[0], r[r.len() / 2], r[r.len() * 95 / 100], r[r.len() - 1], r.len());
        }
    }
    for tolerance in [1e-3, 1e-5, 1e-7] {
        let mut all: Vec<f64> = vec![0.0]; all.extend((0..200).flat_map(|seed| ratios(&random(seed), tolerance, 100.0)));
        all.sort_by(f64::total_cmp);
        println!("random {tolerance:e}: least {:.2} median {:.2} 95% {:.2} most {:.1e} of {}", all[0], all[all.len() / 2], all[all.len() * 95 / 100], all[all.len() - 1], all.len());
    }
}

const DECKS: &[(&str, &str)] = &[
("radiation", r#"
[default]
T0 = "20 degC"
[boundary]
air = { T = "20 degC" }
[node]
a = { C = "50 J/K" }
b = { C = "5 J/K" }
[resistor]
ab = { from = "a", to = "b", G = "0.5 W/K" }
ba = { from = "b", to = "air", G = "0.05 W/K" }
[radiation]
sky = { from = "a", to = "air", emissivity = 0.9, area = "0.05 m^2" }
s2 = { from = "a", to = "b", emissivity = 0.9, area = "0.01 m^2" }
[source]
p = { into = "a", P = "if(t < 500 [s], 40 [W], 10 [W])" }
"#),
("natural", r#"
[default]
T0 = "20 degC"
[boundary]
air = { T = "20 degC" }
[node]
a = { C = "50 J/K" }
b = { C = "20 J/K" }
[resistor]
ab = { from = "a", to = "b", G = "0.5 W/K" }
[convection]
film = { from = "b", to = "air", h = "1.4 [W/(m^2 K^1.25)] * abs(dT)^0.25", area = "0.1 m^2" }
[source]
p = { into = "a", P = "10 W" }
"#),
("k of T", r#"
[material]
x = { k = "20 [W/(m K)] * (1 + 0.002 [1/K] * (T - 20 [degC]))" }
y = { k = "148 [W/(m K)] * (300 [K] / kelvin(T))^1.3" }
[default]
T0 = "20 degC"
[boundary]
air = { T = "20 degC" }
[node]
a = { C = "50 J/K" }
b = { C = "20 J/K" }
c = { C = "20 J/K" }
[conduction]
ab = { from = "a", to = "b", shape = "slab", area = "1 cm^2", thickness = "1 cm", material = "x" }
bc = { from = "b", to = "c", shape = "slab", area = "1 cm^2", thickness = "1 cm", material = "y" }
[resistor]
out = { from = "c", to = "air", G = "0.3 W/K" }
[source]
p = { into = "a", P = "20 W" }
"#),
("thermistor", r#"
[default]
T0 = "25 degC"
[boundary]
air = { T = "25 degC" }
[node]
bead = { C = "20 mJ/K" }
[resistor]
leads = { from = "bead", to = "air", G = "2 mW/K" }
[source]
self = { into = "bead", P = "81 [V^2] * 0.2 / (1 [kohm] * exp(3950 [K] * (1 / kelvin(T) - 1 / 298.15 [K])))" }
"#),
("grow", r#"
[node]
body = { C = "100 J/K", T0 = "20 degC" }
[boundary]
air = { T = "20 degC" }
[resistor]
skin = { from = "body", to = "air", G = "1 W/K" }
[source]
leakage = { into = "body", P = "1 [W] + 1.02 [W/K] * (T - 20 [degC])" }
"#),
("stream", r#"
[default]
T0 = "20 degC"
[boundary]
inlet = { T = "20 degC" }
[node]
w1 = { C = "50 J/K" }
w2 = { C = "50 J/K" }
plate = { C = "200 J/K" }
[advection]
s0 = { from = "inlet", to = "w1", mcp = "(2 [W/K] + 1 [W/K] * sin(t / 50 [s]))" }
s1 = { from = "w1", to = "w2", mcp = "(2 [W/K] + 1 [W/K] * sin(t / 50 [s]))" }
[resistor]
p1 = { from = "plate", to = "w1", G = "1 W/K" }
p2 = { from = "plate", to = "w2", G = "1 W/K" }
[source]
p = { into = "plate", P = "20 W" }
"#),
("pi", r#"
[default]
T0 = "20 degC"
[boundary]
air = { T = "20 degC" }
[node]
a = { C = "50 J/K" }
[resistor]
out = { from = "a", to = "air", G = "0.3 W/K" }
[state]
integral = { rate = "60 [degC] - a.T", start = "0 K*s", size = "1000 K*s" }
[source]
p = { into = "a", P = "1 [W/K] * (60 [degC] - a.T) + 0.01 [W/(K s)] * integral" }
"#),
("copper", r#"
[default]
T0 = "20 degC"
[boundary]
air = { T = "20 degC" }
[node]
a = { C = "50 J/K" }
b = { C = "50 J/K" }
[resistor]
out = { from = "a", to = "b", G = "0.3 W/K" }
o2 = { from = "b", to = "air", G = "0.3 [W/K] * (1 + 0.01 [1/K] * (a.T - 20 [degC]))" }
[source]
p = { into = "a", P = "10 [W] * (1 + 0.00393 [1/K] * (T - 20 [degC])) * (1 - 0.001 [1/K] * (b.T - 20 [degC]))" }
"#),
];

pub fn nonlinear() {
    for (name, text) in DECKS {
        let net = lptn_netlist::parse("net.toml", &format!("format = 1\n{text}")).unwrap_or_else(|e| panic!("{e}")).network;
        let system = ThermalSystem::assemble(&net).unwrap();
        let run = |tolerance: f64, certify: bool| {
            let mut settings = Transient::until(Time(1000.0)).every(Time(20.0)).tolerance(tolerance);
            settings.certify = certify;
            let begin = std::time::Instant::now();
            let solution = settings.solve(&system).unwrap();
            if certify { println!("   {tolerance:e} {:?} steps {} {:?}", solution.method(), solution.statistics().steps, begin.elapsed()); }
            solution
        };
        let fine = run(1e-9, true);
        for tolerance in [1e-3, 1e-5, 1e-7] {
            let plain = std::time::Instant::now();
            run(tolerance, false);
            let plain = plain.elapsed();
            let found = run(tolerance, true);
            if let Some(Err(reason)) = found.certificate() { println!("{name} {tolerance:e}: {reason}"); continue; }
            let mut ratios = Vec::new();
            let mut most: f64 = 0.0;
            for id in net.node_ids() {
                let own = fine.bounds(id).unwrap_or(vec![1e-9; 1000]);
                for (((a, b), bound), own) in found.temperature(id).unwrap().iter().zip(fine.temperature(id).unwrap()).zip(found.bounds(id).unwrap()).zip(own) {
                    let error = (a - b).abs();
                    most = most.max(bound);
                    if error > bound + own { println!("EXCEEDED {name} {error:e} {bound:e} {own:e}"); }
                    if error > 10.0 * own.max(1e-12) { ratios.push(bound / error); }
                }
            }
            ratios.sort_by(f64::total_cmp);
            let r = ratios;
            if r.is_empty() { println!("{name} {tolerance:e}: none larger than own; bound up to {most:e}"); continue; }
            println!("{name} {tolerance:e}: least {:.2} median {:.2} 95% {:.2} most {:.1e} of {}; bound up to {most:.1e}; plain {plain:?}", r[0], r[r.len() / 2], r[r.len() * 95 / 100], r[r.len() - 1], r.len());
        }
    }
}
