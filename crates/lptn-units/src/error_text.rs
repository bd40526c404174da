//! Codes, messages and help of [`UnitErrorKind`].

use crate::error::UnitErrorKind as Kind;
use crate::types::Type;

pub(crate) fn code(kind: &Kind) -> &'static str {
    match kind {
        Kind::Empty => "units::empty",
        Kind::Syntax { .. } => "units::syntax",
        Kind::OutOfRange { .. } => "units::out_of_range",
        Kind::NotFinite { .. } => "units::not_finite",
        Kind::DecimalComma { .. } => "units::decimal_comma",
        Kind::DigitGroups { .. } => "units::digit_groups",
        Kind::PowerOfTen { .. } => "units::power_of_ten",
        Kind::MissingOperator { .. } => "units::missing_operator",
        Kind::TooDeep { .. } => "units::too_deep",
        Kind::UnknownUnit { .. } => "units::unknown_unit",
        Kind::AmbiguousProduct { .. } => "units::ambiguous_product",
        Kind::Exponent { .. } | Kind::VariableExponent { .. } | Kind::ExponentDimension { .. } => {
            "units::exponent"
        }
        Kind::Dimension { .. } => "units::dimension",
        Kind::BareNumber { .. } => "units::bare_number",
        Kind::Rotation { .. } => "units::rotation",
        Kind::AbsoluteWanted { .. } => "units::absolute_wanted",
        Kind::DifferenceWanted { .. } => "units::difference_wanted",
        Kind::BelowAbsoluteZero { .. } => "units::below_absolute_zero",
        Kind::NegativeDeviation { .. } => "units::negative_deviation",
        Kind::RelativeDeviation { .. } => "units::relative_deviation",
        Kind::PercentDeviation { .. } => "units::percent_deviation",
        Kind::BareDeviation { .. } => "units::bare_number",
        Kind::Fraction { .. } => "units::fraction",
        Kind::TwoReadings { .. } => "units::two_readings",
        Kind::UnbracketedUnit { .. } => "units::unbracketed_unit",
        Kind::MisplacedBracket { .. } => "units::misplaced_bracket",
        Kind::UnknownName { .. } => "units::unknown_name",
        Kind::UnknownFunction { .. } => "units::unknown_function",
        Kind::Arity { .. } | Kind::TableArity { .. } => "units::arity",
        Kind::NotATable { .. } => "units::not_a_table",
        Kind::AmbiguousSign { .. } => "units::ambiguous_sign",
        Kind::ChainedComparison => "units::chained_comparison",
        Kind::Operands { .. } => "units::operands",
        Kind::AbsoluteOperand { .. } => "units::absolute_temperature",
        Kind::Argument { .. } | Kind::TableArgument { .. } => "units::argument",
        Kind::TruthValue { .. } | Kind::TruthWanted { .. } => "units::truth",
    }
}

pub(crate) fn message(kind: &Kind) -> String {
    match kind {
        Kind::Dimension { wanted, found, .. } => {
            format!("must be {}, got {}", wanted.with_article(), got(found))
        }
        Kind::BareNumber { wanted, .. } => {
            format!("must be {}, got a number without a unit", wanted.with_article())
        }
        Kind::Rotation { .. } => {
            "must be a rotational speed (rad/s), got a frequency: 1/s and Hz do not say what turns".to_owned()
        }
        Kind::AbsoluteWanted { .. } => {
            "must be an absolute temperature, got a temperature difference".to_owned()
        }
        Kind::DifferenceWanted { .. } => {
            "must be a temperature difference, got an absolute temperature".to_owned()
        }
        Kind::BelowAbsoluteZero { kelvin } => {
            format!("temperature below absolute zero: {} K", crate::format::rounded(*kelvin, 8))
        }
        Kind::Operands { operation, left, right, .. } => {
            format!("{operation} needs values of one kind, got {} and {}", got(left), got(right))
        }
        Kind::AbsoluteOperand { operation, .. } => format!("an absolute temperature cannot be {operation}"),
        Kind::Argument { function, wanted, found, .. } => {
            format!("`{function}` takes {wanted}, got {}", got(found))
        }
        Kind::TableArity { table, wanted, found, .. } => {
            let count = if wanted.len() == 1 { "one argument" } else { "two arguments" };
            format!("table `{table}` takes {count}, {}, got {found}", kinds(wanted))
        }
        Kind::TableArgument { table, wanted, found, .. } => {
            format!("table `{table}` takes {}, got {}", wanted.with_article(), got(found))
        }
        Kind::VariableExponent { base, .. } => {
            format!("power of a {} needs a constant exponent such as 2 or (5/3)", noun(base))
        }
        Kind::ExponentDimension { found } => {
            format!("exponent must be a plain number, got {}", got(found))
        }
        Kind::TruthValue { .. } => "comparison used as a value".to_owned(),
        Kind::TruthWanted { .. } => "first argument of `if` must be a comparison".to_owned(),
        _ => text_message(kind),
    }
}

/// Messages about the text itself.
fn text_message(kind: &Kind) -> String {
    match kind {
        Kind::Empty => "empty string, expected a quantity or an expression".to_owned(),
        Kind::Syntax { wanted, found } => format!("expected {wanted}, found {found}"),
        Kind::OutOfRange { number } => format!("number `{number}` is out of range"),
        Kind::NotFinite { text } => format!("`{text}` is not a finite number"),
        Kind::DecimalComma { thousands: None, .. } => "decimal comma".to_owned(),
        Kind::DecimalComma { .. } => "comma in a number".to_owned(),
        Kind::DigitGroups { .. } => "number with its digits in groups".to_owned(),
        Kind::PowerOfTen { .. } => "a power of ten is part of a number".to_owned(),
        Kind::MissingOperator { name, .. } => format!("`{name}` is a parameter, not a unit"),
        Kind::TooDeep { limit } => format!("nested more than {limit} deep"),
        Kind::UnknownUnit { name, .. } => format!("unknown unit `{name}`"),
        Kind::AmbiguousProduct { .. } => "product after `/` needs brackets".to_owned(),
        Kind::Exponent { text } => format!("exponent `{text}` cannot be used"),
        Kind::NegativeDeviation { text } => format!("negative standard deviation `{text}`"),
        Kind::RelativeDeviation { .. } => "percentage of an absolute temperature".to_owned(),
        Kind::PercentDeviation { .. } => "a deviation in percent that reads in two ways".to_owned(),
        Kind::BareDeviation { .. } => "the deviation has no unit, but the value has one".to_owned(),
        Kind::Fraction { .. } => "fraction in the place of a number".to_owned(),
        Kind::TwoReadings { name, .. } => {
            format!("`{name}` is a unit and also a parameter, so that this reads in two ways")
        }
        Kind::UnbracketedUnit { .. } => "unit without brackets in an expression".to_owned(),
        Kind::MisplacedBracket { .. } => "unit in brackets may only follow a number".to_owned(),
        Kind::UnknownName { name, .. } => format!("unknown name `{name}`"),
        Kind::UnknownFunction { name, .. } => format!("unknown function `{name}`"),
        Kind::NotATable { name, .. } => format!("`{name}` is no table and takes no arguments"),
        Kind::Arity { function, wanted, found } => {
            format!("`{function}` takes {wanted}, got {found}")
        }
        Kind::AmbiguousSign { .. } => "signed number with a power reads in two ways".to_owned(),
        Kind::ChainedComparison => "comparison of a comparison".to_owned(),
        other => format!("{other:?}"),
    }
}

pub(crate) fn help(kind: &Kind) -> Option<String> {
    match kind {
        Kind::BareNumber { wanted, fix } => Some(bare_number(wanted, fix)),
        Kind::DecimalComma { decimal, thousands } => Some(comma(decimal.as_deref(), thousands.as_deref())),
        Kind::PowerOfTen { fix }
        | Kind::MissingOperator { fix, .. }
        | Kind::UnbracketedUnit { fix }
        | Kind::MisplacedBracket { fix }
        | Kind::AbsoluteWanted { fix }
        | Kind::DifferenceWanted { fix }
        | Kind::AbsoluteOperand { fix, .. }
        | Kind::VariableExponent { fix, .. }
        | Kind::TruthValue { fix }
        | Kind::TruthWanted { fix }
        | Kind::BareDeviation { fix }
        | Kind::Fraction { fix }
        | Kind::NotATable { fix, .. } => Some(write(fix)),
        Kind::PercentDeviation { points, part } => Some(percent(points, part)),
        Kind::AmbiguousProduct { fix } | Kind::RelativeDeviation { fix } => fix.as_deref().map(write),
        Kind::DigitGroups { fix } => {
            Some(fix.as_deref().map_or_else(|| "write the digits without separators".to_owned(), write))
        }
        Kind::Operands { left, right, fix, .. } if left.differs_by_radians(**right) => Some(turning(fix)),
        Kind::Operands { fix: Some(fix), .. } => Some(write(fix)),
        Kind::Operands { left, right, .. } => Some(alike(left, right)),
        Kind::Argument { found, example, .. } => example
            .as_ref()
            .map(|example| format!("divide it by {}, for example \"{example}\"", found.with_article())),
        Kind::Syntax { wanted, found } => syntax_help(wanted, found).map(str::to_owned),
        Kind::UnknownUnit { fix, .. } => fix.as_deref().map(|fix| format!("did you mean \"{fix}\"?")),
        Kind::TableArity { table, wanted, fix, .. } => Some(match fix {
            Some(fix) => write(fix),
            None => format!("write `{table}(..)` with {} between the brackets", kinds(wanted)),
        }),
        Kind::TableArgument { wanted, fix, .. } => Some(match fix {
            Some(fix) => write(fix),
            None => format!("the argument must come out in {}", wanted.usual_unit()),
        }),
        Kind::Dimension { wanted, found, fix } if found.differs_by_radians(**wanted) => Some(turning(fix)),
        Kind::Dimension { wanted, fix, .. } => Some(match fix {
            Some(fix) => write(fix),
            None if wanted.is_scalar() => "the value must come out without a unit".to_owned(),
            None => format!("the value must come out in {}", wanted.usual_unit()),
        }),
        Kind::Rotation { fix } => Some(match fix {
            Some(fix) => format!("{} for revolutions, or use rad/s, deg/s or rpm", write(fix)),
            None => "multiply the frequency by `1 [rev]`".to_owned(),
        }),
        Kind::TwoReadings { quantity, expression, .. } => {
            Some(format!("write \"{quantity}\" for the quantity or \"{expression}\" for the expression"))
        }
        Kind::AmbiguousSign { negated, raised } => Some(format!("write \"{negated}\" or \"{raised}\"")),
        Kind::UnknownName { suggestion, .. } | Kind::UnknownFunction { suggestion, .. } => {
            suggestion.as_ref().map(|name| format!("did you mean `{name}`?"))
        }
        _ => fixed_help(kind).map(str::to_owned),
    }
}

/// That operands are to be of one of two types.
fn alike(left: &Type, right: &Type) -> String {
    let unit = |ty: &Type| match ty.is_scalar() {
        true => "without a unit".to_owned(),
        false => format!("in {}", ty.usual_unit()),
    };
    format!("give all of them {} or all {}", unit(left), unit(right))
}

/// Help that does not depend on what was written.
fn fixed_help(kind: &Kind) -> Option<&'static str> {
    match kind {
        Kind::Empty => Some("write a quantity such as \"0.3 K/W\" or an expression such as \"2 * G\""),
        Kind::NotFinite { .. } => Some("leave the field out if there is no such value"),
        Kind::Exponent { .. } => Some("write a whole number, a decimal or a fraction: m^2, s^0.5, rpm^(5/3)"),
        Kind::NegativeDeviation { .. } => Some("the standard deviation after ± is zero or positive"),
        Kind::BelowAbsoluteZero { .. } => Some("0 K is -273.15 degC or -459.67 degF"),
        Kind::ChainedComparison => Some("write \"if(a < b, if(b < c, x, y), y)\""),
        Kind::ExponentDimension { .. } => Some("divide the exponent by its unit: \"x^(n / 1 [K])\""),
        _ => None,
    }
}

/// A power of rad is left over.
fn turning(fix: &Option<String>) -> String {
    let ask = "a power of rad is left over: is a frequency (Hz, 1/s) meant as a rotational speed?";
    match fix {
        // radians that somebody wrote: nothing turns
        Some(fix) if !["rev", "rpm"].iter().any(|unit| fix.contains(unit)) => write(fix),
        Some(fix) => {
            format!("{ask} {} for revolutions, or give the speed in rpm, rev/s or rad/s", write(fix))
        }
        None => format!("{ask} speeds are given in rpm, rev/s or rad/s"),
    }
}

/// What a comma in a number may mean.
fn comma(decimal: Option<&str>, thousands: Option<&str>) -> String {
    match (decimal, thousands) {
        (Some(decimal), Some(thousands)) => format!(
            "write \"{thousands}\" if the comma separates thousands, \"{decimal}\" if it is a decimal comma"
        ),
        (Some(fix), None) | (None, Some(fix)) => write(fix),
        (None, None) => "write a decimal point, and no separators between the digits".to_owned(),
    }
}

/// What a deviation in percent may mean.
fn percent(points: &str, part: &str) -> String {
    format!("write \"{part}\" for a part of the value, or \"{points}\" for percentage points")
}

/// A temperature without a unit may be in kelvin as well.
fn bare_number(wanted: &Type, fix: &str) -> String {
    match fix.strip_suffix("degC").filter(|number| wanted.absolute && !number.starts_with(['-', '\u{2212}']))
    {
        Some(number) => format!("write \"{fix}\" or \"{number}K\""),
        None => write(fix),
    }
}

pub(crate) const WANTED_POWER: &str = "`^` for a power";
pub(crate) const WANTED_CALL: &str = "`(` after `if`";
pub(crate) const WANTED_CHOICE: &str = "`if(..)` for a choice";

fn syntax_help(wanted: &str, found: &str) -> Option<&'static str> {
    match (wanted, found) {
        (WANTED_POWER, _) => Some("a power is written with `^`: \"x^2\""),
        (WANTED_CALL | WANTED_CHOICE, _) | (_, "`then`" | "`else`") => Some(
            "write `if(condition, value, other value)`, for example \"if(t < 10 [min], 100 [W], 0 [W])\"",
        ),
        (_, "`:`") => Some("a time is one number with its unit: \"25 min\""),
        (_, "`and`" | "`or`" | "`not`" | "`&`" | "`|`" | "`!`") => {
            Some("conditions are combined by nesting: \"if(a < b, if(c < d, x, y), y)\"")
        }
        _ => None,
    }
}

fn write(fix: &str) -> String {
    format!("write \"{fix}\"")
}

/// How a found type is called: by its unit if it is unusual, by name and unit if it is usual.
fn got(found: &Type) -> String {
    if found.absolute || found.dimension.quantity_name().is_some() {
        found.with_article()
    } else {
        found.to_string()
    }
}

/// What a table takes.
fn kinds(arguments: &[Type]) -> String {
    let kinds: Vec<String> = arguments.iter().map(Type::with_article).collect();
    kinds.join(" and ")
}

fn noun(ty: &Type) -> String {
    if ty.dimension.quantity_name().is_some() { ty.to_string() } else { format!("quantity in {ty}") }
}
