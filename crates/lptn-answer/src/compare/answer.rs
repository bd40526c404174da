//! Candidates side by side, with doubts and failures.

use std::sync::Arc;

use lptn_netlist::{Diagnostic, Files, Netlist};
use lptn_report::plain;
use lptn_study::{Candidate, CompareRow};
use lptn_units::Unit;

use super::evaluate::NoResult;
use super::load::Loaded;
use crate::answer::Answer;
use crate::exit::Exit;
use crate::failure::Failure;
use crate::gathered::Gathered;
use crate::input::Input;
use crate::steady::others;
use crate::words::unverified;
use crate::{bound, trust};

/// The candidates in their order.
#[derive(Debug)]
pub struct CompareAnswer {
    /// The candidates.
    pub rows: Vec<CompareRow>,
    /// The unit of temperatures.
    pub unit: Unit,
    /// The end of each row; limits do not count.
    pub ends: Vec<Exit>,
    /// Problems of the candidates without results.
    pub failures: Vec<Failure>,
    /// The netlist of each row that could be read.
    pub(super) inputs: Vec<Option<Arc<Input>>>,
    /// The label of the variant of each row.
    pub(super) labels: Vec<String>,
    /// True if candidates are variants of files.
    pub(super) variants: bool,
    /// True if large families are shown as one.
    pub(super) fold: bool,
    /// The words of the command that asked.
    pub(super) command: Vec<String>,
    /// Doubts in the candidates.
    pub(super) gathered: Gathered,
}

impl Answer for CompareAnswer {
    fn files(&self) -> &Files {
        &self.gathered.files
    }

    fn doubts(&self) -> Vec<Diagnostic> {
        self.gathered.doubts.clone()
    }

    /// Exit of the comparison: interrupted, else not read, else failed, else a broken limit.
    fn exit(&self) -> Exit {
        if self.ends.contains(&Exit::Interrupted) {
            Exit::Interrupted
        } else if self.ends.contains(&Exit::Input) {
            Exit::Input
        } else if self.ends.contains(&Exit::Failed) {
            Exit::Failed
        } else if self.rows.iter().any(|row| row.status() == "broken") {
            Exit::No
        } else {
            Exit::Done
        }
    }
}

impl CompareAnswer {
    pub(super) fn of(
        outcomes: impl Iterator<Item = (Loaded, Result<Candidate, NoResult>)>,
        unit: Unit,
    ) -> Self {
        let mut comparison = Self {
            rows: Vec::new(),
            unit,
            ends: Vec::new(),
            failures: Vec::new(),
            inputs: Vec::new(),
            labels: Vec::new(),
            variants: false,
            fold: true,
            command: Vec::new(),
            gathered: Gathered::default(),
        };
        outcomes.for_each(|(loaded, outcome)| comparison.add(loaded, outcome));
        let conditions = comparison.conditions();
        comparison.gathered.add(&Files::new(), &conditions);
        comparison
    }

    fn add(&mut self, loaded: Loaded, outcome: Result<Candidate, NoResult>) {
        let Loaded { file, label, input, .. } = loaded;
        self.labels.push(label);
        self.inputs.push(None);
        let mut title = String::new();
        let mut failure = None;
        match input {
            Ok(input) => {
                title = input.netlist.network.title().map_or(String::new(), plain);
                let found = outcome.as_ref().ok();
                let beyond = found.map_or_else(Vec::new, |found| {
                    trust::doubts(&input.netlist, &found.trust, input.netlist.run.is_some())
                });
                let unbounded = found.and_then(|found| found.trust.unbounded.as_ref());
                let unbounded = bound::unbounded(&input.netlist.network, unbounded);
                let several = outcome.as_ref().ok().and_then(|found| found.several.as_ref());
                let several =
                    several.and_then(|steady| others(&input.netlist.network, steady, &self.unit));
                let of_file = |warning: Diagnostic| Diagnostic {
                    message: format!("{file}: {}", warning.message),
                    ..warning
                };
                let has_cycle = found.is_some_and(|found| matches!(found.settled, Some(Ok(_))));
                let vary = inputs_vary(&input.netlist, &file).filter(|_| !has_cycle);
                let no_cycle = found.and_then(|found| unsettled(&file, found));
                let unsure = unverified(&input.netlist.network).map(|text| {
                    let message = format!("{file}: {text}");
                    Diagnostic::warning("network::unverified_constants", message)
                });
                let own = input.netlist.warnings.iter().cloned();
                let warnings: Vec<Diagnostic> = own
                    .chain(vary)
                    .chain(beyond)
                    .chain(unbounded.map(of_file))
                    .chain(several.map(of_file))
                    .chain(no_cycle)
                    .chain(unsure)
                    .collect();
                self.gathered.add(&input.netlist.files, &warnings);
                self.inputs.pop();
                self.inputs.push(Some(Arc::new(input)));
            }
            Err(not_read) => failure = Some(not_read),
        }
        let outcome = outcome.map_err(|no_result| match no_result {
            NoResult::NotRead => {}
            NoResult::Failure(reason) => failure = Some(reason),
        });
        self.ends.push(failure.as_ref().map_or(Exit::Done, |failure| failure.exit));
        let code = failure.as_ref().and_then(|failure| failure.diagnostics.first()).map(|d| d.code);
        self.failures.extend(failure);
        let outcome = outcome.map_err(|()| code.unwrap_or_default().to_owned());
        self.rows.push(CompareRow { file, title, outcome });
    }

    /// True if every candidate is a file as it is, not a variant of one.
    pub fn is_of_files(&self) -> bool {
        !self.variants
    }
}

/// Warns if inputs vary without a run: only their values at 0 s are used.
fn inputs_vary(netlist: &Netlist, name: &str) -> Option<Diagnostic> {
    let network = &netlist.network;
    let judged: Vec<_> =
        network.limits().iter().flat_map(|limit| [&limit.of, &limit.value]).collect();
    let changes =
        || !network.changing_inputs().is_empty() || !network.changing_inputs_of(&judged).is_empty();
    let vary = netlist.run.is_none() && changes();
    let message = format!(
        "{name}: the inputs change with time; without a [run] their values at 0 s are used, and \
         limits that depend on them are not judged"
    );
    vary.then(|| {
        Diagnostic::warning("steady::inputs_vary", message).help("add a [run] to compare over time")
    })
}

/// Reason why a candidate with repeating signals has no settled cycle.
fn unsettled(file: &str, found: &Candidate) -> Option<Diagnostic> {
    let reason = found.settled.as_ref()?.as_ref().err()?;
    let message = format!("{file}: the column `settled` is empty: {reason}");
    Some(Diagnostic::warning(reason.code(), message).help(reason.help()))
}
