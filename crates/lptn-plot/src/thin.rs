//! Fewer points that look the same.
//!
//! Dots are thinned in the same way as lines: the first, lowest, highest and last of each stretch
//! stay, so that an outlier is always drawn.

/// The points of a curve that are visible at a width of `pixels`. From the points on one pixel, the
/// first, lowest, highest and last stay, so that no peak is lost. Points are in the order of their
/// first coordinate; one that is not finite ends a piece and stays.
pub fn thinned(points: &[(f64, f64)], pixels: usize) -> Vec<(f64, f64)> {
    let range = |(low, high): (f64, f64), &(x, _): &(f64, f64)| (low.min(x), high.max(x));
    let (low, high) = points.iter().fold((f64::INFINITY, f64::NEG_INFINITY), range);
    if points.len() <= 4 * pixels || high <= low || pixels == 0 {
        return points.to_vec();
    }
    let pixel = |x: f64| ((x - low) / (high - low) * pixels as f64).floor() as i64;
    let same = |a: &(f64, f64), b: &(f64, f64)| {
        a.1.is_finite() == b.1.is_finite() && pixel(a.0) == pixel(b.0)
    };
    points.chunk_by(same).flat_map(kept).collect()
}

fn kept(column: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let by = |value: fn(&f64, &f64) -> std::cmp::Ordering| {
        let places = 0..column.len();
        move |column: &[(f64, f64)]| places.max_by(|&a, &b| value(&column[a].1, &column[b].1))
    };
    let highest = by(f64::total_cmp)(column);
    let lowest = by(|a, b| b.total_cmp(a))(column);
    let mut places = [Some(0), lowest, highest, column.len().checked_sub(1)];
    places.sort_unstable();
    let mut kept: Vec<usize> = places.into_iter().flatten().collect();
    kept.dedup();
    kept.into_iter().map(|place| column[place]).collect()
}

#[cfg(test)]
mod tests {
    use super::thinned;

    #[test]
    fn a_peak_of_one_point_stays() {
        let mut points: Vec<(f64, f64)> = (0..10_000).map(|i| (f64::from(i), 0.0)).collect();
        points[4321].1 = 7.0;
        points[8000].1 = f64::NAN;
        let thin = thinned(&points, 100);
        assert!(thin.len() <= 410, "{}", thin.len());
        assert!(thin.contains(&(4321.0, 7.0)));
        assert!(thin.iter().any(|point| point.1.is_nan()));
        assert_eq!((thin[0].0, thin[thin.len() - 1].0), (0.0, 9999.0));
    }

    #[test]
    fn few_points_are_left_alone() {
        let points = [(0.0, 1.0), (0.0, 2.0), (1.0, 3.0)];
        assert_eq!(thinned(&points, 10), points);
    }
}
