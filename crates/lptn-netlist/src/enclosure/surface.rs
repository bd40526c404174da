//! Reads a surface of an enclosure.

use lptn_data::{Diagnostic, Span};
use lptn_units::{Dimension, Expression, Type, parse_quantity};

use super::SURFACE;
use crate::fields::Fields;
use crate::place::Place;
use crate::raw::{RawEntry, RawKind, RawValue};

/// A surface of an enclosure.
pub(super) struct Surface<'r> {
    pub(super) name: &'r str,
    /// The place of its name.
    pub(super) at: &'r Span,
    /// In m^2.
    pub(super) area: f64,
    pub(super) area_at: &'r Span,
    pub(super) emissivity: Emissivity,
    pub(super) emissivity_at: &'r Span,
}

/// The emissivity of a surface.
pub(super) enum Emissivity {
    /// 1, as a number.
    Black,
    /// A number below 1.
    Number(f64),
    /// An expression.
    Follows(String),
}

impl<'r> Surface<'r> {
    /// True if its emissivity is 1: it is its own radiosity.
    pub(super) fn is_black(&self) -> bool {
        matches!(self.emissivity, Emissivity::Black)
    }

    /// Reads a surface and reports its errors; `None` if there are any.
    pub(super) fn of(
        fields: &Fields<'r>,
        entry: &'r RawEntry,
        problems: &mut Vec<Diagnostic>,
    ) -> Option<Self> {
        let owner = fields.owner.inside(&format!("surfaces.{}", entry.key));
        let own = Fields::of(&SURFACE, owner, entry, problems)?;
        let (area, at) = (own.require("area", problems), own.require("emissivity", problems));
        let (area, at) = (area?, at?);
        let area_at = &area.span;
        let area = self::area(&own, area).map_err(|problem| problems.push(problem));
        let emissivity = self::emissivity(&own, at).map_err(|problem| problems.push(problem));
        let (area, emissivity) = (area.ok()?, emissivity.ok()?);
        let emissivity_at = &at.span;
        Some(Self {
            name: &entry.key,
            at: &entry.key_span,
            area,
            area_at,
            emissivity,
            emissivity_at,
        })
    }
}

/// An area in m^2.
fn area(fields: &Fields<'_>, raw: &RawValue) -> Result<f64, Diagnostic> {
    let text = text(fields, "area", raw, "an area")?;
    let place = Place { owner: &fields.owner, key: "area", raw };
    let found = match parse_quantity(text, Some(Type::of(Dimension::AREA))) {
        Ok(found) if found.value > 0.0 && found.value.is_finite() => return Ok(found.value),
        Err(error) if Expression::parse(text).is_ok_and(|e| e.names().is_empty()) => {
            return Err(place.unit_error(&error));
        }
        found => found,
    };
    let why = if found.is_ok() { "must be above 0" } else { "must be a number with its unit" };
    let message = format!("{} {why}", fields.owner.field("area"));
    let problem = Diagnostic::error("netlist::enclosure_area", message).at(raw.span.clone(), "");
    Err(problem.help("view factors belong to one set of areas: write `area = \"0.2 m^2\"`"))
}

/// An emissivity: a number from 0 to 1, or an expression.
fn emissivity(fields: &Fields<'_>, raw: &RawValue) -> Result<Emissivity, Diagnostic> {
    let text = text(fields, "emissivity", raw, "a number or an expression")?;
    let value = match parse_quantity(text, Some(Type::SCALAR)) {
        Ok(found) => found.value,
        Err(error) => {
            let follows = Expression::parse(text).is_ok_and(|e| !e.names().is_empty());
            let place = Place { owner: &fields.owner, key: "emissivity", raw };
            return if follows {
                Ok(Emissivity::Follows(text.to_owned()))
            } else {
                Err(place.unit_error(&error))
            };
        }
    };
    match value {
        1.0 => Ok(Emissivity::Black),
        value if value > 0.0 && value < 1.0 => Ok(Emissivity::Number(value)),
        value => {
            let message = format!(
                "{} must be above 0 and at most 1, got {value}",
                fields.owner.field("emissivity")
            );
            let problem = Diagnostic::error("network::not_a_fraction", message);
            let help = match value > 1.0 && value <= 100.0 {
                true => format!("for {value} % write `emissivity = \"{value} %\"`"),
                false => {
                    "polished metals have 0.03 to 0.1, painted surfaces 0.8 to 0.95".to_owned()
                }
            };
            Err(problem.at(raw.span.clone(), "").help(help))
        }
    }
}

fn text<'r>(
    fields: &Fields<'_>,
    key: &str,
    raw: &'r RawValue,
    wanted: &str,
) -> Result<&'r str, Diagnostic> {
    match &raw.kind {
        RawKind::String { text, .. } | RawKind::Integer(text) | RawKind::Float(text) => Ok(text),
        _ => Err(fields.wrong_shape(key, raw, wanted)),
    }
}
