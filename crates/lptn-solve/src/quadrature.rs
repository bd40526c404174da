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

/// So many points of every interval are looked at: its ends and the nodes of the Gauss rule between
/// them.
pub(crate) const POINTS: usize = 7;

/// Where they are on (-1, 1).
const NODES: [f64; POINTS] =
    [-1.0, GAUSS[0].0, GAUSS[1].0, GAUSS[2].0, GAUSS[3].0, GAUSS[4].0, 1.0];

/// The Gauss rule on these points.
const RULE: [f64; POINTS] = [0.0, GAUSS[0].1, GAUSS[1].1, GAUSS[2].1, GAUSS[3].1, GAUSS[4].1, 0.0];

/// The rule of order 6 that interpolates at the ends, the middle and the two nodes beside it. The
/// temperature inside a step is a polynomial of degree 5 at most, which both integrate exactly;
/// what both agree on is smooth.
const OTHER_RULE: [f64; POINTS] = {
    let square = NODES[2] * NODES[2];
    let beside = 2.0 / 15.0 / (square * (1.0 - square));
    let ends = 1.0 / 3.0 - beside * square;
    [ends, 0.0, beside, 2.0 - 2.0 * (ends + beside), beside, 0.0, ends]
};

/// Of the interpolation through the points (Berrut and Trefethen, SIAM Review 46, 2004, eq. 3.2).
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

/// The two rules agree to this share of the integral of the absolute value, or the interval is
/// halved.
const AGREEMENT: f64 = 1e-10;

/// Nor is it halved for less than this share of the largest integral among the curves of the same
/// kind: the difference of two temperatures that are nearly equal is rounding.
const ROUNDING: f64 = 1e-12;

/// Intervals that may be halved in one step: a kink of an expression is met by halving, and what is
/// nothing but rounding is not followed for ever.
const HALVINGS: usize = 40;

/// Curves over an interval: the values of all at each of its points, in the order of time.
#[derive(Clone, Debug)]
pub(crate) struct Interval {
    from: f64,
    to: f64,
    pub(crate) values: [Vec<f64>; POINTS],
}

impl Interval {
    fn new(
        (from, to): (f64, f64),
        ends: [Vec<f64>; 2],
        at: &mut At<'_>,
    ) -> Result<Self, StopReason> {
        let [first, last] = ends;
        let time = |node: usize| from + 0.5 * (NODES[node] + 1.0) * (to - from);
        let values =
            [first, at(time(1))?, at(time(2))?, at(time(3))?, at(time(4))?, at(time(5))?, last];
        Ok(Self { from, to, values })
    }

    /// When a point is.
    pub(crate) fn time(&self, point: usize) -> f64 {
        match point {
            0 => self.from,
            p if p + 1 == POINTS => self.to,
            p => self.from + 0.5 * (NODES[p] + 1.0) * (self.to - self.from),
        }
    }

    /// A curve between the points, by the polynomial through them.
    pub(crate) fn interpolated(&self, curve: usize, time: f64) -> f64 {
        let x = 2.0 * (time - self.from) / (self.to - self.from) - 1.0;
        let (mut above, mut below) = (0.0, 0.0);
        for ((node, weight), values) in NODES.iter().zip(BARYCENTRIC).zip(&self.values) {
            let share = weight / (x - node);
            if !share.is_finite() {
                return values[curve];
            }
            (above, below) = (above + share * values[curve], below + share);
        }
        above / below
    }

    /// The middle is a point already, so that a half needs five new ones.
    fn halves(self, at: &mut At<'_>) -> Result<[Self; 2], StopReason> {
        let middle = self.time(POINTS / 2);
        let [first, _, _, centre, _, _, last] = self.values;
        let left = Self::new((self.from, middle), [first, centre.clone()], at)?;
        Ok([left, Self::new((middle, self.to), [centre, last], at)?])
    }

    /// For each curve its integral, how far the other rule is off, and the integral of its absolute
    /// value.
    fn integrals(&self) -> Vec<[f64; 3]> {
        let mut sums = vec![[0.0; 3]; self.values[0].len()];
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

/// Evaluates all curves at a time.
pub(crate) type At<'a> = dyn FnMut(f64) -> Result<Vec<f64>, StopReason> + 'a;

/// Integrates several curves step by step.
#[derive(Clone, Debug)]
pub(crate) struct Quadrature {
    /// For each curve its integral up to now.
    pub(crate) integral: Vec<f64>,
    /// For each curve its kind, counted from 0: curves of one quantity.
    kinds: Vec<usize>,
    /// How many intervals of the next step may be halved. Rounding that is taken for a kink is so
    /// in every step: each that ends without agreement leaves the next one half as many, and one
    /// that agrees gives them back.
    halvings: usize,
    last: Option<(f64, Vec<f64>)>,
}

impl Quadrature {
    pub(crate) fn new(kinds: Vec<usize>) -> Self {
        Self { integral: vec![0.0; kinds.len()], kinds, halvings: HALVINGS, last: None }
    }

    /// The curves may jump here: what they were at the end of the last step says nothing of the
    /// next.
    pub(crate) fn jump(&mut self) {
        self.last = None;
    }

    /// Adds the integrals over a step. Each interval is handed over in the order of time, with
    /// whether its points tell what the curves are between them.
    pub(crate) fn step(
        &mut self,
        (from, to): (f64, f64),
        at: &mut At<'_>,
        look: &mut dyn FnMut(&Interval, bool),
    ) -> Result<(), StopReason> {
        let known = self.last.take().filter(|(time, _)| time.to_bits() == from.to_bits());
        let first = match known {
            Some((_, values)) => values,
            None => at(from)?,
        };
        let last = at(to)?;
        let (mut left, mut settled) = (self.halvings, true);
        let mut open = vec![Interval::new((from, to), [first, last.clone()], at)?];
        while let Some(interval) = open.pop() {
            let integrals = interval.integrals();
            let agrees = self.agree(&integrals);
            if !agrees && left > 0 {
                left -= 1;
                let [before, after] = interval.halves(at)?;
                open.extend([after, before]);
                continue;
            }
            settled &= agrees;
            self.integral
                .iter_mut()
                .zip(&integrals)
                .for_each(|(sum, integral)| *sum += integral[0]);
            look(&interval, agrees);
        }
        self.halvings = if settled { HALVINGS } else { self.halvings / 2 };
        self.last = Some((to, last));
        Ok(())
    }

    fn agree(&self, integrals: &[[f64; 3]]) -> bool {
        let mut largest = vec![0.0_f64; self.kinds.iter().max().map_or(0, |kind| kind + 1)];
        for (&kind, [_, _, size]) in self.kinds.iter().zip(integrals) {
            largest[kind] = largest[kind].max(*size);
        }
        let agrees = |(&kind, [_, apart, size]): (&usize, &[f64; 3])| {
            // not so where one of them is not a number
            apart.abs() <= (AGREEMENT * size).max(ROUNDING * largest[kind])
        };
        self.kinds.iter().zip(integrals).all(agrees)
    }
}

#[cfg(test)]
mod tests {
    use super::Quadrature;

    /// The integral, and how often the curve was evaluated.
    fn integral(curve: impl Fn(f64) -> f64, from: f64, to: f64) -> (f64, usize) {
        let mut sum = Quadrature::new(vec![0]);
        let mut calls = 0;
        let mut at = |time: f64| {
            calls += 1;
            Ok(vec![curve(time)])
        };
        let mut end = from;
        sum.step((from, to), &mut at, &mut |interval, _| {
            assert!(interval.time(0) >= end);
            end = interval.time(super::POINTS - 1);
        })
        .unwrap();
        assert!((end - to).abs() < 1e-15);
        (sum.integral[0], calls)
    }

    #[test]
    fn smooth_curves_to_rounding_and_kinks_to_a_millionth() {
        assert!((integral(|t| t.powi(9), 0.0, 1.0).0 - 0.1).abs() < 1e-13);
        assert!((integral(f64::exp, 0.0, 2.0).0 - 2.0_f64.exp_m1()).abs() < 1e-12);
        // |t - 1/3| from 0 to 1: (1/9 + 4/9)/2
        assert!((integral(|t| (t - 1.0 / 3.0).abs(), 0.0, 1.0).0 - 5.0 / 18.0).abs() < 1e-9);
        let step = |t: f64| if t < 0.3 { 1.0 } else { 0.0 };
        assert!((integral(step, 0.0, 1.0).0 - 0.3).abs() < 1e-6);
    }

    /// What a step of the integrator is needs no halving: seven points.
    #[test]
    fn polynomials_of_a_step_are_integrated_at_once() {
        let (sum, calls) = integral(|t| 300.0 + t.powi(5) - 2.0 * t * t, 0.0, 2.0);
        assert!((sum - (600.0 + 64.0 / 6.0 - 16.0 / 3.0)).abs() < 1e-12, "{sum}");
        assert_eq!(calls, 7);
    }

    #[test]
    fn noise_ends() {
        let noise = |t: f64| (1e9 * t).sin();
        assert!(integral(noise, 0.0, 1.0).0.abs() < 1.0);
    }

    /// Noise in every step costs little, and a kink after it is seen again once a step has agreed.
    #[test]
    fn noise_in_every_step_is_given_up() {
        let mut sum = Quadrature::new(vec![0]);
        let mut calls = 0;
        for k in 0..1000 {
            let mut at = |time: f64| {
                calls += 1;
                Ok(vec![(1e9 * time).sin()])
            };
            sum.step((f64::from(k), f64::from(k + 1)), &mut at, &mut |_, _| {}).unwrap();
        }
        assert!(calls < 8000, "{calls}");
        assert_eq!(sum.halvings, 0);
        sum.jump();
        let mut smooth = |time: f64| Ok(vec![time]);
        sum.step((1000.0, 1001.0), &mut smooth, &mut |_, _| {}).unwrap();
        assert_eq!(sum.halvings, super::HALVINGS);
    }

    #[test]
    fn the_polynomial_between_the_points_is_theirs() {
        let curve = |t: f64| 300.0 + 3.0 * t.powi(5) - 7.0 * t.powi(3) + t;
        let mut sum = Quadrature::new(vec![0]);
        sum.step((1.0, 3.0), &mut |t| Ok(vec![curve(t)]), &mut |interval, agrees| {
            assert!(agrees);
            for t in [1.0, 1.1, 1.7, 2.0, 2.9, 3.0] {
                assert!((interval.interpolated(0, t) - curve(t)).abs() < 1e-10);
            }
        })
        .unwrap();
    }
}
