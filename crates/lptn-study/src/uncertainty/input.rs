//! The parameters that carry `±`.

use lptn_network::{Network, ParameterId, Parameters};

use crate::uncertainty::UncertaintyError;

/// A parameter whose value is known with a standard deviation only.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Uncertain {
    /// Which parameter carries `±`.
    pub parameter: ParameterId,
    /// Its value in SI units, absolute temperatures in K: the mean.
    pub value: f64,
    /// One standard deviation in SI units, more than 0.
    pub deviation: f64,
}

/// The parameters of `network` that carry `±`, in the order of the network; `parameters` are the
/// values that were set in place of its own, whose `±` counts where it was given.
///
/// # Errors
/// [`UncertaintyError::NoDeviation`] if none does.
pub fn uncertain(
    network: &Network,
    parameters: &Parameters,
) -> Result<Vec<Uncertain>, UncertaintyError> {
    let one = |parameter: ParameterId| {
        let own = network.parameters()[parameter.index()].deviation;
        let deviation =
            parameters.deviation(parameter).or(own).filter(|deviation| *deviation > 0.0)?;
        Some(Uncertain { parameter, value: network.parameter_value(parameter), deviation })
    };
    let found: Vec<Uncertain> = network.parameter_ids().filter_map(one).collect();
    if found.is_empty() { Err(UncertaintyError::NoDeviation) } else { Ok(found) }
}
