//! Stiff systems, what integrates them, and the linear algebra that both need.
//!
//! A system `M y' = f(t, y)` with a diagonal, positive `M` is described by the trait [`OdeSystem`];
//! an [`Integrator`] owns the system, steps it from one discontinuity to the next, keeps its books
//! ([`OdeSystem::quadrature`]) and carries the derivatives of the state by parameters along with it
//! ([`OdeSystem::sensitivity_flow`]). `lptn-cvodes` is one, and nothing here knows of it. Algebraic
//! unknowns are the system's to solve; the Newton matrix holds them beside the states, see
//! [`OdeSystem`]. The crate knows nothing of what the numbers mean: "units of y" below is whatever
//! unit the system uses.
//!
//! Errors are local: the tolerance is one absolute number and the error norm is the weighted
//! *maximum* over the components, so adding a million idle components changes neither the steps nor
//! the error of the others.
//!
//! faer is called in this crate only. It is generic, so every crate that calls one of its
//! factorisations compiles it again.

mod calls;
pub mod checks;
mod clock;
pub mod dense;
mod diagonal;
mod error;
mod integrator;
pub mod kernels;
pub mod lanczos;
pub mod linear;
mod one_step;
mod options;
mod pattern;
mod statistics;
mod system;
pub mod vectors;

pub use diagonal::Esdirk;
pub use error::{Callback, FactorError, IntegrateError};
pub use integrator::{Integrator, Step};
pub use linear::{LinearSolver, LinearSolverKind};
pub use one_step::OneStep;
pub use options::{Allowance, Options};
pub use pattern::Pattern;
pub use statistics::Statistics;
pub use system::{OdeSystem, Retry};
