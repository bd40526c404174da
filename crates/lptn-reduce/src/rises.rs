//! Rises from heat alone: `G x = b` with every boundary at zero.

use lptn_assembly::{ThermalSystem, Workspace};
use lptn_solve::Conductances;

use crate::error::ReduceError;

/// Temperatures over boundaries that are all at zero.
pub(crate) struct Rises<'a> {
    system: &'a ThermalSystem,
    work: Workspace,
    conductances: Conductances<'a>,
    still: Vec<f64>,
}

impl<'a> Rises<'a> {
    /// Factorises the conductances; heat may go in only where a path leads to a boundary.
    pub(crate) fn new(system: &'a ThermalSystem) -> Result<Self, ReduceError> {
        if let Some(item) = system.network().first_nonlinear() {
            return Err(ReduceError::NotLinear {
                name: system.network().name_of(item).into_owned(),
            });
        }
        let still = vec![0.0; system.network().boundaries().len()];
        Ok(Self {
            system,
            work: system.workspace(),
            conductances: Conductances::new(system)?,
            still,
        })
    }

    /// Rise of every node in K for these heats into the nodes in W.
    pub(crate) fn of_nodes(&mut self, heat: &[f64]) -> Result<Vec<f64>, ReduceError> {
        self.system.apply(&mut self.work, heat, &self.still);
        let states = self.conductances.states(&self.work, 0.0, Conductances::REFINEMENTS)?;
        self.system.recover(&mut self.work, &states);
        Ok(self.system.node_temperatures(&self.work).to_vec())
    }

    /// Rise of every state in K for these heats into the states in W, refined once.
    pub(crate) fn of_states(&mut self, heat: &[f64]) -> Result<Vec<f64>, ReduceError> {
        let mut nodes = vec![0.0; self.system.network().nodes().len()];
        self.system.states().iter().zip(heat).for_each(|(id, q)| nodes[id.index()] = *q);
        self.system.apply(&mut self.work, &nodes, &self.still);
        Ok(self.conductances.states(&self.work, 0.0, 1)?)
    }

    /// Heat that every boundary takes in W at the rises last asked for by [`Rises::of_nodes`].
    pub(crate) fn boundary_heat(&self) -> Vec<f64> {
        let mut heat = vec![0.0; self.still.len()];
        let mut states = vec![0.0; self.system.states().len()];
        self.system.unknown_temperatures(self.system.node_temperatures(&self.work), &mut states);
        self.system.linear_boundary_heat(&self.work, &states, &mut heat);
        heat.iter_mut().for_each(|q| *q = -*q);
        heat
    }
}
