//! A thermal system as the integrator sees it: `M y' = f` with M the capacities and f the heat flows.

use lptn_assembly::{ThermalSystem, Workspace};
use lptn_integrate::{OdeSystem, Pattern, Retry};
use lptn_network::InputError;

/// A system with what evaluating it needs. Its running integrals are those of the ledger.
pub(crate) struct Heat<'a> {
    system: &'a ThermalSystem,
    pattern: Pattern,
    work: Workspace,
    /// Comparisons of `t` keep the truth they have here while a segment lasts.
    pub(crate) segment: f64,
    /// Why a source or boundary had no value.
    pub(crate) failure: Option<InputError>,
}

impl<'a> Heat<'a> {
    pub(crate) fn new(system: &'a ThermalSystem, segment: f64) -> Self {
        let pattern = Pattern::from_symbolic(system.pattern().symbolic());
        Self { system, pattern, work: system.workspace(), segment, failure: None }
    }

    fn read(&mut self, time: f64) -> Result<(), Retry> {
        self.system.read_inputs(&mut self.work, time, self.segment).map_err(|error| {
            self.failure = Some(error);
            Retry::Stop
        })
    }
}

impl OdeSystem for Heat<'_> {
    fn size(&self) -> usize {
        self.system.states().len()
    }

    fn mass(&self) -> &[f64] {
        self.system.capacity()
    }

    fn flow(&mut self, time: f64, y: &[f64], flow: &mut [f64]) -> Result<(), Retry> {
        self.read(time)?;
        self.system.flow(&self.work, y, flow);
        Ok(())
    }

    fn pattern(&self) -> &Pattern {
        &self.pattern
    }

    fn symmetric(&self) -> bool {
        true
    }

    fn jacobian(&mut self, _time: f64, _y: &[f64], values: &mut [f64]) -> Result<(), Retry> {
        self.system.jacobian(values);
        Ok(())
    }

    fn jacobian_is_constant(&self) -> bool {
        true
    }

    fn quadrature_count(&self) -> usize {
        crate::ledger::integrals(self.system.network())
    }

    fn quadrature(&mut self, time: f64, y: &[f64], q: &mut [f64]) -> Result<(), Retry> {
        self.read(time)?;
        crate::ledger::integrands(self.system, &self.work, y, q);
        Ok(())
    }
}
