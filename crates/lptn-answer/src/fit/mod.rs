//! Parameters, laws and choices of networks from records.

pub mod compare;
mod figure;
pub mod law;
pub mod network;
pub mod step;
