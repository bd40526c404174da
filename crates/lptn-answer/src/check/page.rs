//! A check as a page.

use std::io;

use lptn_netlist::Severity;
use lptn_report::{Json, Page, Text};

use super::CheckAnswer;
use super::stiff::Stiff;
use crate::answer::Answer as _;
use crate::exit::Exit;
use crate::lumping::{self, Detail};
use crate::messages;
use crate::words::count;

impl CheckAnswer {
    /// Ends a text after the problems: lumping, and one line with the answer.
    pub fn conclusion(&self, text: &mut Text, detail: Detail) {
        text.section();
        if self.exit() == Exit::Done {
            if let Some(stiff) = (detail > Detail::Brief).then(|| self.stiffness()).flatten() {
                text.sentence("stiffness: ", &stiff.words());
            }
            if let Some((network, lumping)) = self.lumping() {
                lumping::lines(text, network, (lumping, "lumping:   ", detail));
            }
        }
        let number = |severity, word| count(self.of(severity).len(), word);
        let warnings = number(Severity::Warning, "warning");
        let name = &self.name;
        text.line(match (self.exit(), &self.counts) {
            (Exit::Done, Some(counts)) => format!("ok: {name} has {counts}; {warnings}"),
            _ => format!("not ok: {name} has {}, {warnings}", number(Severity::Error, "error")),
        });
    }
}

impl Page for CheckAnswer {
    /// The sentences of the problems, and one line with the answer at the end.
    fn text(&self) -> Text {
        let mut text = Text::new();
        for problem in &self.diagnostics {
            text.section().sentence(&format!("[{}] ", problem.code), &problem.message);
        }
        self.conclusion(&mut text, Detail::Brief);
        text
    }

    fn json(&self, json: &mut Json<'_>) -> io::Result<()> {
        let list = |severity| messages::list(&self.files, &self.of(severity));
        let notes = self.of(Severity::Note);
        json.member("format", &1)?;
        json.member("network", &self.stem)?;
        json.member("ok", &(self.exit() == Exit::Done))?;
        json.member("errors", &list(Severity::Error))?;
        json.member("warnings", &list(Severity::Warning))?;
        json.optional("notes", (!notes.is_empty()).then(|| list(Severity::Note)))?;
        json.member("stiffness", &self.stiffness().as_ref().map(Stiff::json))?;
        let lumping = self.lumping();
        json.member("lumping", &lumping.map(|(network, lumping)| lumping::json(network, lumping)))
    }
}
