//! The course of one quantity over a stretch in which all inputs are straight lines: a sum of
//! exponentials and a straight line, whose extremes and crossings are found to rounding.

/// What was seen of a quantity over a run, in SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CourseSeen {
    /// Its last value.
    pub last: f64,
    /// Its least value.
    pub min: f64,
    /// Its largest value.
    pub max: f64,
    /// Its integral over time.
    pub integral: f64,
    /// For how long it was above zero, in s.
    pub positive: f64,
}

impl CourseSeen {
    pub(crate) const NOTHING: Self = Self {
        last: f64::NAN,
        min: f64::INFINITY,
        max: f64::NEG_INFINITY,
        integral: 0.0,
        positive: 0.0,
    };

    fn take_in(&mut self, value: f64) {
        self.min = self.min.min(value);
        self.max = self.max.max(value);
    }
}

/// `p + q s + sum of e_k exp(-r_k s)` for `s` from 0 to `length`.
#[derive(Clone, Debug)]
pub(crate) struct Course<'a> {
    pub(crate) p: f64,
    pub(crate) q: f64,
    pub(crate) e: &'a [f64],
    pub(crate) rates: &'a [f64],
    pub(crate) length: f64,
}

/// Steps of one length: behind so many of them a mode that is faster than they are is gone.
const STEPS: usize = 12;

/// Of the fastest mode a step is this part of its time constant at first.
const FIRST: f64 = 0.5;

/// Steps towards a zero.
const MOST_NEWTON: usize = 60;

/// A point of a course: where, value and slope.
type Point = (f64, f64, f64);

impl Course<'_> {
    fn at(&self, s: f64) -> Point {
        let (mut value, mut slope) = (self.p + self.q * s, self.q);
        for (e, rate) in self.e.iter().zip(self.rates) {
            let part = e * (-rate * s).exp();
            value += part;
            slope -= rate * part;
        }
        (s, value, slope)
    }

    /// Whether it never turns: every part of the slope has one sign.
    fn is_monotonic(&self) -> bool {
        let up = |x: f64| x >= 0.0;
        let down = |x: f64| x <= 0.0;
        (up(self.q) && self.e.iter().all(|e| down(*e)))
            || (down(self.q) && self.e.iter().all(|e| up(*e)))
    }

    /// Takes the stretch in. `ends` are the exponentials at its end.
    pub(crate) fn see(&self, ends: &[f64], seen: &mut CourseSeen) {
        let sum = |of: &dyn Fn(usize) -> f64| -> f64 { (0..self.e.len()).map(of).sum() };
        let first = self.p + sum(&|k| self.e[k]);
        let slope = self.q - sum(&|k| self.e[k] * self.rates[k]);
        let value = self.p + self.q * self.length + sum(&|k| self.e[k] * ends[k]);
        let end = self.q - sum(&|k| self.e[k] * self.rates[k] * ends[k]);
        let decays = sum(&|k| -self.e[k] * (-self.rates[k] * self.length).exp_m1() / self.rates[k]);
        seen.integral += self.p * self.length + 0.5 * self.q * self.length * self.length + decays;
        seen.last = value;
        seen.take_in(first);
        seen.take_in(value);
        let (begin, end) = ((0.0, first, slope), (self.length, value, end));
        if self.is_monotonic() {
            seen.positive += self.positive(begin, end);
        } else {
            self.step_by_step(begin, end, seen);
        }
    }

    /// Looks at steps that grow with the time constants of what is left.
    fn step_by_step(&self, begin: Point, end: Point, seen: &mut CourseSeen) {
        let fastest = self.rates.iter().copied().fold(0.0, f64::max);
        let mut step = (FIRST / fastest).min(self.length / STEPS as f64);
        let mut decay: Vec<f64> = self.e.to_vec();
        let mut factors = vec![0.0; decay.len()];
        let (mut from, mut at) = (begin, 0.0);
        while at + step < self.length {
            for (factor, rate) in factors.iter_mut().zip(self.rates) {
                *factor = (-rate * step).exp();
            }
            for _ in 0..STEPS {
                if at + step >= self.length {
                    break;
                }
                at += step;
                let (mut value, mut slope) = (self.p + self.q * at, self.q);
                for ((part, factor), rate) in decay.iter_mut().zip(&factors).zip(self.rates) {
                    *part *= factor;
                    value += *part;
                    slope -= rate * *part;
                }
                self.piece(from, (at, value, slope), seen);
                from = (at, value, slope);
            }
            step = (2.0 * step).min(self.length / STEPS as f64);
        }
        self.piece(from, end, seen);
    }

    /// Takes in a step, which turns once at most.
    fn piece(&self, from: Point, to: Point, seen: &mut CourseSeen) {
        seen.take_in(from.1);
        if (from.2 > 0.0) == (to.2 > 0.0) {
            seen.positive += self.positive(from, to);
            return;
        }
        let turn = self.at(self.zero((from.0, to.0), from.2 > 0.0, &|s| {
            let curvature: f64 = self
                .e
                .iter()
                .zip(self.rates)
                .map(|(e, rate)| e * rate * rate * (-rate * s).exp())
                .sum();
            (self.at(s).2, curvature)
        }));
        seen.take_in(turn.1);
        seen.positive += self.positive(from, turn) + self.positive(turn, to);
    }

    /// For how long it is above zero between two points between which it does not turn.
    fn positive(&self, from: Point, to: Point) -> f64 {
        let length = to.0 - from.0;
        match (from.1 > 0.0, to.1 > 0.0) {
            (true, true) => length,
            (false, false) => 0.0,
            (above, _) => {
                let zero = self.zero((from.0, to.0), above, &|s| {
                    let (_, value, slope) = self.at(s);
                    (value, slope)
                });
                if above { zero - from.0 } else { to.0 - zero }
            }
        }
    }

    /// Where a function that begins above zero, or below it, passes it: Newton's method inside an
    /// interval that shrinks.
    fn zero(
        &self,
        (mut low, mut high): (f64, f64),
        above: bool,
        of: &dyn Fn(f64) -> (f64, f64),
    ) -> f64 {
        let mut s = 0.5 * (low + high);
        for _ in 0..MOST_NEWTON {
            let (value, slope) = of(s);
            if (value > 0.0) == above {
                low = s
            } else {
                high = s
            }
            let newton = s - value / slope;
            let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
            if (next - s).abs() <= 4.0 * f64::EPSILON * self.length {
                return next;
            }
            s = next;
        }
        s
    }
}

#[cfg(test)]
mod tests {
    use super::{Course, CourseSeen};

    /// exp(-s) - exp(-10 s) has its top at ln(10)/9; with -0.3 it is above zero between two roots
    /// (mpmath: findroot to 30 digits).
    #[test]
    fn a_pulse_that_rises_and_falls() {
        let (e, rates) = ([1.0, -1.0], [1.0, 10.0]);
        let course = Course { p: -0.3, q: 0.0, e: &e, rates: &rates, length: 5.0 };
        let ends = rates.map(|rate: f64| (-rate * 5.0).exp());
        let mut seen = CourseSeen::NOTHING;
        course.see(&ends, &mut seen);
        let top = 10.0_f64.ln() / 9.0;
        assert!((seen.max - ((-top).exp() - (-10.0 * top).exp() - 0.3)).abs() < 1e-15);
        assert!((seen.min - -0.3).abs() < 1e-15);
        let integral = -1.5 + (1.0 - ends[0]) - 0.1 * (1.0 - ends[1]);
        assert!((seen.integral - integral).abs() < 1e-14);
        assert!((seen.positive - 1.162_277_366_333_314).abs() < 1e-14);
    }
}
