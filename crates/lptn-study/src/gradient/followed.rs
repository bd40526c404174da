//! The quantities of a gradient, and their values.

use lptn_network::{Functional, LimitId};

/// Values and their derivatives, in SI units.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Gradients {
    /// The reports of the study, then the margins.
    pub values: Vec<f64>,
    /// For each value its derivative by each parameter.
    pub slopes: Vec<Vec<f64>>,
}

/// A quantity of results as a limit of the network.
#[derive(Clone, Debug)]
pub(super) struct Followed {
    pub(super) limit: LimitId,
    /// Factor from the margin of the limit to the quantity.
    pub(super) sign: f64,
    pub(super) functional: Functional,
    pub(super) name: String,
}

impl Gradients {
    pub(super) fn add(&mut self, value: f64, slopes: Vec<f64>) {
        self.values.push(value);
        self.slopes.push(slopes);
    }
}

impl Followed {
    /// True if it is a mean or an integral.
    pub(super) fn is_integrated(&self) -> bool {
        matches!(self.functional, Functional::Mean | Functional::Integral)
    }
}
