//! The records that a plan would give.

use lptn_solve::Proceed;

use crate::network::design::error::DesignError;
use crate::network::design::task::DesignTask;
use crate::network::task::{MeasuredColumn, MeasuredRun, NetworkFitTask};

impl DesignTask {
    /// The fit of the records from runs of these samples with sensors at some places, without
    /// noise, for the values of the unknowns. Noise added to them makes records to try a plan with.
    ///
    /// # Errors
    /// [`DesignError`] if a run fails.
    pub fn records(
        &self,
        (places, runs): (&[usize], &[(usize, usize)]),
    ) -> Result<NetworkFitTask, DesignError> {
        let mut all = Vec::with_capacity(runs.len());
        for (number, &(run, samples)) in runs.iter().enumerate() {
            let at = self.given() + run;
            let own = &self.fit.runs[at];
            let measure = self.measure((&self.fit, at), &|_| Proceed::Continue)?;
            let column = |&place: &usize| {
                let from = place * own.times.len();
                let values = measure.modelled[from..from + samples].to_vec();
                MeasuredColumn { values, ..own.columns[place].clone() }
            };
            all.push(MeasuredRun {
                name: format!("{} {}", own.name, number + 1),
                times: own.times[..samples].to_vec(),
                columns: places.iter().map(column).collect(),
                ..own.clone()
            });
        }
        Ok(NetworkFitTask { runs: all, ..self.fit.clone() })
    }
}
