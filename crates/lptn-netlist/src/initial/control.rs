//! The controls of the state that a run starts from.

use lptn_data::{Diagnostic, Span};
use lptn_units::suggest;

use super::{Members, StateFile, member};
use crate::elaborate::Elaboration;
use crate::json::JsonValue;
use crate::vocabulary::CONTROL;

/// Where a control stands.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stand {
    on: bool,
    /// How long it has been so, in s; `None` if it never switched.
    held: Option<f64>,
}

impl StateFile {
    pub(super) fn take_controls(&mut self, value: JsonValue<'_>) {
        let Some(members) = value.members() else {
            let words = "`controls` of a state is an object".to_owned();
            return self.refuse("netlist::state_member", words, value.span());
        };
        for (name, value) in members {
            let stand = self.stand(&name, value);
            if !self.controls.insert(&name, stand, value.span()) {
                let words = format!("`{name}` stands twice in `controls` of the state");
                self.refuse("netlist::state_twice", words, value.span());
            }
        }
    }

    fn stand(&mut self, name: &str, value: JsonValue<'_>) -> Stand {
        let members = value.members().unwrap_or_default();
        for (other, value) in members.iter().filter(|(other, _)| !["on", "held"].contains(&&**other)) {
            let words = format!("control `{name}` of a state has no member `{other}`");
            self.refuse("netlist::state_member", words, value.span());
        }
        let on = member(&members, "on");
        let known = match on.map(JsonValue::written) {
            Some("true") => Some(true),
            Some("false") => Some(false),
            _ => None,
        };
        if known.is_none() {
            let words = format!("control `{name}` of a state has to have `\"on\": true` or `\"on\": false`");
            self.refuse("netlist::state_control", words, on.unwrap_or(value).span());
        }
        let held = member(&members, "held").and_then(|_| self.held(name, &members, &value.span()));
        Stand { on: known.unwrap_or_default(), held }
    }

    fn held(&mut self, name: &str, members: &Members<'_>, place: &Span) -> Option<f64> {
        let value = self.in_unit(members, ("held", "value", "s"), place)?;
        let (code, words) = match value.number() {
            Some(held) if held >= 0.0 => return Some(held),
            Some(held) => {
                let words = format!("how long control `{name}` was held must be at least 0 s, got {held} s");
                ("netlist::state_control", words)
            }
            None => {
                let words = format!("`held` of control `{name}` in the state is no number");
                ("netlist::state_not_a_number", words)
            }
        };
        self.refuse(code, words, value.span());
        None
    }
}

impl Elaboration<'_> {
    /// Whether a control is on in the state that the run starts from; `None` if it starts from none.
    pub(crate) fn stands(&self, name: &str) -> Option<bool> {
        self.state?.controls.get(name).map(|(stand, _)| stand.on)
    }

    /// How long each control was held, in s, by id, in the state that the run starts from; empty if it starts from
    /// none.
    pub(crate) fn held(&self) -> Vec<Option<f64>> {
        let Some(file) = self.state else { return Vec::new() };
        let controls = self.elements(CONTROL.name).iter();
        controls.map(|entry| file.controls.get(&entry.key).and_then(|(stand, _)| stand.held)).collect()
    }

    /// Controls of the state that the network does not have, and those of the network that are not in the state.
    pub(super) fn check_controls(&mut self, file: &StateFile) {
        let known = self.elements(CONTROL.name);
        let missing = known.iter().filter(|entry| file.controls.get(&entry.key).is_none());
        for (name, _, place) in &file.controls.all {
            if !known.iter().any(|entry| entry.key == *name) {
                let near = suggest(name, missing.clone().map(|entry| entry.key.as_str()));
                self.report(file.unknown(("control", name, place), near));
            }
        }
        for entry in missing.filter(|_| file.usable && file.problems.is_empty()) {
            let message = format!("the state does not say how control `{}` stands", entry.key);
            let problem = Diagnostic::error("netlist::state_missing_control", message)
                .at(entry.key_span.clone(), "")
                .also(file.state.place.clone(), "the state is read here");
            self.report(problem.help("a state belongs to the network that it was computed with"));
        }
    }
}
