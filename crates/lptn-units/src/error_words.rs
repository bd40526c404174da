//! Words that several errors share.

use crate::dimension::Dimension;
use crate::temperature::TemperatureScale;
use crate::types::Type;

/// Help for operands that must be of one of two types.
pub(crate) fn alike(left: &Type, right: &Type) -> String {
    let unit = |ty: &Type| match ty.is_scalar() {
        true => "without a unit".to_owned(),
        false => format!("in {}", ty.usual_unit()),
    };
    format!("give all of them {} or all {}", unit(left), unit(right))
}

/// A power of rad is left over.
pub(crate) fn turning(fix: &Option<String>) -> String {
    let ask = "a power of rad is left over: is a frequency (Hz, 1/s) meant as a rotational speed?";
    match fix {
        // radians as written: nothing turns
        Some(fix) if !["rev", "rpm"].iter().any(|unit| fix.contains(unit)) => write(fix),
        Some(fix) => {
            format!(
                "{ask} {} for revolutions, or give the speed in rpm, rev/s or rad/s",
                write(fix)
            )
        }
        None => format!("{ask} speeds are given in rpm, rev/s or rad/s"),
    }
}

/// A torque times a frequency instead of a power.
pub(crate) fn torque_turning(fix: &Option<String>) -> String {
    let speeds = "give the speed in rpm, rev/s or rad/s; an energy per cycle is written in J";
    match fix {
        Some(fix) if fix.contains("* 1 [rad]") => format!("{}, or {speeds}", write(fix)),
        Some(fix) => format!("{} for revolutions, or {speeds}", write(fix)),
        None => speeds.to_owned(),
    }
}

/// A frequency instead of a rotational speed.
pub(crate) fn rotation(fix: &Option<String>) -> String {
    match fix {
        Some(fix) if fix.contains("* 1 [rad]") => write(fix),
        Some(fix) => format!("{} for revolutions, or use rad/s, deg/s or rpm", write(fix)),
        None => "multiply revolutions per time by `1 [rev]`, radians per time by `1 [rad]`".into(),
    }
}

/// The text that is meant, or two: a temperature counts from 0 K or from 0 degC.
pub(crate) fn from_zero(fix: &str, celsius: Option<&str>) -> String {
    match celsius {
        Some(celsius) => {
            format!("{} to count from 0 K, \"{celsius}\" to count from 0 degC", write(fix))
        }
        None => write(fix),
    }
}

/// The possible meanings of a comma in a number.
pub(crate) fn comma(decimal: Option<&str>, thousands: Option<&str>) -> String {
    match (decimal, thousands) {
        (Some(decimal), Some(thousands)) => format!(
            "write \"{thousands}\" if the comma separates thousands, \"{decimal}\" if it is a \
             decimal comma"
        ),
        (Some(fix), None) | (None, Some(fix)) => write(fix),
        (None, None) => "write a decimal point, and no separators between the digits".to_owned(),
    }
}

/// A temperature without a unit may be in kelvin as well.
pub(crate) fn bare_number(wanted: &Type, fix: &str) -> String {
    if let Some(number) = fix.strip_suffix("rad").filter(|_| *wanted == ANGLE) {
        return format!("{} or \"{fix}\"", write(&format!("{number}deg")));
    }
    let Some(number) = fix.strip_suffix("degC").filter(|_| wanted.absolute) else {
        return write(fix);
    };
    let value = number.split_whitespace().next().and_then(|first| first.parse().ok());
    match value.map_or(TemperatureScale::Either, TemperatureScale::of) {
        TemperatureScale::Celsius => write(fix),
        TemperatureScale::Kelvin => write(&format!("{number}K")),
        TemperatureScale::Either => format!("{} or \"{number}K\"", write(fix)),
    }
}

const ANGLE: Type = Type::of(Dimension::ANGLE);

pub(crate) const WANTED_POWER: &str = "`^` for a power";
pub(crate) const WANTED_CALL: &str = "`(` after `if`";
pub(crate) const WANTED_CHOICE: &str = "`if(..)` for a choice";

pub(crate) fn syntax_help(wanted: &str, found: &str) -> Option<&'static str> {
    match (wanted, found) {
        (WANTED_POWER, _) => Some("a power is written with `^`: \"x^2\""),
        (WANTED_CALL | WANTED_CHOICE, _) | (_, "`then`" | "`else`") => Some(
            "write `if(condition, value, other value)`, for example \"if(t < 10 [min], 100 [W], 0 \
             [W])\"",
        ),
        (_, "`:`") => Some("a time is one number with its unit: \"25 min\""),
        (_, "`and`" | "`or`" | "`not`" | "`&`" | "`|`" | "`!`") => {
            Some("conditions are combined by nesting: \"if(a < b, if(c < d, x, y), y)\"")
        }
        _ => None,
    }
}

pub(crate) fn write(fix: &str) -> String {
    format!("write \"{fix}\"")
}

/// The words for a found type: the unit if it is unusual, name and unit if it is usual.
pub(crate) fn got(found: &Type) -> String {
    if found.dimension.is_torque_per_time() {
        return format!("a torque times a frequency ({})", found.dimension.si_unit());
    }
    if found.absolute || found.dimension.quantity_name().is_some() {
        found.with_article()
    } else {
        found.to_string()
    }
}

/// A name that is probably meant.
pub(crate) fn meant(suggestion: &Option<String>) -> Option<String> {
    suggestion.as_ref().map(|name| format!("did you mean `{name}`?"))
}

/// Help with the expected unit.
pub(crate) fn unit_wanted(what: &str, wanted: &Type) -> String {
    match wanted.is_scalar() {
        true => format!("the {what} must come out without a unit"),
        false => format!("the {what} must come out in {}", wanted.usual_unit()),
    }
}

/// The arguments of a table in words.
pub(crate) fn kinds(arguments: &[Type]) -> String {
    let kinds: Vec<String> = arguments.iter().map(Type::with_article).collect();
    kinds.join(" and ")
}

pub(crate) fn noun(ty: &Type) -> String {
    if ty.dimension.quantity_name().is_some() {
        ty.to_string()
    } else {
        format!("quantity in {ty}")
    }
}
