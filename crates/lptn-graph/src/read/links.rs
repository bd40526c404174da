//! The paths of a diagram.

use std::collections::{BTreeMap, BTreeSet};

use lptn_network::{ConductorFlow, ConductorId, ConductorKind, End, Item};
use lptn_report::plain;
use lptn_solve::Snapshot;

use super::{MOST_APART, NOISE, Reader};
use crate::model::Link;
use crate::words;

/// A smaller difference of temperatures, in K, does not determine the rate of a stream.
const LEAST_DIFFERENCE: f64 = 1e-6;

/// Several conductors that become one path.
#[derive(Default)]
struct Bundle {
    members: Vec<ConductorId>,
    /// The ends of the first.
    ends: (usize, usize),
}

impl Reader<'_> {
    /// The item that a conductor is shown as: the path to a face that it is a part of, else itself.
    fn unit(&self, id: ConductorId) -> Item {
        let item = Item::Conductor(id);
        self.network.whole(item).filter(|whole| matches!(whole, Item::FacePath(_))).unwrap_or(item)
    }

    /// The paths, and for each conductor the path that it is a part of.
    pub(super) fn links(&self) -> (Vec<Link>, Vec<Option<usize>>) {
        type Ends = (usize, usize, ConductorKind);
        let ends = |id: ConductorId| {
            let conductor = &self.network.conductors()[id.index()];
            (self.at(conductor.from), self.at(conductor.to), conductor.kind)
        };
        // streams one way and the other are two
        let between = |(from, to, kind): Ends| match kind {
            ConductorKind::Advection => (from, to, kind),
            _ => (from.min(to), from.max(to), kind),
        };
        let mut units: BTreeMap<Ends, BTreeSet<Item>> = BTreeMap::new();
        for id in self.network.conductor_ids() {
            units.entry(between(ends(id))).or_default().insert(self.unit(id));
        }
        let mut known: BTreeMap<(Ends, Option<Item>), usize> = BTreeMap::new();
        let mut bundles: Vec<Bundle> = Vec::new();
        let mut link_of = vec![None; self.network.conductors().len()];
        for id in self.network.conductor_ids() {
            let (from, to, kind) = ends(id);
            if from == to {
                continue;
            }
            let pair = between((from, to, kind));
            let apart = (self.alone[from] && self.alone[to]) || units[&pair].len() <= MOST_APART;
            let at = *known.entry((pair, apart.then(|| self.unit(id)))).or_insert(bundles.len());
            if at == bundles.len() {
                bundles.push(Bundle { members: Vec::new(), ends: (from, to) });
            }
            bundles[at].members.push(id);
            link_of[id.index()] = Some(at);
        }
        let link = |bundle: &Bundle| self.link(&bundle.members, bundle.ends);
        (bundles.iter().map(link).collect(), link_of)
    }

    fn link(&self, members: &[ConductorId], (from, to): (usize, usize)) -> Link {
        let conductor = |id: ConductorId| &self.network.conductors()[id.index()];
        let sign = |id: ConductorId| if self.at(conductor(id).from) == from { 1.0 } else { -1.0 };
        let first = members[0];
        let stream = conductor(first).law.is_stream();
        let back = stream && members.iter().all(|id| self.runs_back(*id));
        let received = |state: &Snapshot, side: usize| -> f64 {
            members.iter().map(|id| sign(*id) * state.received[id.index()][side]).sum()
        };
        let heat = self.view.state.map(|state| received(state, usize::from(!back)));
        let against = self.view.state.map(|state| received(state, usize::from(back)));
        let (from, to) = if back { (to, from) } else { (from, to) };
        Link {
            name: self.link_name(members),
            kind: conductor(first).kind,
            from,
            to,
            value: self.value(members),
            stream,
            heat: heat.map(|heat| if heat.abs() > NOISE { heat } else { 0.0 }),
            carries: self
                .view
                .state
                .filter(|_| stream)
                .and_then(|state| self.carries(members, state)),
            against: against.filter(|_| stream).unwrap_or(0.0),
        }
    }

    /// The capacity rate of streams that run one way, and its product with the temperature that
    /// they leave with; `None` if they run both ways.
    fn carries(&self, members: &[ConductorId], state: &Snapshot) -> Option<(f64, f64)> {
        let back = self.runs_back(members[0]);
        let start = |id: ConductorId| {
            let conductor = &self.network.conductors()[id.index()];
            if back { conductor.to } else { conductor.from }
        };
        let from = self.at(start(members[0]));
        members.iter().try_fold((0.0, 0.0), |(rate, product), &id| {
            let one_way = self.runs_back(id) == back && self.at(start(id)) == from;
            let own = one_way.then(|| self.rate(id, state))?;
            Some((rate + own, product + own * self.kelvin(start(id), state)))
        })
    }

    fn kelvin(&self, end: End, state: &Snapshot) -> f64 {
        match end {
            End::Node(id) => state.temperatures[id.index()],
            End::Boundary(id) => state.boundary_temperatures[id.index()],
        }
    }

    /// The capacity rate of a stream in W/K: its heat over the difference of its temperatures,
    /// unless it is constant.
    fn rate(&self, id: ConductorId, state: &Snapshot) -> f64 {
        if let ConductorFlow::Stream(rate) = self.network.flow(id) {
            return rate.abs();
        }
        let conductor = &self.network.conductors()[id.index()];
        let [from, to] = [conductor.from, conductor.to].map(|end| self.kelvin(end, state));
        let heat = state.received[id.index()].iter().fold(0.0, |a: f64, b| a.max(b.abs()));
        if (from - to).abs() > LEAST_DIFFERENCE { heat / (from - to).abs() } else { 0.0 }
    }

    /// True if a stream flows from its second end to its first.
    fn runs_back(&self, id: ConductorId) -> bool {
        match (self.network.flow(id), self.view.state) {
            (ConductorFlow::Stream(rate), _) => rate < 0.0,
            (_, Some(state)) => {
                let [back, on] = state.received[id.index()];
                back.abs() > on.abs()
            }
            _ => false,
        }
    }

    fn link_name(&self, members: &[ConductorId]) -> String {
        let units: BTreeSet<Item> = members.iter().map(|id| self.unit(*id)).collect();
        let names: Vec<String> = units.iter().map(|of| plain(&self.network.name_of(*of))).collect();
        words::together(&names, "paths")
    }

    /// The conductances of several paths add.
    fn value(&self, members: &[ConductorId]) -> Option<String> {
        let flows: Vec<ConductorFlow> = members.iter().map(|id| self.network.flow(*id)).collect();
        let sum = flows.iter().try_fold(flows[0], |sum, flow| match (sum, flow) {
            _ if std::ptr::eq(flow, &flows[0]) => Some(sum),
            (ConductorFlow::Conductance(a), ConductorFlow::Conductance(b)) => {
                Some(ConductorFlow::Conductance(a + b))
            }
            (ConductorFlow::Radiation(a), ConductorFlow::Radiation(b)) => {
                Some(ConductorFlow::Radiation(a + b))
            }
            _ => None,
        });
        words::flow(sum?)
    }
}
