//! Runs the code.

use std::ops::Range;

use super::eval_error::EvalError;
use super::function::Function;
use super::program::{Arithmetic, NamedTable, Op, Operand, Program};
use super::tree::Comparison;
use crate::scalar::Scalar;
use crate::table::LookupTable;

impl Program {
    /// Evaluates the program on the values of its slots, in SI units.
    ///
    /// `stack` is scratch space that is kept between calls; with a capacity of
    /// [`Program::stack_size`] nothing is allocated. Only the branch of an `if` that is taken is
    /// evaluated.
    ///
    /// # Errors
    ///
    /// See [`EvalError`]. A result whose value or derivative is not finite is an error.
    pub fn eval<S: Scalar>(&self, slots: &[S], stack: &mut Vec<S>) -> Result<S, EvalError> {
        if let Some(&slot) = self.slots.last()
            && slot as usize >= slots.len()
        {
            return Err(EvalError::MissingSlot { slot, given: slots.len() });
        }
        if let Some(result) = S::run_on(self, slots) {
            return Ok(result);
        }
        stack.clear();
        stack.reserve(self.stack_size);
        let result = self.run(slots, stack, |_, _| Ok(()))?;
        if result.is_finite() {
            Ok(result)
        } else {
            Err(self.not_finite(slots, stack, result.value()))
        }
    }

    /// Runs again, up to the first operation whose result is not finite.
    #[cold]
    fn not_finite<S: Scalar>(&self, slots: &[S], stack: &mut Vec<S>, value: f64) -> EvalError {
        stack.clear();
        let stop = |index: usize, accumulator: S| {
            if accumulator.is_finite() {
                Ok(())
            } else {
                Err(EvalError::NotFinite { value, span: self.span(index) })
            }
        };
        match self.run(slots, stack, stop) {
            Err(error) => error,
            Ok(_) => EvalError::NotFinite { value, span: 0..self.text.len() },
        }
    }

    fn span(&self, index: usize) -> Range<usize> {
        self.origins.get(index).map(|origin| origin.span.clone()).unwrap_or_default()
    }

    #[inline(always)]
    fn run<S: Scalar>(
        &self,
        slots: &[S],
        stack: &mut Vec<S>,
        inspect: impl Fn(usize, S) -> Result<(), EvalError>,
    ) -> Result<S, EvalError> {
        let load = |operand: Operand| match operand {
            Operand::Constant(value) => S::from_f64(value),
            Operand::Slot(slot) => slots[slot as usize],
        };
        let mut accumulator = S::from_f64(0.0);
        let mut next = 0;
        while let Some(op) = self.code.get(next) {
            let index = next;
            next += 1;
            accumulator = match *op {
                Op::Load(operand) => load(operand),
                Op::Push => {
                    stack.push(accumulator);
                    continue;
                }
                Op::Right(Arithmetic::Add, Operand::Constant(term)) => accumulator.plus(term),
                Op::Right(Arithmetic::Subtract, Operand::Constant(term)) => accumulator.plus(-term),
                Op::Right(Arithmetic::Multiply, Operand::Constant(factor))
                | Op::Left(Arithmetic::Multiply, Operand::Constant(factor)) => {
                    accumulator.scaled(factor)
                }
                Op::Left(Arithmetic::Add, Operand::Constant(term)) => accumulator.plus(term),
                Op::Right(arithmetic, operand) => apply(arithmetic, accumulator, load(operand)),
                Op::Left(arithmetic, operand) => apply(arithmetic, load(operand), accumulator),
                Op::Popped(arithmetic) => apply(arithmetic, pop(stack), accumulator),
                Op::Negate => -accumulator,
                Op::WholePower(exponent) => accumulator.powi(exponent),
                Op::RealPower(exponent) => {
                    self.check_base(index, accumulator.value(), exponent)?;
                    accumulator.powf(exponent)
                }
                Op::PoppedPower => self.power(index, pop(stack), accumulator)?,
                Op::Call(function) => self.call(index, function, accumulator)?,
                Op::Table(table) => self.table(index, table, accumulator)?,
                Op::PoppedTable(table) => {
                    self.table_of_two(index, table, [pop(stack), accumulator])?
                }
                Op::JumpUnless(comparison, target) => {
                    if !self.holds(index, comparison, [pop(stack).value(), accumulator.value()])? {
                        next = target;
                    }
                    continue;
                }
                Op::Jump(target) => {
                    next = target;
                    continue;
                }
                Op::JumpUnlessSet(slot, target) => {
                    pop(stack);
                    if slots[slot as usize].value() == 0.0 {
                        next = target;
                    }
                    continue;
                }
            };
            inspect(index, accumulator)?;
        }
        Ok(accumulator)
    }

    /// NaN is neither larger nor smaller: nothing follows from it.
    #[inline]
    fn holds(
        &self,
        index: usize,
        comparison: Comparison,
        [left, right]: [f64; 2],
    ) -> Result<bool, EvalError> {
        if left.is_nan() || right.is_nan() {
            return Err(EvalError::NotFinite { value: f64::NAN, span: self.span(index) });
        }
        Ok(comparison.holds(left, right))
    }

    #[inline]
    fn check_base(&self, index: usize, base: f64, exponent: f64) -> Result<(), EvalError> {
        if base < 0.0 && exponent.fract() != 0.0 {
            return Err(EvalError::NegativeBase { base, exponent, span: self.span(index) });
        }
        Ok(())
    }

    fn power<S: Scalar>(&self, index: usize, base: S, exponent: S) -> Result<S, EvalError> {
        self.check_base(index, base.value(), exponent.value())?;
        Ok(base.pow(exponent))
    }

    /// Not inlined, as it would fill the loop that runs programs without tables.
    #[inline(never)]
    fn table<S: Scalar>(&self, index: usize, table: usize, argument: S) -> Result<S, EvalError> {
        let found = match &self.named(table).table.as_ref() {
            LookupTable::One(table) => table.value_and_slope(argument.value()),
            LookupTable::DoubleLog(line) => line.value_and_slope(argument.value()),
            LookupTable::PowerLaw(law) => law.value_and_slope(argument.value()),
            LookupTable::Two(_) => None,
        };
        match found {
            Some((value, slope)) if S::IN_PIECES => {
                let piece = self.named(table).table.piece(0, argument.value());
                Ok(argument.chain(value, slope).on_piece(piece))
            }
            Some((value, slope)) => Ok(argument.chain(value, slope)),
            None => self.outside(index, table, &[argument]),
        }
    }

    #[inline(never)]
    fn table_of_two<S: Scalar>(
        &self,
        index: usize,
        table: usize,
        arguments: [S; 2],
    ) -> Result<S, EvalError> {
        let [x, y] = arguments;
        let found = match &self.named(table).table.as_ref() {
            LookupTable::Two(table) => table.value_and_slopes(x.value(), y.value()),
            LookupTable::One(_) | LookupTable::DoubleLog(_) | LookupTable::PowerLaw(_) => None,
        };
        match found {
            Some((value, slopes)) if S::IN_PIECES => {
                let table = &self.named(table).table;
                let [i, j] = [table.piece(0, x.value()), table.piece(1, y.value())];
                Ok(x.on_piece(i).chain2(y.on_piece(j), value, slopes))
            }
            Some((value, slopes)) => Ok(x.chain2(y, value, slopes)),
            None => self.outside(index, table, &arguments),
        }
    }

    fn named(&self, table: usize) -> &NamedTable {
        match self.tables.get(table) {
            Some(named) => named,
            None => {
                unreachable!("code calls the tables it was compiled with; this is a bug in lptn")
            }
        }
    }

    /// An argument that is not finite gives a value that is not either, so that its own place is
    /// reported.
    #[cold]
    fn outside<S: Scalar>(
        &self,
        index: usize,
        table: usize,
        arguments: &[S],
    ) -> Result<S, EvalError> {
        let NamedTable { name, table, units } = self.named(table);
        for (argument, value) in arguments.iter().map(|argument| argument.value()).enumerate() {
            let knots = table.knots(argument);
            let (Some(&from), Some(&to)) = (knots.first(), knots.last()) else { continue };
            if value.is_finite() && !table.reaches(argument, value) {
                let (table, span) = (name.clone(), self.span(index));
                let unit = units.get(argument).cloned().map(Box::new);
                return Err(EvalError::OutsideTable {
                    table,
                    argument,
                    value,
                    from,
                    to,
                    unit,
                    span,
                });
            }
        }
        Ok(S::from_f64(f64::NAN))
    }

    #[inline]
    fn call<S: Scalar>(
        &self,
        index: usize,
        function: Function,
        argument: S,
    ) -> Result<S, EvalError> {
        let value = argument.value();
        let outside = match function {
            Function::Sqrt => value < 0.0,
            Function::Ln => value <= 0.0,
            _ => false,
        };
        if outside {
            let function = function.name();
            return Err(EvalError::Domain { function, argument: value, span: self.span(index) });
        }
        Ok(match function {
            Function::Abs => argument.abs(),
            Function::Sqrt => argument.sqrt(),
            Function::Exp => argument.exp(),
            Function::Ln => argument.ln(),
            Function::Sin => argument.sin(),
            Function::Cos => argument.cos(),
            Function::Tanh => argument.tanh(),
            _ => argument,
        })
    }
}

#[inline(always)]
fn apply<S: Scalar>(arithmetic: Arithmetic, left: S, right: S) -> S {
    match arithmetic {
        Arithmetic::Add => left + right,
        Arithmetic::Subtract => left - right,
        Arithmetic::Multiply => left * right,
        Arithmetic::Divide => left / right,
        Arithmetic::Min => left.min(right),
        Arithmetic::Max => left.max(right),
    }
}

#[inline(always)]
fn pop<S: Scalar>(stack: &mut Vec<S>) -> S {
    match stack.pop() {
        Some(value) => value,
        None => unreachable!("code pops what it has pushed; this is a bug in lptn"),
    }
}
