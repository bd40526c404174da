//! Information of each run, computed once for every sensor and every length.

use lptn_solve::{Gradient, Proceed, Progress, SensitiveError, in_parallel};

use crate::network::design::error::DesignError;
use crate::network::design::information::{Information, RowSum};
use crate::network::design::task::{DesignPlace, DesignTask};
use crate::network::prior::Priors;
use crate::network::readings::{Measure, Rows};
use crate::network::task::NetworkFitTask;
use crate::network::unknown::Unknown;

/// Is called after every step of every run with the number of the run, and may interrupt them.
pub type DesignObserver<'a> = dyn Fn(usize, Progress) -> Proceed + Sync + 'a;

/// Largest tolerance of the runs, in K.
const TOLERANCE: f64 = 1e-10;

/// Number of lengths of a run at equal distances, and of others at equal ratios.
const LENGTHS: usize = 48;

/// Information of one run at several lengths.
#[derive(Clone, Debug)]
pub(super) struct RunInformation {
    /// Numbers of samples, ascending; the last is the whole run.
    pub(super) lengths: Vec<usize>,
    /// For each place its information at each of these lengths: about all unknowns, then about
    /// those that this record alone has.
    pub(super) places: Vec<Vec<Information>>,
    /// Prior standard deviation of each of those, if there is one.
    pub(super) own: Vec<Option<f64>>,
    /// True if the derivatives are exact, and not differences of runs.
    pub(super) exact: bool,
}

/// A run that could be measured, row by row.
pub(super) struct PlannedRecord {
    unknowns: Vec<Unknown>,
    pub(super) rows: usize,
    measure: Measure,
}

impl PlannedRecord {
    /// Derivatives of a place's reading in a row by all unknowns, over its standard deviation.
    pub(super) fn row(&self, place: usize, row: usize) -> Vec<f64> {
        row_of(&self.measure, &self.unknowns, place * self.rows + row)
    }

    /// The sum of a place before its first row.
    pub(super) fn begin(&self, place: &DesignPlace) -> RowSum {
        let noise = (place.correlated, place.decay);
        RowSum::new(self.unknowns.len(), noise, (place.deviation / place.weight()).powi(2))
    }

    fn is_exact(&self) -> bool {
        self.measure.gradient == Gradient::Exact
    }
}

impl DesignTask {
    /// Information of every run that could be measured.
    pub(super) fn informations(
        &self,
        observer: &DesignObserver<'_>,
    ) -> Result<Vec<RunInformation>, DesignError> {
        let all: Vec<usize> = (0..self.runs.len()).collect();
        let one = |&run: &usize| self.information(run, observer);
        in_parallel(&all, self.fit.threads, one).into_iter().collect()
    }

    fn information(
        &self,
        run: usize,
        observer: &DesignObserver<'_>,
    ) -> Result<RunInformation, DesignError> {
        let record = self.record(run, observer)?;
        let lengths = lengths(record.rows);
        let place = |place: usize| {
            let mut found = Vec::with_capacity(lengths.len());
            let mut sum = record.begin(&self.places[place]);
            for row in 0..record.rows {
                sum.add(&record.row(place, row));
                if lengths.binary_search(&(row + 1)).is_ok() {
                    found.push(sum.sum.clone());
                }
            }
            found
        };
        let places = (0..self.places.len()).map(place).collect();
        let own = record.unknowns[self.unknowns.len()..].iter().map(|unknown| unknown.prior);
        Ok(RunInformation { lengths, places, own: own.collect(), exact: record.is_exact() })
    }

    /// The derivatives of a run that could be measured.
    pub(super) fn record(
        &self,
        run: usize,
        observer: &DesignObserver<'_>,
    ) -> Result<PlannedRecord, DesignError> {
        let at = self.given() + run;
        let measure = self.measure((&self.fit, at), &|step| observer(run, step))?;
        let rows = self.fit.runs[at].times.len();
        Ok(PlannedRecord { unknowns: self.unknowns_of(at), rows, measure })
    }

    /// Prior knowledge of the unknowns that all records share.
    pub(super) fn of_priors(&self) -> Information {
        let mut all = Information::none(self.unknowns.len());
        let priors = Priors::of(&self.unknowns, &self.fit.correlations);
        priors.rows(&self.values).iter().for_each(|row| all.add_row(row, 1.0));
        all
    }

    /// Information of the existing records.
    pub(super) fn of_given(
        &self,
        observer: &DesignObserver<'_>,
    ) -> Result<Information, DesignError> {
        let mut all = Information::none(self.unknowns.len());
        for (run, factors) in self.factors.iter().enumerate() {
            let measured = &self.fit.runs[run];
            let measure = self.measure((&self.fit, run), &|step| observer(run, step))?;
            let unknowns = self.unknowns_of(run);
            let mut own = Information::none(unknowns.len());
            let mut at = 0;
            for (column, factor) in measured.columns.iter().zip(factors) {
                let rows = column.values.iter().filter(|value| !value.is_nan()).count();
                for row in at..at + rows {
                    own.add_row(&row_of(&measure, &unknowns, row), factor.recip());
                }
                at += rows;
            }
            let shared = self.unknowns.len();
            for (i, unknown) in unknowns.iter().enumerate().skip(shared) {
                unknown.prior.into_iter().for_each(|deviation| own.add_prior(i, deviation));
            }
            all.add(&own.without_last(shared));
        }
        Ok(all)
    }

    /// The unknowns of all records, then those of this one.
    pub(super) fn unknowns_of(&self, run: usize) -> Vec<Unknown> {
        let mut all = self.unknowns.clone();
        all.extend(self.fit.unknowns().into_iter().filter(|own| own.run() == Some(run)));
        all
    }

    /// Derivatives of the readings of a record's columns by its unknowns, over their standard
    /// deviations; `fit` is the task's own, or one with other rows.
    pub(super) fn measure(
        &self,
        (fit, run): (&NetworkFitTask, usize),
        observer: &dyn Fn(Progress) -> Proceed,
    ) -> Result<Measure, DesignError> {
        let (unknowns, measured) = (self.unknowns_of(run), &fit.runs[run]);
        let own = unknowns[self.unknowns.len()..].iter().map(|unknown| unknown.own);
        let values: Vec<f64> = self.values.iter().copied().chain(own).collect();
        let failed = |error| match error {
            SensitiveError::Interrupted => DesignError::Interrupted,
            error => DesignError::Run { run: measured.name.clone(), error: Box::new(error) },
        };
        let rows = Rows::new(fit, measured, usize::MAX);
        let tolerance = measured.settings.tolerance().min(TOLERANCE);
        fit.measured((run, &rows), (&unknowns, &values), (tolerance, observer)).map_err(failed)
    }
}

/// Derivatives of one value by all unknowns.
pub(super) fn row_of(measure: &Measure, unknowns: &[Unknown], row: usize) -> Vec<f64> {
    let rows = measure.residuals.len();
    (0..unknowns.len()).map(|i| measure.jacobian[i * rows + row]).collect()
}

/// Numbers of samples at which a run of `samples` is evaluated.
fn lengths(samples: usize) -> Vec<usize> {
    let ratio = (samples as f64).powf(1.0 / LENGTHS as f64);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "up to samples")]
    let grown = (1..LENGTHS).map(|k| ratio.powf(k as f64).round() as usize);
    let even = (1..LENGTHS).map(|k| k * samples / LENGTHS);
    let mut all: Vec<usize> = grown.chain(even).chain([2, samples]).collect();
    all.retain(|length| (2..=samples).contains(length));
    all.sort_unstable();
    all.dedup();
    all
}
