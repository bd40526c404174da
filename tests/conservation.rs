//! Properties of random networks: energy balance, maximum principle, symmetry, invariance.

use crate::support;

use lptn::prelude::*;
use lptn_network::{End, NodeId};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use support::assembled;

/// A random network as plain data, so that a test can compute with it on its own and build it in
/// any order.
#[derive(Clone, Debug)]
struct Plan {
    /// Capacity in J/K and start in degC; no capacity: massless.
    nodes: Vec<(Option<f64>, f64)>,
    /// Boundaries in degC.
    boundaries: Vec<f64>,
    /// Ends (nodes, then boundaries) and conductance in W/K.
    paths: Vec<(usize, usize, f64)>,
    /// Heat in W into a node.
    sources: Vec<(usize, f64)>,
}

fn decades(low: f64, high: f64) -> impl Strategy<Value = f64> {
    (low..high).prop_map(|x| 10_f64.powf(x))
}

/// Connected networks of 2 to 9 nodes: each node is tied to an earlier vertex, boundary 0 being the
/// first.
fn plan() -> impl Strategy<Value = Plan> {
    let node = (prop::option::weighted(0.75, decades(0.0, 3.0)), 0.0..100.0_f64);
    let nodes = prop::collection::vec(node, 2..10);
    let boundaries = prop::collection::vec(0.0..100.0_f64, 1..4);
    (nodes, boundaries).prop_flat_map(|(nodes, boundaries)| {
        let (n, b) = (nodes.len(), boundaries.len());
        let tree = prop::collection::vec((any::<prop::sample::Index>(), decades(-1.0, 2.0)), n);
        let extra = prop::collection::vec((0..n, 0..n + b, decades(-1.0, 2.0)), 0..8);
        let sources = prop::collection::vec((0..n, -2.0..100.0_f64), 0..4);
        (tree, extra, sources).prop_map(move |(tree, extra, sources)| {
            let earlier = |i: usize, pick: prop::sample::Index| match pick.index(i + 1) {
                0 => n,
                k => k - 1,
            };
            let mut paths: Vec<_> =
                tree.iter().enumerate().map(|(i, (pick, g))| (i, earlier(i, *pick), *g)).collect();
            paths.extend(extra.into_iter().filter(|(a, b, _)| a != b));
            let (nodes, boundaries) = (nodes.clone(), boundaries.clone());
            Plan { nodes, boundaries, paths, sources }
        })
    })
}

impl Plan {
    fn build(&self) -> ThermalSystem {
        self.build_in_order(&(0..self.nodes.len()).collect::<Vec<_>>(), "n").0
    }

    /// Builds with the nodes added in `order` and named after `prefix`; gives the id of each node
    /// of the plan.
    fn build_in_order(&self, order: &[usize], prefix: &str) -> (ThermalSystem, Vec<NodeId>) {
        let mut b = NetworkBuilder::new();
        let mut ids = vec![None; self.nodes.len()];
        for &i in order {
            let (capacity, start) = self.nodes[i];
            let name = format!("{prefix}{i}");
            ids[i] = Some(match capacity {
                Some(c) => b.node(&name, HeatCapacity(c), Temperature::celsius(start)),
                None => b.massless(&name),
            });
        }
        let ids: Vec<NodeId> =
            ids.into_iter().map(|id| id.expect("the order names every node")).collect();
        let boundaries: Vec<_> = (0..self.boundaries.len())
            .map(|i| b.boundary(&format!("{prefix}b{i}"), Temperature::celsius(self.boundaries[i])))
            .collect();
        let end = |i: usize| match i.checked_sub(ids.len()) {
            Some(k) => End::from(boundaries[k]),
            None => End::from(ids[i]),
        };
        for (k, &(from, to, g)) in self.paths.iter().enumerate() {
            b.resistor(&format!("{prefix}r{k}"), end(from), end(to), Conductance(g));
        }
        for (k, &(into, q)) in self.sources.iter().enumerate() {
            b.source(&format!("{prefix}q{k}"), ids[into], HeatFlow(q));
        }
        (assembled(b), ids)
    }

    /// Heat into each node at temperatures `t` (nodes, then boundaries).
    fn balance(&self, t: &[f64]) -> Vec<f64> {
        let mut q = vec![0.0; t.len()];
        for &(a, b, g) in &self.paths {
            q[a] -= g * (t[a] - t[b]);
            q[b] += g * (t[a] - t[b]);
        }
        for &(into, heat) in &self.sources {
            q[into] += heat;
        }
        q.truncate(self.nodes.len());
        q
    }

    fn with_boundaries(&self, nodes: &[f64]) -> Vec<f64> {
        nodes.iter().copied().chain(self.boundaries.iter().map(|t| t + 273.15)).collect()
    }

    /// The scale of heat flows, for relative errors.
    fn scale(&self) -> f64 {
        100.0 * self.paths.iter().map(|p| p.2).fold(0.0, f64::max)
    }
}

fn run(system: &ThermalSystem, tolerance: f64) -> Solution {
    let stop = Time(300.0);
    Transient::until(stop).every(Time(30.0)).tolerance(tolerance).solve(system).expect("it runs")
}

fn config() -> ProptestConfig {
    ProptestConfig {
        cases: 96,
        failure_persistence: None,
        rng_seed: RngSeed::Fixed(20_261_121), // the same networks every time
        ..ProptestConfig::default()
    }
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn every_node_is_in_balance_in_steady_state(plan in plan()) {
        let steady = SteadyState::solve(&plan.build(), 0.0).expect("every node leads to boundary 0");
        for q in plan.balance(&plan.with_boundaries(&steady.temperatures)) {
            prop_assert!(q.abs() <= 1e-10 * plan.scale(), "{q} W are left over");
        }
    }

    #[test]
    fn books_close_over_a_run(plan in plan()) {
        let solution = run(&plan.build(), 1e-5);
        let ledger = solution.ledger();
        if let Some(residual) = ledger.relative_residual() {
            prop_assert!(residual.abs() <= 1e-8, "{residual:e} of {} J", ledger.turned_over);
        }
    }

    #[test]
    fn massless_nodes_are_in_balance_at_every_row(plan in plan()) {
        let solution = run(&plan.build(), 1e-5);
        for row in 0..solution.times().len() {
            let q = plan.balance(&plan.with_boundaries(solution.row(row)));
            for (q, (capacity, _)) in q.iter().zip(&plan.nodes) {
                prop_assert!(capacity.is_some() || q.abs() <= 1e-10 * plan.scale(), "{q} W are \
                    left over");
            }
        }
    }

    #[test]
    fn without_sources_temperatures_stay_between_the_extremes(mut plan in plan()) {
        plan.sources.clear();
        let starts = plan.nodes.iter().filter(|(c, _)| c.is_some()).map(|(_, t)| *t);
        let all: Vec<f64> = plan.boundaries.iter().copied().chain(starts).map(|t| t + 273.15).collect();
        let (low, high) = all.iter().fold((f64::MAX, f64::MIN), |(l, h), t| (l.min(*t), h.max(*t)));
        let solution = run(&plan.build(), 1e-5);
        for row in 0..solution.times().len() {
            for t in solution.row(row) {
                prop_assert!((low - 1e-4..=high + 1e-4).contains(t), "{t} is outside {low} .. \
                    {high}");
            }
        }
    }

    #[test]
    fn transfer_resistances_are_symmetric(plan in plan(), a in any::<prop::sample::Index>(), b in any::<prop::sample::Index>()) {
        let (a, b) = (a.index(plan.nodes.len()), b.index(plan.nodes.len()));
        let rise = |heated: usize, read: usize| {
            let mut one = plan.clone();
            one.boundaries.iter_mut().for_each(|t| *t = 0.0);
            one.sources = vec![(heated, 1.0)];
            SteadyState::solve(&one.build(), 0.0).expect("it is grounded").temperatures[read] - 273.15
        };
        let (there, back, own) = (rise(a, b), rise(b, a), rise(a, a));
        prop_assert!((there - back).abs() <= 1e-10 * own.max(rise(b, b)) + 1e-12, "{there} and \
            {back} K/W");
        prop_assert!(there <= own + 1e-12 && there >= -1e-12, "{there} of {own} K/W");
    }

    #[test]
    fn names_change_nothing_at_all(plan in plan()) {
        let order: Vec<usize> = (0..plan.nodes.len()).collect();
        let (first, second) = (plan.build(), plan.build_in_order(&order, "other").0);
        let (first, second) = (run(&first, 1e-5), run(&second, 1e-5));
        for row in 0..first.times().len() {
            prop_assert_eq!(first.row(row), second.row(row));
        }
    }

    #[test]
    fn order_changes_nothing_but_rounding(plan in plan(), seed in any::<u64>()) {
        let mut order: Vec<usize> = (0..plan.nodes.len()).collect();
        order.sort_by_key(|&i| (i as u64 + 1).wrapping_mul(seed | 1).rotate_left(17));
        let (shuffled, ids) = plan.build_in_order(&order, "n");
        let straight = SteadyState::solve(&plan.build(), 0.0).expect("it is grounded");
        let other = SteadyState::solve(&shuffled, 0.0).expect("it is grounded");
        for (i, id) in ids.iter().enumerate() {
            let difference = straight.temperatures[i] - other.temperatures[id.index()];
            prop_assert!(difference.abs() <= 1e-9, "{difference} K");
        }
        let (straight, other) = (run(&plan.build(), 1e-7), run(&shuffled, 1e-7));
        for row in 0..straight.times().len() {
            for (i, id) in ids.iter().enumerate() {
                let difference = straight.row(row)[i] - other.row(row)[id.index()];
                prop_assert!(difference.abs() <= 2e-6, "{difference} K");
            }
        }
    }
}
