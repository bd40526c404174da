//! The values that remain of an interrupted fit of a network.

use std::sync::Arc;

use lptn_fit::network::{FitStage, NetworkFitError, NetworkFitTask};
use lptn_network::ParameterId;
use lptn_report::{Text, TextTable, significant};

use crate::failure::Failure;
use crate::input::{Input, quoted};
use crate::words::spaced;

/// Digits of values from which a search continues.
const DIGITS: usize = 8;

/// A fit that was interrupted: no result, but perhaps values to continue from.
#[derive(Debug)]
pub struct InterruptedFit {
    input: Arc<Input>,
    stage: FitStage,
    /// The study that was requested by its name.
    study: Option<String>,
    /// Name, value and unit of each parameter; `None` if no run came to its end.
    best: Option<Vec<[String; 3]>>,
    /// In SI units.
    values: Option<Vec<f64>>,
}

impl InterruptedFit {
    pub(super) fn new(
        (input, task): (Arc<Input>, &NetworkFitTask),
        study: Option<String>,
        (stage, values): (FitStage, Option<Vec<f64>>),
    ) -> Self {
        let cells = |values: &Vec<f64>| {
            let both = task.parameters.iter().zip(values);
            both.map(|(varied, si)| cells(&input, varied.parameter, *si)).collect()
        };
        let best = values.as_ref().map(cells);
        Self { input, stage, study, best, values }
    }

    /// The best values up to now as a table; `None` if there are none.
    pub fn text(&self) -> Option<Text> {
        let values = self.best.as_ref()?;
        let mut text = Text::new();
        let table = TextTable::of(values).left("parameter", |cells| &cells[0]).names();
        text.table(
            table.right("best until then", |cells| &cells[1]).left("unit", |cells| &cells[2]),
        );
        Some(text)
    }

    /// The stage of the interruption, and the command that continues from the best values.
    pub fn message(&self) -> String {
        let stage = self.stage;
        let Some(values) = &self.best else {
            return format!("interrupted in {stage}: nothing is fitted");
        };
        let mut message = format!(
            "interrupted in {stage}: these values are not a result, and have no standard errors"
        );
        if let Some(file) = self.input.typed() {
            let named = |name: &String| format!(" {}", quoted(name));
            let study = self.study.as_ref().map_or(String::new(), named);
            message += &format!("\ncontinue from them: lptn fit network {file}{study}");
            for [name, value, unit] in values {
                let unit = spaced(unit);
                message += &format!(" --set {}", quoted(&format!("{name}={value}{unit}")));
            }
        }
        message
    }

    /// The failure of a fit without an answer.
    pub fn failure(self) -> Failure {
        let error = NetworkFitError::Interrupted { stage: self.stage, best: self.values };
        self.input.failure(&error, None)
    }
}

/// Name, value and unit of a parameter.
fn cells(input: &Input, parameter: ParameterId, si: f64) -> [String; 3] {
    let unit = input.unit_of(parameter);
    let name = &input.netlist.network.parameters()[parameter.index()].name;
    [name.clone(), significant(unit.from_si(si), DIGITS), unit.text]
}
