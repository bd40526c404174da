//! Checks of netlists: their problems, before anything is computed.

mod page;
mod stiff;

use std::path::Path;
use std::sync::Arc;

use lptn_assembly::ThermalSystem;
use lptn_netlist::{Diagnostic, Files, Netlist, Severity};
use lptn_network::Network;
use lptn_solve::Lumping;

use crate::answer::Answer;
use crate::exit::Exit;
use crate::failure::Failure;
use crate::input::{self, Given, Input};
use crate::known_columns::KnownColumns;
use crate::words::counts;
use crate::{lumping, select};
use stiff::Stiff;

/// Asks for the problems of a netlist.
#[derive(Clone, Debug, Default)]
pub struct CheckQuestion {
    /// The load case that is taken.
    pub case: Option<String>,
    /// Values that are set, such as `G_fan = 2 W/K`.
    pub set: Vec<String>,
    /// The words of the command, for reports.
    pub command: Vec<String>,
}

/// Content and problems of a netlist.
#[derive(Debug)]
pub struct CheckAnswer {
    /// The texts that places are in.
    pub files: Files,
    /// The problems: errors, warnings and notes.
    pub diagnostics: Vec<Diagnostic>,
    /// True if it has a run.
    pub has_run: bool,
    name: String,
    stem: String,
    /// The numbers of its parts, if it is a network.
    counts: Option<String>,
    /// The network, if it is one.
    network: Option<Network>,
    /// Biot numbers and diffusion times of its nodes.
    lumping: Option<Lumping>,
    syntax: bool,
}

impl CheckQuestion {
    /// Asks a file.
    ///
    /// # Errors
    /// A file that cannot be read; problems of the case or of the values that are set, which are
    /// not a property of the netlist.
    pub fn ask(&self, file: &Path) -> Result<CheckAnswer, Failure> {
        self.ask_text(&input::read(file)?)
    }

    /// Asks a text that was read.
    ///
    /// # Errors
    /// Problems of the case or of the values that are set.
    pub fn ask_text(&self, text: &Given) -> Result<CheckAnswer, Failure> {
        let mut answer = CheckAnswer {
            files: Files::new(),
            diagnostics: Vec::new(),
            has_run: false,
            name: text.name.clone(),
            stem: text.stem.clone(),
            counts: None,
            network: None,
            lumping: None,
            syntax: false,
        };
        match input::parse(text) {
            Ok(netlist) => self.found(&mut answer, netlist, text)?,
            Err(rejected) => {
                (answer.files, answer.diagnostics) = (rejected.files, rejected.diagnostics);
                answer.syntax = rejected.syntax;
            }
        }
        Ok(answer)
    }

    /// Problems of a netlist that can be read.
    fn found(
        &self,
        answer: &mut CheckAnswer,
        mut netlist: Netlist,
        text: &Given,
    ) -> Result<(), Failure> {
        let set = input::apply(&mut netlist, text, (self.case.as_deref(), &self.set))?;
        answer.counts = Some(counts(&netlist.network));
        answer.files = netlist.files.clone();
        let problems = &mut answer.diagnostics;
        *problems = netlist.warnings.clone();
        let text = Given { bytes: Vec::new(), name: text.name.clone(), stem: text.stem.clone() };
        let command = self.command.clone();
        let input =
            Input { text: Arc::new(text), netlist, set, command, columns: KnownColumns::default() };
        match input.assemble() {
            Ok(system) => answer.lumping = lumped(&input.netlist, &system),
            Err(failure) => problems.extend(failure.diagnostics),
        }
        let lumping = answer.lumping.iter();
        problems.extend(lumping.flat_map(|lumping| lumping::warnings(&input.netlist, lumping)));
        answer.has_run = input.netlist.run.is_some();
        let selection = select::of_run(&input.netlist, &[]);
        problems.extend(selection.err().into_iter().flat_map(|failure| failure.diagnostics));
        answer.network = Some(input.netlist.network);
        Ok(())
    }
}

/// Biot numbers and diffusion times at the start.
/// `None` if the start cannot be computed, which a run reports.
fn lumped(netlist: &Netlist, system: &ThermalSystem) -> Option<Lumping> {
    let run = netlist.run.as_ref();
    let start = run.map_or(0.0, |run| run.start);
    Lumping::at_start(system, start, run.map(|run| run.stop)).ok()
}

impl CheckAnswer {
    /// Range of its time constants; it takes a while for a large network.
    fn stiffness(&self) -> Option<Stiff> {
        Stiff::of(self.network.as_ref()?)
    }

    fn lumping(&self) -> Option<(&Network, &Lumping)> {
        self.network.as_ref().zip(self.lumping.as_ref())
    }

    fn of(&self, severity: Severity) -> Vec<Diagnostic> {
        self.diagnostics.iter().filter(|d| d.severity == severity).cloned().collect()
    }
}

impl Answer for CheckAnswer {
    fn files(&self) -> &Files {
        &self.files
    }

    fn doubts(&self) -> Vec<Diagnostic> {
        self.of(Severity::Warning)
    }

    fn reasons(&self) -> Vec<String> {
        self.of(Severity::Error).into_iter().map(|problem| problem.message).collect()
    }

    fn exit(&self) -> Exit {
        match self.of(Severity::Error).len() {
            0 => Exit::Done,
            _ if self.syntax => Exit::Input,
            _ => Exit::No,
        }
    }
}
