//! `[sensor.NAME]`: the output of an instrument for the temperature or heat flow that it measures.
//!
//! No temperature depends on a sensor, so it is a study instead of an element: only fits read it,
//! and their columns name it.
//!
//! A lag as a node with a capacity would be one more state of every run. An offset would need a
//! parameter that nothing else in the network uses.

use lptn_data::{Diagnostic, Span, nearest};
use lptn_network::Network;
use lptn_units::{Dimension, Distribution, Quantity, Spread, Type, parse_quantity};

use crate::fields::Fields;
use crate::format::{Role, SectionDeclaration, Takes, akin, shaped, words, words_of};
use crate::place::Place;
use crate::raw::{RawEntry, RawKind, RawNetlist, RawValue};
use crate::study::{PathFrom, Study};
use crate::toml_text::{TomlFields, string};
use crate::work::Elaboration;

const SENSOR: SectionDeclaration = SectionDeclaration {
    name: "sensor",
    sentence: "An instrument of records: its errors, and their uncertainty.",
    role: Role::Study,
    keys: &[
        akin(
            "offset",
            "as the column, with `±`, or `\"free\"`",
            "the constant error of its readings",
            "\"0 ± 3 K\"",
        )
        .or("none"),
        akin(
            "gain",
            "number, with `±`, or `\"free\"`",
            "the factor of its readings, in degC for a temperature",
            "\"1 ± 0.5 %\"",
        )
        .or("1"),
        shaped("lag", "s, with `±`", Takes::Quantity("s"), "its time constant", "\"20 s\"")
            .or("none"),
        akin("resolution", "as the column", "the step of its readings", "\"0.1 K\"").or("none"),
        words(
            "per",
            &words_of(&PER),
            "whether an offset belongs to the sensor, or to each \
            record",
            "\"record\"",
        )
        .or("`\"sensor\"`"),
    ],
    example: "{ offset = \"0 ± 3 K\" }",
    elsewhere: &[
        ("sigma", "the scatter of one sample is in the fit: `sigma = \"0.2 K\"`"),
        (
            "of",
            "the result that it measures is in the fit: `column = { ring = { of = \"steel.T\", \
             sensor = \"tc1\" } }`",
        ),
        (
            "node",
            "the result that it measures is in the fit: `column = { ring = { of = \"steel.T\", \
             sensor = \"tc1\" } }`",
        ),
        ("tau", "the time constant is `lag`"),
    ],
    ..SectionDeclaration::NEW
};

/// The word for a value without prior knowledge.
const FREE: &str = "free";

const PER: [(&str, bool); 2] = [("sensor", false), ("record", true)];

/// Prior knowledge of a value of a sensor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Certainty {
    /// It is exactly the given value.
    Exact,
    /// To this standard deviation; a fit estimates it.
    Deviation(f64),
    /// None; a fit estimates it.
    Free,
}

/// A value of a sensor in SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SensorValue {
    /// The value, or the start of its estimation.
    pub value: f64,
    /// Prior knowledge of it.
    pub certainty: Certainty,
}

impl SensorValue {
    /// A value that is exact.
    pub const fn exact(value: f64) -> Self {
        Self { value, certainty: Certainty::Exact }
    }

    /// True if a fit has to estimate it.
    pub fn is_estimated(&self) -> bool {
        self.certainty != Certainty::Exact
    }
}

/// One `[sensor.NAME]`, in SI units. If x is a temperature in degC, it shows `gain y + offset` in
/// degC, where `lag dy/dt = x - y`. Any other measured quantity is x itself.
#[derive(Clone, Debug)]
pub struct Sensor {
    /// Its name.
    pub name: String,
    /// Its place.
    pub span: Span,
    /// In the SI unit of the columns that it gave, K for a temperature.
    pub offset: SensorValue,
    /// A factor.
    pub gain: SensorValue,
    /// In s; 0 without one.
    pub lag: SensorValue,
    /// The step of its numbers in the same unit.
    pub resolution: Option<f64>,
    /// True if an offset that is estimated differs between records.
    pub per_record: bool,
    /// Its fields as they are written.
    written: Vec<(&'static str, String)>,
}

impl Study for Sensor {
    const SECTION: &'static SectionDeclaration = &SENSOR;

    fn one<'a>(work: &mut Elaboration<'a>, entry: &'a RawEntry) -> Option<Self> {
        work.sensor(entry)
    }

    fn read(work: &mut Elaboration<'_>) -> Vec<Self> {
        let used = in_use(work.raw);
        let entries = work.elements(SENSOR.name);
        let found = entries.iter().filter_map(|entry| Self::one(work, entry)).collect();
        for entry in entries.iter().filter(|entry| !used.contains(&entry.key.as_str())) {
            let message =
                format!("no column of a fit or an inference names sensor `{}`", entry.key);
            let help = format!(
                "name it with a column, `ring = {{ of = \"steel.T\", sensor = \"{}\" }}`, or \
                 remove it",
                entry.key
            );
            work.report(Diagnostic::doubt(
                "netlist::unused_sensor",
                message,
                &entry.key_span,
                help,
            ));
        }
        found
    }

    fn name(&self) -> &str {
        &self.name
    }

    fn check(&self, _: &Network) -> Vec<Diagnostic> {
        Vec::new()
    }

    fn fields(&self, _: &Network, _: &PathFrom<'_>) -> TomlFields {
        let mut fields = TomlFields::default();
        self.written.iter().for_each(|(key, written)| fields.put(key, written));
        fields
    }
}

/// The names of the sensors that columns and signals of fits and inferences, and places of plans,
/// use.
fn in_use(raw: &RawNetlist) -> Vec<&str> {
    let fits = ["fit", "infer"].into_iter().flat_map(|section| raw.elements(section));
    let fits = fits.flat_map(|fit| ["column", "signal"].map(|key| inside(&fit.value, key)));
    let fits = fits.flatten();
    let plans = raw.elements("plan").iter().filter_map(|plan| inside(&plan.value, "place"));
    let columns = fits.chain(plans).filter_map(|column| match &column.kind {
        RawKind::Table(table) => Some(&table.entries),
        _ => None,
    });
    let named = columns.flatten().filter_map(|column| inside(&column.value, "sensor"));
    named
        .filter_map(|name| match &name.kind {
            RawKind::String { text, .. } => Some(text.as_str()),
            _ => None,
        })
        .collect()
}

fn inside<'r>(value: &'r RawValue, key: &str) -> Option<&'r RawValue> {
    match &value.kind {
        RawKind::Table(table) => table.get(key).map(|entry| &entry.value),
        _ => None,
    }
}

impl<'a> Elaboration<'a> {
    fn sensor(&mut self, entry: &'a RawEntry) -> Option<Sensor> {
        let fields = self.fields(&SENSOR, entry)?;
        let own = type_of(entry).unwrap_or(Type::of(Dimension::TEMPERATURE));
        let offset = self.sensor_value(&fields, "offset", own);
        let gain = self.sensor_value(&fields, "gain", Type::SCALAR);
        let lag = self.sensor_value(&fields, "lag", Type::of(Dimension::TIME));
        let resolution = self.sensor_value(&fields, "resolution", own);
        let per_record = self.choice(&fields, "per", &PER);
        let offset = offset?.unwrap_or(SensorValue::exact(0.0));
        if per_record? && !offset.is_estimated() {
            let why = "has no effect on an offset that is known";
            self.refuse_keys(&fields, &["per"], why);
        }
        let written = SENSOR.keys.iter().filter_map(|key| Some((key.name, fields.get(key.name)?)));
        Some(Sensor {
            name: entry.key.clone(),
            span: entry.key_span.clone(),
            offset,
            gain: gain?.unwrap_or(SensorValue::exact(1.0)),
            lag: lag?.unwrap_or(SensorValue::exact(0.0)),
            resolution: resolution?.map(|resolution| resolution.value),
            per_record: per_record?,
            written: written.map(|(key, raw)| (key, as_written(raw))).collect(),
        })
    }

    /// `sensor = "tc1"` of a measurement of this type; `Some(None)` if there is none.
    pub(crate) fn sensor_of(
        &mut self,
        fields: &Fields<'a>,
        measured: Option<Type>,
    ) -> Option<Option<(&'a str, &'a RawValue)>> {
        let Some(raw) = fields.get("sensor") else { return Some(None) };
        let name = fields.text("sensor", raw, &mut self.problems)?;
        let all = self.elements(SENSOR.name);
        let Some(entry) = all.iter().find(|entry| entry.key == name) else {
            let message = format!("{}: there is no sensor `{name}`", fields.owner.words());
            let known: Vec<&str> = all.iter().map(|entry| entry.key.as_str()).collect();
            let help = match known.is_empty() {
                true => format!("write its section: `[sensor.{name}]` with `offset = \"0 ± 3 K\"`"),
                false => nearest(name, known, "the sensors are"),
            };
            self.refuse("netlist::fit_sensor", message, &raw.span, help);
            return None;
        };
        match (type_of(entry), measured) {
            (Some(own), Some(ty)) if own.dimension != ty.dimension => {
                let message = format!(
                    "{} is in {}, but its sensor `{name}` reads in {}",
                    fields.owner.words(),
                    ty.dimension.si_unit(),
                    own.dimension.si_unit()
                );
                let problem = Diagnostic::error("netlist::fit_sensor", message)
                    .at(raw.span.clone(), "")
                    .also(entry.key_span.clone(), "this sensor");
                self.report(problem.help(
                    "`offset` and `resolution` of a sensor are in the unit of the columns that it gave",
                ));
                None
            }
            _ => Some(Some((name, raw))),
        }
    }

    /// A value in its field; `Some(None)` if it is left out, `None` if it is wrong.
    fn sensor_value(
        &mut self,
        fields: &Fields<'a>,
        key: &'static str,
        ty: Type,
    ) -> Option<Option<SensorValue>> {
        let Some(raw) = fields.get(key) else { return Some(None) };
        let text = match &raw.kind {
            RawKind::String { text, .. } | RawKind::Integer(text) | RawKind::Float(text) => {
                text.trim()
            }
            _ => {
                self.report(fields.wrong_shape(key, raw, "a quantity"));
                return None;
            }
        };
        if let Some((message, help)) = misread(key, text) {
            let message = format!("{} {message}", fields.owner.field(key));
            self.refuse("netlist::sensor_value", message, &raw.span, &help);
            return None;
        }
        if text == FREE {
            let value = if key == "gain" { 1.0 } else { 0.0 };
            return Some(Some(SensorValue { value, certainty: Certainty::Free }));
        }
        if text.starts_with('±') {
            let (words, neutral) = (fields.owner.field(key), if key == "gain" { "1" } else { "0" });
            let message = format!("{words} has a `±` without a value before it");
            let help = format!("write `{key} = \"{neutral} {text}\"`");
            self.refuse("netlist::sensor_prior", message, &raw.span, help);
            return None;
        }
        let quantity = match percent_of(text).map_or_else(|| parse_quantity(text, Some(ty)), Ok) {
            Ok(quantity) => quantity,
            Err(error) => {
                self.report(Place { owner: &fields.owner, key, raw }.unit_error(&error));
                return None;
            }
        };
        if let Some((code, why, help)) = unsound(key, &quantity) {
            let message = format!("{} {why}", fields.owner.field(key));
            self.refuse(code, message, &raw.span, help);
            return None;
        }
        let sigma = quantity.deviation.map(|spread| spread.sigma(quantity.value));
        let certainty = sigma.map_or(Certainty::Exact, Certainty::Deviation);
        Some(Some(SensorValue { value: quantity.value, certainty }))
    }
}

/// The type of differences of a sensor's readings, as far as its own values show it.
fn type_of(entry: &RawEntry) -> Option<Type> {
    ["offset", "resolution"].into_iter().find_map(|key| match &inside(&entry.value, key)?.kind {
        RawKind::String { text, .. } => {
            let ty = parse_quantity(text.trim(), None).ok()?.ty;
            (!ty.absolute && !ty.is_scalar()).then_some(ty)
        }
        _ => None,
    })
}

/// The reason why a quantity cannot be this value of a sensor: code, error, and help.
fn unsound(key: &str, quantity: &Quantity) -> Option<(&'static str, &'static str, &'static str)> {
    let value = quantity.value;
    let deviation = quantity.deviation.map(|spread| spread.sigma(value));
    match (key, deviation) {
        ("resolution", Some(_)) => Some((
            "netlist::sensor_prior",
            "has a `±`, but a fit does not estimate a resolution",
            "write the step alone: `resolution = \"0.1 K\"`",
        )),
        (_, Some(deviation)) if deviation <= 0.0 => Some((
            "netlist::sensor_prior",
            "is known to ± 0",
            "write the value alone if it is exact, or its uncertainty after `±`",
        )),
        ("gain" | "resolution" | "lag", _) if value <= 0.0 => Some((
            "netlist::sensor_value",
            "has to be more than zero",
            "leave it out if there is none: a gain is near 1, a lag is a time constant, a \
             resolution a step of readings",
        )),
        _ if quantity.deviation.is_some_and(|d| d.distribution == Distribution::Lognormal) => {
            Some((
                "netlist::sensor_prior",
                "is `(lognormal)`, but the prior of a sensor counts as normal",
                "write it without `(lognormal)`: no fit takes a gain or a lag below 0, and an offset \
                 is as often below 0 as above",
            ))
        }
        _ => None,
    }
}

/// The error of a value as it is written, and help.
fn misread(key: &str, text: &str) -> Option<(String, String)> {
    let takes_free = matches!(key, "offset" | "gain");
    if text.eq_ignore_ascii_case(FREE) && !(takes_free && text == FREE) {
        let alone = format!(
            "cannot be `{text}`: only an offset or a gain can be estimated without \
            a prior"
        );
        return Some(match key {
            "offset" | "gain" => {
                (format!("cannot be `{text}`"), format!("write `{key} = \"{FREE}\"`"))
            }
            "lag" => {
                let help = "write its approximate time constant, and the uncertainty: `lag = \"20 \
                            ± 10 s\"`";
                (alone, help.to_owned())
            }
            _ => (alone, format!("write the step: `{key} = \"0.1 K\"`")),
        });
    }
    if key != "gain" || percent_of(text).is_some() {
        return None;
    }
    let known = parse_quantity(&in_percent(text)?, Some(Type::SCALAR)).ok()?;
    let (value, message) = (known.value, format!("is {text}, and a gain is near 1"));
    let help = match known.deviation {
        Some(spread) => {
            let sigma = (value * spread.sigma(known.value) / 100.0).abs();
            format!("if it multiplies by {value}, write `gain = \"{value} ± {sigma}\"`")
        }
        None => format!("a gain that is known to {text} is `gain = \"1 ± {text}\"`"),
    };
    Some((message, help))
}

/// A value in percent without its sign: `1 ± 0.5` of `1 ± 0.5 %`, followed by its distribution.
fn in_percent(text: &str) -> Option<String> {
    let (before, behind) = text.rsplit_once('%')?;
    let behind = behind.trim();
    let distribution = behind.is_empty() || (behind.starts_with('(') && behind.ends_with(')'));
    distribution.then(|| format!("{} {behind}", before.trim()).trim().to_owned())
}

/// `1 ± 0.5 %`, which elsewhere could be percentage points: there are no gains of one percent.
fn percent_of(text: &str) -> Option<Quantity> {
    let quantity = parse_quantity(&in_percent(text)?, Some(Type::SCALAR)).ok()?;
    let near_one = (0.5..2.0).contains(&quantity.value);
    let deviation = quantity.deviation.filter(|_| near_one)?;
    let sigma = quantity.value * deviation.sigma(quantity.value) / 100.0;
    let deviation = Spread::of(quantity.value, sigma, deviation.distribution);
    Some(Quantity { deviation: Some(deviation), ..quantity })
}

fn as_written(raw: &RawValue) -> String {
    match &raw.kind {
        RawKind::Integer(text) | RawKind::Float(text) => text.clone(),
        RawKind::String { text, .. } => string(text),
        _ => String::new(),
    }
}
