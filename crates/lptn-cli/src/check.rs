//! `lptn check`

use lptn_netlist::{Diagnostic, Files, Netlist, Severity};
use lptn_network::{Item, list_of_names};
use serde_json::json;

use crate::args::{CheckArgs, CheckFormat};
use crate::console::Console;
use crate::diagnostics;
use crate::exit::Exit;
use crate::failure::Failure;
use crate::input::{self, Input, Text};
use crate::select;
use crate::summary::{count, counts};
use lptn_report::JsonWriter;

pub(crate) fn check(args: &CheckArgs, console: &Console) -> Result<Exit, Failure> {
    let text = input::read(&args.source.file)?;
    let finding = Finding::of(&text, &args.source.set)?;
    let exit = finding.exit();
    match args.format {
        CheckFormat::Json => console.write(|out| {
            let mut json = JsonWriter::new(out);
            json.member("format", &json!(1))?;
            json.member("network", &json!(text.stem))?;
            json.member("ok", &json!(exit == Exit::Done))?;
            json.member("errors", &finding.list(Severity::Error))?;
            json.member("warnings", &finding.list(Severity::Warning))?;
            json.finish().map(drop)
        })?,
        CheckFormat::Table => console.print(&finding.text(&text.name, console)).map(drop)?,
    }
    Ok(exit)
}

/// Nodes that no path ties to a boundary: a path that was left out looks like this.
fn adrift(netlist: &Netlist) -> Option<Diagnostic> {
    let network = &netlist.network;
    let nodes: Vec<_> = network.ungrounded().into_iter().flatten().collect();
    let first = *nodes.first()?;
    let names: Vec<String> = nodes.iter().map(|id| network.nodes()[id.index()].name.clone()).collect();
    let message = format!("no path leads to a boundary from {}", list_of_names(&names));
    let warning = Diagnostic::warning("network::no_boundary", message)
        .help("add a path if heat is to get out; without one there is no steady state");
    Some(match netlist.source_map.name(Item::Node(first)) {
        Some(span) => warning.at(span.clone(), ""),
        None => warning,
    })
}

/// What was found in a netlist.
struct Finding {
    files: Files,
    diagnostics: Vec<Diagnostic>,
    /// What the network consists of, if it is one.
    counts: Option<String>,
    syntax: bool,
}

impl Finding {
    /// # Errors
    /// What is wrong with `--set`: that is no property of the netlist.
    fn of(text: &Text, set: &[String]) -> Result<Self, Failure> {
        let mut netlist = match input::parse(text) {
            Ok(netlist) => netlist,
            Err(rejected) => {
                let (files, diagnostics, syntax) = (rejected.files, rejected.diagnostics, rejected.syntax);
                return Ok(Self { files, diagnostics, counts: None, syntax });
            }
        };
        netlist.set(set)?;
        let counts = Some(counts(&netlist.network));
        let (files, mut diagnostics) = (netlist.files.clone(), netlist.warnings.clone());
        let text = Text { bytes: Vec::new(), name: text.name.clone(), stem: text.stem.clone() };
        diagnostics.extend(adrift(&netlist));
        let input = Input { text, netlist };
        diagnostics.extend(input.assemble().err().into_iter().flat_map(|failure| failure.diagnostics));
        let selection = select::of_run(&input.netlist, &[]);
        diagnostics.extend(selection.err().into_iter().flat_map(|failure| failure.diagnostics));
        Ok(Self { files, diagnostics, counts, syntax: false })
    }

    fn number(&self, severity: Severity) -> usize {
        self.diagnostics.iter().filter(|d| d.severity == severity).count()
    }

    fn exit(&self) -> Exit {
        match self.number(Severity::Error) {
            0 => Exit::Done,
            _ if self.syntax => Exit::Input,
            _ => Exit::No,
        }
    }

    fn list(&self, severity: Severity) -> serde_json::Value {
        let found = self.diagnostics.iter().filter(|d| d.severity == severity);
        found.map(|diagnostic| diagnostics::json(&self.files, diagnostic)).collect()
    }

    /// The diagnostics, and one line with the answer at the end.
    fn text(&self, name: &str, console: &Console) -> String {
        let rendered = self.diagnostics.iter().map(|d| console.rendered(&self.files, d) + "\n\n");
        let warnings = count(self.number(Severity::Warning), "warning");
        let answer = match (self.number(Severity::Error), &self.counts) {
            (0, Some(counts)) => format!("ok: {name} has {counts}; {warnings}\n"),
            (errors, _) => format!("not ok: {name} has {}, {warnings}\n", count(errors, "error")),
        };
        rendered.collect::<String>() + &answer
    }
}
