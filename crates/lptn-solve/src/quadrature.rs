//! Integrals over a step by the Gauss rule, halved if a curve has a kink.
//!
//! Windows evaluate seven points a step. The ends and five Gauss nodes make two rules that are
//! exact for the polynomial of a step; extremes come from the polynomial through the points. Noise
//! that looks like a kink in every step loses its halvings.

use lptn_network::Bends;

use crate::cuts::Levels;
use crate::hidden::Hidden;
use crate::interval::{AGREEMENT, At, Interval};
use crate::resolve::{Judged, Resolved, resolve};
use crate::stop_reason::StopReason;

/// Nor is it halved for less than this share of the largest integral among the curves of the same
/// kind: the difference of two temperatures that are nearly equal is rounding.
pub(crate) const ROUNDING: f64 = 1e-12;

/// Intervals that may be halved in one step: halvings locate bends without a known level, and
/// rounding must not be followed without end.
const HALVINGS: usize = 80;

/// Integrates several curves step by step.
#[derive(Clone, Debug)]
pub(crate) struct Quadrature {
    /// For each curve its integral up to now.
    pub(crate) integral: Vec<f64>,
    /// For each curve its kind, counted from 0: curves of one quantity.
    kinds: Vec<usize>,
    halvings: Halvings,
    /// For each curve the integral of its absolute value, and the possible error of its integral if
    /// the halvings came to an end.
    sizes: Vec<[f64; 2]>,
    last: Option<(f64, Vec<f64>)>,
}

/// Number of intervals of the next step that may be halved. Rounding looks like a kink in every
/// step: each step that ends without agreement halves this number, and one that agrees restores it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Halvings(pub(crate) usize);

impl Default for Halvings {
    fn default() -> Self {
        Self(HALVINGS)
    }
}

impl Halvings {
    /// Updates the number after a step; `settled`: its two rules agreed.
    pub(crate) fn after(&mut self, settled: bool) {
        self.0 = if settled { HALVINGS } else { self.0 / 2 };
    }
}

impl Quadrature {
    pub(crate) fn new(kinds: Vec<usize>) -> Self {
        let count = kinds.len();
        let (integral, sizes) = (vec![0.0; count], vec![[0.0; 2]; count]);
        Self { integral, kinds, halvings: Halvings::default(), sizes, last: None }
    }

    /// The curves may jump here: their values at the end of the last step do not apply to the next.
    pub(crate) fn jump(&mut self) {
        self.last = None;
    }

    /// Possible error of a curve's integral, as a share of the integral of its absolute value, if
    /// halvings came to an end and it is more than rounding; else 0.
    pub(crate) fn open(&self, curve: usize) -> f64 {
        let [size, open] = self.sizes[curve];
        if open > ROUNDING * size { open / size } else { 0.0 }
    }

    /// Adds the integrals over a step. Each interval is handed over in the order of time, with a
    /// flag that its points resolve the curves.
    pub(crate) fn step(
        &mut self,
        (from, to): (f64, f64),
        (along, at): ((&Bends, &[f64]), &mut At<'_>),
        look: &mut dyn FnMut(&Interval, bool),
    ) -> Result<(), StopReason> {
        let known = self.last.take().filter(|(time, _)| time.to_bits() == from.to_bits());
        let first = match known {
            Some((_, values)) => values,
            None => at(from)?,
        };
        let last = at(to)?;
        let whole = Interval::new((from, to), [first, last.clone()], at)?;
        let (kinds, count) = (&self.kinds, self.kinds.len());
        let mut hidden = Hidden::new(along, count);
        let mut sizes = vec![0.0; count];
        let mut judge = |interval: &Interval| Judged {
            wanting: wanting(kinds, &interval.integrals(count), &mut sizes),
            hides: hidden.wanting(interval),
        };
        let levels = Levels::new(count, along.0);
        let parts = resolve(whole, levels, self.halvings.0, (at, &mut judge))?;
        self.halvings.after(parts.iter().all(|part| part.told));
        for Resolved { interval, told, open } in &parts {
            let integrals = interval.integrals(count);
            let sums = self.integral.iter_mut().zip(&mut self.sizes);
            for ((sum, size), [integral, apart, absolute]) in sums.zip(integrals) {
                *sum += integral;
                size[0] += absolute;
                size[1] += if *open { apart.abs() } else { 0.0 };
            }
            look(interval, *told);
        }
        self.last = Some((to, last));
        Ok(())
    }
}

/// Difference of the two rules for the worst curve, over the allowed one; 0 if they agree. A curve
/// that is not a number somewhere stays so after a halving. `sizes` are the largest integrals of
/// absolute values in the step up to now, next to which an interval may be negligible.
fn wanting(kinds: &[usize], integrals: &[[f64; 3]], sizes: &mut [f64]) -> f64 {
    let mut largest = vec![0.0_f64; kinds.iter().max().map_or(0, |kind| kind + 1)];
    for ((&kind, [_, _, size]), known) in kinds.iter().zip(integrals).zip(sizes.iter_mut()) {
        *known = known.max(*size);
        largest[kind] = largest[kind].max(*size);
    }
    let one = |((&kind, [_, apart, size]), known): ((&usize, &[f64; 3]), &f64)| {
        let rounding = ROUNDING * largest[kind].max(*known);
        let allowed = (AGREEMENT * size).max(rounding);
        if apart.abs() > allowed { apart.abs() / allowed } else { 0.0 }
    };
    kinds.iter().zip(integrals).zip(&*sizes).map(one).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::float_cmp, reason = "numbers that are given")]

    use lptn_network::Bends;

    use super::{Halvings, Quadrature};
    use crate::interval::{GAUSS, NODES};

    /// The integral, and the number of evaluations of the curve.
    fn integral(curve: impl Fn(f64) -> f64, from: f64, to: f64) -> (f64, usize) {
        let mut sum = Quadrature::new(vec![0]);
        let mut calls = 0;
        let mut at = |time: f64| {
            calls += 1;
            Ok(vec![curve(time)])
        };
        let mut end = from;
        sum.step((from, to), ((&Bends::default(), &[]), &mut at), &mut |interval, _| {
            assert!(interval.time(0) >= end);
            end = interval.time(crate::interval::POINTS - 1);
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

    /// The polynomial of a step of the integrator needs no halving: seven points.
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
            sum.step(
                (f64::from(k), f64::from(k + 1)),
                ((&Bends::default(), &[]), &mut at),
                &mut |_, _| {},
            )
            .unwrap();
        }
        assert!(calls < 8000, "{calls}");
        assert_eq!(sum.halvings.0, 0);
        sum.jump();
        let mut smooth = |time: f64| Ok(vec![time]);
        sum.step((1000.0, 1001.0), ((&Bends::default(), &[]), &mut smooth), &mut |_, _| {})
            .unwrap();
        assert_eq!(sum.halvings.0, super::HALVINGS);
    }

    /// If no halving is left, the integral is off by the difference of the rules, as a share of the
    /// integral of the absolute value.
    #[test]
    fn how_far_off_an_integral_may_be_is_told_where_halvings_end() {
        let mut sum = Quadrature::new(vec![0, 0, 1]);
        sum.halvings = Halvings(0);
        let jump = |t: f64| if t > 1.5 { -3.0 } else { 0.0 };
        for begin in [0.0, 2.0, 4.0] {
            let mut at = |t: f64| Ok(vec![1.0 + t, jump(t - begin), 0.0]);
            let along = ((&Bends::default(), &[][..]), &mut at as &mut _);
            sum.step((begin, begin + 2.0), along, &mut |_, told| assert!(!told)).unwrap();
            sum.jump();
        }
        // two nodes of the Gauss rule are after the jump; for the other rule one of them and the
        // end
        let square = NODES[4] * NODES[4];
        let beside = 2.0 / 15.0 / (square * (1.0 - square));
        let other = beside + 1.0 / 3.0 - beside * square;
        let gauss = GAUSS[3].1 + GAUSS[4].1;
        assert!((sum.integral[1] + 9.0 * gauss).abs() < 1e-12, "{:?}", sum.integral);
        assert!((sum.open(1) - (1.0 - other / gauss).abs()).abs() < 1e-12, "{}", sum.open(1));
        // a straight line is off by rounding alone
        assert!(sum.open(0) == 0.0 && sum.open(2) == 0.0);
        assert!((sum.integral[0] - 24.0).abs() < 1e-12);
    }

    #[test]
    fn halvings_are_halved_until_a_step_is_settled() {
        let mut halvings = Halvings(81);
        halvings.after(false);
        assert_eq!(halvings.0, 40);
        halvings.after(true);
        assert_eq!(halvings.0, super::HALVINGS);
    }

    /// A curve wants the difference of its rules over a part in 1e10 of its own size, or one in
    /// 1e12 of the largest of its kind, in this interval or before.
    #[test]
    fn the_worst_curve_tells_how_much_is_wanting() {
        let wants = |integrals: &[[f64; 3]], known: &[f64]| {
            let mut sizes = known.to_vec();
            let found = super::wanting(&[0, 0, 1][..integrals.len()], integrals, &mut sizes);
            let largest = integrals.iter().zip(known).map(|(one, known)| one[2].max(*known));
            assert_eq!(sizes, largest.collect::<Vec<f64>>());
            found
        };
        let near = |found: f64, expected: f64| {
            assert!((found - expected).abs() < 1e-9 * expected, "{found} {expected}");
        };
        for sign in [1.0, -1.0] {
            near(wants(&[[1.0, sign * 8e-10, 2.0]], &[0.0]), 4.0);
            assert!(wants(&[[1.0, sign * 1.9e-10, 2.0]], &[0.0]) == 0.0);
            // negligible next to another one of its kind, or next to itself before
            let small = [1.0, sign * 8e-10, 2.0];
            near(wants(&[small, [0.0, 0.0, 500.0]], &[0.0; 2]), 8.0 / 5.0);
            assert!(wants(&[small, [0.0, 0.0, 900.0]], &[0.0; 2]) == 0.0);
            near(wants(&[small], &[500.0]), 8.0 / 5.0);
            near(wants(&[small, small, [0.0, 0.0, 9e9]], &[0.0; 3]), 4.0);
            near(wants(&[small, [0.0, sign * 6e-9, 0.0], small], &[0.0; 3]), 3e3);
        }
        assert!(wants(&[[1.0, 1e-10, 1.0]], &[0.0]) == 0.0);
        assert!(wants(&[[f64::NAN; 3]], &[0.0]) == 0.0);
    }

    #[test]
    fn the_polynomial_between_the_points_is_theirs() {
        let curve = |t: f64| 300.0 + 3.0 * t.powi(5) - 7.0 * t.powi(3) + t;
        let mut sum = Quadrature::new(vec![0]);
        sum.step(
            (1.0, 3.0),
            ((&Bends::default(), &[]), &mut |t| Ok(vec![curve(t)])),
            &mut |interval, agrees| {
                assert!(agrees);
                for t in [1.0, 1.1, 1.7, 2.0, 2.9, 3.0] {
                    assert!((interval.interpolated(0, t) - curve(t)).abs() < 1e-10);
                }
            },
        )
        .unwrap();
    }
}
