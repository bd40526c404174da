//! Parameters, laws and choices of networks from records.

pub mod compare;
pub mod figure;
pub mod network;
