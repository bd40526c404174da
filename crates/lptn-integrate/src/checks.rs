//! Checks of the arguments of every integrator.

use crate::{Allowance, IntegrateError, OdeSystem, Options, kernels};

/// The start time is finite, and the options are in range.
///
/// # Errors
/// [`IntegrateError::InvalidOption`] with the first that is not.
pub fn options(t0: f64, given: &Options) -> Result<(), IntegrateError> {
    if !t0.is_finite() {
        return Err(IntegrateError::InvalidOption { option: "t0", value: t0 });
    }
    let positive = [
        ("tolerance", Some(given.tolerance)),
        ("initial_step", given.initial_step),
        ("max_step_size", given.max_step_size),
        ("newton_coefficient", given.newton_coefficient),
    ];
    let usable = |value: f64| value > 0.0 && value.is_finite();
    let Allowance { share, amount } = given.integrals;
    if !(share >= 0.0 && share.is_finite() && amount >= 0.0 && share + amount > 0.0) {
        return Err(IntegrateError::InvalidOption {
            option: "integrals",
            value: amount.min(share),
        });
    }
    match positive
        .into_iter()
        .find_map(|(option, value)| Some((option, value.filter(|&v| !usable(v))?)))
    {
        Some((option, value)) => Err(IntegrateError::InvalidOption { option, value }),
        None => Ok(()),
    }
}

/// One positive scale per parameter, or none at all.
///
/// # Errors
/// A wrong length, [`IntegrateError::InvalidOption`].
pub fn scales(system: &impl OdeSystem, given: &Options) -> Result<(), IntegrateError> {
    let scales = &given.sensitivity_scales;
    if !scales.is_empty() {
        expect_length("sensitivity_scales", system.sensitivity_count(), scales.len())?;
    }
    match scales.iter().find(|&&scale| !(scale > 0.0 && scale.is_finite())) {
        Some(&value) => Err(IntegrateError::InvalidOption { option: "sensitivity_scales", value }),
        None => Ok(()),
    }
}

/// The lengths of a system and its start state agree, and its masses can be used.
///
/// # Errors
/// A wrong length, [`IntegrateError::InvalidState`], [`IntegrateError::InvalidMass`],
/// [`IntegrateError::AlgebraicMass`].
pub fn system(system: &impl OdeSystem, y0: &[f64]) -> Result<(), IntegrateError> {
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
    state(y0)?;
    masses(system.mass(), system.size())
}

/// Positive for the `size` states, 0 for the algebraic rows after them.
fn masses(mass: &[f64], size: usize) -> Result<(), IntegrateError> {
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

/// All values are finite.
///
/// # Errors
/// [`IntegrateError::InvalidState`] with the first that is not.
pub fn state(y: &[f64]) -> Result<(), IntegrateError> {
    kernels::first_not_finite(y)
        .map_or(Ok(()), |index| Err(IntegrateError::InvalidState { index, value: y[index] }))
}

/// Two lengths agree.
///
/// # Errors
/// [`IntegrateError::WrongLength`].
pub fn expect_length(
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
