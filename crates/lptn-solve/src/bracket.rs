//! The moment at which a quantity becomes positive, closed in between two times.
//!
//! The secant method in an interval that shrinks (N. Anderson, A. Björck, BIT 13 (1973) 253),
//! halved if that is slow.

/// Most evaluations for one moment.
const MOST_LOOKS: usize = 160;

/// Two times in s: at the first the quantity is not positive, at the second it is.
pub(crate) struct Bracket {
    times: [f64; 2],
    /// The quantity at both, made smaller at an end that stays.
    sides: [f64; 2],
    next: f64,
    last: Option<bool>,
    width: f64,
    looks: usize,
    enough: f64,
    /// The last of [`Bracket::reach`] in s.
    ahead: f64,
}

impl Bracket {
    /// Between two times in s with the quantity there; from a guess, until they are not further
    /// apart than `enough` in s unless rounding is more.
    pub(crate) fn new([before, after]: [(f64, f64); 2], guess: f64, enough: f64) -> Self {
        Self {
            times: [before.0, after.0],
            sides: [before.1, after.1],
            next: guess,
            last: None,
            width: after.0 - before.0,
            looks: 0,
            enough,
            ahead: 0.0,
        }
    }

    /// The same, started at the zero of a straight line, to the rounding of the time.
    pub(crate) fn straight(ends: [(f64, f64); 2]) -> Self {
        let mut bracket = Self::new(ends, 0.0, 0.0);
        bracket.next = bracket.zero();
        bracket
    }

    /// The time of the next evaluation; `None` if the two are close enough.
    pub(crate) fn next(&mut self) -> Option<f64> {
        let [a, b] = self.times;
        let least = self.enough.max(2.0 * f64::EPSILON * b.abs());
        if b - a <= least || self.sides[1] == 0.0 || self.looks == MOST_LOOKS {
            return None;
        }
        self.looks += 1;
        let slow = self.looks.is_multiple_of(3) && b - a > 0.5 * self.width;
        if self.looks.is_multiple_of(3) {
            // the gain of a halving does not count for the secants
            self.width = if slow { 0.5 * (b - a) } else { b - a };
        }
        if self.sides[0] == 0.0 {
            self.next = a + self.reach(least);
        }
        // a good guess is closed in from its other side
        Some(match self.next >= a && self.next <= b && !slow {
            true => self.next.clamp(a + 0.5 * least, b - 0.5 * least),
            false => a.midpoint(b),
        })
    }

    /// Distance of the next evaluation from a quantity that is zero by rounding, in s. A straight
    /// line does not show where it rises, so the distance grows every time.
    fn reach(&mut self, least: f64) -> f64 {
        self.ahead = if self.ahead == 0.0 { 0.5 * least } else { 8.0 * self.ahead };
        self.ahead
    }

    /// Takes the quantity at that time; returns true if it is positive.
    pub(crate) fn put(&mut self, time: f64, side: f64) -> bool {
        let passed = side > 0.0;
        let (near, far) = if passed { (1, 0) } else { (0, 1) };
        if self.last == Some(passed) {
            let share = 1.0 - side / self.sides[near];
            self.sides[far] *= if share > 0.0 { share } else { 0.5 };
        }
        (self.times[near], self.sides[near], self.last) = (time, side, Some(passed));
        self.next = self.zero();
        passed
    }

    /// The zero of a straight line through both.
    fn zero(&self) -> f64 {
        let ([a, b], [low, high]) = (self.times, self.sides);
        a + (b - a) * (low / (low - high))
    }
}

#[cfg(test)]
mod tests;
