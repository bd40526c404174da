//! Sizing: what a cooling has to do, and the value of a parameter that keeps what is required.

mod coolants;
mod cooling;
mod error;
mod root;
mod search;
mod trial;

pub use cooling::{Coolant, CoolantFlow, Cooling, CoolingError, CoolingTask};
pub use error::SizeError;
pub use search::{Sizing, Verdict, size};
pub use trial::{SizeTask, Trial, requirement_margins};
