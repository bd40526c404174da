//! The controls of a state.

use lptn_data::Span;

use super::{Members, StateFile, member};
use crate::json::JsonValue;

/// Where a control stands.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stand {
    pub(super) on: bool,
    /// How long it has been so, in s; `None` if it never switched.
    pub(super) held: Option<f64>,
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
