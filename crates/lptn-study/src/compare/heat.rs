//! Where the heat of a candidate goes: over its whole run, or in steady state.

use lptn_network::{End, Item, Network};
use lptn_solve::{Ledger, Selection, Solution, SteadyState, Window};

/// The name of what streams carry away, among those of boundaries.
const STREAMS: &str = "streams";

/// The window over the run in which paths are looked at.
const WINDOW: &str = "compare";

/// Of a network with more paths to boundaries than these, such as an imported one, no path is told
/// by itself.
const MOST_PATHS: usize = 64;

/// A part of the heat by the name of what takes it, as a share; `None` where no heat was turned
/// over.
pub type Share = (String, Option<f64>);

/// In which results heat is looked at.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum HeatOver {
    /// In steady state.
    #[default]
    Steady,
    /// Over the whole run.
    Run,
    /// Over the settled cycle.
    Cycle,
}

/// Where heat goes. Shares are those of all heat that leaves the network or is stored in it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct HeatOut {
    /// All of it: in J over a run or cycle, in W in steady state.
    pub all: f64,
    /// In which results.
    pub over: HeatOver,
    /// What nodes store; 0 where they give off heat that they had. Over a run only.
    pub stored: Option<f64>,
    /// What each boundary takes on balance; 0 for one that gives heat. Last, as `streams`, what
    /// streams carry away that no other stream brings.
    pub boundaries: Vec<Share>,
    /// What each path brings on balance to the boundary at its end, but for streams.
    pub paths: Vec<PathShare>,
}

/// What a path to a boundary brings to it.
#[derive(Clone, Debug, PartialEq)]
pub struct PathShare {
    /// The name of the path.
    pub name: String,
    /// The name of the boundary.
    pub to: String,
    /// Its share; 0 where it takes heat from the boundary.
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
        Self::of(network, (given, streams), (None, &paths))
    }

    /// Over a run or over a cycle, which stores nothing.
    pub(crate) fn over_time(network: &Network, solution: &Solution, over: HeatOver) -> Self {
        let Ledger { boundaries, streams, stored, .. } = solution.ledger();
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
        Self { over, ..Self::of(network, (boundaries, streams), (stored, &paths)) }
    }

    /// Boundaries and streams by the heat that they give, paths by what they bring.
    fn of(
        network: &Network,
        (given, streams): (&[f64], &[f64]),
        (stored, paths): (Option<f64>, &[(Path, f64)]),
    ) -> Self {
        let taken = |given: f64| (-given).max(0.0);
        // one stream hands on what another brings, so a closed circuit carries nothing away
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
            stored: stored.and_then(share),
            boundaries: names.zip(given.iter().map(|q| share(taken(*q)))).chain(open).collect(),
            paths: paths.iter().map(of_path).collect(),
        }
    }
}

/// The window over a run that [`HeatOut::over_time`] reads; none where no path is told, or each is
/// the only one to its boundary, whose heat the ledger knows.
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
    /// 1 where its heat flow is counted towards the boundary.
    sign: f64,
}

impl Path {
    fn column(&self, network: &Network) -> String {
        format!("{}.Q", network.name_of(self.item))
    }
}

/// Whether nothing else touches the boundary of a path.
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

/// The paths by which heat may leave, but for streams, in the order of the network; none where they
/// are very many.
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
