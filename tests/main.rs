//! The tests of the library in one program: each file is a module, and the rest is shared.

#![allow(
    unreachable_pub,
    dead_code,
    clippy::unwrap_used,
    reason = "modules of tests, and tables that some of them share; a test fails by panicking"
)]

mod analytic;
mod architecture;
mod candidates;
mod circles;
mod comments;
mod conservation;
mod counters;
mod determinism;
mod docs;
mod elements;
mod enclosures;
mod expand;
mod fuzz;
mod gears;
mod grid_faces;
mod grid_joints;
mod grid_patches;
mod grid_streams;
mod grids;
mod import;
#[path = "support/kind_page.rs"]
mod kind_page;
mod kinds;
mod limits;
mod losses;
mod message_words;
mod networks;
mod networks_validation;
#[path = "support/pages.rs"]
mod pages;
mod paper;
mod parameters;
mod parts;
mod regression;
mod round;
mod runaway;
mod sections;
mod sensitivity;
mod sensitivity_closed;
mod shifted_gears;
mod study;
mod support;
mod synthetic_records;
#[path = "../examples/synthetic_records.rs"]
mod synthetic_records_helper;
#[path = "../fuzz/src/targets.rs"]
mod targets;
mod time;
mod tolerance;
mod validation;
#[path = "support/validation/mod.rs"]
mod validation_helper;
mod wording;
mod words;
