//! Makes a diagram of a network.

mod links;
mod sources;

use lptn_network::{Acts, ControlId, End, Evaluation, Item, Network};
use lptn_plot::SERIES;
use lptn_report::plain;
use lptn_solve::Snapshot;
use lptn_units::Unit;

use crate::groups::{Group, Grouping, groups};
use crate::model::{Diagram, Place, PlaceRole, Scales, Switching, Target};
use crate::words::{self, Scale};

/// Options of a diagram.
#[derive(Clone, Copy, Debug)]
pub struct View<'a> {
    /// Its title.
    pub title: &'a str,
    /// Grouping of many nodes into boxes.
    pub grouping: Grouping,
    /// The scale of its temperatures.
    pub unit: &'a Unit,
    /// The state that is shown.
    pub state: Option<&'a Snapshot>,
    /// True if each node and boundary is marked with the ink of its curve over time.
    pub marked: bool,
}

/// The place of the curve of a node or boundary over time, which decides its ink in every picture:
/// its position in the network, nodes before boundaries. `None` in networks of more nodes and
/// boundaries than inks and dashes can distinguish.
pub fn series(network: &Network, end: End) -> Option<usize> {
    let ends = network.nodes().len() + network.boundaries().len();
    (ends <= 2 * SERIES).then(|| network.vertex(end))
}

/// A network as it is drawn. Values that do not depend on time or temperatures are numbers.
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

/// Most paths of one kind between two groups, or sources of one group, that are shown one by
/// one.
const MOST_APART: usize = 3;

/// Heat flows below this, in W, are rounding errors.
const NOISE: f64 = 1e-9;

/// Boundaries colder than this share of the coldest node, in K, do not set the scale: empty space
/// would give all nodes one colour.
const SPACE: f64 = 0.5;

/// True if a boundary is too cold for the scale.
fn is_below(state: &Snapshot, kelvin: f64) -> bool {
    let coldest = state.temperatures.iter().copied().fold(f64::INFINITY, f64::min);
    coldest.is_finite() && kelvin < SPACE * coldest
}

/// The coldest and the hottest temperature in K that set the scale.
fn span(state: &Snapshot) -> [f64; 2] {
    let boundaries = state.boundary_temperatures.iter().filter(|t| !is_below(state, **t));
    let all = || state.temperatures.iter().chain(boundaries.clone()).copied();
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
    /// The heat that each node stores, in W.
    stored: Option<Vec<f64>>,
}

impl Reader<'_> {
    fn at(&self, end: End) -> usize {
        self.place[self.network.vertex(end)]
    }

    fn scales(&self, state: &Snapshot, span: [f64; 2], most: f64) -> Scales {
        let mut caption = words::caption(self.network, state);
        for (boundary, kelvin) in self.network.boundaries().iter().zip(&state.boundary_temperatures)
        {
            if is_below(state, *kelvin) {
                let name = plain(&boundary.name);
                caption += &format!("; {name}, {}, is below the scale", self.scale.text(*kelvin));
            }
        }
        let most = if most > NOISE { most } else { 0.0 };
        let heat_unit = words::unit_of(most, "W");
        let decimals = lptn_report::decimals(most / heat_unit.0, 4, 0).min(4);
        let ticks = self.scale.ticks(span);
        let ends = span.map(|kelvin| self.scale.text(kelvin));
        let unit = self.view.unit.clone();
        Scales { span, ends, ticks, unit, caption, most, heat_unit, decimals }
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
                    || words::letter("T", (self.network.depends_on_time(given), false)),
                    |kelvin| self.scale.given(kelvin),
                )
            }),
        };
        let (role, name) = (self.role(group), plain(&group.name));
        let stored = self.stored(group).filter(|_| role.stores());
        let (within, series) = (self.within(group), self.series(group));
        Place { name, role, temperature, kelvin, stored, within, series }
    }

    fn series(&self, group: &Group) -> Option<usize> {
        let end = match (group.nodes.as_slice(), group.boundaries.as_slice()) {
            ([one], []) => End::Node(*one),
            ([], [one]) => End::Boundary(*one),
            _ => return None,
        };
        series(self.network, end).filter(|_| self.view.marked)
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
            let varies = group.nodes.iter().any(|id| self.network.capacity_varies(*id));
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

    /// The heat in W that the nodes of a group store together; none in a steady state.
    fn stored(&self, group: &Group) -> Option<f64> {
        let stored = self.stored.as_ref()?;
        Some(group.nodes.iter().map(|id| stored[id.index()]).sum())
    }

    /// The heat in W that streams between members bring the group; no other member loses it.
    fn within(&self, group: &Group) -> f64 {
        let (Some(state), true) = (self.view.state, group.words.is_some()) else { return 0.0 };
        let members = group.nodes.iter().map(|id| End::Node(*id));
        let members = members.chain(group.boundaries.iter().map(|id| End::Boundary(*id)));
        let Some(own) = members.map(|end| self.at(end)).next() else { return 0.0 };
        let conductors = self.network.conductors().iter().zip(&state.received);
        let inside = conductors.filter(|(conductor, _)| {
            conductor.law.is_stream()
                && self.at(conductor.from) == own
                && self.at(conductor.to) == own
        });
        inside.map(|(_, received)| received.iter().sum::<f64>()).sum()
    }

    /// The evaluation at the time of the state, else at the beginning.
    fn scope(&self) -> Evaluation {
        let mut scope = self.network.evaluation();
        let time = self.view.state.map_or(0.0, |state| state.time);
        scope.set_time(time, time);
        scope
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
        for (id, own) in network.heat_sources().zip(sources) {
            let source = &network.sources()[id.index()];
            if source.law.values().iter().any(|value| value.slots().contains(&slot)) {
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
                || words::letter("T", (self.network.depends_on_time(value), false)),
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
