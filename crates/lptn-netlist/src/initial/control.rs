//! The controls of the state that a run starts from.

use lptn_data::Diagnostic;
use lptn_units::suggest;

use super::StateFile;
use crate::section::CONTROL;
use crate::work::Elaboration;

impl Elaboration<'_> {
    /// True if a control is on in the state that the run starts from; `None` without such a state.
    pub(crate) fn stands(&self, name: &str) -> Option<bool> {
        self.state?.controls.get(name).map(|(stand, _)| stand.on)
    }

    /// Time in s for which each control has been as it is, by id, in the state that the run starts
    /// from; empty without such a state.
    pub(crate) fn held(&self) -> Vec<Option<f64>> {
        let Some(file) = self.state else { return Vec::new() };
        let controls = self.elements(CONTROL.name).iter();
        controls
            .map(|entry| file.controls.get(&entry.key).and_then(|(stand, _)| stand.held))
            .collect()
    }

    /// Controls of the state that the network does not have, and those of the network that are not
    /// in the state.
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
            let message = format!("the state does not say whether control `{}` is on", entry.key);
            let problem = Diagnostic::error("netlist::state_missing_control", message)
                .at(entry.key_span.clone(), "")
                .also(file.state.place.clone(), "the state is read here");
            self.report(problem.help("a state belongs to the network that it was computed with"));
        }
    }
}
