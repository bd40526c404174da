//! Readings of a thermometer that is stuck or out of its range: one number in row after row.
//!
//! A body at rest, a coarse instrument and a boundary under control repeat a number too. Such rows
//! are wrong only if the number is reached or left by a jump. In addition, all other rows must show
//! noise, which no plateau of a body hides, or the number must be far outside of all others. Rows at
//! the start are not judged, since a body is at rest before its test.

use std::ops::Range;

use crate::record::spikes::median;

/// The fewest rows of one number.
pub(crate) const LONG: usize = 5;

/// The fewest other rows.
const FEWEST: usize = 20;

/// The jump is larger than these multiples of the step of the instrument and of the scatter.
const STEPS: f64 = 10.0;
const SCATTER: f64 = 20.0;

/// Noise of a larger standard deviation than this part of the step makes neighbours differ.
const NOISY: f64 = 1.2;

/// A number is out of range if the jumps to it and from it are larger than this multiple of the
/// range of all others, and than this number of kelvins. A hot gas that is shut off jumps as far,
/// but does not repeat a number.
const SPAN: f64 = 10.0;
const KELVINS: f64 = 100.0;

/// The fewest small changes of others: a set value has none.
const CHANGES: usize = 5;

/// The places of stuck readings of a temperature in K, in order; `values` has no gaps.
pub(crate) fn stuck(values: &[f64]) -> Vec<usize> {
    if values.len() < FEWEST + LONG {
        return Vec::new();
    }
    let step = resolution(values);
    let jumped = runs(values).into_iter().filter(|run| jump(values, run).1 > STEPS * step);
    let jumped: Vec<Range<usize>> = jumped.collect();
    let Some(others) = Others::of(values, &jumped) else { return Vec::new() };
    jumped.into_iter().filter(|run| others.show(jump(values, run), step)).flatten().collect()
}

/// The runs of one number that do not begin with the first row.
fn runs(values: &[f64]) -> Vec<Range<usize>> {
    let mut start = 0;
    let all = values.chunk_by(|a, b| a.total_cmp(b).is_eq()).map(|run| {
        start += run.len();
        start - run.len()..start
    });
    all.filter(|run| run.start > 0 && run.len() >= LONG).collect()
}

/// The smaller and the larger of the jumps at the ends of a run; the end of the record is none.
fn jump(values: &[f64], run: &Range<usize>) -> (f64, f64) {
    let own = values[run.start];
    let into = (own - values[run.start - 1]).abs();
    let out = values.get(run.end).map_or(into, |next| (next - own).abs());
    (into.min(out), into.max(out))
}

/// All values that differ from the numbers of the runs that a jump begins or ends.
struct Others {
    noise: f64,
    scatter: f64,
    /// The largest less the smallest.
    range: f64,
    /// Changes from a row to the next, rising, without those of 0.
    changes: Vec<f64>,
}

impl Others {
    /// `None` if there are too few, or no runs.
    fn of(values: &[f64], jumped: &[Range<usize>]) -> Option<Self> {
        let mut numbers: Vec<f64> = jumped.iter().map(|run| values[run.start]).collect();
        numbers.sort_by(f64::total_cmp);
        let is_other = |v: &f64| numbers.binary_search_by(|number| number.total_cmp(v)).is_err();
        let others: Vec<f64> = values.iter().copied().filter(is_other).collect();
        if others.len() < FEWEST || jumped.is_empty() {
            return None;
        }
        let triples = values.windows(3).filter(|w| w.iter().all(is_other));
        let bends = triples.map(|w| (w[1] - 0.5 * (w[0] + w[2])).abs());
        let low = others.iter().copied().fold(f64::INFINITY, f64::min);
        let high = others.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let changes = others.windows(2).map(|pair| (pair[1] - pair[0]).abs());
        let mut changes: Vec<f64> = changes.filter(|change| *change > 0.0).collect();
        changes.sort_by(f64::total_cmp);
        let (noise, scatter) = (noise(values, is_other), 1.4826 * median(bends.collect()));
        Some(Self { noise, scatter, range: high - low, changes })
    }

    /// True if they show that a run with these jumps at its ends is stuck.
    fn show(&self, (least, most): (f64, f64), step: f64) -> bool {
        let noisy = self.noise > NOISY * step && most > SCATTER * self.scatter;
        let small = self.changes.partition_point(|change| SCATTER * change < least);
        let far = least > KELVINS.max(SPAN * self.range) && small >= CHANGES;
        noisy || far
    }
}

/// The smallest distance of two numbers: the step of the instrument, or less if few rows show it.
fn resolution(values: &[f64]) -> f64 {
    /// Distances below this part of a value are rounding.
    const ROUNDING: f64 = 1e-12;
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let gaps = sorted.windows(2).map(|pair| (pair[1] - pair[0], pair[1].abs()));
    let least = gaps.filter(|(gap, size)| *gap > ROUNDING * size).map(|(gap, _)| gap);
    least.fold(f64::INFINITY, f64::min)
}

/// The standard deviation of the noise of other rows, from their fourth differences: those of a
/// smooth curve are almost 0.
fn noise(values: &[f64], is_other: impl Fn(&f64) -> bool) -> f64 {
    // of white noise, `1 + 16 + 36 + 16 + 1` variances
    let whole = 70_f64.sqrt();
    let fourth = |w: &[f64]| (w[0] - 4.0 * w[1] + 6.0 * w[2] - 4.0 * w[3] + w[4]).abs();
    let all = values.windows(5).filter(|w| w.iter().all(&is_other)).map(fourth);
    1.4826 * median(all.collect()) / whole
}

#[cfg(test)]
mod tests {
    use super::stuck;

    /// A rise of 60 K in 800 s, every 5 s, with noise of 0.05 K or none, rounded to `step`.
    fn rise(noise: f64, step: f64) -> Vec<f64> {
        let value = |k: u32| {
            // noise without a seed: the remainder of a golden section
            let noise = noise * 3.46 * ((f64::from(k) * 0.618_034).fract() - 0.5);
            300.0 + 60.0 * (1.0 - f64::exp(-f64::from(k) / 160.0)) + noise
        };
        (0..300).map(|k| (value(k) / step).round() * step).collect()
    }

    fn with(mut values: Vec<f64>, places: std::ops::Range<usize>, value: f64) -> Vec<f64> {
        values[places].fill(value);
        values
    }

    #[test]
    fn a_stuck_channel_is_found() {
        for places in [100..140, 100..105, 250..300] {
            let all: Vec<usize> = places.clone().collect();
            assert_eq!(stuck(&with(rise(0.05, 0.01), places, 338.15)), all);
        }
        // the last value before stays, and the body warms on
        let clean = rise(0.05, 0.01);
        let last = clean[29];
        assert_eq!(stuck(&with(clean, 30..70, last)), (29..70).collect::<Vec<_>>());
    }

    /// A K thermocouple without contact, also if the instrument rounds to 0.1 K or 1 K.
    #[test]
    fn a_reading_out_of_range_is_found() {
        for (noise, step) in [(0.05, 0.01), (0.0, 0.1), (0.05, 0.1), (0.0, 1.0)] {
            for places in [100..108, 292..300, 5..10] {
                let all: Vec<usize> = places.clone().collect();
                let found = stuck(&with(rise(noise, step), places, 1573.15));
                assert_eq!(found, all, "{noise} {step}");
            }
        }
    }

    #[test]
    fn what_is_constant_for_good_reason_is_not_stuck() {
        let at_rest = |values: Vec<f64>| {
            let cold = vec![values[0]; 60];
            [cold.clone(), values, cold].concat()
        };
        for (noise, step) in [(0.0, 0.1), (0.05, 0.1), (0.0, 0.5), (0.0, 1e-6), (0.05, 0.01)] {
            assert!(stuck(&rise(noise, step)).is_empty(), "{noise} {step}");
            let mut settled = rise(noise, step);
            let hot = settled[299];
            settled.extend(vec![hot; 200]);
            assert!(stuck(&settled).is_empty(), "{noise} {step}");
        }
        for step in [0.1, 0.5, 1.0] {
            // before the test, and cold again in one row after it
            assert!(stuck(&at_rest(rise(0.0, step))).is_empty(), "{step}");
        }
        // a bath under control: set values, and a ramp with a plateau
        let set: Vec<f64> =
            (0..300).map(|k| if k / 40 % 2 == 0 { 293.15 } else { 353.15 }).collect();
        assert!(stuck(&set).is_empty());
        let held: Vec<f64> = (0..300).map(|k| 293.15 + 0.5 * f64::from(k.min(120))).collect();
        assert!(stuck(&held).is_empty());
        // without noise, to 4 digits: a film on a bath that is heated twice, and at rest between
        let film = |k: u32| {
            let on = (k > 50 && k < 120) || k >= 180;
            let warmth = 1.0 - f64::exp(-f64::from(k % 60) / 20.0);
            if on { 313.15 + (1e4 * 30.0 * warmth).round() / 1e4 } else { 293.15 }
        };
        assert!(stuck(&(0..300).map(film).collect::<Vec<_>>()).is_empty());
        // a heater of little mass between two bodies, rounded to 0.1 K: pulses of 60 K
        let pulse = |k: usize| if (k / 25).is_multiple_of(2) { 0.0 } else { 60.0 };
        let fast: Vec<f64> = rise(0.0, 0.1).iter().zip(0..).map(|(v, k)| v + pulse(k)).collect();
        assert!(stuck(&fast).is_empty());
        // a burner: jumps of 1200 K between values with noise
        let flame = |k: usize| if (100..140).contains(&k) { 1200.0 + (k % 7) as f64 } else { 0.0 };
        let gas: Vec<f64> = rise(0.05, 1.0).iter().zip(0..).map(|(v, k)| v + flame(k)).collect();
        assert!(stuck(&gas).is_empty());
    }
}
