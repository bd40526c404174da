//! The tests of `lptn-graph` in one program: each file is a module, and the rest is shared.

#![allow(
    unreachable_pub,
    dead_code,
    clippy::unwrap_used,
    reason = "modules of tests, and tables that some of them share; a test fails by panicking"
)]

mod common;
mod exchange;
mod pictures;
mod quality;
mod sankey;
