//! Help for a value that its place cannot take.

use lptn_units::{Dimension, Type, Unit, parse_quantity};

use crate::raw::{RawEntry, RawKind};

/// The line of a parameter that is a bare number, or a kelvin value in a place for a point on the
/// temperature scale.
pub(crate) fn parameter_help(entry: &RawEntry, ty: Type) -> Option<String> {
    let text = match &entry.value.kind {
        RawKind::String { text, .. } | RawKind::Integer(text) | RawKind::Float(text) => text.trim(),
        _ => return None,
    };
    let found = parse_quantity(text, None).ok()?.ty;
    let line = |value: &str| format!("`{} = \"{value}\"`", entry.key);
    if found.is_scalar() && text.ends_with(|c: char| c.is_ascii_digit()) {
        return Some(format!("write {} in [param]", line(&format!("{text} {}", ty.usual_unit()))));
    }
    if ty.absolute && found == Type::of(Dimension::ANGLE) {
        let number = text.trim_end_matches(|c: char| !c.is_ascii_digit());
        return Some(format!("write {} in [param]", line(&format!("{number} degC"))));
    }
    if ty.absolute && found == Type::of(Dimension::TEMPERATURE) {
        return celsius_or_kelvin(text, line, " in [param]");
    }
    None
}

/// True if a value is a number without a unit.
pub(crate) fn is_bare(entry: &RawEntry) -> bool {
    match &entry.value.kind {
        RawKind::String { text, .. } | RawKind::Integer(text) | RawKind::Float(text) => {
            text.trim().parse::<f64>().is_ok()
        }
        _ => false,
    }
}

/// The number and the unit of a text like `15 W/(m^2 K)`.
pub(crate) fn number_and_unit(text: &str) -> Option<(f64, &str)> {
    let text = text.trim();
    let unit = text.trim_start_matches(|c: char| c.is_ascii_digit() || "+-.".contains(c));
    let number = text.strip_suffix(unit)?.parse().ok()?;
    Unit::parse(unit.trim()).is_ok().then_some((number, unit.trim()))
}

/// The least number, in K, that is more likely a temperature in K than in degC.
const WARM: f64 = 200.0;

/// Help for a number of kelvin that is meant as an absolute temperature. `line` writes it,
/// `where_to` adds its place. The likelier reading comes first.
pub(crate) fn celsius_or_kelvin(
    text: &str,
    line: impl Fn(&str) -> String,
    where_to: &str,
) -> Option<String> {
    let number = text.trim().strip_suffix('K')?.trim_end().trim_end_matches('*').trim_end();
    let ends_in_digit = number.ends_with(|c: char| c.is_ascii_digit() || c == '.');
    let (celsius, kelvin) =
        (line(&format!("{number} degC")), line(&format!("absolute({number} [K])")));
    let warm = number.parse::<f64>().is_ok_and(|number| number > WARM);
    ends_in_digit.then(|| match warm {
        true => format!("write {kelvin}{where_to}, or {celsius} if degrees Celsius are meant"),
        false => format!("write {celsius}{where_to}, or {kelvin} if kelvin is meant"),
    })
}
