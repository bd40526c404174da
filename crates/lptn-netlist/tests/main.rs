//! The tests of `lptn-netlist` in one program: each file is a module, and the rest is shared.

#![allow(
    unreachable_pub,
    dead_code,
    clippy::unwrap_used,
    reason = "modules of tests, and tables that some of them share; a test fails by panicking"
)]

mod bad;
#[path = "support/cpu.rs"]
mod cpu;
mod csv_form;
mod elements;
mod expand;
mod films;
mod fit;
#[path = "support/fixes.rs"]
mod fixes;
mod good;
mod import;
mod include;
mod index;
mod library;
mod limits;
mod materials;
mod posterior;
mod properties;
mod property;
mod replaced_starts;
mod schema;
#[path = "support/schema_check.rs"]
mod schema_check;
mod set;
mod support;
mod template;
mod winding;
