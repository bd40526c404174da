//! Lumped-parameter thermal networks: simulated, with units checked and energy accounted for.
//!
//! ```
//! use lptn::prelude::*;
//!
//! # fn main() -> Result<(), lptn::Error> {
//! let mut b = NetworkBuilder::new();
//! let steel = b.node("steel", HeatCapacity(2659.0), Temperature::celsius(25.5));
//! let bed = b.boundary("bed", Temperature::celsius(25.5));
//! b.resistor("R_eq", steel, bed, Resistance(0.3046));
//! b.source("losses", steel, HeatFlow(220.6));
//! let system = ThermalSystem::assemble(&b.build()?)?;
//!
//! let steady = SteadyState::solve(&system, 0.0)?;
//! assert!((steady[steel] - (273.15 + 25.5 + 220.6 * 0.3046)).abs() < 1e-9);
//!
//! let run = Transient::until(Time::minutes(25.0)).solve(&system)?;
//! assert!(run.at_end(steel)? < steady[steel] && run.ledger().closes());
//! # Ok(())
//! # }
//! ```
//!
//! Every error becomes an [`Error`], which `main` can return. Many candidates of one network need
//! no second assembly from text: [`ThermalSystem::with`] takes other values of its parameters.
//!
//! A network comes from a TOML netlist ([`Input`], [`read`], [`parse`]) or from a
//! [`NetworkBuilder`]. A question such as [`RunQuestion`] asks it and gives an [`Answer`]: values
//! with units, tables, doubts, verdict, figures, in every format of the command line. A
//! [`RunAnalysis`] gives the numbers alone. A [`Simulation`] is stepped from outside and gives its
//! rates, event indicators and derivatives.
//!
//! This crate exports everything a client needs. The crates below it (`lptn-network`, `lptn-solve`,
//! …) export the rest; ARCHITECTURE.md lists them. All numbers are in SI units, temperatures in K,
//! heat positive into a node and from `from` to `to`.

mod error;

pub use error::Error;

/// Questions to a netlist, and their answers.
pub use lptn_answer::{
    answer::Answer,
    belief::Belief,
    check::{CheckAnswer, CheckQuestion},
    compare::{CompareAnswer, CompareQuestion},
    cycle::{CycleAnswer, CycleQuestion},
    exit::Exit,
    failure::Failure,
    fit::compare::{CandidateNetlist, FitCompareAnswer, FitCompareQuestion},
    fit::law::{FitLawAnswer, FitLawQuestion, FitRunsAnswer, StatedLawsAnswer, StatedLawsQuestion},
    fit::network::{FitNetworkAnswer, FitNetworkQuestion},
    fit::step::{FitStepAnswer, FitStepQuestion},
    fit::terms::{FitTermsAnswer, FitTermsQuestion},
    gear::{GearAnswer, GearQuestion},
    graph::{GraphAnswer, GraphQuestion},
    impedance::{Form as ImpedanceForm, ImpedanceAnswer, ImpedanceQuestion},
    infer::{InferAnswer, InferQuestion},
    input::{Input, quantity, tolerance},
    limits::Verdict,
    listener::{Listener, Nobody, Which},
    loaded::Loaded,
    lumping::Detail,
    messages::list as problems_as_json,
    modes::{ModesAnswer, ModesQuestion},
    plan::{PlanAnswer, PlanQuestion},
    rank::{Over, RankAnswer, RankQuestion},
    reduce::{KeepQuestion, KeptAnswer, ReduceAnswer, ReduceQuestion},
    run::uncertainty::{Method, UncertaintyQuestion},
    run::{NoSteady, RunAnswer, RunQuestion, RunTask},
    size::{CoolingAnswer, CoolingQuestion, SizeAnswer, SizeQuestion},
    steady::{SteadyAnswer, SteadyQuestion},
    sweep::{Shard, SweepAnswer, SweepAsked, SweepQuestion},
    verify::{VerifyAnswer, VerifyQuestion},
};
/// Pages in their formats.
pub use lptn_report::{
    Cells, Format, Look, Page, Picture, Report, RowColumn, Rows, Text, TimeUnit, report_of, write,
    write_csv,
};

/// Numbers without pages, and simulations that are stepped.
pub use lptn_analysis::{
    Analysis, AnalysisError, CycleError, Found, LimitResult, RunAnalysis, RunError,
    SavedSimulation, Simulation, SimulationError, Trust, Trusted, Unresolved, steady,
    steady_within,
};
pub use lptn_assembly::{AssemblyError, ThermalSystem};
pub use lptn_solve::{
    Direction, DirectionError, DirectionPart, Event, EventIndicator, EventKind, ExactSolution,
    Ledger, LimitSeen, Lumping, Modes, Periodic, PositiveSide, Proceed, Progress, RateJacobian,
    RateSlopes, Rates, RecordedNodes, RunStatus, Selection, Snapshot, Solution, Statistics,
    SteadyError, SteadyState, Table, Transient, TransientError, Window,
};

/// Networks and netlists.
pub use lptn_netlist::format as netlist_format;
pub use lptn_netlist::{
    CsvOptions, Diagnostic, Files, Label, Netlist, ReadError, Rejected, Severity, Span, parse, read,
};
pub use lptn_network::{
    BoundaryId, BuildError, BuildErrors, Conductance, ConductorId, ConductorKind, Face,
    FilmCoefficient, GridBlock, GridFace, HeatCapacity, HeatFlow, Item, LimitId, Network,
    NetworkBuilder, NodeId, OutputTimes, ParameterId, Parameters, Path, Resistance, RunSettings,
    SourceId, Temperature, Time,
};
pub use lptn_units::{
    Dimension, Problem, Quantity, Type, Unit, UnitError, parse_quantity, suggest,
};

/// Reduction, fits and studies on numbers.
pub use lptn_fit::{law, network as network_fit, step};
pub use lptn_reduce::{Definition, Judge, Reduction, ReductionOptions, fit_exponential};
pub use lptn_study::{Candidate, Gradients, SortKey};

/// The names that a program uses most often.
pub mod prelude {
    pub use crate::{
        Answer, Conductance, Exit, Failure, Format, HeatCapacity, HeatFlow, Input, Ledger, Network,
        NetworkBuilder, Nobody, OutputTimes, Page, Resistance, RunQuestion, Selection, Simulation,
        Solution, SteadyQuestion, SteadyState, Table, Temperature, ThermalSystem, Time, Transient,
    };
}
