//! A run with the sensitivities of its temperatures to parameters.

use lptn_assembly::{ChangeError, ThermalSystem};
use lptn_network::{InputError, LimitId, Network, NoTangents, NodeId, ParameterId, Value};

use crate::error::TransientError;
use crate::settings::{Proceed, Progress, Transient};
use crate::settings_error::SettingsError;
use crate::solution::{RunStatus, Solution};

/// Relative change of a parameter for a difference of runs. With the tolerances of fits (1e-7 K)
/// the difference of two runs and the curvature between them leave about four digits.
const CHANGE: f64 = 1e-3;

/// The change in K of a parameter that is an absolute temperature.
const CHANGE_IN_KELVIN: f64 = 0.1;

/// Method of the sensitivities.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Gradient {
    /// With the run, from the derivatives of every law: exact to its tolerance.
    Exact,
    /// From central differences of whole runs, because there is no exact method.
    Differences(NoTangents),
}

/// Part of that change for the direct effect of a parameter on a result, in addition to that of the
/// temperatures. Nothing is integrated there, so only rounding limits it.
const FINER: f64 = 1e-2;

/// A run and its sensitivities.
#[derive(Clone, Debug)]
pub struct SensitiveRun {
    /// The run.
    pub solution: Solution,
    /// The method of the sensitivities.
    pub gradient: Gradient,
    /// The runs next to it, if sensitivities are differences.
    differences: Vec<Difference>,
}

/// Runs with other values of one parameter: the sum of their results, each times its weight in 1
/// over the parameter's SI unit, is a derivative.
#[derive(Clone, Debug)]
struct Difference {
    parameter: ParameterId,
    runs: Vec<(f64, Solution)>,
}

impl Difference {
    fn slope(&self, of: impl Fn(&Solution) -> Option<f64>) -> Option<f64> {
        self.runs.iter().map(|(weight, run)| Some(weight * of(run)?)).sum()
    }

    /// The slopes row by row.
    fn slopes(&self, of: impl Fn(&Solution) -> Option<Vec<f64>>) -> Option<Vec<f64>> {
        let mut sum = Vec::new();
        for (weight, run) in &self.runs {
            let values = of(run)?;
            sum.resize(values.len(), 0.0);
            sum.iter_mut().zip(values).for_each(|(sum, value)| *sum += weight * value);
        }
        Some(sum)
    }
}

lptn_units::errors! {
/// Reason why a run or one next to it failed.
#[derive(Debug)]
pub enum SensitiveError {
    /// The run.
    Run => TransientError;
    /// The network, or that with a parameter changed.
    Change => ChangeError;
    /// It was interrupted.
    Interrupted = "run::interrupted", "the run was interrupted";
}
}

lptn_units::errors! {
/// Reason why a margin has no slope.
#[derive(Debug)]
pub enum MarginError {
    /// The network with the parameter changed.
    Change => ChangeError;
    /// The limit has no value.
    Input => InputError;
}
}

/// Runs a network and follows its sensitivities by `parameters`: exactly, or by differences if a
/// network has no exact ones.
///
/// # Errors
/// [`SensitiveError`] if one of the runs fails.
pub fn sensitive_run(
    network: &Network,
    settings: &Transient,
    parameters: &[ParameterId],
) -> Result<SensitiveRun, SensitiveError> {
    sensitive_run_observed(network, (settings, parameters), &|_| Proceed::Continue)
}

/// The same; `observer` is called after every step of every run and may interrupt them.
///
/// # Errors
/// [`SensitiveError`] if one of the runs fails or is interrupted.
pub fn sensitive_run_observed(
    network: &Network,
    (settings, parameters): (&Transient, &[ParameterId]),
    observer: &dyn Fn(Progress) -> Proceed,
) -> Result<SensitiveRun, SensitiveError> {
    let run = |system: &ThermalSystem, settings: &Transient| {
        let solution = settings.solve_observed(system, &mut |step| observer(step))?;
        match solution.end() {
            RunStatus::Interrupted(_) => Err(SensitiveError::Interrupted),
            _ => Ok(solution),
        }
    };
    let system = ThermalSystem::assemble(network).map_err(ChangeError::from)?;
    match run(&system, &settings.clone().sensitivities(parameters)) {
        Err(SensitiveError::Run(TransientError::Settings(SettingsError::Sensitivity(why)))) => {
            let solution = run(&system, &settings.clone().sensitivities(&[]))?;
            let one = |&parameter: &ParameterId| {
                let (own, step) = (network.parameter_value(parameter), step(network, parameter));
                let at = |steps: f64| {
                    let mut changed = network.given();
                    changed.set(parameter, own + steps * step);
                    run(&system.with(&changed)?, settings)
                };
                let runs = difference(at, (&solution, step))?;
                Ok(Difference { parameter, runs })
            };
            let differences = parameters.iter().map(one).collect::<Result<_, SensitiveError>>()?;
            Ok(SensitiveRun { solution, gradient: Gradient::Differences(why), differences })
        }
        outcome => Ok(SensitiveRun {
            solution: outcome?,
            gradient: Gradient::Exact,
            differences: Vec::new(),
        }),
    }
}

/// The runs of a central difference, `at` this number of steps from the own value. If one side has
/// no run, because the value is at the end of its range, those of a difference to the other side,
/// which is of the second order too.
fn difference(
    at: impl Fn(f64) -> Result<Solution, SensitiveError>,
    (own, step): (&Solution, f64),
) -> Result<Vec<(f64, Solution)>, SensitiveError> {
    let one_sided = |side: f64, near: Solution| {
        let unit = side / step;
        match at(2.0 * side) {
            Ok(far) => Ok(vec![(-1.5 * unit, own.clone()), (2.0 * unit, near), (-0.5 * unit, far)]),
            Err(SensitiveError::Interrupted) => Err(SensitiveError::Interrupted),
            Err(_) => Ok(vec![(-unit, own.clone()), (unit, near)]),
        }
    };
    match (at(-1.0), at(1.0)) {
        (Err(SensitiveError::Interrupted), _) | (_, Err(SensitiveError::Interrupted)) => {
            Err(SensitiveError::Interrupted)
        }
        (Ok(below), Ok(above)) => Ok(vec![(-0.5 / step, below), (0.5 / step, above)]),
        (Ok(below), Err(_)) => one_sided(-1.0, below),
        (Err(_), Ok(above)) => one_sided(1.0, above),
        (Err(refused), Err(_)) => Err(refused),
    }
}

/// Checks that a parameter may be a little larger or smaller than it is: a count may not.
///
/// # Errors
/// [`ChangeError`] of the larger value if the network takes neither.
pub fn can_move(network: &Network, parameter: ParameterId) -> Result<(), ChangeError> {
    let (own, step) = (network.parameter_value(parameter), step(network, parameter));
    let at = |value: f64| {
        let mut changed = network.given();
        changed.set(parameter, value);
        network.with(&changed).map(drop).map_err(ChangeError::from)
    };
    at(own + step).or_else(|refused| at(own - step).map_err(|_| refused))
}

/// The change of a parameter for a difference.
pub(crate) fn step(network: &Network, id: ParameterId) -> f64 {
    let parameter = &network.parameters()[id.index()];
    if parameter.ty.absolute {
        return CHANGE_IN_KELVIN;
    }
    let size = network.parameter_value(id).abs();
    let spread = parameter.deviation.map_or(0.0, |spread| spread.sigma(0.0));
    CHANGE * [size, spread].into_iter().find(|size| *size > 0.0).unwrap_or(1.0)
}

/// A margin bends if its slopes to both sides differ by more than this share.
const BENT: f64 = 0.05;

/// Differences of margins below this share of 1 and the margin are rounding.
const ROUNDING: f64 = 1e-10;

impl SensitiveRun {
    fn difference(&self, parameter: ParameterId) -> Option<&Difference> {
        self.differences.iter().find(|difference| difference.parameter == parameter)
    }

    /// Sensitivity of the temperature of a node to a parameter over the rows, in K per SI unit of
    /// the parameter; `None` for a node that was not recorded or another parameter.
    pub fn sensitivity(&self, parameter: ParameterId, node: NodeId) -> Option<Vec<f64>> {
        if self.gradient == Gradient::Exact {
            return self.solution.sensitivity(parameter, node);
        }
        self.difference(parameter)?.slopes(|solution| solution.temperature(node))
    }

    /// Sensitivity of an expression of results, compiled for this network, to a parameter over the
    /// rows, in SI units per SI unit of the parameter: directly, through the temperatures and
    /// through the heat flows. NaN if it has no value, and unless every node was recorded; `None`
    /// for another parameter.
    ///
    /// If temperatures have exact sensitivities, it is that of the expression along them: a
    /// difference in every row, without a run, good to 1e-8 of itself or so.
    pub fn result_slope(&self, parameter: ParameterId, value: &Value) -> Option<Vec<f64>> {
        if self.gradient != Gradient::Exact {
            return self.difference(parameter)?.slopes(|solution| Some(solution.result(value)));
        }
        let by = FINER * step(self.solution.network(), parameter);
        let beside = |to| self.solution.result_beside(value, (parameter, to));
        let (below, above, distance) =
            self.both_sides((parameter, by), beside, || self.solution.result(value)).ok()?;
        Some(below.iter().zip(above).map(|(below, above)| (above - below) / distance).collect())
    }

    /// The results of `beside` with a parameter lower and higher by `by`, and the distance of the
    /// two: at the end of its range there is one side only, and the `own` value on the other.
    fn both_sides<T>(
        &self,
        (parameter, by): (ParameterId, f64),
        beside: impl Fn(f64) -> Result<T, ChangeError>,
        own: impl Fn() -> T,
    ) -> Result<(T, T, f64), ChangeError> {
        let value = self.solution.network().parameter_value(parameter);
        match (beside(value - by), beside(value + by)) {
            (Ok(below), Ok(above)) => Ok((below, above, 2.0 * by)),
            (Ok(below), Err(_)) => Ok((below, own(), by)),
            (Err(_), Ok(above)) => Ok((own(), above, by)),
            (Err(refused), Err(_)) => Err(refused),
        }
    }

    /// The margin of a limit in a row of the run, in SI units of its quantity; see
    /// [`Network::limit_margin`]. NaN unless every node was recorded.
    ///
    /// # Errors
    /// [`InputError`] if it has no value there.
    pub fn margin_in_row(&self, limit: LimitId, row: usize) -> Result<f64, InputError> {
        self.solution.margin_in_row(limit, row)
    }

    /// Sensitivity of that margin to a parameter along exact sensitivities, in SI units per SI unit
    /// of the parameter: a difference over `by` to both sides, without a run. `None` if the margin
    /// bends, as `min(a.T, b.T)` does when both are equal.
    ///
    /// # Errors
    /// [`MarginError`] if the network takes a value on neither side, or the limit has none there.
    pub fn margin_slope_in_row(
        &self,
        (parameter, by): (ParameterId, f64),
        (limit, row): (LimitId, usize),
    ) -> Result<Option<f64>, MarginError> {
        let beside = |to| self.solution.margin_beside((limit, row), (parameter, to));
        let own = || self.solution.margin_in_row(limit, row);
        let (below, above, distance) = self.both_sides((parameter, by), beside, own)?;
        let (below, here, above) = (below?, own()?, above?);
        let bend = if distance > 1.5 * by { (above + below - 2.0 * here).abs() } else { 0.0 };
        let straight = bend <= BENT * (above - below).abs() + ROUNDING * (1.0 + here.abs());
        Ok(straight.then_some((above - below) / distance))
    }

    /// Sensitivity of the highest temperature of a watched node to a parameter, in K per SI unit of
    /// the parameter, as a difference of runs; `None` if the gradient is exact, or the node was not
    /// watched.
    pub fn peak(&self, parameter: ParameterId, node: NodeId) -> Option<f64> {
        let peak = |solution: &Solution| {
            solution.watched().iter().find(|seen| seen.watch.node == node).map(|seen| seen.peak.0)
        };
        self.difference(parameter)?.slope(peak)
    }

    /// Sensitivity of the least margin of a limit to a parameter, in SI units of its quantity per
    /// SI unit of the parameter, as a difference of runs; `None` if the gradient is exact: it is
    /// one of temperatures.
    pub fn margin(&self, parameter: ParameterId, limit: LimitId) -> Option<f64> {
        self.difference(parameter)?.slope(|solution| Some(solution.limits()[limit.index()].margin))
    }
}
