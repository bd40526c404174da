//! The least margin of a limit, and when it was first broken.

use lptn_network::LimitId;

use crate::certify::farthest;

/// A time in s with a margin.
pub(crate) type Point = (f64, f64);

/// Result of a limit in a run, between the rows too.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LimitSeen {
    /// The limit.
    pub limit: LimitId,
    /// Its least margin in SI units, positive if it was kept all the time; NaN if it could not be
    /// [judged](lptn_network::Network::is_judged) at any moment; see
    /// [`lptn_network::Network::limit_margin`]. That of numbers over time for
    /// [`lptn_network::Limit::over_time`]. Zero if a temperature passes it by less than ten times the
    /// tolerance, which is the error of a run.
    pub margin: f64,
    /// Time of that margin in s.
    pub worst_at: f64,
    /// Time in s at which it was first broken.
    pub broken_at: Option<f64>,
    /// Possible error of the margin in SI units, in addition to the error of temperatures, because
    /// its quantity changes faster than steps resolve; 0 if it does not.
    pub open: f64,
    /// Proven bounds, if they were asked for and found.
    pub proven: Option<ProvenMargin>,
    /// The margin that was set to zero, with the time in s at which the limit was first broken.
    pub(crate) passed: Option<(f64, Option<f64>)>,
}

/// Proven bounds on the least margin of a limit in a run, and on the time at which it is first
/// broken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProvenMargin {
    /// Both ends of the least margin in SI units.
    pub margin: [f64; 2],
    /// Time in s up to which it is kept for sure, and one at which it is broken for sure; infinite
    /// if there is none.
    pub broken: [f64; 2],
}

impl ProvenMargin {
    /// True if it is kept for sure, false if it is broken for sure; `None` if the bounds do not
    /// decide.
    pub fn kept(&self) -> Option<bool> {
        let [low, high] = self.margin;
        (low >= 0.0 || high < 0.0).then_some(low >= 0.0)
    }

    /// A bound on the error of a margin in SI units.
    pub fn bound(&self, margin: f64) -> f64 {
        farthest(margin, self.margin)
    }
}

impl LimitSeen {
    /// The same with a margin over time, known at the end.
    pub(crate) fn over_time(self, (time, margin): Point) -> Self {
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

#[cfg(test)]
pub(crate) mod tests {
    #![allow(
        clippy::unwrap_used,
        clippy::float_cmp,
        reason = "a test that cannot go on has failed; numbers that are given"
    )]

    use super::*;

    /// A limit without any results.
    pub(crate) fn unseen() -> LimitSeen {
        let text = "format = 1\n[node]\nbody = { C = \"1 J/K\", T0 = \"0 degC\" }\n[limit]\nhot = { of = \
                    \"body.T\", below = \"1 degC\" }\n[run]\nstop = \"1 s\"\n";
        let netlist = lptn_netlist::parse("limit.toml", text).unwrap();
        let limit = netlist.network.limit_ids().next().unwrap();
        let (margin, worst_at) = (f64::INFINITY, f64::NAN);
        LimitSeen {
            limit,
            margin,
            worst_at,
            broken_at: None,
            open: 0.0,
            proven: None,
            passed: None,
        }
    }

    #[test]
    fn the_least_margin_is_when_it_was_first_there() {
        let mut seen = unseen();
        let mut after = |point: Point| {
            seen.take_in(point);
            (seen.margin, seen.worst_at, seen.broken_at)
        };
        assert_eq!(after((1.0, 3.0)), (3.0, 1.0, None));
        assert_eq!(after((2.0, 4.0)), (3.0, 1.0, None));
        assert_eq!(after((3.0, 3.0)), (3.0, 1.0, None));
        assert_eq!(after((4.0, 0.0)), (0.0, 4.0, None));
        assert_eq!(after((5.0, -1.0)), (-1.0, 5.0, Some(5.0)));
        assert_eq!(after((6.0, -2.0)), (-2.0, 6.0, Some(5.0)));
        assert_eq!(after((7.0, 1.0)), (-2.0, 6.0, Some(5.0)));
    }

    #[test]
    fn a_number_over_time_is_known_and_broken_at_the_end() {
        for (margin, broken) in [(1.0, None), (0.0, None), (-1.0, Some(9.0))] {
            let found = LimitSeen { open: 0.5, ..unseen() }.over_time((9.0, margin));
            assert_eq!((found.margin, found.worst_at, found.broken_at), (margin, 9.0, broken));
            assert!((found.open - 0.5).abs() < 1e-15);
        }
    }
}
