//! `[default]`: what holds unless said otherwise.

use lptn_data::Diagnostic;
use lptn_network::Input;
use lptn_units::{Dimension, Type, Unit, UnitError};

use crate::fields::{Fields, Owner};
use crate::place::{Place, Wanted};
use crate::raw::RawValue;
use crate::vocabulary::DEFAULT;
use crate::work::{Elaboration, stand_in};

/// A temperature at the start, and where it stands.
pub(crate) type Initial<'a> = (Input, &'a RawValue);

/// The values of `[default]`.
pub(crate) struct Default<'a> {
    /// Temperature of the nodes at the start.
    pub(crate) initial: Option<Initial<'a>>,
    /// Unit of temperatures in results.
    pub(crate) temperature_unit: Unit,
}

impl<'a> Elaboration<'a> {
    pub(crate) fn defaults(&mut self) -> Default<'a> {
        let mut default = Default { initial: None, temperature_unit: celsius() };
        let Some(entry) = self.raw.top.get(DEFAULT.name) else { return default };
        let Some(fields) = Fields::of(&DEFAULT, Owner::section(DEFAULT.name), entry, &mut self.problems)
        else {
            return default;
        };
        if let Some(raw) = fields.get("T0") {
            let place = Place { owner: &fields.owner, key: "T0", raw };
            let given = self.given(place, Wanted::constant(Type::ABSOLUTE_TEMPERATURE));
            let input = given.map_or_else(|| stand_in(Type::ABSOLUTE_TEMPERATURE), |given| given.input());
            self.map.set_default(raw.span.clone());
            default.initial = Some((input, raw));
        }
        if let Some(raw) = fields.get("temperature_unit")
            && let Some(text) = fields.text("temperature_unit", raw, &mut self.problems)
        {
            match temperature_unit(text) {
                Ok(unit) => default.temperature_unit = unit,
                Err(error) => self.report(bad_unit(&fields.owner, raw, text, error.as_ref())),
            }
        }
        if !fields.complete && default.initial.is_none() {
            // the unknown key may be the missing `T0`
            default.initial = Some((stand_in(Type::ABSOLUTE_TEMPERATURE), &entry.value));
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

fn bad_unit(owner: &Owner, raw: &RawValue, text: &str, error: Option<&UnitError>) -> Diagnostic {
    let words = owner.field("temperature_unit");
    let message = match error {
        Some(error) => format!("{words}: {error}"),
        None => format!("{words} must be a unit of temperature, got `{text}`"),
    };
    let code = error.map_or("netlist::temperature_unit", UnitError::code);
    Diagnostic::error(code, message)
        .at(raw.span.clone(), "")
        .help("write `temperature_unit = \"degC\"`, or \"K\", \"degF\"")
}
