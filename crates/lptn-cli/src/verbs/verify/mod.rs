//! `lptn verify`

mod args;
mod near;

pub(crate) use args::VerifyArgs;

use std::io;

use lptn_analysis::{RunAnalysis, RunError};
use lptn_assembly::ThermalSystem;
use lptn_network::Network;
use lptn_report::{
    Json, Page, Report, Rows, Standing, Text, TextTable, duration, shortened, significant,
};
use lptn_solve::{NoReference, Reference, RunComparison, Verification};
use lptn_study::SiValue;
use serde_json::{Value, json};

use crate::console::Console;
use crate::input::Load as _;
use crate::interrupt::Interrupt;
use crate::progress::ProgressLine;
use lptn_answer::about::{self, Known};
use lptn_answer::exit::Exit;
use lptn_answer::failure::Failure;
use lptn_answer::input::{self, Input};
use lptn_answer::refused::{no_run, unanswered};
use lptn_answer::words::count;

/// Letters of a node's name beside the other columns.
const NODE_WIDTH: usize = 22;

const NOTHING: &str = "not verified: there is nothing to compare";

pub(crate) fn verify(args: &VerifyArgs, console: &Console) -> Result<Exit, Failure> {
    let input = Input::load(&args.source)?;
    if let Some(point) = args.at.find(&input, console)? {
        return near::near(&input, &point, &args.printed, console);
    }
    let netlist = &input.netlist;
    let settings = netlist.run.as_ref().ok_or_else(|| no_run(&input))?;
    let given = args.tolerance.as_deref().map(input::tolerance).transpose()?;
    let run = RunAnalysis::of(&netlist.network, settings);
    let run = run.within(given.unwrap_or(settings.tolerance));
    let system = input.assemble()?;
    console.warn(&netlist.files, &netlist.warnings);
    let found = observed(&system, &run, console);
    let Some(verification) = found.map_err(|error| unanswered(&input, &error))? else {
        console.message("interrupted: nothing is verified");
        return Ok(Exit::Interrupted);
    };
    let view = View { input: &input, verification: &verification };
    let exit = console.show(&view, args.printed.format)?;
    if let (false, Some(file)) = (view.is_independent(), input.typed()) {
        console.next(&format!("lptn verify {file} --at steady"));
    }
    Ok(exit)
}

/// The verification, with progress on a terminal; `None` after Ctrl-C.
fn observed(
    system: &ThermalSystem,
    run: &RunAnalysis,
    console: &Console,
) -> Result<Option<Verification>, RunError> {
    let interrupt = Interrupt::listen();
    let mut line = ProgressLine::new(console.quiet);
    let found = run.verify(system, &mut |tolerance, progress| {
        line.update_of(&format!("at {} K", significant(tolerance, 3)), progress);
        interrupt.control()
    });
    line.clear();
    found
}

struct View<'a> {
    input: &'a Input,
    verification: &'a Verification,
}

impl View<'_> {
    fn network(&self) -> &Network {
        &self.input.netlist.network
    }

    fn node(&self, comparison: &RunComparison) -> &str {
        &self.network().nodes()[comparison.difference.node.index()].name
    }

    fn comparisons(&self) -> TextTable {
        TextTable::of(&self.verification.comparisons)
            .left("tolerance [K]", |c| significant(c.tolerance, 3))
            .right("difference [K]", |c| significant(c.difference.largest, 2))
            .right("allowed [K]", |c| significant(c.allowed, 2))
            .right("at", |c| duration(c.difference.time, 4))
            .left("of node", |c| shortened(self.node(c), NODE_WIDTH))
            .into()
    }

    /// What the runs are compared with.
    fn reference(&self) -> String {
        match &self.verification.reference {
            Reference::Exact { states, carried, quadrature_error, own_error } => {
                let how = if quadrature_error.is_some() {
                    "inputs in t by quadrature"
                } else {
                    "all in closed form"
                };
                let (parts, error) = (parts(*states, *carried), significant(*own_error, 2));
                format!("exact solution, {parts}, {how}, itself within {error} K")
            }
            Reference::FinerRun { tolerance, reason } => {
                let tolerance = significant(*tolerance, 3);
                let why = match reason {
                    NoReference::Unsolved(error) => error.to_string(),
                    NoReference::TooStiff { own_error } => {
                        let error = significant(*own_error, 2);
                        format!(
                            "time constants differ so much that it would be good to {error} K only"
                        )
                    }
                };
                format!("a run at {tolerance} K; no independent solution: {why}")
            }
        }
    }

    fn is_independent(&self) -> bool {
        matches!(self.verification.reference, Reference::Exact { .. })
    }

    fn verdict(&self) -> String {
        let worst = self.verification.comparisons.iter().find(|c| !c.passes());
        match (worst, self.is_independent()) {
            _ if self.verification.comparisons.is_empty() => NOTHING.into(),
            (None, true) => "verified: every node at every row is within what is allowed".into(),
            (None, false) => {
                "consistent, not verified: two tolerances agree within what is allowed".into()
            }
            (Some(c), _) => format!(
                "not verified: off by {} K at a tolerance of {} K, {} K allowed",
                significant(c.difference.largest, 2),
                significant(c.tolerance, 3),
                significant(c.allowed, 2)
            ),
        }
    }

    fn worst(&self, comparison: &RunComparison) -> Value {
        json!({
            "tolerance": SiValue::new(comparison.tolerance, "K"),
            "difference": SiValue::new(comparison.difference.largest, "K"),
            "allowed": SiValue::new(comparison.allowed, "K"),
            "node": self.node(comparison),
            "time": SiValue::new(comparison.difference.time, "s"),
        })
    }

    fn reference_json(&self) -> Value {
        let kelvin = |value: f64| SiValue::new(value, "K");
        match &self.verification.reference {
            Reference::Exact { states, carried, quadrature_error, own_error } => json!({
                "independent": true,
                "modes": states - carried,
                "exponential": carried,
                "text": self.reference(),
                "own_error": kelvin(*own_error),
                "quadrature_error": quadrature_error.map(kelvin),
            }),
            Reference::FinerRun { tolerance, .. } => json!({
                "independent": false,
                "text": self.reference(),
                "tolerance": kelvin(*tolerance),
            }),
        }
    }
}

impl Page for View<'_> {
    fn text(&self) -> Text {
        let mut text = self.input.begun();
        text.section().table(self.comparisons());
        text.section().labelled("compared with: ", with_units(&self.reference()));
        let standing = match (self.verification.passes(), self.is_independent()) {
            (false, _) => Standing::Fails,
            (true, false) => Standing::Open,
            (true, true) => Standing::Holds,
        };
        text.marked(standing, self.verdict());
        text
    }

    fn rows(&self) -> Rows<'_> {
        self.verification.table(self.network()).into()
    }

    fn more(&self) -> Report {
        about::about(self.input, Known::default())
    }

    fn json(&self, json: &mut Json<'_>) -> io::Result<()> {
        let worst: Vec<Value> =
            self.verification.comparisons.iter().map(|c| self.worst(c)).collect();
        self.input.head(json, &[])?;
        json.table(&self.verification.table(self.network()))?;
        json.member("worst", &worst)?;
        json.member("reference", &self.reference_json())?;
        json.member("passes", &self.verification.passes())
    }

    fn no(&self) -> Option<String> {
        (!self.verification.passes()).then(|| self.verdict())
    }
}

/// How many modes an exact solution has, and how many nodes go by the exponential of a matrix.
fn parts(states: usize, carried: usize) -> String {
    let exponential = format!("{} by matrix exponential", count(carried, "node"));
    match (states - carried, carried) {
        (modes, 0) => count(modes, "mode"),
        (0, _) => exponential,
        (modes, _) => format!("{}, {exponential}", count(modes, "mode")),
    }
}

/// Words for wrapping; a number stays with its unit.
fn with_units(text: &str) -> Vec<String> {
    let mut words: Vec<String> = Vec::new();
    for word in text.split(' ') {
        match words.last_mut() {
            Some(number) if word.starts_with('K') => *number += &format!(" {word}"),
            _ => words.push(word.to_owned()),
        }
    }
    words
}
