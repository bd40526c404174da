//! Data that a fit takes from each record in addition to the compared columns: time histories of
//! signals and the initial state.

use lptn_data::{Diagnostic, Span, nearest};
use lptn_units::{Dimension, Type, parse_quantity};

use crate::fields::{Fields, wrong_shape};
use crate::fit::{FIT_SIGNAL, FitStudy};
use crate::names::ValueKind;
use crate::place::Place;
use crate::raw::{RawEntry, RawKind};
use crate::reading::all;
use crate::toml_text::{TomlFields, key as toml_key, quantity, string};
use crate::work::Elaboration;

/// A signal that follows a column of each record.
#[derive(Clone, Debug)]
pub struct FitSignal {
    /// The signal.
    pub name: String,
    /// The column.
    pub column: String,
    /// Its instrument, by name, if one is named here; else that of the same column among those that
    /// are compared.
    pub sensor: Option<String>,
    /// Its type.
    pub ty: Type,
    /// The place of its name.
    pub span: Span,
}

/// Initial temperatures of nodes whose temperature is a column.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FitInitial {
    /// Those of the network.
    Network,
    /// At the first value of the record.
    First,
    /// At the mean of the first values of the record, up to this time in s.
    Mean(f64),
}

const TIME: Type = Type::of(Dimension::TIME);

impl FitStudy {
    pub(crate) fn put_recorded(&self, fields: &mut TomlFields) {
        let signal = |s: &FitSignal| {
            let (name, column) = (toml_key(&s.name), string(&s.column));
            match &s.sensor {
                Some(own) => format!("{name} = {{ column = {column}, sensor = {} }}", string(own)),
                None => format!("{name} = {column}"),
            }
        };
        fields.table("signal", self.signals.iter().map(signal));
        if self.drop_outliers {
            fields.word("outliers", "drop");
        }
        match self.initial {
            FitInitial::Network => {}
            FitInitial::First => fields.word("initial", "record"),
            FitInitial::Mean(seconds) => fields.put("initial", quantity(seconds, TIME)),
        }
    }
}

impl<'a> Elaboration<'a> {
    /// `signal = { speed = "omega", hall = { … } }`; `None` after an error, which is reported.
    pub(super) fn fit_signals(&mut self, fields: &Fields<'a>) -> Option<Vec<FitSignal>> {
        let Some(raw) = fields.get("signal") else { return Some(Vec::new()) };
        let RawKind::Table(table) = &raw.kind else {
            self.report(fields.wrong_shape("signal", raw, "a table of signals and columns"));
            return None;
        };
        all(table.entries.iter().map(|entry| self.fit_signal(fields, entry)))
    }

    fn fit_signal(&mut self, fields: &Fields<'a>, entry: &'a RawEntry) -> Option<FitSignal> {
        let owner = fields.owner.inside("signal").inside(&entry.key);
        let inner = match &entry.value.kind {
            RawKind::Table(_) => Some(self.inner(&FIT_SIGNAL, owner.clone(), entry)?),
            _ => None,
        };
        let raw = match &inner {
            Some(inner) => self.require(inner, "column")?,
            None => &entry.value,
        };
        let RawKind::String { text, .. } = &raw.kind else {
            let sample = format!("{} = \"omega\"", entry.key);
            self.report(wrong_shape(&owner.words(), raw, "the name of a column", &sample));
            return None;
        };
        let is_signal = |kind: Option<&(ValueKind, Span, usize)>| {
            kind.is_some_and(|(kind, ..)| *kind == ValueKind::Signal)
        };
        if !is_signal(self.names.values.get(&entry.key)) {
            let words = fields.owner.field("signal");
            let message = format!("{words} names `{}`, which is not a signal", entry.key);
            let signals = self.elements(ValueKind::Signal.section()).iter();
            let signals: Vec<&str> = signals.map(|entry| entry.key.as_str()).collect();
            let help = match signals.is_empty() {
                true => format!(
                    "write one to begin with, `[signal]` with `{} = \"25 degC\"`, and use it in a \
                     boundary or a source",
                    entry.key
                ),
                false => nearest(&entry.key, signals, "the signals are"),
            };
            self.refuse("netlist::fit_signal", message, &entry.key_span, help);
            return None;
        }
        let ty = self.type_here(&entry.key)?;
        let sensor = match &inner {
            Some(inner) => self.sensor_of(inner, Some(ty))?.map(|(name, _)| name.to_owned()),
            None => None,
        };
        let (name, column, span) = (entry.key.clone(), text.clone(), raw.span.clone());
        Some(FitSignal { name, column, sensor, ty, span })
    }

    /// `initial = "record"` or `initial = "10 s"`.
    pub(super) fn fit_initial(&mut self, fields: &Fields<'a>) -> Option<FitInitial> {
        let Some(raw) = fields.get("initial") else { return Some(FitInitial::Network) };
        let text = fields.text("initial", raw, &mut self.problems)?;
        if text == "record" {
            return Some(FitInitial::First);
        }
        let place = Place { owner: &fields.owner, key: "initial", raw };
        match parse_quantity(text, Some(TIME)) {
            Ok(quantity) if quantity.value >= 0.0 => {
                self.without_deviation(place, &quantity)?;
                Some(FitInitial::Mean(quantity.value))
            }
            Ok(_) => {
                let message = format!("{} is less than zero", place.words());
                let help = "write \"record\" for the first row, or the duration of the mean, \"10 \
                    s\"";
                self.refuse("netlist::fit_initial", message, &raw.span, help);
                None
            }
            Err(error) => {
                let problem: Diagnostic = place.unit_error(&error);
                self.report(problem);
                None
            }
        }
    }
}
