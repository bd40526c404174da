//! `[control]`: thermostats.

use lptn_data::Diagnostic;
use lptn_network::{Acts, ControlId, Field, Input, Item, Network, Thermostat, is_name};
use lptn_units::{Dimension, Quantity, Type, Unit, format_number};

use crate::fields::Fields;
use crate::format::{ABSOLUTE, Role, SectionDeclaration, key, text, words, words_of};
use crate::names::ValueKind;
use crate::place::{Place, Wanted};
use crate::raw::{RawEntry, RawKind, RawValue};
use crate::source_map::SourceMap;
use crate::value_help::number_and_unit;
use crate::work::Elaboration;

const TIME: Type = Type::of(Dimension::TIME);

/// Help for keys of other kinds of controllers.
const BOTH: &str = "give both thresholds: `on_above` and `off_below` for cooling, `on_below` and \
    `off_above` for heating";

pub(crate) const CONTROL: SectionDeclaration = SectionDeclaration {
    name: ValueKind::Control.section(),
    sentence: "A thermostat; its name is 1 while it is on, else 0.",
    role: Role::Value,
    keys: &[
        text(
            "sense",
            "name",
            "the node or boundary that is sensed",
            "\"name of a node or boundary\"",
        )
        .needed(),
        key("on_above", ABSOLUTE, "cooling: switches on above it", "\"60 degC\""),
        key("off_below", ABSOLUTE, "cooling: switches off below it", "\"55 degC\""),
        key("on_below", ABSOLUTE, "heating: switches on below it", "\"18 degC\""),
        key("off_above", ABSOLUTE, "heating: switches off above it", "\"20 degC\""),
        words(
            "start",
            &words_of(&STARTS),
            "its state at the start, between the thresholds",
            "\"on\"",
        )
        .or("`\"off\"`"),
        key("min_dwell", "s", "the least time between two switches", "\"30 s\"").or("0 s"),
    ],
    example: "{ sense = \"a\", on_above = \"60 degC\", off_below = \"55 degC\" }",
    elsewhere: &[
        ("kind", "every control is a thermostat: leave `kind` out"),
        ("type", "every control is a thermostat: leave `type` out"),
        ("node", "the node or boundary that is sensed is `sense`"),
        ("of", "the node or boundary that is sensed is `sense`"),
        ("sensor", "the node or boundary that is sensed is `sense`"),
        ("setpoint", BOTH),
        ("hysteresis", BOTH),
        ("band", BOTH),
        ("initial", "whether it is on at the start is `start`"),
        ("dwell", "the least time between two switches is `min_dwell`"),
        (
            "P",
            "a switched value uses its name, which is 0 or 1: `P = \"100 [W] * name\"` of a \
             [source]",
        ),
    ],
    ..SectionDeclaration::NEW
};

/// State of a control at the start.
const STARTS: [(&str, bool); 2] = [("off", false), ("on", true)];

/// A dead band of fewer tolerances than this is within the error of a run.
const NARROW: f64 = 10.0;

impl<'a> Elaboration<'a> {
    /// Names every control, so that everything read afterwards may use it.
    pub(crate) fn controls(&mut self) -> Vec<(ControlId, &'a RawEntry)> {
        let mut declared = Vec::new();
        for entry in self.elements(CONTROL.name) {
            let id = self.builder.control(&entry.key);
            self.map.insert(Item::Control(id), Field::Name, entry.key_span.clone());
            declared.push((id, entry));
        }
        declared
    }

    /// Gives each control its thresholds, once the places that it can sense are known.
    pub(crate) fn thermostats(&mut self, declared: Vec<(ControlId, &'a RawEntry)>) {
        for (id, entry) in declared {
            if self.thermostat(id, entry).is_none() {
                // its errors have been reported
                self.left_out.items.insert(Item::Control(id));
            }
        }
    }

    fn thermostat(&mut self, id: ControlId, entry: &'a RawEntry) -> Option<()> {
        let fields = self.fields(&CONTROL, entry)?;
        let sense = self.end(&fields, "sense");
        let thresholds = self.thresholds(id, &fields);
        let (start, min_dwell) = (self.begins_on(&fields), self.dwell(id, &fields));
        let (sense, at) = sense?;
        self.map.value(Item::Control(id), Field::Sense, at);
        let (acts, [on, off]) = thresholds?;
        let (start, min_dwell) = (self.stands(&entry.key).unwrap_or(start?), min_dwell?);
        self.builder.thermostat(id, Thermostat { sense, acts, on, off, start, min_dwell });
        Some(())
    }

    /// The direction in which it acts, and its two thresholds.
    fn thresholds(&mut self, id: ControlId, fields: &Fields<'a>) -> Option<(Acts, [Input; 2])> {
        let acts = self.acts(fields);
        let every = [Acts::Cooling, Acts::Heating].map(Acts::fields);
        let mut given = Vec::new();
        for &field in every.as_flattened() {
            let Some(raw) = fields.get(field.key()) else { continue };
            self.map.value(Item::Control(id), field, raw);
            let place = Place { owner: &fields.owner, key: field.key(), raw };
            given
                .extend(self.given(place, Wanted::threshold()).map(|value| (field, value.input())));
        }
        let acts = acts?;
        let of = |field: Field| {
            given.iter().find(|(other, _)| *other == field).map(|(_, value)| value.clone())
        };
        let [on, off] = acts.fields().map(of);
        Some((acts, [on?, off?]))
    }

    /// Exactly one pair of thresholds, and all of it.
    fn acts(&mut self, fields: &Fields<'a>) -> Option<Acts> {
        let has = |acts: Acts| acts.fields().map(|field| fields.get(field.key()).is_some());
        let half = |acts: Acts, on: bool| {
            let [on_key, off_key] = acts.fields().map(Field::key);
            let (there, missing) = if on { (on_key, off_key) } else { (off_key, on_key) };
            fields.complete.then(|| half_a_pair(fields, there, missing))
        };
        let problem = match (has(Acts::Cooling), has(Acts::Heating)) {
            ([true, true], [false, false]) => return Some(Acts::Cooling),
            ([false, false], [true, true]) => return Some(Acts::Heating),
            ([false, false], [false, false]) => fields.complete.then(|| no_thresholds(fields)),
            ([on, _], [false, false]) => half(Acts::Cooling, on),
            ([false, false], [on, _]) => half(Acts::Heating, on),
            _ => Some(mixed(fields)),
        };
        self.problems.extend(problem);
        None
    }

    /// True if it is on at the start.
    fn begins_on(&mut self, fields: &Fields<'a>) -> Option<bool> {
        match fields.get("start") {
            Some(raw) if !matches!(raw.kind, RawKind::String { .. }) => {
                self.report(fields.wrong_shape("start", raw, "\"off\" or \"on\""));
                None
            }
            _ => self.choice(fields, "start", &STARTS),
        }
    }

    fn dwell(&mut self, id: ControlId, fields: &Fields<'a>) -> Option<Input> {
        let Some(raw) = fields.get("min_dwell") else {
            return Some(Quantity { value: 0.0, deviation: None, ty: TIME }.into());
        };
        self.map.value(Item::Control(id), Field::MinDwell, raw);
        let place = Place { owner: &fields.owner, key: "min_dwell", raw };
        self.given(place, Wanted::constant(TIME)).map(|given| given.input())
    }
}

/// Both pairs, as they could be written.
fn both_pairs() -> String {
    let [cooling, heating] = [Acts::Cooling, Acts::Heating]
        .map(|acts| acts.fields().map(|field| CONTROL.sample(field.key())).join(", "));
    format!("`{cooling}` for cooling or `{heating}` for heating")
}

fn no_thresholds(fields: &Fields<'_>) -> Diagnostic {
    let message = format!("{} does not say when it switches", fields.owner.words());
    Diagnostic::error("netlist::no_thresholds", message)
        .at(fields.place.clone(), "has no thresholds")
        .help(format!("add {}", both_pairs()))
}

fn half_a_pair(fields: &Fields<'_>, there: &str, missing: &str) -> Diagnostic {
    let message = format!("{} has `{there}` but no `{missing}`", fields.owner.words());
    let own = fields.get(there).and_then(|raw| beside(raw, there.ends_with("above")));
    let sample = own.map_or_else(|| fields.sample(missing), |own| format!("{missing} = \"{own}\""));
    let help = format!("add `{sample}`: a thermostat needs a dead band between two temperatures");
    fields.missing(missing, message).help(help)
}

/// The dead band of the help, in degrees of the unit of the threshold.
const BAND: f64 = 5.0;

/// The other threshold of a pair, a dead band below or above this one.
fn beside(raw: &RawValue, below: bool) -> Option<String> {
    let RawKind::String { text, .. } = &raw.kind else { return None };
    let (text, band) = (text.trim(), if below { -BAND } else { BAND });
    if is_name(text) {
        let sign = if below { '-' } else { '+' };
        return Some(format!("{text} {sign} {BAND} [K]"));
    }
    let (number, unit) = number_and_unit(text)?;
    let is_scale = Unit::parse(unit).is_ok_and(|unit| unit.ty.absolute);
    is_scale.then(|| format!("{} {unit}", format_number(number + band)))
}

/// Thresholds of both pairs.
fn mixed(fields: &Fields<'_>) -> Diagnostic {
    let message =
        format!("{} has thresholds for cooling as well as for heating", fields.owner.words());
    let pairs = [("cooling", Acts::Cooling), ("heating", Acts::Heating)];
    let keys =
        pairs.into_iter().flat_map(|(word, acts)| acts.fields().map(|field| (word, field.key())));
    let given =
        keys.filter_map(|(word, key)| Some((fields.key(key)?.clone(), format!("for {word}"))));
    let error = Diagnostic::error("netlist::two_thermostats", message).places(given);
    error.help(format!("keep one pair, {}", both_pairs()))
}

/// A warning for each control whose dead band the tolerance of the run, in K, does not resolve.
pub(crate) fn narrow(network: &Network, map: &SourceMap, tolerance: f64) -> Vec<Diagnostic> {
    let bands = network.control_ids().filter_map(|id| Some((id, network.dead_band(id)?)));
    // a band equal as written is enough: a difference of two temperatures has lost digits
    let narrow = bands.filter(|(_, band)| *band < NARROW * tolerance * (1.0 - 1e-6));
    narrow.map(|(id, band)| narrow_band(network, map, (id, band, tolerance))).collect()
}

fn narrow_band(
    network: &Network,
    map: &SourceMap,
    (id, band, tolerance): (ControlId, f64, f64),
) -> Diagnostic {
    let short = |x: f64| format_number(format!("{x:.2e}").parse().unwrap_or(x));
    let name = &network.controls()[id.index()].name;
    let message = format!(
        "the dead band of control `{name}`, {} K, is less than {NARROW} times the tolerance of the \
         run, {} K",
        short(band),
        short(tolerance)
    );
    let problem = Diagnostic::warning("netlist::narrow_dead_band", message);
    let fields = network.thermostat(id).map(|thermostat| thermostat.acts.fields());
    let places = fields.into_iter().flatten().filter_map(|field| map.get(Item::Control(id), field));
    let problem = problem.places(places.map(|span| (span, String::new())));
    problem.help(format!(
        "widen it, or write `tolerance = \"{} K\"` in [run]: the times of its switches are not \
         resolved",
        short(band / NARROW)
    ))
}
