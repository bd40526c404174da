//! Times at which results are read: limits, reports, windows and signals may bend and jump at times
//! that the heat flows ignore, and the integrator need not stop there.
//!
//! Quantities that only limits, reports, windows or columns read have breakpoints too. The recorder
//! reads inside those stretches without a restart of the integrator.

use lptn_network::{Curve, InputError, Item, Network, same_time};

use crate::cells::{Stretch, stretches};
use crate::limit::of_moments;
use crate::quantity::Quantity;
use crate::selection::Selection;
use crate::times::{Segment, segments, snap};
use crate::window::Window;

/// The times at which anything that is evaluated over a run may bend or jump, and those at which
/// evaluations between the rows have to restart.
#[derive(Clone, Debug)]
pub(crate) struct Readings {
    /// Start, breakpoints of inputs and results, stop; ascending.
    ends: Vec<f64>,
    /// Times in s at which limits may bend or jump.
    pub(crate) bends: Vec<f64>,
    /// Times at which evaluations of limits restart, in s.
    pub(crate) limits: Vec<f64>,
    /// Times at which evaluations of windows restart, in s.
    pub(crate) windows: Vec<f64>,
    /// Times at which evaluations of days restart, in s.
    pub(crate) days: Vec<f64>,
}

impl Readings {
    /// For a run whose results no one reads.
    pub(crate) fn none(segment: Segment) -> Self {
        let [bends, limits, windows, days] = <[Vec<f64>; 4]>::default();
        Self { ends: vec![segment.from, segment.to], bends, limits, windows, days }
    }

    /// For a run of these segments and rows, with these windows and the days of these columns.
    pub(crate) fn new(
        network: &Network,
        driving: &[Segment],
        rows: &[f64],
        (windows, days): (&[Window], Option<&Selection>),
    ) -> Result<Self, InputError> {
        let (start, stop) = (driving[0].from, driving[driving.len() - 1].to);
        let all = Around { network, span: (start, stop), rows, known: &[] };
        let inner: Vec<f64> = driving[1..].iter().map(|segment| segment.from).collect();
        let inner = merged(inner, all.breakpoints(&network.results())?, same_time(start, stop));
        let own = Around { known: &inner, ..all };
        let limits: Vec<Item> = of_moments(network).map(Item::Limit).collect();
        let bends = own.bends(&limits)?;
        let limits = own.looks(&limits)?;
        let windows = own.looks(&items_of(windows.iter().map(|window| &window.of)))?;
        let days = own.looks(&items_of(days.into_iter()))?;
        let ends = [start].into_iter().chain(inner).chain([stop]).collect();
        Ok(Self { ends, bends, limits, windows, days })
    }

    /// The times between start and stop at which inputs or results may bend or jump, in s.
    pub(crate) fn inner(&self) -> &[f64] {
        &self.ends[1..self.ends.len() - 1]
    }

    /// A time inside the stretch in which a result at `time` is read: the one that begins there, at
    /// the stop the last.
    pub(crate) fn inside(&self, time: f64) -> f64 {
        let after = self.ends.partition_point(|&end| end <= time).clamp(1, self.ends.len() - 1);
        0.5 * (self.ends[after - 1] + self.ends[after])
    }

    /// The same before a jump at `time`.
    pub(crate) fn inside_before(&self, time: f64) -> f64 {
        let after = self.ends.partition_point(|&end| end < time).clamp(1, self.ends.len() - 1);
        0.5 * (self.ends[after - 1] + self.ends[after])
    }
}

/// The parts of a step between some times, ascending, flagged if they begin at one of them.
pub(crate) fn pieces(ends: &[f64], (from, to): (f64, f64)) -> Vec<((f64, f64), bool)> {
    let first = ends.partition_point(|&end| end < from);
    let mut begins = ends.get(first).is_some_and(|end| end.to_bits() == from.to_bits());
    let mut pieces = Vec::new();
    let mut at = from;
    for &end in ends[first + usize::from(begins)..].iter().take_while(|&&end| end < to) {
        pieces.push(((at, end), begins));
        (at, begins) = (end, true);
    }
    pieces.push(((at, to), begins));
    pieces
}

/// Two ascending lists as one; of times that differ by rounding only that of the first.
fn merged(main: Vec<f64>, more: Vec<f64>, rounding: f64) -> Vec<f64> {
    let known =
        |time: &f64| nearest(&main, *time).is_some_and(|near| (near - time).abs() <= rounding);
    let new: Vec<f64> = more.into_iter().filter(|time| !known(time)).collect();
    let mut all = [main, new].concat();
    all.sort_by(f64::total_cmp);
    all
}

fn nearest(times: &[f64], time: f64) -> Option<f64> {
    let after = times.partition_point(|&t| t < time);
    let near = times[after.saturating_sub(1)..].iter().take(2);
    near.copied().min_by(|a, b| (a - time).abs().total_cmp(&(b - time).abs()))
}

/// Items of columns whose breakpoints the heat flows do not have.
fn items_of<'a>(columns: impl Iterator<Item = &'a Selection>) -> Vec<Item> {
    let quantities = columns.flat_map(Selection::quantities);
    let mut items: Vec<Item> = quantities
        .filter_map(|quantity| match *quantity {
            Quantity::Report(id) => Some(Item::Report(id)),
            Quantity::Signal(id) => Some(Item::Signal(id)),
            Quantity::Side(id, _) => Some(Item::Limit(id)),
            _ => None,
        })
        .collect();
    items.sort_unstable();
    items.dedup();
    items
}

/// A run in which results are evaluated.
#[derive(Clone, Copy)]
struct Around<'a> {
    network: &'a Network,
    span: (f64, f64),
    rows: &'a [f64],
    /// All breakpoints.
    known: &'a [f64],
}

impl Around<'_> {
    fn breakpoints(&self, items: &[Item]) -> Result<Vec<f64>, InputError> {
        let mut times = if items.is_empty() {
            Vec::new()
        } else {
            self.network.result_breakpoints(items, self.span)?
        };
        snap(&mut times, self.rows, self.span);
        times.dedup();
        Ok(times)
    }

    /// The breakpoints of these items, as they are among the known ones.
    fn bends(&self, items: &[Item]) -> Result<Vec<f64>, InputError> {
        let own = self.breakpoints(items)?.into_iter();
        Ok(own.filter_map(|time| nearest(self.known, time)).collect())
    }

    /// The times at which evaluations of these items have to restart: where they may bend or jump,
    /// and in between as their curves require.
    fn looks(&self, items: &[Item]) -> Result<Vec<f64>, InputError> {
        let own = self.bends(items)?;
        let curves = if items.is_empty() { Vec::new() } else { self.network.result_curves(items) };
        Ok(if curves.is_empty() {
            own
        } else {
            merged(own.clone(), self.curved(&curves, &own), 0.0)
        })
    }

    /// The steps do not depend on the rows, so that neither do the results between them.
    fn curved(&self, curves: &[Curve], breakpoints: &[f64]) -> Vec<f64> {
        let segments = segments(self.span.0, self.span.1, breakpoints);
        let stretches = stretches(self.network, curves, &segments, f64::INFINITY);
        let times = stretches.iter().flat_map(parts);
        times.filter(|time| *time > self.span.0 && *time < self.span.1).collect()
    }
}

/// The beginnings of the steps in a stretch.
pub(crate) fn parts(stretch: &Stretch) -> impl Iterator<Item = f64> + use<> {
    let Stretch { from, to, step } = *stretch;
    let count = ((to - from) / step - 1e-6).ceil().max(1.0);
    (0..)
        .map(f64::from)
        .take_while(move |k| *k < count)
        .map(move |k| from + (to - from) * (k / count))
}

#[cfg(test)]
mod tests {
    use super::{merged, pieces};

    #[test]
    fn a_step_is_cut_where_a_result_jumps() {
        let ends = [1.0, 2.0, 3.0];
        assert_eq!(pieces(&ends, (0.0, 0.5)), [((0.0, 0.5), false)]);
        assert_eq!(pieces(&ends, (0.5, 2.0)), [((0.5, 1.0), false), ((1.0, 2.0), true)]);
        assert_eq!(pieces(&ends, (2.0, 2.5)), [((2.0, 2.5), true)]);
        assert_eq!(pieces(&[], (2.0, 2.5)), [((2.0, 2.5), false)]);
    }

    #[test]
    fn times_that_differ_by_rounding_are_one() {
        assert_eq!(merged(vec![1.0, 3.0], vec![1.0 + 1e-14, 2.0], 1e-12), [1.0, 2.0, 3.0]);
    }
}
