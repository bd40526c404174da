//! A network seen from one node: its Norton equivalent and the error of that.
//!
//! At a *port* (a node) a linear network is `q = Q_N - (T - T_ref) / R_eq` in steady state,
//! exactly: [`NortonEquivalent`]. Over time it is not one resistance and one capacity but a sum of
//! exponentials, [`StepResponse`]; the capacity `C_eq` of the nearest one-node network depends on
//! the meaning of "nearest", so [`Reduction`] gives it by four [`Definition`]s. Each has its
//! largest [`Deviation`] for a unit step of heat and for the network's own inputs. Streams of
//! constant capacity rate may be among the paths. Streams that go on from node to node make the
//! network unsymmetric and leave it without a [`StepResponse`]. [`Nodes`] are a few nodes at a
//! port, [`WorstCase`] their error over every load, [`Kept`] several nodes with the conductances
//! between them. The impedance of a port has two equivalent forms, [`Foster`](lptn_network::Foster)
//! and [`Cauer`](lptn_network::Cauer). [`fit_exponential`] and [`Bias`] are the method of the seed
//! paper, which infers heat from one exponential.
//!
//! Units: SI, temperatures in K, resistances in K/W, capacities in J/K, heat positive into a node.

mod allowed;
mod bias;
mod capacity;
mod carried;
mod definition;
mod deviation;
mod error;
mod exponentials;
mod fewer;
mod fit;
mod kept;
mod kept_errors;
mod kept_network;
mod lanczos;
mod near;
mod nodes;
mod norton;
mod one_node;
mod projected;
mod reduction;
mod rises;
mod step;
mod streams;
mod table;
mod worst;

pub use allowed::Allowed;
pub use bias::Bias;
pub use definition::{Definition, Judge, Pair, Recommended};
pub use deviation::Deviation;
pub use error::{FitError, ReduceError};
pub use fit::{ExponentialFit, fit_exponential};
pub use kept::{Kept, Recovery};
pub use kept_errors::{KeptErrors, KeptReference};
pub use nodes::Nodes;
pub use norton::{Inputs, NortonEquivalent, port, transfer_resistance};
pub use projected::Projected;
pub use reduction::{Dynamics, LeastSquaresWindow, Reduction, ReductionOptions, TOLERANCE};
pub use step::{ResponseTerm, StepResponse};
pub use worst::{Stretch, WorstCase};
