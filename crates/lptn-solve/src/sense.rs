//! Implausible results: nearly always the unit of one value is wrong.

use lptn_network::{ConductorId, End, Network, NodeId, SourceId};

use crate::extremes::{Extremes, Place};
use crate::solution::Solution;
use crate::steady::SteadyState;
use crate::times::just_after;

/// A node with an implausible temperature, and its probable cause.
#[derive(Clone, Debug, PartialEq)]
pub struct Beyond {
    /// The node.
    pub node: NodeId,
    /// Its temperature in K.
    pub temperature: f64,
    /// Its time in s; `None` in steady state.
    pub time: Option<f64>,
    /// The path of the network with the largest difference between its ends, in K: it keeps the
    /// heat in.
    pub path: Option<(ConductorId, f64)>,
    /// The source that gives it the most heat in W, whatever the sign; of any if none heats the
    /// node.
    pub source: Option<(SourceId, f64)>,
}

impl Beyond {
    /// The implausible result of a run, if any: the hottest node if it is hotter than 4000 degC, or
    /// the coldest if it is colder than -100 degC although neither a start nor a boundary is.
    pub fn of_run(solution: &Solution) -> Option<Self> {
        let network = solution.network();
        let last = solution.last();
        let peaks =
            solution.watched().iter().map(|seen| (seen.watch.node, seen.peak.0, Some(seen.peak.1)));
        let ends =
            network.thermal_nodes().map(|id| (id, last.temperatures[id.index()], Some(last.time)));
        let mut scope = network.evaluation();
        scope.set_time(last.time, just_after(last.time));
        let mut boundaries = vec![f64::NAN; network.boundaries().len()];
        network.boundary_temperatures(&mut scope, &mut boundaries).ok()?;
        let ids = network.boundary_ids();
        let colder =
            ids.flat_map(|id| solution.boundary_temperature(id)).chain(boundaries.iter().copied());
        let places = solution.extremes.clone().with(peaks).with(ends);
        let place = places.odd(network, colder)?;
        let temperatures: Vec<f64> = last.temperatures.iter().chain(&boundaries).copied().collect();
        let heat = |id: SourceId| network.source_heat(id, &mut scope, &temperatures).ok();
        let sources: Vec<Option<f64>> = network.source_ids().map(heat).collect();
        Some(Self::beside(network, place, (&temperatures, &sources)))
    }

    /// The implausible result of a steady state, if any: as [`Beyond::of_run`].
    pub fn of_steady(network: &Network, steady: &SteadyState) -> Option<Self> {
        let nodes = network.thermal_nodes().map(|id| (id, steady.temperatures[id.index()], None));
        let boundaries = &steady.boundary_temperatures;
        let place = Extremes::default().with(nodes).odd(network, boundaries.iter().copied())?;
        let temperatures: Vec<f64> =
            steady.temperatures.iter().chain(boundaries).copied().collect();
        let sources: Vec<Option<f64>> = steady.source_heat.iter().map(|heat| Some(*heat)).collect();
        Some(Self::beside(network, place, (&temperatures, &sources)))
    }

    fn beside(
        network: &Network,
        (node, temperature, time): Place,
        (temperatures, heat): (&[f64], &[Option<f64>]),
    ) -> Self {
        let at = |end: End| temperatures[network.vertex(end)];
        let paths = network.conductor_ids().zip(network.conductors());
        let paths =
            paths.map(|(id, conductor)| (id, (at(conductor.from) - at(conductor.to)).abs()));
        let largest = |a: &(SourceId, f64), b: &(SourceId, f64)| a.1.abs().total_cmp(&b.1.abs());
        let sources = || network.heat_sources().filter_map(|id| Some((id, heat[id.index()]?)));
        let heats =
            |id: SourceId| network.sources()[id.index()].into.iter().any(|(into, _)| *into == node);
        let source = sources().filter(|(id, _)| heats(*id)).max_by(largest);
        Self {
            node,
            temperature,
            time,
            path: paths.max_by(|a, b| a.1.total_cmp(&b.1)),
            source: source.or_else(|| sources().max_by(largest)),
        }
    }
}
