//! Thermal networks: nodes, boundaries, conductors and sources, with the invariants that make them solvable.
//!
//! A [`Network`] is built by a [`NetworkBuilder`], from Rust or from a netlist, and never changes;
//! [`Network::with`] gives the same structure with other parameters. This crate knows nothing of TOML, of
//! matrices or of solvers.
//!
//! Units: SI inside, temperatures in K. Sign: heat is positive from `from` to `to`, and into a node.

mod breakpoints;
mod builder;
mod check;
mod element;
mod error;
mod id;
mod input_error;
mod limit;
mod material;
mod names;
mod network;
mod numbers;
mod output;
mod parameters;
mod parts;
mod typed;
mod value;

pub use builder::{NetworkBuilder, Path};
pub use element::{Boundary, Capacitor, Conductor, ConductorKind, Law, Node, Parameter, Source};
pub use error::{BuildError, BuildErrorKind, BuildErrors};
pub use id::{
    BoundaryId, CapacitorId, ConductorId, End, Field, Item, LimitId, MaterialId, NodeId, ParameterId,
    SourceId,
};
pub use input_error::{InputError, InputProblem};
pub use limit::{Bound, Limit, PostScope, Severity};
pub use material::{Lump, Material, Properties, Size};
pub use names::{UnknownName, list_of_names};
pub use network::Network;
pub use output::OutputTimes;
pub use parameters::{ParameterError, Parameters};
pub use typed::{
    Area, Conductance, FilmCoefficient, HeatCapacity, HeatFlow, Resistance, Temperature, Time, ZERO_CELSIUS,
};
pub use value::{Evaluation, Input, Value, slot};
