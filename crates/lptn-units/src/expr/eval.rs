//! Runs the code.

use std::fmt;
use std::ops::Range;

use super::function::Function;
use super::program::{Arithmetic, NamedTable, Op, Operand, Program};
use super::tree::Comparison;
use crate::format::rounded;
use crate::scalar::Scalar;
use crate::table::LookupTable;
use crate::unit::Unit;

/// What can go wrong at run time.
#[derive(Clone, PartialEq, Debug)]
#[non_exhaustive]
pub enum EvalError {
    /// A negative base with an exponent that is not a whole number.
    NegativeBase {
        /// The base, in SI units.
        base: f64,
        /// The exponent of the power.
        exponent: f64,
        /// The power in the text.
        span: Range<usize>,
    },
    /// The square root of a negative number, the logarithm of a number that is not positive.
    Domain {
        /// The name of the function.
        function: &'static str,
        /// Its argument, in SI units.
        argument: f64,
        /// The call in the text.
        span: Range<usize>,
    },
    /// An argument outside the knots of a table that has no value there.
    OutsideTable {
        /// The name of the table.
        table: String,
        /// Which argument, counted from 0.
        argument: usize,
        /// The argument, in SI units.
        value: f64,
        /// The first knot, in SI units.
        from: f64,
        /// The last knot, in SI units.
        to: f64,
        /// The unit in which the table gives this argument, where that is known.
        unit: Option<Box<Unit>>,
        /// The call in the text.
        span: Range<usize>,
    },
    /// The result or one of its derivatives is infinite or not a number.
    NotFinite {
        /// The result, in SI units.
        value: f64,
        /// The part of the text in which this came up first.
        span: Range<usize>,
    },
    /// Fewer slots than the program loads were given.
    MissingSlot {
        /// The largest slot the program loads.
        slot: u32,
        /// How many slots were given.
        given: usize,
    },
}

impl EvalError {
    /// The stable code, as diagnostics print it.
    pub fn code(&self) -> &'static str {
        match self {
            Self::NegativeBase { .. } => "units::negative_base",
            Self::Domain { .. } => "units::domain",
            Self::OutsideTable { .. } => "units::outside_table",
            Self::NotFinite { .. } => "units::result_not_finite",
            Self::MissingSlot { .. } => "units::missing_slot",
        }
    }

    /// The part of the expression that failed, in bytes; empty for a missing slot.
    pub fn span(&self) -> Range<usize> {
        match self {
            Self::NegativeBase { span, .. }
            | Self::Domain { span, .. }
            | Self::OutsideTable { span, .. }
            | Self::NotFinite { span, .. } => span.clone(),
            Self::MissingSlot { .. } => 0..0,
        }
    }

    /// What to write instead.
    pub fn help(&self) -> Option<&'static str> {
        match self {
            Self::NegativeBase { .. } => {
                Some("write \"abs(x)^a\", or \"if(x > 0, x^a, 0)\" with its units")
            }
            Self::Domain { .. } => {
                Some("keep the argument positive: \"max(x, 1e-9)\" with its unit")
            }
            Self::NotFinite { .. } => {
                Some("keep divisors away from 0: \"max(x, 1e-9)\" with its unit")
            }
            Self::OutsideTable { .. } => {
                Some("add points to the table, or keep its end values with `outside = \"hold\"`")
            }
            Self::MissingSlot { .. } => None,
        }
    }
}

impl fmt::Display for EvalError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NegativeBase { base, exponent, .. } => {
                write!(
                    f,
                    "negative base {base} with the exponent {exponent}, which is not a whole number"
                )
            }
            Self::Domain { function, argument, .. } => write!(f, "`{function}` of {argument}"),
            Self::OutsideTable { table, value, from, to, argument, unit, .. } => {
                let which = if *argument == 0 { "first" } else { "second" };
                let unit = unit.as_deref();
                let [first, last, found] = [*from, *to, *value].map(|si| in_unit(si, unit, 12));
                let is_end = found == first || found == last;
                let found = if is_end { in_unit(*value, unit, 17) } else { found };
                let si = if unit.is_none() { " (SI units)" } else { "" };
                write!(
                    f,
                    "table `{table}` reaches from {first} to {last} in its {which} argument, got \
                     {found}{si}"
                )
            }
            Self::NotFinite { value, .. } => {
                write!(f, "result {value} or its derivative is not finite")
            }
            Self::MissingSlot { slot, given } => {
                write!(f, "slot {slot} is needed, but only {given} slots are given")
            }
        }
    }
}

impl std::error::Error for EvalError {}

impl crate::Problem for EvalError {
    fn code(&self) -> &'static str {
        self.code()
    }

    fn help(&self) -> Option<String> {
        self.help().map(str::to_owned)
    }
}

/// A number with the unit in which people give it.
fn in_unit(si: f64, unit: Option<&Unit>, digits: usize) -> String {
    match unit {
        None => format!("{si}"),
        Some(unit) if unit.text == "1" => rounded(si, digits),
        Some(unit) => format!("{} {}", rounded(unit.from_si(si), digits), unit.text),
    }
}

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
        self.spans.get(index).cloned().unwrap_or_default()
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
            LookupTable::Two(_) => None,
        };
        match found {
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
            LookupTable::One(_) => None,
        };
        match found {
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
