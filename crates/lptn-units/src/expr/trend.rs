//! Monotonicity of a result in a variable, from the form of its code, as far as that shows it.

use super::function::Function;
use super::program::{Arithmetic, Op, Operand, Program};
use crate::table::LookupTable;

/// Known properties of a value that depends on one variable: its range, and its monotonicity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trend {
    /// It is never less than this.
    pub low: f64,
    /// It is never more than this.
    pub high: f64,
    /// It never falls while the variable rises.
    pub rises: bool,
    /// It never rises while the variable rises.
    pub falls: bool,
    /// It is a number of either sign whose magnitude rises with the variable.
    pub signed: bool,
}

impl Trend {
    /// Nothing is known of it.
    pub const UNKNOWN: Self = Self {
        low: f64::NEG_INFINITY,
        high: f64::INFINITY,
        rises: false,
        falls: false,
        signed: false,
    };

    /// A variable that is never negative.
    pub const VARIABLE: Self =
        Self { low: 0.0, high: f64::INFINITY, rises: true, falls: false, signed: false };

    /// A number whose magnitude is the variable.
    pub const SIGNED: Self = Self { signed: true, ..Self::UNKNOWN };

    /// A value that does not depend on the variable and is not known otherwise.
    pub const HELD: Self = Self { rises: true, falls: true, ..Self::UNKNOWN };

    /// A constant.
    pub fn constant(value: f64) -> Self {
        if value.is_nan() { Self::HELD } else { Self { low: value, high: value, ..Self::HELD } }
    }

    /// The product of two.
    #[must_use]
    pub fn times(self, other: Self) -> Self {
        if self.is_held() && other.is_held() && !(self.low >= 0.0 && other.low >= 0.0) {
            let both = self.low.to_bits() == self.high.to_bits()
                && other.low.to_bits() == other.high.to_bits();
            return if both { Self::constant(self.low * other.low) } else { Self::HELD };
        }
        // 0 alone is excluded: its negative is the same again
        if self.high <= 0.0 && self.low < 0.0 {
            return self.negated().times(other).negated();
        }
        if other.high <= 0.0 && other.low < 0.0 {
            return self.times(other.negated()).negated();
        }
        if self.low >= 0.0 && other.low >= 0.0 {
            // 0 times infinity: no bound on that side
            let bound = |a: f64, b: f64, none: f64| if (a * b).is_nan() { none } else { a * b };
            let (low, high) =
                (bound(self.low, other.low, 0.0), bound(self.high, other.high, f64::INFINITY));
            return Self {
                low,
                high,
                rises: self.rises && other.rises,
                falls: self.falls && other.falls,
                signed: false,
            };
        }
        let (held, varies) = if self.is_held() { (self, other) } else { (other, self) };
        let signed = held.is_held() && varies.signed;
        match held.is_held() && held.low >= 0.0 {
            // the sign of the varying value is not known, its trend is
            true => Self { rises: varies.rises, falls: varies.falls, signed, ..Self::UNKNOWN },
            false => Self { signed, ..Self::UNKNOWN },
        }
    }

    /// True if it does not depend on the variable.
    pub fn is_held(self) -> bool {
        self.rises && self.falls
    }

    fn negated(self) -> Self {
        Self {
            low: -self.high,
            high: -self.low,
            rises: self.falls,
            falls: self.rises,
            signed: self.signed,
        }
    }

    fn inverted(self) -> Self {
        if self.high <= 0.0 && self.low < 0.0 {
            return self.negated().inverted().negated();
        }
        if self.low < 0.0 {
            return if self.is_held() { Self::HELD } else { Self::UNKNOWN };
        }
        let (low, high) = (self.high.recip(), self.low.recip());
        Self { low, high, rises: self.falls, falls: self.rises, signed: false }
    }

    fn plus(self, other: Self) -> Self {
        let (rises, falls) = (self.rises && other.rises, self.falls && other.falls);
        let (low, high) = (self.low + other.low, self.high + other.high);
        let low = if low.is_nan() { f64::NEG_INFINITY } else { low };
        let high = if high.is_nan() { f64::INFINITY } else { high };
        Self { low, high, rises, falls, signed: false }
    }

    fn extreme(self, other: Self, pick: fn(f64, f64) -> f64) -> Self {
        let (rises, falls) = (self.rises && other.rises, self.falls && other.falls);
        Self {
            low: pick(self.low, other.low),
            high: pick(self.high, other.high),
            rises,
            falls,
            signed: false,
        }
    }

    /// The trend of a function that never falls.
    fn through(self, f: fn(f64) -> f64) -> Self {
        let bound = |x: f64, none: f64| if f(x).is_nan() { none } else { f(x) };
        let (low, high) = (bound(self.low, f64::NEG_INFINITY), bound(self.high, f64::INFINITY));
        Self { low, high, rises: self.rises, falls: self.falls, signed: false }
    }

    /// Its magnitude.
    fn magnitude(self) -> Self {
        match (self.signed, self.low >= 0.0, self.high <= 0.0) {
            (true, ..) => Self::VARIABLE,
            (_, true, _) => self,
            (_, _, true) => self.negated(),
            _ if self.is_held() => Self { low: 0.0, ..Self::HELD },
            _ => Self { low: 0.0, ..Self::UNKNOWN },
        }
    }

    fn power(self, exponent: f64) -> Self {
        let even = exponent % 2.0 == 0.0;
        let base = if even && self.signed { Self::VARIABLE } else { self };
        if base.low < 0.0 {
            let is_one = exponent.to_bits() == 1.0_f64.to_bits();
            return match (is_one, base.is_held()) {
                (true, _) => base,
                (_, true) => Self::HELD,
                _ => Self::UNKNOWN,
            };
        }
        if exponent < 0.0 {
            return base.power(-exponent).inverted();
        }
        Self { low: base.low.powf(exponent), high: base.high.powf(exponent), signed: false, ..base }
    }

    fn combined(arithmetic: Arithmetic, left: Self, right: Self) -> Self {
        match arithmetic {
            Arithmetic::Add => left.plus(right),
            Arithmetic::Subtract => left.plus(right.negated()),
            Arithmetic::Multiply => left.times(right),
            Arithmetic::Divide => left.times(right.inverted()),
            Arithmetic::Min => left.extreme(right, f64::min),
            Arithmetic::Max => left.extreme(right, f64::max),
        }
    }

    fn called(self, function: Function) -> Self {
        match function {
            Function::Abs => self.magnitude(),
            Function::Sqrt => self.power(0.5),
            Function::Exp => self.through(f64::exp),
            Function::Ln => self.through(f64::ln),
            Function::Tanh => self.through(f64::tanh),
            Function::Kelvin | Function::Absolute => Self { signed: false, ..self },
            _ if self.is_held() => Self::HELD,
            _ => Self::UNKNOWN,
        }
    }
}

impl Program {
    /// The trend of the result in a variable: `of` gives that of each slot. After a condition
    /// nothing is known.
    pub fn trend(&self, of: &dyn Fn(u32) -> Trend) -> Trend {
        let operand = |operand: Operand| match operand {
            Operand::Constant(value) => Trend::constant(value),
            Operand::Slot(slot) => of(slot),
        };
        let mut stack: Vec<Trend> = Vec::new();
        let mut now = Trend::UNKNOWN;
        for op in &self.code {
            let mut pop = || stack.pop().unwrap_or(Trend::UNKNOWN);
            now = match *op {
                Op::Load(from) => operand(from),
                Op::Push => {
                    stack.push(now);
                    now
                }
                Op::Right(arithmetic, right) => Trend::combined(arithmetic, now, operand(right)),
                Op::Left(arithmetic, left) => Trend::combined(arithmetic, operand(left), now),
                Op::Popped(arithmetic) => Trend::combined(arithmetic, pop(), now),
                Op::Negate => now.negated(),
                Op::WholePower(exponent) => now.power(f64::from(exponent)),
                Op::RealPower(exponent) => now.power(exponent),
                Op::Call(function) => now.called(function),
                Op::Table(index) => self.looked_up(index, now),
                Op::PoppedPower | Op::PoppedTable(_) if now.is_held() && pop().is_held() => {
                    Trend::HELD
                }
                _ => return Trend::UNKNOWN,
            };
        }
        now
    }

    /// The trend of a table of one argument.
    fn looked_up(&self, index: usize, argument: Trend) -> Trend {
        let table = match self.tables.get(index).map(|named| &*named.table) {
            Some(LookupTable::One(table)) => table,
            Some(LookupTable::DoubleLog(_)) => {
                let (rises, falls) = (argument.falls, argument.rises);
                return Trend { low: 0.0, high: f64::INFINITY, rises, falls, signed: false };
            }
            Some(LookupTable::PowerLaw(_)) => {
                return Trend { low: 0.0, high: f64::INFINITY, signed: false, ..argument };
            }
            _ => return Trend::UNKNOWN,
        };
        let values = table.values();
        let goes = |way: fn(f64, f64) -> bool| values.windows(2).all(|pair| way(pair[0], pair[1]));
        let (up, down) = (goes(|a, b| a <= b), goes(|a, b| a >= b));
        let low = values.iter().copied().fold(f64::INFINITY, f64::min);
        let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let flat = up && down;
        let rises = flat || (up && argument.rises) || (down && argument.falls);
        let falls = flat || (up && argument.falls) || (down && argument.rises);
        Trend { low, high, rises, falls, signed: false }
    }
}
