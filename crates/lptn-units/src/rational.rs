//! Exact fractions: the exponents of dimensions.

use std::fmt;

/// A fraction in lowest terms with a positive denominator. Dimensions carry these as exponents, so
/// that `(x^(5/3))^(3/5)` has exactly the dimension of `x`.
///
/// Every operation is checked: it returns `None` if the result does not fit into two `i32`.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct Rational {
    num: i32,
    den: i32,
}

impl Rational {
    /// 0.
    pub const ZERO: Self = Self::integer(0);
    /// 1.
    pub const ONE: Self = Self::integer(1);
    /// 1/2, the exponent of a square root.
    pub const HALF: Self = Self { num: 1, den: 2 };

    /// The whole number `n`.
    pub const fn integer(n: i32) -> Self {
        Self { num: n, den: 1 }
    }

    /// `num / den` in lowest terms; `None` if `den` is 0 or the reduced fraction does not fit.
    pub fn new(num: i32, den: i32) -> Option<Self> {
        Self::reduced(i64::from(num), i64::from(den))
    }

    /// Reads a plain decimal number such as `1.25` or `-3` without rounding; `None` if it has an
    /// exponent part or does not fit.
    pub fn from_decimal(text: &str) -> Option<Self> {
        let (whole, fraction) = text.split_once('.').unwrap_or((text, ""));
        let fraction = fraction.trim_end_matches('0');
        if fraction.len() > 9 || !fraction.bytes().all(|b| b.is_ascii_digit()) {
            return None;
        }
        let den = 10_i64.checked_pow(u32::try_from(fraction.len()).ok()?)?;
        let num: i64 = match fraction {
            "" => whole.parse().ok()?,
            fraction => [whole, fraction].concat().parse().ok()?,
        };
        Self::reduced(num, den)
    }

    fn reduced(num: i64, den: i64) -> Option<Self> {
        if den == 0 {
            return None;
        }
        let divisor = gcd(num.unsigned_abs(), den.unsigned_abs());
        let sign = if den < 0 { -1 } else { 1 };
        let divisor = i64::try_from(divisor).ok()?;
        let num = i32::try_from((num / divisor).checked_mul(sign)?).ok()?;
        let den = i32::try_from((den / divisor).checked_mul(sign)?).ok()?;
        Some(Self { num, den })
    }

    /// Numerator; carries the sign.
    pub const fn num(self) -> i32 {
        self.num
    }

    /// Denominator, always positive.
    pub const fn den(self) -> i32 {
        self.den
    }

    /// Sum.
    pub fn checked_add(self, other: Self) -> Option<Self> {
        let left = i64::from(self.num) * i64::from(other.den);
        let right = i64::from(other.num) * i64::from(self.den);
        Self::reduced(left.checked_add(right)?, i64::from(self.den) * i64::from(other.den))
    }

    /// Difference.
    pub fn checked_sub(self, other: Self) -> Option<Self> {
        self.checked_add(other.checked_neg()?)
    }

    /// Product.
    pub fn checked_mul(self, other: Self) -> Option<Self> {
        let num = i64::from(self.num) * i64::from(other.num);
        Self::reduced(num, i64::from(self.den) * i64::from(other.den))
    }

    /// Quotient; `None` for a division by 0.
    pub fn checked_div(self, other: Self) -> Option<Self> {
        let num = i64::from(self.num) * i64::from(other.den);
        Self::reduced(num, i64::from(self.den) * i64::from(other.num))
    }

    /// The negative.
    pub fn checked_neg(self) -> Option<Self> {
        Some(Self { num: self.num.checked_neg()?, den: self.den })
    }

    /// The nearest `f64`.
    pub fn to_f64(self) -> f64 {
        f64::from(self.num) / f64::from(self.den)
    }

    /// True if it is 0.
    pub const fn is_zero(self) -> bool {
        self.num == 0
    }

    /// The whole number, if it is one.
    pub const fn as_integer(self) -> Option<i32> {
        if self.den == 1 { Some(self.num) } else { None }
    }
}

fn gcd(mut a: u64, mut b: u64) -> u64 {
    while b != 0 {
        (a, b) = (b, a % b);
    }
    a.max(1)
}

impl fmt::Display for Rational {
    /// `2`, `-1`, `5/3`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.den {
            1 => write!(f, "{}", self.num),
            den => write!(f, "{}/{den}", self.num),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Rational;

    #[test]
    fn fractions_are_in_lowest_terms_with_positive_denominator() {
        let half = Rational::new(-3, -6).unwrap();
        assert_eq!((half.num(), half.den()), (1, 2));
        assert_eq!(Rational::new(4, -6).unwrap().to_string(), "-2/3");
        assert_eq!(Rational::new(1, 0), None);
    }

    #[test]
    fn decimals_are_exact() {
        assert_eq!(Rational::from_decimal("1.25"), Rational::new(5, 4));
        assert_eq!(Rational::from_decimal("-0.50"), Rational::new(-1, 2));
        assert_eq!(
            Rational::from_decimal("0.123456789"),
            Rational::new(123_456_789, 1_000_000_000)
        );
        assert_eq!(Rational::from_decimal("0.1234567891"), None);
        assert_eq!(Rational::from_decimal("0.12500000000000"), Rational::new(1, 8));
        assert_eq!(Rational::from_decimal("1e3"), None);
        assert_eq!(Rational::from_decimal("99999999999"), None);
    }

    #[test]
    fn overflow_is_none() {
        let big = Rational::integer(i32::MAX);
        assert_eq!(big.checked_add(Rational::ONE), None);
        assert_eq!(big.checked_mul(big), None);
        assert_eq!(Rational::integer(i32::MIN).checked_neg(), None);
        assert_eq!(Rational::ONE.checked_div(Rational::ZERO), None);
    }
}
