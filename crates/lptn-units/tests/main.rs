//! The tests of `lptn-units` in one program: each file is a module, and the rest is shared.

#![allow(
    unreachable_pub,
    dead_code,
    clippy::unwrap_used,
    reason = "modules of tests, and tables that some of them share; a test fails by panicking"
)]

mod common;
mod derivatives;
mod distributions;
mod enclosures;
mod engineers;
mod expressions;
mod families;
mod helps;
mod inference;
mod lanes;
mod oracle;
mod programs;
mod property;
mod spoken;
mod strings;
mod table_calls;
mod table_errors;
mod tables;
#[path = "common/tables.rs"]
mod tables_helper;
mod trends;
#[path = "common/wrong.rs"]
mod wrong;
