//! A constant of a run or a window before it is evaluated: `--set` may change its parameters.

use lptn_data::Span;
use lptn_network::Value;
use lptn_units::{Dimension, Quantity, Type, format_number};

use crate::fields::{Fields, Owner};
use crate::place::{Given, Place, Wanted};
use crate::raw::RawValue;
use crate::toml_text::string;
use crate::work::Elaboration;

pub(crate) const TIME: Type = Type::of(Dimension::TIME);

/// A value with its place.
#[derive(Clone, Debug)]
pub(crate) struct Setting {
    pub(crate) value: Value,
    pub(crate) span: Span,
    pub(crate) words: String,
    pub(crate) unit: String,
    pub(crate) help: String,
}

impl Setting {
    /// Its text as a field of a netlist, in SI units.
    pub(crate) fn written(&self) -> String {
        match &self.value {
            Value::Constant(number) if self.unit == "1" => format_number(*number),
            Value::Constant(number) => format!("\"{} {}\"", format_number(*number), self.unit),
            other => other
                .programs()
                .first()
                .map_or_else(String::new, |program| string(program.text().trim())),
        }
    }
}

impl Elaboration<'_> {
    /// A value that must not have a `±`: this would be silently ignored.
    pub(crate) fn exactly(&mut self, place: Place<'_>, wanted: Wanted) -> Option<Value> {
        let given = self.given(place, wanted)?;
        if let Given::Quantity(quantity) = &given {
            self.without_deviation(place, quantity)?;
        }
        Some(given.value())
    }

    /// The same for a field of a table inside a field.
    pub(crate) fn exactly_inside(
        &mut self,
        owner: &Owner<'_>,
        (key, raw): (&str, &RawValue),
        wanted: Wanted,
    ) -> Option<Value> {
        self.exactly(Place { owner: &owner.inside(key), key: "", raw }, wanted)
    }

    /// Reports a `±`.
    pub(crate) fn without_deviation(
        &mut self,
        place: Place<'_>,
        quantity: &Quantity,
    ) -> Option<()> {
        if quantity.deviation.is_none() {
            return Some(());
        }
        let message = format!("`±` has no effect on {}", place.words());
        let help = "write the value alone, or put the uncertainty on a parameter in [param] or a \
            value of a [sensor]";
        self.refuse("netlist::useless_deviation", message, &place.raw.span, help);
        None
    }

    pub(crate) fn setting(
        &mut self,
        owner: &Owner<'_>,
        (key, raw): (&str, &RawValue),
        ty: Type,
    ) -> Option<Setting> {
        let place = Place { owner, key, raw };
        let words = place.words();
        let value = self.exactly(place, Wanted::constant(ty))?;
        let help = format!("write it like this: `{}`", owner.sample(key));
        Some(Setting { value, span: raw.span.clone(), words, unit: ty.usual_unit(), help })
    }

    /// A value of the declared type; `Some(None)` if it is left out, `None` if it is wrong.
    pub(crate) fn optional_setting(
        &mut self,
        fields: &Fields<'_>,
        key: &str,
    ) -> Option<Option<Setting>> {
        let Some(raw) = fields.get(key) else { return Some(None) };
        Some(Some(self.setting(&fields.owner, (key, raw), fields.owner.ty(key))?))
    }

    /// The standard deviation and time of a drift, if there is one.
    pub(crate) fn drift(
        &mut self,
        (owner, span, code): (&Owner<'_>, &Span, &'static str),
        drift: (Option<Setting>, Option<Setting>),
    ) -> Option<Option<(Setting, Setting)>> {
        let (is, not) = match drift {
            (Some(drift), Some(time)) => return Some(Some((drift, time))),
            (None, None) => return Some(None),
            (Some(_), None) => ("drift", "drift_time"),
            (None, Some(_)) => ("drift_time", "drift"),
        };
        let message = format!("{} has `{is}`, but no `{not}`", owner.words());
        let help = "give the size of the drift and its correlation time: `drift = \"0.05 K\"` and \
                    `drift_time = \"5 min\"`";
        self.refuse(code, message, span, help);
        None
    }
}
