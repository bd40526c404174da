//! Several curves over an interval, by their values at a few points of it.

use crate::stop_reason::StopReason;

/// Evaluates all curves at a time: those that are asked for, then the quantities that determine
/// their bends.
pub(crate) type At<'a> = dyn FnMut(f64) -> Result<Vec<f64>, StopReason> + 'a;

/// Nodes and weights of the Gauss-Legendre rule of order 10 on (-1, 1)
/// (Abramowitz and Stegun, Handbook of Mathematical Functions, table 25.4, n = 5).
pub(crate) const GAUSS: [(f64, f64); 5] = [
    (-0.906_179_845_938_664, 0.236_926_885_056_189_1),
    (-0.538_469_310_105_683_1, 0.478_628_670_499_366_5),
    (0.0, 0.568_888_888_888_888_9),
    (0.538_469_310_105_683_1, 0.478_628_670_499_366_5),
    (0.906_179_845_938_664, 0.236_926_885_056_189_1),
];

/// Points of every interval at which curves are evaluated: its ends and the nodes of the Gauss rule
/// between them.
pub(crate) const POINTS: usize = 7;

/// The points on (-1, 1).
pub(crate) const NODES: [f64; POINTS] =
    [-1.0, GAUSS[0].0, GAUSS[1].0, GAUSS[2].0, GAUSS[3].0, GAUSS[4].0, 1.0];

/// The Gauss rule on these points.
const RULE: [f64; POINTS] = [0.0, GAUSS[0].1, GAUSS[1].1, GAUSS[2].1, GAUSS[3].1, GAUSS[4].1, 0.0];

/// The rule of order 6 that interpolates at the ends, the middle and the two nodes next to it. The
/// temperature inside a step is a polynomial of degree 5 at most, which both integrate exactly. A
/// curve is smooth if both agree.
const OTHER_RULE: [f64; POINTS] = {
    let square = NODES[2] * NODES[2];
    let beside = 2.0 / 15.0 / (square * (1.0 - square));
    let ends = 1.0 / 3.0 - beside * square;
    [ends, 0.0, beside, 2.0 - 2.0 * (ends + beside), beside, 0.0, ends]
};

/// Two rules on (-1, 1) that differ by no more than this share of a curve's range agree.
const SMOOTH: f64 = 1e-7;

/// The two rules agree to this share of the integral of the absolute value.
pub(crate) const AGREEMENT: f64 = 1e-10;

/// Weights of the interpolation through the points (Berrut and Trefethen, SIAM Review 46, 2004, eq.
/// 3.2).
const BARYCENTRIC: [f64; POINTS] = {
    let mut weights = [1.0; POINTS];
    let mut at = 0;
    while at < POINTS * POINTS {
        let (j, k) = (at / POINTS, at % POINTS);
        if j != k {
            weights[j] /= NODES[j] - NODES[k];
        }
        at += 1;
    }
    weights
};

/// Curves over an interval: the values of all at each of its points, in the order of time.
#[derive(Clone, Debug)]
pub(crate) struct Interval {
    pub(crate) from: f64,
    pub(crate) to: f64,
    pub(crate) values: [Vec<f64>; POINTS],
}

impl Interval {
    pub(crate) fn new(
        (from, to): (f64, f64),
        ends: [Vec<f64>; 2],
        at: &mut At<'_>,
    ) -> Result<Self, StopReason> {
        let [first, last] = ends;
        let time = |point: usize| time_of((from, to), point);
        let values =
            [first, at(time(1))?, at(time(2))?, at(time(3))?, at(time(4))?, at(time(5))?, last];
        Ok(Self { from, to, values })
    }

    /// The times of all points.
    pub(crate) fn times(&self) -> [f64; POINTS] {
        std::array::from_fn(|point| self.time(point))
    }

    /// The values of a curve at all points.
    pub(crate) fn of(&self, curve: usize) -> [f64; POINTS] {
        std::array::from_fn(|point| self.values[point][curve])
    }

    /// The time of a point in s.
    pub(crate) fn time(&self, point: usize) -> f64 {
        time_of((self.from, self.to), point)
    }

    /// True if the points resolve a curve: both rules agree to a share of its values, or of its
    /// range if it passes zero. With a jump or a kink they do not, however short the interval is.
    pub(crate) fn is_smooth(&self, curve: usize) -> bool {
        let (mut apart, mut size) = (0.0_f64, 0.0);
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for ((value, weight), other) in self.of(curve).into_iter().zip(RULE).zip(OTHER_RULE) {
            (apart, size) = (apart + (weight - other) * value, size + weight * value.abs());
            (low, high) = (low.min(value), high.max(value));
        }
        apart.abs() <= (SMOOTH * (high - low)).max(AGREEMENT * size)
    }

    /// A curve between the points, by the polynomial through them.
    pub(crate) fn interpolated(&self, curve: usize, time: f64) -> f64 {
        interpolated((self.from, self.to), &self.of(curve), time)
    }

    /// The two halves. The middle is a point already, so that a half needs five new ones.
    pub(crate) fn halves(self, at: &mut At<'_>) -> Result<[Self; 2], StopReason> {
        let middle = self.time(POINTS / 2);
        let [first, _, _, centre, _, _, last] = self.values;
        let left = Self::new((self.from, middle), [first, centre.clone()], at)?;
        Ok([left, Self::new((middle, self.to), [centre, last], at)?])
    }

    /// The parts between some times inside, ascending, with the values there.
    pub(crate) fn cut(
        self,
        cuts: Vec<(f64, Vec<f64>)>,
        at: &mut At<'_>,
    ) -> Result<Vec<Self>, StopReason> {
        let [first, .., last] = self.values;
        let mut begin = (self.from, first);
        let mut parts = Vec::with_capacity(cuts.len() + 1);
        for end in cuts.into_iter().chain([(self.to, last)]) {
            parts.push(Self::new((begin.0, end.0), [begin.1, end.1.clone()], at)?);
            begin = end;
        }
        Ok(parts)
    }

    /// For each of the first curves its integral, the difference of the other rule, and the
    /// integral of its absolute value.
    pub(crate) fn integrals(&self, count: usize) -> Vec<[f64; 3]> {
        let mut sums = vec![[0.0; 3]; count];
        let half = 0.5 * (self.to - self.from);
        for ((values, weight), other) in self.values.iter().zip(RULE).zip(OTHER_RULE) {
            let (weight, apart) = (half * weight, half * (weight - other));
            for (sum, value) in sums.iter_mut().zip(values) {
                *sum = [
                    sum[0] + weight * value,
                    sum[1] + apart * value,
                    sum[2] + weight * value.abs(),
                ];
            }
        }
        sums
    }
}

/// The time in s of a point of the interval between two times.
pub(crate) fn time_of((from, to): (f64, f64), point: usize) -> f64 {
    match point {
        0 => from,
        p if p + 1 == POINTS => to,
        p => from + 0.5 * (NODES[p] + 1.0) * (to - from),
    }
}

/// A curve between the points of the interval between two times, by the polynomial through them.
pub(crate) fn interpolated((from, to): (f64, f64), values: &[f64; POINTS], time: f64) -> f64 {
    polynomial(values, 2.0 * (time - from) / (to - from) - 1.0)
}

/// The polynomial through the values at the points, at `x` from -1 to 1.
pub(crate) fn polynomial(values: &[f64; POINTS], x: f64) -> f64 {
    let (mut above, mut below) = (0.0, 0.0);
    for ((node, weight), value) in NODES.iter().zip(BARYCENTRIC).zip(values) {
        let share = weight / (x - node);
        if !share.is_finite() {
            return *value;
        }
        (above, below) = (above + share * value, below + share);
    }
    above / below
}

#[cfg(test)]
mod tests {
    #![allow(
        clippy::unwrap_used,
        clippy::float_cmp,
        reason = "a test that cannot go on has failed; numbers that are given"
    )]

    use super::*;

    /// Curves of a variable from -1 to 1, between two times.
    fn interval<const N: usize>(ends: (f64, f64), curves: impl Fn(f64) -> [f64; N]) -> Interval {
        Interval { from: ends.0, to: ends.1, values: NODES.map(|x| curves(x).to_vec()) }
    }

    /// Both rules are exact for a polynomial of degree 5, so that a bump in one point alone
    /// separates them: by this share of it.
    const APART: f64 = GAUSS[0].1;

    fn bump(x: f64) -> f64 {
        if x.to_bits() == NODES[1].to_bits() { 1.0 } else { 0.0 }
    }

    #[test]
    fn what_the_rules_agree_on_is_smooth() {
        let is_smooth = |curve: &dyn Fn(f64) -> f64| {
            interval((3.0, 7.0), |x| [f64::NAN, curve(x)]).is_smooth(1)
        };
        for sign in [1.0, -1.0] {
            // a part in 1e10 of the integral of a curve that does not pass zero
            let size = 3.0 * 2e-10 / APART;
            assert!(is_smooth(&|x| sign * (3.0 + 0.999 * size * bump(x))));
            assert!(!is_smooth(&|x| sign * (3.0 + 1.001 * size * bump(x))));
            assert!(!is_smooth(&|x| sign * (3.0 - 1.001 * size * bump(x))));
            // a part in 1e7 of the range of a curve that passes it
            let range = 2e-7 * 5.0 / APART;
            assert!(is_smooth(&|x| sign * (5.0 * x + 0.999 * range * bump(x))));
            assert!(!is_smooth(&|x| sign * (5.0 * x + 1.001 * range * bump(x))));
            assert!(is_smooth(&|x| sign * (x.powi(5) - 2.0 * x * x)));
            assert!(!is_smooth(&|x| sign * (x - 0.3).abs()));
        }
    }

    #[test]
    fn integrals_of_a_polynomial_are_exact_and_what_the_rules_differ_by_is_told() {
        let all = interval((3.0, 7.0), |x| [3.0 + x.powi(4), x, -2.0, bump(x) - 1.0]).integrals(4);
        let expected = [
            [12.0 + 0.8, 0.0, 12.8],
            // of the absolute value that of the rule: 0.5 of each side, to its error at a kink
            [0.0, 0.0, 4.0 * (GAUSS[0].1 * GAUSS[4].0 + GAUSS[1].1 * GAUSS[3].0)],
            [-8.0, 0.0, 8.0],
            [-4.0 + 2.0 * APART, 2.0 * APART, 4.0 - 2.0 * APART],
        ];
        for (found, expected) in all.iter().flatten().zip(expected.iter().flatten()) {
            assert!((found - expected).abs() < 1e-13, "{all:?} {expected:?}");
        }
    }

    /// The rule next to the Gauss rule: exact to degree 5, as `2 / (n + 1)` for even powers.
    #[test]
    fn the_other_rule_is_exact_for_polynomials_of_a_step() {
        for power in 0..6 {
            let sum: f64 = NODES.iter().zip(OTHER_RULE).map(|(x, w)| w * x.powi(power)).sum();
            let exact = if power % 2 == 0 { 2.0 / f64::from(power + 1) } else { 0.0 };
            assert!((sum - exact).abs() < 1e-14, "{power}: {sum}");
        }
        let [_, second, .., last, _] = OTHER_RULE;
        assert_eq!([second, last], [0.0; 2]);
        // far enough from the Gauss rule to detect a curve that is not smooth
        assert!((OTHER_RULE[3] - GAUSS[2].1).abs() > 0.1, "{OTHER_RULE:?}");
    }

    /// Rounding would miss the end of some of these.
    #[test]
    fn an_interval_begins_and_ends_at_its_very_ends() {
        for k in 1..200 {
            let (from, to) = (f64::from(k) * 0.1, f64::from(k) * 0.7 + 1.0 / 3.0);
            let ends = [time_of((from, to), 0), time_of((from, to), POINTS - 1)];
            assert_eq!(ends.map(f64::to_bits), [from, to].map(f64::to_bits));
            for (point, node) in NODES.iter().enumerate().take(POINTS - 1).skip(1) {
                let exact = from.midpoint(to) + 0.5 * (to - from) * node;
                assert!((time_of((from, to), point) - exact).abs() < 1e-13);
            }
        }
    }

    #[test]
    fn parts_between_cuts_follow_each_other_and_share_their_ends() {
        let curve = |t: f64| vec![t * t];
        let mut looks = 0;
        let mut at = |time: f64| {
            looks += 1;
            Ok(curve(time))
        };
        let whole = Interval::new((0.0, 8.0), [curve(0.0), curve(8.0)], &mut at).unwrap();
        let parts = whole.clone().cut(vec![(1.0, curve(1.0)), (5.0, curve(5.0))], &mut at).unwrap();
        let [left, right] = whole.halves(&mut at).unwrap();
        assert_eq!(looks, 5 + 15 + 10);
        for (part, ends) in parts.iter().chain([&left, &right]).zip([
            (0.0, 1.0),
            (1.0, 5.0),
            (5.0, 8.0),
            (0.0, 4.0),
            (4.0, 8.0),
        ]) {
            assert_eq!((part.from, part.to), ends);
            for (time, values) in part.times().iter().zip(&part.values) {
                assert_eq!(*values, curve(*time));
            }
        }
    }
}
