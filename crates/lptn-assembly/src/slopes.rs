//! Derivatives of heats.

use lptn_network::Received;

/// The heat of an element with its derivatives, evaluated.
#[derive(Clone, Debug, Default)]
pub(crate) struct Slopes {
    /// By variable: derivatives of the heat of both ends.
    pub(crate) ends: Vec<Received>,
    /// By variable: derivative of the heat of a source.
    pub(crate) source: Vec<f64>,
}
