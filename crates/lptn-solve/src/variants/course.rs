//! The time history of one quantity over a stretch in which all inputs are straight lines: a sum of
//! exponentials and a straight line, whose extremes and crossings are found to rounding.

/// Results of a quantity over a run, in SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CourseSeen {
    /// Its last value.
    pub last: f64,
    /// Its least value.
    pub min: f64,
    /// Its largest value.
    pub max: f64,
    /// Its integral over time, if it was requested.
    pub integral: f64,
    /// Time in s for which it was above zero.
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

/// Requested results of a quantity; its end is always included.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Look {
    /// Nothing more.
    End,
    /// Its integral.
    Integral,
    /// Its extremes and the time for which it is above zero.
    Extremes,
}

/// `p + q s + sum of e_k exp(-r_k s)` for `s` from 0 to `length`, slowest rate first.
#[derive(Clone, Debug)]
pub(crate) struct Course<'a> {
    pub(crate) p: f64,
    pub(crate) q: f64,
    pub(crate) e: &'a [f64],
    pub(crate) rates: &'a [f64],
    pub(crate) length: f64,
}

/// Data shared by all quantities of a stretch.
#[derive(Clone, Debug, Default)]
pub(crate) struct Stretch {
    /// Remaining share of each mode at its end.
    pub(crate) ends: Vec<f64>,
    /// Integral over the stretch of each mode from a start of 1, in s.
    pub(crate) lost: Vec<f64>,
    /// Remaining share of each mode after a step of each length, as far as such steps were taken.
    factors: Vec<f64>,
}

impl Stretch {
    /// Begins with a stretch of this length in s. `integrated`: integrals are requested.
    pub(crate) fn begin(&mut self, rates: &[f64], length: f64, integrated: bool) {
        self.factors.clear();
        self.ends.clear();
        self.ends.extend(rates.iter().map(|rate| (-rate * length).exp()));
        self.lost.clear();
        match integrated {
            true => self.lost.extend(rates.iter().map(|rate| -(-rate * length).exp_m1() / rate)),
            false => self.lost.resize(rates.len(), 0.0),
        }
    }

    /// Remaining shares of the modes after steps of the `level`-th length; `doubled`: they are
    /// twice as long as those before them.
    fn factors(&mut self, level: usize, (rates, step): (&[f64], f64), doubled: bool) -> &[f64] {
        let (place, n) = (level * rates.len(), rates.len());
        if self.factors.len() <= place && doubled {
            // ten doublings cost 1000 roundings: negligible next to the required accuracy
            self.factors.extend_from_within(place - n..place);
            self.factors[place..].iter_mut().for_each(|factor| *factor *= *factor);
        } else if self.factors.len() <= place {
            self.factors.extend(rates.iter().map(|rate| (-rate * step).exp()));
        }
        &self.factors[place..place + n]
    }
}

/// Steps of one length.
const STEPS: usize = 4;

/// Most halvings of a step that may turn twice.
const HALVES: usize = 6;

/// The first step over the time constant of the fastest mode.
const FIRST: f64 = 0.5;

/// A turn is found to this share of a step: the error of the value is the square of that.
const TURNED: f64 = 1e-8;

/// Steps towards a zero.
const MOST_NEWTON: usize = 60;

/// A point of the time history: time in s from the start, value and slope.
type Point = (f64, f64, f64);

impl Course<'_> {
    /// Value, slope and curvature.
    fn at(&self, s: f64) -> [f64; 3] {
        let (mut value, mut slope, mut curvature) = (self.p + self.q * s, self.q, 0.0);
        for (e, rate) in self.e.iter().zip(self.rates) {
            let part = e * (-rate * s).exp();
            value += part;
            slope -= rate * part;
            curvature += rate * rate * part;
        }
        [value, slope, curvature]
    }

    /// True if it does not turn any more when the modes are at `parts`. The slope is
    /// `q - sum of r_k e_k exp(-r_k s)`: with its sums from the slowest part on, it is a sum of those
    /// times differences of exponentials that are not negative (Abel's summation), so it keeps its
    /// sign if they all have one.
    fn is_monotonic(&self, parts: &[f64]) -> bool {
        let (mut sum, mut least, mut most) = (self.q, self.q, self.q);
        for (part, rate) in parts.iter().zip(self.rates) {
            sum -= rate * part;
            (least, most) = (least.min(sum), most.max(sum));
        }
        least >= 0.0 || most <= 0.0
    }

    /// Takes in the stretch.
    pub(crate) fn see(&self, stretch: &mut Stretch, look: Look, seen: &mut CourseSeen) {
        let (mut first, mut slope) = (self.p, self.q);
        let (mut value, mut end_slope) = (self.p + self.q * self.length, self.q);
        let mut integral = self.p * self.length + 0.5 * self.q * self.length * self.length;
        for (k, &e) in self.e.iter().enumerate() {
            first += e;
            slope -= e * self.rates[k];
            value += e * stretch.ends[k];
            end_slope -= e * self.rates[k] * stretch.ends[k];
            integral += e * stretch.lost[k];
        }
        seen.integral += integral;
        seen.last = value;
        seen.take_in(first);
        seen.take_in(value);
        if look == Look::Extremes {
            let (begin, end) = ((0.0, first, slope), (self.length, value, end_slope));
            match self.is_monotonic(self.e) {
                true => seen.positive += self.positive(begin, end),
                false => self.step_by_step((begin, end), stretch, seen),
            }
        }
    }

    /// Evaluates steps that grow with the time constants that remain, until it turns no more.
    fn step_by_step(
        &self,
        (begin, end): (Point, Point),
        stretch: &mut Stretch,
        seen: &mut CourseSeen,
    ) {
        let fastest = self.rates.last().copied().unwrap_or(1.0);
        let mut step = (FIRST / fastest).min(self.length / STEPS as f64);
        let mut parts: Vec<f64> = self.e.to_vec();
        let (mut from, mut at, mut level, mut doubled) = (begin, 0.0, 0, false);
        while at + step < self.length && !self.is_monotonic(&parts) {
            let factors = stretch.factors(level, (self.rates, step), doubled);
            for _ in 0..STEPS {
                if at + step >= self.length {
                    break;
                }
                at += step;
                let (sum, lost) = decay(&mut parts, factors, self.rates);
                let to = (at, self.p + self.q * at + sum, self.q - lost);
                self.piece(from, to, seen);
                from = to;
            }
            doubled = 2.0 * step <= self.length / STEPS as f64;
            step = (2.0 * step).min(self.length / STEPS as f64);
            level += 1;
        }
        self.piece(from, end, seen);
    }

    /// Takes in a step, in halves if it may turn twice.
    fn piece(&self, from: Point, to: Point, seen: &mut CourseSeen) {
        self.halved(from, to, HALVES, seen);
    }

    fn halved(&self, from: Point, to: Point, left: usize, seen: &mut CourseSeen) {
        seen.take_in(from.1);
        if (from.2 > 0.0) == (to.2 > 0.0) {
            if left == 0 || goes_one_way(from, to) {
                seen.positive += self.positive(from, to);
                return;
            }
            let at = 0.5 * (from.0 + to.0);
            let [value, slope, _] = self.at(at);
            self.halved(from, (at, value, slope), left - 1, seen);
            self.halved((at, value, slope), to, left - 1, seen);
            return;
        }
        let ends = (from.0, to.0);
        let enough = TURNED * (to.0 - from.0);
        let guess = between(ends, (from.2, to.2));
        let (at, [value, slope, _]) = self.zero(1, (ends, guess, enough), from.2 > 0.0);
        let turn = (at, value, slope);
        seen.take_in(value);
        seen.positive += self.positive(from, turn) + self.positive(turn, to);
    }

    /// Time in s for which it is above zero between two points without a turn between them.
    fn positive(&self, from: Point, to: Point) -> f64 {
        let length = to.0 - from.0;
        match (from.1 > 0.0, to.1 > 0.0) {
            (true, true) => length,
            (false, false) => 0.0,
            (above, _) => {
                let ends = (from.0, to.0);
                let guess = between(ends, (from.1, to.1));
                let enough = 4.0 * f64::EPSILON * self.length;
                let (zero, _) = self.zero(0, (ends, guess, enough), above);
                if above { zero - from.0 } else { to.0 - zero }
            }
        }
    }

    /// The zero of the value (`of` 0) or the slope (1) that begins above it, or below, to `enough`:
    /// Newton's method inside an interval that shrinks. Also the values there.
    fn zero(
        &self,
        of: usize,
        ((mut low, mut high), guess, enough): ((f64, f64), f64, f64),
        above: bool,
    ) -> (f64, [f64; 3]) {
        let mut s = guess;
        let mut found = self.at(s);
        for _ in 0..MOST_NEWTON {
            if (found[of] > 0.0) == above {
                low = s
            } else {
                high = s
            }
            let newton = s - found[of] / found[of + 1];
            let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
            if (next - s).abs() <= enough {
                return (next, found);
            }
            s = next;
            found = self.at(s);
        }
        (s, found)
    }
}

/// True if the cubic through both points with their slopes, which have one sign, does not turn
/// between them (F. N. Fritsch and R. E. Carlson, SIAM J. Numer. Anal. 17 (1980) 238: it does not
/// if neither slope is more than three times that of the chord).
fn goes_one_way(from: Point, to: Point) -> bool {
    let three = 3.0 * (to.1 - from.1) / (to.0 - from.0);
    match three > 0.0 {
        true => (0.0..=three).contains(&from.2) && (0.0..=three).contains(&to.2),
        false => (three..=0.0).contains(&from.2) && (three..=0.0).contains(&to.2),
    }
}

/// Advances parts by a step: returns their sum, and their loss per second. It uses four partial
/// sums, for one would wait for every addition.
fn decay(parts: &mut [f64], factors: &[f64], rates: &[f64]) -> (f64, f64) {
    const LANES: usize = 4;
    let (mut sum, mut lost) = ([0.0; LANES], [0.0; LANES]);
    let (chunks, tail) = parts.as_chunks_mut::<LANES>();
    let (factors, factors_tail) = factors.as_chunks::<LANES>();
    let (rates, rates_tail) = rates.as_chunks::<LANES>();
    for ((part, factor), rate) in chunks.iter_mut().zip(factors).zip(rates) {
        for k in 0..LANES {
            part[k] *= factor[k];
            sum[k] += part[k];
            lost[k] += rate[k] * part[k];
        }
    }
    let (mut all, mut all_lost) = (sum.iter().sum::<f64>(), lost.iter().sum::<f64>());
    for ((part, factor), rate) in tail.iter_mut().zip(factors_tail).zip(rates_tail) {
        *part *= factor;
        all += *part;
        all_lost += rate * *part;
    }
    (all, all_lost)
}

/// The zero of the straight line between two values of different sign.
fn between((from, to): (f64, f64), (first, last): (f64, f64)) -> f64 {
    let share = first / (first - last);
    let share = if share > 0.0 && share < 1.0 { share } else { 0.5 };
    from + (to - from) * share
}

#[cfg(test)]
mod tests {
    use super::{Course, CourseSeen, Look, Stretch};

    /// exp(-s) - exp(-10 s) has its top at ln(10)/9; with -0.3 it is above zero between two roots
    /// (mpmath: findroot to 30 digits).
    #[test]
    fn a_pulse_that_rises_and_falls() {
        let (e, rates) = ([1.0, -1.0], [1.0, 10.0]);
        let course = Course { p: -0.3, q: 0.0, e: &e, rates: &rates, length: 5.0 };
        let mut stretch = Stretch::default();
        stretch.begin(&rates, 5.0, true);
        let mut seen = CourseSeen::NOTHING;
        course.see(&mut stretch, Look::Extremes, &mut seen);
        let top = 10.0_f64.ln() / 9.0;
        assert!((seen.max - ((-top).exp() - (-10.0 * top).exp() - 0.3)).abs() < 1e-15);
        assert!((seen.min - -0.3).abs() < 1e-15);
        let integral = -1.5 + (1.0 - (-5.0_f64).exp()) - 0.1 * (1.0 - (-50.0_f64).exp());
        assert!((seen.integral - integral).abs() < 1e-14);
        assert!((seen.positive - 1.162_277_366_333_314).abs() < 1e-14);
    }
}
