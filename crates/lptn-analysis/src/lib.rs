//! Analyses: one question to a network, and its answer with how far it can be trusted.
//!
//! An [`Analysis`] is one of a steady state, a run ([`RunAnalysis`]) or the cycle that a network
//! settles to. [`Analysis::ask`] gives a result with the [`Trust`] in it. No other crate above the
//! solver starts a run, solves a steady state or searches a cycle.
//!
//! A [`Simulation`] is stepped from outside, with inputs that its client sets between the steps. It
//! gives rates, event indicators and derivatives to simulators that integrate its states themselves.
//!
//! An answer exists only if its energy balance closes, its ranges of validity could be checked and
//! nothing interrupted it. Its rows decide nothing: peaks, limits, heats and windows are evaluated
//! between the rows.
//!
//! Units: SI, temperatures in K, heat positive into a node and from `from` to `to`.

mod analysis;

mod error;
mod limits;
mod run;
mod simulation;
mod simulation_error;
mod slopes;
mod steady;
mod trust;
mod trusted;

pub use analysis::{Analysis, Found};
pub use error::{AnalysisError, CycleError, RunError};
pub use limits::LimitResult;
pub use run::{Observer, RunAnalysis};
pub use simulation::{SavedControl, SavedSimulation, Simulation};
pub use simulation_error::SimulationError;
pub use steady::{steady, steady_within};
pub use trust::{Trust, Unresolved};
pub use trusted::Trusted;
