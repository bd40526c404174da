//! `lptn fit step`

mod args;
mod doubts;
mod estimate;
mod figure;
mod model;
mod page;
mod request;

pub(crate) use args::StepArgs;

use std::path::Path;

use lptn_fit::step::{Capacity, Power, ReferenceTemperature as Zero, Sensor, StepError, StepFit};
use lptn_netlist::{Diagnostic, Posterior, RecordColumn};

use crate::console::Console;
use crate::verbs::fit::posterior;
use lptn_answer::exit::Exit;
use lptn_answer::failure::Failure;
use model::Model;
use request::{Reference, Request};

/// What came of the record.
#[derive(Debug)]
pub(crate) struct Answer<'a> {
    pub(crate) request: &'a Request,
    /// The columns that have a fit, in order.
    pub(crate) columns: Vec<Column<'a>>,
    /// The names of those that have none, with the code of the reason.
    pub(crate) without: Vec<(&'a str, &'static str)>,
    pub(crate) model: Option<Model>,
    pub(crate) warnings: Vec<Diagnostic>,
    /// 0 unless a column has no fit.
    pub(crate) exit: Exit,
}

/// A column with its fit.
#[derive(Debug)]
pub(crate) struct Column<'a> {
    pub(crate) column: &'a RecordColumn,
    pub(crate) fit: StepFit,
    /// Without a capacity only its dT means something.
    pub(crate) power: Power,
}

pub(crate) fn step(args: &StepArgs, console: &Console) -> Result<Exit, Failure> {
    let request = Request::read(args)?;
    if args.posterior.is_some() && request.columns.len() != 1 {
        let problem = Diagnostic::error(
            "fit::step_posterior",
            "--posterior writes what one column says of P_disp and R_eq",
        );
        return Err(Failure::new(Exit::Input, problem.help("name it: --column ring_gear")));
    }
    let (record, files) = (&request.record, &request.files);
    let (mut columns, mut without, mut failures) = (Vec::new(), Vec::new(), Vec::new());
    for column in request.columns.iter().map(|&i| &record.columns[i]) {
        match fitted(&request, column) {
            Ok(fit) => columns.push(fit),
            Err(error) => {
                without.push((column.name.as_str(), error.code()));
                failures.push(doubts::failed(&request, column, &error));
            }
        }
    }
    let exit =
        failures.iter().map(|(exit, _)| *exit).max_by_key(|exit| *exit as u8).unwrap_or(Exit::Done);
    let problems: Vec<Diagnostic> = failures.into_iter().map(|(_, problem)| problem).collect();
    let mut warnings = record.warnings.clone();
    warnings.extend(columns.iter().flat_map(|column| doubts::of(&request, column)));
    console.warn(files, &warnings);
    if columns.is_empty() {
        return Err(Failure { exit, files: files.clone(), diagnostics: problems });
    }
    let model = Model::read(args, &request)?;
    warnings.extend(problems.iter().cloned());
    let answer = Answer { request: &request, columns, without, model, warnings, exit };
    console.page(&answer, args.printed.format)?;
    console.report(files, &problems);
    if let (Some(file), [column]) = (&args.posterior, answer.columns.as_slice()) {
        posterior::write(&column.posterior(&request), file, console)?;
    }
    Ok(exit)
}

impl Column<'_> {
    fn posterior(&self, request: &Request) -> Posterior {
        let stem = Path::new(&request.name).file_stem().map(|stem| stem.to_string_lossy());
        let called = (&*stem.unwrap_or_default(), self.column.name.as_str());
        self.power.posterior(&self.fit, capacity(request), called)
    }
}

/// dT does not depend on the capacity.
fn capacity(request: &Request) -> Capacity {
    match &request.capacity {
        Some(capacity) => Capacity { value: capacity.value, deviation: capacity.sigma() },
        None => Capacity { value: 1.0, deviation: 0.0 },
    }
}

fn fitted<'a>(request: &'a Request, column: &'a RecordColumn) -> Result<Column<'a>, StepError> {
    let record = &request.record;
    let fit = StepFit::new(&record.time, &column.values)?;
    let reference = match &request.reference {
        Reference::Initial => Zero::Initial,
        Reference::Value(kelvin) => Zero::Value(*kelvin),
        Reference::Column(index) => {
            let column = &record.columns[*index];
            Zero::Column {
                name: column.name.clone(),
                times: &record.time,
                temperatures: &column.values,
            }
        }
    };
    let sensor = Sensor { class: request.sensor.unwrap_or(0.0), gain: 0.0 };
    let power = Power::new(&fit, capacity(request), &reference, sensor)?;
    Ok(Column { column, fit, power })
}

/// A number with its error in brackets, as part of a formula.
pub(crate) fn shown(value: f64, error: f64) -> String {
    format!("({})", estimate::with_error(value, error))
}
