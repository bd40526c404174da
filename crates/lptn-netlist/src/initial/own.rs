//! The states of `[state]` in the state that a run starts from.

use lptn_data::Diagnostic;
use lptn_network::StateId;
use lptn_units::suggest;

use super::StateFile;
use crate::section::STATE;
use crate::work::Elaboration;

impl Elaboration<'_> {
    /// Starts each state where the file has it; without a file it starts as written.
    pub(crate) fn start_state(&mut self, name: &str, id: StateId) {
        let value = self.state.and_then(|file| file.states.get(name)).map(|(value, _)| value);
        value.into_iter().for_each(|value| self.builder.start_state_at(id, value));
    }

    /// States of the file that the network does not have, and those of the network that are not in
    /// the file.
    pub(super) fn check_states(&mut self, file: &StateFile) {
        let known = self.elements(STATE.name);
        let missing = known.iter().filter(|entry| file.states.get(&entry.key).is_none());
        for (name, _, place) in &file.states.all {
            if !known.iter().any(|entry| entry.key == *name) {
                let near = suggest(name, missing.clone().map(|entry| entry.key.as_str()));
                self.report(file.unknown(("state", name, place), near));
            }
        }
        for entry in missing.filter(|_| file.usable && file.problems.is_empty()) {
            let message = format!("the state file has no value of state `{}`", entry.key);
            let problem = Diagnostic::error("netlist::state_missing_state", message)
                .at(entry.key_span.clone(), "")
                .also(file.state.place.clone(), "the state file is read here");
            let help = "a state file belongs to the network that it was computed with";
            self.report(problem.help(help));
        }
    }
}
