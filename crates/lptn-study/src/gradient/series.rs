//! Time histories of quantities with their derivatives by parameters, along one run.

use lptn_analysis::RunAnalysis;
use lptn_network::{LimitId, ParameterId};
use lptn_solve::{Gradient, Proceed, Progress, RecordedNodes};

use crate::gradient::error::GradientError;
use crate::sweep::SweepTask;

/// A quantity over a run, in SI units.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct GradientSeries {
    /// Its value at each time.
    pub values: Vec<f64>,
    /// For each parameter its derivative at each time.
    pub slopes: Vec<Vec<f64>>,
}

impl SweepTask {
    /// The quantities of the first `reports` of the study at these times in s, ascending, with their
    /// derivatives by the parameters of the study at these values: forward sensitivities of one run,
    /// whose work grows with the number of parameters. Functionals of the reports are not applied.
    ///
    /// # Errors
    /// [`GradientError`]; [`GradientError::Differences`] if something switches.
    pub fn gradient_series(
        &self,
        values: &[f64],
        (reports, times): (usize, &[f64]),
        observer: &dyn Fn(Progress) -> Proceed,
    ) -> Result<Vec<GradientSeries>, GradientError> {
        let (network, ids) = self.asked_at(values, reports)?;
        let settings = self.run_for(&network, &ids)?;
        let run = RunAnalysis::of(&network, settings).bare();
        let (start, stop) = (run.start(), run.stop());
        let outside = |time: &&f64| !(start..=stop).contains(*time);
        if let Some(&time) = times.iter().find(outside) {
            return Err(GradientError::Outside { time, start, stop });
        }
        let run = run.at(times.to_vec()).keeping(RecordedNodes::All);
        let found = run.with_slopes((&network, &ids), observer)?;
        if let Gradient::Differences(why) = &found.gradient {
            return Err(GradientError::Differences { why: why.to_string() });
        }
        let rows: Vec<usize> =
            times.iter().filter_map(|time| found.solution.row_at(*time)).collect();
        let picked = |all: &[f64]| rows.iter().map(|row| all[*row]).collect::<Vec<f64>>();
        let series = |limit: LimitId| {
            let of = &network.limits()[limit.index()].of;
            let slope = |&id: &ParameterId| picked(&found.result_slope(id, of).unwrap_or_default());
            GradientSeries {
                values: picked(&found.solution.result(of)),
                slopes: ids.iter().map(slope).collect(),
            }
        };
        let own = network.limits().len() - reports;
        Ok(network.limit_ids().skip(own).map(series).collect())
    }
}
