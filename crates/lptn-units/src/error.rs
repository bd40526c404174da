//! What can be wrong with a quantity or an expression.

use std::fmt;
use std::ops::Range;

use crate::error_text;
use crate::types::Type;

/// A mistake in a quantity, a unit or an expression, with its place in the text.
#[derive(Clone, PartialEq, Debug)]
pub struct UnitError {
    /// What is wrong.
    pub kind: UnitErrorKind,
    /// Where: bytes of the string that was parsed.
    pub span: Range<usize>,
}

/// What is wrong. A `fix` is a text that can be pasted over the whole string, unless said otherwise.
#[derive(Clone, PartialEq, Debug)]
#[non_exhaustive]
pub enum UnitErrorKind {
    /// The string holds nothing.
    Empty,
    /// Something else was due here.
    Syntax {
        /// What was due, in words.
        wanted: &'static str,
        /// What stands there.
        found: String,
    },
    /// The number, or the number in SI units, does not fit into an `f64`.
    OutOfRange {
        /// The number as written.
        number: String,
    },
    /// `nan` or `inf`.
    NotFinite {
        /// The word as written.
        text: String,
    },
    /// `0,5` for `0.5`, or `1,000` for `1000`.
    DecimalComma {
        /// The string with a decimal point, where the comma can be one.
        decimal: Option<String>,
        /// The string without the commas, where they can separate thousands.
        thousands: Option<String>,
    },
    /// `1 000` or `1'000` for `1000`.
    DigitGroups {
        /// The string without the separators.
        fix: Option<String>,
    },
    /// `7.7*10^-3 K/W` for `7.7e-3 K/W`.
    PowerOfTen {
        /// The string with an exponent.
        fix: String,
    },
    /// `2 P` for `2 * P`.
    MissingOperator {
        /// The parameter that stands in the place of a unit.
        name: String,
        /// The string with the operator.
        fix: String,
    },
    /// Brackets, signs or powers nested too deeply.
    TooDeep {
        /// The deepest nesting allowed.
        limit: usize,
    },
    /// No unit has this name.
    UnknownUnit {
        /// The name as written.
        name: String,
        /// The string with the unit that was probably meant.
        fix: Option<String>,
    },
    /// A product after a division bar without brackets: `J/kg K`.
    AmbiguousProduct {
        /// The string with brackets.
        fix: Option<String>,
    },
    /// An exponent that cannot be read or does not fit.
    Exponent {
        /// The exponent as written, or the power it belongs to.
        text: String,
    },
    /// The value has the wrong dimension.
    Dimension {
        /// The type that is due.
        wanted: Box<Type>,
        /// The type of the value.
        found: Box<Type>,
        /// What was possibly meant.
        fix: Option<String>,
    },
    /// A number without a unit where a unit is due.
    BareNumber {
        /// The type that is due.
        wanted: Type,
        /// The string with the usual unit.
        fix: String,
    },
    /// `Hz` or `1/s` where a rotation is due.
    Rotation {
        /// The string, or the part of an expression, in revolutions.
        fix: Option<String>,
    },
    /// A temperature difference where an absolute temperature is due.
    AbsoluteWanted {
        /// The value made absolute.
        fix: String,
    },
    /// An absolute temperature where a difference is due.
    DifferenceWanted {
        /// The value made a difference.
        fix: String,
    },
    /// An absolute temperature below 0 K.
    BelowAbsoluteZero {
        /// The temperature in K.
        kelvin: f64,
    },
    /// A standard deviation below zero.
    NegativeDeviation {
        /// The deviation as written.
        text: String,
    },
    /// `25 ± 5 % degC`: a percentage of an absolute temperature.
    RelativeDeviation {
        /// The string with a deviation in degrees.
        fix: Option<String>,
    },
    /// A deviation in percent that reads in two ways: `0.8 ± 5 %`, `80 % ± 5 %`, `220 ± 5 % W`.
    PercentDeviation {
        /// The string if the percentage is one of the same kind as the value, with numbers that say so.
        points: String,
        /// The string if it is a part of the value.
        part: String,
    },
    /// A deviation without a unit behind a value that has one: `5 kW ± 1`.
    BareDeviation {
        /// The string with one unit for both.
        fix: String,
    },
    /// A fraction in the place of a number: `3/8 in`, `1 1/2 in`.
    Fraction {
        /// The string with the number that the fraction is.
        fix: String,
    },
    /// `2 * m` while `m` is both a unit and a parameter.
    TwoReadings {
        /// The name that is both.
        name: String,
        /// The string to write for the quantity.
        quantity: String,
        /// The string to write for the expression.
        expression: String,
    },
    /// A unit without brackets in an expression.
    UnbracketedUnit {
        /// The expression with brackets.
        fix: String,
    },
    /// A bracket that follows neither a number nor, without space, a name.
    MisplacedBracket {
        /// The expression without this bracket.
        fix: String,
    },
    /// No parameter, signal, node ... has this name.
    UnknownName {
        /// The name as written.
        name: String,
        /// The nearest name in scope.
        suggestion: Option<String>,
    },
    /// No function has this name.
    UnknownFunction {
        /// The name as written.
        name: String,
        /// The nearest function.
        suggestion: Option<String>,
    },
    /// A wrong number of arguments.
    Arity {
        /// The function.
        function: &'static str,
        /// How many arguments it takes, in words.
        wanted: &'static str,
        /// How many were given.
        found: usize,
    },
    /// `-2^2`, which some read as 4 and some as -4.
    AmbiguousSign {
        /// The power negated.
        negated: String,
        /// The negative number raised.
        raised: String,
    },
    /// `a < b < c`.
    ChainedComparison,
    /// The two sides of `+`, `-`, a comparison, or two arguments, are of different types.
    Operands {
        /// The operator or function.
        operation: &'static str,
        /// Type of the left or first one.
        left: Box<Type>,
        /// Type of the right or later one.
        right: Box<Type>,
        /// What was possibly meant for the part in question.
        fix: Option<String>,
    },
    /// An absolute temperature where only plain quantities can be used.
    AbsoluteOperand {
        /// What it cannot be, in words: "multiplied".
        operation: &'static str,
        /// What to write in its place.
        fix: String,
    },
    /// A function argument of the wrong type.
    Argument {
        /// The function.
        function: &'static str,
        /// What it takes, in words.
        wanted: &'static str,
        /// What it was given.
        found: Box<Type>,
        /// The string with the argument made a plain number by a scale of its own kind.
        example: Option<String>,
    },
    /// A table called with a wrong number of arguments, or used without any.
    TableArity {
        /// The table.
        table: String,
        /// The type of each argument it takes.
        wanted: Vec<Type>,
        /// How many were given.
        found: usize,
        /// The string with names in scope that are of the right kind.
        fix: Option<String>,
    },
    /// An argument of a table of the wrong type.
    TableArgument {
        /// The table.
        table: String,
        /// Which argument, counted from 0.
        argument: usize,
        /// The type it takes.
        wanted: Box<Type>,
        /// The type it was given.
        found: Box<Type>,
        /// What was possibly meant.
        fix: Option<String>,
    },
    /// A parameter or another name without arguments, called as if it were a table.
    NotATable {
        /// The name.
        name: String,
        /// The string without the call; a product if there is one argument.
        fix: String,
    },
    /// A variable exponent on a base that has a dimension.
    VariableExponent {
        /// Type of the base.
        base: Type,
        /// The power with a plain base.
        fix: String,
    },
    /// An exponent that has a dimension.
    ExponentDimension {
        /// Type of the exponent.
        found: Type,
    },
    /// A comparison where a value is due.
    TruthValue {
        /// The comparison inside an `if`.
        fix: String,
    },
    /// A value where a comparison is due.
    TruthWanted {
        /// The value compared with something.
        fix: String,
    },
}

impl UnitError {
    pub(crate) fn new(kind: UnitErrorKind, span: Range<usize>) -> Self {
        Self { kind, span }
    }

    /// The stable code, `units::dimension` and so on; it never changes once released.
    pub fn code(&self) -> &'static str {
        error_text::code(&self.kind)
    }

    /// What to write instead.
    pub fn help(&self) -> Option<String> {
        error_text::help(&self.kind)
    }

    /// The same error in a larger text: `at` bytes further on.
    pub(crate) fn shifted(mut self, at: usize) -> Self {
        self.span = self.span.start + at..self.span.end + at;
        self
    }

    /// Completes a fix for a unit to a fix for the text around it.
    pub(crate) fn map_fix(mut self, complete: impl Fn(&str) -> String) -> Self {
        if let UnitErrorKind::UnknownUnit { fix: Some(fix), .. }
        | UnitErrorKind::AmbiguousProduct { fix: Some(fix) } = &mut self.kind
        {
            *fix = complete(fix);
        }
        self
    }
}

impl fmt::Display for UnitError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&error_text::message(&self.kind))
    }
}

impl std::error::Error for UnitError {}
