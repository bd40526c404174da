//! The tests of `lptn-study` in one program: each file is a module, and the rest is shared.

#![allow(
    unreachable_pub,
    dead_code,
    clippy::unwrap_used,
    reason = "modules of tests, and tables that some of them share; a test fails by panicking"
)]

mod common;
mod gradient;
mod gradient_events;
mod gradient_values;
mod rank;
mod size;
mod size_choices;
mod size_moments;
mod size_several;
mod uncertainty_joint;
mod uncertainty_linear;
mod uncertainty_sobol;
