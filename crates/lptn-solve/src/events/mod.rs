//! Events: controls that switch, comparisons of temperatures that change, limits that break.

mod consistent;
mod crossing;
mod gates;
mod indicator;
mod log;
mod switching;

pub(crate) use consistent::find as find_consistent;
pub(crate) use crossing::{Trouble, find as find_crossings};
pub(crate) use gates::Gates;
pub use indicator::{EventIndicator, PositiveSide};
pub use log::{ControlState, Event, EventKind};
pub(crate) use switching::Switching;
