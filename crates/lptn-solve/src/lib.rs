//! Analyses of an assembled network: steady state, transient, energy ledger.
//!
//! [`SteadyState::solve`] solves `G T = q` directly; [`Transient`] integrates `C dT/dt = q(t, T)` from one known
//! discontinuity to the next and gives a [`Solution`] with its [`Ledger`]. This crate knows nothing of TOML
//! and of pointers.
//!
//! Units: SI, temperatures in K, heat positive into a node and from `from` to `to`.

mod error;
mod heat;
mod ledger;
#[cfg(test)]
mod mutants;
mod recorder;
mod settings;
mod solution;
mod stateless;
mod steady;
mod summary;
mod table;
mod times;
mod transient;
mod watch;

pub use error::{SettingsError, SteadyError, StopReason, TransientError};
pub use ledger::Ledger;
pub use lptn_integrate::{LinearSolver, Linkage, Statistics, linked};
pub use lptn_network::OutputTimes;
pub use settings::{Control, Progress, Record, Transient};
pub use solution::{End, Solution};
pub use steady::SteadyState;
pub use summary::{NodeSummary, Summary};
pub use table::{Column, Selection, Table};

pub use watch::{Seen, Watch, top};
