//! The tests of `lptn-network` in one program: each file is a module, and the rest is shared.

#![allow(
    unreachable_pub,
    dead_code,
    clippy::unwrap_used,
    reason = "modules of tests, and tables that some of them share; a test fails by panicking"
)]

mod alike;
mod build_errors;
mod build_parts;
mod capacities;
mod common;
mod controls;
mod expressions;
mod grids;
mod joints;
mod ladder;
mod laws;
mod limits;
mod names;
mod periods;
mod round;
mod signals;
mod streams;
mod tangents;
