//! Heat that drives the sensitivities of a system to parameters of its network.
//!
//! Temperatures that change by `s` per unit of a parameter obey the balances with the Jacobian as
//! conductances and with the change of every heat flow at fixed temperatures as a source: massless
//! nodes pass that source on as they do heat.

use lptn_network::{InputError, Tangents};

use crate::element::JacobianForm;
use crate::system::ThermalSystem;
use crate::workspace::Workspace;

impl ThermalSystem {
    /// Writes the change of the heat into every vertex in W per SI unit of each parameter, at fixed
    /// temperatures, with that of eliminated nodes passed on: a block per parameter, a value per
    /// vertex. From inputs read and nodes recovered.
    ///
    /// # Errors
    /// [`InputError`] for a value that has no finite derivative here.
    pub fn tangent_heat(
        &self,
        tangents: &mut Tangents,
        work: &Workspace,
        out: &mut [f64],
    ) -> Result<(), InputError> {
        tangents.heat(self.network(), &work.scope, &work.temperature, out)?;
        out.chunks_mut(work.temperature.len())
            .for_each(|block| self.elimination().distribute(block));
        Ok(())
    }

    /// Adds the change of the sum of those heats, each times a weight for its vertex, per SI unit of
    /// each parameter, before they are passed on. From inputs read and nodes recovered.
    ///
    /// # Errors
    /// As [`ThermalSystem::tangent_heat`].
    pub fn add_tangent_heat(
        &self,
        tangents: &mut Tangents,
        work: &Workspace,
        weights: &[f64],
        out: &mut [f64],
    ) -> Result<(), InputError> {
        let at = (&work.scope, &work.temperature[..]);
        tangents.add_heat_against(self.network(), at, weights, out)
    }

    /// Writes the exact Jacobian, as [`ThermalSystem::jacobian_at`], and keeps the changes of heats by
    /// the parameters if evaluations serve both. From inputs read and nodes recovered. True if they
    /// are kept; those that fail are not.
    ///
    /// # Errors
    /// As [`ThermalSystem::jacobian_at`].
    pub fn linearise(
        &self,
        (work, y): (&mut Workspace, &[f64]),
        tangents: &mut Tangents,
        values: &mut [f64],
    ) -> Result<bool, InputError> {
        let kept = tangents.shares_slopes()
            && tangents.keep_heats(self.network(), &work.scope, &work.temperature).is_ok();
        let tangents = &*tangents;
        let known = |id| if kept { tangents.kept_slopes(id) } else { None };
        self.jacobian_with((work, y), JacobianForm::Exact, &known, values)?;
        Ok(kept)
    }

    /// True if temperatures of nodes follow from others without storage: then their sensitivities
    /// need [`ThermalSystem::tangent_heat`] too.
    pub fn has_massless(&self) -> bool {
        !(self.elimination().is_empty() && self.algebraic().is_empty())
    }

    /// Writes the sensitivities of all vertices in K per SI unit of one parameter from those of the
    /// unknowns, and from the block of [`ThermalSystem::tangent_heat`] that belongs to it.
    /// Boundaries get 0: their changes are in that block.
    pub fn recover_tangent(&self, heat: &[f64], unknowns: &[f64], out: &mut [f64]) {
        out.fill(0.0);
        unknowns.iter().zip(self.unknowns()).for_each(|(s, id)| out[id.index()] = *s);
        self.elimination().recover(heat, out);
    }

    /// Hands weights of the temperatures of all vertices on to the unknowns. It is the transpose of
    /// [`ThermalSystem::recover_tangent`] without heat: an eliminated node follows its neighbours by
    /// the shares in which it hands heat on to them.
    pub fn hand_on(&self, weights: &mut [f64]) {
        self.elimination().distribute(weights);
    }
}
