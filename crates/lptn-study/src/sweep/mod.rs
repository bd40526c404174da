//! Many candidates: values of parameters, and what is reported of each.

mod cases;
mod error;
mod latin;
mod linear;
mod task;

pub use cases::Cases;
pub use error::SweepError;
pub use linear::LinearSweep;
pub use task::{Candidate, SweepTask};
