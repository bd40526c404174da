//! Values that a plan takes as exact although they have an uncertainty.

use crate::network::design::Design;
use crate::network::design::error::DesignError;
use crate::network::design::task::DesignTask;
use crate::network::taken::{Moved, Off};
use crate::network::task::NetworkFitTask;
use crate::network::unknown::Unknown;

impl DesignTask {
    /// The parameters that are not estimated although they have an uncertainty, and the effect of
    /// each on the fit of the existing and the planned records; `None` if a run fails.
    pub fn taken_as_exact(&self, design: &Design) -> (Vec<Off>, Option<Vec<Moved>>) {
        let Ok(task) = self.with_plan(design) else { return (self.fit.taken_as_exact(), None) };
        let off = task.taken_as_exact();
        let own = |unknown: &Unknown| {
            let shared = self.unknowns.iter().position(|own| own.of == unknown.of);
            shared.map_or(unknown.own, |place| self.values[place])
        };
        let values: Vec<f64> = task.unknowns().iter().map(own).collect();
        let moved = task.moved_by(&off, (&values, &|_| true)).ok();
        (off, moved)
    }

    /// The existing records and those of the plan; every run if there is none.
    fn with_plan(&self, design: &Design) -> Result<NetworkFitTask, DesignError> {
        let (given, possible) = self.fit.runs.split_at(self.given());
        let planned = match &design.plan {
            Some(plan) if !plan.runs.is_empty() => self.records((&plan.places, &plan.runs))?.runs,
            _ => possible.to_vec(),
        };
        let runs = given.iter().cloned().chain(planned).collect();
        Ok(NetworkFitTask { runs, ..self.fit.clone() })
    }
}
