//! A network as its element list says it, massless nodes eliminated by dense algebra.
//!
//! Written apart from `lptn-assembly` on purpose: it reads the laws of the conductors and the parts
//! of the nodes anew and eliminates with a Cholesky factorisation, where the assembly uses the
//! star-mesh transformation. With m the massless nodes, r the others, u the boundaries and g >= 0
//! the conductances between two vertices, the balance of the massless nodes is
//! `G_mm T_m = g_mr T_r + g_mu T_u + q_m`. Put into the balances of the others it adds
//! `g_rm G_mm^-1 g_mr` to the conductances between them: sums and products of numbers that are not
//! negative, so that nothing cancels.

use faer::Mat;
use lptn_integrate::dense;
use lptn_network::{End, Evaluation, Network, NodeId};
use lptn_units::EvalError;

use super::ExactError;

/// Nodes with capacity (states), what joins them, and what the inputs do to them. The inputs are
/// the boundaries, then the sources.
#[derive(Clone, Debug)]
pub(crate) struct Reduced {
    pub(crate) states: Vec<NodeId>,
    /// Heat capacity of each state in J/K.
    pub(crate) capacity: Vec<f64>,
    /// Conductances in W/K between states, `a < b`, positive.
    pub(crate) links: Vec<(usize, usize, f64)>,
    /// Heat into a state (row) per K of a boundary above it, or its share of a source (columns).
    pub(crate) feeds: Mat<f64>,
    pub(crate) massless: Vec<NodeId>,
    /// Temperature of a massless node (row) per unit of each state, then of each input (columns).
    pub(crate) recovery: Mat<f64>,
}

/// What the element list holds: conductances, and where the inputs act.
struct Elements {
    /// Conductances between nodes, symmetric, zero on the diagonal.
    among: Mat<f64>,
    /// For each node (row) conductances to the boundaries, then 1 for the sources that heat it.
    inputs: Mat<f64>,
    boundaries: usize,
}

impl Reduced {
    /// The largest number of nodes: eigenvalues of matrices beyond it take minutes.
    pub(crate) const MOST_NODES: usize = 2000;

    pub(crate) fn new(network: &Network) -> Result<Self, ExactError> {
        let nodes = network.nodes().len();
        if nodes > Self::MOST_NODES {
            return Err(ExactError::TooLarge { nodes });
        }
        if let Some(item) = network.first_nonlinear() {
            return Err(ExactError::NotLinear { name: network.name_of(item).into_owned() });
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
        let links = links(&coupling);
        Ok(Self { states, capacity, links, feeds, massless, recovery })
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
        for conductor in network.conductors() {
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
        Ok(Self { among, inputs, boundaries })
    }

    /// `G_mm^-1` times what the massless nodes (rows) get from each state and input (columns).
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
        dense::cholesky_solve(own.as_ref(), given.as_ref())
    }

    /// Conductances between the states, and what the inputs do to them, with the massless nodes
    /// gone.
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

fn links(coupling: &Mat<f64>) -> Vec<(usize, usize, f64)> {
    let n = coupling.nrows();
    let pairs = (0..n).flat_map(|a| (a + 1..n).map(move |b| (a, b)));
    pairs
        .map(|(a, b)| (a, b, 0.5 * (coupling[(a, b)] + coupling[(b, a)])))
        .filter(|link| link.2 > 0.0)
        .collect()
}
