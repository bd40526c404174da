//! Extremes of an interval whose points determine a column, and of one whose points do not.
use super::*;
use crate::interval::NODES;

/// A column between 2 and 12 s by a variable from -1 to 1.
fn interval(curve: impl Fn(f64) -> f64) -> Interval {
    Interval { from: 2.0, to: 12.0, values: NODES.map(|x| vec![curve(x)]) }
}

/// The extremes of a column, with their times in s.
fn extremes(told: bool, curve: impl Fn(f64) -> f64) -> [(f64, f64); 2] {
    let (mut min, mut max) = ([(f64::INFINITY, f64::NAN)], [(f64::NEG_INFINITY, f64::NAN)]);
    look(&interval(curve), told, &mut min, &mut max);
    [min[0], max[0]]
}

fn near(found: f64, expected: f64) {
    assert!((found - expected).abs() < 1e-9, "{found} for {expected}");
}

#[test]
fn a_top_between_the_points_counts_where_they_tell_the_column() {
    for sign in [1.0, -1.0] {
        let curve = |x: f64| sign * (1.0 - (x - 0.3) * (x - 0.3));
        let place = usize::from(sign > 0.0);
        let (value, time) = extremes(true, curve)[place];
        near(value, sign);
        assert!((time - 8.5).abs() < 1e-4, "{time}");
        let (value, time) = extremes(true, curve)[1 - place];
        near(value, sign * (1.0 - 1.69));
        near(time, 2.0);
        // else the best of the points
        let (value, time) = extremes(false, curve)[place];
        near(value, curve(NODES[4]));
        near(time, 7.0 + 5.0 * NODES[4]);
        // as with a kink, which no polynomial resolves
        let kink = |x: f64| sign * (1.0 - (x - 0.3).abs());
        near(extremes(true, kink)[place].0, kink(NODES[4]));
    }
}

/// For `x - 0.3` and its square less 0.04, for 10 s: by the polynomial, or on the chords.
#[test]
fn the_time_above_zero_is_that_of_the_polynomial_or_of_the_chords() {
    let above = |told: bool, curve: &dyn Fn(f64) -> f64| above_zero(&interval(curve), told, 0);
    for told in [true, false] {
        near(above(told, &|x| x - 0.3), 3.5);
        near(above(told, &|x| 0.3 - x), 6.5);
        near(above(told, &|_| 1.0), 10.0);
        near(above(told, &|_| -1.0), 0.0);
        near(above(told, &|x| x + 1.5), 10.0);
        near(above(told, &|x| x - 1.5), 0.0);
    }
    near(above(true, &|x| 0.04 - (x - 0.3) * (x - 0.3)), 2.0);
    // no point lies between 0.1 and 0.5
    near(above(false, &|x| 0.04 - (x - 0.3) * (x - 0.3)), 0.0);
    // two chords: from 0 to a node, and from there to the next
    let [_, .., middle, node, next, _] = NODES;
    let kink = |x: f64| if x > 0.5 && x < 0.6 { 1.0 } else { -1.0 };
    near(above(true, &kink), 5.0 * 0.5 * (node - middle + next - node));
    near(above(false, &kink), 5.0 * 0.5 * (node - middle + next - node));
}
