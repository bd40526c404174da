//! Data of the callbacks and settings of Newton's method, made before the first step.

use crate::callback::{Counts, Shared};
use lptn_integrate::{FactorError, IntegrateError, OdeSystem, Options, linear};

/// Stopping test of Newton's method for a constant Jacobian: CVODES' own. With factors that match
/// gamma the first iteration is exact whatever the test, so the energy balance closes to
/// rounding. A sharper test only adds iterations that change nothing.
const NEWTON_LINEAR: f64 = 1e-1;

/// The same for a Jacobian that depends on the state. Measured by `benches/grid.rs` (60 by 60 cells
/// with radiation, tolerance 1e-5; energy balance relative to the total heat exchanged):
///
/// | coefficient | steps | factorisations | solves | s | balance |
/// |---|---|---|---|---|---|
/// | 1e-1 | 2312 | 198 | 3104 | 0.82 | 1.8e-10 |
/// | 1e-2 | 1736 | 126 | 2667 | 0.68 | 4.5e-11 |
/// | 1e-3 | 1700 | 124 | 3144 | 0.68 | 5.5e-12 |
/// | 1e-4 | 1753 | 161 | 4399 | 0.88 | 9.9e-13 |
/// | 1e-6 | 3415 | 2961 | 14180 | 6.56 | 1.6e-12 |
///
/// CVODES' 1e-1 is slower than 1e-2 and less exact: the residual of Newton's method counts as local
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
