//! Many candidates: values of parameters, and what is reported of each.

mod cases;
mod error;
mod latin;
mod task;

pub use cases::Cases;
pub use error::SweepError;
pub use task::{Candidate, SweepTask};
