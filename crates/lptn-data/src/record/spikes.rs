//! Outliers: a broken wire, a lost digit.
//!
//! An outlier lies outside of the values before and after it by far more than they scatter. A step
//! of the power lies between both and is not one.

/// Number of values on each side with which one is compared.
const SIDE: usize = 7;

/// An outlier is off by more than these multiples of the scatter of the column, of the step of the
/// instrument, and of the spread of the values around it.
const SCATTER: f64 = 20.0;
const STEPS: f64 = 10.0;
const SPREAD: f64 = 5.0;

/// At an end of the record the neighbour has to be nearer to the others by this factor: a fast
/// start is not an outlier.
const ALONE: f64 = 0.1;

/// In a record of few rows, at least `FEWEST`, an outlier is off by more than `SPAN` times the
/// range of all others. There the first and the last row are not judged: a fast start or end is as
/// far off.
const FEWEST: usize = 6;
const SPAN: f64 = 30.0;

/// The places of values that are far from those around them.
pub(crate) fn spikes(values: &[f64]) -> Vec<usize> {
    match values.len() {
        ..FEWEST => Vec::new(),
        few if few < 3 * SIDE => (1..few - 1).filter(|&i| is_far(values, i)).collect(),
        _ => scattered(values),
    }
}

/// True if a value is far outside of all others, whatever their time history.
fn is_far(values: &[f64], i: usize) -> bool {
    let others = || values.iter().enumerate().filter(|(k, _)| *k != i).map(|(_, v)| *v);
    let low = others().fold(f64::INFINITY, f64::min);
    let high = others().fold(f64::NEG_INFINITY, f64::max);
    let outside = (values[i] - high).max(low - values[i]);
    // others that are all equal do not show their scatter
    high > low && outside > SPAN * (high - low)
}

fn scattered(values: &[f64]) -> Vec<usize> {
    let bent = |w: &[f64]| (w[1] - 0.5 * (w[0] + w[2])).abs();
    let scatter = 1.4826 * median(values.windows(3).map(bent).collect());
    let least = (SCATTER * scatter).max(STEPS * step(values));
    // a cheap test first: most values need no sorting of their neighbours
    let is_off = |i: &usize| off(values, *i, 0.0) > least;
    let inside = (0..values.len()).filter(is_off).filter(|&i| off(values, i, SPREAD) > least);
    let mut found: Vec<usize> = inside.collect();
    let turned: Vec<f64> = values.iter().rev().copied().collect();
    let last = values.len() - leading(&turned, least);
    found.extend((0..leading(values, least)).chain(last..values.len()));
    found.sort_unstable();
    found.dedup();
    found
}

/// The most outliers in a row, of which more are a part of the time history.
const GROUP: usize = 3;

/// The number of outliers that a record begins with, as an instrument that starts out of its range.
fn leading(values: &[f64], least: f64) -> usize {
    let begins = |count: &usize| {
        let (group, behind) = (&values[..*count], &values[*count..*count + SIDE]);
        let middle = median(behind.to_vec());
        let away = |value: &f64| (value - middle).abs();
        let scatter = 1.4826 * median(behind.iter().map(away).collect());
        let nearest = group.iter().map(away).fold(f64::INFINITY, f64::min);
        nearest > least.max(SPREAD * scatter) && away(&behind[0]) <= ALONE * nearest
    };
    (2..=GROUP).rev().find(begins).unwrap_or(0)
}

/// Distance of a value beyond those before and after it; 0 if it is within `times` their scatter.
fn off(values: &[f64], i: usize, times: f64) -> f64 {
    let before = &values[i.saturating_sub(SIDE)..i];
    let behind = &values[(i + 1).min(values.len())..(i + 1 + SIDE).min(values.len())];
    let sides: Vec<f64> = [before, behind]
        .iter()
        .filter(|side| !side.is_empty())
        .map(|s| median(s.to_vec()))
        .collect();
    let low = sides.iter().copied().fold(f64::INFINITY, f64::min);
    let high = sides.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let outside = (values[i] - high).max(low - values[i]);
    if times <= 0.0 || outside <= 0.0 {
        return outside;
    }
    let neighbour = match (before.last(), behind.first()) {
        (None, Some(next)) | (Some(next), None) => (next - sides[0]).abs(),
        _ => 0.0,
    };
    if neighbour > ALONE * outside {
        return 0.0;
    }
    let around = [before, behind].concat();
    let middle = median(around.clone());
    let scatter = 1.4826 * median(around.iter().map(|v| (v - middle).abs()).collect());
    if outside > times * scatter { outside } else { 0.0 }
}

/// The smallest distance between consecutive values that differ; 0 if all are equal.
fn step(values: &[f64]) -> f64 {
    let apart = values.windows(2).map(|pair| (pair[1] - pair[0]).abs());
    let least = apart.filter(|d| *d > 0.0).fold(f64::INFINITY, f64::min);
    if least.is_finite() { least } else { 0.0 }
}

pub(crate) fn median(mut values: Vec<f64>) -> f64 {
    let middle = values.len() / 2;
    if values.is_empty() {
        return 0.0;
    }
    *values.select_nth_unstable_by(middle, f64::total_cmp).1
}

#[cfg(test)]
mod tests {
    use super::spikes;

    /// A rise of 60 K in 800 s, every 5 s, rounded to 0.1 K.
    fn rise() -> Vec<f64> {
        let value = |k: u32| 25.0 + 60.0 * (1.0 - f64::exp(-f64::from(k) / 160.0));
        (0..300).map(|k| (10.0 * value(k)).round() / 10.0).collect()
    }

    #[test]
    fn what_no_course_explains_is_found_wherever_it_stands() {
        for places in [
            vec![0],
            vec![0, 1],
            vec![0, 1, 2],
            vec![298, 299],
            vec![297, 298, 299],
            vec![299],
            vec![120],
            vec![40, 41],
            vec![17, 18, 19, 20],
            vec![3, 200],
        ] {
            let mut values = rise();
            places.iter().for_each(|&i| values[i] = 9999.0);
            assert_eq!(spikes(&values), places);
        }
        let mut values = rise();
        (values[50], values[99]) = (0.0, values[99] + 8.0);
        assert_eq!(spikes(&values), [50, 99]);
    }

    /// Few rows with one outlier, and few rows without: a pulse among zeros, a fast start or end, a
    /// peak between rows far apart.
    #[test]
    fn one_of_few_rows_is_found() {
        for count in 6..25 {
            for place in 1..count - 1 {
                let rise = |k: usize| 20.0 + 5.0 * (1.0 - f64::exp(-(k as f64) / 4.0));
                let mut values: Vec<f64> = (0..count).map(rise).collect();
                assert_eq!(spikes(&values), [0; 0], "{count}");
                values[place] = 9999.0;
                assert_eq!(spikes(&values), [place], "{count}");
            }
        }
        for clean in [
            vec![0.0, 0.0, 0.0, 100.0, 0.0, 0.0, 0.0],
            vec![80.0, 20.1, 20.0, 20.0, 20.1, 20.0, 20.0],
            vec![20.0, 20.0, 20.1, 20.0, 20.1, 20.0, 80.0],
            vec![20.0, 20.0, 45.0, 24.0, 21.0, 20.0],
            vec![20.0, 45.0, 45.1, 45.0, 45.1, 45.0],
        ] {
            assert_eq!(spikes(&clean), [0; 0], "{clean:?}");
        }
    }

    #[test]
    fn steps_kinks_pulses_and_noise_are_none() {
        assert!(spikes(&rise()).is_empty());
        let step: Vec<f64> = (0..100).map(|k| if k < 47 { 20.0 } else { 80.0 }).collect();
        assert!(spikes(&step).is_empty());
        let kinks: Vec<f64> = (0..100).map(|k| 20.0 + f64::from((k % 40 - 20i32).abs())).collect();
        assert!(spikes(&kinks).is_empty());
        let flicker: Vec<f64> = (0..100).map(|k| if k % 33 == 5 { 20.1 } else { 20.0 }).collect();
        assert!(spikes(&flicker).is_empty());
        let pulse: Vec<f64> =
            (0..100).map(|k| if (40..52).contains(&k) { 900.0 } else { 0.0 }).collect();
        assert!(spikes(&pulse).is_empty());
        let fast: Vec<f64> = (0..100).map(|k| 60.0 * f64::exp(-f64::from(k))).collect();
        assert!(spikes(&fast).is_empty());
        assert!(spikes(&[1.0, 2.0, 1e6]).is_empty());
    }
}
