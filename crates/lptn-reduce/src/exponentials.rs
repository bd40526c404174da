//! Sums of falling exponentials, and their total rise.

/// `sum of w_i exp(-t / tau_i)`, after a jump from 0 at time 0: the difference of two step
/// responses that end at the same rise.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Exponentials {
    /// Weights and rates in 1/s, the slowest first.
    terms: Vec<(f64, f64)>,
}

/// The variation of a curve from 0 to infinite time.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Variation {
    /// Sum of all its rises, which equals that of all its falls.
    pub(crate) rises: f64,
    /// Upper bound of further rises, in extremes too close to be found; 0 if it is proven that
    /// there are no others.
    pub(crate) missed: f64,
    /// Times of its extremes, ascending.
    pub(crate) turns: Vec<f64>,
}

/// Points in a decade of time of the first search.
const PER_DECADE: f64 = 60.0;

/// Extremes in an interval that can add no more than this share of the rises are not searched for.
const ENOUGH: f64 = 1e-6;

/// Rises below this share of the weights are rounding.
const SMALLEST: f64 = 1e-6;

/// Greatest number of halvings of an interval between two points.
const DEEPEST: u32 = 12;

impl Exponentials {
    /// From weights and time constants in s.
    pub(crate) fn new(terms: impl Iterator<Item = (f64, f64)>) -> Self {
        let falls = |&(weight, tau): &(f64, f64)| weight != 0.0 && tau > 0.0;
        let mut terms: Vec<(f64, f64)> =
            terms.filter(falls).map(|(weight, tau)| (weight, tau.recip())).collect();
        terms.sort_by(|a, b| a.1.total_cmp(&b.1));
        // equal rates make one term, or none: two equal networks have no difference
        terms.dedup_by(|next, first| {
            let same = next.1.total_cmp(&first.1).is_eq();
            if same {
                first.0 += next.0;
            }
            same
        });
        terms.retain(|term| term.0 != 0.0);
        Self { terms }
    }

    /// The value after the jump.
    pub(crate) fn value(&self, time: f64) -> f64 {
        self.sum(time, |_| 1.0)
    }

    /// Its derivative.
    pub(crate) fn slope(&self, time: f64) -> f64 {
        self.sum(time, |rate| -rate)
    }

    fn sum(&self, time: f64, factor: impl Fn(f64) -> f64) -> f64 {
        self.terms.iter().map(|&(w, rate)| w * factor(rate) * (-rate * time).exp()).sum()
    }

    /// Upper bound of its third derivative's size between two times: the parts of either sign fall,
    /// so that their values at the two ends enclose it.
    fn third(&self, (a, b): (f64, f64)) -> f64 {
        let part = |sign: f64, time: f64| -> f64 {
            let one = self.terms.iter().filter(|term| term.0 * sign > 0.0);
            one.map(|&(w, rate)| w.abs() * rate.powi(3) * (-rate * time).exp()).sum()
        };
        let (rise, fall) = ([part(1.0, a), part(1.0, b)], [part(-1.0, a), part(-1.0, b)]);
        (rise[0] - fall[1]).abs().max((rise[1] - fall[0]).abs())
    }

    /// Number of changes of sign of the weights in the order of their rates. The derivative has no
    /// more zeros: Descartes' rule, which applies to sums of exponentials (E. N. Laguerre, J. Math.
    /// Pures Appl. 9 (1883) 99; G. Polya, G. Szego, Problems and Theorems in Analysis II, part V,
    /// problem 77).
    pub(crate) fn most_turns(&self) -> usize {
        self.terms.windows(2).filter(|pair| pair[0].0 * pair[1].0 < 0.0).count()
    }

    /// Times from long before the fastest to long after the slowest term.
    pub(crate) fn times(&self) -> Vec<f64> {
        let (Some(slow), Some(fast)) = (self.terms.first(), self.terms.last()) else {
            return Vec::new();
        };
        let (from, to) = ((1e-6 / fast.1).log10(), (50.0 / slow.1).log10());
        let mut times = Vec::new();
        let mut k = 0.0;
        while from + k / PER_DECADE <= to {
            times.push(10_f64.powf(from + k / PER_DECADE));
            k += 1.0;
        }
        times
    }

    /// Its rises, with all its extremes or a bound on what others could add.
    pub(crate) fn variation(&self) -> Variation {
        let times = self.times();
        let points: Vec<(f64, f64)> = times.iter().map(|&time| (time, self.slope(time))).collect();
        let mut found = Search { curve: self, turns: Vec::new(), missed: 0.0, enough: 0.0 };
        points.windows(2).for_each(|pair| found.turn(pair[0], pair[1]));
        // zeros that are still hidden come in pairs
        if found.turns.len() + 2 <= self.most_turns() {
            let size: f64 = self.terms.iter().map(|term| term.0.abs()).sum();
            found.enough = ENOUGH * self.coarse(&times).max(SMALLEST * size);
            found.turns.clear();
            points.windows(2).for_each(|pair| found.look((pair[0], pair[1]), 0));
        }
        let missed = if found.turns.len() + 2 <= self.most_turns() { found.missed } else { 0.0 };
        let turns = found.turns;
        let mut levels = vec![0.0, self.value(0.0)];
        levels.extend(turns.iter().map(|&turn| self.value(turn)));
        levels.push(0.0);
        let rises = levels.windows(2).map(|pair| (pair[1] - pair[0]).max(0.0)).sum();
        Variation { rises, missed, turns }
    }

    /// Its rises from samples at these times only.
    pub(crate) fn coarse(&self, times: &[f64]) -> f64 {
        let (mut last, mut rises) = (0.0, 0.0);
        for value in [0.0].iter().chain(times).map(|&time| self.value(time)).chain([0.0]) {
            rises += f64::max(value - last, 0.0);
            last = value;
        }
        rises
    }
}

struct Search<'a> {
    curve: &'a Exponentials,
    turns: Vec<f64>,
    /// Bound on rises in the intervals that may contain more turns.
    missed: f64,
    /// Acceptable bound of one interval.
    enough: f64,
}

impl Search<'_> {
    /// The turn between two points at which the slope is known, if its sign changes.
    fn turn(&mut self, a: (f64, f64), b: (f64, f64)) {
        if a.1 * b.1 < 0.0 || (b.1 == 0.0 && a.1 != 0.0) {
            self.turns.push(self.zero(a, b));
        }
    }

    /// Searches for turns between two points.
    ///
    /// Linear interpolation over the width w is off by at most `w^2/8` times the second derivative
    /// of the slope. If the line through the ends is farther from zero than that, there is no turn.
    /// Else the interval is halved while it matters.
    fn look(&mut self, (a, b): ((f64, f64), (f64, f64)), depth: u32) {
        let width = b.0 - a.0;
        let sag = width * width / 8.0 * self.curve.third((a.0, b.0));
        let least = if a.1 * b.1 < 0.0 { 0.0 } else { a.1.abs().min(b.1.abs()) };
        let missed = width * (sag - least).max(0.0);
        if missed <= self.enough || depth == DEEPEST {
            self.turn(a, b);
            self.missed += missed;
            return;
        }
        let time = 0.5 * (a.0 + b.0);
        let middle = (time, self.curve.slope(time));
        self.look((a, middle), depth + 1);
        self.look((middle, b), depth + 1);
    }

    fn zero(&self, mut a: (f64, f64), mut b: (f64, f64)) -> f64 {
        for _ in 0..60 {
            let time = 0.5 * (a.0 + b.0);
            let slope = self.curve.slope(time);
            if slope * a.1 > 0.0 { a = (time, slope) } else { b = (time, slope) }
        }
        0.5 * (a.0 + b.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `exp(-t) - exp(-q t)`: one extreme, of the size `q^(-1/(q-1)) - q^(-q/(q-1))`.
    #[test]
    fn two_exponentials_have_one_turn() {
        for q in [0.3_f64, 3.0, 500.0] {
            let curve = Exponentials::new([(1.0, 1.0), (-1.0, 1.0 / q)].into_iter());
            let found = curve.variation();
            let size = (q.powf(-1.0 / (q - 1.0)) - q.powf(-q / (q - 1.0))).abs();
            assert!((found.rises / size - 1.0).abs() < 1e-12, "{q}: {found:?}");
            assert!((found.turns[0] / (q.ln() / (q - 1.0)) - 1.0).abs() < 1e-9, "{found:?}");
            assert!(found.missed == 0.0 && found.turns.len() == 1);
        }
    }

    /// Two extremes as close as the coefficients allow: the derivative of `(x - a)(x - b)` in x =
    /// exp(-t), with a and b apart by 1e-5, far below the first search.
    #[test]
    fn a_pair_of_close_turns_is_found_or_bounded() {
        for apart in [1e-2, 1e-4, 1e-5] {
            let (a, b) = (0.5, 0.5 + apart);
            // slope: -x (x - a)(x - b) = -x^3 + (a + b) x^2 - a b x
            let weights = [(a * b, 1.0), (-(a + b) / 2.0, 0.5), (1.0 / 3.0, 1.0 / 3.0)];
            let curve = Exponentials::new(weights.into_iter());
            let found = curve.variation();
            // between the two the curve rises by apart^3 / 6
            let jump: f64 = weights.iter().map(|w| w.0).sum();
            let rise = jump + apart.powi(3) / 6.0;
            assert!(found.rises <= rise * (1.0 + 1e-12), "{apart}: {found:?}");
            assert!(found.rises + found.missed >= rise * (1.0 - 1e-12), "{apart}: {found:?}");
            assert!(found.missed <= 1e-3 * rise);
        }
    }

    /// The only rise of a falling curve is its jump at the start.
    #[test]
    fn a_jump_counts_as_a_rise() {
        let curve = Exponentials::new([(2.0, 3.0)].into_iter());
        let found = curve.variation();
        assert!((found.rises - 2.0).abs() < 1e-15 && found.turns.is_empty(), "{found:?}");
        let curve = Exponentials::new([(-2.0, 3.0)].into_iter());
        assert!((curve.variation().rises - 2.0).abs() < 1e-15);
        let twice = [(0.3, 7.0), (0.2, 1.0), (-0.2, 1.0), (-0.3, 7.0)];
        assert_eq!(Exponentials::new(twice.into_iter()), Exponentials::default());
        assert_eq!(Exponentials::default().variation().rises.to_bits(), 0.0_f64.to_bits());
    }
}
