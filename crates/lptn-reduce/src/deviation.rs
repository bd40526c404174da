//! Errors of a one-node network against the network that it represents.

use lptn_analysis::{RunAnalysis, RunError};
use lptn_assembly::ThermalSystem;
use lptn_network::NodeId;
use lptn_solve::{Proceed, RecordedNodes, TransientError, top};

use crate::allowed::Allowed;
use crate::step::StepResponse;

/// The largest difference between the temperatures of the port and of its one-node equivalent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Deviation {
    /// Its size in K.
    pub kelvin: f64,
    /// The same as a share of the rise; `None` if nothing rises.
    pub relative: Option<f64>,
    /// Time of the error in s: after the step, or in the time of the run.
    pub time: f64,
    /// The one node less the network at that time in K: negative if the one node is too cold.
    pub signed: f64,
    /// Time after which the error stays within the limit, in s as `time`; `None` if it is above the
    /// limit at the end of the run.
    pub good_from: Option<f64>,
}

impl Deviation {
    /// True if the error is at most this; if nothing rises, no share of it is too large.
    pub fn within(&self, allowed: Allowed) -> bool {
        match allowed {
            Allowed::Kelvin(most) => self.kelvin <= most,
            Allowed::Share(most) => self.relative.unwrap_or(0.0) <= most,
        }
    }
}

/// For a step of 1 W at the port and all times after it. The error is sampled at 0 and at 200
/// points a decade, from a thousandth of the shortest to 50 of the longest time constant, then
/// refined. `share` of the rise is allowed.
pub(crate) fn of_step(step: &StepResponse, capacity: f64, share: f64) -> Deviation {
    let tau = step.resistance * capacity;
    // without capacity all of the rise comes at once
    let model = |time: f64| {
        if tau > 0.0 { -step.resistance * f64::exp_m1(-time / tau) } else { step.resistance }
    };
    of_curve(step, &model, (tau > 0.0).then_some((tau, tau)), share)
}

/// The same for any model's curve, with its shortest and longest time constant in s.
pub(crate) fn of_curve(
    step: &StepResponse,
    model: &dyn Fn(f64) -> f64,
    span: Option<(f64, f64)>,
    share: f64,
) -> Deviation {
    const PER_DECADE: f64 = 200.0;
    let signed = |time: f64| model(time) - step.value(time);
    let error = |time: f64| signed(time).abs();
    let mut whole = step.span();
    if let Some((least, most)) = span {
        whole = (whole.0.min(least), whole.1.max(most));
    }
    let from = (1e-3 * whole.0).log10();
    let count = ((50.0 * whole.1).log10() - from) * PER_DECADE;
    let at = |k: f64| 10_f64.powf(from + k / PER_DECADE);
    let (mut best, mut place, mut k) = (error(0.0), None, 0.0);
    let allowed = share * step.resistance;
    let mut bad = (best > allowed).then_some(0.0);
    while k <= count {
        let here = error(at(k));
        if here > best {
            (best, place) = (here, Some(k));
        }
        if here > allowed {
            bad = Some(at(k));
        }
        k += 1.0;
    }
    let time = place.map_or(0.0, |k| highest(&error, at(k - 1.0), at(k + 1.0)));
    let kelvin = best.max(error(time));
    let good_from = bad.map_or(0.0, |bad| {
        last(&|t| error(t) > allowed, bad, bad.max(at(0.0)) * at(1.0) / at(0.0))
    });
    Deviation {
        kelvin,
        relative: Some(kelvin / step.resistance),
        time,
        signed: kelvin.copysign(signed(time)),
        good_from: Some(good_from),
    }
}

/// The time at which `is`, true at `a` and not at `b`, becomes false.
fn last(is: &dyn Fn(f64) -> bool, mut a: f64, mut b: f64) -> f64 {
    for _ in 0..60 {
        let middle = 0.5 * (a + b);
        if is(middle) { a = middle } else { b = middle }
    }
    b
}

/// The maximum of a function with one top between `a` and `b`, by golden section.
fn highest(f: &dyn Fn(f64) -> f64, mut a: f64, mut b: f64) -> f64 {
    let ratio = 0.5 * (5_f64.sqrt() - 1.0);
    for _ in 0..60 {
        let (left, right) = (b - ratio * (b - a), a + ratio * (b - a));
        if f(left) > f(right) { b = right } else { a = left }
    }
    0.5 * (a + b)
}

/// Temperatures of one node at the times of a comparison.
#[derive(Clone, Debug, Default)]
pub(crate) struct Record {
    times: Vec<f64>,
    temperatures: Vec<f64>,
    breaks: Vec<f64>,
}

impl Record {
    /// Runs `system` and keeps `node`.
    pub(crate) fn of(system: &ThermalSystem, node: NodeId, run: &Dense) -> Result<Self, RunError> {
        Ok(Self::all(system, &[node], run)?.pop().unwrap_or_default())
    }

    /// Runs `system` and keeps these nodes, each in a separate record.
    pub(crate) fn all(
        system: &ThermalSystem,
        nodes: &[NodeId],
        run: &Dense,
    ) -> Result<Vec<Self>, RunError> {
        let asked = run.run.clone().keeping(RecordedNodes::Nodes(nodes.to_vec()));
        let solution = asked.solve(system, &mut |_| Proceed::Continue)?;
        let record = |&node: &NodeId| Self {
            times: solution.times().to_vec(),
            temperatures: solution.temperature(node).unwrap_or_default(),
            breaks: run.breaks.clone(),
        };
        Ok(nodes.iter().map(record).collect())
    }

    /// The largest change from the start in K.
    pub(crate) fn rise(&self) -> f64 {
        let start = self.temperatures.first().copied().unwrap_or(0.0);
        self.largest(self.temperatures.iter().map(|t| (t - start).abs())).0
    }

    /// The largest difference of `other` from this at the same times and between them.
    pub(crate) fn deviation(&self, other: &Self, allowed: Allowed) -> Deviation {
        let pairs = self.temperatures.iter().zip(&other.temperatures);
        let signed: Vec<f64> = pairs.map(|(whole, one)| one - whole).collect();
        let (kelvin, time) = self.largest(signed.iter().map(|d| d.abs()));
        let rise = self.rise();
        let row = self.times.partition_point(|&t| t <= time).saturating_sub(1);
        // a maximum between two rows has the sign of the larger of them
        let [a, b] = [row, row + 1].map(|k| signed.get(k).copied().unwrap_or(0.0));
        let sign = if a.abs() >= b.abs() { a } else { b };
        let most = allowed.of(rise);
        let bad = signed.iter().rposition(|d| d.abs() > most);
        let good_from = bad.map_or(self.times.first(), |bad| self.times.get(bad + 1)).copied();
        Deviation {
            kelvin,
            relative: (rise > 0.0).then(|| kelvin / rise),
            time,
            signed: kelvin.copysign(sign),
            good_from,
        }
    }

    /// The temperature at the start in K.
    pub(crate) fn first(&self) -> Option<f64> {
        self.temperatures.first().copied()
    }

    /// The largest of these sizes, one a row, and its time; between rows by a parabola through
    /// three of them.
    fn largest(&self, sizes: impl Iterator<Item = f64>) -> (f64, f64) {
        let points: Vec<(f64, f64)> = self.times.iter().copied().zip(sizes).collect();
        let start = (0.0, self.times.first().copied().unwrap_or(0.0));
        let smooth = points.windows(3).filter(|p| self.is_smooth([p[0].0, p[1].0, p[2].0]));
        let tops = smooth.filter_map(|p| top([p[0], p[1], p[2]]));
        let all = points.iter().map(|&(time, size)| (size, time)).chain(tops);
        all.fold(start, |best, next| if next.0 > best.0 { next } else { best })
    }

    /// True if a parabola may go through rows at these times. A jump or kink between them rules it
    /// out, and so do very unequal distances, which turn noise into slope.
    fn is_smooth(&self, [a, b, c]: [f64; 3]) -> bool {
        const MOST_UNEVEN: f64 = 10.0;
        let passed = |time: f64| self.breaks.partition_point(|&at| at <= time);
        let even = b - a <= MOST_UNEVEN * (c - b) && c - b <= MOST_UNEVEN * (b - a);
        even && passed(a) == passed(c)
    }
}

/// A run with rows for the search of errors, and its known discontinuities.
#[derive(Clone, Debug)]
pub(crate) struct Dense {
    run: RunAnalysis,
    breaks: Vec<f64>,
}

impl Dense {
    /// The rows of `run`, and between two known discontinuities 1000 at equal distances, 100 a
    /// decade after the first over eight decades, since errors are largest soon after a jump, and
    /// one just before the second, when a massless port is about to leap.
    pub(crate) fn new(
        system: &ThermalSystem,
        run: &RunAnalysis,
        tolerance: f64,
    ) -> Result<Self, RunError> {
        let (start, stop) = (run.start(), run.stop());
        let mut times = run.rows()?;
        let breaks = system.network().breakpoints(start, stop);
        let breaks = breaks.map_err(|error| Box::new(TransientError::Input(error)))?;
        let mut from = start;
        for &to in breaks.iter().chain([&stop]) {
            let length = to - from;
            times.extend((0..1000).map(|k| from + length * f64::from(k) / 1000.0));
            times.extend((1..800).map(|k| from + length * 10_f64.powf(-f64::from(k) / 100.0)));
            times.push(to - 1e-9 * length);
            from = to;
        }
        times.sort_unstable_by(f64::total_cmp);
        let near = |next: f64, first: f64| {
            next - first <= 1e-12 * (stop - start) && !breaks.contains(&next)
        };
        times.dedup_by(|next, first| *next <= *first || near(*next, *first));
        times.retain(|time| (start..=stop).contains(time));
        Ok(Self { run: run.clone().bare().at(times).within(tolerance), breaks })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::step::ResponseTerm;

    /// `exp(-t) - exp(-q t)` is largest at `t = ln q / (q - 1)`, and is
    /// `q^(-1/(q-1)) - q^(-q/(q-1))` there.
    #[test]
    fn the_error_of_one_exponential_for_another() {
        let term = ResponseTerm { tau: 1.0, resistance: 2.0, error: 0.0 };
        let step = StepResponse { resistance: 2.0, direct: 0.0, terms: vec![term], residual: 0.0 };
        for q in [1e-6_f64, 0.3, 3.0, 500.0, 1e6] {
            let found = of_step(&step, 1.0 / (2.0 * q), 0.05);
            let size = (q.powf(-1.0 / (q - 1.0)) - q.powf(-q / (q - 1.0))).abs();
            assert!((found.relative.unwrap() / size - 1.0).abs() < 1e-9, "{q}: {found:?} {size}");
            assert!((found.kelvin - 2.0 * found.relative.unwrap()).abs() < 1e-15);
            let time = q.ln() / (q - 1.0);
            assert!((found.time / time - 1.0).abs() < 1e-4, "{q}: {found:?} {time}");
            // one node of a larger capacity (q < 1) reads too cold
            assert_eq!(found.signed < 0.0, q < 1.0, "{found:?}");
            let error = |t: f64| ((-t).exp() - (-q * t).exp()).abs();
            let from = found.good_from.unwrap();
            assert!((error(from) - 0.05).abs() < 1e-9 && from > time, "{q}: {found:?}");
            assert!(error(1.01 * from) < 0.05, "{found:?}");
        }
    }

    #[test]
    fn without_capacity_the_error_is_all_that_is_still_to_come() {
        let term = ResponseTerm { tau: 7.0, resistance: 0.5, error: 0.0 };
        let step = StepResponse { resistance: 2.0, direct: 1.5, terms: vec![term], residual: 0.0 };
        let found = of_step(&step, 0.0, 0.05);
        assert_eq!((found.kelvin, found.relative, found.time), (0.5, Some(0.25), 0.0));
        // too warm, until 0.5 exp(-t/7) is 0.1
        assert!(found.signed > 0.0, "{found:?}");
        assert!((found.good_from.unwrap() - 7.0 * 5_f64.ln()).abs() < 1e-9, "{found:?}");
    }

    #[test]
    fn a_deviation_is_held_against_both_bounds() {
        let found = Deviation {
            kelvin: 2.0,
            relative: Some(0.1),
            time: 0.0,
            signed: -2.0,
            good_from: None,
        };
        assert!(found.within(Allowed::Kelvin(2.0)) && found.within(Allowed::Share(0.1)));
        assert!(!found.within(Allowed::Kelvin(1.9)) && !found.within(Allowed::Share(0.09)));
        // if nothing rises, no share of it is too large
        assert!(Deviation { relative: None, ..found }.within(Allowed::Share(0.0)));
    }

    /// The deviation of a parabola with its maximum, 4, at 1.3.
    fn parabola(times: &[f64], breaks: &[f64]) -> Deviation {
        let of =
            |temperatures| Record { times: times.to_vec(), temperatures, breaks: breaks.to_vec() };
        let other = of(vec![0.0; times.len()]);
        of(times.iter().map(|t| 4.0 - (t - 1.3) * (t - 1.3)).collect())
            .deviation(&other, Allowed::default())
    }

    #[test]
    fn a_record_is_good_from_the_row_after_the_last_bad_one() {
        let of = |temperatures: [f64; 5]| Record {
            times: vec![0.0, 1.0, 2.0, 3.0, 4.0],
            temperatures: temperatures.to_vec(),
            breaks: Vec::new(),
        };
        let whole = of([0.0, 6.0, 8.0, 9.0, 10.0]);
        let found = whole.deviation(&of([0.0, 5.0, 8.1, 8.4, 10.1]), Allowed::default());
        assert!(found.signed <= -1.0 && found.good_from == Some(4.0), "{found:?}");
        let found = whole.deviation(&of([0.0, 6.2, 8.1, 9.4, 11.0]), Allowed::default());
        assert!(found.signed >= 1.0 && found.good_from.is_none(), "{found:?}");
        assert_eq!(whole.deviation(&whole, Allowed::default()).good_from, Some(0.0));
    }

    #[test]
    fn between_rows_the_error_is_that_of_a_parabola() {
        let found = parabola(&[0.0, 1.0, 2.0], &[]);
        assert!(
            (found.kelvin - 4.0).abs() < 1e-14 && (found.time - 1.3).abs() < 1e-14,
            "{found:?}"
        );
        // from 2.31 to 3.91 at the rows, 4 between them: the rise is also that of the maximum
        assert!((found.relative.unwrap() - 4.0 / 1.69).abs() < 1e-14, "{found:?}");
    }

    #[test]
    fn no_parabola_goes_over_a_break() {
        let is_row = |breaks: &[f64]| (parabola(&[0.0, 1.0, 2.0], breaks).time - 1.0).abs() < 1e-15;
        assert!(is_row(&[0.5]) && is_row(&[1.0]) && is_row(&[1.5]) && is_row(&[-3.0, 1.5, 9.0]));
        // the row at a break belongs to the time after it
        assert!(is_row(&[2.0]) && !is_row(&[0.0]) && !is_row(&[-3.0, 9.0]));
    }

    #[test]
    fn no_parabola_goes_through_rows_of_very_different_distance() {
        let is_row = |times: &[f64]| times.contains(&parabola(times, &[]).time);
        assert!(is_row(&[0.0, 1.25, 1.35]) && is_row(&[1.25, 1.32, 2.5]));
        assert!(!is_row(&[0.3, 1.3125, 1.4375]) && !is_row(&[1.1875, 1.3125, 2.5]));
        // ten times as far still counts, in binary fractions
        assert!(!is_row(&[0.0, 1.25, 1.375]) && !is_row(&[1.25, 1.375, 2.625]));
    }
}
