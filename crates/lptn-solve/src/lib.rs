//! Analyses of an assembled network: steady state, transient, energy ledger.
//!
//! [`SteadyState::solve`] solves `G T = q` directly; [`Transient`] integrates `C dT/dt = q(t, T)`
//! from one known discontinuity to the next and gives a [`Solution`] with its [`Ledger`]. This
//! crate knows nothing of TOML and of pointers, and of C only the name of the integrator that steps
//! its runs (`stepper.rs`).
//!
//! Units: SI, temperatures in K, heat positive into a node and from `from` to `to`.

mod adiabatic;
mod adjoint;
mod algebraic;
mod anchor;
mod backward;
mod balance;
mod beside;
mod between;
mod bracket;
mod branch;
mod cells;
mod certify;
mod columns;
mod conductances;
mod curved;
mod cuts;
mod days;
mod drawn;
mod driving;
mod error;
mod events;
mod exact;
mod extremes;
mod growth;
mod guard;
mod heat;
mod hidden;
mod inside;
mod insides;
mod interval;
mod last;
mod ledger;
mod limit;
mod limit_look;
mod limit_seen;
mod linearised;
mod looks;
mod lumping;
mod margin;
mod method;
mod modes;
#[cfg(all(test, feature = "cvodes"))]
mod mutants;
mod newton;
mod newton_error;
mod parallel;
mod periodic;
mod pipe;
mod powers;
mod quadrature;
mod quantity;
mod ranges;
mod rate_slopes;
mod rates;
mod reading;
mod readings;
mod recorder;
mod replay;
mod resolve;
mod response;
mod result_slopes;
mod runaway;
mod samples;
#[cfg(test)]
mod scripted;
mod selection;
mod sense;
mod sensed;
mod sensitive_run;
mod sensitivity_rows;
mod settings;
mod settings_error;
mod several;
mod sides;
mod snapshot;
mod solution;
mod solution_error;
mod stability;
mod standing;
mod state;
mod stateless;
mod steady;
mod steady_columns;
mod stencil;
mod stepper;
mod stiffness;
mod stop_reason;
mod summary;
mod table;
mod tangent;
mod times;
mod tracked;
mod trajectory;
mod transient;
mod unbounded;
mod unfold;
mod unsolved;
mod variants;
mod verification;
mod watch;
mod window;
mod zeros;

pub use adjoint::{Adjoint, AdjointError, Influence, ParameterSlopes};
pub use backward::BackwardError;
pub use balance::{Balance, Term};
pub use certify::{Certificate, Uncertified};
pub use conductances::Conductances;
pub use days::{ColumnDays, DaySeen};
pub use drawn::Drawn;
pub use driving::largest_of_inputs;
pub use error::{SteadyError, TransientError};
pub use events::{ControlState, Event, EventIndicator, EventKind, PositiveSide, Undecided};
pub use exact::{Difference, ExactError, ExactSolution};
pub use last::LastState;
pub use ledger::{Ledger, LedgerError};
pub use limit_seen::{LimitSeen, ProvenMargin};
pub use linearised::{Linearised, LinearisedError, Tried};
pub use looks::Looks;
#[cfg(feature = "cvodes")]
pub use lptn_cvodes::{Linkage, linked};
pub use lptn_integrate::dense::Complex;
pub use lptn_integrate::{LinearSolver, Statistics};
pub use lptn_network::OutputTimes;
pub use lumping::{Biot, LumpCheck, Lumping, NotChecked, Stretch};
pub use margin::BentMargin;
pub use method::Method;
pub use modes::{Mode, Modes, ModesError};
pub use parallel::{available_threads, in_order, in_parallel};
pub use periodic::{CycleMethod, Periodic, PeriodicError};
pub use ranges::OutOfRange;
pub use rate_slopes::{
    Direction, DirectionError, DirectionPart, RateJacobian, RateSlopes, RateSlopesError,
};
pub use rates::{Rates, StateRates, boundary_temperatures};
pub use response::{Drive, FrequencyResponse, ResponseError, StepAnswer, settled_rises};
pub use result_slopes::{MarginSlopes, SlopesError};
pub use runaway::Feedback;
pub use selection::{RecordedNodes, Selection, name_matches};
pub use sense::Beyond;
pub use sensitive_run::{
    Gradient, MarginError, SensitiveError, SensitiveRun, can_move, sensitive_run,
    sensitive_run_observed,
};
pub use settings::{Around, Proceed, Progress, Transient};
pub use settings_error::SettingsError;
pub use several::Others;
pub use sides::{on_both_sides, own_side};
pub use snapshot::Snapshot;
pub use solution::{RunStatus, Solution};
pub use solution_error::SolutionError;
pub use state::State;
pub use steady::SteadyState;
pub use steady_columns::SteadyColumns;
pub use stiffness::Stiffness;
pub use stop_reason::StopReason;
pub use summary::{NodeSummary, Summary};
pub use table::{Column, LabelColumn, Table, TableOf};
pub use trajectory::NoTrajectory;
pub use unbounded::Unbounded;
pub use unsolved::Unsolved;
pub use variants::{CourseSeen, LinearVariants, Look, Quantity as FollowedQuantity};
pub use verification::{
    Disturbance, DisturbanceShape, LEAST_TOLERANCE, NearError, NearState, NoReference, Reference,
    RunComparison, Verification, allowed_error,
};

pub use watch::{Watch, Watched, first_there, top};
pub use window::{ColumnSeen, ReportSeen, Window, WindowSeen};
