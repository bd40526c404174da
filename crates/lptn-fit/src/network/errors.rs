//! How well the parameters are determined, from what is left over.

use crate::Covariance;
use crate::network::fitted::ColumnMisfit;
use crate::network::hint::{Hint, Missed};
use crate::network::identify::Identifiability;
use crate::network::model::{Block, Evaluated, Model};
use crate::network::task::NetworkFitTask;
use crate::noise::{Middle, Noise, degrees_of, student_95};

/// With fewer values than this left over, residuals alone do not tell the noise.
const FEW: usize = 10;

/// Residuals and derivatives at the end of a fit, and the noise of every column.
pub(crate) struct Errors<'a> {
    task: &'a NetworkFitTask<'a>,
    at_end: &'a Evaluated,
    /// Number of residuals that are data.
    data: usize,
    /// The parameters that have a standard error, and those that are held for it.
    free: Vec<usize>,
    columns: Vec<ColumnNoise<'a>>,
}

/// One column with values.
struct ColumnNoise<'a> {
    block: &'a Block,
    noise: Noise,
    /// `J^T Omega J` of the free parameters.
    middle: Middle,
}

impl<'a> Errors<'a> {
    /// With the parameters that sit on no bound. Where some cannot be told apart, so many of them
    /// are held that the others can; the errors of the determined ones do not depend on which.
    pub(crate) fn new(
        task: &'a NetworkFitTask<'a>,
        model: &'a Model<'_>,
        (at_end, inside, known): (&'a Evaluated, &[usize], Option<&Identifiability>),
    ) -> Self {
        let held: Vec<usize> = known
            .iter()
            .flat_map(|known| &known.unseparated)
            .flat_map(|group| group.held())
            .collect();
        let unfelt = |i: &usize| known.is_none_or(|known| known.unfelt.contains(i));
        let free: Vec<usize> =
            inside.iter().copied().filter(|i| !unfelt(i) && !held.contains(i)).collect();
        let mut errors = Self { task, at_end, data: model.data(), free, columns: Vec::new() };
        let blocks = model.blocks.iter().filter(|block| !block.range.is_empty());
        errors.columns = blocks.map(|block| errors.noise_of(block)).collect();
        errors
    }

    fn noise_of(&self, block: &'a Block) -> ColumnNoise<'a> {
        let run = &self.task.runs[block.run];
        let values = &run.columns[block.column].values;
        let rows = run.times.iter().zip(values).filter(|(_, value)| !value.is_nan());
        let times: Vec<f64> = rows.map(|(time, _)| *time).collect();
        let slopes: Vec<f64> = self
            .free
            .iter()
            .flat_map(|&i| self.derivatives(i)[block.range.clone()].iter().copied())
            .collect();
        let residuals = &self.at_end.residuals[block.range.clone()];
        // a single record may drift as slowly as its curve rises
        let noise = match self.task.runs.len() {
            1 => Noise::with_slow_drift(&times, residuals, &slopes),
            _ => Noise::estimate(&times, residuals, &slopes),
        };
        let middle = noise.middle(&times, &slopes);
        ColumnNoise { block, noise, middle }
    }

    /// Of all residuals by one parameter.
    fn derivatives(&self, parameter: usize) -> &[f64] {
        let rows = self.at_end.residuals.len();
        &self.at_end.jacobian[parameter * rows..(parameter + 1) * rows]
    }

    pub(crate) fn columns(&self) -> Vec<ColumnMisfit> {
        let missed = Missed {
            task: self.task,
            at_end: self.at_end,
            blocks: self.columns.iter().map(|column| column.block).collect(),
            slopes: self.free.iter().map(|&i| self.derivatives(i)).collect(),
        };
        let hints = missed.hints();
        self.columns.iter().map(|column| self.misfit(column, &hints)).collect()
    }

    fn misfit(&self, column: &ColumnNoise<'_>, hints: &[Option<Hint>]) -> ColumnMisfit {
        let block = column.block;
        let measured = &self.task.runs[block.run].columns[block.column];
        let residuals = &self.at_end.residuals[block.range.clone()];
        let samples = residuals.len();
        let mean = |of: &dyn Fn(f64) -> f64| {
            residuals.iter().map(|&r| of(r * measured.weight())).sum::<f64>() / samples as f64
        };
        let rms = mean(&|residual| residual * residual).sqrt();
        let modelled = &self.at_end.modelled[block.rows.clone()];
        ColumnMisfit {
            run: block.run,
            column: block.column,
            samples,
            effective: column.noise.effective,
            slow_drift: column.noise.drifts(),
            rms,
            mean: mean(&|residual| residual),
            sigma: measured.sigma,
            hint: hints.get(block.column).copied().flatten(),
            modelled: modelled.to_vec(),
        }
    }

    /// Values and priors beyond those that the free parameters take up.
    pub(crate) fn left_over(&self) -> usize {
        self.at_end.residuals.len().saturating_sub(self.free.len())
    }

    /// The covariance of the free parameters: `(J^T J)^-1 J^T Omega J (J^T J)^-1` with the
    /// covariance Omega of the residuals. Few residuals may be small by chance, and as many as
    /// parameters vanish: then errors are at least those that the standard deviations given say,
    /// and where none are given and nothing is left over there are none.
    pub(crate) fn covariance(&self) -> Option<Covariance> {
        if self.free.is_empty() || self.data == 0 {
            return None;
        }
        let inverse =
            Covariance::inverse(&self.at_end.jacobian, self.at_end.residuals.len(), &self.free)?;
        let found = inverse.sandwich(&self.middle());
        let given = self.columns.iter().all(|column| self.sigma(column).is_some());
        match self.left_over() {
            0 => given.then_some(inverse),
            left if left < FEW && given => Some(inverse.at_least(&found)),
            _ => Some(found),
        }
    }

    /// Half the width of the 95 % interval of a free parameter, and the degrees of freedom of the
    /// quantile of Student's t that it takes: each column tells the variance that it brings in with
    /// those of its own noise, and what is known beforehand is known (F. E. Satterthwaite,
    /// Biometrics Bulletin 2 (1946) 110). Slow drift of several columns adds up in the squares of
    /// half the widths that it alone has.
    pub(crate) fn interval(&self, covariance: &Covariance, parameter: usize) -> Option<(f64, f64)> {
        let error = covariance.standard_error(parameter)?;
        let inverse =
            Covariance::inverse(&self.at_end.jacobian, self.at_end.residuals.len(), &self.free)?;
        if self.left_over() == 0 {
            return Some((student_95(f64::INFINITY) * error, f64::INFINITY));
        }
        let count = self.at_end.jacobian.len() / self.at_end.residuals.len();
        let gradient: Vec<f64> = (0..count).map(|i| f64::from(u8::from(i == parameter))).collect();
        let found = inverse.sandwich(&self.middle()).standard_error(parameter)?;
        let (mut known, mut uncertain, mut drift) = (found * found, 0.0, 0.0);
        for column in &self.columns {
            let (variance, degrees) = column.middle.variance(&inverse, &gradient);
            if column.noise.drifts() {
                known -= variance;
                drift += variance * student_95(degrees).powi(2);
            } else {
                uncertain += variance * variance / degrees;
            }
        }
        let known = known.max(0.0);
        let degrees = if uncertain > 0.0 { known * known / uncertain } else { f64::INFINITY };
        let half = (known * student_95(degrees).powi(2) + drift).sqrt();
        let degrees = if drift > 0.0 { degrees_of(half / found) } else { degrees };
        // where few values are left over, the errors that `sigma` says are known
        Some((half.max(student_95(f64::INFINITY) * error), degrees))
    }

    /// The rise of the sum of squares at the end of an interval of this half width: that over the
    /// error that independent residuals of unit variance would leave, squared.
    pub(crate) fn rise(&self, parameter: usize, half: f64) -> Option<f64> {
        let rows = self.at_end.residuals.len();
        let inverse = Covariance::inverse(&self.at_end.jacobian, rows, &self.free)?;
        Some((half / inverse.standard_error(parameter)?).powi(2))
    }

    fn sigma(&self, column: &ColumnNoise<'_>) -> Option<f64> {
        self.task.runs[column.block.run].columns[column.block.column].sigma
    }

    fn middle(&self) -> Vec<f64> {
        let n = self.free.len();
        // priors are what they are said to be
        let prior = |i: usize| &self.derivatives(self.free[i])[self.data..];
        let dot =
            |at: usize| prior(at / n).iter().zip(prior(at % n)).map(|(a, b)| a * b).sum::<f64>();
        let mut middle: Vec<f64> = (0..n * n).map(dot).collect();
        for column in &self.columns {
            middle.iter_mut().zip(&column.middle.values).for_each(|(sum, part)| *sum += part);
        }
        middle
    }
}
