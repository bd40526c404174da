//! Quantities of the results, read at the state of a workspace.
//!
//! This is the one place where a quantity of results is read; rows, limits and windows use it.
//! Balances of one node are running integrals, separate from the ledger's.

use lptn_assembly::{ThermalSystem, Workspace};
use lptn_network::{Evaluation, HeatOf, InputError, Item, Network};

use crate::quantity::Quantity;

/// Reads quantities from a workspace whose inputs are read and whose nodes are recovered.
#[derive(Clone, Debug)]
pub(crate) struct Reading<'a> {
    system: &'a ThermalSystem,
    pub(crate) scope: Evaluation,
    /// True if anything reads temperatures: results, or further results of laws.
    reads: bool,
    unknowns: Vec<f64>,
    flow: Vec<f64>,
    boundary_heat: Vec<f64>,
    /// True if the heat of boundaries and sources has yet to be evaluated.
    heat_is_due: bool,
    /// The heat flows that expressions of results name.
    named: Vec<f64>,
}

impl<'a> Reading<'a> {
    pub(crate) fn new(system: &'a ThermalSystem) -> Self {
        Self {
            system,
            scope: system.network().evaluation(),
            reads: reads_temperatures(system.network()),
            unknowns: vec![f64::NAN; system.unknowns().len()],
            flow: vec![f64::NAN; system.unknowns().len()],
            boundary_heat: vec![f64::NAN; system.network().boundaries().len()],
            heat_is_due: false,
            named: Vec::new(),
        }
    }

    /// The same for expressions that are not part of the network.
    pub(crate) fn of_any(system: &'a ThermalSystem) -> Self {
        Self { reads: true, ..Self::new(system) }
    }

    /// Goes to the state of the workspace, and evaluates the heat of boundaries and sources there;
    /// `at` is the time and a time inside the segment, in s. If a temperature is not known (NaN),
    /// results that depend on it are NaN.
    pub(crate) fn place(&mut self, work: &mut Workspace, at: (f64, f64)) -> Result<(), InputError> {
        self.stand(work, at)?;
        self.settle(work)
    }

    /// [`Reading::place`] without the heat, which is evaluated when it is read: most rows show
    /// none. Until then the workspace has the heat of sources of some earlier temperatures.
    pub(crate) fn stand(&mut self, work: &mut Workspace, at: (f64, f64)) -> Result<(), InputError> {
        let Self { system, scope, reads, unknowns, boundary_heat, .. } = self;
        let network = system.network();
        let nodes = system.node_temperatures(work);
        let known = !nodes.iter().any(|t| t.is_nan());
        if network.has_events() {
            scope.set_positions(work.positions());
        }
        scope.set_time(at.0, at.1);
        if *reads {
            network.place_temperatures(scope, nodes, system.boundary_temperatures(work));
        }
        self.heat_is_due = known;
        if !known {
            boundary_heat.fill(f64::NAN);
            return Ok(());
        }
        system.unknown_temperatures(system.node_temperatures(work), unknowns);
        self.read_named(work)
    }

    /// Reads the heat flows that expressions name.
    fn read_named(&mut self, work: &mut Workspace) -> Result<(), InputError> {
        let network = self.system.network();
        self.named.clear();
        for heat in network.named_heats() {
            let heat = self.heat(work, heat)?;
            self.named.push(heat);
        }
        self.scope.set_heats(&self.named);
        Ok(())
    }

    /// Evaluates the heat of boundaries and sources, if that has yet to be done.
    fn settle(&mut self, work: &mut Workspace) -> Result<(), InputError> {
        if self.heat_is_due {
            self.boundary_heat.fill(f64::NAN);
            self.system.boundary_heat(work, &self.unknowns, &mut self.boundary_heat)?;
            self.heat_is_due = false;
        }
        Ok(())
    }

    fn heat(&mut self, work: &mut Workspace, heat: HeatOf) -> Result<f64, InputError> {
        self.settle(work)?;
        heat_of(self.system, (&self.boundary_heat, &mut self.scope), work, heat)
    }

    /// Evaluates every path and source at the last place, to check its heat.
    pub(crate) fn check_heat(&mut self, work: &mut Workspace) -> Result<(), InputError> {
        self.system.flow(work, &self.unknowns, &mut self.flow)
    }

    /// One quantity in SI units.
    pub(crate) fn value(
        &mut self,
        work: &mut Workspace,
        quantity: Quantity,
    ) -> Result<f64, InputError> {
        match quantity {
            Quantity::Node(id) => Ok(self.system.node_temperatures(work)[id.index()]),
            Quantity::Grid(value) => {
                Ok(self.system.network().grid_value(value, self.system.node_temperatures(work)))
            }
            Quantity::BoundaryTemperature(id) => {
                Ok(self.system.boundary_temperatures(work)[id.index()])
            }
            Quantity::Heat(heat) => self.heat(work, heat),
            Quantity::State(id) => {
                Ok(self.system.network().state_value(id, self.system.node_temperatures(work)))
            }
            Quantity::Signal(id) => Ok(self.scope.signal(id)),
            Quantity::Control(id) => Ok(self.scope.control(id)),
            Quantity::Report(id) => self.system.network().report_value(id, &mut self.scope),
            Quantity::Side(id, side) => {
                self.system.network().limit_side((id, side), &mut self.scope)
            }
        }
    }
}

/// True if there is a result, or a law with further results.
fn reads_temperatures(network: &Network) -> bool {
    let conductors = network.conductor_ids().map(Item::Conductor);
    let mut laws = conductors.chain(network.source_ids().map(Item::Source));
    !(network.limits().is_empty() && network.reports().is_empty())
        || network.named_heats().len() > 0
        || laws.any(|item| network.told_of(item).next().is_some())
}

fn heat_of(
    system: &ThermalSystem,
    (boundary_heat, scope): (&[f64], &mut Evaluation),
    work: &mut Workspace,
    heat: HeatOf,
) -> Result<f64, InputError> {
    match heat {
        HeatOf::Conductor(id) | HeatOf::ReceivedTo(id) => Ok(system.received(work, id)?[1]),
        HeatOf::ReceivedFrom(id) => Ok(system.received(work, id)?[0]),
        HeatOf::Told(item, key) => system.network().told(item, key, scope),
        HeatOf::Source(id) => {
            let needs = system.network().source_variables(id);
            let known =
                needs.is_empty() || !system.node_temperatures(work).iter().any(|t| t.is_nan());
            Ok(if known { system.source_powers(work)[id.index()] } else { f64::NAN })
        }
        HeatOf::Boundary(id) => Ok(boundary_heat[id.index()]),
        HeatOf::FacePath(id) => {
            let parts = system.network().face_paths()[id.index()].conductors();
            parts.map(|part| Ok(system.received(work, part)?[1])).sum()
        }
    }
}

#[cfg(test)]
mod tests;
