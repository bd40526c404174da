//! The tests of `lptn-laws` in one program: each file is a module, and the rest is shared.

#![allow(
    unreachable_pub,
    dead_code,
    clippy::unwrap_used,
    reason = "modules of tests, and tables that some of them share; a test fails by panicking"
)]

mod bodies;
mod correlations;
mod derivatives;
mod exchangers;
mod limits;
mod losses;
mod published;
mod scuffing;
mod shifted;
mod table;
