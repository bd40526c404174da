//! Several nodes kept: exact in steady state, positive, with the first moments of the whole, and no
//! load exceeds the error that is said. The whole networks are decomposed by the tests' own means.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking, in its helpers too")]

use crate::common;

use common::{Random, Spectrum, assembled, chain, near};
use lptn_analysis::RunAnalysis;
use lptn_assembly::ThermalSystem;
use lptn_network::{
    Conductance, HeatCapacity, HeatFlow, NetworkBuilder, NodeId, Temperature, Time,
};
use lptn_reduce::{
    Allowed, Kept, KeptErrors, KeptReference, NortonEquivalent, Projected, ReduceError, Reduction,
    ReductionOptions,
};
use lptn_solve::SteadyState;

/// `z_pq` in the end and its first moment by the library's one-port solutions, which other tests
/// hold against closed forms.
fn moments(system: &ThermalSystem, p: NodeId, q: NodeId) -> (f64, f64) {
    let [a, b] = [p, q].map(|node| NortonEquivalent::new(system, node).unwrap().response);
    let capacity = system.network().node_ids().map(|id| system.network().capacity(id));
    (a[q.index()], a.iter().zip(&b).zip(capacity).map(|((a, b), c)| a * b * c).sum())
}

fn kept(
    system: &ThermalSystem,
    asked: &[NodeId],
    count: usize,
    run: Option<&RunAnalysis>,
) -> (Kept, KeptErrors) {
    let reference = KeptReference::new(system, asked, (run, Allowed::default())).unwrap();
    Kept::new(system, &reference, count).unwrap()
}

fn reduced(kept: &Kept, system: &ThermalSystem) -> (ThermalSystem, Vec<NodeId>) {
    let network = kept.network(system, 0.0).unwrap();
    let few = ThermalSystem::assemble(&network).unwrap();
    let ids = few.network().node_ids().collect();
    (few, ids)
}

fn check(random: &mut Random) {
    let (system, nodes) = random.network();
    let asked = [nodes[0], nodes[nodes.len() - 1]];
    for count in [2, 3, 5, nodes.len()] {
        let (kept, errors) = kept(&system, &asked, count, None);
        assert_eq!(kept.count(), count.clamp(2, nodes.len()));
        assert!(kept.capacity.iter().all(|c| *c > 0.0), "{kept:?}");
        assert!(kept.links.iter().all(|(_, _, g)| *g > 0.0), "{kept:?}");
        assert!(kept.grounds.iter().flatten().all(|g| *g >= 0.0), "{kept:?}");
        let (few, ids) = reduced(&kept, &system);
        for i in 0..2 {
            for j in 0..2 {
                let (whole, here) =
                    (moments(&system, asked[i], asked[j]), moments(&few, ids[i], ids[j]));
                near(here.0, whole.0, 1e-9);
                let own = moments(&system, asked[i], asked[i]).1;
                let other = moments(&system, asked[j], asked[j]).1;
                let missed = (here.1 - whole.1).abs() / (own * other).sqrt();
                assert!(missed <= kept.moments + 1e-9, "{missed} {kept:?}");
            }
        }
        loads(random, (&system, &few), (&asked, &ids), &(kept, errors));
    }
}

/// Loads between 0 and 1 W into both nodes at once, by the spectra of both networks.
fn loads(
    random: &mut Random,
    (whole, few): (&ThermalSystem, &ThermalSystem),
    (asked, ids): (&[NodeId; 2], &[NodeId]),
    (kept, errors): &(Kept, KeptErrors),
) {
    for at in 0..2 {
        let spectra: Vec<(Spectrum, Spectrum)> = (0..2)
            .map(|from| {
                (
                    Spectrum::between(whole, asked[from], asked[at]),
                    Spectrum::between(few, ids[from], ids[at]),
                )
            })
            .collect();
        let slow = spectra[0].0.terms.iter().fold(0.0, |a: f64, term| a.max(term.0));
        let (most, rise) = errors.loads[at];
        near(
            rise,
            moments(whole, asked[at], asked[0]).0 + moments(whole, asked[at], asked[1]).0,
            1e-9,
        );
        for _ in 0..20 {
            let mut error = 0.0;
            let (one, end) = random.load(slow);
            let (other, _) = random.load(slow);
            for ((whole, few), load) in spectra.iter().zip([one, other]) {
                let mut before = 0.0;
                for (from, power) in load.into_iter().filter(|(from, _)| *from < end) {
                    error += (power - before) * (few.rise(end - from) - whole.rise(end - from));
                    before = power;
                }
            }
            assert!(error.abs() <= most + 1e-7 * rise, "{error} is more than {most}: {kept:?}");
        }
    }
}

#[test]
fn kept_nodes_are_exact_at_rest_and_no_load_exceeds_their_error() {
    let mut random = Random::new(5);
    (0..12).for_each(|_| check(&mut random));
}

#[test]
#[ignore = "a thousand networks: cargo test --release -p lptn-reduce -- --ignored"]
fn kept_nodes_of_a_thousand_networks() {
    let mut random = Random::new(2);
    (0..1000).for_each(|_| check(&mut random));
}

/// All nodes kept are the network.
#[test]
fn all_nodes_are_the_network() {
    let (capacity, conductance) = ([50.0, 30.0, 20.0, 7.0], [2.0, 3.0, 4.0, 0.1]);
    let (system, nodes) = chain(&capacity, &conductance);
    let (kept, errors) = kept(&system, &[nodes[3], nodes[0]], 9, None);
    assert_eq!(kept.count(), 4);
    for (node, found) in kept.nodes.iter().zip(&kept.capacity) {
        near(*found, capacity[node.index()], 1e-9);
    }
    assert!(errors.loads.iter().all(|(error, rise)| *error < 1e-8 * rise), "{errors:?}");
}

/// One node kept is the pair of the first moment, where that is better than what TICER moves.
#[test]
fn one_node_is_the_first_moment() {
    let (system, nodes) = chain(&[50.0, 30.0, 20.0], &[2.0, 3.0, 4.0]);
    let (kept, _) = kept(&system, &nodes[2..], 1, None);
    let reduction = Reduction::new(&system, nodes[2], &ReductionOptions::default()).unwrap();
    near(kept.capacity[0], reduction.dynamics.unwrap().pairs[1].capacity, 1e-12);
    assert!(kept.moments < 1e-12);
    near(kept.grounds[0][0], 1.0 / reduction.norton.resistance, 1e-12);
}

/// A frame with two bodies, a junction, a body apart, two boundaries and two sources.
fn frame() -> (ThermalSystem, Vec<NodeId>) {
    let zero = Temperature::celsius(20.0);
    let mut b = NetworkBuilder::new();
    let nodes: Vec<NodeId> = [("hot", 200.0), ("wall", 900.0), ("cold", 400.0)]
        .map(|(name, c)| b.node(name, HeatCapacity(c), zero))
        .to_vec();
    let junction = b.massless("junction");
    let apart = b.node("apart", HeatCapacity(5.0), zero);
    let (air, base) =
        (b.boundary("air", Temperature(300.0)), b.boundary("base", Temperature::celsius(60.0)));
    b.resistor("a", nodes[0], junction, Conductance(4.0));
    b.resistor("b", junction, nodes[1], Conductance(3.0));
    b.resistor("c", nodes[1], nodes[2], Conductance(2.0));
    b.resistor("d", nodes[2], base, Conductance(1.0));
    b.resistor("e", junction, air, Conductance(0.5));
    b.source("p", nodes[0], HeatFlow(70.0));
    b.shared_source("q", &[(nodes[1], 0.25), (junction, 0.75)], HeatFlow(12.0));
    (assembled(b), [nodes, vec![junction, apart]].concat())
}

/// At rest all temperatures come back from the kept ones, with massless nodes and islands.
#[test]
fn recovered_temperatures_are_the_steady_ones() {
    let (system, nodes) = frame();
    let whole = SteadyState::solve(&system, 0.0).unwrap().temperatures.clone();
    for asked in [&nodes[..1], &[nodes[3], nodes[2]][..], &nodes[1..3]] {
        for count in [asked.len(), 3] {
            let (kept, _) = kept(&system, asked, count, None);
            let recovery = kept.recovery(&system).unwrap();
            let (few, _) = reduced(&kept, &system);
            let found = SteadyState::solve(&few, 0.0).unwrap().temperatures.clone();
            for (node, expected) in nodes[..4].iter().zip(&whole) {
                let n = node.index();
                let of_nodes: f64 = kept.weights.iter().zip(&found).map(|(w, t)| w[n] * t).sum();
                let of_boundaries =
                    recovery.boundaries[0][n] * 300.0 + recovery.boundaries[1][n] * 333.15;
                let of_sources = recovery.sources[0][n] * 70.0 + recovery.sources[1][n] * 12.0;
                let recovered = of_nodes + of_boundaries + of_sources;
                assert!((recovered - expected).abs() < 1e-9, "{recovered} is not {expected}");
            }
        }
    }
}

/// Sources away from the kept nodes and boundaries that warm are in the error of the run.
#[test]
fn the_run_is_compared_at_every_node_asked_for() {
    let (system, nodes) = frame();
    let run = RunAnalysis::until(Time(4000.0));
    let error = |count| {
        let (_, errors) = kept(&system, &[nodes[0], nodes[2]], count, Some(&run));
        errors.run.unwrap().iter().map(|(error, _)| error.kelvin).fold(0.0, f64::max)
    };
    assert!(error(2) > 0.1 && error(3) < 1e-5, "{} {}", error(2), error(3));
}

/// The model's own response, and the steady state between the nodes asked for; what it says of every
/// load is held against loads.
#[test]
fn a_projection_is_exact_at_rest_and_no_load_exceeds_its_error() {
    let mut random = Random::new(11);
    for _ in 0..12 {
        let (system, nodes) = random.network();
        let asked = [nodes[0], nodes[nodes.len() - 1]];
        let with = (None, Allowed::default());
        let reference = KeptReference::new(&system, &asked, with).unwrap();
        for count in [2, 4, 6, 99] {
            let model = Projected::new(&system, &reference, count).unwrap();
            assert!(model.tau.len() <= count && model.tau.iter().all(|tau| *tau >= 0.0));
            let rise = |p: usize, q: usize, time: f64| -> f64 {
                let modes = model.tau.iter().zip(&model.shapes);
                let part = |(tau, shape): (&f64, &Vec<f64>)| {
                    let weight = shape[asked[p].index()] * shape[asked[q].index()];
                    if *tau > 0.0 { -weight * (-time / tau).exp_m1() } else { weight }
                };
                modes.map(part).sum()
            };
            for (p, q) in [(0, 0), (0, 1), (1, 1)] {
                near(rise(p, q, 1e30), moments(&system, asked[p], asked[q]).0, 1e-9);
            }
            let spectra = [0, 1].map(|from| Spectrum::between(&system, asked[from], asked[0]));
            let slow = spectra[0].terms.iter().fold(0.0, |a: f64, term| a.max(term.0));
            let (most, whole) = model.errors.loads[0];
            for _ in 0..20 {
                let (one, end) = random.load(slow);
                let (other, _) = random.load(slow);
                let mut error = 0.0;
                for ((from, spectrum), load) in spectra.iter().enumerate().zip([one, other]) {
                    let mut before = 0.0;
                    for (start, power) in load.into_iter().filter(|(start, _)| *start < end) {
                        let time = end - start;
                        error += (power - before) * (rise(from, 0, time) - spectrum.rise(time));
                        before = power;
                    }
                }
                assert!(error.abs() <= most + 1e-7 * whole, "{error} is more than {most}");
            }
            // the last modes are lost in rounding: the space begins with the slow ones
            assert!(count < 99 || most < 1e-2 * whole, "{most} of {whole}");
        }
    }
}

#[test]
fn what_cannot_be_kept_is_refused() {
    let (system, nodes) = frame();
    let with = (None, Allowed::default());
    let apart = KeptReference::new(&system, &[nodes[0], nodes[4]], with).unwrap_err();
    assert!(matches!(&apart, ReduceError::NoGround { names } if names == &["apart"]), "{apart}");
}
