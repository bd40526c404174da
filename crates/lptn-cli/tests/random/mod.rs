//! Random networks, what may be done to them without changing what they mean, and the comparison.
#![allow(unreachable_pub, reason = "a part of a test")]

pub mod compare;
pub mod generate;
pub mod model;
pub mod program;
#[allow(clippy::module_inception, reason = "the random numbers of random networks")]
pub mod random;
pub mod relations;
pub mod results;
pub mod shrink;
pub mod units;
pub mod verbs;
pub mod write;
