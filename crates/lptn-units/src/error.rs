//! Mistakes in a quantity or an expression, each declared once.

use std::fmt;
use std::ops::Range;

use crate::error_words::{
    alike, bare_number, comma, from_zero, got, kinds, meant, noun, rotation, syntax_help,
    torque_turning, turning, unit_wanted, write,
};
use crate::errors;
use crate::format::rounded;
use crate::spread::Distribution;
use crate::types::Type;
use crate::unit_table::calendar;

/// A mistake in a quantity, a unit or an expression, with its place in the text.
#[derive(Clone, PartialEq, Debug)]
pub struct UnitError {
    /// The kind of mistake, with a correction.
    pub kind: UnitErrorKind,
    /// The place: bytes of the string that was parsed.
    pub span: Range<usize>,
}

errors! {
/// A kind of mistake. By default, a `fix` is a text that can be pasted over the whole string.
#[derive(Clone, PartialEq, Debug)]
#[non_exhaustive]
pub enum UnitErrorKind {
    /// The string is empty or blank.
    Empty = "units::empty", "empty string, expected a quantity or an expression",
        help "write a quantity such as \"0.3 K/W\" or an expression such as \"2 * G\"";
    /// Something else was expected here; both in words.
    Syntax { wanted: &'static str, found: String } = "units::syntax",
        format!("expected {wanted}, found {found}"),
        help syntax_help(wanted, found).map(str::to_owned);
    /// The number, or the number in SI units, does not fit into an `f64`.
    OutOfRange { number: String } = "units::out_of_range",
        format!("number `{number}` is out of range");
    /// `nan` or `inf`.
    NotFinite { text: String } = "units::not_finite", format!("`{text}` is not a finite number"),
        help "leave the field out if there is no such value";
    /// `0,5` for `0.5`, or `1,000` for `1000`: the string with a decimal point, if the comma can be
    /// one, and without the commas, if they can separate thousands.
    DecimalComma { decimal: Option<String>, thousands: Option<String> } = "units::decimal_comma",
        if thousands.is_none() { "decimal comma" } else { "comma in a number" },
        help comma(decimal.as_deref(), thousands.as_deref());
    /// `1 000` or `1'000` for `1000`.
    DigitGroups { fix: Option<String> } = "units::digit_groups", "number with its digits in groups",
        help fix.as_deref().map_or_else(|| "write the digits without separators".to_owned(), write);
    /// `7.7*10^-3 K/W` for `7.7e-3 K/W`.
    PowerOfTen { fix: String } = "units::power_of_ten", "a power of ten is part of a number",
        help write(fix);
    /// `2 P` for `2 * P`: the parameter in the position of a unit.
    MissingOperator { name: String, fix: String } = "units::missing_operator",
        format!("`{name}` is a parameter, not a unit"), help write(fix);
    /// Brackets, signs or powers nested more deeply than this.
    TooDeep { limit: usize } = "units::too_deep", format!("nested more than {limit} deep");
    /// No unit has this name; the string with the unit that was probably meant.
    UnknownUnit { name: String, fix: Option<String> } = "units::unknown_unit",
        format!("unknown unit `{name}`"),
        help match fix {
            Some(fix) => Some(format!("did you mean \"{fix}\"?")),
            None => calendar(name).map(str::to_owned),
        };
    /// A product after a division bar without brackets: `J/kg K`.
    AmbiguousProduct { fix: Option<String> } = "units::ambiguous_product",
        "product after `/` needs brackets",
        help fix.as_deref().map(write);
    /// `W/mK`, which is metre kelvin to nearly everyone, but millikelvin by the rules: the string
    /// in metre kelvin, if it can be meant.
    Millikelvin { fix: Option<String> } = "units::millikelvin",
        "`mK` below the bar may be metre kelvin or millikelvin",
        help match fix {
            Some(fix) => format!("{}; 1 W per millikelvin is 1000 W/K", write(fix)),
            None => "write it per kelvin: 1 W per millikelvin is 1000 W/K".to_owned(),
        };
    /// An exponent that cannot be read or does not fit, as written, or the power it belongs to.
    Exponent { text: String } = "units::exponent", format!("exponent `{text}` cannot be used"),
        help "write a whole number, a decimal or a fraction: m^2, s^0.5, rpm^(5/3)";
    /// The value has the wrong dimension.
    Dimension { wanted: Box<Type>, found: Box<Type>, fix: Option<String> } = "units::dimension",
        format!("must be {}, got {}", wanted.with_article(), got(found)),
        help match found.differs_by_radians(**wanted) {
            true if found.differs_by_a_turn(**wanted) => torque_turning(fix),
            true => turning(fix),
            false => fix.as_deref().map_or_else(|| unit_wanted("value", wanted), write),
        };
    /// A number without a unit, although one is expected; the string with the usual one.
    BareNumber { wanted: Type, fix: String } = "units::bare_number",
        format!("must be {}, got a number without a unit", wanted.with_article()),
        help bare_number(wanted, fix);
    /// `Hz` or `1/s` instead of a rotation; the string, or the part of an expression, in
    /// revolutions.
    Rotation { fix: Option<String> } = "units::rotation",
        "must be a rotational speed (rad/s), got a frequency: 1/s and Hz do not say what turns",
        help rotation(fix);
    /// A temperature difference instead of an absolute temperature. Either one text is meant, or
    /// `fix` counts from 0 K and `celsius` from 0 degC.
    AbsoluteWanted { fix: String, celsius: Option<String> } = "units::absolute_wanted",
        "must be an absolute temperature, got a temperature difference",
        help from_zero(fix, celsius.as_deref());
    /// An absolute temperature instead of a difference.
    DifferenceWanted { fix: String } = "units::difference_wanted",
        "must be a temperature difference, got an absolute temperature", help write(fix);
    /// An absolute temperature below 0 K.
    BelowAbsoluteZero { kelvin: f64 } = "units::below_absolute_zero",
        format!("temperature below absolute zero: {} K", rounded(*kelvin, 8)),
        help "0 K is -273.15 degC or -459.67 degF";
    /// A standard deviation below zero, as written.
    NegativeDeviation { text: String } = "units::negative_deviation",
        format!("negative standard deviation `{text}`"),
        help "the standard deviation after ± is zero or positive";
    /// An unknown distribution, or another word for one; the one that is meant.
    UnknownDistribution { word: String, meant: Option<Distribution> } = "units::distribution",
        format!("there is no distribution `{word}`"),
        help match meant {
            Some(Distribution::Normal) => {
                "leave it out: a deviation is normal by default".to_owned()
            }
            Some(meant) => format!("write `({})`", meant.word()),
            None => "there are `(rectangle)`, between two limits, `(lognormal)`, a factor, and \
                `(normal)`, which need not be written"
                .to_owned(),
        };
    /// A distribution after a value without a deviation.
    DistributionAlone { word: &'static str } = "units::distribution",
        format!("`({word})` is the distribution of a deviation, but there is no `±`"),
        help "write how far the value may be off before it: \"20 W ± 5 % (rectangle)\"";
    /// A lognormal value that is not more than zero, or an absolute temperature.
    Lognormal = "units::lognormal",
        "only a value more than zero that is not a temperature can be lognormal",
        help "leave `(lognormal)` out, or write a separate factor: \"1 ± 0.2 (lognormal)\"";
    /// `25 ± 5 % degC`: a percentage of an absolute temperature.
    RelativeDeviation { fix: Option<String> } = "units::relative_deviation",
        "percentage of an absolute temperature", help fix.as_deref().map(write);
    /// `0 W ± 10 %`: a percentage of 0 is nothing; the value with a deviation of 1 instead.
    DeviationOfZero { example: String } = "units::relative_deviation",
        "a percentage of 0 is 0, so the value would be exact",
        help format!(
            "write the deviation in the unit of the value, for example \"{example}\""
        );
    /// A deviation in percent with two readings: `0.8 ± 5 %`, `80 % ± 5 %`, `220 ± 5 % W`. The
    /// string if the percentage is of the same kind as the value, and if it is a part of the value.
    PercentDeviation { points: String, part: String } = "units::percent_deviation",
        "a deviation in percent that reads in two ways",
        help format!(
            "write \"{part}\" for a part of the value, or \"{points}\" for percentage points"
        );
    /// A deviation without a unit after a value that has one: `5 kW ± 1`.
    BareDeviation { fix: String } = "units::bare_number",
        "the deviation has no unit, but the value has one", help write(fix);
    /// A fraction instead of a number: `3/8 in`, `1 1/2 in`.
    Fraction { fix: String } = "units::fraction", "fraction instead of a number",
        help write(fix);
    /// `2 * m` while `m` is both a unit and a parameter.
    TwoReadings { name: String, quantity: String, expression: String } = "units::two_readings",
        format!("`{name}` is a unit and also a parameter, so that this reads in two ways"),
        help format!(
            "write \"{quantity}\" for the quantity or \"{expression}\" for the expression"
        );
    /// A unit without brackets in an expression.
    UnbracketedUnit { fix: String } = "units::unbracketed_unit",
        "unit without brackets in an expression",
        help write(fix);
    /// A bracket that follows neither a number nor, without space, a name.
    MisplacedBracket { fix: String } = "units::misplaced_bracket",
        "unit in brackets may only follow a number",
        help write(fix);
    /// No parameter, signal, node ... has this name; the nearest in scope.
    UnknownName { name: String, suggestion: Option<String> } = "units::unknown_name",
        format!("unknown name `{name}`"), help meant(suggestion);
    /// No function has this name; the nearest one.
    UnknownFunction { name: String, suggestion: Option<String> } = "units::unknown_function",
        format!("unknown function `{name}`"), help meant(suggestion);
    /// A wrong number of arguments; `wanted` is the right one, in words.
    Arity { function: &'static str, wanted: &'static str, found: usize } = "units::arity",
        format!("`{function}` takes {wanted}, got {found}");
    /// `-2^2`, which some read as 4 and some as -4: the power negated, and the negative number
    /// raised.
    AmbiguousSign { negated: String, raised: String } = "units::ambiguous_sign",
        "signed number with a power reads in two ways",
        help format!("write \"{negated}\" or \"{raised}\"");
    /// `a < b < c`.
    ChainedComparison = "units::chained_comparison", "comparison of a comparison",
        help "write \"if(a < b, if(b < c, x, y), y)\"";
    /// The two sides of `+`, `-`, a comparison, or two arguments, are of different types. The fix
    /// is for the part in question.
    Operands { operation: &'static str, left: Box<Type>, right: Box<Type>, fix: Option<String> } =
        "units::operands",
        format!("{operation} needs values of one kind, got {} and {}", got(left), got(right)),
        help match fix {
            _ if left.differs_by_a_turn(**right) => torque_turning(fix),
            _ if left.differs_by_radians(**right) => turning(fix),
            Some(fix) => write(fix),
            None => alike(left, right),
        };
    /// An absolute temperature in an operation that needs plain quantities; the operation in words:
    /// "multiplied". Either one text is meant, or `fix` counts from 0 K and `celsius` from 0 degC.
    AbsoluteOperand { operation: &'static str, fix: String, celsius: Option<String> } =
        "units::absolute_temperature",
        format!("an absolute temperature cannot be {operation}"),
        help from_zero(fix, celsius.as_deref());
    /// A function argument of the wrong type; the right one in words, and the string with the
    /// argument made a plain number by a scale of the same kind.
    Argument {
        function: &'static str, wanted: &'static str, found: Box<Type>, example: Option<String>
    } = "units::argument", format!("`{function}` takes {wanted}, got {}", got(found)),
        help example.as_ref().map(|example| {
            format!("divide it by {}, for example \"{example}\"", found.with_article())
        });
    /// A table called with a wrong number of arguments, or used without any; the fix has names in
    /// scope of the right kind.
    TableArity { table: String, wanted: Vec<Type>, found: usize, fix: Option<String> } =
        "units::arity", {
            let count = if wanted.len() == 1 { "one argument" } else { "two arguments" };
            format!("table `{table}` takes {count}, {}, got {found}", kinds(wanted))
        },
        help match fix {
            Some(fix) => write(fix),
            None => format!("write `{table}(..)` with {} between the brackets", kinds(wanted)),
        };
    /// An argument of a table, counted from 0, of the wrong type.
    TableArgument {
        table: String, argument: usize, wanted: Box<Type>, found: Box<Type>, fix: Option<String>
    } = "units::argument",
        format!("table `{table}` takes {}, got {}", wanted.with_article(), got(found)),
        help match fix {
            Some(fix) => write(fix),
            None => unit_wanted("argument", wanted),
        };
    /// A parameter or another name without arguments, called as if it were a table; the string
    /// without the call, a product if there is one argument.
    NotATable { name: String, fix: String } = "units::not_a_table",
        format!("`{name}` is not a table and takes no arguments"), help write(fix);
    /// A variable exponent on a base that has a dimension; the power with a plain base.
    VariableExponent { base: Type, fix: String } = "units::exponent",
        format!("power of a {} needs a constant exponent such as 2 or (5/3)", noun(base)),
        help write(fix);
    /// An exponent that has a dimension.
    ExponentDimension { found: Type } = "units::exponent",
        format!("exponent must be a plain number, got {}", got(found)),
        help "divide the exponent by its unit: \"x^(n / 1 [K])\"";
    /// A comparison instead of a value; the comparison inside an `if`.
    TruthValue { fix: String } = "units::truth", "comparison used as a value", help write(fix);
    /// A value instead of a comparison; the value compared with something.
    TruthWanted { fix: String } = "units::truth", "first argument of `if` must be a comparison",
        help write(fix);
}
}

impl UnitError {
    pub(crate) fn new(kind: UnitErrorKind, span: Range<usize>) -> Self {
        Self { kind, span }
    }

    /// The stable code, `units::dimension` and so on; it never changes once released.
    pub fn code(&self) -> &'static str {
        self.kind.code()
    }

    /// The correction.
    pub fn help(&self) -> Option<String> {
        self.kind.help()
    }

    /// The same error in a larger text: `at` bytes further on.
    pub(crate) fn shifted(mut self, at: usize) -> Self {
        self.span = self.span.start + at..self.span.end + at;
        self
    }

    /// Completes a fix for a unit to a fix for the text around it.
    pub(crate) fn map_fix(mut self, complete: impl Fn(&str) -> String) -> Self {
        if let UnitErrorKind::UnknownUnit { fix: Some(fix), .. }
        | UnitErrorKind::Millikelvin { fix: Some(fix) }
        | UnitErrorKind::AmbiguousProduct { fix: Some(fix) } = &mut self.kind
        {
            *fix = complete(fix);
        }
        self
    }
}

impl fmt::Display for UnitError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.kind.fmt(f)
    }
}

impl std::error::Error for UnitError {}

impl crate::Problem for UnitError {
    fn code(&self) -> &'static str {
        self.code()
    }

    fn help(&self) -> Option<String> {
        self.help()
    }
}
