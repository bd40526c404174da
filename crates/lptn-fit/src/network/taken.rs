//! Effect of the error of a fixed parameter.
//!
//! One more run of each record at the end has the derivatives by every parameter with a `±` that is
//! not varied. `(J^T J)^-1 J^T v` is the effect of its error. It is reported only if it is a tenth
//! of an error or more. The errors stay as they are, because the user chooses the estimated
//! parameters.

use lptn_network::{ParameterId, Varied};
use lptn_solve::{Proceed, SensitiveError, in_parallel};

use crate::network::design::Information;
use crate::network::fitted::NetworkFit;
use crate::network::prior::Priors;
use crate::network::readings::{Measure, Rows};
use crate::network::task::NetworkFitTask;
use crate::network::unknown::Unknown;

/// Tolerance of the runs in K.
const TOLERANCE: f64 = 1e-7;

/// A fixed parameter with an uncertainty.
#[derive(Clone, Debug, PartialEq)]
pub struct Off {
    /// The parameter.
    pub parameter: ParameterId,
    /// Its standard deviation in each record, in its SI unit; 0 if it is certain.
    pub by: Vec<f64>,
}

impl Off {
    /// Its largest standard deviation.
    pub fn most(&self) -> f64 {
        self.by.iter().copied().fold(0.0, f64::max)
    }
}

/// Effect of the error of a parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct Moved {
    /// Movement of each unknown, in its SI unit; `None` if it is not determined.
    pub by: Vec<Option<f64>>,
    /// The root of the sum of squares of the changes of all values, over their standard deviations.
    /// No unknown moves by more of its errors under independent noise.
    pub rows: f64,
}

impl NetworkFitTask {
    /// The parameters that are not estimated although they have an uncertainty: by a `±`, of the
    /// netlist or of the record, or by a posterior.
    pub fn taken_as_exact(&self) -> Vec<Off> {
        let mut found: Vec<Off> = Vec::new();
        for (i, run) in self.runs.iter().enumerate() {
            for (parameter, spread) in run.parameters.uncertain() {
                if self.parameters.iter().any(|varied| varied.parameter == parameter) {
                    continue;
                }
                let known = found.iter().position(|off| off.parameter == parameter);
                let at = known.unwrap_or(found.len());
                if known.is_none() {
                    found.push(Off { parameter, by: vec![0.0; self.runs.len()] });
                }
                let set = run.parameters.value(parameter);
                let value = set.unwrap_or_else(|| self.network.parameter_value(parameter));
                found[at].by[i] = spread.sigma(value);
            }
        }
        found
    }

    /// Effect of each of these at these values of the unknowns. Those that `counted` selects move,
    /// the others are fixed.
    ///
    /// # Errors
    /// Returns the error of a run that fails.
    pub fn moved_by(
        &self,
        off: &[Off],
        (values, counted): (&[f64], &dyn Fn(usize) -> bool),
    ) -> Result<Vec<Moved>, SensitiveError> {
        let unknowns = self.unknowns();
        let measured = self.with_held(off, (&unknowns, values))?;
        let count = unknowns.len();
        let mut told = Information::none(count);
        let mut pulls = vec![vec![0.0; count]; off.len()];
        let mut rows = vec![0.0; off.len()];
        let mut add = |x: &[f64], moves: &[f64]| {
            let x: Vec<f64> =
                x.iter().enumerate().map(|(i, x)| if counted(i) { *x } else { 0.0 }).collect();
            told.add_row(&x, 1.0);
            for ((pull, sum), by) in pulls.iter_mut().zip(&mut rows).zip(moves) {
                pull.iter_mut().zip(&x).for_each(|(pull, x)| *pull += x * by);
                *sum += by * by;
            }
        };
        for (run, measure) in measured.iter().enumerate() {
            let all = measure.residuals.len();
            for row in 0..all {
                let slope = |i: usize| measure.jacobian[i * all + row];
                let x: Vec<f64> = (0..count).map(slope).collect();
                let moves: Vec<f64> =
                    off.iter().enumerate().map(|(k, off)| slope(count + k) * off.by[run]).collect();
                add(&x, &moves);
            }
        }
        let none = vec![0.0; off.len()];
        let priors = Priors::of(&unknowns, &self.correlations);
        priors.rows(values).iter().for_each(|row| add(row, &none));
        let covariance = told.covariance();
        // if the model reads too high, the unknowns move to make it read less
        let moved = |(pull, rows): (&Vec<f64>, &f64)| Moved {
            by: (0..count).map(|i| covariance.moved(i, pull).map(|by| -by)).collect(),
            rows: rows.sqrt(),
        };
        Ok(pulls.iter().zip(&rows).map(moved).collect())
    }

    /// The runs of all records with derivatives by the unknowns, then by the fixed parameters.
    fn with_held(
        &self,
        off: &[Off],
        (unknowns, values): (&[Unknown], &[f64]),
    ) -> Result<Vec<Measure>, SensitiveError> {
        let held = off.iter().map(|off| Varied {
            parameter: off.parameter,
            bounds: (f64::NEG_INFINITY, f64::INFINITY),
            prior: None,
        });
        let all: Vec<usize> = (0..self.runs.len()).collect();
        let task = Self {
            parameters: self.parameters.iter().copied().chain(held).collect(),
            ..self.clone()
        };
        let estimated = task.unknowns();
        let is_held = |own: &&Unknown| unknowns.iter().all(|unknown| unknown.of != own.of);
        let held: Vec<&Unknown> = estimated.iter().filter(is_held).collect();
        let one = |&run: &usize| {
            let (mut unknowns, mut values) = (unknowns.to_vec(), values.to_vec());
            for own in &held {
                let id = own.parameter();
                // a record may have its own value
                values.push(id.map_or(own.own, |id| self.held_value(run, id)));
                unknowns.push((*own).clone());
            }
            let measured = &task.runs[run];
            let rows = Rows::new(&task, measured, usize::MAX);
            let tolerance = measured.settings.tolerance().min(TOLERANCE);
            task.measured((run, &rows), (&unknowns, &values), (tolerance, &|_| Proceed::Continue))
        };
        in_parallel(&all, self.threads, one).into_iter().collect()
    }

    /// The value that a parameter has in a record.
    fn held_value(&self, run: usize, id: ParameterId) -> f64 {
        self.runs[run].parameters.value(id).unwrap_or_else(|| self.network.parameter_value(id))
    }
}

impl NetworkFit {
    /// Effect of each of these on the parameters that have a standard error.
    ///
    /// # Errors
    /// Returns the error of a run that fails.
    pub fn moved_by(
        &self,
        task: &NetworkFitTask,
        off: &[Off],
    ) -> Result<Vec<Moved>, SensitiveError> {
        let values: Vec<f64> = self.parameters.iter().map(|fitted| fitted.value).collect();
        let counted = |i: usize| self.parameters[i].standard_error.is_some();
        task.moved_by(off, (&values, &counted))
    }
}
