//! Networks with known answers.
#![allow(
    dead_code,
    unreachable_pub,
    clippy::unwrap_used,
    reason = "each test file uses a part of it"
)]

use faer::Mat;
use lptn_assembly::ThermalSystem;
use lptn_integrate::dense;
use lptn_network::{
    Conductance, End, HeatCapacity, HeatFlow, NetworkBuilder, NodeId, Resistance, Temperature,
};
use lptn_reduce::Nodes;

pub fn assembled(builder: NetworkBuilder) -> ThermalSystem {
    ThermalSystem::assemble(&builder.build().unwrap()).unwrap()
}

/// Steel that is heated, aluminium around it, ambient at 25.5 degC.
pub fn two_nodes(c: [f64; 2], r_int: f64, r_amb: f64, heat: f64) -> (ThermalSystem, [NodeId; 2]) {
    let ambient = Temperature::celsius(25.5);
    let mut b = NetworkBuilder::new();
    let steel = b.node("steel", HeatCapacity(c[0]), ambient);
    let aluminium = b.node("aluminium", HeatCapacity(c[1]), ambient);
    let bed = b.boundary("bed", ambient);
    b.resistor("internal", steel, aluminium, Resistance(r_int));
    b.resistor("outer", aluminium, bed, Resistance(r_amb));
    b.source("P_disp", steel, HeatFlow(heat));
    (assembled(b), [steel, aluminium])
}

/// `n` cells between a boundary before the first one and the last one, which is the port.
pub fn chain(capacity: &[f64], conductance: &[f64]) -> (ThermalSystem, Vec<NodeId>) {
    let zero = Temperature::celsius(0.0);
    let mut b = NetworkBuilder::new();
    let nodes: Vec<NodeId> = capacity
        .iter()
        .enumerate()
        .map(|(i, &c)| b.node(&format!("n{i}"), HeatCapacity(c), zero))
        .collect();
    let end = b.boundary("end", zero);
    b.resistor("g0", end, nodes[0], Conductance(conductance[0]));
    for i in 1..nodes.len() {
        b.resistor(&format!("g{i}"), nodes[i - 1], nodes[i], Conductance(conductance[i]));
    }
    (assembled(b), nodes)
}

#[track_caller]
pub fn near(found: f64, expected: f64, relative: f64) {
    assert!((found - expected).abs() <= relative * expected.abs(), "{found:?} is not {expected:?}");
}

/// Numbers without pattern, the same in every run (PCG's multiplier).
pub struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1)
    }

    /// Between 0 and 1.
    pub fn share(&mut self) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        #[expect(clippy::cast_precision_loss, reason = "32 bits")]
        let high = (self.0 >> 32) as f64;
        high / f64::from(u32::MAX)
    }

    pub fn below(&mut self, n: usize) -> usize {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            clippy::cast_precision_loss,
            reason = "small numbers"
        )]
        let k = (self.share() * n as f64) as usize;
        k.min(n - 1)
    }

    /// Evenly by its logarithm.
    pub fn log(&mut self, from: f64, to: f64) -> f64 {
        from * (to / from).powf(self.share())
    }

    /// Two to 25 nodes, a tree with as many paths more, and one or two paths to a boundary.
    pub fn network(&mut self) -> (ThermalSystem, Vec<NodeId>) {
        let zero = Temperature::celsius(0.0);
        let mut b = NetworkBuilder::new();
        let count = 2 + self.below(24);
        let nodes: Vec<NodeId> = (0..count)
            .map(|i| b.node(&format!("n{i}"), HeatCapacity(self.log(1.0, 1e4)), zero))
            .collect();
        let end = b.boundary("end", zero);
        let mut paths = 0;
        let mut join = |b: &mut NetworkBuilder, ends: (NodeId, NodeId), g: f64| {
            paths += 1;
            b.resistor(&format!("g{paths}"), ends.0, ends.1, Conductance(g));
        };
        for i in 1..count {
            let other = nodes[self.below(i)];
            join(&mut b, (nodes[i], other), self.log(0.02, 50.0));
        }
        for _ in 0..self.below(count) {
            let (a, c) = (self.below(count), self.below(count));
            if a != c {
                join(&mut b, (nodes[a], nodes[c]), self.log(0.02, 50.0));
            }
        }
        for i in 0..=self.below(2) {
            let node = nodes[self.below(count)];
            b.resistor(&format!("out{i}"), node, end, Conductance(self.log(0.05, 5.0)));
        }
        (assembled(b), nodes)
    }

    /// Powers between 0 and 1 W from rising times on, and an end.
    pub fn load(&mut self, slow: f64) -> (Vec<(f64, f64)>, f64) {
        let steps = 1 + self.below(12);
        let full = self.share() < 0.5;
        let mut time = 0.0;
        let mut load = Vec::new();
        for _ in 0..steps {
            let power = self.share();
            load.push((time, if full { power.round() } else { power }));
            time += self.log(1e-4 * slow, 3.0 * slow);
        }
        (load, time)
    }
}

/// The step response at a node from all eigenvalues of the whole matrices.
pub struct Spectrum {
    pub terms: Vec<(f64, f64)>,
    direct: f64,
}

impl Spectrum {
    pub fn of(system: &ThermalSystem, port: NodeId) -> Self {
        Self::between(system, port, port)
    }

    /// The rise of one node for heat into the other.
    pub fn between(system: &ThermalSystem, from: NodeId, to: NodeId) -> Self {
        let network = system.network();
        let n = network.nodes().len();
        let mut g = Mat::<f64>::zeros(n, n);
        for (conductor, id) in network.conductors().iter().zip(network.conductor_ids()) {
            let value = network.conductance(id).unwrap();
            for (here, there) in [(conductor.from, conductor.to), (conductor.to, conductor.from)] {
                let End::Node(here) = here else { continue };
                g[(here.index(), here.index())] += value;
                if let End::Node(there) = there {
                    g[(here.index(), there.index())] -= value;
                }
            }
        }
        let capacity: Vec<f64> = network.node_ids().map(|id| network.capacity(id)).collect();
        Self::from(&g, &capacity, (from.index(), to.index()), 0.0)
    }

    pub fn of_ladder(nodes: &Nodes) -> Self {
        let (c, r): (Vec<f64>, Vec<f64>) = nodes.ladder.rungs.iter().copied().unzip();
        let mut g = Mat::<f64>::zeros(c.len(), c.len());
        for (i, r) in r.iter().enumerate() {
            g[(i, i)] += 1.0 / r;
            if i + 1 < c.len() {
                g[(i + 1, i + 1)] += 1.0 / r;
                g[(i, i + 1)] -= 1.0 / r;
                g[(i + 1, i)] -= 1.0 / r;
            }
        }
        Self::from(&g, &c, (0, 0), nodes.ladder.direct)
    }

    fn from(g: &Mat<f64>, capacity: &[f64], (p, q): (usize, usize), direct: f64) -> Self {
        let n = capacity.len();
        let root: Vec<f64> = capacity.iter().map(|c| c.sqrt()).collect();
        let scaled = Mat::from_fn(n, n, |i, j| g[(i, j)] / root[i] / root[j]);
        let (rates, vectors) = dense::symmetric_eigen(scaled.as_ref()).unwrap();
        let term = |k: usize| {
            let share = vectors[(p, k)] / root[p] * vectors[(q, k)] / root[q];
            (1.0 / rates[k], share / rates[k])
        };
        Self { terms: (0..n).map(term).collect(), direct }
    }

    /// In K for 1 W from time 0 on.
    pub fn rise(&self, time: f64) -> f64 {
        self.direct - self.terms.iter().map(|(tau, r)| r * (-time / tau).exp_m1()).sum::<f64>()
    }
}
