//! One exponential through each temperature of a record.

mod doubts;
mod estimate;
mod figure;
mod model;
mod page;
mod report;
mod request;

use std::path::{Path, PathBuf};

use lptn_fit::step::{Capacity, Power, ReferenceTemperature as Zero, Sensor, StepError, StepFit};
use lptn_netlist::{CsvOptions, Diagnostic, Files, Posterior, RecordColumn};

use crate::answer::Answer;
use crate::exit::Exit;
use crate::failure::Failure;
use crate::listener::Listener;
use crate::memory_files::MemoryFiles;
use model::Model;
pub(crate) use request::units_missing;
use request::{Reference, Request};

/// Asks which exponential each temperature of a record follows.
/// A heat capacity adds the heat and the resistance.
#[derive(Clone, Debug, Default)]
pub struct FitStepQuestion {
    /// The columns to fit; none for all temperatures that change.
    pub columns: Vec<String>,
    /// The column of the times; `None` for the first in a unit of time.
    pub time: Option<String>,
    /// Rows before this time are left out: `30 s`.
    pub from: Option<String>,
    /// Rows after this time are left out.
    pub to: Option<String>,
    /// True if values far from those before and after them are left out.
    pub drop_outliers: bool,
    /// Statements about the form of the file.
    pub csv: CsvOptions,
    /// The heat capacity, `2659 J/K ± 5 %`; `None` for no heat and no resistance.
    pub capacity: Option<String>,
    /// The zero of rises: `initial`, a column, or a temperature; `None` for `initial`.
    pub reference: Option<String>,
    /// The class error of the thermocouples, `3 K`; `None` for exact ones.
    pub sensor: Option<String>,
    /// The netlist of which the bias of the method is computed.
    pub model: Option<PathBuf>,
    /// The node of the model that the thermocouple is on.
    pub port: Option<String>,
    /// True if the posterior is wanted, which exists for one column only.
    pub posterior: bool,
    /// The unit of temperatures; `None` for degC.
    pub temperature_unit: Option<String>,
    /// Files that are not on the disk.
    pub files: MemoryFiles,
    /// The words of the command that asked, for reports; empty if a program asked.
    pub command: Vec<String>,
}

/// The exponentials of a record.
#[derive(Debug)]
pub struct FitStepAnswer {
    request: Request,
    /// The columns that have a fit, in order.
    pub columns: Vec<StepColumn>,
    /// The names of columns that have none, with the code of the reason.
    pub without: Vec<(String, &'static str)>,
    /// Reasons why these have none.
    pub problems: Vec<Diagnostic>,
    model: Option<Model>,
    doubts: Vec<Diagnostic>,
    exit: Exit,
    command: Vec<String>,
}

/// A column with its fit.
#[derive(Debug)]
pub struct StepColumn {
    /// The measured temperatures in K.
    pub column: RecordColumn,
    /// The exponential.
    pub fit: StepFit,
    /// Rise, resistance and heat. Without a heat capacity only the rise is known.
    pub power: Power,
}

impl Answer for FitStepAnswer {
    fn files(&self) -> &Files {
        &self.request.files
    }

    fn doubts(&self) -> Vec<Diagnostic> {
        self.doubts.clone()
    }

    fn exit(&self) -> Exit {
        self.exit
    }
}

impl FitStepQuestion {
    /// Asks a file of a record; `-` is stdin.
    ///
    /// # Errors
    /// Problems of the question, the record or the model, and no column with a fit.
    pub fn ask(&self, record: &Path, listener: &dyn Listener) -> Result<FitStepAnswer, Failure> {
        let request = Request::read(self, record)?;
        if self.posterior && request.columns.len() != 1 {
            return Err(Failure::refused(
                "fit::step_posterior",
                "--posterior writes P_disp and R_eq of one column",
                "name it: --column ring_gear",
            ));
        }
        let (record, files) = (&request.record, &request.files);
        let (mut columns, mut without, mut failures) = (Vec::new(), Vec::new(), Vec::new());
        for column in request.columns.iter().map(|&i| &record.columns[i]) {
            match fitted(&request, column) {
                Ok(fit) => columns.push(fit),
                Err(error) => {
                    without.push((column.name.clone(), error.code()));
                    failures.push(doubts::failed(&request, column, &error));
                }
            }
        }
        let exits = failures.iter().map(|(exit, _)| *exit);
        let exit = exits.max_by_key(|exit| *exit as u8).unwrap_or(Exit::Done);
        let problems: Vec<Diagnostic> = failures.into_iter().map(|(_, problem)| problem).collect();
        let mut doubts = record.warnings.clone();
        doubts.extend(columns.iter().flat_map(|column| doubts::of(&request, column)));
        listener.warn(files, &doubts);
        if columns.is_empty() {
            return Err(Failure { exit, files: files.clone(), diagnostics: problems });
        }
        let model = Model::read(self, &request)?;
        let command = self.command.clone();
        Ok(FitStepAnswer { request, columns, without, problems, model, doubts, exit, command })
    }

    /// The zero of rises.
    fn zero(&self) -> &str {
        self.reference.as_deref().unwrap_or("initial")
    }
}

impl FitStepAnswer {
    /// Heat, resistance and capacity with their covariance, for further studies.
    /// `None` unless there is one column.
    pub fn posterior(&self) -> Option<Posterior> {
        let [column] = self.columns.as_slice() else { return None };
        let stem = Path::new(&self.request.name).file_stem().map(|stem| stem.to_string_lossy());
        let called = (&*stem.unwrap_or_default(), column.column.name.as_str());
        Some(column.power.posterior(&column.fit, capacity(&self.request), called))
    }
}

/// dT does not depend on the capacity.
fn capacity(request: &Request) -> Capacity {
    match &request.capacity {
        Some(capacity) => Capacity { value: capacity.value, deviation: capacity.sigma() },
        None => Capacity { value: 1.0, deviation: 0.0 },
    }
}

fn fitted(request: &Request, column: &RecordColumn) -> Result<StepColumn, StepError> {
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
    Ok(StepColumn { column: column.clone(), fit, power })
}

/// A number with its error in brackets, as part of a formula.
fn shown(value: f64, error: f64) -> String {
    format!("({})", estimate::with_error(value, error))
}
