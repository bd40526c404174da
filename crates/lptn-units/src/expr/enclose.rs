//! Runs the code on bounds instead of numbers.

use super::function::Function;
use super::program::{Arithmetic, Op, Operand, Program};
use super::tree::Comparison;
use crate::table::LookupTable;
use crate::taylor::Taylor;
use crate::taylor::interval::Interval;

/// Number of times that both branches of an `if` are followed, if both may be taken, before the
/// result counts as unknown.
const FORKS: u32 = 64;

impl Program {
    /// Bounds on the result, and on its derivatives, while one slot runs through an interval and
    /// the others are fixed. They apply to every number of the interval, whatever the expression
    /// does between any two of them: if [`Taylor::range`] is known, every evaluation succeeds.
    pub fn enclose(&self, slot: u32, over: [f64; 2], slots: &[f64]) -> Taylor {
        let variable = Taylor::variable(over[0], over[1]);
        self.enclose_along(&|of| (of == slot).then_some(variable), slots)
    }

    /// Bounds on the result, and on its derivatives, along a path: `known` gives the bounds of the
    /// slots that vary on it, by one variable; the others are fixed. They apply like those of
    /// [`Program::enclose`].
    pub fn enclose_along(&self, known: &dyn Fn(u32) -> Option<Taylor>, slots: &[f64]) -> Taylor {
        if self.slots.last().is_some_and(|last| *last as usize >= slots.len()) {
            return Taylor::unknown();
        }
        self.enclosed(&|slot| {
            let still =
                || slots.get(slot as usize).map_or(Taylor::unknown(), |v| Taylor::constant(*v));
            known(slot).unwrap_or_else(still)
        })
    }

    /// Bounds on the result for bounds on each slot.
    pub(crate) fn enclosed(&self, of: &dyn Fn(u32) -> Taylor) -> Taylor {
        let mut forks = FORKS;
        let mut run = Run { program: self, of, stack: Vec::new() };
        run.from(0, Taylor::constant(0.0), &mut forks)
    }
}

/// A run up to some operation.
#[derive(Clone)]
struct Run<'a> {
    program: &'a Program,
    /// The bounds on each slot.
    of: &'a dyn Fn(u32) -> Taylor,
    stack: Vec<Taylor>,
}

impl Run<'_> {
    fn load(&self, operand: Operand) -> Taylor {
        match operand {
            Operand::Constant(value) => Taylor::constant(value),
            Operand::Slot(slot) => (self.of)(slot),
        }
    }

    fn pop(&mut self) -> Taylor {
        self.stack.pop().unwrap_or(Taylor::unknown())
    }

    /// The result of the code from an operation on.
    fn from(&mut self, first: usize, mut accumulator: Taylor, forks: &mut u32) -> Taylor {
        let mut next = first;
        while let Some(op) = self.program.code.get(next) {
            next += 1;
            match *op {
                Op::Push => self.stack.push(accumulator),
                Op::Jump(target) => next = target,
                Op::JumpUnlessSet(slot, target) => {
                    self.pop();
                    if (self.of)(slot).range() == Some([0.0; 2]) {
                        next = target;
                    }
                }
                Op::JumpUnless(comparison, target) => {
                    match holds(comparison, self.pop().value(), accumulator.value()) {
                        Some(true) => {}
                        Some(false) => next = target,
                        None if *forks == 0 => return Taylor::unknown(),
                        None => {
                            *forks -= 1;
                            let taken = self.clone().from(next, accumulator, forks);
                            return taken.either(self.from(target, accumulator, forks));
                        }
                    }
                }
                ref other => accumulator = self.step(other, accumulator),
            }
        }
        accumulator
    }

    fn step(&mut self, op: &Op, accumulator: Taylor) -> Taylor {
        match *op {
            Op::Load(operand) => self.load(operand),
            Op::Right(arithmetic, operand) => apply(arithmetic, accumulator, self.load(operand)),
            Op::Left(arithmetic, operand) => apply(arithmetic, self.load(operand), accumulator),
            Op::Popped(arithmetic) => apply(arithmetic, self.pop(), accumulator),
            Op::Negate => -accumulator,
            Op::WholePower(exponent) => accumulator.power(f64::from(exponent)),
            Op::RealPower(exponent) => accumulator.power(exponent),
            Op::PoppedPower => power(self.pop(), accumulator),
            Op::Call(function) => call(function, accumulator),
            Op::Table(table) => match self.table(table) {
                Some(LookupTable::One(table)) => table.enclose(accumulator),
                Some(LookupTable::DoubleLog(line)) => line.enclose(accumulator),
                Some(LookupTable::PowerLaw(law)) => law.enclose(accumulator),
                _ => Taylor::unknown(),
            },
            Op::PoppedTable(table) => {
                let first = self.pop();
                match self.table(table) {
                    Some(LookupTable::Two(table)) => table.enclose([first, accumulator]),
                    _ => Taylor::unknown(),
                }
            }
            Op::Push | Op::Jump(_) | Op::JumpUnless(..) | Op::JumpUnlessSet(..) => accumulator,
        }
    }

    fn table(&self, index: usize) -> Option<&LookupTable> {
        self.program.tables.get(index).map(|named| &*named.table)
    }
}

/// True if a comparison holds for all values, false if for none; `None` if it depends on them.
fn holds(comparison: Comparison, left: Interval, right: Interval) -> Option<bool> {
    if left == Interval::ALL || right == Interval::ALL {
        return None;
    }
    let ends = [
        comparison.holds(left.low, right.low),
        comparison.holds(left.low, right.high),
        comparison.holds(left.high, right.low),
        comparison.holds(left.high, right.high),
    ];
    let apart = left.high < right.low || right.high < left.low;
    let points = left.width() == 0.0 && right.width() == 0.0;
    let ordered = !matches!(comparison, Comparison::Equal | Comparison::NotEqual);
    let same = ends.iter().all(|end| *end == ends[0]);
    (same && (apart || points || ordered)).then_some(ends[0])
}

fn power(base: Taylor, exponent: Taylor) -> Taylor {
    match exponent.range() {
        Some([from, to]) if from.to_bits() == to.to_bits() && exponent.degree() == 0 => {
            base.power(from)
        }
        _ => (base.ln() * exponent).exp(),
    }
}

fn call(function: Function, argument: Taylor) -> Taylor {
    match function {
        Function::Abs => argument.abs(),
        Function::Sqrt => argument.square_root(),
        Function::Exp => argument.exp(),
        Function::Ln => argument.ln(),
        Function::Sin => argument.sin(),
        Function::Cos => argument.cos(),
        Function::Tanh => argument.tanh(),
        _ => argument,
    }
}

fn apply(arithmetic: Arithmetic, left: Taylor, right: Taylor) -> Taylor {
    match arithmetic {
        Arithmetic::Add => left + right,
        Arithmetic::Subtract => left - right,
        Arithmetic::Multiply => left * right,
        Arithmetic::Divide => left / right,
        Arithmetic::Min => left.smaller(right),
        Arithmetic::Max => left.larger(right),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A comparison holds for all numbers of two ranges, for none or for some: their halves show
    /// which.
    #[test]
    fn a_comparison_of_ranges_is_that_of_all_their_numbers() {
        use Comparison::{Equal, Greater, GreaterEqual, Less, LessEqual, NotEqual};
        let ranges: Vec<Interval> = (0..4)
            .flat_map(|low| {
                (low..4).map(move |high| Interval::new(f64::from(low), f64::from(high)))
            })
            .collect();
        let halves = (0..7).map(|k| 0.5 * f64::from(k));
        let numbers =
            |range: Interval| halves.clone().filter(move |x| range.low <= *x && *x <= range.high);
        for comparison in [Less, LessEqual, Greater, GreaterEqual, Equal, NotEqual] {
            for (a, b) in ranges.iter().flat_map(|a| ranges.iter().map(move |b| (*a, *b))) {
                let truths: Vec<bool> = numbers(a)
                    .flat_map(|x| numbers(b).map(move |y| comparison.holds(x, y)))
                    .collect();
                let expected = truths.iter().all(|truth| *truth == truths[0]).then_some(truths[0]);
                assert_eq!(holds(comparison, a, b), expected, "{a:?} {comparison} {b:?}");
            }
            assert_eq!(holds(comparison, Interval::ALL, ranges[0]), None);
            assert_eq!(holds(comparison, ranges[0], Interval::ALL), None);
        }
    }
}
