//! Thermal networks: nodes, boundaries, conductors and sources, with the invariants that make them solvable.
//!
//! A [`Network`] is built by a [`NetworkBuilder`], from Rust or from a netlist, and never changes;
//! [`Network::with`] gives the same structure with other parameters. This crate knows nothing of TOML, of
//! matrices or of solvers.
//!
//! Units: SI inside, temperatures in K. Sign: heat is positive from `from` to `to`, and into a node.

mod body;
mod breakpoints;
mod builder;
mod changing;
mod check;
mod checks;
mod clash;
mod conductances;
mod control;
mod curves;
mod dependence;
mod element;
mod enthalpy;
mod error;
mod error_words;
mod evaluation;
mod flow;
mod fluid;
mod grid;
mod id;
mod input_error;
mod label;
mod law;
mod layout;
mod limit;
mod lookup;
mod material;
mod name_index;
mod names;
mod network;
mod numbered;
mod numbers;
mod parameters;
mod parts;
mod periodicity;
mod positions;
mod result;
mod rising;
mod run;
mod scope;
mod signal;
mod stream;
mod switch;
mod tangent;
mod thermal;
mod typed;
mod value;

pub use body::{NoMaterial, Surface};
pub use breakpoints::same_time;
pub use builder::{NetworkBuilder, Path};
pub use changing::Changing;
pub use control::{Acts, Control, Thermostat};
pub use curves::Curve;
pub use element::{Boundary, Capacitor, Conductor, Node, Parameter, Source};
pub use enthalpy::{Content, Enthalpy};
pub use error::{BuildError, BuildErrorKind, BuildErrors};
pub use error_words::{Naming, Say};
pub use evaluation::Evaluation;
pub use flow::{Flow, Received};
pub use fluid::Fluid;
pub use grid::{Block, Face, Grid, GridFace, GridValue, Joint, MOST_CELLS, Substance, Terminal};
pub use id::{
    BoundaryId, CapacitorId, ConductorId, ControlId, End, Field, FluidId, GridId, Item, JointId, LawField,
    LimitId, MaterialId, NodeId, ParameterId, ReportId, SignalId, SourceId, SwitchId, TableId,
};
pub use input_error::{InputError, InputProblem};
pub use law::Law;
pub use layout::slot;
pub use limit::{Bound, Limit, Severity};
pub use lptn_laws::{Carries, Formula, Kind as ConductorKind};
pub use material::{Lump, Material, Melting, Properties, Size};
pub use names::{UnknownName, is_name, is_path, list_of, list_of_names};
pub use network::Network;
pub use parameters::{ParameterError, Parameters};
pub use periodicity::{NoCommonPeriod, NotPeriodic};
pub use positions::Positions;
pub use result::{HeatOf, Report};
pub use run::{OutputTimes, RunSettings, WindowSettings};
pub use scope::{Context, NetworkScope};
pub use signal::{AfterEnd, Course, Join, Signal};
pub use stream::Passing;
pub use switch::Switch;
pub use tangent::{NoTangents, Tangents};
pub use typed::{
    Area, Conductance, FilmCoefficient, HeatCapacity, HeatFlow, Resistance, Temperature, Time, ZERO_CELSIUS,
};
pub use value::{Input, Value};
