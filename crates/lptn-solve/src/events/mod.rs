//! Events: controls that switch, comparisons of temperatures that change, limits that break.

mod consistent;
mod crossing;
mod gates;
mod indicator;
mod log;
mod nearness;
mod switching;

pub(crate) use consistent::find as find_consistent;
pub(crate) use crossing::{Crossings, Look, Trouble, find as find_crossings};
pub(crate) use gates::Gates;
pub use indicator::{EventIndicator, PositiveSide};
pub use log::{ControlState, Event, EventKind};
pub use nearness::Undecided;
pub(crate) use nearness::{Nearness, Stay};
pub(crate) use switching::Switching;
