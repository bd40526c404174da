//! Results of a fit.

use lptn_solve::Gradient;

use crate::Covariance;
use crate::least_squares::{Side, Stop};
use crate::network::between::BetweenRecords;
use crate::network::hint::Hint;
use crate::network::identify::Identifiability;
use crate::network::profile::Profile;
use crate::network::search::Starts;
use crate::network::shared::SharedNoise;

/// Results of a fit of a network.
#[derive(Clone, Debug)]
pub struct NetworkFit {
    /// Reason why the search did not converge; `None` if it did. Without a minimum the values are
    /// not a result.
    pub not_converged: Option<Stop>,
    /// The varied parameters, in the order of the task.
    pub parameters: Vec<FittedParameter>,
    /// The columns of every record, in the order of the task.
    pub columns: Vec<ColumnMisfit>,
    /// The records whose columns are off together by more than chance explains; the errors count
    /// it, and less of it too.
    pub shared_noise: Vec<SharedNoise>,
    /// Root mean square of all residuals: in the SI unit of the columns, or over their standard
    /// deviations if they have no common unit ([`NetworkFitTask::unit`]).
    ///
    /// [`NetworkFitTask::unit`]: crate::network::NetworkFitTask::unit
    pub rms: f64,
    /// Covariance of the parameters that are free and determined, corrected for correlated
    /// residuals.
    pub covariance: Option<Covariance>,
    /// Values and priors beyond those that the parameters take up. Without any, errors are those
    /// from the standard deviations of the columns, or there are none.
    pub left_over: usize,
    /// Identifiability by the records; `None` if the derivatives are not finite.
    pub identifiability: Option<Identifiability>,
    /// Results of the searches.
    pub starts: Starts,
    /// Kind of the derivatives.
    pub gradient: Gradient,
    /// Number of evaluations of the runs of all records.
    pub evaluations: usize,
}

/// A parameter after the fit, in SI units.
#[derive(Clone, Debug, PartialEq)]
pub struct FittedParameter {
    /// Value at the end of the search.
    pub value: f64,
    /// Its standard error; `None` on a bound, if the records do not determine it, or if no error
    /// can be estimated.
    pub standard_error: Option<f64>,
    /// Half the width of its 95 % interval: its standard error times the quantile of Student's t.
    pub half_width: Option<f64>,
    /// The degrees of freedom of that quantile; infinite if the error is known.
    pub degrees_of_freedom: Option<f64>,
    /// Scatter of the records in it, if more than two of them determine it; the errors above
    /// include it if it is more than their noise.
    pub between: Option<BetweenRecords>,
    /// Its start value.
    pub start: f64,
    /// The bound that it is on.
    pub on_bound: Option<Side>,
    /// Its 95 % interval if value ± `half_width` would contain impossible values, and that of a
    /// parameter on a bound.
    pub profile: Option<Profile>,
}

/// Residuals of a column, in the SI unit of its measurand.
#[derive(Clone, Debug, PartialEq)]
pub struct ColumnMisfit {
    /// Index of the record.
    pub run: usize,
    /// Index of the column in its record.
    pub column: usize,
    /// Number of values.
    pub samples: usize,
    /// Number of independent values with the same information.
    pub effective: f64,
    /// True if drift as slow as the record is as likely as none, and is in the intervals.
    pub slow_drift: bool,
    /// Root mean square of the residuals.
    pub rms: f64,
    /// Mean of model less record.
    pub mean: f64,
    /// Standard deviation of one value as given.
    pub sigma: Option<f64>,
    /// Likely cause of the misfit, if it is far more than that.
    pub hint: Option<Hint>,
    /// Value of the model at each time of the record.
    pub modelled: Vec<f64>,
}

impl NetworkFit {
    /// The correlation of two parameters, in -1..1; `None` if one of them has no standard error.
    pub fn correlation(&self, i: usize, j: usize) -> Option<f64> {
        let known = |k: usize| self.parameters[k].standard_error.is_some();
        (known(i) && known(j)).then(|| self.covariance.as_ref()?.correlation(i, j))?
    }

    /// Number of values of all columns.
    pub fn samples(&self) -> usize {
        self.columns.iter().map(|column| column.samples).sum()
    }
}
