//! Time constants of a network, with the shape of each mode and the part that each node has in it.

mod near;

pub(crate) use near::{Shapes, shapes};

use lptn_integrate::FactorError;
use lptn_integrate::lanczos::LanczosError;
use lptn_network::{Network, NodeId};

use crate::exact::{ExactError, Island, Reduced, islands};
use crate::linearised::{LinearisedError, Tried};
use crate::table::Table;

/// One decay of a network: a pattern of temperatures that keeps its shape and dies away as `exp(-t
/// / tau)`.
#[derive(Clone, Debug, PartialEq)]
pub struct Mode {
    /// 1/tau in 1/s; exactly 0 if heat cannot leave, negative if a disturbance grows.
    pub rate: f64,
    /// Angular frequency in rad/s: 0 except for a pair of modes that oscillate by streams or
    /// slopes, `exp(-t / tau) cos(omega t + phase)`.
    pub omega: f64,
    /// Temperature of every node relative to the largest, which is 1; massless nodes follow their
    /// neighbours. Amplitudes if it oscillates.
    pub shape: Vec<f64>,
    /// Lead of each node over that with the largest amplitude, in rad from -pi to pi; empty if
    /// nothing oscillates.
    pub phase: Vec<f64>,
    /// The part of every node, from 0 to 1: `C x^2` over its sum, x the shape. Over the nodes of a
    /// mode it sums to 1, and over all modes of a node with capacity too; massless nodes have none.
    ///
    /// This is the participation factor of Pérez-Arriaga, Verghese and Schweppe (Selective modal
    /// analysis, part I, IEEE Trans. PAS-101 (1982) 3117): the product of an entry of the right
    /// eigenvector, x, and of the left one, C x if the network is symmetric. If it is not, the
    /// magnitudes of the products, over their sum.
    pub participation: Vec<f64>,
}

impl Mode {
    /// The time constant in s; infinite for a mean temperature that nothing carries away.
    pub fn tau(&self) -> f64 {
        self.rate.recip()
    }
}

/// Modes of a network, slowest first.
#[derive(Clone, Debug, PartialEq)]
pub struct Modes {
    modes: Vec<Mode>,
    /// Number of all modes, computed or not.
    all: usize,
    /// Comparison with the full network, if the linear network represents another near a state.
    tried: Option<Tried>,
}

lptn_units::errors! {
/// Reason why the modes of a network near a state are not known.
#[derive(Clone, Debug)]
pub enum ModesError {
    /// The dense eigenproblem of a network of constants.
    Exact => ExactError;
    /// It cannot be linearised there.
    Linearised => LinearisedError;
    /// Too many nodes with capacity for a network without symmetry.
    TooLarge { nodes: usize } = "modes::too_large",
        format!("{nodes} nodes with capacity are more than the 2000 of a network with streams or \
            slopes whose modes are found"),
        help "lump nodes until there are at most 2000, or let `lptn run` show how long each node \
            takes";
    /// Modes coincide: the network has fewer than it has nodes.
    Defective = "modes::defective",
        "modes coincide: a chain of like cells that a stream passes one way does not decay by \
            exponentials alone",
        help "`lptn impedance` shows how long each node takes";
    /// The eigenvalues were not found.
    NotFound = "modes::not_found", "the time constants of the network were not found",
        help crate::exact::MERGE, class lptn_units::Class::Numbers;
    /// The conductances cannot be factorised.
    Factorization(error: FactorError) = "modes::not_found", error, source error,
        help crate::exact::MERGE, class lptn_units::Class::Numbers;
}
}

impl From<LanczosError> for ModesError {
    fn from(error: LanczosError) -> Self {
        match error {
            LanczosError::Operator(error) => Self::Factorization(error),
            LanczosError::Stalled => Self::NotFound,
        }
    }
}

impl From<FactorError> for ModesError {
    fn from(error: FactorError) -> Self {
        Self::Factorization(error)
    }
}

/// Entries of a shape that differ by less are equally large: the first of them is made 1.
const EQUAL: f64 = 1e-9;

impl Modes {
    /// Eigenvalues and vectors of `C^-1/2 G C^-1/2`, massless nodes eliminated. Inputs have no
    /// effect.
    ///
    /// # Errors
    /// [`ExactError::TooLarge`] for more than 2000 nodes; [`ExactError`] if the numbers fail.
    pub fn solve(network: &Network) -> Result<Self, ExactError> {
        let reduced = Reduced::new(network)?;
        let islands = islands(&reduced, network.boundaries().len())?;
        let view = View { reduced: &reduced, nodes: network.nodes().len() };
        let of_island = |island| (0..).map_while(move |k| view.mode(island, k));
        let mut modes: Vec<Mode> = islands.iter().flat_map(of_island).collect();
        modes.sort_by(|a, b| a.rate.total_cmp(&b.rate));
        Ok(Self { all: modes.len(), modes, tried: None })
    }

    /// The modes, slowest first.
    pub fn modes(&self) -> &[Mode] {
        &self.modes
    }

    /// Number of all modes: a pair that oscillates counts once.
    pub fn all(&self) -> usize {
        self.all
    }

    /// Comparison of the linear network of these modes with the full one; `None` for a network that
    /// is linear itself.
    pub fn tried(&self) -> Option<Tried> {
        self.tried
    }

    /// Keeps the slowest `count`.
    pub fn truncate(&mut self, count: usize) {
        self.modes.truncate(count);
    }

    /// True if one of them oscillates.
    pub fn swing(&self) -> bool {
        self.modes.iter().any(|mode| mode.omega != 0.0)
    }

    /// One row per mode: `tau`, then `NAME.shape` and `NAME.participation` of every node. If one
    /// oscillates also `omega`, and `NAME.phase` after the shapes.
    pub fn table(&self, network: &Network) -> Table {
        let mut table = Table::of(&self.modes);
        let swing = self.swing();
        table.column("tau", "s", Mode::tau);
        if swing {
            table.column("omega", "rad/s", |m| m.omega);
        }
        for (i, node) in network.nodes().iter().enumerate() {
            table.column(format!("{}.shape", node.name), "-", |m| m.shape[i]);
            if swing {
                let phase = |m: &Mode| m.phase.get(i).copied().unwrap_or(0.0);
                table.column(format!("{}.phase", node.name), "rad", phase);
            }
            table.column(format!("{}.participation", node.name), "-", |m| m.participation[i]);
        }
        table.done()
    }
}

#[derive(Clone, Copy)]
struct View<'a> {
    reduced: &'a Reduced,
    nodes: usize,
}

impl View<'_> {
    fn mode(&self, island: &Island, k: usize) -> Option<Mode> {
        let rate = *island.rates.get(k)?;
        let mut of_states = vec![0.0; self.reduced.states.len()];
        let mut participation = vec![0.0; self.nodes];
        for (row, &state) in island.members.iter().enumerate() {
            let x = island.shapes[(row, k)];
            of_states[state] = x;
            participation[self.reduced.states[state].index()] =
                self.reduced.capacity[state] * x * x;
        }
        let shape = normalised(self.shape(&of_states));
        Some(Mode { rate, omega: 0.0, shape, phase: Vec::new(), participation })
    }

    fn shape(&self, of_states: &[f64]) -> Vec<f64> {
        let mut shape = vec![0.0; self.nodes];
        let mut put = |id: NodeId, x: f64| shape[id.index()] = x;
        self.reduced.states.iter().zip(of_states).for_each(|(&id, &x)| put(id, x));
        for (m, &id) in self.reduced.massless.iter().enumerate() {
            put(
                id,
                of_states.iter().enumerate().map(|(j, x)| self.reduced.recovery[(m, j)] * x).sum(),
            );
        }
        shape
    }
}

/// The same pattern with 1 as its largest entry, the first of those that are equally large.
fn normalised(mut shape: Vec<f64>) -> Vec<f64> {
    let largest = shape.iter().fold(0.0, |largest, x| f64::max(largest, x.abs()));
    let first = shape.iter().copied().find(|x| x.abs() >= (1.0 - EQUAL) * largest);
    if let Some(first) = first.filter(|x| *x != 0.0) {
        shape.iter_mut().for_each(|x| *x /= first);
    }
    shape
}

/// The parts of the states over their sum, among all nodes.
fn participation(states: &[NodeId], parts: &[f64], nodes: usize) -> Vec<f64> {
    let all: f64 = parts.iter().sum();
    let mut participation = vec![0.0; nodes];
    states.iter().zip(parts).for_each(|(id, part)| participation[id.index()] = part / all);
    participation
}
