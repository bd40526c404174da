//! How near a limit came to being broken, and when it first was.

use lptn_network::LimitId;

/// A time in s with a margin.
pub(crate) type Point = (f64, f64);

/// How a limit fared in a run, between the rows too.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LimitSeen {
    /// The limit.
    pub limit: LimitId,
    /// Its least margin in SI units, positive if it was kept all the time; NaN if it could not be
    /// [judged](lptn_network::Network::is_judged) at any moment; see
    /// [`lptn_network::Network::limit_margin`]. That of the mean over time for
    /// [`lptn_network::Limit::of_mean`]. Zero where a temperature passes it by less than ten times
    /// the tolerance, which is the error of a run.
    pub margin: f64,
    /// When that was, in s.
    pub worst_at: f64,
    /// When it was first broken, in s.
    pub broken_at: Option<f64>,
    /// By how much in SI units the margin may be off beside the error of temperatures, because its
    /// quantity changes faster than steps are looked at; 0 where it does not.
    pub open: f64,
}

impl LimitSeen {
    /// The same with the mean of its margin, known at the end.
    pub(crate) fn of_mean(self, (time, margin): Point) -> Self {
        let broken_at = (margin < 0.0).then_some(time);
        Self { margin, worst_at: time, broken_at, ..self }
    }

    /// Takes in the next point.
    pub(crate) fn take_in(&mut self, (time, margin): Point) {
        if margin < self.margin {
            (self.margin, self.worst_at) = (margin, time);
        }
        if margin < 0.0 {
            self.broken_at.get_or_insert(time);
        }
    }
}
