//! The tests of `lptn-assembly` in one program: each file is a module, and the rest is shared.

#![allow(
    unreachable_pub,
    dead_code,
    clippy::unwrap_used,
    reason = "modules of tests, and tables that some of them share; a test fails by panicking"
)]

mod bodies;
mod elimination;
mod forms;
mod jacobian;
#[path = "common/networks.rs"]
mod networks;
mod part;
#[path = "common/rational.rs"]
mod rational;
mod system;
mod together;
