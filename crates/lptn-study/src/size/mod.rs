//! Sizing: what a cooling has to do, and the value of a parameter that keeps what is required.

mod coolants;
mod cooling;
mod error;
mod judge;
mod root;
mod search;

pub use cooling::{Coolant, CoolantFlow, Cooling, CoolingError, CoolingTask};
pub use error::{SizeError, TrialError};
pub use judge::{Demand, Judged, LoadCase, Moments, RunOf, Watcher, judge};
pub use search::{SizeTask, Sizing, Trial, Verdict, size};
