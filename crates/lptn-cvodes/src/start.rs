//! What an integration needs before its first step: checked arguments, the data of the callbacks,
//! and the setting of Newton's method.

use crate::callback::{Counts, Shared};
use lptn_integrate::{FactorError, IntegrateError, OdeSystem, Options, kernels, linear};

/// Stopping test of Newton's method for a constant Jacobian: CVODES' own. With factors that match
/// gamma the first iteration is exact whatever the test, so the books close to rounding, and a
/// sharper test only buys iterations that change nothing.
const NEWTON_LINEAR: f64 = 1e-1;

/// The same for a Jacobian that depends on the state. Measured by `benches/grid.rs` (60 by 60 cells
/// with radiation, tolerance 1e-5; books relative to the heat turned over):
///
/// | coefficient | steps | factorisations | solves | s | books |
/// |---|---|---|---|---|---|
/// | 1e-1 | 2312 | 198 | 3104 | 0.82 | 1.8e-10 |
/// | 1e-2 | 1736 | 126 | 2667 | 0.68 | 4.5e-11 |
/// | 1e-3 | 1700 | 124 | 3144 | 0.68 | 5.5e-12 |
/// | 1e-4 | 1753 | 161 | 4399 | 0.88 | 9.9e-13 |
/// | 1e-6 | 3415 | 2961 | 14180 | 6.56 | 1.6e-12 |
///
/// CVODES' 1e-1 is worst in everything but the books: what Newton leaves over passes for local
/// error and costs steps. Below 1e-4 convergence failures begin. 1e-3 costs up to a quarter more
/// than 1e-2 on other networks.
const NEWTON_NONLINEAR: f64 = 1e-2;

/// The coefficient asked for, or the one that suits the system.
pub(crate) fn newton_coefficient(system: &impl OdeSystem, options: &Options) -> f64 {
    let default = if system.jacobian_is_constant() { NEWTON_LINEAR } else { NEWTON_NONLINEAR };
    options.newton_coefficient.unwrap_or(default)
}

/// The data of the callbacks, with the pattern analysed.
pub(crate) fn shared<S: OdeSystem>(
    system: S,
    t0: f64,
    options: &Options,
) -> Result<Shared<S>, IntegrateError> {
    let factors = linear::for_steps(system.pattern(), system.symmetric(), options.linear_solver);
    let factors = factors.map_err(|cause| match cause {
        FactorError::OutOfMemory => IntegrateError::OutOfMemory { function: "linear solver" },
        cause => IntegrateError::Linear { time: t0, cause },
    })?;
    let slots = system.pattern().len();
    let (jacobian, matrix) = (vec![0.0; slots], vec![0.0; slots]);
    let rows = system.pattern().size();
    let work = vec![0.0; if rows > system.size() { rows } else { 0 }];
    let blocks = system.sensitivity_count() * system.size();
    let (counts, root_count) = (Counts::default(), system.root_count());
    Ok(Shared {
        system,
        origin: t0,
        jacobian,
        jacobian_is_current: false,
        matrix,
        slopes: Vec::new(),
        work,
        sensitivities: vec![0.0; blocks],
        sensitivity_flows: vec![0.0; blocks],
        factors,
        root_count,
        absolute: options.tolerance / 3.0,
        counts,
        time: t0,
        failure: None,
        overcome: None,
    })
}

pub(crate) fn check_options(t0: f64, options: &Options) -> Result<(), IntegrateError> {
    if !t0.is_finite() {
        return Err(IntegrateError::InvalidOption { option: "t0", value: t0 });
    }
    let positive = [
        ("tolerance", Some(options.tolerance)),
        ("initial_step", options.initial_step),
        ("max_step_size", options.max_step_size),
        ("newton_coefficient", options.newton_coefficient),
    ];
    let usable = |value: f64| value > 0.0 && value.is_finite();
    match positive
        .into_iter()
        .find_map(|(option, value)| Some((option, value.filter(|&v| !usable(v))?)))
    {
        Some((option, value)) => Err(IntegrateError::InvalidOption { option, value }),
        None => Ok(()),
    }
}

/// One positive scale per parameter, or none at all.
pub(crate) fn check_scales(
    system: &impl OdeSystem,
    options: &Options,
) -> Result<(), IntegrateError> {
    let scales = &options.sensitivity_scales;
    if !scales.is_empty() {
        expect_length("sensitivity_scales", system.sensitivity_count(), scales.len())?;
    }
    match scales.iter().find(|&&scale| !(scale > 0.0 && scale.is_finite())) {
        Some(&value) => Err(IntegrateError::InvalidOption { option: "sensitivity_scales", value }),
        None => Ok(()),
    }
}

pub(crate) fn check_system(system: &impl OdeSystem, y0: &[f64]) -> Result<(), IntegrateError> {
    if system.size() == 0 {
        return Err(IntegrateError::InvalidOption { option: "size", value: 0.0 });
    }
    expect_length("y0", system.size(), y0.len())?;
    let rows = system.pattern().size();
    if rows < system.size() {
        expect_length("pattern", system.size(), rows)?;
    }
    expect_length("mass", rows, system.mass().len())?;
    if let Some(slope) = system.slope() {
        expect_length("slope", rows, slope.len())?;
    }
    check_state(y0)?;
    check_mass(system.mass(), system.size())
}

/// Positive for the `size` states, 0 for the algebraic rows behind them.
fn check_mass(mass: &[f64], size: usize) -> Result<(), IntegrateError> {
    let (states, algebraic) = mass.split_at(size);
    if let Some(index) = states.iter().position(|&mass| !(mass > 0.0 && mass.is_finite())) {
        return Err(IntegrateError::InvalidMass { index, value: mass[index] });
    }
    match algebraic.iter().position(|&mass| mass.abs() > 0.0 || mass.is_nan()) {
        Some(index) => {
            Err(IntegrateError::AlgebraicMass { row: size + index, value: algebraic[index] })
        }
        None => Ok(()),
    }
}

pub(crate) fn check_state(y: &[f64]) -> Result<(), IntegrateError> {
    kernels::first_not_finite(y)
        .map_or(Ok(()), |index| Err(IntegrateError::InvalidState { index, value: y[index] }))
}

pub(crate) fn expect_length(
    what: &'static str,
    expected: usize,
    found: usize,
) -> Result<(), IntegrateError> {
    if expected == found {
        Ok(())
    } else {
        Err(IntegrateError::WrongLength { what, expected, found })
    }
}
