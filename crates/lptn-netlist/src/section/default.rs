//! `[default]`: default values.

use lptn_data::Diagnostic;
use lptn_network::Input;
use lptn_units::{Dimension, Type, Unit, UnitError};

use crate::fields::Owner;
use crate::format::{ABSOLUTE, Role, SectionDeclaration, key, text};
use crate::place::Wanted;
use crate::raw::RawValue;
use crate::work::{Elaboration, stand_in};

pub(crate) const DEFAULT: SectionDeclaration = SectionDeclaration {
    name: "default",
    sentence: "Defaults for all elements.",
    role: Role::Default,
    keys: &[
        key("T0", ABSOLUTE, "temperature of the nodes at the start", "\"25 degC\""),
        text("temperature_unit", "unit", "unit of temperatures in results", "\"degC\"")
            .or("`\"degC\"`"),
    ],
    example: "{ T0 = \"25 degC\" }",
    ..SectionDeclaration::NEW
};

/// An initial temperature, and its place.
pub(crate) type Initial<'a> = (Input, &'a RawValue);

/// The values of `[default]`.
pub(crate) struct Default<'a> {
    /// Initial temperature of the nodes.
    pub(crate) initial: Option<Initial<'a>>,
    /// Unit of temperatures in results.
    pub(crate) temperature_unit: Unit,
}

impl<'a> Elaboration<'a> {
    pub(crate) fn defaults(&mut self) -> Default<'a> {
        let mut default = Default { initial: None, temperature_unit: celsius() };
        let Some(entry) = self.raw.top.get(DEFAULT.name) else { return default };
        let Some(fields) = self.inner(&DEFAULT, Owner::section(DEFAULT.name), entry) else {
            return default;
        };
        let ty = Type::ABSOLUTE_TEMPERATURE;
        let read = |work: &mut Self| work.input(&fields, "T0", Wanted::constant(ty));
        if let (Some(raw), Some(input)) = (fields.get("T0"), self.replaced_by_state(read)) {
            self.map.set_default(raw.span.clone());
            default.initial = Some((input, raw));
        }
        if let Some((text, raw)) = self.word(&fields, "temperature_unit") {
            match temperature_unit(text) {
                Ok(unit) => default.temperature_unit = unit,
                Err(error) => self.report(bad_unit(&fields.owner, raw, text, error.as_ref())),
            }
        }
        if !fields.complete && default.initial.is_none() {
            // the unknown key may be the missing `T0`
            default.initial = Some((stand_in(ty), &entry.value));
        }
        default
    }
}

fn celsius() -> Unit {
    Unit {
        text: "degC".into(),
        scale: 1.0,
        offset: lptn_network::ZERO_CELSIUS,
        ty: Type::ABSOLUTE_TEMPERATURE,
    }
}

/// A unit for absolute temperatures; `K` alone is one here.
fn temperature_unit(text: &str) -> Result<Unit, Option<UnitError>> {
    let unit = Unit::parse(text).map_err(Some)?;
    if unit.ty.dimension != Dimension::TEMPERATURE {
        return Err(None);
    }
    Ok(Unit { ty: Type::ABSOLUTE_TEMPERATURE, ..unit })
}

fn bad_unit(
    owner: &Owner<'_>,
    raw: &RawValue,
    text: &str,
    error: Option<&UnitError>,
) -> Diagnostic {
    let words = owner.field("temperature_unit");
    let message = match error {
        Some(error) => format!("{words}: {error}"),
        None => format!("{words} must be a unit of temperature, got `{text}`"),
    };
    let code = error.map_or("netlist::temperature_unit", UnitError::code);
    Diagnostic::wrong(
        code,
        message,
        &raw.span,
        "write `temperature_unit = \"degC\"`, or \"K\", \"degF\"",
    )
}
