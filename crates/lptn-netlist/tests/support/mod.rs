//! What a network is to the outside: the names of everything and all numbers.

#![allow(
    clippy::unwrap_used,
    dead_code,
    reason = "a test that cannot go on has failed; shared by several"
)]

use lptn_network::{Item, Network};

/// Every name with its numbers: capacities, starts, heat flows at some temperatures and times,
/// margins.
pub(crate) fn seen(network: &Network) -> Vec<(String, Vec<f64>)> {
    let mut seen = Vec::new();
    for id in network.node_ids() {
        let numbers = vec![network.capacity(id), network.initial(id)];
        seen.push((format!("node {}", network.name_of(Item::Node(id))), numbers));
    }
    for id in network.parameter_ids() {
        let parameter = &network.parameters()[id.index()];
        let value = network.parameter_value(id);
        // also of another value, which percents follow
        let sigma = |at: f64| parameter.deviation.map_or(0.0, |spread| spread.sigma(at));
        let numbers = vec![value, sigma(value), sigma(2.0 * value)];
        seen.push((format!("parameter {} {}", parameter.name, parameter.ty), numbers));
    }
    let count = network.nodes().len() + network.boundaries().len();
    for (time, base) in [(1.0, 300.0), (7.3, 340.0)] {
        let mut scope = network.evaluation();
        scope.set_time(time, time);
        let mut temperatures: Vec<f64> =
            (0..count).map(|i| base + 3.7 * ((i * 7) % 11) as f64).collect();
        let mut boundaries = vec![0.0; network.boundaries().len()];
        network.boundary_temperatures(&mut scope, &mut boundaries).unwrap();
        temperatures[network.nodes().len()..].copy_from_slice(&boundaries);
        for (boundary, value) in network.boundaries().iter().zip(&boundaries) {
            seen.push((format!("boundary {}", boundary.name), vec![*value]));
        }
        for id in network.conductor_ids() {
            let conductor = &network.conductors()[id.index()];
            let mut received = Vec::new();
            let heat = network.exchange_slopes(id, &mut scope, &temperatures, &mut received);
            received.extend(heat);
            let ends = [conductor.from, conductor.to].map(|end| network.name_of(end.into()));
            let name = format!("{:?} {} {ends:?}", conductor.kind, conductor.name());
            seen.push((name, received.into_iter().flatten().collect()));
        }
        let (nodes, boundaries) = temperatures.split_at(network.nodes().len());
        scope.set_temperatures(nodes, boundaries);
        for source in network.sources() {
            let nodes: Vec<_> =
                source.into.iter().map(|(n, _)| network.name_of(Item::Node(*n))).collect();
            let mut numbers: Vec<f64> = source.into.iter().map(|(_, share)| *share).collect();
            numbers.extend(source.law.values().iter().flat_map(|value| value.at(&mut scope)));
            seen.push((format!("source {} {nodes:?}", source.name()), numbers));
        }
        for id in network.limit_ids() {
            let limit = &network.limits()[id.index()];
            let name = format!(
                "limit {} {:?} {:?} {}",
                limit.name, limit.bound, limit.severity, limit.text
            );
            seen.push((name, network.limit_margin(id, &mut scope).into_iter().collect()));
        }
        for id in network.report_ids() {
            let name = format!("report {}", network.reports()[id.index()].name);
            seen.push((name, network.report_value(id, &mut scope).into_iter().collect()));
        }
    }
    seen
}

/// The same names in the same order, and the same numbers up to a relative difference.
pub(crate) fn same(found: &[(String, Vec<f64>)], expected: &[(String, Vec<f64>)], relative: f64) {
    let names =
        |seen: &[(String, Vec<f64>)]| seen.iter().map(|(name, _)| name.clone()).collect::<Vec<_>>();
    assert_eq!(names(found), names(expected));
    for ((name, a), (_, b)) in found.iter().zip(expected) {
        assert_eq!(a.len(), b.len(), "{name}");
        for (x, y) in a.iter().zip(b) {
            let near =
                (x - y).abs() <= relative * y.abs().max(x.abs()) || (x.is_nan() && y.is_nan());
            assert!(near, "{name}: {a:?} is not {b:?}");
        }
    }
}
