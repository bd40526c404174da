//! Curvature of inputs over time, and the steps that are short enough to resolve it.
//!
//! A step is judged by the prediction of a cubic through the ends of its neighbours, summed over
//! seven steps. Neither a large base nor a kink of the second derivative counts.

use lptn_network::{Curve, Evaluation, Network};

use crate::times::Segment;

/// Steps of the whole run to begin with.
const COARSE: f64 = 300.0;

/// Most halvings of a step.
const HALVINGS: usize = 7;

/// Parts of a first step at whose ends the values are sampled.
const PARTS: usize = 16;

/// Parts of a shorter one at least, which then are no longer than those of a first step.
const FEWEST_PARTS: usize = 4;

/// The share of the bend within steps that the values at their ends may fail to predict. It leaves
/// at least six steps in a period of a sine.
const MISSED: f64 = 0.2;

/// Steps on both sides that are judged together: a bend has its size from its neighbours.
const AROUND: usize = 3;

/// Values below this part of the largest one are rounding.
const ROUNDING: f64 = 1e-10;

/// Fewest steps of a segment: as many as a prediction takes.
const LEAST: f64 = 4.0;

/// Steps that are sampled in one go.
const CHUNK: usize = 4096;

/// A stretch of time in which no step may be longer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Stretch {
    pub(crate) from: f64,
    pub(crate) to: f64,
    pub(crate) step: f64,
}

/// Samples curves over the segments of a run and gives stretches that cover it, ascending. No step
/// is longer than `gap` or a three-hundredth of the run. If the ends of its steps do not predict a
/// curve between them, the steps are halved, up to seven times. All in s.
pub(crate) fn stretches(
    network: &Network,
    curves: &[Curve],
    segments: &[Segment],
    gap: f64,
) -> Vec<Stretch> {
    let span = segments[segments.len() - 1].to - segments[0].from;
    let coarse = span / COARSE;
    // not finer than the halvings can resolve: rows may be many
    let first = coarse.min(gap).max(coarse / f64::from(1_u32 << HALVINGS));
    let mut scope = network.evaluation();
    let largest = largest((network, curves), segments, first, &mut scope);
    let look = |(curve, largest)| Look { network, curve, rounding: ROUNDING * largest };
    let open: Vec<Look<'_>> = curves.iter().zip(largest).map(look).collect();
    let mut stretches = Vec::new();
    for &segment in segments {
        let length = segment.to - segment.from;
        let count = (length / first).ceil().max(LEAST);
        let cells = Cells::new(segment, length / count, first);
        let mut finer = Vec::new();
        // a segment as short as a sixteenth of a step is left to the integrator's first steps
        let looks = if length > coarse / PARTS as f64 { &open[..] } else { &[] };
        for range in cells.whole(count) {
            let samples = sampled(looks, cells, range, &mut scope);
            for (look, samples) in looks.iter().zip(&samples) {
                look.judge((cells, range), samples, (HALVINGS, &mut finer), &mut scope);
            }
        }
        let step = if count > LEAST { cells.step } else { first };
        let whole = Stretch { from: segment.from, to: segment.to, step };
        flatten(whole, finer, gap, &mut stretches);
    }
    stretches
}

/// Steps of one length from the start of a segment on.
#[derive(Clone, Copy)]
struct Cells {
    segment: Segment,
    step: f64,
    parts: usize,
}

/// Some of them, from and to.
type Range = (usize, usize);

impl Cells {
    fn new(segment: Segment, step: f64, first: f64) -> Self {
        let parts = whole_number((step / first * PARTS as f64).ceil());
        Self { segment, step, parts: parts.clamp(FEWEST_PARTS, PARTS) }
    }

    fn count(&self) -> usize {
        whole_number((self.segment.to - self.segment.from) / self.step)
    }

    fn whole(&self, count: f64) -> impl Iterator<Item = Range> + use<> {
        let count = whole_number(count);
        (0..count).step_by(CHUNK).map(move |from| (from, (from + CHUNK).min(count)))
    }

    fn start_of(&self, cell: usize) -> f64 {
        self.place((cell * self.parts) as f64)
    }

    /// The time in s after this number of parts of a step from the start.
    fn place(&self, parts: f64) -> f64 {
        (self.segment.from + parts / self.parts as f64 * self.step).min(self.segment.to)
    }

    /// The steps that are judged with those of a range.
    fn around(&self, (from, to): Range) -> Range {
        (from.saturating_sub(AROUND), (to + AROUND).min(self.count()))
    }

    fn halved(self) -> Self {
        Self { step: 0.5 * self.step, ..self }
    }
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a count of steps, at least 0"
)]
fn whole_number(x: f64) -> usize {
    x.round() as usize
}

/// One curve that is sampled.
struct Look<'a> {
    network: &'a Network,
    curve: &'a Curve,
    rounding: f64,
}

impl Look<'_> {
    /// Adds the stretches in which the steps of a range have to be halved, and samples them again.
    fn judge(
        &self,
        (cells, (from, to)): (Cells, Range),
        samples: &[f64],
        (halvings, finer): (usize, &mut Vec<Stretch>),
        scope: &mut Evaluation,
    ) {
        let (first, last) = cells.around((from, to));
        let bends = bends(samples, cells.parts);
        let unseen = |cell: &usize| {
            let around = cell.saturating_sub(AROUND).max(first)..(cell + AROUND + 1).min(last);
            let sum = bends[around.start - first..around.end - first].iter();
            let (missed, bent) = sum.fold((0.0, 0.0), |sum, bend| (sum.0 + bend.0, sum.1 + bend.1));
            missed > MISSED * bent && missed > self.rounding * (around.len() * cells.parts) as f64
        };
        let unseen: Vec<usize> = (from..to).filter(unseen).collect();
        for run in unseen.chunk_by(|a, b| a + 1 == *b) {
            let (a, b) = (run[0], run[run.len() - 1] + 1);
            let half = cells.halved();
            finer.push(Stretch { from: cells.start_of(a), to: cells.start_of(b), step: half.step });
            if halvings > 1 {
                let range = (2 * a, 2 * b);
                let samples = &sampled(std::slice::from_ref(self), half, range, scope)[0];
                self.judge((half, range), samples, (halvings - 1, &mut *finer), scope);
            }
        }
    }
}

/// The samples of each curve over a range and the steps around it; NaN for a value that fails,
/// which is left to the run.
fn sampled(
    looks: &[Look<'_>],
    cells: Cells,
    range: Range,
    scope: &mut Evaluation,
) -> Vec<Vec<f64>> {
    let (first, last) = cells.around(range);
    let count = (last - first) * cells.parts + 1;
    let mut samples = vec![Vec::with_capacity(count); looks.len()];
    if looks.is_empty() {
        return samples;
    }
    for k in first * cells.parts..=last * cells.parts {
        scope.set_time(cells.place(k as f64), cells.segment.inside());
        for (look, samples) in looks.iter().zip(&mut samples) {
            samples.push(look.network.curve_here(look.curve, scope).unwrap_or(f64::NAN));
        }
    }
    samples
}

/// The largest value of each curve at the ends and in the middle of the steps.
fn largest(
    (network, curves): (&Network, &[Curve]),
    segments: &[Segment],
    step: f64,
    scope: &mut Evaluation,
) -> Vec<f64> {
    let mut largest = vec![0.0_f64; curves.len()];
    for &segment in segments {
        let count = (2.0 * (segment.to - segment.from) / step).ceil().max(1.0);
        for k in 0..=whole_number(count) {
            let share = (k as f64 / count).min(1.0);
            let time = segment.from + share * (segment.to - segment.from);
            scope.set_time(time, segment.inside());
            for (curve, largest) in curves.iter().zip(&mut largest) {
                let value = network.curve_here(curve, scope).unwrap_or(f64::NAN);
                *largest = largest.max(value.abs());
            }
        }
    }
    largest
}

/// For each step the distances of its samples from the cubic through the ends of steps, and from
/// the chord. Both are 0 if a sample is not a number.
fn bends(samples: &[f64], parts: usize) -> Vec<(f64, f64)> {
    let count = samples.len() / parts;
    let end = |cell: usize| samples[cell * parts];
    let one = |cell: usize| {
        let first = cell.saturating_sub(1).min(count.saturating_sub(3));
        let [y0, y1, y2, y3] = [0, 1, 2, 3].map(|k| end((first + k).min(count)));
        let (d1, d2, d3) = (y1 - y0, y2 - 2.0 * y1 + y0, y3 - 3.0 * (y2 - y1) - y0);
        let (mut missed, mut bent) = (0.0, 0.0);
        for part in 1..parts {
            let (value, share) = (samples[cell * parts + part], part as f64 / parts as f64);
            let u = (cell - first) as f64 + share;
            let cubic = y0 + u * (d1 + (u - 1.0) / 2.0 * (d2 + (u - 2.0) / 3.0 * d3));
            missed += (value - cubic).abs();
            bent += (value - (end(cell) + share * (end(cell + 1) - end(cell)))).abs();
        }
        if (missed + bent).is_finite() { (missed, bent) } else { (0.0, 0.0) }
    };
    (0..count).map(one).collect()
}

/// The shortest step everywhere, as stretches that follow each other.
fn flatten(whole: Stretch, mut finer: Vec<Stretch>, gap: f64, out: &mut Vec<Stretch>) {
    let mut ends: Vec<f64> = finer.iter().flat_map(|s| [s.from, s.to]).collect();
    ends.extend([whole.from, whole.to]);
    ends.sort_by(f64::total_cmp);
    ends.dedup();
    finer.sort_by(|a, b| b.step.total_cmp(&a.step));
    let mut steps = vec![whole.step; ends.len() - 1];
    for stretch in finer {
        let place = |time: f64| ends.partition_point(|&end| end < time);
        steps[place(stretch.from)..place(stretch.to)].fill(stretch.step);
    }
    for (pair, step) in ends.windows(2).zip(steps) {
        let step = step.min(gap);
        match out.last_mut() {
            Some(last) if last.to >= pair[0] && last.step.to_bits() == step.to_bits() => {
                last.to = pair[1]
            }
            _ => out.push(Stretch { from: pair[0], to: pair[1], step }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Cells, MISSED, PARTS, Segment, bends};

    /// Miss of the cubic over the bend, for all steps of samples of a function of the steps.
    fn share(count: usize, of: impl Fn(f64) -> f64) -> f64 {
        let samples: Vec<f64> = (0..=count * PARTS).map(|k| of(k as f64 / PARTS as f64)).collect();
        let sum = bends(&samples, PARTS)
            .into_iter()
            .fold((0.0, 0.0), |sum, bend| (sum.0 + bend.0, sum.1 + bend.1));
        sum.0 / sum.1
    }

    #[test]
    fn a_sine_needs_six_steps_in_a_period_and_a_pulse_in_a_step_is_seen() {
        let sine = |steps: f64| share(60, |x| (2.0 * std::f64::consts::PI * x / steps).sin());
        assert!(sine(6.0) < MISSED && sine(5.0) > MISSED, "{} {}", sine(6.0), sine(5.0));
        let pulse = |width: f64| share(20, |x| 1e-3 * x * x + (-((x - 9.4) / width).powi(2)).exp());
        assert!(pulse(0.1) > MISSED && pulse(3.0) < MISSED, "{} {}", pulse(0.1), pulse(3.0));
        // a cubic is predicted, whatever its size
        assert!(share(7, |x| 1e6 * (x - 3.0).powi(3)) < 1e-9);
    }

    /// Samples are no further apart than those of a first step, at least four in a step.
    #[test]
    fn short_steps_have_fewer_samples() {
        let segment = Segment { from: 2.0, to: 12.0 };
        for (step, parts) in [(1.0, 16), (0.5, 8), (0.3, 5), (0.25, 4), (0.01, 4)] {
            let cells = Cells::new(segment, step, 1.0);
            assert_eq!(cells.parts, parts, "{step}");
            assert!((cells.start_of(3) - 2.0 - 3.0 * step).abs() < 1e-12);
            assert!((cells.place(parts as f64 / 2.0) - 2.0 - 0.5 * step).abs() < 0.13 * step);
        }
    }
}

#[cfg(test)]
mod course_tests;
