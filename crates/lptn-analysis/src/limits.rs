//! Results for limits.

use lptn_network::{InputError, LimitId, Network};
use lptn_solve::{LimitSeen, Periodic, ProvenMargin, SteadyState};

/// The result for a limit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LimitResult {
    /// The limit.
    pub limit: LimitId,
    /// Its least margin in SI units, positive while it is kept. NaN if it was not judged: in a
    /// steady state it depends on inputs that change with time, or it is of gears that carry no
    /// load.
    pub margin: f64,
    /// Time of that margin in s; `None` in steady state and if it was not judged.
    pub worst_at: Option<f64>,
    /// Time at which it was first broken, in s; `None` if it was not, and in steady state.
    pub broken_at: Option<f64>,
    /// Error of the margin in SI units in addition to the error of temperatures.
    pub open: f64,
    /// Proven bounds on the margin, if they were asked for and found.
    pub proven: Option<ProvenMargin>,
}

impl LimitResult {
    /// The result in a run or cycle.
    pub fn of_run(seen: &LimitSeen) -> Self {
        let LimitSeen { limit, margin, worst_at, broken_at, open, proven, .. } = *seen;
        let judged = !margin.is_nan();
        Self { limit, margin, worst_at: judged.then_some(worst_at), broken_at, open, proven }
    }

    /// All limits over a periodic steady state, which has no first time.
    pub fn of_cycle(found: &Periodic) -> Vec<Self> {
        let one = |seen| Self { broken_at: None, ..Self::of_run(seen) };
        found.solution.limits().iter().map(one).collect()
    }

    /// All limits of a network in steady state.
    ///
    /// # Errors
    /// [`InputError`] if a limit has no value.
    pub fn of_steady(network: &Network, steady: &SteadyState) -> Result<Vec<Self>, InputError> {
        let margins = steady.limit_margins(network, steady.time)?;
        let one = |(limit, margin): (LimitId, f64)| {
            let own = &network.limits()[limit.index()];
            let constant = network.changing_inputs_of(&[&own.of, &own.value]).is_empty();
            let margin = if constant { margin } else { f64::NAN };
            Self { limit, margin, worst_at: None, broken_at: None, open: 0.0, proven: None }
        };
        Ok(network.limit_ids().zip(margins).map(one).collect())
    }

    /// The same with proven margins, one for each.
    #[must_use]
    pub fn with_proofs(results: Vec<Self>, proven: Vec<Option<ProvenMargin>>) -> Vec<Self> {
        results.into_iter().zip(proven).map(|(result, proven)| Self { proven, ..result }).collect()
    }

    /// True if it is neither kept nor broken, because it was not judged.
    pub fn is_open(&self) -> bool {
        self.margin.is_nan()
    }

    /// A proven bound on the error of the margin in SI units; `None` if there is none.
    pub fn margin_bound(&self) -> Option<f64> {
        let proven = self.proven?;
        (!self.is_open()).then(|| proven.bound(self.margin))
    }

    /// A proven bound in s on the error of the time at which it was first broken; `None` if there
    /// is none.
    pub fn time_bound(&self) -> Option<f64> {
        let ([first, last], at) = (self.proven?.broken, self.broken_at?);
        Some((last - at).max(at - first)).filter(|bound| bound.is_finite())
    }

    /// True if the verdict is proven, false if the bounds do not decide; `None` without bounds, and
    /// if it was not judged.
    pub fn is_proven(&self) -> Option<bool> {
        let kept = self.proven.filter(|_| !self.is_open())?.kept();
        Some(kept == Some(!self.is_broken()))
    }

    /// True if it is broken.
    pub fn is_broken(&self) -> bool {
        self.margin < 0.0
    }
}
