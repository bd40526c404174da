//! Capacities that follow states.
//!
//! The mass matrix is constant: it has the capacity C0 of the start. A node with the capacity C at
//! the moment obeys `C dT/dt = q`. Its row is multiplied by `C0 / C`, in the flow and in the
//! Jacobian. Heats of paths, sources and boundaries stay those of the network.

use lptn_network::{InputError, Network, NodeId, StateCapacity};

use crate::element::slot;
use crate::pattern::JacobianPattern;
use crate::system::ThermalSystem;
use crate::workspace::Workspace;

/// A node whose capacity follows states.
#[derive(Clone, Debug)]
pub(crate) struct Scaled {
    of: StateCapacity,
    unknown: usize,
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
}

impl ThermalSystem {
    /// Multiplies the rows of nodes whose capacity follows states.
    pub(crate) fn scale_flow(
        &self,
        work: &mut Workspace,
        flow: &mut [f64],
    ) -> Result<(), InputError> {
        for scaled in self.scaled.iter() {
            let Workspace { scope, temperature, .. } = &mut *work;
            let now = self.network().capacity_at(&scaled.of, scope, temperature)?;
            flow[scaled.unknown] *= scaled.start / now;
        }
        Ok(())
    }

    /// The same for the Jacobian, with the derivatives by the states.
    pub(crate) fn scale_slopes(
        &self,
        work: &mut Workspace,
        y: &[f64],
        values: &mut [f64],
    ) -> Result<(), InputError> {
        if self.scaled.is_empty() {
            return Ok(());
        }
        let mut flow = vec![0.0; self.unknowns().len()];
        self.heat_flow(work, y, &mut flow)?;
        let mut slopes = Vec::new();
        for scaled in self.scaled.iter() {
            let Workspace { scope, temperature, .. } = &mut *work;
            let network = self.network();
            let now = network.capacity_slopes(&scaled.of, scope, temperature, &mut slopes)?;
            let factor = scaled.start / now;
            scaled.row.iter().for_each(|slot| values[*slot] *= factor);
            for (slot, slope) in scaled.columns.iter().zip(&slopes) {
                values[*slot as usize] -= flow[scaled.unknown] * factor / now * slope;
            }
        }
        Ok(())
    }

    /// Heat content in J over the temperature of the start of each of
    /// [`Network::state_capacities`], at the temperatures `y` of the states in K.
    ///
    /// # Errors
    /// [`InputError`] if a capacity has no value.
    pub fn contents(&self, work: &mut Workspace, y: &[f64]) -> Result<Vec<f64>, InputError> {
        self.put(work, y);
        let one = |scaled: &Scaled| {
            let Workspace { scope, temperature, .. } = &mut *work;
            let capacity = self.network().capacity_at(&scaled.of, scope, temperature)?;
            Ok(capacity * self.rise(scaled.of.node, y[scaled.unknown]))
        };
        self.scaled.iter().map(one).collect()
    }

    /// Writes the heat in W, over the temperature of the start, that comes into each of
    /// [`Network::state_capacities`] with its mass, from the sources last evaluated: the change of
    /// its capacity times its rise.
    ///
    /// # Errors
    /// As [`ThermalSystem::contents`].
    pub fn mass_heat(
        &self,
        work: &mut Workspace,
        y: &[f64],
        heat: &mut [f64],
    ) -> Result<(), InputError> {
        let mut slopes = Vec::new();
        for (heat, scaled) in heat.iter_mut().zip(self.scaled.iter()) {
            let Workspace { scope, temperature, power, .. } = &mut *work;
            let network = self.network();
            network.capacity_slopes(&scaled.of, scope, temperature, &mut slopes)?;
            let changes = scaled.of.states.iter().zip(&slopes).map(|(state, slope)| {
                let source = network.state_at(*state).and_then(|state| state.source);
                source.map_or(0.0, |id| slope * power[id.index()])
            });
            *heat = changes.sum::<f64>() * self.rise(scaled.of.node, y[scaled.unknown]);
        }
        Ok(())
    }

    /// The rise of a node over its start, in K.
    fn rise(&self, node: NodeId, temperature: f64) -> f64 {
        temperature - self.network().initial(node)
    }
}
