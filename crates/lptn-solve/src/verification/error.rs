//! Reasons why a network near a state cannot be compared with its linear one.

use lptn_network::InputError;

use crate::error::TransientError;
use crate::linearised::LinearisedError;
use crate::modes::ModesError;
use crate::stop_reason::StopReason;

lptn_units::errors! {
/// Reason why a network near a state cannot be compared with its linear one.
#[derive(Debug)]
pub enum NearError {
    /// Its modes.
    Modes => ModesError;
    /// It cannot be taken for a linear one there.
    Linearised => LinearisedError;
    /// A run.
    Run => TransientError;
    /// A state of a run.
    Stopped => StopReason;
    /// A disturbed temperature is one that the network has no value for.
    Input => InputError;
}
}
