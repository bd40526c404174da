//! The tests of `lptn-integrate` in one program: each file is a module, and the rest is shared.

#![allow(
    unreachable_pub,
    dead_code,
    reason = "modules of tests, and tables that some of them share"
)]

mod common;
mod iterative;
mod linear;
mod one_step;
