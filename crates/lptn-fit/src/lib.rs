//! Parameters from measurements, with what the measurements can and cannot tell.
//!
//! [`least_squares`] finds the parameters of any model that are nearest to data; [`Covariance`] and
//! [`Spectrum`] say how well the data determine them. [`noise`] gives standard errors where
//! residuals depend on those before them. [`step`] is the seed paper's fit of one exponential,
//! [`network`] the fit of any network's parameters,
//! [`choice`] which of several networks the records speak for.

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
