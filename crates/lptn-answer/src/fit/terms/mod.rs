//! Several exponentials through one step response: the R-tau table of a curve.

mod figure;
mod page;

use std::path::Path;

use lptn_fit::step::{ExponentialSum, PositiveEstimate, StepCurve, TermsError};
use lptn_netlist::{
    CsvOptions, Diagnostic, Files, Record, RecordColumn, RecordName, RecordQuery, read_record,
};
use lptn_units::{Dimension, Problem as _, Type};

use crate::answer::Answer;
use crate::exit::Exit;
use crate::failure::{Failure, told};
use crate::fit::step::units_missing;
use crate::input;
use crate::listener::Listener;
use crate::memory_files::MemoryFiles;

/// Asks which exponentials a step response is the sum of.
#[derive(Clone, Debug, Default)]
pub struct FitTermsQuestion {
    /// The column to fit; `None` if the record has one of temperatures or impedances.
    pub column: Option<String>,
    /// The column of the times; `None` for the first in a unit of time.
    pub time: Option<String>,
    /// The time of the step: `30 s`; `None` for time 0 of the record.
    pub from: Option<String>,
    /// Rows after this time are left out.
    pub to: Option<String>,
    /// True if values far from those before and after them are left out.
    pub drop_outliers: bool,
    /// Statements about the form of the file.
    pub csv: CsvOptions,
    /// The power of the step: `1 W`; `None` for an impedance, or for amplitudes in kelvins.
    pub power: Option<String>,
    /// The number of terms; `None` for that of the least AICc.
    pub terms: Option<usize>,
    /// Files that are not on the disk.
    pub files: MemoryFiles,
    /// The words of the command that asked, for reports; empty if a program asked.
    pub command: Vec<String>,
}

/// The exponentials of a step response.
#[derive(Debug)]
pub struct FitTermsAnswer {
    name: String,
    files: Files,
    record: Record,
    column: RecordColumn,
    /// The sum, in K/W or K.
    pub sum: ExponentialSum,
    /// The time of the step in s.
    step: f64,
    /// The power in W by which amplitudes are divided.
    power: Option<f64>,
    command: Vec<String>,
}

impl Answer for FitTermsAnswer {
    fn files(&self) -> &Files {
        &self.files
    }

    fn doubts(&self) -> Vec<Diagnostic> {
        self.record.warnings.clone()
    }
}

impl FitTermsQuestion {
    /// Asks a file of a record; `-` is stdin.
    ///
    /// # Errors
    /// Problems of the question or the record, and a record that does not determine the terms.
    pub fn ask(&self, record: &Path, listener: &dyn Listener) -> Result<FitTermsAnswer, Failure> {
        let what = (Dimension::POWER, "fit::not_positive", "\"1 W\"");
        let power = self.power.as_deref().map(|text| input::positive("--power", text, what));
        let power = power.transpose()?.map(|power| power.value);
        let text = self.files.given(record)?;
        let (record, files) = read_record(Path::new(&text.name), &text.bytes, &self.query()?)?;
        listener.warn(&files, &record.warnings);
        let column = self.chosen(&record, &files)?;
        let impedance = is_impedance(&column);
        if impedance && power.is_some() {
            return Err(Failure::refused(
                "fit::terms_power",
                format!("--power has no effect: column `{}` is an impedance", column.name),
                "leave it out",
            ));
        }
        let step = seconds("--from", self.from.as_deref())?.unwrap_or(0.0);
        let times: Vec<f64> = record.time.iter().map(|time| time - step).collect();
        let start = impedance.then_some(0.0);
        let curve = StepCurve { times: &times, values: &column.values, start };
        let failed = |error: TermsError| {
            let message = format!("column `{}`: {error}", column.name);
            let problem = Diagnostic { message, ..told(&error) }.at(column.span.clone(), "");
            Failure::at(error.class().into(), files.clone(), problem)
        };
        let sum = ExponentialSum::new(curve, self.terms).map_err(failed)?;
        let (name, command) = (text.name, self.command.clone());
        Ok(FitTermsAnswer { name, files, record, column, sum, step, power, command })
    }

    fn query(&self) -> Result<RecordQuery, Failure> {
        Ok(RecordQuery {
            time: self.time.as_ref().map(RecordName::new),
            columns: self.column.iter().map(RecordName::new).collect(),
            from: seconds("--from", self.from.as_deref())?,
            to: seconds("--to", self.to.as_deref())?,
            drop_outliers: self.drop_outliers,
            csv: self.csv.clone(),
            of_run: false,
        })
    }

    /// The one column that is a temperature or an impedance.
    fn chosen(&self, record: &Record, files: &Files) -> Result<RecordColumn, Failure> {
        let fits = |column: &&RecordColumn| is_impedance(column) || column.unit.ty.is_temperature();
        let all: Vec<&RecordColumn> = record.columns.iter().filter(fits).collect();
        if let [column] = all[..] {
            return Ok(column.clone());
        }
        let message = match all.len() {
            0 => "no column is a temperature or a thermal impedance".to_owned(),
            count => format!("--terms fits one column, and {count} may be meant"),
        };
        let problem = Diagnostic::error("fit::no_column", message);
        let problem = problem.at(record.columns.first().map(|column| column.span.clone()), "");
        let help = match all.first() {
            None => units_missing(record).unwrap_or_else(|| {
                "the unit of an impedance is `[K/W]`, that of a temperature `[degC]`".to_owned()
            }),
            Some(column) => format!("name it: --column \"{}\"", column.name),
        };
        Err(Failure::at(Exit::Input, files.clone(), problem.help(help)))
    }
}

fn is_impedance(column: &RecordColumn) -> bool {
    column.unit.ty.conforms_to(Type::of(Dimension::RESISTANCE))
}

fn seconds(option: &str, text: Option<&str>) -> Result<Option<f64>, Failure> {
    let read = |text| input::quantity(option, text, Type::of(Dimension::TIME));
    Ok(text.map(read).transpose()?.map(|quantity| quantity.value))
}

impl FitTermsAnswer {
    /// Name and unit of the factors of the terms.
    fn factor(&self) -> (&'static str, &'static str) {
        match is_impedance(&self.column) || self.power.is_some() {
            true => ("R", "K/W"),
            false => ("A", "K"),
        }
    }

    /// The factor of each term with its time constant, fastest first.
    fn rows_of_terms(&self) -> Vec<(PositiveEstimate, PositiveEstimate)> {
        let divisor = self.power.unwrap_or(1.0);
        let terms = self.sum.terms.iter();
        terms.map(|term| (term.amplitude.over(divisor), term.tau)).collect()
    }

    /// The table as a `[foster]` that can be pasted; `None` without a power.
    pub fn foster(&self) -> Option<String> {
        if self.factor().0 == "A" {
            return None;
        }
        let rows = self.rows_of_terms();
        let column = |unit: &str, of: &dyn Fn(&(PositiveEstimate, PositiveEstimate)) -> f64| {
            let values = rows
                .iter()
                .map(|row| format!("\"{} {unit}\"", lptn_report::significant(of(row), DIGITS)));
            values.collect::<Vec<_>>().join(", ")
        };
        let (r, tau) = (column("K/W", &|row| row.0.value), column("s", &|row| row.1.value));
        Some(format!("[foster.device]\nto = \"case\"\nR = [{r}]\ntau = [{tau}]\n"))
    }
}

/// Digits of a number that is pasted.
const DIGITS: usize = 6;
