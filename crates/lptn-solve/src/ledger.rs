//! The energy ledger of a run: what went in, what went out, what is stored.

use lptn_assembly::{ThermalSystem, Workspace};
use lptn_network::Network;

/// Heat turned over during a run, in J.
///
/// It proves book-keeping, not accuracy: a run at a coarse tolerance closes its books as well.
#[derive(Clone, Debug, PartialEq)]
pub struct Ledger {
    /// Heat of each source, positive into the network.
    pub sources: Vec<f64>,
    /// Heat that each boundary gave to the network.
    pub boundaries: Vec<f64>,
    /// Heat that each node stored: its capacity times its rise.
    pub stored: Vec<f64>,
    /// Integral of the absolute heat of every source and boundary, plus the absolute heat stored by each node.
    pub turned_over: f64,
    /// What may remain of the heat turned over: `1e-8 + 10 tolerance C_max / turned_over` summed over the nodes.
    pub bound: f64,
}

impl Ledger {
    pub(crate) fn new(network: &Network, integrals: &[f64], stored: Vec<f64>, tolerance: f64) -> Self {
        let (sources, rest) = integrals.split_at(network.sources().len());
        let (boundaries, turned) = rest.split_at(network.boundaries().len());
        let turned_over = turned.iter().sum::<f64>() + stored.iter().map(|q| q.abs()).sum::<f64>();
        let capacity: f64 = network.node_ids().map(|id| network.capacity(id)).sum();
        let bound = 1e-8 + 10.0 * tolerance * capacity / turned_over;
        Self { sources: sources.to_vec(), boundaries: boundaries.to_vec(), stored, turned_over, bound }
    }

    /// Sources plus boundaries less stored heat, in J: zero but for rounding and what Newton's method left.
    pub fn residual(&self) -> f64 {
        let sum = |q: &[f64]| q.iter().sum::<f64>();
        sum(&self.sources) + sum(&self.boundaries) - sum(&self.stored)
    }

    /// The residual over the heat turned over; `None` where no heat was turned over.
    pub fn relative_residual(&self) -> Option<f64> {
        (self.turned_over > 0.0).then(|| self.residual() / self.turned_over)
    }

    /// Whether the books close as far as they must.
    pub fn closes(&self) -> bool {
        self.relative_residual().is_none_or(|r| r.abs() <= self.bound)
    }
}

/// Number of running integrals a run of `network` needs.
pub(crate) fn integrals(network: &Network) -> usize {
    network.sources().len() + network.boundaries().len() + 1
}

/// The integrands at the inputs of `work` and the states `y`: sources, boundaries, sum of absolute values, in W.
pub(crate) fn integrands(system: &ThermalSystem, work: &Workspace, y: &[f64], q: &mut [f64]) {
    let powers = system.source_powers(work);
    let (sources, rest) = q.split_at_mut(powers.len());
    sources.copy_from_slice(powers);
    let last = rest.len() - 1;
    system.boundary_heat(work, y, &mut rest[..last]);
    rest[last] = sources.iter().chain(&rest[..last]).map(|q| q.abs()).sum();
}
