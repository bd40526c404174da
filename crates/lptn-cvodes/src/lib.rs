//! CVODES with its own vectors and faer as linear solver, for `lptn-integrate`.
//!
//! [`Cvodes`] is an [`Integrator`](lptn_integrate::Integrator). Its error norm is a maximum where
//! CVODE's own is a mean, which idle components would dilute.
//!
//! CVODES is used, not CVODE, because its quadratures are the running integrals of the energy
//! balance. They obey the same formula as the state, so the balance of a linear network closes to
//! rounding: 1e-15 of the exchanged heat, where 1e-8 is required. A closed balance means that
//! integrals and states agree, not that the integrals are right.
//!
//! # Why this crate may use `unsafe`
//!
//! It is the only crate of the workspace that calls C or replaces functions of the C library
//! (`elementary`). The argument that it is sound has five parts:
//!
//! 1. *Lifetimes.* Every object made by SUNDIALS belongs to exactly one Rust value with a `Drop`;
//!    [`Cvodes`] declares its fields in the order in which SUNDIALS must free them, the context
//!    last. Raw handles never leave the crate.
//! 2. *Aliasing.* The data of the callbacks is one heap allocation, reached only through the raw
//!    pointer made when it was allocated. While a C function runs that may call back, no Rust
//!    reference into it exists: `&mut Cvodes` guarantees that no one else reads it, and the
//!    callback makes the only reference, for its own duration.
//! 3. *Vectors.* The contents of a vector are a Rust allocation of known length. If SUNDIALS
//!    passes one vector twice (in-place operations), the operation is dispatched to an in-place
//!    kernel before any reference is made, so a mutable slice never overlaps another slice. The
//!    kernels are safe Rust.
//! 4. *Unwinding.* Every callback into user code is wrapped in `catch_unwind`; a panic becomes an
//!    error after the C frames have returned.
//! 5. *Threads.* Each integrator has its own SUNDIALS context and raw pointers, so it is
//!    neither `Send` nor `Sync`; nothing is shared between two of them.
#![allow(unsafe_code)]

mod callback;
mod context;
#[cfg(feature = "portable")]
mod elementary;
mod integrator;
mod linear_solver;
mod memory;
mod shared;
mod start;
mod symmetry;
mod vector;
mod vectors;
mod version;

pub use integrator::Cvodes;
pub use version::{Linkage, Linked, linked};
