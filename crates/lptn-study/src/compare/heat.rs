//! Distribution of the heat of a candidate: over its whole run, or in steady state.

use lptn_network::{End, Item, Network};
use lptn_solve::{Ledger, Selection, Solution, SteadyState, Window};

/// The name of the heat that streams carry away, among those of boundaries.
const STREAMS: &str = "streams";

/// The window over the run in which heat by path is taken.
const WINDOW: &str = "compare";

/// Most paths to boundaries that are listed one by one; a network with more, such as an imported
/// one, lists none.
const MOST_PATHS: usize = 64;

/// A part of the heat as a share, by the name of its receiver; `None` if there was no heat.
pub type Share = (String, Option<f64>);

/// The results over which heat is taken.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum HeatOver {
    /// In steady state.
    #[default]
    Steady,
    /// Over the whole run.
    Run,
    /// Over the periodic steady state.
    Cycle,
}

/// Distribution of heat. Shares are those of all heat that leaves the network or is stored in it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct HeatOut {
    /// All of it: in J over a run or cycle, in W in steady state.
    pub all: f64,
    /// The results over which it is taken.
    pub over: HeatOver,
    /// Mean heat flow of all sources in W.
    pub duty: f64,
    /// Length in s of the run or cycle; `None` in steady state.
    pub length: Option<f64>,
    /// Share stored in nodes; 0 if they give off heat that they had. Over a run only.
    pub stored: Option<f64>,
    /// Share that each boundary takes on balance; 0 for one that gives heat. The last, `streams`,
    /// is heat that streams carry away and that no other stream brings.
    pub boundaries: Vec<Share>,
    /// Share that each path brings on balance to the boundary at its end, except streams.
    pub paths: Vec<PathShare>,
}

/// Heat that a path to a boundary brings to it.
#[derive(Clone, Debug, PartialEq)]
pub struct PathShare {
    /// The name of the path.
    pub name: String,
    /// The name of the boundary.
    pub to: String,
    /// Its share; 0 if it takes heat from the boundary.
    pub share: Option<f64>,
}

impl HeatOut {
    pub(crate) fn in_steady_state(network: &Network, steady: &SteadyState) -> Self {
        let (given, streams) = (&steady.boundary_heat, &steady.stream_heat);
        let mut flows = Vec::new();
        let paths = paths(network);
        // one balance a boundary, not one a path
        for (id, end) in network.boundary_ids().map(|id| (id, End::Boundary(id))) {
            if paths.iter().any(|path| path.to == end) {
                let balance = steady.balance(network, End::Boundary(id));
                flows.extend(balance.terms.into_iter().map(|term| (term.item, end, term.power)));
            }
        }
        let flow = |path: &Path| {
            let found = flows.iter().find(|(item, to, _)| *item == path.item && *to == path.to);
            found.map_or(0.0, |(_, _, power)| *power)
        };
        let paths: Vec<(Path, f64)> = paths.into_iter().map(|path| (path, flow(&path))).collect();
        let duty = network.heat_sources().map(|id| steady.source_heat[id.index()]).sum();
        Self { duty, ..Self::of(network, (given, streams), (None, &paths)) }
    }

    /// Over a run or over a cycle, which stores nothing.
    pub(crate) fn over_time(
        network: &Network,
        solution: &Solution,
        (over, length): (HeatOver, f64),
    ) -> Self {
        let Ledger { sources, boundaries, streams, stored, .. } = solution.ledger();
        let seen = solution.windows().iter().find(|window| window.name == WINDOW);
        let heat = |path: &Path| {
            if let (true, End::Boundary(id)) = (is_alone(network, path), path.to) {
                return Some(-boundaries[id.index()]);
            }
            let window = seen?;
            let name = path.column(network);
            let column = window.columns.iter().find(|column| column.name == name)?;
            Some(path.sign * column.mean * (window.to - window.from))
        };
        let known = paths(network).into_iter().filter_map(|path| Some((path, heat(&path)?)));
        let paths: Vec<(Path, f64)> = known.collect();
        let stored = (over == HeatOver::Run).then(|| stored.iter().sum());
        let given: f64 = network.heat_sources().map(|id| sources[id.index()]).sum();
        let (duty, length) = (given / length, Some(length));
        Self { over, duty, length, ..Self::of(network, (boundaries, streams), (stored, &paths)) }
    }

    /// Boundaries and streams by the heat that they give, paths by the heat that they bring.
    fn of(
        network: &Network,
        (given, streams): (&[f64], &[f64]),
        (stored, paths): (Option<f64>, &[(Path, f64)]),
    ) -> Self {
        let taken = |given: f64| (-given).max(0.0);
        // one stream passes on the heat of another, so a closed circuit carries nothing away
        let (brought, moved) =
            streams.iter().fold((0.0, 0.0), |(sum, moved), q| (sum + q, moved + q.abs()));
        let carried = if brought.abs() > 1e-9 * moved { taken(brought) } else { 0.0 };
        let all = given.iter().map(|q| taken(*q)).sum::<f64>()
            + carried
            + stored.map_or(0.0, |stored: f64| stored.max(0.0));
        let share = |heat: f64| (all > 0.0).then(|| heat.max(0.0) / all);
        let names = network.boundaries().iter().map(|boundary| boundary.name.clone());
        let open = (carried > 0.0).then(|| (STREAMS.to_owned(), share(carried)));
        let of_path = |(path, heat): &(Path, f64)| PathShare {
            name: network.name_of(path.item).into_owned(),
            to: network.name_of(path.to.into()).into_owned(),
            share: share(*heat),
        };
        Self {
            all,
            over: HeatOver::Steady,
            duty: 0.0,
            length: None,
            stored: stored.and_then(share),
            boundaries: names.zip(given.iter().map(|q| share(taken(*q)))).chain(open).collect(),
            paths: paths.iter().map(of_path).collect(),
        }
    }
}

/// The window over a run that [`HeatOut::over_time`] reads; none if no path is listed, or if each
/// is the only one to its boundary, whose heat the ledger has.
pub(crate) fn window(network: &Network, (from, to): (f64, f64)) -> Option<Window> {
    let paths = paths(network);
    let shared = paths.iter().filter(|path| !is_alone(network, path));
    let columns: Vec<String> = shared.map(|path| path.column(network)).collect();
    let of = Selection::matching(network, &columns).ok().filter(|_| !columns.is_empty())?;
    Some(Window { name: WINDOW.to_owned(), from, to, of })
}

/// A path that ends at one boundary.
#[derive(Clone, Copy)]
struct Path {
    item: Item,
    to: End,
    /// 1 if its heat flow is counted towards the boundary.
    sign: f64,
}

impl Path {
    fn column(&self, network: &Network) -> String {
        format!("{}.Q", network.name_of(self.item))
    }
}

/// True if nothing else touches the boundary of a path.
fn is_alone(network: &Network, path: &Path) -> bool {
    let conductors = network.conductors();
    let touches = |id: lptn_network::ConductorId| {
        let conductor = &conductors[id.index()];
        conductor.from == path.to || conductor.to == path.to
    };
    let joints = network.shared_face_paths();
    let joints = joints.filter_map(|id| network.face_paths()[id.index()].conductors().next());
    network.outer_conductors().chain(joints).filter(|id| touches(*id)).count() == 1
}

/// The paths by which heat may leave, except streams, in the order of the network; none if they are
/// very many.
fn paths(network: &Network) -> Vec<Path> {
    let conductors = network.conductors();
    let ends = |item: Item, id: lptn_network::ConductorId| {
        let conductor = &conductors[id.index()];
        let (to, sign) = match (conductor.from, conductor.to) {
            (End::Node(_), to @ End::Boundary(_)) => (to, 1.0),
            (from @ End::Boundary(_), End::Node(_)) => (from, -1.0),
            _ => return None,
        };
        (!conductor.law.is_stream()).then_some(Path { item, to, sign })
    };
    let shared = network.shared_face_paths().filter_map(|id| {
        let first = network.face_paths()[id.index()].conductors().next()?;
        ends(Item::FacePath(id), first)
    });
    let alone = network.outer_conductors().filter_map(|id| ends(Item::Conductor(id), id));
    let found: Vec<Path> = alone.chain(shared).take(MOST_PATHS + 1).collect();
    if found.len() > MOST_PATHS { Vec::new() } else { found }
}
