//! Existing records.

use lptn_netlist::{Netlist, PlanStudy};
use lptn_network::ParameterId;

use crate::network::design::error::DesignError;
use crate::network::error::NetworkFitError;
use crate::network::fit_network_observed;
use crate::network::fitted::{ColumnMisfit, NetworkFit};
use crate::network::task::{FitObserver, MeasuredRun, NetworkFitTask};

/// The fit of existing records.
#[derive(Clone, Debug)]
pub struct GivenFit {
    /// Its name.
    pub name: String,
    /// Task of the fit.
    pub task: NetworkFitTask,
    /// Result of the fit.
    pub fit: NetworkFit,
}

/// The records of fits, and their results.
#[derive(Default)]
pub(super) struct Given {
    pub(super) fits: Vec<GivenFit>,
    pub(super) runs: Vec<MeasuredRun>,
    /// For each column of each record the variance of the mean of its residuals, over that of
    /// independent ones of its weight.
    pub(super) factors: Vec<Vec<f64>>,
    /// Fitted values in SI units; those of a later fit count.
    pub(super) values: Vec<(ParameterId, f64)>,
}

pub(super) fn given(
    netlist: &Netlist,
    study: &PlanStudy,
    (threads, observer): (usize, &FitObserver<'_>),
) -> Result<Given, DesignError> {
    let mut given = Given::default();
    for name in &study.given {
        let Some(own) = netlist.studies.fits.iter().find(|fit| fit.name == *name) else { continue };
        let failed = |error| match error {
            NetworkFitError::Interrupted { .. } => DesignError::Interrupted,
            error => DesignError::Given { fit: name.clone(), error: Box::new(error) },
        };
        let task = NetworkFitTask::of(netlist, own, threads).map_err(failed)?;
        let fit = fit_network_observed(&task, observer).map_err(failed)?;
        if fit.not_converged.is_some() {
            return Err(DesignError::NotConverged { fit: name.clone() });
        }
        for (varied, found) in task.parameters.iter().zip(&fit.parameters) {
            given.values.retain(|(id, _)| *id != varied.parameter);
            given.values.push((varied.parameter, found.value));
        }
        given.factors.extend(factors(&task, &fit));
        given.runs.extend(task.runs.iter().cloned());
        given.fits.push(GivenFit { name: name.clone(), task, fit });
    }
    Ok(given)
}

fn factors(task: &NetworkFitTask, fit: &NetworkFit) -> Vec<Vec<f64>> {
    let mut factors: Vec<Vec<f64>> =
        task.runs.iter().map(|run| vec![1.0; run.columns.len()]).collect();
    for misfit in &fit.columns {
        let weight = task.runs[misfit.run].columns[misfit.column].weight();
        factors[misfit.run][misfit.column] = factor(misfit, weight);
    }
    factors
}

/// Correlated residuals have less information than as many independent ones.
fn factor(misfit: &ColumnMisfit, weight: f64) -> f64 {
    let fewer = misfit.samples as f64 / misfit.effective.max(1.0);
    (misfit.rms / weight).powi(2) * fewer
}
