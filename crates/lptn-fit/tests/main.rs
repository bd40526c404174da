//! The tests of `lptn-fit` in one program: each file is a module, and the rest is shared.

#![allow(
    unreachable_pub,
    dead_code,
    clippy::unwrap_used,
    reason = "modules of tests, and tables that some of them share; a test fails by panicking"
)]

#[path = "support/bench.rs"]
mod bench;
mod between;
#[path = "support/body.rs"]
mod body;
mod calibration;
mod choice;
mod coverage;
mod design;
mod design_given;
mod design_scatter;
mod design_sets;
mod fit_network;
mod infer;
mod infer_determined;
mod infer_follow;
mod infer_inputs;
mod infer_noise;
mod late_records;
mod law;
mod law_consistency;
mod law_coverage;
mod law_slopes;
mod least_squares;
mod network_intervals;
mod noise;
mod open;
#[path = "support/planned.rs"]
mod planned;
mod posterior;
mod prior_together;
mod profile;
mod recorded;
#[path = "support/records.rs"]
mod records;
mod results;
#[path = "support/runs.rs"]
mod runs;
mod sensors;
mod step;
#[path = "support/student.rs"]
mod student;
mod taken;
