//! Heat of elements and the pieces of tables and kinks that they go through, for steps that carry
//! temperatures over a range.

use std::sync::Arc;

use lptn_network::{Evaluation, Formula, InputError, Value};
use lptn_units::Program;

use crate::element::Kind;
use crate::system::ThermalSystem;
use crate::workspace::Workspace;

impl ThermalSystem {
    /// Number of elements that are neither a constant conductance nor radiation of a constant area.
    pub fn element_count(&self) -> usize {
        self.elements.len()
    }

    /// True if the heat of an element may have kinks over temperature.
    pub fn has_pieces(&self, element: usize) -> bool {
        let law = match self.elements[element].kind {
            Kind::Stream(..) => return false,
            Kind::Conductor(id) => &self.network.conductors()[id.index()].law,
            Kind::Source(id) => &self.network.sources()[id.index()].law,
        };
        let plain = [
            Formula::Resistance,
            Formula::Conductance,
            Formula::Film,
            Formula::ExchangeArea,
            Formula::Given,
            Formula::CapacityRate,
            // bodies in which heat spreads are proportional to their conductivity
            Formula::Slab,
            Formula::Cylinder,
            Formula::Sphere,
            Formula::Rod,
        ];
        let bends = |program: &Arc<Program>| {
            !(program.kinks().is_empty() && program.table_calls().is_empty())
        };
        !plain.contains(&law.formula())
            || law.fluid().is_some()
            || law.values().iter().flat_map(Value::programs).any(bends)
    }

    /// A number for the pieces of tables, kinks and laws that the heat of an element goes through,
    /// from inputs read and temperatures placed; 0 if there is only one. The number is another on
    /// the other side of a kink.
    ///
    /// # Errors
    /// As [`ThermalSystem::flow`].
    pub fn pieces(&self, work: &mut Workspace, element: usize) -> Result<u64, InputError> {
        let kind = self.elements[element].kind;
        let (scope, temperature) = work.current();
        match kind {
            Kind::Stream(..) => Ok(0),
            Kind::Conductor(id) => self.network.pieces_of_exchange(id, scope, temperature),
            Kind::Source(id) => self.network.pieces_of_source(id, scope, temperature),
        }
    }

    /// Adds the heat of an element to that of every vertex in W, from inputs read and temperatures
    /// placed.
    ///
    /// # Errors
    /// As [`ThermalSystem::flow`].
    pub fn add_heat_of(
        &self,
        work: &mut Workspace,
        element: usize,
        heat: &mut [f64],
    ) -> Result<(), InputError> {
        let element = &self.elements[element];
        if let Kind::Source(id) = element.kind {
            let (scope, temperature) = work.current();
            let power = self.network.source_heat(id, scope, temperature)?;
            for (&vertex, share) in element.receivers.iter().zip(element.shares()) {
                heat[vertex as usize] += share * power;
            }
            return Ok(());
        }
        let received = element.received(&self.network, work)?;
        for (&vertex, q) in element.receivers.iter().zip(received) {
            heat[vertex as usize] += q;
        }
        Ok(())
    }

    /// Temperatures of all vertices in K, nodes then boundaries, as last placed.
    pub fn vertex_temperatures<'a>(&self, work: &'a Workspace) -> &'a [f64] {
        &work.temperature
    }

    /// Takes the temperatures of all vertices in K.
    pub fn place_vertices(&self, work: &mut Workspace, temperatures: &[f64]) {
        work.temperature.copy_from_slice(temperatures);
    }

    /// Values that expressions read in addition to temperatures, as last read.
    pub fn scope<'a>(&self, work: &'a mut Workspace) -> &'a Evaluation {
        work.current().0
    }
}
