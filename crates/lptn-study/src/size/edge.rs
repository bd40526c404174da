//! Edges: values at which the network goes to another state, and the margin of a requirement jumps.
//!
//! The error of a run decides on which side of an edge it is. So the answer is a value from which
//! runs of several tolerances all go the same way.

use lptn_network::NodeId;

use crate::size::answer::{Edge, Trial};
use crate::size::error::SizeError;
use crate::size::judge::{Care, Moments};
use crate::size::search::Search;

/// The margin of a requirement jumps if it changes by more than this share of its scale between
/// neighbouring values.
const JUMP: f64 = 1e-3;

/// Neighbouring values differ by less than this share.
const NEIGHBOURS: f64 = 1e-9;

/// Tolerances in K to which the network is followed to a steady state.
const TOLERANCES: [f64; 4] = [1e-3, 1e-4, 1e-5, 1e-6];

/// The first distance from an edge that is tried, as a share of the value, and how it grows.
const FIRST: f64 = 1e-10;
const FURTHER: f64 = 3.0;

/// The share of the value beyond which no answer is searched after an edge.
const FURTHEST: f64 = 1e-6;

/// The most distances.
const DISTANCES: usize = 24;

impl Search<'_> {
    /// The edge between a value that keeps everything and one that does not, if there is one and
    /// not only a border.
    pub(super) fn edge(&self, kept: &Trial, broken: f64) -> Result<Option<Edge>, SizeError> {
        if (broken - kept.value).abs() > NEIGHBOURS * kept.value.abs() {
            return Ok(None);
        }
        let beyond = self.beyond(kept.value, broken)?;
        if self.worst(kept) - self.worst(&beyond) <= JUMP {
            return Ok(None);
        }
        let closest = self.closest(&beyond);
        let states = self.states([kept.value, beyond.value]);
        let margin = beyond.judged.margins[closest];
        Ok(Some(Edge { value: kept.value, beyond: margin, broken: closest, states }))
    }

    /// The first trial beyond an edge that has an answer.
    fn beyond(&self, kept: f64, broken: f64) -> Result<Trial, SizeError> {
        let mut distance = broken - kept;
        loop {
            match self.trials.at(kept + distance) {
                Err(error) if error.is_not_found() => distance *= 10.0,
                other => return other,
            }
            if distance.abs() > FURTHEST * kept.abs() {
                return self.trials.at(kept + distance);
            }
        }
    }

    /// The node whose steady temperature differs most between two values.
    fn states(&self, values: [f64; 2]) -> Option<(NodeId, [f64; 2])> {
        let task = self.trials.task;
        let Moments::Steady(time) = task.demand.moments else { return None };
        let [here, there] =
            values.map(|value| self.trials.judge.states(&[(task.parameter, value)], time).ok());
        let mut most = None;
        let mut apart = 0.0;
        for (here, there) in here?.iter().zip(&there?) {
            for (id, (here, there)) in task.demand.network.node_ids().zip(here.iter().zip(there)) {
                if (here - there).abs() > apart {
                    apart = (here - there).abs();
                    most = Some((id, [*here, *there]));
                }
            }
        }
        most
    }

    /// The trial on the way from an edge to `inside` that is twice as far from it as the edges of
    /// runs of other tolerances; the one at the edge if these do not differ. If that distance is
    /// not known, the first trial that all of them keep.
    pub(super) fn safe(
        &self,
        (at_edge, broken): (Trial, f64),
        inside: f64,
    ) -> Result<Trial, SizeError> {
        let room = inside - at_edge.value;
        let (mut distance, mut first) = (0.0_f64, None);
        for k in 0..DISTANCES {
            if 2.0 * distance.abs() >= room.abs() {
                break;
            }
            let (kept, beyond) = (at_edge.value + distance, at_edge.value - distance);
            if self.all_runs(kept, true) {
                first = first.or(Some(kept));
                let outside = if k == 0 { broken } else { beyond };
                if self.all_runs(outside, false) {
                    return self.trials.at(kept + distance);
                }
            }
            distance = match k {
                0 => (FIRST * at_edge.value.abs()).max(f64::MIN_POSITIVE).copysign(room),
                _ => FURTHER * distance,
            };
        }
        first.map_or(Ok(at_edge), |value| self.trials.at(value))
    }

    /// True if runs of all tolerances keep everything (`keep`), or none of them does (not `keep`).
    fn all_runs(&self, value: f64, keep: bool) -> bool {
        let like = |care: &Care| match self.trials.with(value, *care) {
            Ok(trial) => self.keeps(&trial) == keep,
            Err(_) => !keep,
        };
        let as_asked = [Care::Look, Care::Proof];
        let steady = TOLERANCES.map(Care::Within);
        if self.trials.exact() { steady.iter().all(like) } else { as_asked.iter().all(like) }
    }
}
