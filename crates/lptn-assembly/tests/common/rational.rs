//! Fractions of whole numbers, and systems of equations solved in them without rounding.

use std::ops::{Add, Div, Mul, Sub};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Rational {
    over: i128,
    under: i128,
}

fn divisor(a: i128, b: i128) -> i128 {
    if b == 0 { a.abs() } else { divisor(b, a % b) }
}

impl Rational {
    pub(crate) fn whole(number: i128) -> Self {
        Self { over: number, under: 1 }
    }

    fn new(over: i128, under: i128) -> Self {
        let by = divisor(over, under) * under.signum();
        Self { over: over / by, under: under / by }
    }

    pub(crate) fn number(self) -> f64 {
        // the whole part and the rest: numbers of more than 53 bits would each be rounded
        let whole = self.over / self.under;
        whole as f64 + (self.over - whole * self.under) as f64 / self.under as f64
    }
}

impl Add for Rational {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self::new(self.over * other.under + other.over * self.under, self.under * other.under)
    }
}

impl Sub for Rational {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self::new(self.over * other.under - other.over * self.under, self.under * other.under)
    }
}

impl Mul for Rational {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        Self::new(self.over * other.over, self.under * other.under)
    }
}

impl Div for Rational {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        Self::new(self.over * other.under, self.under * other.over)
    }
}

/// Gauss and Jordan: each row ends with its right-hand side.
pub(crate) fn solved(mut rows: Vec<Vec<Rational>>) -> Vec<Rational> {
    let zero = Rational::whole(0);
    for k in 0..rows.len() {
        let pivot = (k..rows.len())
            .find(|&i| rows[i][k] != zero)
            .expect("the balances determine everything");
        rows.swap(k, pivot);
        let by = rows[k][k];
        rows[k].iter_mut().for_each(|x| *x = *x / by);
        let own = rows[k].clone();
        for (_, row) in rows.iter_mut().enumerate().filter(|(i, _)| *i != k) {
            let factor = row[k];
            row.iter_mut().zip(&own).for_each(|(x, of)| *x = *x - factor * *of);
        }
    }
    rows.into_iter().map(|row| row[row.len() - 1]).collect()
}
