//! `lptn verify`

mod args;

pub(crate) use args::VerifyArgs;

use lptn_assembly::ThermalSystem;
use lptn_network::Network;
use lptn_report::{
    Align, Column, JsonWriter, TextTable, WIDTH, duration, labelled, plain, shortened, significant, write_csv,
};
use lptn_solve::{Comparison, NoReference, Reference, Transient, TransientError, Verification};
use lptn_study::Scalar;
use serde_json::{Value, json};

use crate::console::Console;
use crate::diagnostics;
use crate::exit::Exit;
use crate::failure::Failure;
use crate::input::{self, Input};
use crate::interrupt::Interrupt;
use crate::options::Format;
use crate::progress::ProgressLine;
use crate::verbs::run::job::{explain, no_run};
use crate::words::{count, counts};

/// Letters of a node's name beside the other columns.
const NODE_WIDTH: usize = 22;

pub(crate) fn verify(args: &VerifyArgs, console: &Console) -> Result<Exit, Failure> {
    let input = Input::load(&args.source)?;
    let netlist = &input.netlist;
    let settings = netlist.run.as_ref().ok_or_else(|| no_run(&input))?;
    let given = args.tolerance.as_deref().map(input::tolerance).transpose()?;
    let transient = lptn_study::transient(&netlist.network, settings);
    let transient = Transient { tolerance: given.unwrap_or(settings.tolerance), ..transient };
    let system = input.assemble()?;
    console.warn(&netlist.files, &netlist.warnings);
    let found = observed(&system, &transient, console);
    let Some(verification) = found.map_err(|error| failed(&input, &error))? else {
        console.message("interrupted: nothing is verified");
        return Ok(Exit::Interrupted);
    };
    let view = View { input: &input, verification: &verification };
    match args.printed.format {
        Format::Table => console.print(&view.text(console)).map(drop)?,
        Format::Csv => {
            let table = verification.table(&netlist.network);
            console.write(|out| write_csv(&table, out))?;
        }
        Format::Json => console.write(|out| view.json(out))?,
    }
    if verification.passes() {
        return Ok(Exit::Done);
    }
    if args.printed.format != Format::Table {
        console.message(&view.verdict());
    }
    Ok(Exit::No)
}

/// The verification, with progress on a terminal; `None` after Ctrl-C.
fn observed(
    system: &ThermalSystem,
    settings: &Transient,
    console: &Console,
) -> Result<Option<Verification>, TransientError> {
    let interrupt = Interrupt::listen();
    let mut line = ProgressLine::new(console.quiet);
    let found = Verification::observed(system, settings, &mut |tolerance, progress| {
        line.update_of(&format!("at {} K", significant(tolerance, 3)), progress);
        interrupt.control()
    });
    line.clear();
    found
}

fn failed(input: &Input, error: &TransientError) -> Failure {
    let exit = match error {
        TransientError::Integrator(_) | TransientError::Start(_) | TransientError::Stopped { .. } => {
            Exit::Failed
        }
        TransientError::Settings(_) | TransientError::Input(_) => Exit::Input,
    };
    Failure::at(exit, input.netlist.files.clone(), explain(input, error))
}

struct View<'a> {
    input: &'a Input,
    verification: &'a Verification,
}

impl View<'_> {
    fn network(&self) -> &Network {
        &self.input.netlist.network
    }

    fn node(&self, comparison: &Comparison) -> &str {
        &self.network().nodes()[comparison.difference.node.index()].name
    }

    fn text(&self, console: &Console) -> String {
        let title = self.network().title().map_or(self.input.text.stem.clone(), plain);
        let mut lines = vec![console.title(&title), counts(self.network()), String::new()];
        lines.extend(self.comparisons());
        lines.push(String::new());
        lines.extend(labelled("compared with: ", &words(&self.reference()), WIDTH));
        lines.push(self.verdict());
        lines.join("\n") + "\n"
    }

    fn comparisons(&self) -> Vec<String> {
        let comparisons = &self.verification.comparisons;
        let column = |title: &str, align: Align, text: &dyn Fn(&Comparison) -> String| {
            Column::new(title, align, comparisons.iter().map(text).collect())
        };
        let table = TextTable::new(vec![
            column("tolerance [K]", Align::Left, &|c| significant(c.tolerance, 3)),
            column("difference [K]", Align::Right, &|c| significant(c.difference.largest, 2)),
            column("allowed [K]", Align::Right, &|c| significant(c.allowed, 2)),
            column("at", Align::Right, &|c| duration(c.difference.time, 4)),
            column("of node", Align::Left, &|c| shortened(self.node(c), NODE_WIDTH)),
        ]);
        table.lines(WIDTH)
    }

    /// What the runs are compared with.
    fn reference(&self) -> String {
        match &self.verification.reference {
            Reference::Exact { states, quadrature_error, own_error } => {
                let how = if quadrature_error.is_some() {
                    "inputs in t by quadrature"
                } else {
                    "all in closed form"
                };
                let (modes, error) = (count(*states, "mode"), significant(*own_error, 2));
                format!("exact solution, {modes}, {how}, itself within {error} K")
            }
            Reference::FinerRun { tolerance, reason } => {
                let tolerance = significant(*tolerance, 3);
                let why = match reason {
                    NoReference::Unsolved(error) => error.to_string(),
                    NoReference::TooStiff { own_error } => {
                        let error = significant(*own_error, 2);
                        format!("time constants differ so much that it would be good to {error} K only")
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
            _ if self.verification.comparisons.is_empty() => {
                "not verified: there is nothing to compare".into()
            }
            (None, true) => "verified: every node at every row is within what is allowed".into(),
            (None, false) => "consistent, not verified: two tolerances agree within what is allowed".into(),
            (Some(c), _) => format!(
                "not verified: off by {} K at a tolerance of {} K, {} K allowed",
                significant(c.difference.largest, 2),
                significant(c.tolerance, 3),
                significant(c.allowed, 2)
            ),
        }
    }

    fn json(&self, out: impl std::io::Write) -> std::io::Result<()> {
        let netlist = &self.input.netlist;
        let worst: Vec<Value> = self.verification.comparisons.iter().map(|c| self.worst(c)).collect();
        let mut json = JsonWriter::new(out);
        json.member("format", &json!(1))?;
        json.member("network", &json!(self.input.text.stem))?;
        json.member("warnings", &diagnostics::list(&netlist.files, &netlist.warnings))?;
        json.table(&self.verification.table(&netlist.network))?;
        json.member("worst", &Value::Array(worst))?;
        json.member("reference", &self.reference_json())?;
        json.member("passes", &json!(self.verification.passes()))?;
        json.finish().map(drop)
    }

    fn worst(&self, comparison: &Comparison) -> Value {
        json!({
            "tolerance": Scalar::new(comparison.tolerance, "K").json(),
            "difference": Scalar::new(comparison.difference.largest, "K").json(),
            "allowed": Scalar::new(comparison.allowed, "K").json(),
            "node": self.node(comparison),
            "time": Scalar::new(comparison.difference.time, "s").json(),
        })
    }

    fn reference_json(&self) -> Value {
        let scalar = |kelvin: f64| Scalar::new(kelvin, "K").json();
        match &self.verification.reference {
            Reference::Exact { quadrature_error, own_error, .. } => json!({
                "independent": true,
                "text": self.reference(),
                "own_error": scalar(*own_error),
                "quadrature_error": quadrature_error.map(scalar),
            }),
            Reference::FinerRun { tolerance, .. } => json!({
                "independent": false,
                "text": self.reference(),
                "tolerance": scalar(*tolerance),
            }),
        }
    }
}

/// Words for wrapping; a number stays with its unit.
fn words(text: &str) -> Vec<String> {
    let mut words: Vec<String> = Vec::new();
    for word in text.split(' ') {
        match words.last_mut() {
            Some(number) if word.starts_with('K') => *number += &format!(" {word}"),
            _ => words.push(word.to_owned()),
        }
    }
    words
}
