//! Time constants of a network, with the shape of each mode and the part that each node has in it.

use lptn_network::{Network, NodeId};

use crate::exact::{ExactError, Island, Reduced, islands};
use crate::table::Table;

/// One way in which a network forgets: a pattern of temperatures that keeps its shape and dies away
/// as `exp(-t / tau)`.
#[derive(Clone, Debug, PartialEq)]
pub struct Mode {
    /// 1/tau in 1/s, not negative; exactly 0 where heat cannot leave.
    pub rate: f64,
    /// Temperature of every node relative to the largest, which is 1; massless nodes follow their
    /// neighbours.
    pub shape: Vec<f64>,
    /// The part of every node, from 0 to 1: `C x^2` over its sum, x the shape. Over the nodes of a
    /// mode it sums to 1, and over all modes of a node with capacity too; massless nodes have none.
    ///
    /// This is the participation factor of Pérez-Arriaga, Verghese and Schweppe (Selective modal
    /// analysis, part I, IEEE Trans. PAS-101 (1982) 3117): the product of an entry of the right
    /// eigenvector, x, and of the left one, C x here.
    pub participation: Vec<f64>,
}

impl Mode {
    /// The time constant in s; infinite for a mean temperature that nothing carries away.
    pub fn tau(&self) -> f64 {
        self.rate.recip()
    }
}

/// All modes of a network, slowest first: as many as it has nodes with capacity.
#[derive(Clone, Debug, PartialEq)]
pub struct Modes {
    modes: Vec<Mode>,
}

/// Entries of a shape that differ by less are equally large: the first of them is made 1.
const EQUAL: f64 = 1e-9;

impl Modes {
    /// Eigenvalues and vectors of `C^-1/2 G C^-1/2`, massless nodes eliminated. Inputs play no
    /// part.
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
        Ok(Self { modes })
    }

    /// The modes, slowest first.
    pub fn modes(&self) -> &[Mode] {
        &self.modes
    }

    /// Keeps the slowest `count`.
    pub fn truncate(&mut self, count: usize) {
        self.modes.truncate(count);
    }

    /// One row a mode: `tau`, then `NAME.shape` and `NAME.participation` of every node.
    pub fn table(&self, network: &Network) -> Table {
        let mut table = Table::of(&self.modes);
        table.column("tau", "s", Mode::tau);
        for (i, node) in network.nodes().iter().enumerate() {
            table.column(format!("{}.shape", node.name), "-", |m| m.shape[i]);
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
        Some(Mode { rate, shape: normalised(self.shape(&of_states)), participation })
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
