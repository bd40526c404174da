//! The tests of `lptn-analysis` in one program.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking, in its helpers too")]

mod simulation;
