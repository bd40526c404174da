//! What became of the limits of a candidate.

use lptn_network::{LimitSeverity, Network};
use lptn_solve::LimitSeen;
use lptn_units::{Dimension, Type};

/// What became of a limit.
#[derive(Clone, Debug, PartialEq)]
pub struct LimitResult {
    /// The name of the limit in its network.
    pub name: String,
    /// Type of the margin; a difference for temperatures.
    pub ty: Type,
    /// What it means if it is broken.
    pub severity: LimitSeverity,
    /// The least margin, in SI units: positive while the limit is kept; NaN where it is not judged,
    /// since it depends on inputs that change with time and was looked at in steady state only.
    pub margin: f64,
    /// When it is first broken, in s; `None` if it is kept, or was looked at in steady state or over
    /// the settled cycle.
    pub broken_at: Option<f64>,
}

impl LimitResult {
    /// Whether it is neither kept nor broken, because it was not judged.
    pub fn is_open(&self) -> bool {
        self.margin.is_nan()
    }

    /// Whether it is broken.
    pub fn broken(&self) -> bool {
        self.margin < 0.0
    }

    /// Whether its margin is a temperature difference.
    pub fn is_temperature(&self) -> bool {
        self.ty == Type::of(Dimension::TEMPERATURE)
    }
}

/// The limits of a network with margins and times of the first break, in the order of the network.
fn results(network: &Network, found: impl Iterator<Item = (f64, Option<f64>)>) -> Vec<LimitResult> {
    let one = |(limit, (margin, broken_at)): (&lptn_network::Limit, _)| {
        let (name, ty, severity) = (limit.name.clone(), limit.margin_type(), limit.severity);
        LimitResult { name, ty, severity, margin, broken_at }
    };
    network.limits().iter().zip(found).map(one).collect()
}

pub(crate) fn in_steady_state(network: &Network, margins: &[f64]) -> Vec<LimitResult> {
    results(network, margins.iter().map(|&margin| (margin, None)))
}

pub(crate) fn over_time(network: &Network, seen: &[LimitSeen]) -> Vec<LimitResult> {
    results(network, seen.iter().map(|seen| (seen.margin, seen.broken_at)))
}
