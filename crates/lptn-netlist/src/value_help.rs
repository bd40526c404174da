//! Help for a value that its place cannot take.

use lptn_units::{Dimension, Type, parse_quantity};

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

/// Help for a number of kelvin that is meant as an absolute temperature. `line` writes it,
/// `where_to` adds its place.
pub(crate) fn celsius_or_kelvin(
    text: &str,
    line: impl Fn(&str) -> String,
    where_to: &str,
) -> Option<String> {
    let number = text.trim().strip_suffix('K')?.trim_end().trim_end_matches('*').trim_end();
    let ends_in_digit = number.ends_with(|c: char| c.is_ascii_digit() || c == '.');
    let (celsius, kelvin) =
        (line(&format!("{number} degC")), line(&format!("absolute({number} [K])")));
    ends_in_digit.then(|| format!("write {celsius}{where_to}, or {kelvin} if kelvin is meant"))
}
