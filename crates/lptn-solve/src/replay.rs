//! The rows of a run, one after the other, as they were.

use lptn_assembly::{ThermalSystem, Workspace};
use lptn_network::{ConductorId, InputError, LimitId, Positions, Received, Value};

use crate::quantity::Quantity;
use crate::reading::Reading;
use crate::snapshot::Snapshot;

/// The system at one row of a solution. Results that depend on an unrecorded node are NaN.
pub(crate) struct Replay<'a> {
    system: &'a ThermalSystem,
    work: Workspace,
    reading: Reading<'a>,
    /// The reason why its values cannot be computed, if they cannot.
    known: Result<(), InputError>,
}

impl<'a> Replay<'a> {
    /// At no row yet.
    pub(crate) fn new(system: &'a ThermalSystem) -> Self {
        Self { system, work: system.workspace(), reading: Reading::of_any(system), known: Ok(()) }
    }

    /// Sets the positions from here on.
    pub(crate) fn set_positions(&mut self, positions: &Positions) {
        self.work.set_positions(positions);
    }

    /// Goes to a row: its time and one inside its segment in s, and the temperatures of all nodes
    /// in K.
    pub(crate) fn go_to(&mut self, at: (f64, f64), nodes: &[f64]) {
        let read = self.system.read_inputs(&mut self.work, at.0, at.1);
        self.system.place(&mut self.work, nodes);
        self.known = read.and_then(|()| self.reading.place(&mut self.work, at));
    }

    /// One quantity in SI units. Anything that could be evaluated in the run can be here.
    pub(crate) fn value(&mut self, quantity: Quantity) -> f64 {
        let value = if self.known.is_ok() {
            self.reading.value(&mut self.work, quantity).ok()
        } else {
            None
        };
        value.unwrap_or(f64::NAN)
    }

    /// An expression of results in SI units, compiled for this network.
    pub(crate) fn result(&mut self, value: &Value) -> f64 {
        let found = if self.known.is_ok() { value.at(&mut self.reading.scope).ok() } else { None };
        found.unwrap_or(f64::NAN)
    }

    /// The margin of a limit in SI units.
    pub(crate) fn margin(&mut self, limit: LimitId) -> Result<f64, InputError> {
        self.known.clone()?;
        self.system.network().limit_margin(limit, &mut self.reading.scope)
    }

    /// The workspace of this row.
    pub(crate) fn work(&mut self) -> &mut Workspace {
        &mut self.work
    }

    /// Everything at this row, whose time in s is given; `None` if it cannot be evaluated.
    pub(crate) fn snapshot(&mut self, time: f64) -> Option<Snapshot> {
        let mut unknowns = vec![0.0; self.system.unknowns().len()];
        self.system.unknown_temperatures(self.system.node_temperatures(&self.work), &mut unknowns);
        let taken = self
            .known
            .is_ok()
            .then(|| Snapshot::of_workspace(self.system, &mut self.work, &unknowns, (time, false)));
        taken?.ok()
    }

    /// Heat that the two ends of a conductor receive in W.
    pub(crate) fn received(&mut self, id: ConductorId) -> Received {
        self.system.received(&mut self.work, id).unwrap_or([f64::NAN; 2])
    }
}
