//! The controls of a state.

use lptn_data::Span;

use super::{Members, StateFile, member};
use crate::json::JsonValue;

/// The state of a control.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stand {
    pub(super) on: bool,
    /// Time in s since it switched; `None` if it never switched.
    pub(super) held: Option<f64>,
}

impl StateFile {
    pub(super) fn stand(&mut self, name: &str, value: JsonValue<'_>) -> Option<Stand> {
        let members = value.members().unwrap_or_default();
        for (other, value) in
            members.iter().filter(|(other, _)| !["on", "held"].contains(&&**other))
        {
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
            let words = format!(
                "control `{name}` of a state has to have `\"on\": true` or `\"on\": false`"
            );
            self.refuse("netlist::state_control", words, on.unwrap_or(value).span());
        }
        let held = member(&members, "held").and_then(|_| self.held(name, &members, &value.span()));
        Some(Stand { on: known.unwrap_or_default(), held })
    }

    fn held(&mut self, name: &str, members: &Members<'_>, place: &Span) -> Option<f64> {
        let value = self.in_unit(members, ("held", "value", "s"), place)?;
        let held = self.number(value, &format!("`held` of control `{name}` in the state"))?;
        if held < 0.0 {
            let words = format!(
                "the time since control `{name}` switched must be at least 0 s, got {held} \
                    s"
            );
            self.refuse("netlist::state_control", words, value.span());
        }
        Some(held).filter(|held| *held >= 0.0)
    }
}
