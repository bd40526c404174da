//! Thermal networks: nodes, boundaries, conductors and sources, with the invariants that make them
//! solvable.
//!
//! A [`Network`] is built by a [`NetworkBuilder`], from Rust or from a netlist, and never changes;
//! [`Network::with`] gives the same structure with other parameters. This crate knows nothing of
//! TOML, of matrices or of solvers.
//!
//! Units: SI inside, temperatures in K. Sign: heat is positive from `from` to `to`, and into a
//! node.
//!
//! A network is built in layers: `parts` (its components, before any number is computed), `numbers`
//! (their values for one set of parameters, checked), `network` (the queries) and `builder` on top.
//! A topic such as controls has a file in each layer. One file for the whole topic would need every
//! layer at once.

mod along;
mod bends;
mod breakpoints;
mod build_error;
mod builder;
mod changing;
mod check;
mod clash;
mod curves;
mod enthalpy;
mod error;
mod error_words;
mod evaluation;
mod gauss;
mod id;
mod input_error;
mod knots;
mod ladder;
mod law;
mod name_index;
mod names;
mod network;
mod numbers;
mod parameters;
mod parts;
mod patch_words;
mod periodicity;
mod positions;
mod rising;
mod run;
mod scope;
pub mod slot;
mod stream;
mod sweeps;
mod tangent;
mod typed;
mod value;
mod variant;

pub use bends::Bends;
pub use breakpoints::same_time;
pub use build_error::{BuildError, BuildErrors};
pub use builder::grid::{GridBlock, GridBody, GridCylinder};
pub use builder::state::StateLaw;
pub use builder::substance::{NoMaterial, Properties};
pub use builder::{NetworkBuilder, Path};
pub use changing::Changing;
pub use curves::Curve;
pub use enthalpy::{Content, Enthalpy};
pub use error::BuildErrorKind;
pub use error_words::{Naming, Say};
pub use evaluation::Evaluation;
pub use id::{
    BoundaryId, CapacitorId, ConductorId, ControlId, End, FacePathId, FaceStreamId, Field, FluidId,
    GridId, GridPatch, Item, LawField, LimitId, MaterialId, NodeId, ParameterId, ReportId,
    SignalId, SourceId, StateId, SwitchId, TableId, ValueId,
};
pub use input_error::{InputError, InputProblem};
pub use ladder::{Cauer, Foster, LadderError};
pub use law::{ConductorFlow, Law, Received};
pub use lptn_laws::{Carries, Extent, Formula, Kind as ConductorKind};
pub use names::{UnknownName, is_name, is_path, list_of, list_of_names};
pub use network::Network;
pub use network::alike::Alike;
pub use network::axes::GridAxis;
pub use network::body::Surface;
pub use network::conductivity::Conductivity;
pub use network::enclosure::InputBounds;
pub use network::fields::ValueChange;
pub use parameters::{ParameterError, Parameters};
pub use parts::control::{Acts, Control, Thermostat};
pub use parts::dependence::Vertices;
pub use parts::element::{Boundary, Capacitor, Conductor, Node, Parameter, Source};
pub use parts::face_stream::FaceStream;
pub use parts::functional::{Functional, History, OverTime};
pub use parts::grid::{Face, FacePath, Grid, GridFace, MOST_CELLS, Substance, Terminal};
pub use parts::grid_value::GridValue;
pub use parts::heat::HeatOf;
pub use parts::layout::Followed;
pub use parts::named_value::NamedValue;
pub use parts::overlap::Placement;
pub use parts::patch::{Outline, Patch, PatchProblem};
pub use parts::pipe::{Pipe, PipePart};
pub use parts::result::{Bound, Limit, LimitSeverity, Report};
pub use parts::shape::{Form, Shape};
pub use parts::signal::{AfterEnd, Course, Join, Signal};
pub use parts::state::State;
pub use parts::state_capacity::StateCapacity;
pub use parts::substance::{Fluid, Material, Melting, Winding};
pub use parts::switch::Switch;
pub use periodicity::{NoCommonPeriod, NotPeriodic};
pub use positions::Positions;
pub use run::{IntegratorChoice, OutputTimes, RunSettings, Varied, WindowSettings};
pub use scope::{Context, NetworkScope};
pub use stream::{Outlet, Passing};
pub use sweeps::Reader;
pub use tangent::{NoTangents, Tangents, Variable};
pub use typed::{
    Area, Conductance, FilmCoefficient, HeatCapacity, HeatFlow, Resistance, Temperature, Time,
    ZERO_CELSIUS,
};
pub use value::{Input, Lump, Size, Value};
pub use variant::Variants;
