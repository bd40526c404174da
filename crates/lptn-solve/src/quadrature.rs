//! Integrals over a step by the Gauss rule, halved where a curve has a kink.

use crate::error::StopReason;

/// Nodes and weights of the Gauss-Legendre rule of order 10 on (-1, 1)
/// (Abramowitz and Stegun, Handbook of Mathematical Functions, table 25.4, n = 5).
pub(crate) const GAUSS: [(f64, f64); 5] = [
    (-0.906_179_845_938_664, 0.236_926_885_056_189_1),
    (-0.538_469_310_105_683_1, 0.478_628_670_499_366_5),
    (0.0, 0.568_888_888_888_888_9),
    (0.538_469_310_105_683_1, 0.478_628_670_499_366_5),
    (0.906_179_845_938_664, 0.236_926_885_056_189_1),
];

/// Values of several curves at one time in s.
#[derive(Clone, Debug)]
pub(crate) struct Point {
    pub(crate) time: f64,
    pub(crate) values: Vec<f64>,
}

/// The rule on an interval and on its halves agree to this share of the largest value, or the halves are halved.
const AGREEMENT: f64 = 1e-10;

/// Intervals that may be halved in one step. The temperature inside a step is a polynomial, which the rule integrates
/// exactly; a kink of an expression is met by halving, and what is nothing but rounding is not followed for ever.
const HALVINGS: usize = 40;

/// Evaluates all curves at a time.
type At<'a> = dyn FnMut(f64) -> Result<Point, StopReason> + 'a;

/// Adds the integral of every curve from `from` to `to`, and gives all points looked at, by time, ends included.
pub(crate) fn integrate(
    (from, to): (f64, f64),
    integral: &mut [f64],
    at: &mut At<'_>,
) -> Result<Vec<Point>, StopReason> {
    let mut points = vec![at(from)?];
    let mut halvings = 0;
    let mut open = vec![((from, to), rule((from, to), &mut points, at)?)];
    while let Some(((a, b), whole)) = open.pop() {
        let middle = a + 0.5 * (b - a);
        let left = rule((a, middle), &mut points, at)?;
        let right = rule((middle, b), &mut points, at)?;
        let agree = (0..whole.len()).all(|i| {
            let size = (left[i].1 + right[i].1).max(whole[i].1);
            (left[i].0 + right[i].0 - whole[i].0).abs() <= AGREEMENT * size
        });
        if agree || halvings >= HALVINGS {
            integral.iter_mut().zip(left.iter().zip(&right)).for_each(|(sum, (l, r))| *sum += l.0 + r.0);
        } else {
            halvings += 1;
            open.push(((middle, b), right));
            open.push(((a, middle), left));
        }
    }
    points.push(at(to)?);
    points.sort_by(|a, b| a.time.total_cmp(&b.time));
    Ok(points)
}

/// For each curve its integral, and that of its absolute value.
fn rule(
    (from, to): (f64, f64),
    points: &mut Vec<Point>,
    at: &mut At<'_>,
) -> Result<Vec<(f64, f64)>, StopReason> {
    let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
    let mut sums = Vec::new();
    for (x, weight) in GAUSS {
        let point = at(middle + half * x)?;
        sums.resize(point.values.len(), (0.0, 0.0));
        for (sum, value) in sums.iter_mut().zip(&point.values) {
            *sum = (sum.0 + half * weight * value, sum.1 + half * weight * value.abs());
        }
        points.push(point);
    }
    Ok(sums)
}

#[cfg(test)]
mod tests {
    use super::{Point, integrate};

    fn integral(curve: impl Fn(f64) -> f64, from: f64, to: f64) -> f64 {
        let mut sum = [0.0];
        let mut at = |time: f64| Ok(Point { time, values: vec![curve(time)] });
        let points = integrate((from, to), &mut sum, &mut at).unwrap();
        assert!(points.windows(2).all(|w| w[0].time <= w[1].time));
        sum[0]
    }

    #[test]
    fn smooth_curves_to_rounding_and_kinks_to_a_millionth() {
        assert!((integral(|t| t.powi(9), 0.0, 1.0) - 0.1).abs() < 1e-15);
        assert!((integral(f64::exp, 0.0, 2.0) - 2.0_f64.exp_m1()).abs() < 1e-12);
        // |t - 1/3| from 0 to 1: (1/9 + 4/9)/2
        assert!((integral(|t| (t - 1.0 / 3.0).abs(), 0.0, 1.0) - 5.0 / 18.0).abs() < 1e-9);
        let step = |t: f64| if t < 0.3 { 1.0 } else { 0.0 };
        assert!((integral(step, 0.0, 1.0) - 0.3).abs() < 1e-6);
    }

    #[test]
    fn noise_ends() {
        let noise = |t: f64| (1e9 * t).sin();
        assert!(integral(noise, 0.0, 1.0).abs() < 1.0);
    }
}
