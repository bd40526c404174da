//! Capacities that follow states.
//!
//! The mass matrix is constant: it has the capacity C0 of the start. A node with the capacity C at
//! the moment obeys `C dT/dt = q`. Its row is multiplied by `C0 / C`, in the flow and in the
//! Jacobian. Heats of paths, sources and boundaries stay those of the network.

use lptn_network::{InputError, Network, StateCapacity};

use crate::element::slot;
use crate::pattern::JacobianPattern;
use crate::workspace::Workspace;

/// A node whose capacity follows states.
#[derive(Clone, Debug)]
pub(crate) struct Scaled {
    pub(crate) of: StateCapacity,
    pub(crate) unknown: usize,
    /// Capacity at the start in J/K.
    start: f64,
    /// The slots of its row.
    row: Vec<usize>,
    /// The slots of the states in its row.
    columns: Vec<u32>,
}

impl Scaled {
    /// The pairs of unknowns that meet in the rows of these nodes.
    pub(crate) fn pairs<'a>(
        network: &'a Network,
        number: &'a [u32],
    ) -> impl Iterator<Item = (u32, u32)> + 'a {
        let one = move |of: &'a StateCapacity| {
            let row = number[of.node.index()];
            of.states.iter().map(move |state| (row, number[state.index()]))
        };
        network.state_capacities().iter().flat_map(one)
    }

    /// All of a network.
    pub(crate) fn all_of(
        network: &Network,
        number: &[u32],
        pattern: &JacobianPattern,
    ) -> Vec<Self> {
        let one = |of: &StateCapacity| {
            let row = number[of.node.index()];
            let columns = of.states.iter().map(|state| slot(pattern, row, number[state.index()]));
            Self {
                of: of.clone(),
                unknown: row as usize,
                start: network.capacity(of.node),
                row: pattern.row(row as usize),
                columns: columns.collect(),
            }
        };
        network.state_capacities().iter().map(one).collect()
    }

    /// Multiplies its heat flow, at the temperatures in `work`.
    pub(crate) fn scale_flow(
        &self,
        network: &Network,
        work: &mut Workspace,
        flow: &mut [f64],
    ) -> Result<(), InputError> {
        let Workspace { scope, temperature, .. } = work;
        let now = network.capacity_at(&self.of, scope, temperature)?;
        flow[self.unknown] *= self.start / now;
        Ok(())
    }

    /// Multiplies its row of the Jacobian, with the derivatives by the states; `flow` is that of
    /// heat in W.
    pub(crate) fn scale_slopes(
        &self,
        network: &Network,
        work: &mut Workspace,
        (flow, values): (&[f64], &mut [f64]),
    ) -> Result<(), InputError> {
        let Workspace { scope, temperature, .. } = work;
        let mut slopes = Vec::new();
        let now = network.capacity_slopes(&self.of, scope, temperature, &mut slopes)?;
        let factor = self.start / now;
        self.row.iter().for_each(|slot| values[*slot] *= factor);
        for (slot, slope) in self.columns.iter().zip(&slopes) {
            values[*slot as usize] -= flow[self.unknown] * factor / now * slope;
        }
        Ok(())
    }
}
