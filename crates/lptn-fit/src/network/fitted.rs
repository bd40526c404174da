//! What came of a fit.

use lptn_solve::Gradient;

use crate::Covariance;
use crate::least_squares::{Side, Stop};
use crate::network::between::BetweenRecords;
use crate::network::hint::Hint;
use crate::network::identify::Identifiability;
use crate::network::profile::Profile;
use crate::network::search::Starts;
use crate::network::shared::SharedNoise;

/// What came of a fit of a network.
#[derive(Clone, Debug)]
pub struct NetworkFit {
    /// Why the search did not converge; `None` if it did. Without a minimum the values are no
    /// result.
    pub not_converged: Option<Stop>,
    /// The varied parameters, in the order of the task.
    pub parameters: Vec<FittedParameter>,
    /// The columns of every record, in the order of the task.
    pub columns: Vec<ColumnMisfit>,
    /// The records whose columns are off together by more than chance explains; the errors count
    /// it, and less of it too.
    pub shared_noise: Vec<SharedNoise>,
    /// Root of the mean of the squares of all misfits: in the SI unit of the columns, or over their
    /// standard deviations where they have no unit in common ([`NetworkFitTask::unit`]).
    ///
    /// [`NetworkFitTask::unit`]: crate::network::NetworkFitTask::unit
    pub rms: f64,
    /// Covariance of the parameters that are free and determined, corrected for residuals that
    /// follow each other.
    pub covariance: Option<Covariance>,
    /// Values and priors beyond those that the parameters take up. With none, errors are those that
    /// the standard deviations of the columns say, or there are none.
    pub left_over: usize,
    /// What the records determine; `None` where the derivatives are not finite.
    pub identifiability: Option<Identifiability>,
    /// How the searches came out.
    pub starts: Starts,
    /// How derivatives were had.
    pub gradient: Gradient,
    /// How often the runs of all records were computed.
    pub evaluations: usize,
}

/// A parameter after the fit, in SI units.
#[derive(Clone, Debug, PartialEq)]
pub struct FittedParameter {
    /// Where the search ended.
    pub value: f64,
    /// Its standard error; `None` on a bound, where the records do not determine it and where
    /// nothing tells it.
    pub standard_error: Option<f64>,
    /// Half the width of its 95 % interval: its standard error times the quantile of Student's t.
    pub half_width: Option<f64>,
    /// The degrees of freedom of that quantile; infinite where the error is known.
    pub degrees_of_freedom: Option<f64>,
    /// How the records differ in it, where more than two of them tell it; the errors above count
    /// it where that is more than their noise says.
    pub between: Option<BetweenRecords>,
    /// Its value before.
    pub start: f64,
    /// The bound that it sits on.
    pub on_bound: Option<Side>,
    /// Its 95 % interval where the value ± `half_width` would hold what cannot be, and that of a
    /// parameter on a bound.
    pub profile: Option<Profile>,
}

/// How the model misses a column, in the SI unit of what that measures.
#[derive(Clone, Debug, PartialEq)]
pub struct ColumnMisfit {
    /// Place of the record.
    pub run: usize,
    /// Place of the column in its record.
    pub column: usize,
    /// Number of values.
    pub samples: usize,
    /// How many independent values would tell as much.
    pub effective: f64,
    /// Whether drift as slow as the record is as likely as none, and is in the intervals.
    pub slow_drift: bool,
    /// Root of the mean square.
    pub rms: f64,
    /// Mean of model less record.
    pub mean: f64,
    /// Standard deviation of one value as it was given.
    pub sigma: Option<f64>,
    /// What the misfit looks like, where it is far more than that.
    pub hint: Option<Hint>,
    /// What the model says at each time of the record.
    pub modelled: Vec<f64>,
}

impl NetworkFit {
    /// The correlation of two parameters, in -1..1; `None` where one of them has no standard error.
    pub fn correlation(&self, i: usize, j: usize) -> Option<f64> {
        let known = |k: usize| self.parameters[k].standard_error.is_some();
        (known(i) && known(j)).then(|| self.covariance.as_ref()?.correlation(i, j))?
    }

    /// Number of values of all columns.
    pub fn samples(&self) -> usize {
        self.columns.iter().map(|column| column.samples).sum()
    }
}
