//! The tests of `lptn-analysis` in one program.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking, in its helpers too")]

mod indicators;
mod simulation;
mod slopes;
mod slopes_enthalpy;
