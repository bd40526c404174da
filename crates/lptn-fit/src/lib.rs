//! Parameters from measurements, and how well the measurements determine them.
//!
//! [`least_squares`] finds the parameters of any model that are nearest to data; [`Covariance`] and
//! [`Spectrum`] show how well the data determine them. [`noise`] gives standard errors if residuals
//! depend on those before them. [`step`] is the seed paper's fit of one exponential, and
//! [`network`] the fit of any network's parameters. [`choice`] finds the network that records
//! favour.

pub mod choice;
pub mod infer;
pub mod kalman;
pub mod law;
pub mod least_squares;
pub mod network;
pub mod noise;
pub mod step;

mod covariance;
mod simplex;
mod spectrum;

pub use covariance::Covariance;
pub use spectrum::Spectrum;
