//! Fits of one column of all runs.

use super::consistency::{Consistency, Measured};
use crate::step::{Capacity, Power, StepFit};

/// One column of one run.
#[derive(Clone, Debug, PartialEq)]
pub struct RunFit {
    /// The exponential through the column.
    pub fit: StepFit,
    /// Rise, resistance and power.
    pub power: Power,
}

/// A column of every run.
#[derive(Clone, Debug, PartialEq)]
pub struct ColumnFits {
    /// The name of the column in every record.
    pub column: String,
    /// Fits in the order of the runs.
    pub fits: Vec<RunFit>,
}

impl ColumnFits {
    pub(crate) fn named(column: &str) -> Self {
        Self { column: column.to_owned(), fits: Vec::new() }
    }

    /// The exponents of rise, time constant and power at speeds in rad/s, weighted by random errors
    /// or with equal weights. `None` if there are too few runs or a number is not above 0.
    pub(crate) fn consistency(
        &self,
        speeds: &[f64],
        capacity: Capacity,
        unweighted: bool,
    ) -> Option<Consistency> {
        let all = |pick: fn(&RunFit) -> f64| self.fits.iter().map(pick).collect::<Vec<f64>>();
        let errors = [
            all(|f| f.power.rise.random),
            all(|f| f.fit.tau.standard_error),
            all(|f| f.power.power.random),
        ];
        let measured = Measured {
            speed: speeds,
            rise: &all(|f| f.power.rise.value),
            time_constant: &all(|f| f.fit.tau.value),
            power: &all(|f| f.power.power.value),
            errors: (!unweighted).then(|| errors.each_ref().map(Vec::as_slice)),
        };
        Consistency::of_points(&measured, Some(capacity)).ok()
    }
}
