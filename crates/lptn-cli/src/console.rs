//! Output of text: results to stdout, everything else to stderr.

use std::io::{self, BufWriter, ErrorKind, IsTerminal as _, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};

use lptn_answer::answer::Answer;
use lptn_netlist::{Diagnostic, Files};
use lptn_plot::Figure;
use lptn_report::{Canvas, Format, Look, Page, Report};
use serde_json::Value;

use crate::diagnostics::render;
use crate::drawing::{self, Drawing};
use crate::options::{Color, Global};
use crate::phases::Phases;
use crate::refusal::Refusal;
use crate::reporting::{self, Reporting};
use lptn_answer::exit::Exit;
use lptn_answer::failure::{Failure, reason};

pub(crate) use lptn_answer::lumping::Detail;

/// The two streams of a command.
#[derive(Debug)]
pub(crate) struct Console {
    pub(crate) quiet: bool,
    pub(crate) verbose: bool,
    styled_results: bool,
    styled_messages: bool,
    /// True if a person reads the messages as they come.
    watched: bool,
    pub(crate) detail: Detail,
    pub(crate) plot: Option<Drawing>,
    drawn: AtomicBool,
    reporting: Option<Reporting>,
    /// Answer to a program if there is no result; only if JSON was requested.
    refusal: Option<Refusal>,
    /// True if something was printed.
    printed: AtomicBool,
    /// Commands to type next.
    next: Mutex<Vec<String>>,
    /// Warnings that were printed, as texts.
    said: Mutex<Vec<String>>,
    pub(crate) phases: Phases,
}

impl Console {
    pub(crate) fn new(global: &Global, report: Option<Option<PathBuf>>) -> Self {
        let styled = |terminal: bool| match global.color {
            Color::Always => true,
            Color::Never => false,
            Color::Auto => terminal && colours_are_welcome(),
        };
        Self {
            quiet: global.quiet,
            verbose: global.verbose,
            styled_results: styled(io::stdout().is_terminal()),
            styled_messages: styled(io::stderr().is_terminal()),
            watched: io::stderr().is_terminal(),
            detail: match io::stdout().is_terminal() {
                _ if global.verbose => Detail::Verbose,
                true => Detail::Usual,
                false => Detail::Brief,
            },
            plot: global.plot.clone(),
            drawn: AtomicBool::new(false),
            reporting: report.map(Reporting::into),
            refusal: Refusal::wanted(),
            printed: AtomicBool::new(false),
            next: Mutex::default(),
            said: Mutex::default(),
            phases: Phases::default(),
        }
    }

    /// Writes a result in a format, and reports if its answer is no.
    pub(crate) fn show(&self, page: &dyn Page, format: Format) -> Result<Exit, Failure> {
        self.page(page, format)?;
        Ok(self.conclude(page, format))
    }

    /// Writes an answer in a format, after its doubts.
    /// Doubts that were printed while it was computed are not repeated.
    pub(crate) fn answer(&self, answer: &dyn Answer, format: Format) -> Result<Exit, Failure> {
        let mut doubts = answer.doubts();
        let said = self.said.lock().unwrap_or_else(PoisonError::into_inner).clone();
        doubts.retain(|doubt| !said.contains(&render(answer.files(), doubt, false)));
        self.warn(answer.files(), &doubts);
        self.show(answer, format)
    }

    /// Writes a result in a format, and draws it if that was requested.
    pub(crate) fn page(&self, page: &dyn Page, format: Format) -> Result<(), Failure> {
        if self.plot == Some(Drawing::Terminal) && format != Format::Table {
            return Err(drawing::not_here());
        }
        let write = || self.write(|out| lptn_report::write(page, format, self.look(), out));
        self.phases.timed("write", write)?;
        if self.reports() {
            self.add_report(lptn_report::report_of(page));
        }
        self.plot.as_ref().map_or(Ok(()), |drawing| self.draw(&page.figures(), drawing))
    }

    /// Adds to the report that was requested.
    pub(crate) fn add_report(&self, report: Report) {
        if let Some(reporting) = &self.reporting {
            reporting.add(report);
        }
    }

    /// Makes the report live, with these contents.
    pub(crate) fn live_page(&self, contents: Value) {
        self.reporting.iter().for_each(|reporting| reporting.live(contents.clone()));
    }

    /// True if a report was requested.
    pub(crate) fn reports(&self) -> bool {
        self.reporting.is_some()
    }

    /// The folder of the results, to which the report goes unless it has its own file.
    pub(crate) fn results_in(&self, folder: &Path) {
        self.reporting.iter().for_each(|reporting| reporting.beside(folder));
    }

    /// Writes the report that was requested. A verb that failed may have none.
    pub(crate) fn write_report(&self, verb: &str, known: bool) -> Result<(), Failure> {
        let Some(reporting) = &self.reporting else { return Ok(()) };
        match reporting.finish(verb)? {
            Some(file) => self.note(&format!("wrote  {file}")),
            None if known => return Err(reporting::nothing()),
            None => {}
        }
        Ok(())
    }

    /// Look of results.
    pub(crate) fn look(&self) -> Look {
        Look { styled: self.styled_results, width: drawing::terminal_width() }
    }

    /// Draws figures into a file or on the terminal.
    pub(crate) fn draw(&self, figures: &[Figure], drawing: &Drawing) -> Result<(), Failure> {
        self.draw_on(&Canvas::default(), figures, drawing)
    }

    /// The same with a size and colours.
    pub(crate) fn draw_on(
        &self,
        canvas: &Canvas,
        figures: &[Figure],
        drawing: &Drawing,
    ) -> Result<(), Failure> {
        let show = |bytes: &[u8]| self.write(|out| out.write_all(bytes));
        let wrote = drawing.draw((figures, canvas), self.styled_results, show)?;
        self.drawn.store(true, Ordering::Relaxed);
        wrote.iter().for_each(|file| self.note(&format!("wrote  {file}")));
        Ok(())
    }

    /// The exit code of an answer. If the answer is no, a table says so itself.
    /// For other formats it is reported here.
    pub(crate) fn conclude(&self, page: &dyn Page, format: Format) -> Exit {
        let Some(no) = page.no() else { return Exit::Done };
        if format != Format::Table {
            self.message(&no);
        }
        Exit::No
    }

    /// Writes a result that is text.
    pub(crate) fn print(&self, text: &str) -> Result<Exit, Failure> {
        self.write(|out| out.write_all(text.as_bytes())).map(|()| Exit::Done)
    }

    /// Writes a result. A reader that went away (`| head`) is not an error.
    pub(crate) fn write(
        &self,
        result: impl FnOnce(&mut BufWriter<io::StdoutLock<'static>>) -> io::Result<()>,
    ) -> Result<(), Failure> {
        self.stream(result).map(|_| ())
    }

    /// The same for a part of an endless result; true if it is still read.
    pub(crate) fn stream(
        &self,
        result: impl FnOnce(&mut BufWriter<io::StdoutLock<'static>>) -> io::Result<()>,
    ) -> Result<bool, Failure> {
        self.printed.store(true, Ordering::Relaxed);
        let mut out = BufWriter::with_capacity(1 << 16, io::stdout().lock());
        match result(&mut out).and_then(|()| out.flush()) {
            Err(error) if error.kind() != ErrorKind::BrokenPipe => {
                let message = format!("cannot write to stdout: {}", reason(&error));
                Err(Failure::new(Exit::Failed, Diagnostic::error("output::stdout", message)))
            }
            outcome => Ok(outcome.is_ok()),
        }
    }

    /// True if a requested picture was not drawn yet.
    pub(crate) fn owes_a_picture(&self) -> bool {
        self.plot.is_some() && !self.drawn.load(Ordering::Relaxed)
    }

    /// Prints a note next to the result; left out when quiet.
    pub(crate) fn note(&self, text: &str) {
        if !self.quiet {
            self.message(text);
        }
    }

    /// Keeps a command to type next, for people at a terminal; it is printed last.
    /// Scripts and logs get it only when verbose.
    pub(crate) fn next(&self, command: &str) {
        if self.watched || self.verbose {
            self.next.lock().unwrap_or_else(PoisonError::into_inner).push(command.to_owned());
        }
    }

    /// Prints the durations of the parts of the command; only when verbose.
    pub(crate) fn say_times(&self) {
        if self.verbose && !self.phases.seconds().is_empty() {
            self.note(&self.phases.text());
        }
    }

    /// Prints the commands to type next.
    pub(crate) fn say_next(&self) {
        let commands = self.next.lock().unwrap_or_else(PoisonError::into_inner);
        commands.iter().for_each(|command| self.note(&format!("next   {command}")));
    }

    /// Prints how to explain the first of some problems, for people at a terminal.
    pub(crate) fn offer_explanation(&self, diagnostics: &[Diagnostic]) {
        if let Some(first) = diagnostics.first().filter(|_| self.watched) {
            self.note(&format!("\nexplain  lptn explain {}", first.code));
        }
    }

    /// Prints a message. If stderr is closed, it is lost.
    pub(crate) fn message(&self, text: &str) {
        let newline = if text.ends_with('\n') { "" } else { "\n" };
        drop(io::stderr().write_all(format!("{text}{newline}").as_bytes()));
    }

    /// Prints diagnostics as messages.
    pub(crate) fn report(&self, files: &Files, diagnostics: &[Diagnostic]) {
        let texts: Vec<String> = diagnostics
            .iter()
            .map(|diagnostic| render(files, diagnostic, self.styled_messages))
            .collect();
        self.note_down(files, diagnostics);
        if !texts.is_empty() {
            self.message(&texts.join("\n\n"));
        }
    }

    /// Prints warnings next to a result.
    pub(crate) fn warn(&self, files: &Files, warnings: &[Diagnostic]) {
        if self.quiet {
            self.note_down(files, warnings);
        } else {
            self.report(files, warnings);
        }
    }

    /// Prints warnings before there is a result, which does not repeat them.
    pub(crate) fn warn_early(&self, files: &Files, warnings: &[Diagnostic]) {
        let said = warnings.iter().map(|warning| render(files, warning, false));
        self.said.lock().unwrap_or_else(PoisonError::into_inner).extend(said);
        self.warn(files, warnings);
    }

    /// Keeps diagnostics for the report, and for a program that gets no result.
    pub(crate) fn note_down(&self, files: &Files, diagnostics: &[Diagnostic]) {
        self.reporting.iter().for_each(|reporting| reporting.say(files, diagnostics));
        self.refusal.iter().for_each(|refusal| refusal.say(files, diagnostics));
    }

    /// Answers a program that requested JSON and got no result, so that it always finds one object.
    pub(crate) fn answer_failure(&self, exit: Exit) {
        let Some(refusal) = &self.refusal else { return };
        if exit != Exit::Done && !self.printed.load(Ordering::Relaxed) {
            // if stdout cannot be written to, the object is lost
            drop(self.write(|out| out.write_all(&refusal.object(exit)?)));
        }
    }

    /// A diagnostic as a result.
    pub(crate) fn rendered(&self, files: &Files, diagnostic: &Diagnostic) -> String {
        render(files, diagnostic, self.styled_results)
    }
}

/// The conventions of no-color.org and of terminals that cannot.
fn colours_are_welcome() -> bool {
    let set = |name| std::env::var_os(name).filter(|value| !value.is_empty());
    set("NO_COLOR").is_none() && set("TERM").is_none_or(|term| term != "dumb")
}
