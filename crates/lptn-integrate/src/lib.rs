//! Stiff systems, their integrators, and the linear algebra that both need.
//!
//! A system `M y' = f(t, y)` with a diagonal, positive `M` is described by the trait [`OdeSystem`];
//! an [`Integrator`] owns the system, steps it from one discontinuity to the next, keeps running
//! integrals ([`OdeSystem::quadrature`]) and carries the derivatives of the state by parameters
//! along with it ([`OdeSystem::sensitivity_flow`]). `lptn-cvodes` has one, on which nothing here
//! depends. The system solves its algebraic unknowns; the Newton matrix contains them after the
//! states, see [`OdeSystem`]. The crate does not know the meaning of the numbers: "units of y"
//! below is the unit that the system uses.
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
pub use one_step::{OneStep, SeriesStep};
pub use options::{Allowance, Options};
pub use pattern::Pattern;
pub use statistics::Statistics;
pub use system::{OdeSystem, Retry};
