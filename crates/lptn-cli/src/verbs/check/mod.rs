//! `lptn check`

mod args;

pub(crate) use args::CheckArgs;

use std::io;
use std::path::Path;

use lptn_assembly::ThermalSystem;
use lptn_netlist::{Diagnostic, Files, Netlist, Severity};
use lptn_network::{Network, NodeId};
use lptn_report::{Format, Json, Page, Text, duration, significant};
use lptn_solve::{Lumping, Stiffness};
use lptn_study::SiValue;
use serde_json::{Value, json};

use crate::console::{Console, Detail};
use crate::options::Source;
use crate::written::proven;
use lptn_answer::exit::Exit;
use lptn_answer::failure::Failure;
use lptn_answer::input::{self, Given, Input};
use lptn_answer::lumping;
use lptn_answer::messages;
use lptn_answer::select;
use lptn_answer::words::{count, counts};

pub(crate) fn check(args: &CheckArgs, console: &Console) -> Result<Exit, Failure> {
    let text = input::read(&args.source.file)?;
    if args.expand {
        return expand(&text, &args.source, console);
    }
    let finding = Finding::of(&text, &args.source)?;
    console.show(&View { finding: &finding, text: &text, console }, args.format)?;
    let ok = finding.exit() == Exit::Done && args.format == Format::Table;
    if let (true, Some(file)) = (ok, text.typed()) {
        let verb = if finding.has_run { "run" } else { "steady" };
        console.next(&format!("lptn {verb} {file}"));
    }
    Ok(finding.exit())
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

/// Biot numbers and diffusion times at the start.
/// `None` if the start cannot be computed, which a run reports.
fn lumped(netlist: &Netlist, system: &ThermalSystem) -> Option<Lumping> {
    let run = netlist.run.as_ref();
    let start = run.map_or(0.0, |run| run.start);
    Lumping::at_start(system, start, run.map(|run| run.stop)).ok()
}

/// Content and problems of a netlist.
struct Finding {
    files: Files,
    diagnostics: Vec<Diagnostic>,
    /// The numbers of its parts, if it is a network.
    counts: Option<String>,
    /// The network, if it is one.
    network: Option<Network>,
    /// Biot numbers and diffusion times of its nodes.
    lumping: Option<Lumping>,
    syntax: bool,
    /// True if it has a run.
    has_run: bool,
}

impl Finding {
    /// # Errors
    /// Problems of `--set` or `--case`: they are not a property of the netlist.
    fn of(text: &Given, source: &Source) -> Result<Self, Failure> {
        let mut netlist = match input::parse(text) {
            Ok(netlist) => netlist,
            Err(rejected) => {
                let (files, diagnostics, syntax) =
                    (rejected.files, rejected.diagnostics, rejected.syntax);
                return Ok(Self {
                    files,
                    diagnostics,
                    counts: None,
                    network: None,
                    lumping: None,
                    syntax,
                    has_run: false,
                });
            }
        };
        let set = input::apply(&mut netlist, text, source.settings())?;
        let counts = Some(counts(&netlist.network));
        let (files, mut diagnostics) = (netlist.files.clone(), netlist.warnings.clone());
        let text = Given { bytes: Vec::new(), name: text.name.clone(), stem: text.stem.clone() };
        let input = Input { text, netlist, set, command: crate::files::arguments() };
        let mut lumping = None;
        match input.assemble() {
            Ok(system) => lumping = lumped(&input.netlist, &system),
            Err(failure) => diagnostics.extend(failure.diagnostics),
        }
        let found = lumping.iter().flat_map(|lumping| lumping::warnings(&input.netlist, lumping));
        diagnostics.extend(found);
        let has_run = input.netlist.run.is_some();
        let selection = select::of_run(&input.netlist, &[]);
        diagnostics.extend(selection.err().into_iter().flat_map(|failure| failure.diagnostics));
        let network = Some(input.netlist.network);
        Ok(Self { files, diagnostics, counts, network, lumping, syntax: false, has_run })
    }

    /// Range of its time constants; it takes a while for a large network.
    fn stiffness(&self) -> Option<Stiff> {
        Stiff::of(self.network.as_ref()?)
    }

    fn lumping(&self) -> Option<(&Network, &Lumping)> {
        self.network.as_ref().zip(self.lumping.as_ref())
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

    fn list(&self, severity: Severity) -> Value {
        let found = self.diagnostics.iter().filter(|d| d.severity == severity);
        found.map(|diagnostic| messages::json(&self.files, diagnostic)).collect()
    }
}

/// A finding and its display.
struct View<'a> {
    finding: &'a Finding,
    text: &'a Given,
    console: &'a Console,
}

impl Page for View<'_> {
    /// The diagnostics, and one line with the answer at the end.
    fn text(&self) -> Text {
        let (finding, name) = (self.finding, &self.text.name);
        let mut text = Text::new();
        for diagnostic in &finding.diagnostics {
            text.section().line(self.console.rendered(&finding.files, diagnostic));
        }
        text.section();
        if finding.exit() == Exit::Done {
            let at_length = self.console.detail > Detail::Brief;
            if let Some(stiff) = at_length.then(|| finding.stiffness()).flatten() {
                text.sentence("stiffness: ", &stiff.words());
            }
            if let Some((network, lumping)) = finding.lumping() {
                lumping::lines(&mut text, network, (lumping, "lumping:   ", self.console.detail));
            }
        }
        let warnings = count(finding.number(Severity::Warning), "warning");
        text.line(match (finding.number(Severity::Error), &finding.counts) {
            (0, Some(counts)) => format!("ok: {name} has {counts}; {warnings}"),
            (errors, _) => format!("not ok: {name} has {}, {warnings}", count(errors, "error")),
        });
        text
    }

    fn json(&self, json: &mut Json<'_>) -> io::Result<()> {
        let finding = self.finding;
        let lumping = finding.lumping();
        json.member("format", &1)?;
        json.member("network", &self.text.stem)?;
        json.member("ok", &(finding.exit() == Exit::Done))?;
        json.member("errors", &finding.list(Severity::Error))?;
        json.member("warnings", &finding.list(Severity::Warning))?;
        if finding.number(Severity::Note) > 0 {
            json.member("notes", &finding.list(Severity::Note))?;
        }
        json.member("stiffness", &finding.stiffness().as_ref().map(Stiff::json))?;
        json.member("lumping", &lumping.map(|(network, lumping)| lumping::json(network, lumping)))
    }
}

/// The time constants of the nodes that follow their surroundings fastest and slowest.
struct Stiff {
    fastest: (String, f64),
    slowest: (String, f64),
    ratio: f64,
}

impl Stiff {
    fn of(network: &Network) -> Option<Self> {
        let stiffness = Stiffness::of(network)?;
        let named = |(node, tau): (NodeId, f64)| (network.nodes()[node.index()].name.clone(), tau);
        let ratio = stiffness.ratio();
        Some(Self { fastest: named(stiffness.fastest), slowest: named(stiffness.slowest), ratio })
    }

    fn words(&self) -> String {
        let one = |(name, tau): &(String, f64)| format!("{} ({name})", duration(*tau, 3));
        let (fast, slow) = (one(&self.fastest), one(&self.slowest));
        match self.fastest.0 == self.slowest.0 {
            true => format!("C / sum of G is {fast}"),
            false => format!("{}, C / sum of G is {fast} to {slow}", significant(self.ratio, 3)),
        }
    }

    fn json(&self) -> Value {
        let one =
            |(name, tau): &(String, f64)| json!({ "node": name, "tau": SiValue::new(*tau, "s") });
        let ratio = SiValue::new(self.ratio, "1");
        json!({ "fastest": one(&self.fastest), "slowest": one(&self.slowest), "ratio": ratio })
    }
}
