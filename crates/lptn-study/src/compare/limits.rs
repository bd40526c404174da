//! What became of the limits of a candidate.

use lptn_network::{LimitSeverity, Network};
use lptn_units::{Dimension, Type};

/// What became of a limit.
#[derive(Clone, Debug, PartialEq)]
pub struct CandidateLimit {
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

impl CandidateLimit {
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
