//! A network read from its element list, massless nodes eliminated by dense algebra.
//!
//! Written apart from `lptn-assembly` on purpose: it reads the laws of the conductors and the parts
//! of the nodes again and eliminates with a Cholesky factorisation, while the assembly uses the
//! star-mesh transformation. With m the massless nodes, r the others, u the boundaries and g >= 0
//! the conductances between two vertices, the balance of the massless nodes is `G_mm T_m = g_mr
//! T_r + g_mu T_u + q_m`. Put into the balances of the others it adds `g_rm G_mm^-1 g_mr` to the
//! conductances between them: sums and products of numbers that are not negative, so that nothing
//! cancels. A stream of constant capacity rate is a conductance that only the node it flows into
//! feels; with one `G_mm` is not symmetric, and LU replaces Cholesky.

use faer::Mat;
use lptn_integrate::dense;
use lptn_network::{ConductorFlow, End, Evaluation, Item, Network, NodeId};
use lptn_units::EvalError;

use super::ExactError;

/// Nodes with capacity (states), their links, and the effects of the inputs on them. The inputs are
/// the boundaries, then the sources.
#[derive(Clone, Debug)]
pub(crate) struct Reduced {
    pub(crate) states: Vec<NodeId>,
    /// Heat capacity of each state in J/K.
    pub(crate) capacity: Vec<f64>,
    /// Conductances in W/K between states, `a < b`, positive.
    pub(crate) links: Vec<(usize, usize, f64)>,
    /// One-way flows in W/K in addition to the links: into the first state, from the second.
    pub(crate) streams: Vec<(usize, usize, f64)>,
    /// Heat into a state (row) per K of a boundary above it, or its share of a source (columns).
    pub(crate) feeds: Mat<f64>,
    pub(crate) massless: Vec<NodeId>,
    /// Temperature of a massless node (row) per unit of each state, then of each input (columns).
    pub(crate) recovery: Mat<f64>,
}

/// Content of the element list: conductances, and where the inputs act.
struct Elements {
    /// Heat into a node (row) per K of another; zero on the diagonal, symmetric without streams.
    among: Mat<f64>,
    /// For each node (row) conductances to the boundaries, then 1 for the sources that heat it.
    inputs: Mat<f64>,
    boundaries: usize,
    /// True if some stream flows between nodes.
    streams: bool,
}

impl Reduced {
    /// The largest number of nodes: eigenvalues of matrices beyond it take minutes.
    pub(crate) const MOST_NODES: usize = 2000;

    /// A network of constant conductances.
    pub(crate) fn new(network: &Network) -> Result<Self, ExactError> {
        match network.first_nonlinear() {
            Some(item) => Err(not_linear(network, item)),
            None => Self::with_streams(network),
        }
    }

    /// The same, or a network that also has streams of constant capacity rates.
    pub(crate) fn with_streams(network: &Network) -> Result<Self, ExactError> {
        let nodes = network.nodes().len();
        if nodes > Self::MOST_NODES {
            return Err(ExactError::TooLarge { nodes });
        }
        if let Some(item) = first_beyond(network) {
            return Err(not_linear(network, item));
        }
        let elements = Elements::read(network).map_err(ExactError::Value)?;
        let capacities = capacities(network).map_err(ExactError::Value)?;
        let (mut states, mut massless) = (Vec::new(), Vec::new());
        for id in network.node_ids() {
            if network.nodes()[id.index()].massless { massless.push(id) } else { states.push(id) }
        }
        let capacity = states.iter().map(|id| capacities[id.index()]).collect();
        let recovery = elements.recovery(&massless, &states).ok_or(ExactError::Singular)?;
        let (coupling, feeds) = elements.eliminate(&massless, &states, &recovery);
        let (links, streams) = match elements.streams {
            true => (links(&coupling, f64::min), streams(&coupling)),
            false => (links(&coupling, |a, b| 0.5 * (a + b)), Vec::new()),
        };
        Ok(Self { states, capacity, links, streams, feeds, massless, recovery })
    }

    /// Temperatures of the states at the start in K.
    pub(crate) fn initial(&self, network: &Network) -> Result<Vec<f64>, ExactError> {
        let mut scope = network.evaluation();
        let start = |id: &NodeId| match &network.nodes()[id.index()].initial {
            Some(value) => value.at(&mut scope).map_err(ExactError::Value),
            None => Ok(f64::NAN),
        };
        self.states.iter().map(start).collect()
    }

    /// Conductance of each state to all boundaries together in W/K.
    pub(crate) fn ties(&self, boundaries: usize) -> Vec<f64> {
        (0..self.states.len()).map(|i| (0..boundaries).map(|b| self.feeds[(i, b)]).sum()).collect()
    }
}

impl Elements {
    fn read(network: &Network) -> Result<Self, EvalError> {
        let (nodes, boundaries) = (network.nodes().len(), network.boundaries().len());
        let mut among = Mat::zeros(nodes, nodes);
        let mut inputs = Mat::zeros(nodes, boundaries + network.sources().len());
        let mut scope = network.evaluation();
        let mut streams = false;
        for (id, conductor) in network.conductor_ids().zip(network.conductors()) {
            if let ConductorFlow::Stream(rate) = network.flow(id) {
                let ends = (conductor.from, conductor.to);
                let (from, to) = if rate < 0.0 { (ends.1, ends.0) } else { ends };
                match (from, to) {
                    (End::Node(from), End::Node(to)) => {
                        among[(to.index(), from.index())] += rate.abs();
                        streams = true;
                    }
                    (End::Boundary(b), End::Node(to)) => {
                        inputs[(to.index(), b.index())] += rate.abs();
                    }
                    (_, End::Boundary(_)) => {} // what flows away is not missed
                }
                continue;
            }
            let g = conductor.law.conductance_at(&mut scope)?;
            match (conductor.from, conductor.to) {
                (End::Node(a), End::Node(b)) => {
                    among[(a.index(), b.index())] += g;
                    among[(b.index(), a.index())] += g;
                }
                (End::Node(node), End::Boundary(b)) | (End::Boundary(b), End::Node(node)) => {
                    inputs[(node.index(), b.index())] += g;
                }
                (End::Boundary(_), End::Boundary(_)) => {} // no node feels it
            }
        }
        for (k, source) in network.sources().iter().enumerate() {
            source
                .into
                .iter()
                .for_each(|(node, share)| inputs[(node.index(), boundaries + k)] += share);
        }
        Ok(Self { among, inputs, boundaries, streams })
    }

    /// `G_mm^-1` times the conductances of massless nodes (rows) to states and inputs (columns).
    fn recovery(&self, massless: &[NodeId], states: &[NodeId]) -> Option<Mat<f64>> {
        let inputs = self.inputs.ncols();
        let given = Mat::from_fn(massless.len(), states.len() + inputs, |i, j| {
            let row = massless[i].index();
            states.get(j).map_or_else(
                || self.inputs[(row, j - states.len())],
                |s| self.among[(row, s.index())],
            )
        });
        if massless.is_empty() {
            return Some(given);
        }
        let total = |row: usize| -> f64 {
            let nodes: f64 = (0..self.among.ncols()).map(|j| self.among[(row, j)]).sum();
            nodes + (0..self.boundaries).map(|b| self.inputs[(row, b)]).sum::<f64>()
        };
        let own = Mat::from_fn(massless.len(), massless.len(), |i, j| {
            let (row, column) = (massless[i].index(), massless[j].index());
            if i == j { total(row) } else { -self.among[(row, column)] }
        });
        match self.streams {
            true => dense::solve(own.as_ref(), given.as_ref()),
            false => dense::cholesky_solve(own.as_ref(), given.as_ref()),
        }
    }

    /// Conductances between the states, and the effects of the inputs on them, without the massless
    /// nodes.
    fn eliminate(
        &self,
        massless: &[NodeId],
        states: &[NodeId],
        recovery: &Mat<f64>,
    ) -> (Mat<f64>, Mat<f64>) {
        let n = states.len();
        let direct = |i: usize, j: usize| {
            let row = states[i].index();
            states
                .get(j)
                .map_or_else(|| self.inputs[(row, j - n)], |s| self.among[(row, s.index())])
        };
        let mut all = Mat::from_fn(n, n + self.inputs.ncols(), direct);
        if !massless.is_empty() {
            let to_massless = Mat::from_fn(n, massless.len(), |i, m| {
                self.among[(states[i].index(), massless[m].index())]
            });
            all += dense::product(to_massless.as_ref(), recovery.as_ref());
        }
        (all.subcols(0, n).to_owned(), all.subcols(n, self.inputs.ncols()).to_owned())
    }
}

/// Capacity of every node: its own and that of its parts.
fn capacities(network: &Network) -> Result<Vec<f64>, EvalError> {
    let mut scope: Evaluation = network.evaluation();
    let mut capacity = Vec::with_capacity(network.nodes().len());
    for node in network.nodes() {
        capacity.push(node.capacity.as_ref().map_or(Ok(0.0), |c| c.at(&mut scope))?);
    }
    for part in network.capacitors() {
        capacity[part.node.index()] += part.capacity.at(&mut scope)?;
    }
    Ok(capacity)
}

/// Conductances between two states, from the coupling in both directions.
fn links(coupling: &Mat<f64>, both: fn(f64, f64) -> f64) -> Vec<(usize, usize, f64)> {
    let n = coupling.nrows();
    let pairs = (0..n).flat_map(|a| (a + 1..n).map(move |b| (a, b)));
    pairs
        .map(|(a, b)| (a, b, both(coupling[(a, b)], coupling[(b, a)])))
        .filter(|link| link.2 > 0.0)
        .collect()
}

/// Excess of the coupling of one state to another over that in the other direction.
fn streams(coupling: &Mat<f64>) -> Vec<(usize, usize, f64)> {
    let n = coupling.nrows();
    let pairs = (0..n).flat_map(|to| (0..n).map(move |from| (to, from)));
    pairs
        .map(|(to, from)| (to, from, coupling[(to, from)] - coupling[(from, to)]))
        .filter(|stream| stream.2 > 0.0)
        .collect()
}

/// The first item that is more than constant capacities, conductances and capacity rates.
fn first_beyond(network: &Network) -> Option<Item> {
    let linear = |id| network.conductance(id).is_some() || is_stream(network, id);
    let conductor = network.conductor_ids().find(|&id| !linear(id)).map(Item::Conductor);
    let source = network.source_ids().find(|id| !network.source_variables(*id).is_empty());
    let node = network.first_varying_capacity();
    conductor.or(source.map(Item::Source)).or(node.map(Item::Node))
}

fn is_stream(network: &Network, id: lptn_network::ConductorId) -> bool {
    matches!(network.flow(id), ConductorFlow::Stream(_))
}

fn not_linear(network: &Network, item: Item) -> ExactError {
    ExactError::NotLinear { name: network.name_of(item).into_owned() }
}
