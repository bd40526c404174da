//! Proven bounds on errors: against exact solutions of linear networks, and against Runge-Kutta's
//! method on random nonlinear ones that are written out twice.

#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "helpers of tests; the measured figures, shown with --nocapture"
)]

use std::fmt::Write as _;

use crate::common;

use common::{gearbox, nafems_t3, random, rc_ladder, stiff, two_masses};
use lptn_assembly::ThermalSystem;
use lptn_network::{Network, Time};
use lptn_solve::{ExactSolution, Solution, SteadyState, Transient};

/// `LPTN_CERTIFIED` asks for more networks than the usual ones.
pub fn count(usual: u64) -> u64 {
    std::env::var("LPTN_CERTIFIED").map_or(usual, |text| text.parse().unwrap())
}

fn certified(network: &Network, tolerance: f64, stop: f64) -> Solution {
    let system = ThermalSystem::assemble(network).unwrap();
    let settings = Transient::until(Time(stop)).every(Time(stop / 20.0)).tolerance(tolerance);
    Transient { certify: true, ..settings }.solve(&system).unwrap()
}

/// Checks the bounds against right temperatures with an error of their own in K, and collects bound
/// over error, if the error can be told from that of the right temperatures.
pub fn check(
    found: &Solution,
    right: &dyn Fn(usize, usize) -> f64,
    own: &dyn Fn(usize) -> f64,
    ratios: &mut Vec<f64>,
) {
    let reason = found.certificate().unwrap().as_ref().err();
    assert!(reason.is_none(), "{}", reason.unwrap());
    for (node, id) in found.network().node_ids().enumerate() {
        let (values, bounds) = (found.temperature(id).unwrap(), found.bounds(id).unwrap());
        assert_eq!(bounds.len(), values.len());
        let (most, own) = (found.largest_bound(id).unwrap(), own(node));
        for (row, (value, bound)) in values.iter().zip(&bounds).enumerate() {
            let error = (value - right(row, node)).abs();
            assert!(error <= bound + own, "node {node}, row {row}: {error:e} K, bound {bound:e}");
            assert!(*bound <= most * (1.0 + 1e-9) + 1e-12, "{bound:e} {most:e}");
            if error > 10.0 * own.max(1e-12) {
                ratios.push(bound / error);
            }
        }
    }
}

/// Median and 95th percentile.
pub fn spread(ratios: &mut [f64]) -> (f64, f64) {
    ratios.sort_by(f64::total_cmp);
    (ratios[ratios.len() / 2], ratios[ratios.len() * 95 / 100])
}

fn check_exactly(network: &Network, tolerance: f64, stop: f64, ratios: &mut Vec<f64>) {
    let found = certified(network, tolerance, stop);
    let exact = ExactSolution::solve(network, 0.0, found.times()).unwrap();
    let states = exact.own_error() + exact.quadrature_error().unwrap_or(0.0) + 1e-12;
    // massless nodes come from a dense matrix of conductances over five decades
    let own = |node: usize| states + if network.nodes()[node].massless { 5e-11 } else { 0.0 };
    check(&found, &|row, node| exact.row(row)[node], &own, ratios);
}

#[test]
fn linear_networks_stay_within_their_bounds() {
    let fixed = [
        (gearbox(), 3600.0),
        (rc_ladder(), 300.0),
        (stiff(), 300.0),
        (two_masses(), 5.0),
        (nafems_t3(), 32.0),
    ];
    for tolerance in [1e-3, 1e-5, 1e-7] {
        let mut ratios = Vec::new();
        for (network, stop) in &fixed {
            check_exactly(network, tolerance, *stop, &mut ratios);
        }
        (0..count(20)).for_each(|seed| check_exactly(&random(seed), tolerance, 100.0, &mut ratios));
        let (median, most) = spread(&mut ratios);
        println!("linear, {tolerance:e} K: bound over error {median:.2}, 95 % below {most:.1}");
        assert!(median < 5.0 && most < 30.0, "{median} {most}");
    }
}

/// A path from a node to another one, or to air of 20 degC.
struct Link {
    from: usize,
    to: Option<usize>,
    law: Law,
}

#[derive(Clone, Copy)]
enum Law {
    /// Conductance in W/K.
    Constant(f64),
    /// Exchange area in m^2.
    Radiation(f64),
    /// `q = g |dT|^n dT`.
    Film { g: f64, n: f64 },
    /// A slab of 1 m^2 and 1 m with `k = k0 (1 + b (T - 20 degC))`.
    Slab { k0: f64, b: f64 },
    /// A stream in W/K.
    Stream(f64),
}

/// A random network: capacities in J/K, paths, and for each node a heat in W and its change with
/// the temperature of a node in W/K.
pub struct Written {
    pub capacities: Vec<f64>,
    links: Vec<Link>,
    pub heats: Vec<(f64, f64, usize)>,
}

pub const AIR: f64 = 293.15;
const SIGMA: f64 = 5.670_374_419e-8;

impl Written {
    pub fn new(seed: u64) -> Self {
        // the generator of Knuth's MMIX (The Art of Computer Programming 2, 3.3.4)
        let mut state = seed.wrapping_add(17);
        let mut next = move |from: f64, to: f64| {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            from + (to - from) * (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        let nodes = 1 + next(0.0, 5.0) as usize;
        let capacities = (0..nodes).map(|_| 10f64.powf(next(1.0, 2.5))).collect();
        let law = |next: &mut dyn FnMut(f64, f64) -> f64| match next(0.0, 5.0) as usize {
            0 => Law::Constant(next(0.1, 2.0)),
            1 => Law::Radiation(next(0.005, 0.1)),
            2 => Law::Film { g: next(0.05, 0.4), n: next(0.1, 0.6) },
            3 => Law::Slab { k0: next(0.1, 1.0), b: next(-1e-3, 4e-3) },
            _ => Law::Stream(next(0.1, 1.0)),
        };
        let mut links = Vec::new();
        for from in 0..nodes {
            let to = (from > 0).then(|| next(0.0, from as f64) as usize);
            links.push(Link { from, to, law: law(&mut next) });
            let to = Some(next(0.0, nodes as f64) as usize).filter(|to| *to != from);
            links.push(Link { from, to, law: law(&mut next) });
        }
        let heats = (0..nodes)
            .map(|_| (next(0.0, 20.0), next(-0.05, 0.03), next(0.0, nodes as f64) as usize))
            .collect();
        Self { capacities, links, heats }
    }

    pub fn text(&self) -> String {
        let mut text = String::from("format = 1\n[boundary]\nair = { T = \"20 degC\" }\n[node]\n");
        let end = |to: Option<usize>| to.map_or("air".to_owned(), |to| format!("n{to}"));
        for (i, c) in self.capacities.iter().enumerate() {
            writeln!(text, "n{i} = {{ C = \"{c} J/K\", T0 = \"20 degC\" }}").unwrap();
        }
        for (i, link) in self.links.iter().enumerate() {
            let (from, to) = (format!("n{}", link.from), end(link.to));
            let (section, law) = match link.law {
                Law::Constant(g) => ("resistor", format!("G = \"{g} W/K\"")),
                Law::Radiation(area) => ("radiation", format!("Gr = \"{area} m^2\"")),
                Law::Film { g, n } => (
                    "convection",
                    format!("area = \"1 m^2\", h = \"{g} [W/(m^2 K)] * abs(dT / 1 [K])^{n}\""),
                ),
                Law::Slab { k0, b } => (
                    "conduction",
                    format!(
                        "shape = \"slab\", area = \"1 m^2\", thickness = \"1 m\", \
                         k = \"{k0} [W/(m K)] * (1 + {b} [1/K] * (T_mean - 20 [degC]))\""
                    ),
                ),
                Law::Stream(mcp) => ("advection", format!("mcp = \"{mcp} W/K\"")),
            };
            writeln!(text, "[{section}.p{i}]\nfrom = \"{from}\"\nto = \"{to}\"").unwrap();
            law.split(", ").for_each(|key| writeln!(text, "{key}").unwrap());
        }
        for (i, (heat, slope, of)) in self.heats.iter().enumerate() {
            writeln!(
                text,
                "[source.q{i}]\ninto = \"n{i}\"\n\
                 P = \"{heat} [W] + {slope} [W/K] * (n{of}.T - 20 [degC])\""
            )
            .unwrap();
        }
        text
    }

    /// Change of each temperature in K/s.
    pub fn slopes(&self, t: &[f64]) -> Vec<f64> {
        let mut heat: Vec<f64> =
            self.heats.iter().map(|(heat, slope, of)| heat + slope * (t[*of] - AIR)).collect();
        for link in &self.links {
            let (a, b) = (t[link.from], link.to.map_or(AIR, |to| t[to]));
            let q = match link.law {
                Law::Constant(g) => g * (a - b),
                Law::Radiation(area) => SIGMA * area * (a.powi(4) - b.powi(4)),
                Law::Film { g, n } => g * (a - b).abs().powf(n) * (a - b),
                Law::Slab { k0, b: c } => k0 * (1.0 + c * (0.5 * (a + b) - AIR)) * (a - b),
                // the first end gives what it has; only the second one changes
                Law::Stream(mcp) => mcp * (a - b),
            };
            if !matches!(link.law, Law::Stream(_)) {
                heat[link.from] -= q;
            }
            if let Some(to) = link.to {
                heat[to] += q;
            }
        }
        heat.iter().zip(&self.capacities).map(|(q, c)| q / c).collect()
    }

    /// The temperatures in K near these at which nothing changes.
    fn rest(&self, near: &[f64]) -> Vec<f64> {
        let mut t = near.to_vec();
        for _ in 0..20 {
            let now = self.slopes(&t);
            let mut rows: Vec<Vec<f64>> = vec![Vec::new(); t.len()];
            for j in 0..t.len() {
                let mut moved = t.clone();
                moved[j] += 1e-3;
                let slopes = self.slopes(&moved);
                (0..t.len()).for_each(|i| rows[i].push((slopes[i] - now[i]) / 1e-3));
            }
            let step = solved(rows, now.iter().map(|slope| -slope).collect());
            t.iter_mut().zip(step).for_each(|(t, step)| *t += step);
        }
        t
    }

    /// Temperatures at twenty equal times after the start in K, by Runge-Kutta's method in steps
    /// of `step` s.
    fn run(&self, stop: f64, steps: usize) -> Vec<Vec<f64>> {
        let step = stop / steps as f64;
        let mut t = vec![AIR; self.capacities.len()];
        let mut rows = vec![t.clone()];
        for i in 1..=steps {
            let along = |k: &[f64], by: f64| -> Vec<f64> {
                t.iter().zip(k).map(|(t, k)| t + by * k).collect()
            };
            let k1 = self.slopes(&t);
            let k2 = self.slopes(&along(&k1, 0.5 * step));
            let k3 = self.slopes(&along(&k2, 0.5 * step));
            let k4 = self.slopes(&along(&k3, step));
            for (j, t) in t.iter_mut().enumerate() {
                *t += step / 6.0 * (k1[j] + 2.0 * (k2[j] + k3[j]) + k4[j]);
            }
            if i % (steps / 20) == 0 {
                rows.push(t.clone());
            }
        }
        rows
    }
}

/// Gauss's elimination with pivots.
pub fn solved(mut a: Vec<Vec<f64>>, mut b: Vec<f64>) -> Vec<f64> {
    let n = b.len();
    for k in 0..n {
        let pivot = (k..n).max_by(|i, j| a[*i][k].abs().total_cmp(&a[*j][k].abs())).unwrap();
        a.swap(k, pivot);
        b.swap(k, pivot);
        for i in k + 1..n {
            let factor = a[i][k] / a[k][k];
            let row = a[k].clone();
            a[i].iter_mut().zip(row).for_each(|(x, y)| *x -= factor * y);
            b[i] -= factor * b[k];
        }
    }
    for k in (0..n).rev() {
        let known: f64 = (k + 1..n).map(|j| a[k][j] * b[j]).sum();
        b[k] = (b[k] - known) / a[k][k];
    }
    b
}

#[test]
fn nonlinear_networks_stay_within_their_bounds() {
    const STOP: f64 = 200.0;
    let mut all = [1e-3, 1e-5, 1e-7].map(|tolerance| (tolerance, Vec::new()));
    for seed in 0..count(20) {
        let written = Written::new(seed);
        let network = lptn_netlist::parse("net.toml", &written.text());
        let network = network.unwrap_or_else(|e| panic!("{e}\n{}", written.text())).network;
        let (rough, fine) = (written.run(STOP, 2000), written.run(STOP, 4000));
        // the method errs by a fifteenth of this; a film that begins at dT = 0 by more
        let pairs = rough.iter().flatten().zip(fine.iter().flatten());
        let own = pairs.map(|(a, b)| (a - b).abs()).fold(1e-11, f64::max);
        for (tolerance, ratios) in &mut all {
            let found = certified(&network, *tolerance, STOP);
            check(&found, &|row, node| fine[row][node], &|_| own, ratios);
        }
    }
    for (tolerance, mut ratios) in all {
        let (median, most) = spread(&mut ratios);
        println!("nonlinear, {tolerance:e} K: bound over error {median:.2}, 95 % below {most:.1}");
        assert!(median < 10.0 && most < 100.0, "{median} {most}");
    }
}

/// Newton's method on the network that is written out, with differences as slopes, against the
/// bounds of `steady`: it ends at the rounding of the heats.
#[test]
fn steady_states_stay_within_their_bounds() {
    let mut proven = 0;
    for seed in 0..count(20) {
        let written = Written::new(seed);
        let network = lptn_netlist::parse("net.toml", &written.text()).unwrap().network;
        let system = ThermalSystem::assemble(&network).unwrap();
        // some heats grow faster with temperature than they are removed
        let Ok(steady) = SteadyState::solve(&system, 0.0) else { continue };
        let Ok(bounds) = steady.proven_errors(&system) else { continue };
        proven += 1;
        let right = written.rest(&steady.temperatures);
        for ((found, right), bound) in steady.temperatures.iter().zip(&right).zip(&bounds) {
            let error = (found - right).abs();
            assert!(error <= bound + 2e-12, "seed {seed}: {error:e} K, bound {bound:e}");
            // wide only if the network hardly comes back to its state: 3.7e-5 K for seed 46
            assert!(*bound < 1e-3, "seed {seed}: {bound:e}");
        }
        // a state beside it lies outside of its own bounds, or has none
        let mut beside = steady.state.clone();
        beside.temperatures[0] += 1e-3;
        if let Ok(wider) = beside.proven_errors(&system) {
            assert!(wider[0] >= 1e-3 - 1e-9, "seed {seed}: {:e}", wider[0]);
        }
    }
    println!("{proven} steady states of {} are proven", count(20));
    assert!(proven * 10 >= count(20) * 8, "{proven}");
}

/// `shared/findings`: heat that grows by e^5 in 500 s, whose error was 404 tolerances without a
/// word.
#[test]
fn errors_that_grow_are_within_their_bounds() {
    let text = "format = 1\n[node]\nbody = { C = \"100 J/K\", T0 = \"20 degC\" }\n\
        [boundary]\nair = { T = \"20 degC\" }\n\
        [resistor]\nskin = { from = \"body\", to = \"air\", G = \"1 W/K\" }\n\
        [source]\nheat = { into = \"body\", P = \"1 [W] + 2 [W/K] * (T - 20 [degC])\" }\n";
    let network = lptn_netlist::parse("grow.toml", text).unwrap().network;
    for tolerance in [1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8] {
        let found = certified(&network, tolerance, 500.0);
        let times = found.times().to_vec();
        let right = |row: usize, _| AIR + (times[row] / 100.0).exp_m1();
        check(&found, &right, &|_| 1e-12, &mut Vec::new());
    }
}

#[test]
fn networks_that_are_not_covered_say_so() {
    let about = |rest: &str| {
        let text = format!(
            "format = 1\n[boundary]\nair = {{ T = \"20 degC\" }}\n\
             [resistor]\nskin = {{ from = \"body\", to = \"air\", G = \"1 W/K\" }}\n{rest}"
        );
        let network = lptn_netlist::parse("net.toml", &text).unwrap_or_else(|e| panic!("{e}"));
        let found = certified(&network.network, 1e-5, 100.0);
        let reason = found.certificate().unwrap().as_ref().unwrap_err().clone();
        assert!(found.bounds(network.network.node("body").unwrap()).is_none());
        (reason.code(), reason.to_string())
    };
    let body = "[node]\nbody = { C = \"100 J/K\", T0 = \"20 degC\" }\n";
    let (code, text) = about(&format!(
        "{body}[source]\nheater = {{ into = \"body\", \
         P = \"if(body.T < 25 [degC], 5 [W], 0 [W])\" }}\n"
    ));
    assert_eq!(code, "certify::switches");
    assert!(text.contains("`heater` compares temperatures"), "{text}");
    let (code, text) = about(
        "[node]\nbody = { C = \"1 [J/K] + 1 [J/K^2] * (T - 0 [degC])\", T0 = \"20 degC\" }\n",
    );
    assert_eq!(code, "certify::node");
    assert!(text.contains("`body` has a capacity that changes"), "{text}");
}
