//! How long a step may be where inputs curve.
//!
//! The integrator sees an input only at the ends of its steps: a pulse between two of them would be missed without
//! a trace, and the books would close all the same. So the inputs are looked at before the run, and no step is
//! longer than what resolves them.

use lptn_assembly::{Form, ThermalSystem};
use lptn_network::{Evaluation, Value};

use crate::times::Segment;

/// Steps of the whole run to begin with.
const COARSE: f64 = 300.0;

/// How often the step is halved at most.
const HALVINGS: usize = 7;

/// Parts of a step that the inputs are looked at in.
const PARTS: u32 = 16;

/// The share of its variation by which an input may differ from the chords of the steps: a sine has then at least
/// seven steps in a period.
const MISSED: f64 = 0.1;

/// What curved inputs ask of the integrator.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Curved {
    /// The longest step in s.
    pub(crate) step: f64,
    /// The share of the tolerance that the integrator gets.
    pub(crate) share: f64,
    /// How many of the steps the network remembers.
    pub(crate) remembered: f64,
}

/// Steps within the network's memory over which errors still add up to a few tolerances.
const REMEMBERED: f64 = 10.0;

/// Steps within the memory beyond which nothing is promised of the error: with up to 1000 it stays within ten tolerances,
/// with 8000 it was once found to be 67 of them, however small the share.
pub(crate) const MOST_REMEMBERED: f64 = 1000.0;

/// The smallest share of the tolerance.
const LEAST_SHARE: f64 = 1e-3;

impl Curved {
    /// `None` if no input is curved.
    ///
    /// The step is at most a three-hundredth of the run and the longest distance of rows, and is halved until every
    /// curved input, looked at in sixteen parts of each step, stays near the chords of the steps. A pulse shorter than a part of the first step can still be missed: write it with `if(t < ..)`, which is
    /// met exactly.
    ///
    /// The share falls with the number of such steps that the network remembers: curved inputs excite it in every
    /// one of them, and the errors of the steps add up over its memory (`tests/tolerance.rs` measures it).
    pub(crate) fn of(system: &ThermalSystem, segments: &[Segment], rows: &[f64]) -> Option<Self> {
        let network = system.network();
        let inputs: Vec<&Value> = network.curved_inputs().collect();
        if inputs.is_empty() {
            return None;
        }
        let span = segments[segments.len() - 1].to - segments[0].from;
        let gap = rows.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max);
        let mut step = (span / COARSE).min(gap);
        let mut scope = network.evaluation();
        for _ in 0..HALVINGS {
            if inputs.iter().all(|input| segments.iter().all(|s| resolves(input, *s, step, &mut scope))) {
                break;
            }
            step *= 0.5;
        }
        let remembered = memory(system, segments[0].inside()).min(span) / step;
        let share = (1.0 + remembered / REMEMBERED).recip().max(LEAST_SHARE);
        Some(Self { step, share, remembered })
    }
}

/// How long a network remembers, in s: all capacity over all conductance that leads out. The slowest time constant
/// is not shorter, for it is the inverse of the least Rayleigh quotient, and this is the quotient of a uniform rise.
fn memory(system: &ThermalSystem, time: f64) -> f64 {
    let mut values = vec![0.0; system.pattern().entries()];
    let mut work = system.workspace();
    let mut start = system.initial();
    let mean = start.iter().sum::<f64>() / start.len() as f64;
    start.resize(system.unknowns().len(), mean);
    let known = system.read_inputs(&mut work, time, time).is_ok()
        && system.jacobian_at(&mut work, &start, Form::Exact, &mut values).is_ok();
    if !known {
        return f64::INFINITY;
    }
    // what leaves all nodes together for a rise of all by 1 K
    let out = -values.iter().sum::<f64>();
    if out > 0.0 { system.capacity().iter().sum::<f64>() / out } else { f64::INFINITY }
}

/// Whether steps of this length see the input over the segment. What cannot be evaluated is left to the run.
fn resolves(input: &Value, segment: Segment, step: f64, scope: &mut Evaluation) -> bool {
    let steps = ((segment.to - segment.from) / step).ceil().max(1.0);
    let points = steps * f64::from(PARTS);
    let mut at = |k: f64| {
        scope.set_time(segment.from + (segment.to - segment.from) * (k / points), segment.inside());
        input.at(scope).unwrap_or(0.0)
    };
    let first = at(0.0);
    let (mut missed, mut variation, mut left, mut k) = (0.0, 0.0, first, 0.0);
    while k < points {
        let right = at(k + f64::from(PARTS));
        for part in 1..=PARTS {
            let share = f64::from(part) / f64::from(PARTS);
            let value = at(k + f64::from(part));
            missed += (value - (left + share * (right - left))).abs();
            variation += (value - first).abs();
        }
        left = right;
        k += f64::from(PARTS);
    }
    missed <= MISSED * variation
}
