//! Bounds on a function of one variable: on its values over an interval, and on its Taylor
//! coefficients at every point of it. They follow from the form of the function, not from samples,
//! so nothing can be hidden.
//!
//! Source: R. E. Moore, R. B. Kearfott, M. J. Cloud, Introduction to Interval Analysis (SIAM 2009),
//! chapter 9.2: automatic differentiation to higher order in interval arithmetic.

mod functions;
pub(crate) mod interval;

use std::ops::{Add, Div, Mul, Neg, Sub};

use interval::Interval;

/// Number of coefficients: the value, and derivatives to the ninth.
const ORDERS: usize = 10;

/// Bounds on `f(x)` for every x of an interval, and on `f'(x)`, `f''(x)/2!`, … for every x between
/// its ends.
///
/// ```
/// use lptn_units::Taylor;
///
/// // (x - 3)^2 from 2 to 5
/// let x = Taylor::variable(2.0, 5.0);
/// let square = (x + Taylor::constant(-3.0)).power(2.0);
/// assert_eq!(square.range(), Some([0.0, 4.0]));
/// assert_eq!((square.largest(2), square.largest(3)), (1.0, 0.0));
/// assert_eq!(square.degree(), 2);
/// ```
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Taylor {
    terms: [Interval; ORDERS],
    /// All terms after this one are zero …
    degree: usize,
    /// … up to this one; those after it are not known.
    orders: usize,
}

impl Taylor {
    /// The highest order with known bounds.
    pub const ORDER: usize = ORDERS - 1;

    /// A number.
    pub fn constant(value: f64) -> Self {
        Self::flat(Interval::point(value))
    }

    /// The variable itself, between two numbers.
    pub fn variable(from: f64, to: f64) -> Self {
        let mut variable = Self::flat(Interval::new(from, to));
        variable.terms[1] = Interval::point(1.0);
        variable.degree = 1;
        variable
    }

    /// A function whose value and Taylor coefficients are between these bounds at every point of an
    /// interval, from the value on; those that are not given are 0.
    pub fn between(terms: &[[f64; 2]]) -> Self {
        let mut all = Self::flat(Interval::ZERO);
        for (term, [low, high]) in all.terms.iter_mut().zip(terms) {
            *term = Interval::new(*low, *high);
        }
        all.degree = terms.len().saturating_sub(1).min(Self::ORDER);
        all
    }

    /// The same bounds on the value and the derivative, without those of higher orders: less to
    /// compute with.
    #[must_use]
    pub fn first_order(mut self) -> Self {
        self.orders = self.orders.min(1);
        self.degree = self.degree.min(1);
        self
    }

    /// Bounds on the Taylor coefficient of this order, up to [`Taylor::ORDER`].
    pub fn term(&self, order: usize) -> [f64; 2] {
        match self.terms.get(order) {
            Some(term) if order <= self.orders => [term.low, term.high],
            _ => [f64::NEG_INFINITY, f64::INFINITY],
        }
    }

    /// Bounds on the derivative.
    #[must_use]
    pub fn derivative(self) -> Self {
        let mut derivative = Self::flat(self.terms[1]);
        derivative.orders = self.orders.saturating_sub(1);
        derivative.degree = self.degree.saturating_sub(1).min(derivative.orders);
        for k in 1..=derivative.degree {
            derivative.terms[k] = self.terms[k + 1] * number(k + 1);
        }
        derivative
    }

    /// Bounds on a function with this derivative and the values of `value`.
    #[must_use]
    pub fn integral(self, value: Self) -> Self {
        let mut integral = Self::flat(value.terms[0]);
        if integral.is_unknown() || self.is_unknown() {
            return Self::rough(integral.terms[0]);
        }
        integral.orders = (self.orders + 1).min(Self::ORDER);
        integral.degree = (self.degree + 1).min(integral.orders);
        for k in 1..=integral.degree {
            integral.terms[k] = self.terms[k - 1] * number(k).recip();
        }
        integral
    }

    /// A part of the straight path from one number to another: both as shares of it, from 0 to 1.
    /// It has bounds on the value and the derivative, no others.
    pub(crate) fn on_way([from, to]: [f64; 2], [first, last]: [f64; 2]) -> Self {
        let [a, b] = [first, last].map(|share| from + share * (to - from));
        let mut way = Self::flat(Interval::new(a.min(b), a.max(b)));
        if from.to_bits() != to.to_bits() {
            way.terms[1] = Interval::point(to - from);
            way.degree = 1;
        }
        way.orders = 1;
        way
    }

    /// Bounds on the derivative.
    pub(crate) fn slope(&self) -> Interval {
        self.terms[1]
    }

    /// A number with known bounds.
    fn flat(value: Interval) -> Self {
        let mut terms = [Interval::ZERO; ORDERS];
        terms[0] = value;
        let flat = Self { terms, degree: 0, orders: Self::ORDER };
        if value == Interval::ALL { Self::rough(value) } else { flat }
    }

    /// A function that has a kink, a jump or an end: only its values are bounded.
    pub(crate) fn rough(value: Interval) -> Self {
        let mut terms = [Interval::ALL; ORDERS];
        terms[0] = value;
        Self { terms, degree: Self::ORDER, orders: Self::ORDER }
    }

    /// Nothing is known: the function may not even have a value everywhere.
    pub(crate) fn unknown() -> Self {
        Self::rough(Interval::ALL)
    }

    pub(crate) fn value(&self) -> Interval {
        self.terms[0]
    }

    fn is_unknown(&self) -> bool {
        self.terms[0] == Interval::ALL
    }

    /// The smallest and largest value it may take; `None` if that is not known, or it may have
    /// none.
    pub fn range(&self) -> Option<[f64; 2]> {
        self.value().is_bounded().then(|| [self.value().low, self.value().high])
    }

    /// A bound on the absolute value of `1/order!` times the derivative of this order, up to
    /// [`Taylor::ORDER`]; infinite if none is known.
    pub fn largest(&self, order: usize) -> f64 {
        self.terms.get(order).map_or(f64::INFINITY, |term| term.magnitude())
    }

    /// Upper bound of the degree, if it is a polynomial; [`Taylor::ORDER`] for anything else.
    pub fn degree(&self) -> usize {
        self.degree
    }

    /// The function whose terms follow from those before: `next(k, terms)` is number k from 1 on.
    fn recurrence(
        first: Interval,
        orders: usize,
        next: impl Fn(usize, &[Interval; ORDERS]) -> Interval,
    ) -> Self {
        let mut all = Self::flat(first);
        if all.is_unknown() {
            return all;
        }
        (all.degree, all.orders) = (orders, orders);
        for k in 1..=orders {
            all.terms[k] = next(k, &all.terms);
        }
        all
    }

    /// `sum over j from 1 to k of weight(j) a_j b_(k-j)`, a those of this.
    fn folded(
        &self,
        k: usize,
        other: &[Interval; ORDERS],
        weight: impl Fn(f64) -> f64,
    ) -> Interval {
        (1..=k.min(self.degree))
            .fold(Interval::ZERO, |sum, j| sum + self.terms[j] * other[k - j] * weight(number(j)))
    }
}

/// A small count as a number.
fn number(count: usize) -> f64 {
    f64::from(u8::try_from(count).unwrap_or(u8::MAX))
}

impl Add for Taylor {
    type Output = Self;

    fn add(mut self, other: Self) -> Self {
        if self.is_unknown() || other.is_unknown() {
            return Self::unknown();
        }
        self.orders = self.orders.min(other.orders);
        self.degree = self.degree.max(other.degree).min(self.orders);
        for k in 0..=other.degree.min(self.orders) {
            self.terms[k] = self.terms[k] + other.terms[k];
        }
        self
    }
}

impl Neg for Taylor {
    type Output = Self;

    fn neg(mut self) -> Self {
        self.terms.iter_mut().for_each(|term| *term = -*term);
        self
    }
}

impl Sub for Taylor {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Taylor {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        if self.is_unknown() || other.is_unknown() {
            return Self::unknown();
        }
        let mut product = Self::flat(Interval::ZERO);
        product.orders = self.orders.min(other.orders);
        product.degree = (self.degree + other.degree).min(product.orders);
        for k in 0..=product.degree {
            let from = k.saturating_sub(other.degree);
            product.terms[k] = (from..=k.min(self.degree))
                .fold(Interval::ZERO, |sum, j| sum + self.terms[j] * other.terms[k - j]);
        }
        product
    }
}

impl Div for Taylor {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        if other.degree == 0 {
            let factor = Self::flat(other.terms[0].reciprocal());
            return self * factor;
        }
        self * other.reciprocal()
    }
}
