//! Predictions of records that were not used in the fit.

use lptn_solve::SensitiveError;

use crate::network::apart::told_apart;
use crate::network::coordinates::Coordinates;
use crate::network::error::NetworkFitError;
use crate::network::model::Model;
use crate::network::open::settled;
use crate::network::search::search;
use crate::network::task::{FitObserver, NetworkFitTask};

/// Tolerance in K of the runs.
const TOLERANCE: f64 = 1e-7;

/// The values of a fit without their errors.
pub(crate) struct Refitted {
    pub(crate) values: Vec<f64>,
    /// True if the search found a minimum.
    pub(crate) converged: bool,
    /// True if the records determine every value.
    pub(crate) whole: bool,
}

/// Fits a task from values in SI units, one for each of its unknowns.
pub(crate) fn refit(
    task: &NetworkFitTask,
    begin: &[f64],
    observer: &FitObserver<'_>,
) -> Result<Refitted, NetworkFitError> {
    let unknowns = task.unknowns();
    super::check(task, &unknowns)?;
    let coordinates = Coordinates::new(&unknowns);
    let found = search((task, observer), (&unknowns, &coordinates), begin)?;
    let mut found = settled(found, (task, &unknowns, &coordinates), begin)?;
    let (values, _) = coordinates.values(&found.estimate.parameters);
    let Ok(at_end) = found.model.at(&values).cloned() else {
        return Err(NetworkFitError::NoData); // the search ends where there are runs
    };
    let known = told_apart((task, &unknowns), (&at_end, found.accuracy), &mut found.model);
    if found.model.interrupted {
        return Err(found.model.broken_off());
    }
    let whole = known.is_some_and(|known| known.is_whole());
    Ok(Refitted { values, converged: found.outcome.is_ok(), whole })
}

/// Residuals of a column of a record in standard deviations, the standard deviation in its SI unit,
/// and the modelled value in each row.
pub(crate) struct Misses {
    pub(crate) over_sigma: Vec<f64>,
    pub(crate) sigma: f64,
    pub(crate) modelled: Vec<f64>,
}

/// Residuals of a network with these values for the records of a task.
pub(crate) fn misses(
    task: &NetworkFitTask,
    values: &[f64],
    observer: &FitObserver<'_>,
) -> Result<Vec<Misses>, SensitiveError> {
    let unknowns = task.unknowns();
    let coordinates = Coordinates::new(&unknowns);
    let tolerance = task.runs.iter().fold(TOLERANCE, |t, run| t.min(run.settings.tolerance()));
    let mut model =
        Model::new((task, observer), (&unknowns, &coordinates), (usize::MAX, tolerance));
    let found = model.at(values).map_err(|(_, error)| error)?.clone();
    let one = |block: &crate::network::model::Block| Misses {
        over_sigma: found.residuals[block.range.clone()].to_vec(),
        modelled: found.modelled[block.rows.clone()].to_vec(),
        sigma: task.runs[block.run].columns[block.column].weight(),
    };
    Ok(model.blocks.iter().map(one).collect())
}
