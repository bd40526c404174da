//! Answers in words and as data: doubts in numbers, what became of limits, laws outside their
//! ranges, nodes that are not lumps.
//!
//! A doubt is a [`Diagnostic`](lptn_netlist::Diagnostic) of severity warning with its code, its
//! sentence, its place in the netlist and what to do. Clients print what this crate gives.
//! Doubts of fits, inferences and plans are still made by the command line.

pub mod bound;
pub mod families;
mod gaps;
pub mod limits;
pub mod lumping;
pub mod ranges;
pub mod scale;
mod steady;
pub mod trust;
pub mod words;

pub use gaps::gaps;
pub use steady::{adiabatic, inputs_vary, others};
