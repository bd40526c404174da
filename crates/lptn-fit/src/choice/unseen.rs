//! Predictions of held-out records.

use lptn_solve::{Progress, SensitiveError};

use crate::choice::error::ChoiceError;
use crate::choice::{ChoiceObserver, ChoiceStage, Contender};
use crate::network::{
    FitStage, MeasuredRun, Misses, NetworkFit, NetworkFitTask, Unknown, UnknownOf, misses, refit,
};

/// Minimum number of values in the last third of a record.
const LEAST: usize = 3;

/// Misfit in standard deviations that runs cannot distinguish from zero.
const SMALL: f64 = 1e-6;

/// Data held out of the fits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Held {
    /// Each record in turn.
    EachRecord,
    /// The values of a single record after this time.
    LastThird {
        /// The time in s.
        from: f64,
    },
}

/// Prediction of held-out data by a network.
#[derive(Clone, Debug, PartialEq)]
pub struct UnseenRecord {
    /// Index of the record.
    pub run: usize,
    /// Number of values.
    pub samples: usize,
    /// Root mean square of the residuals in standard deviations (in SI units if none are given).
    pub over_sigma: f64,
    /// The same in the SI unit of the columns; in standard deviations if they have no common unit.
    pub rms: f64,
    /// True if the search without the record found a minimum.
    pub converged: bool,
    /// True if the other records determine every value.
    pub whole: bool,
    /// Predicted values of each column in each row of the record, in SI units. For a single record,
    /// rows used in the fit are included.
    pub modelled: Vec<Vec<f64>>,
}

/// A network without a part of the records, and with that part alone.
struct Split {
    seen: NetworkFitTask,
    unseen: NetworkFitTask,
}

impl Held {
    /// Held-out data by the number of records.
    pub(crate) fn of(contenders: &[Contender]) -> Result<Self, ChoiceError> {
        let runs = &contenders[0].task.runs;
        if runs.len() > 1 {
            contenders.iter().try_for_each(known_offsets)?;
            return Ok(Self::EachRecord);
        }
        let Some(run) = runs.first() else { return Ok(Self::EachRecord) };
        let (first, last) = (run.times.first(), run.times.last());
        let (first, last) = (first.copied().unwrap_or(0.0), last.copied().unwrap_or(0.0));
        let from = first + 2.0 / 3.0 * (last - first);
        let late = late(run, from);
        let values = late.columns.iter().flat_map(|column| &column.values);
        match values.filter(|value| !value.is_nan()).count() {
            values if values < LEAST => {
                Err(ChoiceError::Nothing { record: run.name.clone(), values })
            }
            _ => Ok(Self::LastThird { from }),
        }
    }

    /// Number of parts that are held out in turn.
    pub(crate) fn parts(&self, contender: &Contender) -> usize {
        match self {
            Self::EachRecord => contender.task.runs.len(),
            Self::LastThird { .. } => 1,
        }
    }

    /// Fits a network without a part, from its fit to all records, and predicts that part.
    pub(crate) fn predict(
        &self,
        (contender, whole): (&Contender, &NetworkFit),
        (part, threads): (usize, usize),
        observer: &ChoiceObserver<'_>,
    ) -> Result<UnseenRecord, ChoiceError> {
        let split = self.split(&contender.task, part, threads);
        let without = Some((part + 1, self.parts(contender)));
        let watch = |fit: FitStage, step: Progress| {
            observer(&ChoiceStage { contender: &contender.name, without, fit }, step)
        };
        let record = &contender.task.runs[part].name;
        let all: Vec<f64> = whole.parameters.iter().map(|parameter| parameter.value).collect();
        let known = (contender.task.unknowns(), all);
        let begin = self.carried(&split.seen.unknowns(), &known, |run| self.shifted(run, part));
        let failed = |error| ChoiceError::of_fit(&contender.name, Some(record), error);
        let found = refit(&split.seen, &begin, &watch).map_err(failed)?;
        let known = (split.seen.unknowns(), found.values);
        let values = self.carried(&split.unseen.unknowns(), &known, |run| match self {
            Self::EachRecord => None,
            Self::LastThird { .. } => Some(run),
        });
        let missed = misses(&split.unseen, &values, &watch).map_err(|error| match error {
            SensitiveError::Interrupted => ChoiceError::Interrupted,
            error => ChoiceError::Unseen {
                contender: contender.name.clone(),
                record: record.clone(),
                error: Box::new(error),
            },
        })?;
        let (samples, over_sigma, rms) = size(&missed, split.unseen.unit().is_some());
        let (converged, whole) = (found.converged, found.whole);
        let modelled = missed.into_iter().map(|column| column.modelled).collect();
        Ok(UnseenRecord { run: part, samples, over_sigma, rms, converged, whole, modelled })
    }

    fn split(&self, task: &NetworkFitTask, part: usize, threads: usize) -> Split {
        let with = |runs: Vec<MeasuredRun>| NetworkFitTask {
            runs,
            more_starts: 0,
            threads,
            ..task.clone()
        };
        match *self {
            Self::EachRecord => {
                let mut others = task.runs.clone();
                let own = others.remove(part);
                Split { seen: with(others), unseen: with(vec![own]) }
            }
            Self::LastThird { from } => {
                let run = &task.runs[part];
                Split { seen: with(vec![early(run, from)]), unseen: with(vec![late(run, from)]) }
            }
        }
    }

    /// Index among all records of one that is left.
    fn shifted(&self, run: usize, part: usize) -> Option<usize> {
        match self {
            Self::EachRecord => Some(run + usize::from(run >= part)),
            Self::LastThird { .. } => Some(run),
        }
    }

    /// Values of some unknowns from those of others. An unknown without a counterpart keeps its
    /// value, such as the offset of a sensor in a held-out record.
    fn carried(
        &self,
        unknowns: &[Unknown],
        (known, values): &(Vec<Unknown>, Vec<f64>),
        place: impl Fn(usize) -> Option<usize>,
    ) -> Vec<f64> {
        let value = |unknown: &Unknown| {
            let of = match unknown.of {
                UnknownOf::Offset { sensor, run: Some(run) } => {
                    UnknownOf::Offset { sensor, run: Some(place(run)?) }
                }
                of => of,
            };
            Some(values[known.iter().position(|other| other.of == of)?])
        };
        unknowns.iter().map(|unknown| value(unknown).unwrap_or(unknown.own)).collect()
    }
}

/// Rejects an offset that is free in each record and has no prior: it leaves the level of a
/// held-out record open.
fn known_offsets(contender: &Contender) -> Result<(), ChoiceError> {
    let unknowns = contender.task.unknowns();
    let open = |unknown: &&Unknown| unknown.run().is_some() && unknown.prior.is_none();
    match unknowns.iter().find(open).and_then(Unknown::sensor) {
        Some(sensor) => Err(ChoiceError::Offset {
            contender: contender.name.clone(),
            sensor: contender.task.sensors[sensor].name.clone(),
        }),
        None => Ok(()),
    }
}

/// A record up to a time.
fn early(run: &MeasuredRun, until: f64) -> MeasuredRun {
    let mut run = run.clone();
    run.times.retain(|time| *time <= until);
    let rows = run.times.len();
    run.columns.iter_mut().for_each(|column| column.values.truncate(rows));
    run
}

/// The whole record, with NaN for all values up to a time.
fn late(run: &MeasuredRun, from: f64) -> MeasuredRun {
    let mut run = run.clone();
    for column in &mut run.columns {
        let rows = column.values.iter_mut().zip(&run.times);
        rows.filter(|(_, time)| **time <= from).for_each(|(value, _)| *value = f64::NAN);
    }
    run
}

/// Number of values, and root of the mean square in standard deviations and in the unit of all.
fn size(missed: &[Misses], one_unit: bool) -> (usize, f64, f64) {
    let samples: usize = missed.iter().map(|column| column.over_sigma.len()).sum();
    let mean = |of: &dyn Fn(&Misses, f64) -> f64| {
        let column = |misses: &Misses| -> f64 {
            misses.over_sigma.iter().map(|&one| of(misses, one).powi(2)).sum()
        };
        (missed.iter().map(column).sum::<f64>() / samples.max(1) as f64).sqrt()
    };
    let over_sigma = mean(&|_, one| one).max(SMALL);
    let unit = |misses: &Misses| if one_unit { misses.sigma } else { 1.0 };
    (samples, over_sigma, mean(&|misses, one| one * unit(misses)))
}
