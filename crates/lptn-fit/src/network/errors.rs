//! Standard errors of the parameters, from the residuals.

use lptn_integrate::vectors::dot;
use lptn_units::statistics::{degrees_of, student_95};

use crate::Covariance;
use crate::network::between::{BetweenRecords, Told};
use crate::network::fitted::ColumnMisfit;
use crate::network::hint::{Hint, Missed};
use crate::network::identify::Identifiability;
use crate::network::model::{Block, Evaluated, Model};
use crate::network::shared::{Shared, SharedNoise};
use crate::network::task::NetworkFitTask;
use crate::noise::{Middle, Noise, Whitened};

/// If fewer values than this are left over, residuals alone do not determine the noise.
const FEW: usize = 10;

/// Residuals and derivatives at the end of a fit, and the noise of every column.
pub(crate) struct Errors<'a> {
    task: &'a NetworkFitTask,
    at_end: &'a Evaluated,
    /// Number of residuals that are data.
    data: usize,
    /// The parameters that have a standard error.
    free: Vec<usize>,
    columns: Vec<ColumnNoise<'a>>,
    /// Noise that the columns of each record share.
    shared: Vec<Shared>,
    /// `(J^T J)^-1` of the free parameters.
    inverse: Option<Covariance>,
    /// Scatter of the records in each free parameter, if enough of them determine it.
    between: Vec<Option<BetweenRecords>>,
}

/// One column with values.
struct ColumnNoise<'a> {
    block: &'a Block,
    noise: Noise,
    /// `J^T Omega J` of the free parameters.
    middle: Middle,
    /// The same noise as independent values, if the record has other columns.
    whitened: Option<Whitened>,
}

impl<'a> Errors<'a> {
    /// With the parameters that are not on a bound. If some cannot be distinguished, enough of them
    /// are fixed to separate the others. The errors of the determined ones do not depend on the
    /// choice.
    pub(crate) fn new(
        task: &'a NetworkFitTask,
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
        let inverse = match free.is_empty() {
            true => None,
            false => Covariance::inverse(&at_end.jacobian, at_end.residuals.len(), &free),
        };
        let (data, columns, shared, between) = (model.data(), vec![], vec![], vec![]);
        let mut errors = Self { task, at_end, data, free, columns, shared, inverse, between };
        let blocks = model.blocks.iter().filter(|block| !block.range.is_empty());
        errors.columns = blocks.map(|block| errors.noise_of(block)).collect();
        errors.shared = (0..task.runs.len()).filter_map(|run| errors.shared_in(run)).collect();
        errors.between = errors.free.iter().map(|&i| errors.scatter(i)).collect();
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
        // records may drift as slowly as their curves rise; three or more show it by their scatter
        let noise = match self.task.runs.len() {
            records @ 1..=2 => Noise::with_slow_drift((&times, residuals, &slopes), records == 1),
            _ => Noise::estimate(&times, residuals, &slopes),
        };
        let middle = noise.middle(&times, &slopes);
        let alone = run.columns.len() < 2;
        let whitened = (!alone).then(|| noise.whitened(&times, (residuals, &slopes)));
        ColumnNoise { block, noise, middle, whitened }
    }

    /// Noise that the columns of a record share.
    fn shared_in(&self, run: usize) -> Option<Shared> {
        let own = self.columns.iter().enumerate().filter(|(_, column)| column.block.run == run);
        Shared::of(run, own.filter_map(|(i, c)| Some((i, c.whitened.as_ref()?))).collect())
    }

    /// The records whose columns are off together by more than chance explains.
    pub(crate) fn shared_noise(&self) -> Vec<SharedNoise> {
        self.shared.iter().filter_map(Shared::told).collect()
    }

    /// Derivatives of all residuals by one parameter.
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
    /// parameters vanish. Errors are then at least those of the given standard deviations. If none
    /// are given and nothing is left over, there are none.
    pub(crate) fn covariance(&self) -> Option<Covariance> {
        let inverse = self.inverse.as_ref().filter(|_| self.data > 0)?;
        let found = self.with_records(self.of_noise(inverse, &self.prior()));
        let given = self.columns.iter().all(|column| self.sigma(column).is_some());
        match self.left_over() {
            0 => given.then(|| inverse.clone()),
            left if left < FEW && given => Some(inverse.at_least(&found)),
            _ => Some(found),
        }
    }

    /// The covariance from the noise of the records and `more` of `J^T Omega J`. Shared noise only
    /// widens it: a difference of columns may be known better, but how much better is an estimate.
    fn of_noise(&self, inverse: &Covariance, more: &[f64]) -> Covariance {
        let alone: Vec<f64> = self.noise().iter().zip(more).map(|(a, b)| a + b).collect();
        let mut all = alone.clone();
        for shared in &self.shared {
            all.iter_mut().zip(shared.middle()).for_each(|(sum, part)| *sum += part);
        }
        let found = inverse.sandwich(&alone);
        if self.shared.is_empty() { found } else { inverse.sandwich(&all).at_least(&found) }
    }

    /// Half the width of the 95 % interval of a free parameter, and the degrees of freedom of its
    /// quantile of Student's t. Each column adds its variance with the degrees of freedom of its
    /// own noise; priors are exact (F. E. Satterthwaite, Biometrics Bulletin 2 (1946) 110). Slow
    /// drifts of several columns add up in the squares of their half widths. Shared noise widens
    /// all of it.
    pub(crate) fn interval(&self, covariance: &Covariance, parameter: usize) -> Option<(f64, f64)> {
        let error = covariance.standard_error(parameter)?;
        let inverse = self.inverse.as_ref()?;
        if self.left_over() == 0 {
            return Some((student_95(f64::INFINITY) * error, f64::INFINITY));
        }
        let found = inverse.sandwich(&self.middle()).standard_error(parameter)?;
        let (mut known, mut drift) = (found * found, 0.0);
        let each = self.variances(inverse, parameter);
        for (column, (variance, degrees)) in self.columns.iter().zip(&each) {
            if column.noise.drifts() {
                known -= variance;
                drift += variance * student_95(*degrees).powi(2);
            }
        }
        let (wider, more) = self.in_common(parameter, found * found)?;
        let known = wider * known.max(0.0);
        let uncertain = wider * wider * self.uncertain(&each) + more;
        let degrees = if uncertain > 0.0 { known * known / uncertain } else { f64::INFINITY };
        let half = (known * student_95(degrees).powi(2) + wider * drift).sqrt();
        let degrees = if drift > 0.0 { degrees_of(half / (found * wider.sqrt())) } else { degrees };
        // if few values are left over, the errors from `sigma` are known
        let inside = (half.max(student_95(f64::INFINITY) * error), degrees);
        Some(self.widened(parameter, inside).unwrap_or(inside))
    }

    /// The variance of a parameter from each column, and its degrees of freedom.
    fn variances(&self, inverse: &Covariance, parameter: usize) -> Vec<(f64, f64)> {
        let gradient = self.unit(parameter);
        self.columns.iter().map(|column| column.middle.variance(inverse, &gradient)).collect()
    }

    /// Half of the uncertainty of the variances of all columns together, as a variance, without
    /// those that drift. Columns with the same noise are one estimate, not several.
    fn uncertain(&self, each: &[(f64, f64)]) -> f64 {
        let of = |column: usize| match self.columns[column].noise.drifts() {
            true => 0.0,
            false => each[column].0 / each[column].1.sqrt(),
        };
        let alone: f64 = (0..each.len()).map(|column| of(column).powi(2)).sum();
        let pairs = |shared: &Shared| -> f64 {
            let columns = || shared.columns.iter().enumerate();
            let pair = |(c, i): (usize, &usize)| -> f64 {
                let others = columns().filter(|(d, _)| *d != c);
                others.map(|(d, j)| shared.alike(c, d).powi(2) * of(*i) * of(*j)).sum()
            };
            columns().map(pair).sum()
        };
        alone + self.shared.iter().map(pairs).sum::<f64>()
    }

    /// Factor by which shared noise of columns increases the variance of a parameter, at least 1,
    /// and half of its uncertainty, as a variance.
    fn in_common(&self, parameter: usize, variance: f64) -> Option<(f64, f64)> {
        let weights = self.weights(parameter)?;
        let all = self.shared.iter().map(|shared| shared.variance(&weights));
        let (adds, uncertain) = all.fold((0.0, 0.0), |sum, one| (sum.0 + one.0, sum.1 + one.1));
        let wider = if variance > 0.0 { 1.0 + adds / variance } else { 1.0 };
        Some(if wider > 1.0 { (wider, uncertain) } else { (1.0, 0.0) })
    }

    /// Effect of `J^T r` on a free parameter.
    fn weights(&self, parameter: usize) -> Option<Vec<f64>> {
        let inverse = self.inverse.as_ref()?;
        self.free.iter().map(|&i| inverse.between(parameter, i)).collect()
    }

    /// An interval from the scatter of the records, if that is more than their noise.
    fn widened(&self, parameter: usize, (half, _): (f64, f64)) -> Option<(f64, f64)> {
        let between = self.between(parameter)?;
        let none = vec![0.0; self.free.len() * self.free.len()];
        let noise = self.of_noise(self.inverse.as_ref()?, &none);
        let prior = self.inverse.as_ref()?.sandwich(&self.prior()).standard_error(parameter)?;
        let scatter = between.standard_error;
        if scatter <= noise.standard_error(parameter)? {
            return None;
        }
        let wide = (student_95(between.degrees_of_freedom) * scatter)
            .hypot(student_95(f64::INFINITY) * prior);
        (wide > half).then(|| (wide, degrees_of(wide / scatter.hypot(prior))))
    }

    /// Scatter of the records in a free parameter.
    pub(crate) fn between(&self, parameter: usize) -> Option<BetweenRecords> {
        self.between[self.free.binary_search(&parameter).ok()?]
    }

    fn scatter(&self, parameter: usize) -> Option<BetweenRecords> {
        let inverse = self.inverse.as_ref().filter(|_| self.task.runs.len() > 2)?;
        let gradient = self.unit(parameter);
        let weights = self.weights(parameter)?;
        let mut records = vec![Told::default(); self.task.runs.len()];
        for column in &self.columns {
            let told = &mut records[column.block.run];
            told.variance += column.middle.variance(inverse, &gradient).0;
            for row in column.block.range.clone() {
                let slopes = self.free.iter().map(|&i| self.derivatives(i)[row]);
                let weight: f64 = slopes.zip(&weights).map(|(slope, weight)| slope * weight).sum();
                told.pull += weight * self.at_end.residuals[row];
                told.share += weight * self.derivatives(parameter)[row];
            }
        }
        for shared in &self.shared {
            records[shared.run].variance += shared.variance(&weights).0.max(0.0);
        }
        BetweenRecords::of(&records)
    }

    /// A covariance whose standard errors include the scatter of the records; correlations stay.
    fn with_records(&self, found: Covariance) -> Covariance {
        let n = found.parameters.len();
        let mut between = found.clone();
        let prior = self.inverse.as_ref().map(|inverse| inverse.sandwich(&self.prior()));
        for k in 0..n {
            let error = self.between[k].map_or(0.0, |between| between.standard_error);
            let known = prior.as_ref().map_or(0.0, |prior| prior.values[k * n + k]);
            between.values[k * n + k] = error * error + known;
        }
        found.at_least(&between)
    }

    /// Unit vector of a parameter.
    fn unit(&self, parameter: usize) -> Vec<f64> {
        let count = self.at_end.jacobian.len() / self.at_end.residuals.len();
        (0..count).map(|i| f64::from(u8::from(i == parameter))).collect()
    }

    /// The rise of the sum of squares at the end of an interval of this half width: that over the
    /// error that independent residuals of unit variance would leave, squared.
    pub(crate) fn rise(&self, parameter: usize, half: f64) -> Option<f64> {
        Some((half / self.inverse.as_ref()?.standard_error(parameter)?).powi(2))
    }

    fn sigma(&self, column: &ColumnNoise<'_>) -> Option<f64> {
        self.task.runs[column.block.run].columns[column.block.column].sigma
    }

    /// `J^T Omega J` of records and priors.
    fn middle(&self) -> Vec<f64> {
        self.prior().iter().zip(self.noise()).map(|(prior, noise)| prior + noise).collect()
    }

    fn noise(&self) -> Vec<f64> {
        let mut noise = vec![0.0; self.free.len() * self.free.len()];
        for column in &self.columns {
            noise.iter_mut().zip(&column.middle.values).for_each(|(sum, part)| *sum += part);
        }
        noise
    }

    /// Priors count as they are given.
    fn prior(&self) -> Vec<f64> {
        let n = self.free.len();
        let prior = |i: usize| &self.derivatives(self.free[i])[self.data..];
        (0..n * n).map(|at| dot(prior(at / n), prior(at % n))).collect()
    }
}
