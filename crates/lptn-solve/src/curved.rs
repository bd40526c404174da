//! The longest step for inputs that curve.
//!
//! The integrator sees an input only at the ends of its steps. A pulse between two of them would be
//! missed without a trace, and the energy balance would close all the same. So the inputs are
//! sampled before the run, and no step is longer than they need at that time.
//!
//! CVODE's steps grow over a quiet stretch. A pulse after it was missed and the energy balance
//! closed, because the balance sees no more than the steps do. Every part of an expression that
//! reads only the time is inspected separately before the run (`cells.rs`).
//!
//! The longest step is local. A stop time enforces it only if CVODES' next step is longer; a stop
//! time in every step would shorten the following step. The share of the tolerance falls if the
//! network remembers many such steps.

use lptn_assembly::{JacobianForm, ThermalSystem};

use crate::cells::{Stretch, stretches};
use crate::times::Segment;

/// Limits that curved inputs set to the integrator.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Curved {
    /// The longest step everywhere.
    stretches: Vec<Stretch>,
    /// The share of the tolerance that the integrator gets.
    pub(crate) share: f64,
    /// Number of those steps that the network remembers.
    pub(crate) remembered: f64,
}

/// Steps within the network's memory over which errors still add up to a few tolerances.
const REMEMBERED: f64 = 10.0;

/// Steps within the memory beyond which the error has no bound. With up to 1000 it stays within ten
/// tolerances; with 8000 it was once 67 of them, however small the share.
pub(crate) const MOST_REMEMBERED: f64 = 1000.0;

/// The smallest share of the tolerance.
const LEAST_SHARE: f64 = 1e-3;

impl Curved {
    /// `None` if no input is curved.
    ///
    /// A pulse shorter than a part of the first steps can still be missed: write it with
    /// `if(t < …)`, which is met exactly.
    ///
    /// The share falls with the number of steps that the network remembers: curved inputs excite it
    /// in every one of them, and the errors of the steps add up over its memory
    /// (`tests/tolerance.rs` measures it).
    pub(crate) fn of(system: &ThermalSystem, segments: &[Segment], rows: &[f64]) -> Option<Self> {
        let network = system.network();
        let curves = network.curves();
        if curves.is_empty() {
            return None;
        }
        let stretches = stretches(network, &curves, segments, longest_gap(rows));
        let remembered = most_steps(&stretches, memory(system, segments[0].inside()));
        let share = (1.0 + remembered / REMEMBERED).recip().max(LEAST_SHARE);
        Some(Self { stretches, share, remembered })
    }

    /// The longest step from `time` on, in s: a step that leads into a stretch of shorter steps
    /// ends soon after its beginning.
    pub(crate) fn longest(&self, time: f64) -> f64 {
        let here = self.stretches.partition_point(|s| s.to <= time).min(self.stretches.len() - 1);
        let mut longest = self.stretches[here].step;
        for next in &self.stretches[here + 1..] {
            let way = next.from - time;
            if way >= longest {
                break;
            }
            longest = longest.min(way + next.step);
        }
        longest
    }
}

/// The longest distance of two rows in s.
pub(crate) fn longest_gap(rows: &[f64]) -> f64 {
    rows.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max)
}

/// The most steps of the longest size within `memory` in s.
fn most_steps(stretches: &[Stretch], memory: f64) -> f64 {
    let mut ends = vec![(stretches[0].from, 0.0)];
    for s in stretches {
        let (_, before) = ends[ends.len() - 1];
        ends.push((s.to, before + (s.to - s.from) / s.step));
    }
    let (start, (stop, all)) = (stretches[0].from, ends[ends.len() - 1]);
    if memory >= stop - start {
        return all;
    }
    let up_to = |time: f64| {
        let i = ends.partition_point(|end| end.0 < time).clamp(1, ends.len() - 1);
        let ((a, before), (b, after)) = (ends[i - 1], ends[i]);
        before + (after - before) * ((time - a) / (b - a))
    };
    let windows = ends.iter().flat_map(|&(end, _)| [end, end - memory]);
    let inside = windows.map(|from| from.clamp(start, stop - memory));
    inside.map(|from| up_to(from + memory) - up_to(from)).fold(0.0, f64::max)
}

/// The memory of a network, in s: all capacity over all conductance that leads out. The slowest
/// time constant is not shorter, for it is the inverse of the least Rayleigh quotient, and this is
/// the quotient of a uniform rise.
fn memory(system: &ThermalSystem, time: f64) -> f64 {
    let mut values = vec![0.0; system.pattern().entries()];
    let mut work = system.workspace();
    let mut start = system.initial();
    let mean = start.iter().sum::<f64>() / start.len() as f64;
    start.resize(system.unknowns().len(), mean);
    let known = system.read_inputs(&mut work, time, time).is_ok()
        && system.jacobian_at(&mut work, &start, JacobianForm::Exact, &mut values).is_ok();
    if !known {
        return f64::INFINITY;
    }
    // heat in W out of all nodes together for a rise of all by 1 K
    let out = -values.iter().sum::<f64>();
    if out > 0.0 { system.capacity().iter().sum::<f64>() / out } else { f64::INFINITY }
}

#[cfg(test)]
mod tests {
    use super::{Curved, Stretch, most_steps};

    fn stretches() -> Vec<Stretch> {
        let all = [(0.0, 10.0, 5.0), (10.0, 12.0, 0.5), (12.0, 20.0, 5.0)];
        all.map(|(from, to, step)| Stretch { from, to, step }).to_vec()
    }

    #[test]
    fn steps_shrink_before_a_stretch_of_short_ones() {
        let curved = Curved { stretches: stretches(), share: 1.0, remembered: 0.0 };
        let expected = [
            (0.0, 5.0),
            (7.0, 3.5),
            (9.75, 0.75),
            (10.0, 0.5),
            (11.9, 0.5),
            (12.0, 5.0),
            (20.0, 5.0),
        ];
        for (time, longest) in expected {
            assert!(
                (curved.longest(time) - longest).abs() < 1e-12,
                "{} at {time}",
                curved.longest(time)
            );
        }
    }

    #[test]
    fn the_most_steps_within_a_time_are_counted_where_they_are_short() {
        let most = |memory: f64| most_steps(&stretches(), memory);
        assert!((most(1.0) - 2.0).abs() < 1e-12 && (most(4.0) - 4.4).abs() < 1e-12);
        assert!((most(1e9) - 7.6).abs() < 1e-12);
    }
}
