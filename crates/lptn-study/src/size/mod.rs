//! Sizing: the cooling that is needed, the value of a parameter that keeps the requirements, and
//! the best of several parameters and of parts.
//!
//! A requirement of a study becomes a limit of the network that is run (`Network::requiring`).
//! Sizing over time therefore evaluates limits between rows by the same code. Evaluations over the
//! range have the tolerance of the run, those that bracket the answer 1e-9 K. If an evaluation errs
//! on an answer by less than its error, the answer is searched again, place by place.

mod aim;
mod answer;
mod choice;
mod coolants;
mod cooling;
mod design;
mod doubt;
mod edge;
mod error;
mod judge;
mod load_case;
mod proof;
mod root;
mod search;
mod several;
mod shortfall;
#[cfg(not(target_family = "wasm"))]
mod smooth;
#[cfg(target_family = "wasm")]
#[path = "not_smooth.rs"]
mod smooth;

pub use aim::Aim;
pub use answer::{Edge, SizeTask, Sizing, Trial, Verdict};
pub use choice::{Choice, ChoiceTask, Choices, Parts, choose};
pub use cooling::{Coolant, CoolantFlow, Cooling, CoolingError, CoolingTask};
pub use design::Design;
pub use error::{SizeError, TrialError};
pub use judge::{Demand, Doubt, Judged, Moments, RunOf, Watcher, judge};
pub use load_case::LoadCase;
pub use proof::certify;
pub use search::size;
pub use several::{Several, SeveralTask, size_several};
pub use shortfall::Shortfall;
