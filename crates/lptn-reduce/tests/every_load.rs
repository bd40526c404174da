//! The largest error over every load: never exceeded, reached, and kept by as few nodes as are said.
//! What a load does is summed from step responses by a decomposition of the whole matrices, which
//! shares nothing with the library but its networks.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking, in its helpers too")]

use crate::common;

use common::{Random, Spectrum, near};
use lptn_network::NodeId;
use lptn_reduce::{Nodes, Reduction, ReductionOptions};

/// A random network, its whole spectrum at a port, and its reduction.
fn reduced(random: &mut Random) -> (Spectrum, Reduction) {
    let (system, nodes) = random.network();
    let port: NodeId = nodes[random.below(nodes.len())];
    let reduction = Reduction::new(&system, port, &ReductionOptions::default()).unwrap();
    (Spectrum::of(&system, port), reduction)
}

/// The error in K of a few nodes, which are a network of their own, at the end of a load: power from
/// each time on.
fn error(whole: &Spectrum, nodes: &Nodes, load: &[(f64, f64)], end: f64) -> f64 {
    let few = Spectrum::of_ladder(nodes);
    let mut before = 0.0;
    let mut sum = 0.0;
    for &(from, power) in load.iter().filter(|(from, _)| *from < end) {
        sum += (power - before) * (few.rise(end - from) - whole.rise(end - from));
        before = power;
    }
    sum
}

/// The load that the library says has the largest error, of 1 W.
fn own_load(nodes: &Nodes) -> (Vec<(f64, f64)>, f64) {
    let (stretches, end) = nodes.worst.load();
    let power = |on: bool| if on { 1.0 } else { 0.0 };
    (stretches.into_iter().map(|(from, on)| (from, power(on))).collect(), end)
}

fn check(random: &mut Random) {
    let (whole, reduction) = reduced(random);
    let dynamics = reduction.dynamics.as_ref().unwrap();
    let step = dynamics.step.as_ref().unwrap();
    let r = step.resistance;
    let rounding = 1e-7 * r;
    let mut candidates: Vec<Nodes> =
        dynamics.pairs.iter().filter_map(|pair| Nodes::of_pair(step, pair)).collect();
    candidates.extend((2..5).filter_map(|count| Nodes::of(step, count)));
    for nodes in &candidates {
        // positive elements, and the steady state of the whole network
        let ladder = &nodes.ladder;
        assert!(ladder.rungs.iter().all(|(c, r)| *c > 0.0 && *r > 0.0), "{nodes:?}");
        near(ladder.resistance(), r, 1e-12);
        // reached by its own load
        let most = nodes.worst.most();
        if most > 1e-9 * r {
            let (load, end) = own_load(nodes);
            let reached = -error(&whole, nodes, &load, end);
            assert!(reached >= 0.99 * most - rounding, "{reached} of {most}: {nodes:?}");
            assert!(reached <= most + rounding, "{reached} of {most}: {nodes:?}");
            // what is on where that is off reads too warm by as much
            let before = if load.len() > nodes.worst.turns.len() { 0.0 } else { 1.0 };
            let slow = nodes.foster.terms.iter().fold(step.slowest().tau, |a, term| a.max(term.1));
            let mut other = vec![(-100.0 * slow, before)];
            other.extend(load.iter().map(|&(from, power)| (from, 1.0 - power)));
            let reached = error(&whole, nodes, &other, end);
            assert!(reached >= 0.99 * most - rounding, "{reached} of {most}: {nodes:?}");
            assert!(reached <= most + rounding, "{reached} of {most}: {nodes:?}");
        }
        // exceeded by no other
        let slow = step.slowest().tau;
        for _ in 0..100 {
            let (load, end) = random.load(slow);
            let found = error(&whole, nodes, &load, end).abs();
            assert!(found <= most + rounding, "{found} is more than {most}: {load:?} {nodes:?}");
        }
    }
    // as few nodes as are said
    for share in [0.3, 0.03, 0.003] {
        let (found, short) = Nodes::enough(step, &dynamics.pairs, (share * r, 20));
        let found = found.unwrap();
        assert!(found.worst.most() <= share * r);
        for nodes in &short {
            assert!(nodes.count() < found.count());
            let (load, end) = own_load(nodes);
            let reached = -error(&whole, nodes, &load, end);
            assert!(reached > 0.99 * share * r, "{reached} breaks not {share} of {r}: {nodes:?}");
        }
        assert_eq!(short.len() + 1, found.count().max(1), "{share} {short:?}");
    }
}

#[test]
fn no_load_exceeds_the_worst_case_and_its_own_reaches_it() {
    let mut random = Random::new(17);
    (0..60).for_each(|_| check(&mut random));
}

#[test]
#[ignore = "a thousand networks: cargo test --release -p lptn-reduce -- --ignored"]
fn no_load_exceeds_the_worst_case_of_a_thousand_networks() {
    let mut random = Random::new(1);
    (0..1000).for_each(|_| check(&mut random));
}

/// As many nodes as the port sees are exact, and more are not made.
#[test]
fn more_nodes_than_there_are_are_those_there_are() {
    let (system, nodes) = common::chain(&[50.0, 30.0, 20.0], &[2.0, 3.0, 4.0]);
    let reduction = Reduction::new(&system, nodes[2], &ReductionOptions::default()).unwrap();
    let dynamics = reduction.dynamics.unwrap();
    let found = Nodes::of(dynamics.step.as_ref().unwrap(), 9).unwrap();
    // the chain itself, from its end
    let own = [(20.0, 0.25), (30.0, 1.0 / 3.0), (50.0, 0.5)];
    for (found, own) in found.ladder.rungs.iter().zip(own) {
        near(found.0, own.0, 1e-9);
        near(found.1, own.1, 1e-9);
    }
    assert!(found.worst.most() < 1e-9);
}

/// By hand: `z = 1 - exp(-t)/2 - exp(-4t)/2` and one node of the time constant 5/8, the mean. The
/// error `exp(-8t/5) - exp(-t)/2 - exp(-4t)/2` turns twice; the sum of its rises by SciPy's brentq
/// on its derivative.
#[test]
fn two_exponentials_for_one() {
    let step = lptn_reduce::StepResponse {
        resistance: 1.0,
        direct: 0.0,
        terms: [(1.0, 0.5), (0.25, 0.5)]
            .map(|(tau, resistance)| lptn_reduce::ResponseTerm { tau, resistance, error: 0.0 })
            .to_vec(),
        residual: 0.0,
    };
    let pair = lptn_reduce::Pair {
        definition: lptn_reduce::Definition::FirstMoment,
        capacity: 0.625,
        step: None,
        run: None,
    };
    let worst = Nodes::of_pair(&step, &pair).unwrap().worst;
    near(worst.turns[0], 0.2861803420648552, 1e-9);
    near(worst.turns[1], 1.91755589605284, 1e-9);
    near(worst.kelvin, 0.12510429652600075, 1e-9);
    assert_eq!(worst.turns.len(), 2);
    assert!(worst.missed == 0.0);
}
