//! Results between the points of an interval, bounded by their form: a bell over a temperature may
//! be narrower than any distance of points.
//!
//! A narrow peak without a bend is bounded along the step by Taylor arithmetic.

use lptn_network::Bends;
use lptn_units::Taylor;

use crate::interval::{Interval, POINTS};
use crate::zeros::coefficients;

/// The largest product of the distances to all points, on (-1, 1).
const BETWEEN: f64 = 0.05;

/// Largest miss between the points, over the largest value that the step allows.
const MISSED: f64 = 1e-7;

/// A range of numbers ends this share of its width within: an interval is cut where something
/// bends, and the bend is not part of it.
const WITHIN: f64 = 1e-9;

/// Bounds hidden features in the intervals of one step.
pub(crate) struct Hidden<'a> {
    bends: &'a Bends,
    slots: &'a [f64],
    /// The place of the first number that moves among the values of an interval.
    first: usize,
    /// For each result the largest value that the step allows.
    sizes: Option<Vec<f64>>,
}

impl<'a> Hidden<'a> {
    /// `count` curves come before the quantities of `bends` among the values.
    pub(crate) fn new((bends, slots): (&'a Bends, &'a [f64]), count: usize) -> Self {
        Self { bends, slots, first: count + bends.levels().len(), sizes: None }
    }

    /// Possible miss in an interval over the allowed one; 0 if it is not larger. The first interval
    /// is the whole step. If nothing is known, nothing is missed.
    pub(crate) fn wanting(&mut self, interval: &Interval) -> f64 {
        if self.bends.moved() == 0 || self.slots.is_empty() {
            return 0.0;
        }
        let bounds = self.bounds(interval, WITHIN);
        let size =
            |bound: &Taylor| bound.range().map_or(f64::INFINITY, |[a, b]| a.abs().max(b.abs()));
        let sizes = self.sizes.get_or_insert_with(|| bounds.iter().map(size).collect());
        let one = |(bound, size): (&Taylor, &f64)| {
            let over = BETWEEN * bound.largest(POINTS) / (MISSED * size);
            if over.is_finite() && over > 1.0 { over } else { 0.0 }
        };
        bounds.iter().zip(&*sizes).map(one).fold(0.0, f64::max)
    }

    /// The widest range of a nonlinear result in an interval, whatever hides in it; infinite if that
    /// is not known.
    pub(crate) fn width(&self, interval: &Interval) -> f64 {
        let width = |bound: &Taylor| bound.range().map_or(f64::INFINITY, |[low, high]| high - low);
        self.bounds(interval, -WITHIN).iter().map(width).fold(0.0, f64::max)
    }

    /// Bounds of the nonlinear results; ranges of numbers end this share of their width within.
    fn bounds(&self, interval: &Interval, within: f64) -> Vec<Taylor> {
        let moved = (0..self.bends.moved()).map(|k| way(&interval.of(self.first + k), within));
        self.bends.enclose(&moved.collect::<Vec<_>>(), self.slots)
    }
}

/// A number over an interval, as a polynomial through its points, by a variable from -1 to 1; its
/// range ends a share of its width `within`.
fn way(values: &[f64; POINTS], within: f64) -> Taylor {
    let coefficients = coefficients(values);
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    for value in values {
        (low, high) = (low.min(*value), high.max(*value));
    }
    let mut terms = [[0.0; 2]; POINTS];
    for (k, term) in terms.iter_mut().enumerate() {
        let (mut rest, mut binomial) = (0.0, 1.0);
        for (m, coefficient) in coefficients.iter().enumerate().skip(k + 1) {
            binomial *= m as f64 / (m - k) as f64;
            rest += binomial * coefficient.abs();
        }
        *term = [coefficients[k] - rest, coefficients[k] + rest];
    }
    let goes_one_way = values.is_sorted() || values.iter().rev().is_sorted();
    if goes_one_way {
        let inside = within * (high - low);
        terms[0] = [low + inside, high - inside];
    }
    Taylor::between(&terms)
}

#[cfg(test)]
mod tests {
    #![allow(
        clippy::unwrap_used,
        clippy::float_cmp,
        reason = "a test that cannot go on has failed; numbers that are given"
    )]

    use lptn_assembly::ThermalSystem;
    use lptn_network::{Bends, Item};

    use super::{Hidden, WITHIN, way};
    use crate::interval::{Interval, NODES};
    use crate::reading::Reading;

    fn near(found: f64, expected: f64) {
        assert!((found - expected).abs() <= 1e-12 * expected.abs().max(1.0), "{found} {expected}");
    }

    /// `x^m` has the terms `C(m, k) x^(m - k)` in `(x + h)^m`, which are largest at the ends.
    #[test]
    fn a_way_is_bounded_by_the_terms_of_its_polynomial() {
        let choose = |m: usize, k: usize| {
            (0..k).fold(1.0, |product, i| product * (m - i) as f64 / (i + 1) as f64)
        };
        for sign in [1.0, -1.0] {
            let exact = [3.0, -1.0, 0.5, 2.0, -0.25, 1.5, -4.0].map(|a: f64| sign * a);
            let values = NODES.map(|x| exact.iter().rev().fold(0.0, |sum, a| sum * x + a));
            let bounds = way(&values, WITHIN);
            for k in 0..7 {
                let most = (k..7).map(|m| choose(m, k) * exact[m].abs()).sum();
                near(bounds.largest(k), most);
            }
            assert!(bounds.largest(7) == 0.0);
            let [low, high] = bounds.range().unwrap();
            near(low, exact[0] - 9.25);
            near(high, exact[0] + 9.25);
        }
    }

    /// A number that moves one way stays between its ends, and ends a part in 1e9 within.
    #[test]
    fn a_way_in_one_direction_stays_between_its_ends() {
        for sign in [1.0, -1.0] {
            let values = NODES.map(|x| 30.0 + sign * (100.0 * x + 10.0 * x * x));
            let bounds = way(&values, WITHIN);
            let [low, high] = bounds.range().unwrap();
            let ends = if sign > 0.0 { [-60.0, 140.0] } else { [-80.0, 120.0] };
            assert!((low - ends[0] - 2e-7).abs() < 1e-11 && (high - ends[1] + 2e-7).abs() < 1e-11);
            near(bounds.largest(1), 120.0);
        }
    }

    /// The bends in a report over the temperature of a node, with their slots.
    fn bends_of(report: &str) -> (Bends, Vec<f64>) {
        let text = format!(
            "format = 1\n[node]\nbody = {{ C = \"1 J/K\", T0 = \"400 K\" }}\n[boundary]\nair = {{ T = \
             \"300 K\" }}\n[resistor]\nskin = {{ from = \"body\", to = \"air\", R = \"1 K/W\" \
             }}\n[run]\nstop = \"1 s\"\nreport = {{ over = \"{report}\" }}\n"
        );
        let netlist = lptn_netlist::parse("hidden.toml", &text).unwrap();
        let network = &netlist.network;
        let bends = network.bends(network.report_ids().map(Item::Report));
        let system = ThermalSystem::assemble(network).unwrap();
        let mut reading = Reading::new(&system);
        reading.place(&mut system.workspace(), (0.0, 0.0)).unwrap();
        let slots = bends.slots(&mut reading.scope);
        (bends, slots)
    }

    /// An interval in which a temperature goes from one value to another, after `count` curves.
    fn interval(count: usize, middle: f64, half: f64) -> Interval {
        let values = NODES.map(|x| {
            let curves = (0..count).map(|k| 7e5 * x.powi(k as i32 + 2));
            curves.chain([middle + half * x]).collect()
        });
        Interval { from: 0.0, to: 1.0, values }
    }

    /// The eighth power of `a + b x` has the term `8 (a + b x) b^7` of order 7 and the size
    /// `(a + b)^8`; 0.05 of that term may be missed, and 1e-7 of the size is allowed.
    #[test]
    fn what_may_be_missed_is_measured_by_what_is_allowed() {
        let (bends, slots) = bends_of("(kelvin(body.T) / 1 [K])^8");
        assert_eq!((bends.moved(), bends.levels().len()), (1, 0));
        let over = |b: f64, size: f64| {
            0.05 * 8.0 * b.powi(7) * (400.0 + b) / (1e-7 * (400.0 + size).powi(8))
        };
        let at_one = 400.0 * (0.4e7_f64).powf(-1.0 / 7.0);
        for count in [0, 1, 3] {
            for half in [0.5 * at_one, 1.3 * at_one, -1.3 * at_one, 2.0 * at_one, 100.0] {
                let found =
                    Hidden::new((&bends, &slots), count).wanting(&interval(count, 400.0, half));
                let expected = over(half.abs(), half.abs());
                let expected = if expected > 1.0 { expected } else { 0.0 };
                assert!((found - expected).abs() <= 1e-6 * expected, "{half}: {found} {expected}");
            }
        }
        // in a part, the largest value of the whole step counts
        let mut hidden = Hidden::new((&bends, &slots), 0);
        hidden.wanting(&interval(0, 400.0, 200.0));
        let found = hidden.wanting(&interval(0, 400.0, 100.0));
        assert!((found / over(100.0, 200.0) - 1.0).abs() < 1e-6, "{found}");
    }

    /// A seventh power has a term of order 7, a sixth has none.
    #[test]
    fn nothing_hides_in_what_seven_points_tell() {
        for (report, hides) in
            [("(kelvin(body.T) / 1 [K])^6", false), ("(kelvin(body.T) / 1 [K])^9", true)]
        {
            let (bends, slots) = bends_of(report);
            let found = Hidden::new((&bends, &slots), 0).wanting(&interval(0, 400.0, 300.0));
            assert_eq!(found > 0.0, hides, "{report}: {found}");
        }
        let nothing = Bends::default();
        assert!(Hidden::new((&nothing, &[]), 0).wanting(&interval(0, 400.0, 300.0)) == 0.0);
        let (bends, _) = bends_of("(kelvin(body.T) / 1 [K])^9");
        assert!(Hidden::new((&bends, &[]), 0).wanting(&interval(0, 400.0, 300.0)) == 0.0);
    }
}

#[cfg(test)]
mod several_tests;
