//! `lptn check`

mod args;

pub(crate) use args::CheckArgs;

use std::io;
use std::path::Path;

use lptn_answer::answer::Answer as _;
use lptn_answer::check::{CheckAnswer, CheckQuestion};
use lptn_answer::exit::Exit;
use lptn_answer::failure::Failure;
use lptn_answer::input::{self, Given};
use lptn_report::{Format, Json, Page, Text};

use crate::arguments;
use crate::console::Console;
use crate::options::Source;
use crate::written::proven;

pub(crate) fn check(args: &CheckArgs, console: &Console) -> Result<Exit, Failure> {
    let text = input::read(&args.source.file)?;
    if args.expand {
        return expand(&text, &args.source, console);
    }
    let (case, set) = args.source.settings();
    let question = CheckQuestion {
        case: case.map(str::to_owned),
        set: set.to_vec(),
        command: arguments::words(),
    };
    let answer = question.ask_text(&text)?;
    console.show(&View { answer: &answer, console }, args.format)?;
    let ok = answer.exit() == Exit::Done && args.format == Format::Table;
    if let (true, Some(file)) = (ok, text.typed()) {
        let verb = if answer.has_run { "run" } else { "steady" };
        console.next(&format!("lptn {verb} {file}"));
    }
    Ok(answer.exit())
}

/// Writes the network as a flat netlist; its problems go to stderr.
fn expand(text: &Given, source: &Source, console: &Console) -> Result<Exit, Failure> {
    let mut netlist = input::parse(text).map_err(|rejected| Failure {
        exit: if rejected.syntax { Exit::Input } else { Exit::No },
        ..rejected.into()
    })?;
    input::apply(&mut netlist, text, source.settings())?;
    console.warn(&netlist.files, &netlist.warnings);
    if let Some(problem) = netlist.not_flat() {
        return Err(Failure::at(Exit::No, netlist.files, problem));
    }
    let flat = netlist.expanded();
    console.print(&proven(flat, Path::new(&text.name), &netlist.network, netlist.run.as_ref())?)
}

/// An answer whose problems are shown with their lines.
struct View<'a> {
    answer: &'a CheckAnswer,
    console: &'a Console,
}

impl Page for View<'_> {
    /// The diagnostics, and one line with the answer at the end.
    fn text(&self) -> Text {
        let mut text = Text::new();
        for diagnostic in &self.answer.diagnostics {
            text.section().line(self.console.rendered(&self.answer.files, diagnostic));
        }
        self.answer.conclusion(&mut text, self.console.detail);
        text
    }

    fn json(&self, json: &mut Json<'_>) -> io::Result<()> {
        self.answer.json(json)
    }
}
