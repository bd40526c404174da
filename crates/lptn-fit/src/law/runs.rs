//! From records at several speeds to a law: the seed paper from Figure 6 to Figure 9.

use lptn_solve::in_parallel;
use lptn_units::statistics;

use super::candidate::{LawFit, Outcome};
use super::columns::{ColumnFits, RunFit};
use super::consistency::Consistency;
use super::error::LawError;
use super::model::LossLaw;
use super::points::Points;
use super::slopes::{ColumnDifference, ColumnLines};
use super::solve;
use super::study::LawStudy;
use crate::step::{Capacity, Power, ReferenceTemperature, Sensor, StepError, StepFit};

/// A record at one speed.
#[derive(Clone, Debug, PartialEq)]
pub struct Run {
    /// Its name in messages and tables, such as its file.
    pub name: String,
    /// Its speed in rad/s, above 0.
    pub speed: f64,
    /// Times in s, ascending.
    pub times: Vec<f64>,
    /// Temperatures by column: name, and K at every time, NaN for gaps. All runs have the same
    /// columns.
    pub columns: Vec<(String, Vec<f64>)>,
}

/// The zero of dT of all runs.
#[derive(Clone, Debug, PartialEq)]
pub enum RunReference {
    /// `T_i` of each fit.
    Initial,
    /// The mean of a column of the same record.
    Column(String),
    /// A temperature in K.
    Value(f64),
}

/// Settings that turn records into powers.
#[derive(Clone, Debug)]
pub struct RunsSettings {
    /// The columns to fit; the first is the one whose power gets a law.
    pub columns: Vec<String>,
    /// The heat capacity.
    pub capacity: Capacity,
    /// The zero of dT.
    pub reference: RunReference,
    /// The class of the thermocouples.
    pub sensor: Sensor,
    /// True if every run has the same weight, whatever the random error of its power.
    pub unweighted: bool,
    /// The laws to fit; if it is empty, [`LossLaw::standard`].
    pub laws: Vec<LossLaw>,
    /// Number of threads.
    pub threads: usize,
}

lptn_units::errors! {
/// Reasons why a study is not possible.
#[derive(Debug)]
pub enum RunsError {
    /// A run has no such column.
    Column { run: String, column: String } = "record::no_column",
        format!("{run} has no column `{column}`");
    /// A column of a run could not be fitted.
    Step { run: String, column: String, error: Box<StepError> } = error.code(),
        format!("{run}, column `{column}`: {error}"), source error.as_ref(), help error.help();
    /// The powers could not become points of a law.
    LossLaw => LawError;
}
}

/// Change of a coefficient by one standard deviation of an error that all runs share.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Systematic {
    /// Change by the capacity.
    pub capacity: f64,
    /// Change by the offset of the sensors; 0 if the reference is `T_i` of the same one.
    pub offset: f64,
    /// Change by the gain of the sensors.
    pub gain: f64,
}

impl Systematic {
    /// All three together, in quadrature.
    pub fn total(&self) -> f64 {
        self.capacity.hypot(self.offset).hypot(self.gain)
    }
}

/// Results of a study.
#[derive(Clone, Debug)]
pub struct RunsStudy {
    /// Name and speed in rad/s of every run.
    pub runs: Vec<(String, f64)>,
    /// The columns that were fitted.
    pub columns: Vec<ColumnFits>,
    /// The laws of the first column's power.
    pub laws: LawStudy,
    /// The exponents of the first column's rise, time constant and power; `None` if there are too
    /// few runs, or a rise that is not above 0. The power was computed from the other two: this
    /// shows which laws of them are possible.
    pub consistency: Option<Consistency>,
    /// The lines of every column over the speed.
    pub lines: Vec<ColumnLines>,
    /// The first column less each of the others.
    pub differences: Vec<ColumnDifference>,
    settings: RunsSettings,
}

impl RunsStudy {
    /// Fits every column of every run, and laws to the powers of the first column.
    ///
    /// # Errors
    /// [`RunsError`] for the first run that cannot be fitted.
    pub fn new(runs: &[Run], settings: RunsSettings) -> Result<Self, RunsError> {
        let fitted = in_parallel(runs, settings.threads, |run| fits(run, &settings));
        let fitted: Result<Vec<Vec<RunFit>>, RunsError> = fitted.into_iter().collect();
        let mut columns: Vec<ColumnFits> =
            settings.columns.iter().map(|column| ColumnFits::named(column)).collect();
        for fits in fitted? {
            columns.iter_mut().zip(fits).for_each(|(column, fit)| column.fits.push(fit));
        }
        let speeds: Vec<f64> = runs.iter().map(|run| run.speed).collect();
        let first = columns.first().map_or(&[][..], |column| &column.fits);
        let power = first.iter().map(|f| f.power.power.value).collect();
        let random = || first.iter().map(|f| f.power.power.random).collect();
        let weights = (!settings.unweighted).then(random);
        let points = Points::new(speeds.clone(), power, weights)?;
        let laws =
            if settings.laws.is_empty() { LossLaw::standard() } else { settings.laws.clone() };
        let consistency = |column: &ColumnFits| {
            column.consistency(&speeds, settings.capacity, settings.unweighted)
        };
        let lines = |c: &ColumnFits| ColumnLines::of(c, &speeds, consistency(c).as_ref());
        Ok(Self {
            runs: runs.iter().map(|run| (run.name.clone(), run.speed)).collect(),
            consistency: columns.first().and_then(consistency),
            lines: columns.iter().map(lines).collect(),
            differences: ColumnDifference::all(&columns, &speeds),
            laws: LawStudy::new(points, laws),
            columns,
            settings,
        })
    }

    /// The systematic errors of the coefficients of a law, in its order and in SI units: from fits
    /// to powers that are off by one standard deviation. `None` if the law was not fitted.
    pub fn systematic(&self, candidate: &LawFit) -> Option<Vec<Systematic>> {
        let before = candidate.fitted()?;
        let first = &self.columns.first()?.fits;
        let capacity = self.settings.capacity;
        let sensors = match self.settings.reference {
            RunReference::Initial => 0.0,
            RunReference::Value(_) => 1.0,
            RunReference::Column(_) => 2.0,
        };
        let offset = f64::sqrt(sensors) * self.settings.sensor.class / 3_f64.sqrt();
        let moved = |by: &dyn Fn(&RunFit) -> f64| {
            let power = first.iter().map(|f| f.power.power.value + by(f)).collect();
            match solve::fit(&candidate.law, &self.laws.points.with_power(power)) {
                Outcome::Fitted(fit) => {
                    let change = fit.coefficients.iter().zip(&before.coefficients);
                    Some(change.map(|(a, b)| (a.value - b.value).abs()).collect::<Vec<f64>>())
                }
                _ => None,
            }
        };
        let by_capacity = moved(&|f| f.power.power.value * capacity.deviation / capacity.value)?;
        let by_offset = moved(&|f| offset * capacity.value / f.fit.tau.value)?;
        let by_gain = moved(&|f| f.power.power.value * self.settings.sensor.gain)?;
        let all = by_capacity.into_iter().zip(by_offset).zip(by_gain);
        Some(all.map(|((capacity, offset), gain)| Systematic { capacity, offset, gain }).collect())
    }

    /// Mean of a column's time constants in s and their standard deviation (divisor: number less
    /// one), as the paper's Figure 8 gives them; the deviation of a single run is NaN.
    pub fn time_constant(&self, column: &ColumnFits) -> (f64, f64) {
        let taus: Vec<f64> = column.fits.iter().map(|f| f.fit.tau.value).collect();
        let squares = statistics::squares_about_mean(&taus);
        (statistics::mean(&taus), (squares / (taus.len() as f64 - 1.0)).sqrt())
    }

    /// Settings of the study.
    pub fn settings(&self) -> &RunsSettings {
        &self.settings
    }
}

/// The fits of one run, in the order of the columns.
fn fits(run: &Run, settings: &RunsSettings) -> Result<Vec<RunFit>, RunsError> {
    let find = |column: &String| {
        let found = run.columns.iter().find(|(name, _)| name == column).map(|(_, values)| values);
        found.ok_or_else(|| RunsError::Column { run: run.name.clone(), column: column.clone() })
    };
    let reference = match &settings.reference {
        RunReference::Initial => ReferenceTemperature::Initial,
        RunReference::Value(kelvin) => ReferenceTemperature::Value(*kelvin),
        RunReference::Column(name) => ReferenceTemperature::Column {
            name: name.clone(),
            times: &run.times,
            temperatures: find(name)?,
        },
    };
    let fitted = |column: &String| {
        let failed = |error| {
            let (run, column) = (run.name.clone(), column.clone());
            RunsError::Step { run, column, error: Box::new(error) }
        };
        let fit = StepFit::new(&run.times, find(column)?).map_err(failed)?;
        let power =
            Power::new(&fit, settings.capacity, &reference, settings.sensor).map_err(failed)?;
        Ok(RunFit { fit, power })
    };
    settings.columns.iter().map(fitted).collect()
}
