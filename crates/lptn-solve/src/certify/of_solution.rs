//! The bounds of a solution.

use lptn_network::{
    BoundaryId, Evaluation, Functional, HeatOf, History, LimitId, Network, NodeId, OverTime,
    ReportId, SourceId,
};

use super::results::{Followed, ResultBounds, reaches};
use super::{Certificate, ROUNDING, Uncertified};
use crate::limit::with_limits;
use crate::limit_seen::{LimitSeen, ProvenMargin};
use crate::quantity::Quantity;
use crate::selection::Selection;
use crate::solution::Solution;

impl Solution {
    /// Proven bounds on the errors of the temperatures; `None` unless they were asked for
    /// ([`Transient::certify`]).
    ///
    /// [`Transient::certify`]: crate::Transient::certify
    pub fn certificate(&self) -> Option<&Result<Certificate, Uncertified>> {
        self.certificate.as_ref()
    }

    /// Proven bounds on the error of a node in the rows in K; `None` if there are none.
    pub fn bounds(&self, node: NodeId) -> Option<Vec<f64>> {
        let column = self.recorded.binary_search(&node).ok()?;
        let certificate = self.certificate.as_ref()?.as_ref().ok()?;
        let bounds = certificate.rows.iter().skip(column).step_by(self.recorded.len());
        // a recovered temperature is rounded too
        let rounded = |(bound, value): (&f64, f64)| bound + ROUNDING * value;
        // a run that broke off may have rows without one
        let bounds = bounds.chain(std::iter::repeat(&f64::NAN));
        Some(bounds.zip(self.temperature(node)?).map(rounded).collect())
    }

    /// A proven bound on the error of a node at every time of the run in K; `None` if there is
    /// none.
    pub fn largest_bound(&self, node: NodeId) -> Option<f64> {
        let column = self.recorded.binary_search(&node).ok()?;
        let most = *self.certificate.as_ref()?.as_ref().ok()?.most.get(column)?;
        let hottest = self.temperature(node)?.into_iter().fold(0.0, f64::max);
        Some(most + ROUNDING * hottest)
    }

    /// For each switch of a control, in their order, the times in s between which the exact solution
    /// switches; `None` if they are not proven. A control that switches at the start is not among
    /// them.
    pub fn proven_switches(&self) -> Option<&[[f64; 2]]> {
        Some(&self.certificate.as_ref()?.as_ref().ok()?.switches)
    }

    fn result_bounds(&self) -> Option<&ResultBounds> {
        Some(&self.certificate.as_ref()?.as_ref().ok()?.results)
    }

    /// The ranges in SI units in which a column lies in the rows with proof; NaN in a row without
    /// one. Temperatures of nodes have [`Solution::bounds`].
    pub(crate) fn proven_ranges(&self, quantity: Quantity) -> Option<Vec<[f64; 2]>> {
        let ranges = self.result_bounds()?.ranges(quantity)?;
        let all = ranges.chain(std::iter::repeat([f64::NAN; 2]));
        Some(all.take(self.times.len()).collect())
    }

    /// The names of the columns that errors of temperatures reach and that have no bound.
    pub fn without_bounds(&self, selection: &Selection) -> Vec<String> {
        let network = self.network();
        let lacks = |quantity: &&Quantity| {
            let known = |ranges: Vec<[f64; 2]>| ranges.iter().all(|[low, _]| !low.is_nan());
            reaches(**quantity) && !self.proven_ranges(**quantity).is_some_and(known)
        };
        selection.quantities().iter().filter(lacks).map(|of| of.name(network)).collect()
    }

    /// A proven bound in K on the error of a temperature as the largest one of a node over the run;
    /// `None` if there is none.
    pub fn peak_bound(&self, node: NodeId, peak: f64) -> Option<f64> {
        let seen = self.result_bounds()?.of(Followed::Quantity(Quantity::Node(node)))?;
        Some(farthest(peak, seen.max))
    }

    /// A proven bound in K on the errors of the smallest and the largest temperature of a node over
    /// the run; `None` if there is none.
    pub fn extreme_bound(&self, node: NodeId, [least, most]: [f64; 2]) -> Option<f64> {
        let seen = self.result_bounds()?.of(Followed::Quantity(Quantity::Node(node)))?;
        Some(farthest(least, seen.min).max(farthest(most, seen.max)))
    }

    /// A proven bound in J on the error of the heat of a source over the run; `None` if there is
    /// none.
    pub fn source_bound(&self, id: SourceId) -> Option<f64> {
        self.energy_bound(HeatOf::Source(id), self.ledger.sources[id.index()])
    }

    /// The same of a boundary.
    pub fn boundary_bound(&self, id: BoundaryId) -> Option<f64> {
        self.energy_bound(HeatOf::Boundary(id), self.ledger.boundaries[id.index()])
    }

    fn energy_bound(&self, heat: HeatOf, energy: f64) -> Option<f64> {
        let seen = self.result_bounds()?.of(Followed::Quantity(Quantity::Heat(heat)))?;
        Some(farthest(energy, seen.integral))
    }

    /// Writes the bounds of limits and of numbers over time to their results.
    pub(crate) fn with_proofs(mut self) -> Self {
        let Some(Ok(certificate)) = &self.certificate else { return self };
        let network = self.system.network();
        let mut scope = network.evaluation();
        for seen in &mut self.limits {
            let limit = &network.limits()[seen.limit.index()];
            seen.proven = match limit.is_of_moments() {
                true => certificate
                    .results
                    .of(Followed::Margin(seen.limit))
                    .map(|margin| ProvenMargin { margin: margin.min, broken: margin.falls }),
                false => margin_over_time(network, &certificate.results, seen.limit, &mut scope),
            };
        }
        let passed =
            self.limits.iter_mut().filter_map(LimitSeen::proven_broken).collect::<Vec<_>>();
        self.events = with_limits(self.events, &passed);
        for seen in &mut self.reports {
            let range = report_over_time(network, &certificate.results, seen.report, &mut scope);
            seen.bound = range.map(|range| farthest(seen.value, range));
        }
        self
    }
}

impl LimitSeen {
    /// Takes back that a margin was set to zero, if the limit is broken for sure.
    fn proven_broken(&mut self) -> Option<Self> {
        let kept = self.proven?.kept();
        let (margin, broken_at) = self.passed.take_if(|_| kept == Some(false))?;
        (self.margin, self.broken_at) = (margin, broken_at);
        Some(*self)
    }
}

/// The larger distance of a printed value from the ends of a range, with its rounding.
pub(crate) fn farthest(value: f64, [low, high]: [f64; 2]) -> f64 {
    (high - value).max(value - low) + ROUNDING * value.abs()
}

/// The smallest range of several numbers.
fn around(numbers: &[f64]) -> Option<[f64; 2]> {
    let low = numbers.iter().copied().fold(f64::INFINITY, f64::min);
    let high = numbers.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    numbers.iter().all(|x| x.is_finite()).then_some([low, high])
}

/// Every functional rises or falls with every statistic, so its ends are those of the statistics; a
/// life does so if the mean has one sign.
fn report_over_time(
    network: &Network,
    results: &ResultBounds,
    id: ReportId,
    scope: &mut Evaluation,
) -> Option<[f64; 2]> {
    let [low, high] = results.histories(Quantity::Report(id))?;
    let lives = network.reports()[id.index()].over_time.iter();
    one_sign(lives.map(|of| (of, &low)))?;
    let mut of = |history| network.report_over_time(id, history, scope).ok();
    around(&[of(&low)?, of(&high)?])
}

/// `None` if a life is that of a mean which may be zero or less.
fn one_sign<'a>(mut all: impl Iterator<Item = (&'a OverTime, &'a History)>) -> Option<()> {
    all.all(|(of, low)| of.functional != Functional::Life || low.mean > 0.0).then_some(())
}

fn margin_over_time(
    network: &Network,
    results: &ResultBounds,
    id: LimitId,
    scope: &mut Evaluation,
) -> Option<ProvenMargin> {
    let sides = [0, 1].map(|side| results.histories(Quantity::Side(id, side)));
    let ([of, value], end) = ([sides[0]?, sides[1]?], results.end()?);
    let both = network.limits()[id.index()].over_time.iter().zip([&of[0], &value[0]]);
    one_sign(both.filter_map(|(over_time, low)| Some((over_time.as_ref()?, low))))?;
    let mut margins = Vec::with_capacity(4);
    for of in of {
        for value in value {
            let [low, high] = network.limit_over_time(id, &[of, value], scope).ok()?;
            margins.push(high - low);
        }
    }
    let margin = around(&margins)?;
    let broken = margin.map(|margin| if margin < 0.0 { end } else { f64::INFINITY });
    Some(ProvenMargin { margin, broken })
}
