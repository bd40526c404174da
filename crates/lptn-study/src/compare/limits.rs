//! Results for the limits of a candidate.

use lptn_network::{LimitSeverity, Network};
use lptn_units::{Dimension, Type};

/// The result for a limit.
#[derive(Clone, Debug, PartialEq)]
pub struct CandidateLimit {
    /// The name of the limit in its network.
    pub name: String,
    /// Type of the margin; a difference for temperatures.
    pub ty: Type,
    /// The consequence if it is broken.
    pub severity: LimitSeverity,
    /// The least margin, in SI units: positive while the limit is kept. NaN if it is not judged,
    /// because it depends on inputs that change with time and was evaluated in steady state only.
    pub margin: f64,
    /// Time in s at which it is first broken; `None` if it is kept, or was evaluated in steady
    /// state or over the periodic steady state.
    pub broken_at: Option<f64>,
}

impl CandidateLimit {
    /// True if it is neither kept nor broken, because it was not judged.
    pub fn is_open(&self) -> bool {
        self.margin.is_nan()
    }

    /// True if it is broken.
    pub fn broken(&self) -> bool {
        self.margin < 0.0
    }

    /// True if its margin is a temperature difference.
    pub fn is_temperature(&self) -> bool {
        self.ty == Type::of(Dimension::TEMPERATURE)
    }
}

/// The limits of a network by name, in its order.
pub(crate) fn named(
    network: &Network,
    found: &[lptn_analysis::LimitResult],
) -> Vec<CandidateLimit> {
    let one = |found: &lptn_analysis::LimitResult| {
        let limit = &network.limits()[found.limit.index()];
        let (name, ty, severity) = (limit.name.clone(), limit.margin_type(), limit.severity);
        CandidateLimit { name, ty, severity, margin: found.margin, broken_at: found.broken_at }
    };
    found.iter().map(one).collect()
}
