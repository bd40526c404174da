//! A record and the settings of its fit.

use std::path::Path;

use lptn_netlist::{Diagnostic, Files, Record, RecordName, RecordQuery, read_record, unit_option};
use lptn_units::{Dimension, Quantity, Type, Unit, parse_quantity};

use super::FitStepQuestion;
use crate::exit::Exit;
use crate::failure::Failure;
use crate::input::{self, wrong_unit};

/// A record and the settings of its fit.
#[derive(Debug)]
pub(super) struct Request {
    /// Name of the record in diagnostics and results.
    pub(super) name: String,
    pub(super) record: Record,
    /// The first time of the record in s before `--from` cut it.
    /// `None` if that part cannot be read.
    pub(super) begin: Option<f64>,
    pub(super) files: Files,
    /// The columns to fit, by position.
    pub(super) columns: Vec<usize>,
    pub(super) reference: Reference,
    /// The capacity in J/K.
    pub(super) capacity: Option<Quantity>,
    /// The class error of the thermocouples in K.
    pub(super) sensor: Option<f64>,
    pub(super) unit: Unit,
}

/// Zero from which dT is counted.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Reference {
    /// The temperature at the start of each column.
    Initial,
    /// A column of the record, by position.
    Column(usize),
    /// A temperature in K.
    Value(f64),
}

impl Request {
    /// True if rows before the first fitted one were left out.
    pub(super) fn is_cut(&self) -> bool {
        self.begin.is_none_or(|begin| self.record.time.first().is_some_and(|&first| begin < first))
    }

    pub(super) fn read(question: &FitStepQuestion, record: &Path) -> Result<Self, Failure> {
        let positive = |option: &str, text: &Option<String>, dimension, example| {
            let what = (dimension, "fit::not_positive", example);
            text.as_deref().map(|text| input::positive(option, text, what)).transpose()
        };
        let capacity =
            positive("--capacity", &question.capacity, Dimension::CAPACITY, "\"2659 J/K ± 5 %\"")?;
        let sensor = positive("--sensor", &question.sensor, Dimension::TEMPERATURE, "\"3 K\"")?;
        let unit = temperature_unit(question.temperature_unit.as_deref())?;
        let text = question.files.given(record)?;
        let (record, files) = read_record(Path::new(&text.name), &text.bytes, &query(question)?)?;
        let begin = match question.from {
            Some(_) => begin(question, Path::new(&text.name), &text.bytes)?,
            None => record.time.first().copied(),
        };
        let reference = reference(question.zero(), (&record, &files))?;
        let columns = columns(question, &record, &reference);
        if columns.is_empty() {
            return Err(nothing(&record, files));
        }
        let sensor = sensor.map(|quantity| quantity.value);
        Ok(Self {
            name: text.name,
            record,
            begin,
            files,
            columns,
            reference,
            capacity,
            sensor,
            unit,
        })
    }
}

/// The first time of the whole record.
fn begin(question: &FitStepQuestion, path: &Path, bytes: &[u8]) -> Result<Option<f64>, Failure> {
    let whole = RecordQuery { from: None, ..query(question)? };
    Ok(read_record(path, bytes, &whole).ok().and_then(|(record, _)| record.time.first().copied()))
}

fn time(option: &str, text: Option<&str>) -> Result<Option<f64>, Failure> {
    let read = |text| input::quantity(option, text, Type::of(Dimension::TIME));
    Ok(text.map(read).transpose()?.map(|quantity| quantity.value))
}

fn temperature_unit(text: Option<&str>) -> Result<Unit, Failure> {
    input::scale_of("--temperature-unit", text.unwrap_or("degC"))
}

/// The query of a record: all columns, or the named ones and the one that dT is counted from.
fn query(question: &FitStepQuestion) -> Result<RecordQuery, Failure> {
    let temperature =
        |name: &str| RecordName { ty: Some(Type::ABSOLUTE_TEMPERATURE), ..RecordName::new(name) };
    let mut names: Vec<&str> = Vec::new();
    for name in &question.columns {
        if !names.contains(&name.as_str()) {
            names.push(name);
        }
    }
    let reference = question.zero();
    if !names.is_empty() && names_a_column(reference) && !names.contains(&reference) {
        names.push(reference);
    }
    let (from, to) =
        (time("--from", question.from.as_deref())?, time("--to", question.to.as_deref())?);
    Ok(RecordQuery {
        time: question.time.as_ref().map(RecordName::new),
        columns: names.into_iter().map(temperature).collect(),
        from,
        to,
        drop_outliers: question.drop_outliers,
        csv: question.csv.clone(),
        of_run: false,
    })
}

/// True if the text of `--reference` is neither `initial` nor a temperature.
fn names_a_column(text: &str) -> bool {
    text != "initial" && parse_quantity(text, Some(Type::ABSOLUTE_TEMPERATURE)).is_err()
}

fn reference(text: &str, (record, files): (&Record, &Files)) -> Result<Reference, Failure> {
    if text == "initial" {
        return Ok(Reference::Initial);
    }
    let temperatures =
        || record.columns.iter().enumerate().filter(|(_, column)| column.unit.ty.absolute);
    if let Some((index, _)) = temperatures().find(|(_, column)| column.name == text) {
        return Ok(Reference::Column(index));
    }
    match parse_quantity(text, Some(Type::ABSOLUTE_TEMPERATURE)) {
        Ok(quantity) => Ok(Reference::Value(quantity.value)),
        // a text that begins with a digit was meant as a temperature
        Err(error)
            if text.trim_start_matches(['+', '-']).starts_with(|c: char| c.is_ascii_digit()) =>
        {
            Err(wrong_unit("--reference", text, &error))
        }
        Err(_) => {
            let message = format!("--reference: there is no column `{text}` of temperatures");
            let problem = Diagnostic::error("fit::reference", message);
            let names = temperatures().map(|(_, column)| column.name.as_str()).chain(["initial"]);
            let problem = problem.did_you_mean(text, names, || {
                "name a column of the record, a temperature such as \"25.5 degC\", or initial"
                    .into()
            });
            Err(Failure::at(Exit::Input, files.clone(), problem))
        }
    }
}

/// The columns to fit: the named ones, or all temperatures that change.
/// The column that dT is counted from is not fitted.
fn columns(question: &FitStepQuestion, record: &Record, reference: &Reference) -> Vec<usize> {
    let is_asked = |i: usize| question.columns.contains(&record.columns[i].name);
    let changes = |i: usize| {
        let mut values = record.columns[i].values.iter().filter(|value| !value.is_nan());
        let first = values.next();
        values.any(|value| Some(value) != first)
    };
    let all = 0..record.columns.len();
    let chosen = all.filter(|&i| match question.columns.is_empty() {
        true => {
            record.columns[i].unit.ty.absolute && *reference != Reference::Column(i) && changes(i)
        }
        false => is_asked(i),
    });
    chosen.collect()
}

/// Help if columns of a record were left out because they have no unit.
pub(crate) fn units_missing(record: &Record) -> Option<String> {
    let option = |name: &String| unit_option(name, Type::ABSOLUTE_TEMPERATURE);
    let options: Vec<String> = record.unitless.iter().map(option).collect();
    (!options.is_empty()).then(|| format!("give the column its unit: {}", options.join(" ")))
}

fn nothing(record: &Record, files: Files) -> Failure {
    let message = "no column of the record is a temperature that changes";
    let problem = Diagnostic::error("fit::no_column", message);
    let problem = problem.at(record.columns.first().map(|column| column.span.clone()), "");
    let usual = "the unit of a temperature is `[degC]`, `[K]` or `[degF]`";
    let problem = problem.help(units_missing(record).unwrap_or_else(|| usual.to_owned()));
    // the warnings name the columns that do not change
    let diagnostics = record.warnings.iter().cloned().chain([problem]).collect();
    Failure { exit: Exit::Input, files, diagnostics }
}
