//! The integrator of runs: CVODES, unless the crate is built without the feature `cvodes`.

use lptn_integrate::{Integrator, Options};

use crate::error::TransientError;
use crate::heat::Heat;

/// What steps a run.
pub(crate) type Stepper<'a> = Box<dyn Integrator<Heat<'a>> + 'a>;

/// Takes the system at a time in s in a state, one value per component.
#[cfg(feature = "cvodes")]
pub(crate) fn stepper<'a>(
    heat: Heat<'a>,
    (start, state): (f64, &[f64]),
    options: &Options,
) -> Result<Stepper<'a>, TransientError> {
    let integrator = lptn_cvodes::Cvodes::new(heat, start, state, options);
    Ok(Box::new(integrator.map_err(TransientError::Integrator)?))
}

/// There is none.
#[cfg(not(feature = "cvodes"))]
pub(crate) fn stepper<'a>(
    _: Heat<'a>,
    _: (f64, &[f64]),
    _: &Options,
) -> Result<Stepper<'a>, TransientError> {
    Err(TransientError::Settings(crate::settings_error::SettingsError::NoIntegrator))
}
