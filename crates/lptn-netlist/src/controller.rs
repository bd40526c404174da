//! `[controller.NAME]`: a PI, PD or PID controller, written out as parameters, named values and
//! states before anything is read.
//!
//! The output is `u = min(max(v, min), max)` with `v = K_p e + I - K_d (d sensed/dt)`, and the
//! integral follows `dI/dt = K_i e + (u - v) / tracking`: at a limit it goes back to the limit
//! (back-calculation; K. J. Åström and R. M. Murray, Feedback Systems, 2nd edition, Princeton 2021,
//! section 11.4). Nothing switches, so a controller has no events. The derivative is that of the
//! sensed temperature after a lag of first order: a step of the set point causes no impulse.
//!
//! With `sample` the output and the integral are sampled states: the sensor is read at each sample,
//! and the output stays until the next one. The integral is a sum (rectangles), and the derivative
//! the backward difference after the lag.
//!
//! Parameters of a controller have names, `NAME.K_p`, so that sweeps and fits can change them.

use std::sync::Arc;

use lptn_data::{Diagnostic, Span};
use lptn_units::{Dimension, Type, parse_quantity};

use crate::fields::{Fields, Owner};
use crate::format::{Role, SectionDeclaration, akin, key, text, words, words_of};
use crate::names::ValueKind;
use crate::raw::{RawEntry, RawKind, RawNetlist, RawValue};
use crate::template::Structure;
use crate::written_out::WrittenOut;

pub(crate) const CONTROLLER: SectionDeclaration = SectionDeclaration {
    name: "controller",
    sentence: "A PI, PD or PID controller; its name is its output.",
    role: Role::Element,
    keys: &[
        text("sense", "name", "the node or boundary that is sensed", "\"sensor\"").needed(),
        akin(
            "setpoint",
            "temperature or expression",
            "the temperature that is wanted",
            "\"200 degC\"",
        )
        .needed(),
        akin("K_p", "quantity or expression", "output for an error of 1 K", "\"0.03 1/K\"")
            .needed(),
        akin(
            "K_i",
            "quantity or expression",
            "its change per second for an error of 1 K",
            "\"0.0005 1/(K s)\"",
        ),
        akin(
            "K_d",
            "quantity or expression",
            "output for 1 K/s of the sensed temperature",
            "\"0.1 s/K\"",
        ),
        key("lag", "s", "time constant of the derivative", "\"2 s\""),
        akin("min", "quantity or expression", "the least output", "0").needed(),
        akin("max", "quantity or expression", "the greatest output", "1").needed(),
        akin("start", "quantity or expression", "the integral at the start", "0").or("0"),
        key("tracking", "s", "time in which the integral goes back to a limit", "\"60 s\"")
            .or("`abs(K_p / K_i)`"),
        key(
            "sample",
            "s",
            "time between samples; without it the controller acts at every moment",
            "\"0.1 s\"",
        ),
        words("acts", &words_of(&ACTS), "more output warms or cools", "\"cooling\"")
            .or("`\"heating\"`"),
    ],
    example: "{ sense = \"a\", setpoint = \"60 degC\", K_p = \"5 W/K\", K_i = \"0.1 W/(K s)\", min = \
        \"0 W\", max = \"100 W\" }",
    elsewhere: &[
        ("sensor", "the node or boundary that is sensed is `sense`"),
        ("input", "the node or boundary that is sensed is `sense`"),
        ("set", "the temperature that is wanted is `setpoint`"),
        ("Kp", "the proportional gain is `K_p`"),
        ("Ki", "the integral gain is `K_i`"),
        ("Kd", "the derivative gain is `K_d`"),
        ("T_i", "the integral gain is `K_i`: `K_p / T_i`"),
        ("T_d", "the derivative gain is `K_d`: `K_p * T_d`"),
        ("on_above", "a thermostat is a [control]"),
        ("sampling", "the time between samples is `sample`"),
        ("every", "the time between samples is `sample`"),
    ],
    ..SectionDeclaration::NEW
};

/// Direction, by its word: true if more output warms.
const ACTS: [(&str, bool); 2] = [("heating", true), ("cooling", false)];

/// Keys that become parameters, signals or named values `NAME.KEY`.
const GIVEN: [&str; 10] =
    ["setpoint", "K_p", "K_i", "K_d", "lag", "min", "max", "start", "tracking", "sample"];

/// Values `NAME.KEY` that are not results.
pub(crate) const INNER: [&str; 3] = ["error", "demand", "limited"];

/// Replaces every controller by its values and states; the types that some of these have to have.
pub(crate) fn expand(
    raw: &mut RawNetlist,
    structure: &mut Arc<Structure>,
    problems: &mut Vec<Diagnostic>,
) -> Vec<(String, Type)> {
    let mut types = Vec::new();
    for entry in raw.take(CONTROLLER.name) {
        let owner = Owner::element(CONTROLLER.name, &entry.key);
        let Some(fields) = Fields::of(&CONTROLLER, owner, &entry, problems) else { continue };
        match Controller::read((raw, structure), (&entry, &fields), problems) {
            Some(made) => {
                let typed = TYPES.map(|(key, ty)| (format!("{}.{key}", entry.key), ty));
                types.extend(
                    typed.into_iter().filter(|(name, _)| made.iter().any(|m| m.1.key == *name)),
                );
                made.into_iter().for_each(|(section, entry)| raw.push(section, entry));
            }
            None => Arc::make_mut(structure).lose(&entry.key),
        }
    }
    types
}

/// The types of keys that do not follow from those of the output.
const TYPES: [(&str, Type); 4] = [
    ("setpoint", Type::ABSOLUTE_TEMPERATURE),
    ("lag", Type::of(Dimension::TIME)),
    ("tracking", Type::of(Dimension::TIME)),
    ("sample", Type::of(Dimension::TIME)),
];

/// Elements with their sections.
type Made = Vec<(&'static str, RawEntry)>;

struct Controller<'r> {
    raw: &'r RawNetlist,
    structure: &'r Structure,
    fields: &'r Fields<'r>,
    sense: &'r str,
    out: WrittenOut<'r>,
}

impl<'r> Controller<'r> {
    fn read(
        (raw, structure): (&'r RawNetlist, &'r Structure),
        (entry, fields): (&'r RawEntry, &'r Fields<'r>),
        problems: &mut Vec<Diagnostic>,
    ) -> Option<Made> {
        let needed = ["sense", "setpoint", "K_p", "min", "max"];
        let there = needed.map(|key| fields.require(key, problems).is_some());
        let sense = fields.text("sense", fields.get("sense")?, problems)?;
        let out = WrittenOut::new((raw, structure), entry);
        let mut new = Self { raw, structure, fields, sense, out };
        let warms = new.warms(problems)?;
        new.pairs(problems)?;
        new.constants(problems)?;
        new.numbers(problems)?;
        new.has_temperature(problems)?;
        if there.contains(&false) {
            return None;
        }
        new.given();
        new.values(warms);
        new.states(problems)?;
        Some(new.out.made)
    }

    /// True if more output warms.
    fn warms(&self, problems: &mut Vec<Diagnostic>) -> Option<bool> {
        let Some(raw) = self.fields.get("acts") else { return Some(true) };
        let text = self.fields.text("acts", raw, problems)?;
        let found = ACTS.iter().find(|(word, _)| *word == text).map(|(_, warms)| *warms);
        if found.is_none() {
            let message = format!("{} cannot be \"{text}\"", self.fields.owner.field("acts"));
            let help = "it is \"heating\" or \"cooling\"";
            problems.push(Diagnostic::wrong("netlist::unknown_word", message, &raw.span, help));
        }
        found
    }

    /// Refuses keys that have no effect without another one.
    fn pairs(&self, problems: &mut Vec<Diagnostic>) -> Option<()> {
        let pairs = [("lag", "K_d"), ("start", "K_i"), ("tracking", "K_i")];
        let mut right = true;
        for (key, needs) in pairs {
            let (Some(at), None) = (self.fields.key(key), self.fields.get(needs)) else { continue };
            right = false;
            let message =
                format!("{} has no effect without `{needs}`", self.fields.owner.field(key));
            let help = format!("remove `{key}`, or add `{needs}`");
            problems.push(Diagnostic::wrong("netlist::useless_key", message, at, help));
        }
        if self.fields.get("K_d").is_some() {
            right &= self.fields.require("lag", problems).is_some();
        }
        right.then_some(())
    }

    /// Refuses values that change, if the states of the controller need them at the start: their
    /// start, their size and the time between samples.
    fn constants(&self, problems: &mut Vec<Diagnostic>) -> Option<()> {
        let before = problems.len();
        let with_states = self.fields.get("K_i").is_some() || self.is_sampled();
        let keys = ["min", "max", "start", "sample"].into_iter().filter(|_| with_states);
        for (key, raw) in keys.filter_map(|key| Some((key, self.fields.get(key)?))) {
            let Some((name, timed)) = self.out.changing(raw) else { continue };
            let message =
                format!("{} has to be constant, but reads `{name}`", self.fields.owner.field(key));
            let h = self.out.here;
            let help = match key {
                "min" | "max" => format!(
                    "keep `{key}` constant and limit the output after the controller: `[value] \
                     {h}_limited = \"{}({h}, ..)\"`, which elements then read instead of `{h}`",
                    if key == "max" { "min" } else { "max" }
                ),
                _ => "give it a constant, or an expression of parameters".to_owned(),
            };
            let code =
                ["network::depends_on_result", "network::depends_on_time"][usize::from(timed)];
            problems.push(Diagnostic::wrong(code, message, &raw.span, help));
        }
        (problems.len() == before).then_some(())
    }

    /// The number of a key in SI units, if it is written as one.
    fn number(&self, key: &str) -> Option<(f64, &'r Span)> {
        let raw = self.fields.get(key)?;
        let text = match &raw.kind {
            RawKind::String { text, .. } | RawKind::Integer(text) | RawKind::Float(text) => text,
            _ => return None,
        };
        Some((parse_quantity(text, None).ok()?.value, &raw.span))
    }

    /// Refuses limits that are exchanged, and gains of 0 that `tracking` divides by.
    fn numbers(&self, problems: &mut Vec<Diagnostic>) -> Option<()> {
        let owner = &self.fields.owner;
        let before = problems.len();
        if let (Some((min, _)), Some((max, at))) = (self.number("min"), self.number("max"))
            && min >= max
        {
            let message = format!("{} is not above `min`", owner.field("max"));
            let help = "exchange them: `min` is the least output, `max` the greatest";
            problems.push(Diagnostic::wrong("netlist::controller_limits", message, at, help));
        }
        let gains = [
            ("K_i", "leave `K_i` out: a controller without it is proportional"),
            (
                "K_p",
                "add the time in which the integral goes back to a limit: `tracking = \"60 s\"`",
            ),
        ];
        let default = self.fields.get("K_i").is_some() && self.fields.get("tracking").is_none();
        for (key, help) in gains.into_iter().filter(|_| default) {
            let Some((_, at)) = self.number(key).filter(|(value, _)| *value == 0.0) else {
                continue;
            };
            let message =
                format!("`{key}` of {} is 0, and `tracking` is `abs(K_p / K_i)`", owner.words());
            problems.push(Diagnostic::wrong("netlist::controller_tracking", message, at, help));
        }
        (problems.len() == before).then_some(())
    }

    /// Refuses a sensed name that is a value, which has no temperature.
    fn has_temperature(&self, problems: &mut Vec<Diagnostic>) -> Option<()> {
        let at = &self.fields.get("sense")?.span;
        let full = self.structure.resolve(at, self.sense);
        let is = |kind: &&ValueKind| {
            self.raw.elements(kind.section()).iter().any(|entry| entry.key == full)
        };
        let kinds = [ValueKind::State, ValueKind::Value, ValueKind::Parameter, ValueKind::Signal];
        let own = self.out.entry.key == full;
        let Some(word) =
            kinds.iter().find(is).map(|kind| kind.word()).or(own.then_some("controller"))
        else {
            return Some(());
        };
        let message = format!(
            "{} is {word} `{full}`, which has no temperature",
            self.fields.owner.field("sense")
        );
        let help = "name a [node] or a [boundary]: the controller senses its temperature";
        problems.push(Diagnostic::wrong("netlist::controller_sense", message, at, help));
        None
    }

    /// The keys that are written, each with a name.
    fn given(&mut self) {
        let fields = self.fields;
        for name in GIVEN {
            if let Some(value) = fields.get(name) {
                self.out.given(name, value);
            }
        }
        let (k_i, h) = (fields.get("K_i").is_some(), self.out.here);
        if k_i && fields.get("start").is_none() {
            self.out.text(ValueKind::Parameter.section(), "start", format!("0 * {h}.max"));
        }
    }

    /// The error, the output before its limits, and the output.
    fn values(&mut self, warms: bool) {
        let (h, sense, value) = (self.out.here, self.sense, ValueKind::Value.section());
        let error = match warms {
            true => format!("{h}.setpoint - {sense}.T"),
            false => format!("{sense}.T - {h}.setpoint"),
        };
        let mut demand = format!("{h}.K_p * {h}.error");
        if self.fields.get("K_i").is_some() {
            demand += &format!(" + {h}.integral");
        }
        if self.fields.get("K_d").is_some() {
            let sign = if warms { '-' } else { '+' };
            demand += &format!(" {sign} {h}.K_d * ({sense}.T - {h}.felt) / {}", self.delay());
        }
        self.out.text(value, "error", error);
        self.out.text(value, "demand", demand);
        let name = if self.is_sampled() { "limited" } else { "" };
        self.out.text(value, name, format!("min(max({h}.demand, {h}.min), {h}.max)"));
    }

    fn is_sampled(&self) -> bool {
        self.fields.get("sample").is_some()
    }

    /// Time over which the derivative is taken: the lag, and the time since the last sample.
    fn delay(&self) -> String {
        let h = self.out.here;
        match self.is_sampled() {
            true => format!("({h}.lag + {h}.sample)"),
            false => format!("{h}.lag"),
        }
    }

    /// The keys of a state that changes at `rate`, from each sample to the next if the controller
    /// samples.
    fn changes(&self, name: &str, rate: &str) -> Vec<(&'static str, String)> {
        let h = self.out.here;
        match self.is_sampled() {
            true => vec![
                ("next", format!("{h}.{name} + {h}.sample * ({rate})")),
                ("every", format!("{h}.sample")),
            ],
            false => vec![("rate", rate.to_owned())],
        }
    }

    /// The output that stays from each sample to the next.
    fn held(&mut self) {
        let h = self.out.here;
        let start = if self.fields.get("K_i").is_some() { "start" } else { "min" };
        let state = self.out.table(&[
            ("next", format!("{h}.limited")),
            ("every", format!("{h}.sample")),
            ("start", format!("min(max({h}.{start}, {h}.min), {h}.max)")),
            ("size", format!("{h}.max - {h}.min")),
        ]);
        self.out.put(ValueKind::State.section(), "", state);
    }

    fn states(&mut self, problems: &mut Vec<Diagnostic>) -> Option<()> {
        let (h, sense) = (self.out.here, self.sense);
        let sampled = self.is_sampled();
        if sampled {
            self.held();
        }
        if self.fields.get("K_i").is_some() {
            // so written, an integral gain of 0 leaves a proportional controller
            let back = match self.fields.get("tracking") {
                Some(_) => format!("1 / {h}.tracking"),
                None => format!("abs({h}.K_i / {h}.K_p)"),
            };
            // a sample goes back to the limit at most, not beyond it
            let (output, back) = match sampled {
                true => (format!("{h}.limited"), format!("min({back}, 1 / {h}.sample)")),
                false => (h.to_owned(), back),
            };
            let rate = format!("{h}.K_i * {h}.error + ({output} - {h}.demand) * {back}");
            let mut keys = self.changes("integral", &rate);
            keys.push(("start", format!("{h}.start")));
            keys.push(("size", format!("{h}.max - {h}.min")));
            let state = self.out.table(&keys);
            self.out.put(ValueKind::State.section(), "integral", state);
        }
        if self.fields.get("K_d").is_some() {
            let start = self.sensed_start(problems)?;
            let rate = format!("({sense}.T - {h}.felt) / {}", self.delay());
            let mut state = self.out.table(&self.changes("felt", &rate));
            if let RawKind::Table(table) = &mut state.kind {
                table.entries.push(RawEntry::new("start", start));
            }
            self.out.put(ValueKind::State.section(), "felt", state);
        }
        Some(())
    }

    /// `T0` of the sensed node, where its derivative begins.
    fn sensed_start(&self, problems: &mut Vec<Diagnostic>) -> Option<RawValue> {
        let at = &self.fields.get("sense")?.span;
        let full = self.structure.resolve(at, self.sense);
        let node = self.raw.elements("node").iter().find(|entry| entry.key == full);
        let own = node.and_then(|node| match &node.value.kind {
            RawKind::Table(table) => table.get("T0"),
            _ => None,
        });
        let default = || self.raw.section("default")?.get("T0");
        let start = own.or_else(|| node.and_then(|_| default())).map(|entry| entry.value.clone());
        if start.is_none() {
            let message = format!("{} has no start for its derivative", self.fields.owner.words());
            let help = "let `sense` name a [node] with `T0`, or leave `K_d` out";
            problems.push(Diagnostic::wrong("netlist::controller_start", message, at, help));
        }
        start
    }
}
