//! The heat that boundaries give, streams carry and conductors pass on, after the temperatures are
//! known.
//!
//! The heat of boundaries is summed over the links that remain after the elimination, not over the
//! conductors as written. A boundary joined to a massless node by 1e9 W/K would be the difference
//! of two temperatures that agree to the last digit. The energy balance therefore does not test the
//! elimination; closed forms and random networks do.

use lptn_network::{ConductorId, InputError, Item, Received, SourceId, Surface};

use crate::system::ThermalSystem;
use crate::workspace::Workspace;

impl ThermalSystem {
    /// Writes the heat that each boundary gives to the network in W, from the inputs last read and
    /// the temperatures `y` of the unknowns in K; and keeps the heat of sources that depend on
    /// temperatures.
    ///
    /// The sum runs over the same links as [`ThermalSystem::flow`], after the elimination: a
    /// boundary next to a massless node through a large conductance would otherwise be the
    /// difference of two temperatures that are equal to the last digit.
    ///
    /// # Errors
    /// As [`ThermalSystem::flow`].
    pub fn boundary_heat(
        &self,
        work: &mut Workspace,
        y: &[f64],
        heat: &mut [f64],
    ) -> Result<(), InputError> {
        self.linear_boundary_heat(work, y, heat);
        if !self.is_linear() {
            let nodes = self.network.nodes().len();
            self.evaluate_outer(work, y)?;
            heat.iter_mut()
                .zip(&work.element_heat[nodes..])
                .for_each(|(q, received)| *q -= received);
        }
        Ok(())
    }

    /// Adds the heat of an element, which may have been evaluated with others.
    pub(crate) fn add_known(&self, work: &mut Workspace, element: usize) -> Result<(), InputError> {
        match work.together.get(element) {
            Some(heat) if !heat.is_nan() => {
                let [from, to] = self.elements[element].receivers[..] else { return Ok(()) };
                let heat = *heat;
                work.element_heat[from as usize] += -heat;
                work.element_heat[to as usize] += heat;
                Ok(())
            }
            _ => self.elements[element].add_heat(&self.network, work),
        }
    }

    /// Evaluates sources that depend on temperatures, and the heat of elements into boundaries; that
    /// into nodes is not whole.
    fn evaluate_outer(&self, work: &mut Workspace, y: &[f64]) -> Result<(), InputError> {
        self.put(work, y);
        work.element_heat.fill(0.0);
        for &i in &self.outer.radiation {
            self.radiation[i as usize].add_heat(&work.temperature, &mut work.element_heat);
        }
        self.together.evaluate(work, self.elements.len(), true);
        self.outer.elements.iter().try_for_each(|&i| self.add_known(work, i as usize))
    }

    /// The part of [`ThermalSystem::boundary_heat`] that constant conductances carry: all of it for
    /// a linear system.
    pub fn linear_boundary_heat(&self, work: &Workspace, y: &[f64], heat: &mut [f64]) {
        let nodes = self.network.nodes().len();
        for (q, share) in heat.iter_mut().zip(&work.heat[nodes..]) {
            *q = -share; // the heat that massless nodes pass on to it
        }
        for tie in self.ties.iter() {
            let boundary = tie.b as usize;
            heat[boundary - nodes] += tie.g * (work.temperature[boundary] - y[tie.a as usize]);
        }
        for bridge in self.bridges.iter() {
            let (a, b) = (bridge.a as usize, bridge.b as usize);
            let q = bridge.g * (work.temperature[a] - work.temperature[b]);
            heat[a - nodes] += q;
            heat[b - nodes] -= q;
        }
    }

    /// The heat of a source in W at the inputs last read and the temperatures `y` of the unknowns.
    ///
    /// # Errors
    /// As [`ThermalSystem::flow`].
    pub fn source_heat(
        &self,
        work: &mut Workspace,
        id: SourceId,
        y: &[f64],
    ) -> Result<f64, InputError> {
        if self.network.source_variables(id).is_empty() {
            return Ok(work.power[id.index()]);
        }
        self.put(work, y);
        let (scope, temperature) = work.current();
        self.network.source_heat(id, scope, temperature)
    }

    /// The conductors that are streams.
    pub fn streams(&self) -> &[ConductorId] {
        &self.streams
    }

    /// Writes the heat that each stream brings to its two ends together, in W, after
    /// [`ThermalSystem::boundary_heat`].
    ///
    /// # Errors
    /// As [`ThermalSystem::flow`].
    pub fn stream_heat(&self, work: &mut Workspace, heat: &mut [f64]) -> Result<(), InputError> {
        for (q, &id) in heat.iter_mut().zip(self.streams.iter()) {
            *q = self.received(work, id)?.iter().sum();
        }
        Ok(())
    }

    /// The surface that a convection, contact or radiation is, from inputs read and nodes
    /// recovered; `None` for any other conductor.
    ///
    /// # Errors
    /// As [`ThermalSystem::flow`].
    pub fn surface(
        &self,
        work: &mut Workspace,
        id: ConductorId,
    ) -> Result<Option<Surface>, InputError> {
        let (scope, temperature) = work.current();
        self.network.surface(id, scope, temperature)
    }

    /// The heat that the two ends of a conductor receive in W, from inputs read and nodes
    /// recovered: equal and opposite but for a stream.
    ///
    /// # Errors
    /// As [`ThermalSystem::flow`].
    pub fn received(&self, work: &mut Workspace, id: ConductorId) -> Result<Received, InputError> {
        let conductor = &self.network.conductors()[id.index()];
        if let Some(conductance) = self.network.conductance(id) {
            let at = |end| work.temperature[self.network.vertex(end)];
            let heat = conductance * (at(conductor.from) - at(conductor.to));
            return Ok([-heat, heat]);
        }
        if let Ok(place) = self.radiation.binary_search_by_key(&id, |r| r.conductor) {
            return Ok(self.radiation[place].received(&work.temperature));
        }
        let place = self.elements.partition_point(|e| e.conductor().is_some_and(|c| c < id));
        self.elements[place].received(&self.network, work)
    }

    /// Values of the groups of a conductor's or source's law, as [`Network::groups`]; temperatures
    /// and inputs as in [`ThermalSystem::received`].
    ///
    /// # Errors
    /// [`InputError`] if a value fails.
    ///
    /// [`Network::groups`]: lptn_network::Network::groups
    pub fn groups(&self, work: &mut Workspace, item: Item) -> Result<Vec<Option<f64>>, InputError> {
        let (scope, temperature) = work.current();
        self.network.groups(item, scope, temperature)
    }
}
