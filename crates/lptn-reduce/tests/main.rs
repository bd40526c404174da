//! The tests of `lptn-reduce` in one program: each file is a module, and the rest is shared.

#![allow(
    unreachable_pub,
    dead_code,
    clippy::unwrap_used,
    reason = "modules of tests, and tables that some of them share; a test fails by panicking"
)]

mod accuracy;
mod closed_forms;
mod common;
mod every_load;
mod grid;
mod kept;
mod near;
#[path = "../../lptn-assembly/tests/common/networks.rs"]
mod networks;
mod one_exponential;
mod one_node;
mod ports;
mod refusals;
mod streams;
