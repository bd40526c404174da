//! How far a one-node network is from the network it stands for.

use lptn_assembly::ThermalSystem;
use lptn_network::{NodeId, OutputTimes};
use lptn_solve::{Transient, TransientError, top};

use crate::step::StepResponse;

/// The largest difference between the temperatures of the port and of its one-node equivalent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Deviation {
    /// Its size in K.
    pub kelvin: f64,
    /// The same as a share of the rise; `None` where nothing rises.
    pub relative: Option<f64>,
    /// When it occurs, in s: after the step, or in the time of the run.
    pub time: f64,
}

impl Deviation {
    /// Whether the error is at most this.
    pub fn within(&self, kelvin: Option<f64>, relative: Option<f64>) -> bool {
        kelvin.is_none_or(|most| self.kelvin <= most)
            && relative.is_none_or(|most| self.relative.unwrap_or(0.0) <= most)
    }
}

/// For a step of 1 W at the port and all times after it. Looked for on a grid of 200 points a decade from a
/// thousandth of the shortest to 50 of the longest time constant, and at 0, then refined.
pub(crate) fn of_step(step: &StepResponse, capacity: f64) -> Deviation {
    const PER_DECADE: f64 = 200.0;
    let tau = step.resistance * capacity;
    let error = |time: f64| (step.value(time) + step.resistance * f64::exp_m1(-time / tau)).abs();
    let (least, most) = step.span();
    let from = (1e-3 * least.min(tau)).log10();
    let count = ((50.0 * most.max(tau)).log10() - from) * PER_DECADE;
    let at = |k: f64| 10_f64.powf(from + k / PER_DECADE);
    let (mut best, mut place, mut k) = (error(0.0), None, 0.0);
    while k <= count {
        if error(at(k)) > best {
            (best, place) = (error(at(k)), Some(k));
        }
        k += 1.0;
    }
    let time = place.map_or(0.0, |k| highest(&error, at(k - 1.0), at(k + 1.0)));
    let kelvin = best.max(error(time));
    Deviation { kelvin, relative: Some(kelvin / step.resistance), time }
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
#[derive(Clone, Debug)]
pub(crate) struct Record {
    pub(crate) times: Vec<f64>,
    pub(crate) temperatures: Vec<f64>,
}

impl Record {
    /// Runs `system` and keeps `node`.
    pub(crate) fn of(
        system: &ThermalSystem,
        node: NodeId,
        transient: &Transient,
    ) -> Result<Self, TransientError> {
        let solution = transient.clone().record(&[node]).solve(system)?;
        let temperatures = solution.temperature(node).unwrap_or_default();
        Ok(Self { times: solution.times().to_vec(), temperatures })
    }

    /// The largest change from the start in K.
    pub(crate) fn rise(&self) -> f64 {
        let start = self.temperatures.first().copied().unwrap_or(0.0);
        self.temperatures.iter().map(|t| (t - start).abs()).fold(0.0, f64::max)
    }

    /// The largest difference from `other` at the same times, and between them by a parabola.
    pub(crate) fn deviation(&self, other: &Self) -> Deviation {
        let pairs = self.temperatures.iter().zip(&other.temperatures).zip(&self.times);
        let points: Vec<(f64, f64)> = pairs.map(|((a, b), &time)| (time, (a - b).abs())).collect();
        let start = (0.0, self.times.first().copied().unwrap_or(0.0));
        let tops = points.windows(3).filter_map(|three| top([three[0], three[1], three[2]]));
        let all = points.iter().map(|&(time, size)| (size, time)).chain(tops);
        let (kelvin, time) = all.fold(start, |best, next| if next.0 > best.0 { next } else { best });
        let rise = self.rise();
        Deviation { kelvin, relative: (rise > 0.0).then(|| kelvin / rise), time }
    }
}

/// The run with rows where errors are looked for: its own, and between two known discontinuities 1000 at
/// equal distances and 100 a decade after the first over eight decades, since errors are largest soon after a jump.
pub(crate) fn dense(system: &ThermalSystem, run: &Transient) -> Result<Transient, TransientError> {
    let (start, stop) = (run.start, run.stop);
    let mut times = run.rows().map_err(TransientError::Settings)?;
    let mut ends = system.network().breakpoints(start, stop).map_err(TransientError::Input)?;
    ends.push(stop);
    let mut from = start;
    for to in ends {
        let length = to - from;
        times.extend((0..1000).map(|k| from + length * f64::from(k) / 1000.0));
        times.extend((1..800).map(|k| from + length * 10_f64.powf(-f64::from(k) / 100.0)));
        from = to;
    }
    times.sort_unstable_by(f64::total_cmp);
    times.dedup_by(|next, first| *next - *first <= 1e-12 * (stop - start));
    times.retain(|time| (start..=stop).contains(time));
    Ok(Transient { output: OutputTimes::At(times), watch: Vec::new(), ..run.clone() })
}
