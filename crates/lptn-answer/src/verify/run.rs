//! A run compared with an exact solution or with a finer run.

use std::io;
use std::sync::Arc;

use lptn_analysis::RunAnalysis;
use lptn_network::Network;
use lptn_report::{
    Json, Page, Report, Rows, Standing, Text, TextTable, duration, shortened, significant,
};
use lptn_solve::{NoReference, Reference, RunComparison, Verification};
use lptn_study::SiValue;
use serde_json::{Value, json};

use super::{NODE_WIDTH, NOTHING, with_units};
use crate::about::{self, Known};
use crate::failure::Failure;
use crate::input::{self, Input};
use crate::listener::Listener;
use crate::refused::{no_run, unanswered};
use crate::words::count;

/// A run and its comparison.
#[derive(Debug)]
pub(super) struct RunAnswer {
    pub(super) input: Arc<Input>,
    verification: Verification,
}

impl RunAnswer {
    /// Compares the run; `None` if the listener interrupted it.
    pub(super) fn of(
        tolerance: Option<&str>,
        input: Arc<Input>,
        listener: &dyn Listener,
    ) -> Result<Option<Self>, Failure> {
        let netlist = &input.netlist;
        let settings = netlist.run.as_ref().ok_or_else(|| no_run(&input))?;
        let given = tolerance.map(input::tolerance).transpose()?;
        let run = RunAnalysis::of(&netlist.network, settings);
        let run = run.within(given.unwrap_or(settings.tolerance));
        let system = input.assemble()?;
        listener.warn(&netlist.files, &netlist.warnings);
        let found = run.verify(&system, &mut |tolerance, progress| {
            listener.stage(&format!("at {} K", significant(tolerance, 3)), progress)
        });
        let found = found.map_err(|error| unanswered(&input, &error))?;
        Ok(found.map(|verification| Self { input, verification }))
    }

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

    /// Text on the reference of the runs.
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
                            "time constants differ too much: it would be accurate to {error} K only"
                        )
                    }
                };
                format!("a run at {tolerance} K; no independent solution: {why}")
            }
        }
    }

    pub(super) fn is_independent(&self) -> bool {
        matches!(self.verification.reference, Reference::Exact { .. })
    }

    fn verdict(&self) -> String {
        let worst = self.verification.comparisons.iter().find(|c| !c.passes());
        match (worst, self.is_independent()) {
            _ if self.verification.comparisons.is_empty() => NOTHING.into(),
            (None, true) => "verified: every node at every row is within the allowed error".into(),
            (None, false) => {
                "consistent, not verified: two tolerances agree within the allowed error".into()
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

impl Page for RunAnswer {
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
        about::about(&self.input, Known::default())
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

/// Number of modes of an exact solution, and of nodes solved by the exponential of a matrix.
fn parts(states: usize, carried: usize) -> String {
    let exponential = format!("{} by matrix exponential", count(carried, "node"));
    match (states - carried, carried) {
        (modes, 0) => count(modes, "mode"),
        (0, _) => exponential,
        (modes, _) => format!("{}, {exponential}", count(modes, "mode")),
    }
}
