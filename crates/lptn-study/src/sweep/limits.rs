//! Limits of a candidate: whether all are kept, which one is the worst, and by how much.
//!
//! Margins of different units cannot be compared, so each unit has its own least margin. A broken
//! limit is worse than a kept one, and one of severity `"error"` worse than one of `"warning"`.

use lptn_network::{Limit, LimitSeverity, Network};
use lptn_units::{Dimension, Type};

use crate::standing::standing;

/// The limits of a network with the units of their margins.
#[derive(Clone, Debug)]
pub struct SweepLimits {
    /// The types of margins, in the order of the first limit of each.
    types: Vec<Type>,
    limits: Vec<Known>,
}

#[derive(Clone, Debug)]
struct Known {
    name: String,
    severity: LimitSeverity,
    /// The place of its type.
    place: usize,
}

/// The limits of one candidate.
#[derive(Clone, Debug, PartialEq)]
pub struct LimitsJudged<'a> {
    /// The word of [`standing`](mod@crate::standing).
    pub standing: &'static str,
    /// The name of the worst limit; empty if none was judged.
    pub worst: &'a str,
    /// The margin of the worst limit of each unit, in SI units; NaN if none was judged.
    pub margins: Vec<f64>,
}

impl SweepLimits {
    pub(super) fn of(network: &Network) -> Self {
        let mut types: Vec<Type> = Vec::new();
        let known = |limit: &Limit| {
            let ty = limit.margin_type();
            let place = types.iter().position(|other| *other == ty).unwrap_or_else(|| {
                types.push(ty);
                types.len() - 1
            });
            Known { name: limit.name.clone(), severity: limit.severity, place }
        };
        let limits = network.limits().iter().map(known).collect();
        Self { types, limits }
    }

    /// True without limits.
    pub fn is_empty(&self) -> bool {
        self.limits.is_empty()
    }

    /// The type of each margin that a candidate has.
    pub fn types(&self) -> &[Type] {
        &self.types
    }

    /// Judges a candidate by the margin of each limit in SI units, NaN if it was not judged.
    pub fn judge(&self, margins: &[f64]) -> LimitsJudged<'_> {
        let all = || self.limits.iter().zip(margins.iter().copied());
        let rank = |(limit, margin): &(&Known, f64)| {
            (*margin >= 0.0, limit.severity == LimitSeverity::Warning)
        };
        let judged = |place: Option<usize>| {
            let judged = all().filter(|(_, margin)| !margin.is_nan());
            let judged = judged.filter(|(limit, _)| place.is_none_or(|own| own == limit.place));
            judged.min_by(|a, b| {
                let places = (a.0.place, b.0.place);
                let units = rank(a).cmp(&rank(b)).then(places.0.cmp(&places.1));
                units.then(a.1.total_cmp(&b.1))
            })
        };
        LimitsJudged {
            standing: standing(all().map(|(limit, margin)| (margin, limit.severity))),
            worst: judged(None).map_or("", |(limit, _)| &limit.name),
            margins: (0..self.types.len())
                .map(|place| judged(Some(place)).map_or(f64::NAN, |(_, margin)| margin))
                .collect(),
        }
    }
}

/// True if the margin of a limit is a temperature difference.
pub(super) fn is_temperature(limit: &Limit) -> bool {
    limit.ty.dimension == Dimension::TEMPERATURE
}
