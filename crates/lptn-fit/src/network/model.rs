//! The runs of all records for one set of parameters, with their derivatives.

use std::ops::Range;

use lptn_assembly::ChangeError;
use lptn_network::{Network, ParameterId};
use lptn_solve::{Gradient, Proceed, Progress, SensitiveError, in_parallel};

use crate::least_squares::{self, LeastSquaresError, Residuals};
use crate::network::coordinates::Coordinates;
use crate::network::error::NetworkFitError;
use crate::network::prior::Priors;
use crate::network::readings::{Beside, Measure, Reader, Rows};
use crate::network::task::{FitObserver, FitStage, NetworkFitTask};
use crate::network::unknown::Unknown;

/// Error that a temperature may have, in tolerances.
const ERROR: f64 = 10.0;

/// The residuals of one column of one record.
#[derive(Clone, Debug)]
pub(crate) struct Block {
    pub(crate) run: usize,
    pub(crate) column: usize,
    /// Range of its residuals.
    pub(crate) range: Range<usize>,
    /// Range of its rows, with those in which nothing was measured.
    pub(crate) rows: Range<usize>,
}

/// Residuals over their standard deviations, and their derivatives one parameter after the other,
/// in SI units.
#[derive(Clone, Debug)]
pub(crate) struct Evaluated {
    pub(crate) values: Vec<f64>,
    /// The temperatures in every row of every block.
    pub(crate) modelled: Vec<f64>,
    pub(crate) residuals: Vec<f64>,
    pub(crate) jacobian: Vec<f64>,
}

/// Computes the task's runs at some of the records' rows.
pub(crate) struct Model<'a> {
    task: &'a NetworkFitTask,
    unknowns: &'a [Unknown],
    coordinates: &'a Coordinates,
    /// Prior knowledge.
    priors: Priors,
    /// The rows of each record that count.
    rows: Vec<Rows>,
    pub(crate) blocks: Vec<Block>,
    tolerance: f64,
    /// Kind of the derivatives; known after the first runs.
    pub(crate) gradient: Option<Gradient>,
    /// The last evaluation.
    last: Option<Evaluated>,
    /// Number of evaluations of the runs of all records.
    pub(crate) evaluations: usize,
    /// Progress of the fit, without the evaluations of this model.
    pub(crate) stage: FitStage,
    /// The least sum of squares up to now, and its values.
    pub(crate) best: Option<(f64, Vec<f64>)>,
    /// True if the observer has interrupted the fit.
    pub(crate) interrupted: bool,
    observer: &'a FitObserver<'a>,
}

impl<'a> Model<'a> {
    /// With at most `most` rows of each record, taken at equal intervals.
    pub(crate) fn new(
        (task, observer): (&'a NetworkFitTask, &'a FitObserver<'a>),
        (unknowns, coordinates): (&'a [Unknown], &'a Coordinates),
        (most, tolerance): (usize, f64),
    ) -> Self {
        let rows: Vec<Rows> = task.runs.iter().map(|run| Rows::new(task, run, most)).collect();
        let blocks = blocks(task, &rows);
        let stage = FitStage { search: 0, of: 1, evaluations: 0 };
        Self {
            task,
            unknowns,
            coordinates,
            priors: Priors::of(unknowns, &task.correlations),
            rows,
            blocks,
            tolerance,
            gradient: None,
            last: None,
            evaluations: 0,
            stage,
            best: None,
            interrupted: false,
            observer,
        }
    }

    /// The reason why a search ended without an answer.
    pub(crate) fn ended(&self, error: LeastSquaresError) -> NetworkFitError {
        match error {
            LeastSquaresError::Interrupted => self.broken_off(),
            error => NetworkFitError::Search(error),
        }
    }

    /// The error of an interrupted fit, with the best values.
    pub(crate) fn broken_off(&self) -> NetworkFitError {
        let best = self.best.as_ref().map(|(_, values)| values.clone());
        NetworkFitError::Interrupted { stage: self.stage_now(), best }
    }

    pub(crate) fn stage_now(&self) -> FitStage {
        FitStage { evaluations: self.stage.evaluations + self.evaluations, ..self.stage }
    }

    /// Number of residuals of the records; those of the priors follow.
    pub(crate) fn data(&self) -> usize {
        self.blocks.last().map_or(0, |block| block.range.end)
    }

    /// The root of the sum of the squares of the residuals' errors from errors of the runs.
    pub(crate) fn error(&self) -> f64 {
        let of = |block: &Block| {
            let weight = self.task.runs[block.run].columns[block.column].weight();
            block.range.len() as f64 / (weight * weight)
        };
        ERROR * self.tolerance * self.blocks.iter().map(of).sum::<f64>().sqrt()
    }

    /// The error if a column's quantity had no value in the last evaluation although something was
    /// measured: an expression may have none.
    pub(crate) fn without_value(&self) -> Option<NetworkFitError> {
        let last = self.last.as_ref()?;
        self.blocks.iter().find_map(|block| {
            let run = &self.task.runs[block.run];
            let column = &run.columns[block.column];
            let rows = self.rows[block.run].chosen.iter().zip(&last.modelled[block.rows.clone()]);
            let mut lost =
                rows.filter(|(row, model)| !column.values[**row].is_nan() && !model.is_finite());
            lost.next().map(|(&row, _)| NetworkFitError::NoValue {
                record: run.name.clone(),
                column: column.name.clone(),
                time: run.times[row],
            })
        })
    }

    /// Residuals and derivatives for values in SI units; or the record whose run failed, and the
    /// reason.
    pub(crate) fn at(&mut self, values: &[f64]) -> Result<&Evaluated, (usize, SensitiveError)> {
        if self.last.as_ref().is_none_or(|last| last.values != values) {
            self.last = None;
            let found = self.evaluate(values).inspect_err(|(_, error)| {
                self.interrupted |= matches!(error, SensitiveError::Interrupted);
            })?;
            let squares: f64 = found.residuals.iter().map(|residual| residual * residual).sum();
            if squares.is_finite() && self.best.as_ref().is_none_or(|(least, _)| squares < *least) {
                self.best = Some((squares, values.to_vec()));
            }
            self.last = Some(found);
        }
        self.last.as_ref().ok_or_else(|| unreachable!("it was just set"))
    }

    fn evaluate(&mut self, values: &[f64]) -> Result<Evaluated, (usize, SensitiveError)> {
        self.evaluations += 1;
        let all: Vec<usize> = (0..self.task.runs.len()).collect();
        let run = |&i: &usize| self.run(i, values).map_err(|error| (i, error));
        let runs: Vec<Measure> =
            in_parallel(&all, self.task.threads, run).into_iter().collect::<Result<_, _>>()?;
        // one record's refusal causes differences of its runs only: report it for all
        let differences = |measure: &&Measure| measure.gradient != Gradient::Exact;
        let gradient = runs.iter().find(differences).or(runs.first());
        self.gradient = gradient.map(|measure| measure.gradient);
        Ok(self.with_priors(values, &runs))
    }

    fn with_priors(&self, values: &[f64], runs: &[Measure]) -> Evaluated {
        let (data, count) = (self.data(), values.len());
        let mut residuals: Vec<f64> = Vec::with_capacity(data + self.priors.count());
        runs.iter().for_each(|run| residuals.extend_from_slice(&run.residuals));
        let modelled = runs.iter().flat_map(|run| &run.modelled).copied().collect();
        residuals.extend(self.priors.residuals(values));
        let mut jacobian = Vec::with_capacity(residuals.len() * count);
        for j in 0..count {
            for run in runs {
                let rows = run.residuals.len();
                jacobian.extend_from_slice(&run.jacobian[j * rows..(j + 1) * rows]);
            }
            jacobian.extend(self.priors.slopes(values, j));
        }
        Evaluated { values: values.to_vec(), modelled, residuals, jacobian }
    }

    /// One record's run.
    fn run(&self, i: usize, values: &[f64]) -> Result<Measure, SensitiveError> {
        let (rows, stage) = (&self.rows[i], self.stage_now());
        let at = (self.unknowns, values);
        self.task.measured((i, rows), at, (self.tolerance, &|step| (self.observer)(stage, step)))
    }
}

impl NetworkFitTask {
    /// A record's run with these values of the unknowns, compared with the record.
    pub(crate) fn measured(
        &self,
        (run, rows): (usize, &Rows),
        (unknowns, values): (&[Unknown], &[f64]),
        (tolerance, observer): (f64, &dyn Fn(Progress) -> Proceed),
    ) -> Result<Measure, SensitiveError> {
        let settings = rows.settings(&self.runs[run], tolerance);
        let computed = |values: &[f64], ids: &[ParameterId]| {
            let network = self.network_of(run, (unknowns, values))?;
            settings.with_slopes((&network, ids), observer)
        };
        let ids: Vec<ParameterId> = self.parameters.iter().map(|varied| varied.parameter).collect();
        let found = computed(values, &ids)?;
        let mut beside = Vec::new();
        for (i, unknown) in unknowns.iter().enumerate() {
            let Some(by) = self.runs[run].change(run, unknown) else { continue };
            let moved = |by: f64| {
                let mut moved = values.to_vec();
                moved[i] += by;
                computed(&moved, &[])
            };
            beside.push(Beside {
                unknown: i,
                runs: [moved(-by)?.result, moved(by)?.result],
                distance: 2.0 * by,
            });
        }
        let reader = Reader { task: self, run, rows, unknowns, values, beside: &beside };
        Ok(reader.measure(&found))
    }

    /// The network of one record with values of the unknowns in SI units.
    fn network_of(
        &self,
        place: usize,
        (unknowns, values): (&[Unknown], &[f64]),
    ) -> Result<Network, SensitiveError> {
        let run = &self.runs[place];
        let mut parameters = run.parameters.clone();
        for (unknown, &value) in unknowns.iter().zip(values) {
            unknown.parameter().into_iter().for_each(|id| parameters.set(id, value));
        }
        let network = self.network.with(&parameters).map_err(ChangeError::from)?;
        if run.signals.is_empty() && run.initial.is_empty() {
            return Ok(network);
        }
        let held = |sensor| self.held((sensor, place), (unknowns, values));
        let signals = run.signals.iter();
        let signals: Vec<_> = signals.map(|s| (s.signal, s.course(held(s.sensor)))).collect();
        let initial: Vec<_> = run.initial.iter().map(|s| s.begins(held(s.sensor))).collect();
        Ok(network.recorded(&signals, &initial).map_err(ChangeError::from)?)
    }
}

fn blocks(task: &NetworkFitTask, rows: &[Rows]) -> Vec<Block> {
    let mut blocks = Vec::new();
    let (mut from, mut first) = (0, 0);
    for (run, measured) in task.runs.iter().enumerate() {
        for (column, values) in measured.columns.iter().enumerate() {
            let chosen = &rows[run].chosen;
            let count = chosen.iter().filter(|&&row| !values.values[row].is_nan()).count();
            let all = first..first + chosen.len();
            blocks.push(Block { run, column, range: from..from + count, rows: all.clone() });
            (from, first) = (from + count, all.end);
        }
    }
    blocks
}

impl Residuals for Model<'_> {
    fn parameters(&self) -> usize {
        self.unknowns.len()
    }

    /// Derivatives come with the runs at little cost, so they are always computed: the next call
    /// may ask for them.
    fn evaluate(&mut self, p: &[f64], _: bool) -> least_squares::Evaluated {
        let (values, slopes) = self.coordinates.values(p);
        let count = self.data() + self.priors.count();
        match self.at(&values) {
            Ok(found) => {
                let columns = found.jacobian.chunks(found.residuals.len().max(1)).zip(slopes);
                let scaled =
                    columns.flat_map(|(column, slope)| column.iter().map(move |x| x * slope));
                Ok((found.residuals.clone(), scaled.collect()))
            }
            Err((_, SensitiveError::Interrupted)) => Err(LeastSquaresError::Interrupted),
            Err(_) => Ok((vec![f64::NAN; count], vec![f64::NAN; count * p.len()])),
        }
    }
}
