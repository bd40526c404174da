//! Sensitivities of temperatures to parameters, along with the temperatures themselves.
//!
//! The variable of a node is `s = (dH/dp) / C0` in K per SI unit of the parameter, H its heat
//! content over its start and C0 its capacity there: then `C0 ds/dt = dq/dp` whatever depends on
//! the parameter, and `s = 0` at the start. The temperature follows from `dH/dp = C dT/dp + (change
//! of H at fixed T)`. Heat flows change by their derivatives at fixed temperatures, which the
//! network takes from its own laws on dual numbers, and by the exact Jacobian times `dT/dp`
//! (forward sensitivity analysis; A. C. Hindmarsh and R. Serban, User Documentation for CVODES,
//! section 2.6).
//!
//! This is valid whether the parameter is a capacity, a start temperature, a heat transfer
//! coefficient or the temperature of a boundary. Nothing is written twice: a new law has
//! sensitivities from the start. If the times of events move with a parameter, this derivative does
//! not exist. `sensitive_run` then takes central differences of runs and reports it.

use lptn_assembly::{JacobianForm, ThermalSystem, Workspace};
use lptn_integrate::Pattern;
use lptn_network::{ParameterId, Tangents};

use crate::error::TransientError;
use crate::newton::Newton;
use crate::newton_error::NewtonError;
use crate::settings_error::SettingsError;
use crate::unfold::Unfold;
use crate::unsolved::Unsolved;

/// Sensitivities of a system at one time. All arrays are blocks, one for each parameter.
pub(crate) struct Tangent<'a> {
    system: &'a ThermalSystem,
    parameters: Vec<ParameterId>,
    tangents: Tangents,
    pattern: Pattern,
    /// The exact Jacobian in W/K; empty until it is needed.
    jacobian: Vec<f64>,
    algebraic: Option<Newton<'a>>,
    /// Change of the heat into every vertex at fixed temperatures.
    heat: Vec<f64>,
    /// Change of the heat content of every node at its fixed temperature.
    contents: Vec<f64>,
    /// Sensitivity of the temperature of every unknown.
    unknowns: Vec<f64>,
    /// The Jacobian times those of one block.
    product: Vec<f64>,
}

impl<'a> Tangent<'a> {
    /// Set up for some parameters without duplicates.
    ///
    /// # Errors
    /// [`SettingsError::Sensitivity`] if the network has no derivatives by them.
    pub(crate) fn new(
        system: &'a ThermalSystem,
        parameters: &[ParameterId],
    ) -> Result<Self, TransientError> {
        let network = system.network();
        let tangents = network.tangents(parameters);
        let tangents =
            tangents.map_err(|e| TransientError::Settings(SettingsError::Sensitivity(e)))?;
        let (states, all) = (system.states().len(), system.unknowns().len());
        let failed = |error| TransientError::Start(Unsolved::new(system, error));
        let algebraic = (states < all).then(|| Newton::new(system, (states..all).collect()));
        let algebraic = algebraic.transpose().map_err(failed)?;
        let vertices = network.nodes().len() + network.boundaries().len();
        let blocks = |length: usize| vec![0.0; length * parameters.len()];
        Ok(Self {
            system,
            parameters: parameters.to_vec(),
            tangents,
            pattern: Pattern::from_symbolic(system.pattern().symbolic()),
            jacobian: Vec::new(),
            algebraic,
            heat: blocks(vertices),
            contents: blocks(network.nodes().len()),
            unknowns: blocks(all),
            product: vec![0.0; all],
        })
    }

    /// The parameters.
    pub(crate) fn parameters(&self) -> &[ParameterId] {
        &self.parameters
    }

    /// The variables at a start at the temperatures in `work`, which do not depend on the
    /// parameters. At the network's own start, whose temperatures may do so, they are zero.
    pub(crate) fn carried_at(&mut self, work: &Workspace, out: &mut [f64]) {
        self.take_contents(work);
        let system = self.system;
        let (states, nodes) = (system.states(), system.network().nodes().len());
        for (block, contents) in
            out.chunks_mut(states.len().max(1)).zip(self.contents.chunks(nodes.max(1)))
        {
            for ((s, id), capacity) in block.iter_mut().zip(states).zip(system.capacity()) {
                *s = contents[id.index()] / capacity;
            }
        }
    }

    fn take_contents(&mut self, work: &Workspace) {
        let temperatures = self.system.node_temperatures(work);
        self.tangents.contents(self.system.network(), temperatures, &mut self.contents);
    }

    /// Writes `C0 ds/dt` in W per SI unit of each parameter, from inputs read and nodes recovered
    /// in `work`.
    pub(crate) fn flow(
        &mut self,
        work: &mut Workspace,
        unfold: &Unfold<'_>,
        carried: &[f64],
        out: &mut [f64],
    ) -> Result<(), NewtonError> {
        self.take_states(work, unfold, carried);
        self.take_heat(work)?;
        self.take_jacobian(work, unfold)?;
        self.solve_algebraic(work, unfold)?;
        let states = self.system.states();
        let (all, vertices) = (self.system.unknowns().len(), self.vertices());
        for (k, block) in out.chunks_mut(states.len().max(1)).enumerate() {
            self.pattern.multiply(
                &self.jacobian,
                &self.unknowns[k * all..(k + 1) * all],
                &mut self.product,
            );
            let heat = &self.heat[k * vertices..(k + 1) * vertices];
            for ((q, id), product) in block.iter_mut().zip(states).zip(&self.product) {
                *q = heat[id.index()] + product;
            }
        }
        Ok(())
    }

    /// Takes the variables, from inputs read and nodes recovered in `work`;
    /// [`Tangent::vertices_of`] then gives the sensitivities of all nodes.
    pub(crate) fn recover(
        &mut self,
        work: &mut Workspace,
        unfold: &Unfold<'_>,
        carried: &[f64],
    ) -> Result<(), NewtonError> {
        self.take_states(work, unfold, carried);
        if self.system.has_massless() {
            self.take_heat(work)?;
        }
        if self.algebraic.is_some() {
            self.take_jacobian(work, unfold)?;
            self.solve_algebraic(work, unfold)?;
        }
        Ok(())
    }

    /// Sensitivities of all vertices by the parameter of number `k`, in K per SI unit: those of
    /// nodes.
    pub(crate) fn vertices_of(&self, k: usize, out: &mut Vec<f64>) {
        let (all, vertices) = (self.system.unknowns().len(), self.vertices());
        out.resize(vertices, 0.0);
        let heat = &self.heat[k * vertices..(k + 1) * vertices];
        self.system.recover_tangent(heat, &self.unknowns[k * all..(k + 1) * all], out);
    }

    fn vertices(&self) -> usize {
        self.heat.len() / self.parameters().len().max(1)
    }

    /// Sensitivities of the temperatures of all states.
    fn take_states(&mut self, work: &Workspace, unfold: &Unfold<'_>, carried: &[f64]) {
        self.take_contents(work);
        let system = self.system;
        let (states, nodes) = (system.states(), system.network().nodes().len());
        let blocks = self
            .unknowns
            .chunks_mut(system.unknowns().len().max(1))
            .zip(carried.chunks(states.len().max(1)));
        for ((block, carried), contents) in blocks.zip(self.contents.chunks(nodes.max(1))) {
            for (i, id) in states.iter().enumerate() {
                let held = contents[id.index()] / system.capacity()[i];
                block[i] = unfold.slopes()[i] * (carried[i] - held);
            }
        }
    }

    fn take_heat(&mut self, work: &Workspace) -> Result<(), NewtonError> {
        self.system
            .tangent_heat(&mut self.tangents, work, &mut self.heat)
            .map_err(NewtonError::Input)
    }

    fn take_jacobian(
        &mut self,
        work: &mut Workspace,
        unfold: &Unfold<'_>,
    ) -> Result<(), NewtonError> {
        if self.system.is_linear() && !self.jacobian.is_empty() {
            return Ok(());
        }
        self.jacobian.resize(self.pattern.len(), 0.0);
        let taken =
            self.system.jacobian_at(work, unfold.last(), JacobianForm::Exact, &mut self.jacobian);
        taken.map_err(NewtonError::Input)
    }

    /// Sensitivities of the massless nodes that were not eliminated: their balances are fulfilled
    /// for all parameters.
    fn solve_algebraic(
        &mut self,
        work: &mut Workspace,
        unfold: &Unfold<'_>,
    ) -> Result<(), NewtonError> {
        let Some(newton) = &mut self.algebraic else { return Ok(()) };
        newton.factorize(work, unfold.last(), 0.0)?;
        let system = self.system;
        let (states, all) = (system.states().len(), system.unknowns().len());
        let vertices = self.heat.len() / self.parameters.len().max(1);
        for (block, heat) in self.unknowns.chunks_mut(all.max(1)).zip(self.heat.chunks(vertices)) {
            block[states..].fill(0.0);
            self.pattern.multiply(&self.jacobian, block, &mut self.product);
            let rest = system.algebraic().iter().zip(&self.product[states..]);
            let mut left: Vec<f64> = rest.map(|(id, product)| heat[id.index()] + product).collect();
            newton.factors.solve_in_place(&mut left).map_err(NewtonError::Factorization)?;
            block[states..].copy_from_slice(&left);
        }
        Ok(())
    }
}
