//! A run together with how its temperatures change with parameters.

use lptn_assembly::{ChangeError, ThermalSystem};
use lptn_network::{LimitId, Network, NoTangents, NodeId, ParameterId, Value};

use crate::error::TransientError;
use crate::settings::{Proceed, Progress, Transient};
use crate::settings_error::SettingsError;
use crate::solution::{RunStatus, Solution};

/// By which part of itself a parameter is changed for a difference of runs. With the tolerances of
/// fits (1e-7 K) the difference of two runs and the curvature between them leave about four digits.
const CHANGE: f64 = 1e-3;

/// The change in K of a parameter that is an absolute temperature.
const CHANGE_IN_KELVIN: f64 = 0.1;

/// How sensitivities were had.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Gradient {
    /// With the run, from the derivatives of every law: exact to its tolerance.
    Exact,
    /// As central differences of whole runs, because there is no exact one.
    Differences(NoTangents),
}

/// By which part of that a parameter is changed to see what a result makes of it beside what the
/// temperatures do: nothing is integrated there, so rounding is all that is in the way.
const FINER: f64 = 1e-2;

/// A run and its sensitivities.
#[derive(Clone, Debug)]
pub struct SensitiveRun {
    /// The run.
    pub solution: Solution,
    /// How the sensitivities were had.
    pub gradient: Gradient,
    /// For each parameter the solutions below and above with the distance of the two, where they
    /// are differences.
    differences: Vec<(ParameterId, [Solution; 2], f64)>,
}

lptn_units::errors! {
/// Why a run or one beside it failed.
#[derive(Debug)]
pub enum SensitiveError {
    /// The run.
    Run => TransientError;
    /// The network, or what it is with a parameter changed.
    Change => ChangeError;
    /// It was interrupted.
    Interrupted = "run::interrupted", "the run was interrupted";
}
}

/// Runs a network and follows its sensitivities by `parameters`: exactly, or by differences where a
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
            let one = |&id: &ParameterId| {
                let (value, step) = (network.parameter_value(id), step(network, id));
                let at = |value: f64| {
                    let mut changed = network.given();
                    changed.set(id, value);
                    run(&system.with(&changed)?, settings)
                };
                Ok((id, [at(value - step)?, at(value + step)?], 2.0 * step))
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

fn step(network: &Network, id: ParameterId) -> f64 {
    let parameter = &network.parameters()[id.index()];
    if parameter.ty.absolute {
        return CHANGE_IN_KELVIN;
    }
    let size = network.parameter_value(id).abs();
    let size =
        if size > 0.0 { size } else { parameter.deviation.map_or(1.0, |spread| spread.sigma) };
    CHANGE * size
}

impl SensitiveRun {
    /// How the temperature of a node changes with a parameter over the rows, in K per SI unit of
    /// the parameter; `None` for a node that was not recorded or another parameter.
    pub fn sensitivity(&self, parameter: ParameterId, node: NodeId) -> Option<Vec<f64>> {
        if self.gradient == Gradient::Exact {
            return self.solution.sensitivity(parameter, node);
        }
        let (_, solutions, distance) =
            self.differences.iter().find(|(id, _, _)| *id == parameter)?;
        let [below, above] = solutions.each_ref().map(|solution| solution.temperature(node));
        Some(below?.iter().zip(above?).map(|(below, above)| (above - below) / distance).collect())
    }

    /// How an expression of results, compiled for this network, changes with a parameter over the
    /// rows, in SI units per SI unit of the parameter: by itself, through the temperatures and
    /// through the heat flows. NaN where it has no value, and unless every node was recorded; `None`
    /// for another parameter.
    ///
    /// Where temperatures have exact sensitivities, it is that of the expression along them: a
    /// difference in every row, without a run, good to 1e-8 of itself or so.
    pub fn result_slope(&self, parameter: ParameterId, value: &Value) -> Option<Vec<f64>> {
        let slope = |below: &[f64], above: &[f64], distance: f64| {
            below.iter().zip(above).map(|(below, above)| (above - below) / distance).collect()
        };
        if self.gradient != Gradient::Exact {
            let (_, solutions, distance) =
                self.differences.iter().find(|(id, _, _)| *id == parameter)?;
            let [below, above] = solutions.each_ref().map(|solution| solution.result(value));
            return Some(slope(&below, &above, *distance));
        }
        let network = self.solution.network();
        let own = network.parameter_value(parameter);
        let by = FINER * step(network, parameter);
        // at the end of a parameter's range there is one side only
        let side = |to: f64| {
            let beside = self.solution.result_beside(value, (parameter, to)).ok();
            beside.map_or_else(|| (self.solution.result(value), own), |found| (found, to))
        };
        let ((below, from), (above, to)) = (side(own - by), side(own + by));
        (to > from).then(|| slope(&below, &above, to - from))
    }

    /// How the highest temperature of a watched node changes with a parameter, in K per SI unit of
    /// the parameter, as a difference of runs; `None` where the gradient is exact, or the node was
    /// not watched.
    pub fn peak(&self, parameter: ParameterId, node: NodeId) -> Option<f64> {
        let (_, solutions, distance) =
            self.differences.iter().find(|(id, _, _)| *id == parameter)?;
        let peak = |solution: &Solution| {
            solution.watched().iter().find(|seen| seen.watch.node == node).map(|seen| seen.peak.0)
        };
        let [below, above] = solutions.each_ref().map(peak);
        Some((above? - below?) / distance)
    }

    /// How the least margin of a limit changes with a parameter, in SI units of its quantity per SI
    /// unit of the parameter, as a difference of runs; `None` where the gradient is exact: it is
    /// one of temperatures.
    pub fn margin(&self, parameter: ParameterId, limit: LimitId) -> Option<f64> {
        let (_, solutions, distance) =
            self.differences.iter().find(|(id, _, _)| *id == parameter)?;
        let [below, above] =
            solutions.each_ref().map(|solution| solution.limits()[limit.index()].margin);
        Some((above - below) / distance)
    }
}
