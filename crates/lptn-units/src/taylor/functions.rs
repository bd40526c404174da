//! Functions of bounded functions, by the recurrences of their Taylor coefficients.
//!
//! Source: A. Griewank and A. Walther, Evaluating Derivatives, 2nd edition (SIAM 2008), table 13.2.

use super::interval::Interval;
use super::{Taylor, number};

impl Taylor {
    pub(super) fn reciprocal(self) -> Self {
        let first = self.value().reciprocal();
        Self::recurrence(first, self.orders, |k, terms| -(self.folded(k, terms, |_| 1.0) * first))
    }

    /// Exponential.
    #[must_use]
    pub fn exp(self) -> Self {
        self.of(Interval::rising(self.value(), f64::exp), |k, terms| {
            self.folded(k, terms, |j| j) * number(k).recip()
        })
    }

    pub(crate) fn ln(self) -> Self {
        if self.value().low <= 0.0 {
            return Self::unknown();
        }
        let over = self.value().reciprocal();
        self.of(self.value().rising(f64::ln), |k, terms| {
            let order = number(k);
            (self.terms[k] - self.folded(k, terms, |j| (order - j) / order)) * over
        })
    }

    pub(crate) fn sin(self) -> Self {
        self.circular()[0]
    }

    pub(crate) fn cos(self) -> Self {
        self.circular()[1]
    }

    /// Sine and cosine, whose derivatives are each other.
    fn circular(self) -> [Self; 2] {
        if self.is_unknown() {
            return [Self::rough(Interval::new(-1.0, 1.0)); 2];
        }
        let quarter = Interval::point(std::f64::consts::FRAC_PI_2);
        let values = [self.value().sin(), (self.value() + quarter).sin()];
        let mut pair = values.map(Self::flat);
        if self.degree == 0 {
            return pair;
        }
        for k in 1..=self.orders {
            let over = number(k).recip();
            let terms = pair.map(|one| self.folded(k, &one.terms, |j| j) * over);
            (pair[0].terms[k], pair[1].terms[k]) = (terms[1], -terms[0]);
        }
        pair.iter_mut().for_each(|one| (one.degree, one.orders) = (self.orders, self.orders));
        pair
    }

    pub(crate) fn tanh(self) -> Self {
        if self.is_unknown() {
            return Self::rough(Interval::new(-1.0, 1.0));
        }
        let one = Interval::point(1.0);
        self.of(self.value().rising(f64::tanh), |k, terms| {
            // its slope is 1 - tanh^2
            let mut slope = terms.map(|_| Interval::ZERO);
            for (i, term) in slope.iter_mut().enumerate().take(k) {
                let square = (0..=i).fold(Interval::ZERO, |sum, j| sum + terms[j] * terms[i - j]);
                *term = if i == 0 { one - terms[0].power(2) } else { -square };
            }
            self.folded(k, &slope, |j| j) * number(k).recip()
        })
    }

    /// A constant power. Unknown if the base may be negative and the exponent is not whole.
    #[must_use]
    pub fn power(self, exponent: f64) -> Self {
        if exponent.fract() == 0.0 && exponent.abs() <= 64.0 {
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "whole and at most 64"
            )]
            let whole = exponent.abs() as u32;
            let power = self.whole_power(whole);
            return if exponent < 0.0 { Self::constant(1.0) / power } else { power };
        }
        let Interval { low, high } = self.value();
        let power = |x: f64| x.powf(exponent);
        let first = if exponent < 0.0 {
            Interval::new(power(high), power(low))
        } else {
            self.value().rising(power)
        };
        if low > 0.0 {
            let over = self.value().reciprocal();
            return self.of(first, |k, terms| {
                let order = number(k);
                self.folded(k, terms, |j| (exponent * j - (order - j)) / order) * over
            });
        }
        match low == 0.0 && exponent > 0.0 {
            true => self.steep_at_zero(first),
            false => Self::unknown(),
        }
    }

    /// A power from zero on, which rises or falls as its base does, however steep.
    fn steep_at_zero(self, value: Interval) -> Self {
        let mut power = Self::rough(value);
        let slope = self.slope();
        if slope.low >= 0.0 {
            power.terms[1] = Interval { low: 0.0, ..Interval::ALL };
        } else if slope.high <= 0.0 {
            power.terms[1] = Interval { high: 0.0, ..Interval::ALL };
        }
        power
    }

    fn whole_power(self, exponent: u32) -> Self {
        if self.is_unknown() {
            return self;
        }
        let mut power = Self::constant(1.0);
        for _ in 0..exponent {
            power = power * self;
        }
        power.terms[0] = self.value().power(exponent);
        power
    }

    pub(crate) fn square_root(self) -> Self {
        self.power(0.5)
    }

    pub(crate) fn abs(self) -> Self {
        let value = self.value();
        if self.is_unknown() || value.low >= 0.0 {
            self
        } else if value.high <= 0.0 {
            -self
        } else {
            Self::rough(value.abs())
        }
    }

    /// The smaller of two.
    pub(crate) fn smaller(self, other: Self) -> Self {
        let (mine, theirs) = (self.value(), other.value());
        if self.is_unknown() || other.is_unknown() {
            Self::unknown()
        } else if mine.high <= theirs.low {
            self
        } else if theirs.high <= mine.low {
            other
        } else {
            Self::rough(Interval::new(mine.low.min(theirs.low), mine.high.min(theirs.high)))
        }
    }

    /// The larger of two.
    pub(crate) fn larger(self, other: Self) -> Self {
        -((-self).smaller(-other))
    }

    /// One of two; it is unknown which.
    pub(crate) fn either(self, other: Self) -> Self {
        if self.is_unknown() || other.is_unknown() {
            return Self::unknown();
        }
        Self::rough(self.value().hull(other.value()))
    }

    /// A function of this: a number where this is one.
    fn of(
        &self,
        first: Interval,
        next: impl Fn(usize, &[Interval; super::ORDERS]) -> Interval,
    ) -> Self {
        if self.is_unknown() {
            Self::unknown()
        } else if self.degree == 0 {
            Self::flat(first)
        } else {
            Self::recurrence(first, self.orders, next)
        }
    }
}
