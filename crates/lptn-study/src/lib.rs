//! Studies of networks, and records of the inputs and results of runs.
//!
//! [`Candidate`] is one design of a comparison, [`compare_table`] puts several side by side.
//! [`size`](fn@size) finds the value of a parameter that keeps the requirements, [`CoolingTask`]
//! the cooling that is needed when only a power and two temperatures are known.
//!
//! [`Ranking`] sorts the values of a network by their effect on one of its temperatures.
//!
//! A sweep gives [`Gradients`] of its reports too, for optimisers.
//!
//! A [`Manifest`] is next to the results of a run and lists everything that made them: the hash of
//! every input, the parameters as they were resolved, versions, tolerance, counters of the solver,
//! the energy ledger and the hash of every result. Time and host, which change from run to run, are
//! in [`Environment`]; the rest is the same to the last byte whenever the same inputs are run by
//! the same program.

mod compare;
mod digest;
mod gears;
mod gradient;
mod manifest;
mod moment;
mod rank;
mod record;
mod size;
pub mod standing;
pub mod sweep;
pub mod uncertainty;

pub use compare::{
    Above, Candidate, CandidateLimit, CandidateReport, CompareError, CompareRow, HeatOut, HeatOver,
    PathShare, Peak, Scatter, Settled, Share, SortKey, compare_table, order,
};
pub use digest::{Hashing, sha256};
pub use gears::{GearError, GearPoint, GearState, GearTask, MemberState, MeshTeeth, PartLoss};
pub use gradient::{GradientError, GradientSeries, Gradients};
pub use manifest::{Environment, FileHash, Manifest, ParameterRecord, RunEnd, Sundials};
pub use moment::utc;
pub use rank::{RankError, Ranking, effect, has_effect};
pub use record::{LedgerRecord, SiValue, StatisticsRecord};
pub use size::{
    Aim, Choice, ChoiceTask, Choices, Coolant, CoolantFlow, Cooling, CoolingError, CoolingTask,
    Demand, Design, Doubt, Edge, Judged, LoadCase, Moments, Parts, RunOf, Several, SeveralTask,
    Shortfall, SizeError, SizeTask, Sizing, Trial, TrialError, Verdict, Watcher, certify, choose,
    judge, size, size_several,
};
