//! Makes a diagram of a network.

use std::collections::{BTreeMap, BTreeSet};

use lptn_network::{
    Acts, ConductorFlow, ConductorId, ConductorKind, ControlId, End, Evaluation, Item, Network,
    SourceId,
};
use lptn_report::plain;
use lptn_solve::Snapshot;
use lptn_units::Unit;

use crate::groups::{Group, Grouping, groups};
use crate::model::{Diagram, Link, Place, PlaceRole, Scales, Supply, Switching, Target};
use crate::words::{self, Scale};

/// How a network is looked at.
#[derive(Clone, Copy, Debug)]
pub struct View<'a> {
    /// What it is called.
    pub title: &'a str,
    /// Whether many nodes stand as one box.
    pub grouping: Grouping,
    /// The scale of its temperatures.
    pub unit: &'a Unit,
    /// The state that is shown.
    pub state: Option<&'a Snapshot>,
}

/// A network as it is drawn. Values that do not depend on time or temperatures are given as
/// numbers.
pub fn diagram(network: &Network, view: &View<'_>) -> Diagram {
    let groups = groups(network, view.grouping);
    let span = view.state.map_or([0.0, 100.0], span);
    let reader = Reader {
        network,
        view: *view,
        scale: Scale::new(view.unit, span[1] - span[0]),
        place: places_of(network, &groups),
        alone: groups.iter().map(|group| group.words.is_none()).collect(),
        stored: view.state.filter(|state| !state.settled).map(|state| state.stored(network)),
    };
    let (links, link_of) = reader.links();
    let (sources, source_of) = reader.sources();
    let target = (&link_of[..], &source_of[..]);
    let controls = network.control_ids().map(|id| reader.control(id, target)).collect();
    let places: Vec<Place> = groups.iter().map(|group| reader.group(group)).collect();
    let scales = view.state.map(|state| {
        let flows = links.iter().filter_map(|link| link.heat);
        let flows = flows.chain(sources.iter().filter_map(|source| source.heat));
        let flows = flows.chain(places.iter().filter_map(|place| place.stored));
        reader.scales(state, span, flows.map(f64::abs).fold(0.0, f64::max))
    });
    Diagram {
        title: plain(view.title),
        places,
        links,
        sources,
        controls,
        scales,
        grouped: groups
            .iter()
            .filter_map(|group| Some(format!("{}: {}", group.name, group.words.as_ref()?)))
            .collect(),
    }
}

/// So many paths of one kind between two groups, or sources of one group, are still told apart.
const MOST_APART: usize = 3;

/// Heat flows below this, in W, are what rounding left over.
const NOISE: f64 = 1e-9;

fn span(state: &Snapshot) -> [f64; 2] {
    let all = || state.temperatures.iter().chain(&state.boundary_temperatures).copied();
    [all().fold(f64::INFINITY, f64::min), all().fold(f64::NEG_INFINITY, f64::max)]
}

/// The place of every node, then of every boundary.
fn places_of(network: &Network, groups: &[Group]) -> Vec<usize> {
    let mut place = vec![0; network.nodes().len() + network.boundaries().len()];
    for (at, group) in groups.iter().enumerate() {
        let nodes = group.nodes.iter().map(|id| End::Node(*id));
        for end in nodes.chain(group.boundaries.iter().map(|id| End::Boundary(*id))) {
            place[network.vertex(end)] = at;
        }
    }
    place
}

struct Reader<'a> {
    network: &'a Network,
    view: View<'a>,
    scale: Scale<'a>,
    place: Vec<usize>,
    alone: Vec<bool>,
    /// What each node stores, in W.
    stored: Option<Vec<f64>>,
}

/// Several conductors that become one path.
#[derive(Default)]
struct Bundle {
    members: Vec<ConductorId>,
    /// The ends of the first.
    ends: (usize, usize),
}

impl Reader<'_> {
    fn at(&self, end: End) -> usize {
        self.place[self.network.vertex(end)]
    }

    fn scales(&self, state: &Snapshot, span: [f64; 2], most: f64) -> Scales {
        let caption = words::caption(self.network, state);
        let most = if most > NOISE { most } else { 0.0 };
        let heat_unit = words::unit_of(most, "W");
        let decimals = lptn_report::decimals(most / heat_unit.0, 4, 0).min(4);
        let ends = span.map(|kelvin| self.scale.text(kelvin));
        Scales { span, ends, caption, most, heat_unit, decimals }
    }

    fn group(&self, group: &Group) -> Place {
        let temperatures = self.temperatures(group);
        let kelvin = temperatures.as_ref().map(|all| all.iter().sum::<f64>() / all.len() as f64);
        let range = temperatures.map(|all| {
            let fold = |of: fn(f64, f64) -> f64| all.iter().copied().reduce(of).unwrap_or(0.0);
            [fold(f64::min), fold(f64::max)]
        });
        let temperature = match range {
            Some(range) => Some(self.scale.range(range)),
            None => group.boundaries.first().filter(|_| group.words.is_none()).map(|id| {
                let given = &self.network.boundaries()[id.index()].temperature;
                words::number(self.network, given, &mut self.scope()).map_or_else(
                    || words::letter(self.network, given, "T", false),
                    |kelvin| self.scale.given(kelvin),
                )
            }),
        };
        let (role, name) = (self.role(group), plain(&group.name));
        let stored = self.stored(group).filter(|_| role.stores());
        Place { name, role, temperature, kelvin, stored }
    }

    fn temperatures(&self, group: &Group) -> Option<Vec<f64>> {
        let state = self.view.state?;
        let nodes = group.nodes.iter().map(|id| state.temperatures[id.index()]);
        let boundaries = group.boundaries.iter().map(|id| state.boundary_temperatures[id.index()]);
        Some(nodes.chain(boundaries).collect())
    }

    fn role(&self, group: &Group) -> PlaceRole {
        let capacity = || {
            let sum: f64 = group.nodes.iter().map(|id| self.network.capacity(*id)).sum();
            let varies = group.nodes.iter().any(|id| self.network.enthalpy(*id).is_some());
            (sum > 0.0).then(|| match varies {
                true => format!("{} at the start", words::si(sum, "J/K")),
                false => words::si(sum, "J/K"),
            })
        };
        match (&group.words, group.boundaries.is_empty()) {
            (_, false) => PlaceRole::Boundary,
            (Some(words), true) => PlaceRole::Group(words.clone(), capacity()),
            (None, true) => capacity().map_or(PlaceRole::Junction, PlaceRole::Node),
        }
    }

    /// What the nodes of a group store together, unless the state has settled.
    fn stored(&self, group: &Group) -> Option<f64> {
        let stored = self.stored.as_ref()?;
        Some(group.nodes.iter().map(|id| stored[id.index()]).sum())
    }

    /// Where values are read: the time of the state, else the beginning.
    fn scope(&self) -> Evaluation {
        let mut scope = self.network.evaluation();
        let time = self.view.state.map_or(0.0, |state| state.time);
        scope.set_time(time, time);
        scope
    }

    /// What a conductor is told as: the path to a face that it is a part of, else itself.
    fn unit(&self, id: ConductorId) -> Item {
        let item = Item::Conductor(id);
        self.network.whole(item).filter(|whole| matches!(whole, Item::FacePath(_))).unwrap_or(item)
    }

    /// The paths, and which of them each conductor is a part of.
    fn links(&self) -> (Vec<Link>, Vec<Option<usize>>) {
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
        let back = conductor(first).law.is_stream() && members.iter().all(|id| self.runs_back(*id));
        let heat = self.view.state.map(|state| {
            let heat = |id: &ConductorId| match back {
                true => state.received[id.index()][0],
                false => sign(*id) * state.received[id.index()][1],
            };
            members.iter().map(heat).sum::<f64>()
        });
        let (from, to) = if back { (to, from) } else { (from, to) };
        Link {
            name: self.link_name(members),
            kind: conductor(first).kind,
            from,
            to,
            value: self.value(members),
            stream: conductor(first).law.is_stream(),
            heat: heat.map(|heat| if heat.abs() > NOISE { heat } else { 0.0 }),
        }
    }

    /// Whether a stream flows from its second end to its first.
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

    /// The places that a source heats, with their shares.
    fn shares(&self, id: SourceId) -> Vec<(usize, f64)> {
        let mut shares: Vec<(usize, f64)> = Vec::new();
        for (node, share) in &self.network.sources()[id.index()].into {
            let place = self.at(End::Node(*node));
            match shares.iter_mut().find(|(at, _)| *at == place) {
                Some((_, sum)) => *sum += share,
                None => shares.push((place, *share)),
            }
        }
        shares
    }

    /// Sources for each place that they heat, and those that each source becomes.
    fn sources(&self) -> (Vec<Supply>, Vec<Vec<usize>>) {
        let shares: Vec<_> = self.network.source_ids().map(|id| (id, self.shares(id))).collect();
        let mut count = vec![0; self.alone.len()];
        for (place, _) in shares.iter().flat_map(|(_, shares)| shares) {
            count[*place] += 1;
        }
        let mut known: BTreeMap<usize, usize> = BTreeMap::new();
        let mut all: Vec<(usize, Vec<(SourceId, f64)>)> = Vec::new();
        let mut source_of = Vec::new();
        for (id, shares) in shares {
            let mut own = Vec::new();
            for (place, share) in shares {
                let apart = self.alone[place] || count[place] <= MOST_APART;
                let new = all.len();
                let at = if apart { new } else { *known.entry(place).or_insert(new) };
                if at == new {
                    all.push((place, Vec::new()));
                }
                all[at].1.push((id, share));
                own.push(at);
            }
            source_of.push(own);
        }
        let supply = |(into, members): &(usize, Vec<_>)| self.supply(*into, members);
        (all.iter().map(supply).collect(), source_of)
    }

    fn supply(&self, into: usize, members: &[(SourceId, f64)]) -> Supply {
        let heat = self.view.state.map(|state| {
            members.iter().map(|(id, share)| state.source_heat[id.index()] * share).sum()
        });
        let name = |id: SourceId| plain(&self.network.name_of(Item::Source(id)));
        let name = match members {
            [(id, share)] if *share > 0.999_999 => name(*id),
            [(id, share)] => {
                format!("{}, {} %", name(*id), lptn_report::significant(100.0 * share, 3))
            }
            many => {
                let names: Vec<String> = many.iter().map(|(id, _)| name(*id)).collect();
                words::together(&names, "sources")
            }
        };
        Supply { name, into, value: self.power(members), heat }
    }

    fn power(&self, members: &[(SourceId, f64)]) -> String {
        let mut scope = self.scope();
        let mut sum = 0.0;
        for (id, share) in members {
            let value = &self.network.sources()[id.index()].power;
            match words::number(self.network, value, &mut scope) {
                Some(power) => sum += power * share,
                None => {
                    let on_heat = !self.network.source_variables(*id).is_empty();
                    return words::letter(self.network, value, "P", on_heat);
                }
            }
        }
        let sign = if sum < 0.0 { "-" } else { "" };
        format!("{sign}{}", words::si(sum.abs(), "W"))
    }

    fn control(
        &self,
        id: ControlId,
        (links, sources): (&[Option<usize>], &[Vec<usize>]),
    ) -> Switching {
        let network = self.network;
        let slot = network.control_slot(id);
        let mut switches: Vec<Target> = Vec::new();
        for (conductor, at) in network.conductors().iter().zip(links) {
            if conductor.law.values().iter().any(|value| value.slots().contains(&slot)) {
                switches.extend(at.map(Target::Link));
            }
        }
        for (source, own) in network.sources().iter().zip(sources) {
            if source.power.slots().contains(&slot) {
                switches.extend(own.iter().copied().map(Target::Source));
            }
        }
        switches.sort_unstable();
        switches.dedup();
        let (sense, rule) = self.rule(id);
        let name = plain(&network.name_of(Item::Control(id)));
        Switching { name, sense, rule, switches }
    }

    fn rule(&self, id: ControlId) -> (usize, String) {
        let Some(thermostat) = self.network.thermostat(id) else { return (0, String::new()) };
        let mut scope = self.scope();
        let mut threshold = |value| {
            words::number(self.network, value, &mut scope).map_or_else(
                || words::letter(self.network, value, "T", false),
                |kelvin| self.scale.given(kelvin),
            )
        };
        let (on, off) = (threshold(&thermostat.on), threshold(&thermostat.off));
        let rule = match thermostat.acts {
            Acts::Cooling => format!("on above {on}, off below {off}"),
            Acts::Heating => format!("on below {on}, off above {off}"),
        };
        (self.at(thermostat.sense), rule)
    }
}
