//! The integrator of runs: the one-step method if it applies, else CVODES, unless the crate is
//! built without the feature `cvodes`.
//!
//! Runs reach the integrator through `Box<dyn Integrator>`, and this file alone names both. A
//! virtual call per step costs nothing. The core builds without C and for WebAssembly, and another
//! integrator needs one function. The feature `cvodes` is on by default. Without it linear networks
//! still run, and others by the Runge-Kutta method; those that it does not suit (pipes, several
//! branches) are refused with `SettingsError::NoIntegrator`.

use lptn_integrate::{Esdirk, Integrator, OdeSystem, OneStep, Options};
use lptn_network::IntegratorChoice;

use crate::error::TransientError;
use crate::heat::Heat;
use crate::method::Method;
use crate::settings_error::SettingsError;

/// The integrator of a run.
pub(crate) type Stepper<'a> = Box<dyn Integrator<Heat<'a>> + 'a>;

/// Number of parts of a run between breakpoints of inputs from which on BDF, which restarts in each
/// of them, takes more steps than a Runge-Kutta method. Without CVODES that method takes all that
/// it suits.
const MANY_PARTS: usize = if cfg!(feature = "cvodes") { 20 } else { 0 };

/// The inputs of a run.
#[derive(Clone, Copy)]
pub(crate) struct Inputs {
    /// They are not straight lines in time between their breakpoints.
    pub(crate) curved: bool,
    /// Parts of the run between breakpoints.
    pub(crate) parts: usize,
}

/// Takes the system at a time in s in a state, one value per component.
pub(crate) fn stepper<'a>(
    mut heat: Heat<'a>,
    (start, state): (f64, &[f64]),
    options: &Options,
    (choice, inputs): (IntegratorChoice, Inputs),
) -> Result<(Stepper<'a>, Method), TransientError> {
    let Inputs { curved, parts } = inputs;
    let serves = matches!(choice, IntegratorChoice::Auto | IntegratorChoice::OneStep)
        && !curved
        && !heat.has_pipes()
        && OneStep::suits(&mut heat, (start, state), options.tolerance);
    match choice {
        IntegratorChoice::Auto | IntegratorChoice::OneStep if serves => {
            let integrator = OneStep::new(heat, start, state, options);
            let integrator = integrator.map_err(TransientError::Integrator)?;
            Ok((Box::new(integrator), Method::OneStep))
        }
        IntegratorChoice::OneStep => {
            Err(TransientError::Settings(SettingsError::OneStep { curved }))
        }
        IntegratorChoice::Auto if parts >= MANY_PARTS && suits_esdirk(&heat) => {
            esdirk(heat, (start, state), options)
        }
        IntegratorChoice::Esdirk if !heat.has_pipes() && Esdirk::suits(&heat) => {
            esdirk(heat, (start, state), options)
        }
        IntegratorChoice::Esdirk => Err(TransientError::Settings(SettingsError::Esdirk)),
        _ => Ok((cvodes(heat, (start, state), options)?, Method::Cvode)),
    }
}

/// Stages go back in time, which may lose the branch of a massless node, and asks a pipe for fluid
/// that has left.
fn suits_esdirk(heat: &Heat<'_>) -> bool {
    !heat.is_guarded() && !heat.has_pipes() && Esdirk::suits(heat)
}

fn esdirk<'a>(
    heat: Heat<'a>,
    (start, state): (f64, &[f64]),
    options: &Options,
) -> Result<(Stepper<'a>, Method), TransientError> {
    let integrator = Esdirk::new(heat, start, state, options);
    Ok((Box::new(integrator.map_err(TransientError::Integrator)?), Method::Esdirk))
}

#[cfg(feature = "cvodes")]
pub(crate) fn cvodes<'a, S: OdeSystem + 'a>(
    system: S,
    (start, state): (f64, &[f64]),
    options: &Options,
) -> Result<Box<dyn Integrator<S> + 'a>, TransientError> {
    let integrator = lptn_cvodes::Cvodes::new(system, start, state, options);
    Ok(Box::new(integrator.map_err(TransientError::Integrator)?))
}

/// There is none.
#[cfg(not(feature = "cvodes"))]
pub(crate) fn cvodes<'a, S: OdeSystem + 'a>(
    _: S,
    _: (f64, &[f64]),
    _: &Options,
) -> Result<Box<dyn Integrator<S> + 'a>, TransientError> {
    Err(TransientError::Settings(SettingsError::NoIntegrator))
}
