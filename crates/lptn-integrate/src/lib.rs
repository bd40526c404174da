//! CVODES with own vectors and with faer as its linear solver, behind a safe interface.
//!
//! A system `M y' = f(t, y)` with a diagonal, positive `M` is described by the trait [`OdeSystem`]; an [`Integrator`]
//! owns the system, steps it from one discontinuity to the next, keeps its books ([`OdeSystem::quadrature`]) and carries
//! the derivatives of the state by parameters along with it ([`OdeSystem::sensitivity_flow`]).
//! Algebraic unknowns are the system's to solve; the Newton matrix holds them beside the states, see [`OdeSystem`].
//! The crate knows nothing of what the numbers mean: "units of y" below is whatever unit the system uses.
//!
//! Errors are local: the tolerance is one absolute number and the error norm is the weighted *maximum* over the
//! components, so adding a million idle components changes neither the steps nor the error of the others. CVODE's own
//! norm is a mean and does change them.
//!
//! # Why this crate may use `unsafe`
//!
//! It is the only one of the workspace that calls C. The argument that it is sound has five parts:
//!
//! 1. *Lifetimes.* Every object made by SUNDIALS belongs to exactly one Rust value with a `Drop`; [`Integrator`]
//!    declares its fields in the order in which SUNDIALS must free them, the context last. Raw handles never leave
//!    the crate.
//! 2. *Aliasing.* What the callbacks need lives in one heap allocation that is reached only through the raw pointer
//!    made when it was allocated. While a C function runs that may call back, no Rust reference into it exists:
//!    `&mut Integrator` guarantees that nobody else looks, and the callback makes the only reference, for its own
//!    duration.
//! 3. *Vectors.* The contents of a vector are a Rust allocation of known length. Where SUNDIALS hands over one vector
//!    twice (in-place operations), the operation is dispatched to an in-place kernel before any reference is made, so
//!    a mutable slice never overlaps another slice. The kernels are safe Rust.
//! 4. *Unwinding.* Every callback into user code is wrapped in `catch_unwind`; a panic becomes an error after the C
//!    frames have returned.
//! 5. *Threads.* Each integrator has its own SUNDIALS context and holds raw pointers, so it is neither `Send` nor
//!    `Sync`; nothing is shared between two of them.
#![allow(unsafe_code)]

mod callback;
mod context;
mod error;
mod integrator;
mod kernels;
pub mod linear;
mod linear_solver;
mod memory;
mod options;
mod pattern;
mod shared;
mod start;
mod statistics;
mod symmetry;
mod system;
mod vector;
mod vectors;
mod version;

pub use error::{Callback, FactorError, IntegrateError};
pub use integrator::{Integrator, Step};
pub use linear::{LinearSolver, LinearSolverKind};
pub use options::Options;
pub use pattern::Pattern;
pub use statistics::Statistics;
pub use system::{OdeSystem, Retry};
pub use version::{Linkage, Linked, linked};
