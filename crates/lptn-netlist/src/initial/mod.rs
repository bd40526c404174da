//! `initial` of `[run]`: temperatures and controls at the start, from the final state of another
//! run.

mod control;
mod own;
mod stand;
mod start;

pub(crate) use start::{warnings, without_effect};

use std::borrow::Cow;
use std::path::Path;

use foldhash::{HashMap, HashMapExt as _};
use lptn_data::{Diagnostic, Files, Span};

use crate::include::Loader;
use crate::json::{Json, JsonValue};
use crate::near_file::NamedFile;
use crate::raw::{RawKind, RawValue};
use crate::state::{FORMAT, StateEnd};
use stand::Stand;

const NAMED: NamedFile = NamedFile {
    does: "read a state",
    verb: "read",
    without_folder: "netlist::state_without_folder",
    not_found: "netlist::state_not_found",
    else_help: "; `lptn run` writes `out/NAME/state.json`",
};

/// Temperature in K of a node whose state is unknown, to check for other mistakes.
const ANYWHERE: f64 = 298.15;

/// All members that a state file may have.
const MEMBERS: [&str; 9] =
    ["format", "network", "title", "time", "end", "temperatures", "melted", "states", "controls"];

/// The state that a run starts from.
#[derive(Clone, Debug, PartialEq)]
pub struct InitialState {
    /// The file that contains it.
    pub file: String,
    /// Its time in s.
    pub time: f64,
    /// The end of the run that wrote it.
    pub end: StateEnd,
    /// The place that names it in the netlist.
    pub place: Span,
    /// Parameters that only `T0` uses, which the state replaces.
    pub(crate) without_effect: Vec<String>,
}

/// Values by name, each with its place, in the order of the file.
#[derive(Clone, Debug)]
struct Named<T> {
    all: Vec<(String, T, Span)>,
    index: HashMap<String, usize>,
}

impl<T: Copy> Named<T> {
    fn new() -> Self {
        Self { all: Vec::new(), index: HashMap::new() }
    }

    fn get(&self, name: &str) -> Option<(T, &Span)> {
        self.index.get(name).map(|&i| (self.all[i].1, &self.all[i].2))
    }

    /// Adds a value; false if there is one of this name already.
    fn insert(&mut self, name: &str, value: T, place: Span) -> bool {
        let before = self.index.insert(name.to_owned(), self.all.len());
        self.all.push((name.to_owned(), value, place));
        before.is_none()
    }
}

/// A state file, or its errors.
#[derive(Clone, Debug)]
pub(crate) struct StateFile {
    pub(crate) state: InitialState,
    temperatures: Named<f64>,
    melted: Named<f64>,
    states: Named<f64>,
    controls: Named<Stand>,
    problems: Vec<Diagnostic>,
    /// True if a file was named.
    usable: bool,
}

impl StateFile {
    /// Reads the file that a value names, `initial` of `[run]`.
    pub(crate) fn read(
        files: &mut Files,
        value: &RawValue,
        loader: Option<&mut Loader<'_>>,
    ) -> Self {
        let RawKind::String { text, .. } = &value.kind else {
            // reported where `[run]` is read; nodes then need no start
            return Self { usable: false, ..Self::empty(String::new(), value) };
        };
        let from =
            Path::new(files.name(value.span.file)).parent().unwrap_or(Path::new("")).to_owned();
        let path = from.join(text);
        let mut state = Self::empty(path.display().to_string(), value);
        match load(files, &path, value, loader) {
            Ok(json) => state.take(files, json),
            Err(problem) => state.problems.push(problem),
        }
        state
    }

    fn empty(file: String, value: &RawValue) -> Self {
        let place = value.span.clone();
        let (end, without_effect) = (StateEnd::Reached, Vec::new());
        let state = InitialState { file, time: f64::NAN, end, place, without_effect };
        let (temperatures, melted) = (Named::new(), Named::new());
        let (states, controls) = (Named::new(), Named::new());
        Self { state, temperatures, melted, states, controls, problems: Vec::new(), usable: true }
    }

    fn take(&mut self, files: &Files, file: crate::FileId) {
        let whole = match (Json { file, text: files.text(file) }).read() {
            Ok(whole) => whole,
            Err((words, place)) => return self.refuse("netlist::state_not_json", words, place),
        };
        let Some(members) = whole.members() else {
            let words = "the state is not a JSON object".to_owned();
            return self.refuse("netlist::state_not_json", words, Span::new(file, 0..0));
        };
        let format = member(&members, "format");
        if format.map(JsonValue::written) != Some(FORMAT) {
            let words = match format {
                Some(found) => {
                    format!(
                        "the state has format {}, but this lptn reads {FORMAT}",
                        found.written()
                    )
                }
                None => "the file has no `format`, so it is not a state of a run".to_owned(),
            };
            let place = format.map_or(Span::new(file, 0..0), JsonValue::span);
            return self.refuse("netlist::state_format", words, place);
        }
        for (name, value) in members.iter().filter(|(name, _)| !MEMBERS.contains(&&**name)) {
            let words = format!("a state has no member `{name}`");
            self.refuse("netlist::state_member", words, value.span());
        }
        let top = Span::new(file, 0..0);
        if let Some(time) = self.in_unit(&members, ("time", "value", "s"), &top) {
            self.state.time = self.number(time, "`time` of the state").unwrap_or(f64::NAN);
        }
        if let Some(end) = member(&members, "end") {
            self.end(end);
        }
        if let Some(values) = self.in_unit(&members, ("temperatures", "values", "K"), &top) {
            self.temperatures = self.named(values, "temperatures", Self::temperature);
        }
        if let Some(melted) = member(&members, "melted") {
            self.melted = self.named(melted, "melted", Self::share);
        }
        if let Some(states) = member(&members, "states") {
            let number = |file: &mut Self, name: &str, value: JsonValue<'_>| {
                file.number(value, &format!("`{name}` in `states` of the state"))
            };
            self.states = self.named(states, "states", number);
        }
        if let Some(controls) = member(&members, "controls") {
            self.controls = self.named(controls, "controls", Self::stand);
        }
    }

    fn refuse(&mut self, code: &'static str, words: String, place: Span) {
        let help = "use the `state.json` that `lptn run` writes next to its results";
        let problem = Diagnostic::error(code, words)
            .at(place, "")
            .also(self.state.place.clone(), "read here");
        self.problems.push(problem.help(help));
    }

    /// The contents of a member in this unit; errors are reported.
    fn in_unit<'a>(
        &mut self,
        members: &Members<'a>,
        (name, inside, unit): (&str, &str, &str),
        top: &Span,
    ) -> Option<JsonValue<'a>> {
        let Some(value) = member(members, name) else {
            self.refuse("netlist::state_member", format!("the state has no `{name}`"), top.clone());
            return None;
        };
        let inner = value.members().unwrap_or_default();
        let found = member(&inner, "unit").and_then(JsonValue::string);
        if found.as_deref() != Some(unit) {
            let words = format!("`{name}` of a state has to have `\"unit\": \"{unit}\"`");
            self.refuse("netlist::state_unit", words, value.span());
            return None;
        }
        let held = member(&inner, inside);
        if held.is_none() {
            let words = format!("`{name}` of the state has no `{inside}`");
            self.refuse("netlist::state_member", words, value.span());
        }
        held
    }

    fn end(&mut self, value: JsonValue<'_>) {
        match value.string().and_then(|word| StateEnd::of(&word)) {
            Some(end) => self.state.end = end,
            None => {
                let words =
                    "`end` of a state is \"reached\", \"interrupted\" or \"failed\"".to_owned();
                self.refuse("netlist::state_member", words, value.span());
            }
        }
    }

    fn number(&mut self, value: JsonValue<'_>, what: &str) -> Option<f64> {
        let number = value.number();
        if number.is_none() {
            let words = format!("{what} is not a number: {}", value.written());
            self.refuse("netlist::state_not_a_number", words, value.span());
        }
        number
    }

    /// The members of an object by name, each read by the given function.
    fn named<T: Copy>(
        &mut self,
        value: JsonValue<'_>,
        what: &str,
        read: impl Fn(&mut Self, &str, JsonValue<'_>) -> Option<T>,
    ) -> Named<T> {
        let mut named = Named::new();
        let Some(members) = value.members() else {
            let words = format!("`{what}` of a state is an object with a member for each name");
            self.refuse("netlist::state_member", words, value.span());
            return named;
        };
        for (name, value) in members {
            let Some(found) = read(self, &name, value) else { continue };
            if !named.insert(&name, found, value.span()) {
                let words = format!("`{name}` appears twice in `{what}` of the state");
                self.refuse("netlist::state_twice", words, value.span());
            }
        }
        named
    }

    fn temperature(&mut self, name: &str, value: JsonValue<'_>) -> Option<f64> {
        let number = self.number(value, &format!("`{name}` in `temperatures` of the state"))?;
        if number < 0.0 {
            let words = format!(
                "the temperature of `{name}` in the state is below absolute zero: {number} K"
            );
            self.refuse("netlist::state_below_absolute_zero", words, value.span());
        }
        Some(number)
    }

    fn share(&mut self, name: &str, value: JsonValue<'_>) -> Option<f64> {
        let share = self.number(value, &format!("`{name}` in `melted` of the state"))?;
        if !(0.0..=1.0).contains(&share) {
            let words = format!("the molten share of `{name}` must be from 0 to 1, got {share}");
            self.refuse("netlist::state_share", words, value.span());
        }
        Some(share)
    }

    fn unknown(&self, (what, name, place): (&str, &str, &Span), near: Option<&str>) -> Diagnostic {
        let message = format!("the state has a {what} `{name}` that the network does not have");
        let problem = Diagnostic::error("netlist::state_unknown_name", message)
            .at(place.clone(), "")
            .also(self.state.place.clone(), "read here");
        let renamed = near.map(|near| format!("was `{near}` renamed? ")).unwrap_or_default();
        problem.help(renamed + "a state belongs to the network that it was computed with")
    }
}

type Members<'a> = [(Cow<'a, str>, JsonValue<'a>)];

fn member<'a>(members: &Members<'a>, name: &str) -> Option<JsonValue<'a>> {
    members.iter().find(|(found, _)| found == name).map(|(_, value)| *value)
}

fn load(
    files: &mut Files,
    path: &Path,
    value: &RawValue,
    loader: Option<&mut Loader<'_>>,
) -> Result<crate::FileId, Diagnostic> {
    let bytes = NAMED.load(path, value, loader)?;
    match std::str::from_utf8(&bytes) {
        Ok(text) => Ok(files.add(path.display().to_string(), text)),
        Err(_) => {
            let message = format!("{} is not a text file in UTF-8", path.display());
            let help = "use the `state.json` that `lptn run` writes";
            Err(Diagnostic::wrong("netlist::not_text", message, &value.span, help))
        }
    }
}
