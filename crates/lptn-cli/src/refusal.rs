//! Answer to programs if a command fails: one object on stdout, as for a result.

use std::sync::{Mutex, PoisonError};

use lptn_netlist::{Diagnostic, Files, Severity};
use lptn_report::JsonWriter;
use serde_json::Value;

use crate::arguments;
use lptn_answer::exit::Exit;
use lptn_answer::messages;

/// Diagnostics next to a result that is printed as JSON, errors and warnings separately.
///
/// stderr has the same in words: logs keep it, and a program that reads only stdout loses nothing.
#[derive(Debug, Default)]
pub(crate) struct Refusal {
    said: Mutex<[Vec<Value>; 2]>,
}

impl Refusal {
    /// One to fill if JSON was requested.
    pub(crate) fn wanted() -> Option<Self> {
        is_json(&arguments::words()).then(Self::default)
    }

    /// Keeps diagnostics.
    pub(crate) fn say(&self, files: &Files, diagnostics: &[Diagnostic]) {
        let mut said = self.said.lock().unwrap_or_else(PoisonError::into_inner);
        for diagnostic in diagnostics {
            let list = usize::from(diagnostic.severity != Severity::Error);
            said[list].push(messages::json(files, diagnostic));
        }
    }

    /// The object instead of a result.
    pub(crate) fn object(&self, exit: Exit) -> std::io::Result<Vec<u8>> {
        let [mut errors, warnings] =
            std::mem::take(&mut *self.said.lock().unwrap_or_else(PoisonError::into_inner));
        if errors.is_empty() && exit == Exit::Interrupted {
            let problem = Diagnostic::error("run::interrupted", "interrupted: there is no result");
            errors.push(messages::json(&Files::new(), &problem));
        }
        let mut json = JsonWriter::new(Vec::new());
        json.member("format", &1)?;
        messages::failed(&mut json, exit, &errors.into())?;
        json.member("warnings", &warnings)?;
        json.finish()
    }
}

/// True if the words of a command ask for JSON.
/// They are searched directly, because a command that cannot be parsed is answered in JSON too.
fn is_json(words: &[String]) -> bool {
    let options = words.split(|word| word == "--").next().unwrap_or_default();
    options.iter().any(|word| word == "--format=json")
        || options.windows(2).any(|pair| pair == ["--format", "json"])
}

#[cfg(test)]
mod tests {
    use super::is_json;

    #[test]
    fn json_is_seen_among_words_that_cannot_be_understood() {
        let asks = |text: &str| is_json(&text.split(' ').map(str::to_owned).collect::<Vec<_>>());
        assert!(asks("run a.toml --format json") && asks("rum --format=json"));
        assert!(!asks("run a.toml --format csv json") && !asks("run a.toml -- --format json"));
    }
}
