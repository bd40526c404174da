//! From a [`Network`](lptn_network::Network) to the sparse system `C dT/dt = q(t, T)`.
//!
//! [`ThermalSystem`] is assembled once: capacities, links, the pattern of the Jacobian with its
//! full diagonal. Massless nodes are eliminated exactly (star-mesh) and recovered in every output,
//! so that the state has only nodes with capacity. Time stepping and files are not in this crate.
//!
//! Units: SI, temperatures in K. Heat is positive into a node.

mod bodies;
mod change;
mod contents;
mod element;
mod eliminate;
mod enclosure;
mod error;
mod heat;
mod links;
mod monotone;
mod outer;
mod part;
mod pattern;
mod positions;
mod radiation;
mod scaled;
mod slopes;
mod sweep;
mod switching;
mod system;
mod tangent;
mod together;
mod workspace;

pub use change::ChangeError;
pub use element::JacobianForm;
pub use enclosure::{BoxSlopes, FlowBounds};
pub use error::AssemblyError;
pub use part::Part;
pub use pattern::JacobianPattern;
pub use system::ThermalSystem;
pub use workspace::Workspace;
