//! `--report`: results as a page that can be sent to a colleague.

use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use lptn_html::Live;
use lptn_netlist::{Diagnostic, Files};
use lptn_report::{Piece, Report, Section};
use serde_json::Value;

use crate::core_of_live::CORE;
use crate::diagnostics::render;
use crate::files;
use lptn_answer::exit::Exit;
use lptn_answer::failure::{Failure, reason};

/// Help if a report cannot be written.
const ELSEWHERE: &str = "name another file: --report=FILE.html";

/// A report that was requested, as far as it is known.
#[derive(Debug, Default)]
pub(crate) struct Reporting {
    /// The file; without one it is among the results.
    file: Option<PathBuf>,
    known: Mutex<Known>,
}

#[derive(Debug, Default)]
struct Known {
    report: Option<Report>,
    messages: Vec<String>,
    folder: Option<PathBuf>,
    /// The contents of a live page.
    live: Option<Value>,
}

impl Reporting {
    /// A report that goes into a file, or among the results.
    pub(crate) fn into(file: Option<PathBuf>) -> Self {
        Self { file, ..Self::default() }
    }

    fn known(&self) -> MutexGuard<'_, Known> {
        self.known.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Results go to this folder.
    pub(crate) fn beside(&self, folder: &Path) {
        self.known().folder = Some(folder.to_owned());
    }

    /// Adds the content of another report.
    pub(crate) fn add(&self, report: Report) {
        match &mut self.known().report {
            Some(first) => {
                first.claims.extend(report.claims);
                first.sections.extend(report.sections);
            }
            none => *none = Some(report),
        }
    }

    /// The page is a live one, with these contents.
    pub(crate) fn live(&self, contents: Value) {
        self.known().live = Some(contents);
    }

    /// Keeps the diagnostics next to the result.
    pub(crate) fn say(&self, files: &Files, diagnostics: &[Diagnostic]) {
        let said = diagnostics.iter().map(|diagnostic| render(files, diagnostic, false));
        self.known().messages.extend(said);
    }

    /// Writes the report of a verb, and returns the file's name.
    /// `None` if there is nothing to report.
    pub(crate) fn finish(&self, verb: &str) -> Result<Option<String>, Failure> {
        let mut known = self.known();
        let Some(mut report) = known.report.take() else { return Ok(None) };
        let messages = std::mem::take(&mut known.messages);
        if !messages.is_empty() {
            let section = Section::of("Messages", Piece::Verbatim(messages.join("\n\n")));
            // messages on the result come before its sources
            let place = report.sections.iter().position(|section| section.folded);
            report.sections.insert(place.unwrap_or(report.sections.len()), section);
        }
        let name = match verb {
            "run" | "report" => "report.html".to_owned(),
            verb => format!("{verb}.html"),
        };
        let usual = || {
            let out = || Path::new("out").join(&report.name);
            known.folder.clone().unwrap_or_else(out).join(name)
        };
        let file = match self.file.clone() {
            Some(file) => file,
            None => beside_results(usual())?,
        };
        write(&file, &report, known.live.as_ref())?;
        Ok(Some(file.display().to_string()))
    }
}

/// The same place, whose folder is made if it is missing: a verb may write nothing else.
fn beside_results(file: PathBuf) -> Result<PathBuf, Failure> {
    let folder = file.parent().unwrap_or(Path::new("."));
    let cannot = |error: std::io::Error| {
        let message = format!("cannot write {}: {}", file.display(), reason(&error));
        let problem = Diagnostic::error("output::cannot_write", message);
        Failure::new(Exit::Failed, problem.help(ELSEWHERE))
    };
    std::fs::create_dir_all(folder).map_err(cannot)?;
    Ok(file)
}

/// Reads the name of a report. Only HTML is accepted, so that no other file is overwritten.
pub(crate) fn page_name(text: &str) -> Result<PathBuf, String> {
    let file = PathBuf::from(text);
    let ending = file.extension().map(|ending| ending.to_ascii_lowercase());
    if ending.is_some_and(|ending| ending == "html" || ending == "htm") {
        return Ok(file);
    }
    let stem = file.with_extension("html");
    Err(format!("a report is an HTML page: write {}", stem.display()))
}

fn write(file: &Path, report: &Report, live: Option<&Value>) -> Result<(), Failure> {
    let page = match live.zip(CORE) {
        Some((contents, core)) => lptn_html::write_live(report, &Live { contents, core }),
        None => lptn_html::write(report),
    };
    files::replace(file, page.as_bytes()).map_err(|failure| failure.with_help(ELSEWHERE))
}

/// A verb that answers with something else than a result.
pub(crate) fn nothing() -> Failure {
    Failure::refused(
        "report::nothing",
        "there is no report of this answer",
        "every command that prints a result has one",
    )
}
