//! The tests of `lptn-cvodes` in one program: each file is a module, and the rest is shared.

#![allow(
    unreachable_pub,
    dead_code,
    clippy::unwrap_used,
    reason = "modules of tests, and tables that some of them share; a test fails by panicking"
)]

mod algebraic;
#[path = "common/algebraic.rs"]
mod algebraic_helper;
mod analytic;
mod books;
mod common;
mod errors;
#[path = "common/matrix.rs"]
mod matrix;
#[path = "common/radiation.rs"]
mod radiation;
#[path = "common/rooted.rs"]
mod rooted;
mod roots;
#[path = "common/sensitive.rs"]
mod sensitive;
mod sensitivity;
mod sensitivity_errors;
mod steps;
