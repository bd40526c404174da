//! Rows on both sides of a moment at which something may jump.
//!
//! A row has the values that are valid from its time on. A maximum or a least margin may be at the
//! end of a stretch. The slopes of an extreme are read in one of two rows: the one with the value
//! of the extreme. The first row is 2e-9 of the run earlier.

/// Distance of a row before a moment, as a part of the run: far below any thermal time, far above
/// the distance at which two times are one.
const BEFORE: f64 = 2e-9;

/// The least number of doubles between the two.
const DOUBLES: f64 = 32.0;

/// The times, and before each another one whose row has the values from before a jump. A row has
/// the values from its time on, but an extreme may be where an earlier part ends. Ascending,
/// without those outside of the run, which goes from `start` to `stop` in s.
pub fn on_both_sides(times: impl Iterator<Item = f64>, (start, stop): (f64, f64)) -> Vec<f64> {
    let inside = times.filter(|time| (start..=stop).contains(time));
    let both = inside.flat_map(|time| [before(time, (start, stop)), time]);
    let mut all: Vec<f64> = both.filter(|time| *time > start).collect();
    all.sort_by(f64::total_cmp);
    all.dedup();
    all
}

fn before(time: f64, (start, stop): (f64, f64)) -> f64 {
    let double = f64::EPSILON * start.abs().max(stop.abs());
    time - (BEFORE * (stop - start)).max(DOUBLES * double)
}

/// The row at `times` whose value is nearest to `value`, among those on either side of the moment
/// `at`, in a run from `start` to `stop` in s: the one with an extreme. If both are, the later one.
pub fn own_side(
    (times, value_of): (&[f64], impl Fn(usize) -> f64),
    (at, value): (f64, f64),
    ends: (f64, f64),
) -> usize {
    let far = 1.5 * (at - before(at, ends));
    let near = |row: &usize| (times[*row] - at).abs() <= far;
    let miss = |row: usize| (value_of(row) - value).abs();
    let rows = (0..times.len()).rev().filter(near);
    let best = rows.min_by(|&a, &b| miss(a).total_cmp(&miss(b)));
    best.unwrap_or_else(|| times.partition_point(|time| *time < at).min(times.len() - 1))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::float_cmp, reason = "numbers that are given")]

    use super::{on_both_sides, own_side};

    #[test]
    fn a_row_in_front_of_each_moment() {
        let found = on_both_sides([5.0, 0.0, 5.0, 12.0].into_iter(), (0.0, 10.0));
        assert_eq!(found, [5.0 - 2e-8, 5.0]);
    }

    #[test]
    fn the_side_is_that_of_the_value() {
        let (times, values) = ([0.0, 5.0 - 2e-8, 5.0, 10.0], [0.0, 7.0, 3.0, 7.0]);
        let side = |value: f64| own_side((&times, |row| values[row]), (5.0, value), (0.0, 10.0));
        assert_eq!((side(7.0), side(3.0), side(5.0)), (1, 2, 2));
    }

    /// Far from 0 the row in front is 32 doubles away, of the larger end.
    #[test]
    fn a_row_in_front_is_told_apart_far_from_zero() {
        for sign in [1.0, -1.0] {
            let (start, stop) = (sign * 1e6 - 0.5, sign * 1e6 + 0.5);
            let found = on_both_sides([sign * 1e6].into_iter(), (start, stop));
            let away = 32.0 * f64::EPSILON * (1e6 + 0.5);
            assert!(found.len() == 2 && (found[1] - found[0] - away).abs() < 2e-10, "{found:?}");
        }
        let found = on_both_sides([40.0].into_iter(), (-20.0, 80.0));
        assert!((found[1] - found[0] - 2e-7).abs() < 1e-13, "{found:?}");
    }

    /// If no row is next to the moment it is the first one after it, or the last.
    #[test]
    fn a_moment_without_rows_has_the_next() {
        let times = [0.0, 4.0, 6.0, 10.0];
        let row = |at: f64| own_side((&times, |_| 0.0), (at, 0.0), (0.0, 10.0));
        assert_eq!([3.0, 4.0, 4.1, 9.0, 11.0].map(row), [1, 1, 2, 3, 3]);
        // rows are next to it up to one and a half of the distance, on both sides
        let beside = [5.0 - 2.9e-8, 5.0 + 2.9e-8, 7.0];
        let at = |value: f64| own_side((&beside, |row| row as f64), (5.0, value), (0.0, 10.0));
        assert_eq!([at(-1.0), at(0.2), at(0.9), at(9.0)], [0, 0, 1, 1]);
        let far = [5.0 - 3.1e-8, 5.0 + 3.1e-8, 7.0];
        assert_eq!(own_side((&far, |row| row as f64), (5.0, 0.0), (0.0, 10.0)), 1);
    }
}
