//! Networks with known answers, and exact solutions by code that shares nothing with the library's
//! solvers.
#![allow(dead_code, unreachable_pub, reason = "each test file uses a part")]

use faer::{Mat, Side};
use lptn::prelude::*;
use lptn_network::{Item, Network, NodeId};

/// The folder of the shipped networks.
pub fn networks() -> std::path::PathBuf {
    std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("networks")
}

/// A shipped network, assembled.
pub fn shipped(name: &str) -> (lptn_netlist::Netlist, ThermalSystem) {
    let netlist = lptn::read(&networks().join(name)).unwrap_or_else(|e| panic!("{name}: {e}"));
    let system = ThermalSystem::assemble(&netlist.network).expect("it assembles");
    (netlist, system)
}

/// The run that a netlist asks for.
pub fn transient(netlist: &lptn_netlist::Netlist) -> Transient {
    let run = netlist.run.as_ref().expect("the network has [run]");
    let mut transient = Transient::until(Time(run.stop)).tolerance(run.tolerance);
    transient.start = run.start;
    transient.output = run.output.clone();
    transient
}

/// A netlist that has to parse, assembled.
pub fn parsed(text: &str) -> (lptn_netlist::Netlist, ThermalSystem) {
    let netlist = lptn::parse("netlist", text).unwrap_or_else(|rejected| panic!("{rejected}"));
    let system = ThermalSystem::assemble(&netlist.network).expect("it assembles");
    (netlist, system)
}

/// A netlist with its steady state.
pub fn settled(text: &str) -> (lptn_netlist::Netlist, SteadyState) {
    let (netlist, system) = parsed(text);
    let steady = SteadyState::solve(&system, 0.0).expect("it settles");
    (netlist, steady)
}

/// The temperature of a node, or of a grid as a whole, a face or a patch, in degC.
pub fn celsius(netlist: &lptn_netlist::Netlist, steady: &SteadyState, name: &str) -> f64 {
    if let Ok(node) = netlist.network.node(name) {
        return steady.temperatures[node.index()] - 273.15;
    }
    let mut values = netlist.network.grid_values().chain(netlist.network.idle_grid_values());
    let value = values.find(|value| value.name(&netlist.network) == name).unwrap();
    netlist.network.grid_value(value, &steady.temperatures) - 273.15
}

/// The heat through a path, or all paths of a face, in W.
pub fn heat(netlist: &lptn_netlist::Netlist, steady: &SteadyState, name: &str) -> f64 {
    match netlist.network.item(name).unwrap() {
        Item::Conductor(id) => steady.conductor_heat[id.index()],
        Item::FacePath(id) => netlist.network.face_paths()[id.index()]
            .conductors()
            .map(|c| steady.conductor_heat[c.index()])
            .sum(),
        other => panic!("{name} is {other:?}"),
    }
}

/// The values of a table's column by its name.
pub fn column(table: &Table, name: &str) -> Vec<f64> {
    let found = table.columns().iter().find(|column| column.name == name);
    found.unwrap_or_else(|| panic!("no column {name}")).values.clone()
}

pub fn close(found: f64, exact: f64, within: f64) {
    assert!((found - exact).abs() <= within, "{found} is not {exact} within {within:e}");
}

/// The largest difference of two equally long lists.
pub fn distance(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// Numbers that look random: the same on every machine (D. E. Knuth, MMIX).
pub struct Numbers(pub u64);

impl Numbers {
    /// A number from `low` to `high`.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        low + (high - low) * ((self.0 >> 11) as f64 / (1_u64 << 53) as f64)
    }
}

/// `idle` nodes beside the gearbox that nothing ever happens to.
pub fn gearbox_with_idle(idle: usize) -> (ThermalSystem, NodeId, NodeId) {
    let ambient = Temperature::celsius(25.5);
    let mut b = NetworkBuilder::new();
    let steel = b.node("steel", HeatCapacity(1235.0), ambient);
    let aluminium = b.node("aluminium", HeatCapacity(1424.0), ambient);
    let bed = b.boundary("bed", ambient);
    b.resistor("internal", steel, aluminium, Conductance(220.6 / 1.7));
    b.resistor("outer", aluminium, bed, Conductance(220.6 / 65.5));
    b.source("P_disp", steel, HeatFlow(220.6));
    for i in 0..idle {
        let node = b.node(&format!("idle{i}"), HeatCapacity(100.0), ambient);
        b.resistor(&format!("idle_path{i}"), node, bed, Conductance(1.0));
    }
    (assembled(b), steel, aluminium)
}

/// The rise of both gearbox nodes over ambient at `t` by the eigenvectors of the 2 x 2 system,
/// written out.
pub fn gearbox_rise(t: f64) -> [f64; 2] {
    let (c_s, c_a, g_i, g_o, p) = (1235.0, 1424.0, 220.6 / 1.7, 220.6 / 65.5, 220.6);
    let (a, b, d) = (g_i / c_s, -g_i / f64::sqrt(c_s * c_a), (g_i + g_o) / c_a);
    let (mean, half) = (0.5 * (a + d), f64::hypot(0.5 * (a - d), b));
    let mut rise = [0.0; 2];
    for rate in [mean + half, (a * d - b * b) / (mean + half)] {
        let (x, y) = (b, rate - a); // eigenvector of the symmetric form
        let scale = p / f64::sqrt(c_s) * x / (x * x + y * y) * -f64::exp_m1(-rate * t) / rate;
        rise[0] += scale * x / c_s.sqrt();
        rise[1] += scale * y / c_a.sqrt();
    }
    rise
}

pub fn assembled(builder: NetworkBuilder) -> ThermalSystem {
    ThermalSystem::assemble(&builder.build().expect("a sound network")).expect("it assembles")
}

/// A symmetric system `C dT/dt = q0 + q1 sin(w t) - G T` in its modes, from matrices that the
/// caller fills.
pub struct Modal {
    root: Vec<f64>,
    rates: Vec<f64>,
    vectors: Mat<f64>,
}

impl Modal {
    pub fn new(capacity: &[f64], g: &Mat<f64>) -> Self {
        let root: Vec<f64> = capacity.iter().map(|c| c.sqrt()).collect();
        let n = root.len();
        let scaled = Mat::from_fn(n, n, |i, j| g[(i, j)] / (root[i] * root[j]));
        let eigen =
            scaled.self_adjoint_eigen(Side::Lower).expect("a symmetric matrix has real modes");
        let rates = (0..n).map(|k| eigen.S().column_vector()[k]).collect();
        Self { root, rates, vectors: eigen.U().to_owned() }
    }

    /// Temperatures at `t` from rest at 0 with constant heat `q0` and a sine `q1 sin(w t)`.
    pub fn at(&self, t: f64, q0: &[f64], q1: &[f64], w: f64) -> Vec<f64> {
        let n = self.root.len();
        let mut temperature = vec![0.0; n];
        for k in 0..n {
            let rate = self.rates[k];
            let project = |q: &[f64]| -> f64 {
                (0..n).map(|i| self.vectors[(i, k)] * q[i] / self.root[i]).sum()
            };
            let decay = (-rate * t).exp();
            let constant = project(q0) * -f64::exp_m1(-rate * t) / rate;
            let sine = project(q1) * (rate * (w * t).sin() - w * (w * t).cos() + w * decay)
                / (rate * rate + w * w);
            for (i, temperature) in temperature.iter_mut().enumerate() {
                *temperature += self.vectors[(i, k)] * (constant + sine) / self.root[i];
            }
        }
        temperature
    }
}

/// A stiff ladder of `n` nodes: capacities over four decades, conductances over three, a constant
/// and a sine source at its head, its foot tied to a boundary at 0 degC. Returns the system and its
/// exact rise at times.
pub struct StiffLadder {
    pub system: ThermalSystem,
    modal: Modal,
    constant: Vec<f64>,
    sine: Vec<f64>,
}

pub const LADDER_OMEGA: f64 = 2.0 * std::f64::consts::PI / 60.0;

impl StiffLadder {
    pub fn new(n: usize) -> Self {
        let spread =
            |i: usize, decades: f64| 10_f64.powf(decades * ((i * 7 % n) as f64 / n as f64 - 0.5));
        let capacity: Vec<f64> = (0..n).map(|i| 10.0 * spread(i, 4.0)).collect();
        let conductance: Vec<f64> = (0..n).map(|i| 20.0 * spread(i + 3, 3.0)).collect();
        let zero = Temperature::celsius(0.0);
        let mut b = NetworkBuilder::new();
        let nodes: Vec<NodeId> =
            (0..n).map(|i| b.node(&format!("n{i}"), HeatCapacity(capacity[i]), zero)).collect();
        let foot = b.boundary("foot", zero);
        let mut g = Mat::zeros(n, n);
        for i in 0..n {
            g[(i, i)] += conductance[i];
            match nodes.get(i + 1) {
                Some(&next) => {
                    b.resistor(&format!("r{i}"), nodes[i], next, Conductance(conductance[i]));
                    g[(i + 1, i + 1)] += conductance[i];
                    g[(i, i + 1)] -= conductance[i];
                    g[(i + 1, i)] -= conductance[i];
                }
                None => {
                    b.resistor(&format!("r{i}"), nodes[i], foot, Conductance(conductance[i]));
                }
            }
        }
        let heat =
            b.expression("30 [W] + 50 [W] * sin(2 * pi * t / 60 [s])", None).expect("it compiles");
        b.source("head", nodes[0], heat);
        let unit = |x: f64| (0..n).map(|i| if i == 0 { x } else { 0.0 }).collect();
        Self {
            system: assembled(b),
            modal: Modal::new(&capacity, &g),
            constant: unit(30.0),
            sine: unit(50.0),
        }
    }

    pub fn rise(&self, t: f64) -> Vec<f64> {
        self.modal.at(t, &self.constant, &self.sine, LADDER_OMEGA)
    }
}

/// An `n` by `n` grid, C = 1 J/K, G = 1 W/K to four neighbours or to the boundary at 0 degC around
/// it, and `heat` W into the cell (p, q), from 1.
pub fn grid(n: usize, heat: f64, (p, q): (usize, usize)) -> ThermalSystem {
    let zero = Temperature::celsius(0.0);
    let mut b = NetworkBuilder::new();
    let edge = b.boundary("edge", zero);
    let mut cells = Vec::with_capacity(n * n);
    for k in 0..n * n {
        cells.push(b.node(&format!("c{k}"), HeatCapacity(1.0), zero));
    }
    let one = Conductance(1.0);
    for i in 0..n {
        for j in 0..n {
            let here = cells[i * n + j];
            if j + 1 < n {
                b.resistor(&format!("x{i}_{j}"), here, cells[i * n + j + 1], one);
            }
            if i + 1 < n {
                b.resistor(&format!("y{i}_{j}"), here, cells[(i + 1) * n + j], one);
            }
            let outside =
                [i == 0, i + 1 == n, j == 0, j + 1 == n].into_iter().filter(|&o| o).count();
            for side in 0..outside {
                b.resistor(&format!("e{i}_{j}_{side}"), here, edge, one);
            }
        }
    }
    b.source("heat", cells[(p - 1) * n + (q - 1)], HeatFlow(heat));
    assembled(b)
}

/// The exact rise of cell (x, y) of [`grid`] at `t`: the eigenvectors of the discrete Laplacian are
/// products of sines, with rates `4 - 2 cos(i pi/(n+1)) - 2 cos(j pi/(n+1))`.
pub fn grid_rise(
    n: usize,
    heat: f64,
    (p, q): (usize, usize),
    (x, y): (usize, usize),
    t: f64,
) -> f64 {
    let angle = std::f64::consts::PI / (n as f64 + 1.0);
    let sine = |i: usize, at: usize| (i as f64 * at as f64 * angle).sin();
    let mut rise = 0.0;
    for i in 1..=n {
        for j in 1..=n {
            let rate = 4.0 - 2.0 * (i as f64 * angle).cos() - 2.0 * (j as f64 * angle).cos();
            let shape = sine(i, p) * sine(j, q) * sine(i, x) * sine(j, y);
            rise += shape * -f64::exp_m1(-rate * t) / rate;
        }
    }
    rise * heat * 4.0 / ((n as f64 + 1.0) * (n as f64 + 1.0))
}

/// The network of a solution's names, for messages.
pub fn name(network: &Network, node: NodeId) -> &str {
    &network.nodes()[node.index()].name
}
