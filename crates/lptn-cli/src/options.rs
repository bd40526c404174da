//! Options that several verbs share.

use std::path::PathBuf;

use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Args as Arguments, ValueEnum};
use lptn_answer::failure::Failure;
use lptn_netlist::{CsvOptions, DATE_ORDERS, DECIMALS};
use lptn_report::{Format, TimeUnit};
use lptn_units::Unit;

use crate::drawing::Drawing;
use crate::reporting::page_name;

/// The help of every command: examples, its purpose, then its options.
pub(crate) const TEMPLATE: &str = "\
{before-help}{about-with-newline}
{usage-heading} {usage}

{all-args}";

/// Options of every verb.
#[derive(Debug, Arguments)]
#[command(next_help_heading = "Everywhere")]
pub(crate) struct Global {
    /// Print results and errors only
    #[arg(short, long, global = true, conflicts_with = "verbose")]
    pub(crate) quiet: bool,
    /// Print more about the solver, and list checks that were skipped
    #[arg(short, long, global = true)]
    pub(crate) verbose: bool,
    #[arg(long, global = true, value_name = "WHEN", default_value = "auto")]
    #[arg(help = "Use colours: auto, always or never; auto respects NO_COLOR")]
    #[arg(hide_default_value = true, hide_possible_values = true)]
    pub(crate) color: Color,
    /// Draw the result: to a file that ends with .svg or .png, or - for the terminal
    #[arg(long, global = true, value_name = "FILE")]
    pub(crate) plot: Option<Drawing>,
    /// Write the result as one HTML page, among the results or to =FILE
    #[arg(long, global = true, value_name = "FILE", num_args = 0..=1, require_equals = true)]
    #[arg(value_parser = page_name)]
    pub(crate) report: Option<Option<PathBuf>>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Color {
    Auto,
    Always,
    Never,
}

/// The netlist and what is changed in it.
#[derive(Debug, Arguments)]
pub(crate) struct Source {
    /// The netlist; - reads it from stdin
    #[arg(value_name = "FILE")]
    pub(crate) file: PathBuf,
    /// Give a parameter a value; may be repeated
    #[arg(long, value_name = "NAME=VALUE")]
    pub(crate) set: Vec<String>,
    /// Take the parameters and signals of a load case, [case.NAME]; --set goes before it
    #[arg(long, value_name = "NAME")]
    pub(crate) case: Option<String>,
}

impl Source {
    /// A netlist as it is.
    pub(crate) fn of(file: PathBuf) -> Self {
        Self { file, set: Vec::new(), case: None }
    }

    /// The load case, and the values that are set after it.
    pub(crate) fn settings(&self) -> (Option<&str>, &[String]) {
        (self.case.as_deref(), &self.set)
    }
}

/// Statements about the numbers of CSV files, where their contents do not show it.
#[derive(Clone, Debug, Default, Arguments)]
#[command(next_help_heading = "CSV files")]
pub(crate) struct CsvNumbers {
    /// The decimal sign, . or , if the numbers do not show it
    #[arg(long, value_name = "SIGN", value_parser = [".", ","])]
    #[arg(hide_possible_values = true)]
    pub(crate) decimal: Option<String>,
    /// The unit of a column whose header does not give it; may be repeated
    #[arg(long, value_name = "NAME=UNIT")]
    pub(crate) unit: Vec<String>,
}

impl CsvNumbers {
    /// The statements.
    ///
    /// # Errors
    /// If a unit is not one, or belongs to no column.
    pub(crate) fn options(&self) -> Result<CsvOptions, Failure> {
        let word = self.decimal.as_deref().unwrap_or_default();
        let decimal = DECIMALS.iter().find(|(sign, _)| *sign == word);
        Ok(CsvOptions {
            decimal: decimal.map(|(_, decimal)| *decimal),
            units: self.unit.iter().map(|text| unit_of(text)).collect::<Result<_, _>>()?,
            ..CsvOptions::default()
        })
    }
}

/// Statements about the form of records, where their contents do not show it.
#[derive(Clone, Debug, Default, Arguments)]
#[command(next_help_heading = "CSV files")]
pub(crate) struct CsvForm {
    #[command(flatten)]
    pub(crate) numbers: CsvNumbers,
    /// The order of dates: "day first", "month first" or "year first"
    #[arg(long, value_name = "ORDER", value_parser = ["day first", "month first", "year first"])]
    #[arg(hide_possible_values = true)]
    pub(crate) dates: Option<String>,
    /// The date and clock time that is 0 s; default: those of the first row
    #[arg(long, value_name = "TIME")]
    pub(crate) start: Option<String>,
}

impl CsvForm {
    /// The statements.
    ///
    /// # Errors
    /// If a unit is not one, or belongs to no column.
    pub(crate) fn options(&self) -> Result<CsvOptions, Failure> {
        let word = self.dates.as_deref().unwrap_or_default();
        let dates = DATE_ORDERS.iter().find(|(order, _)| *order == word);
        Ok(CsvOptions {
            dates: dates.map(|(_, order)| *order),
            start: self.start.clone(),
            ..self.numbers.options()?
        })
    }
}

/// The column and the unit of `NAME=UNIT`.
fn unit_of(text: &str) -> Result<(String, String), Failure> {
    let split = text.rsplit_once('=').map(|(name, unit)| (name.trim(), unit.trim()));
    match split.filter(|(_, unit)| *unit == "-" || Unit::parse(unit).is_ok()) {
        Some((name, unit)) => Ok((name.to_owned(), unit.to_owned())),
        None => Err(Failure::refused(
            "netlist::csv_form",
            format!("--unit needs a column and its unit, got `{text}`"),
            "write for example `--unit ring=degC`",
        )),
    }
}

/// Times of the run in place of those of the netlist.
#[derive(Clone, Debug, Default, Arguments)]
pub(crate) struct Times {
    /// End the run after this time, such as 2h
    #[arg(long, value_name = "TIME")]
    pub(crate) stop: Option<String>,
    /// Write a row at this interval, such as 10s
    #[arg(long, value_name = "TIME")]
    pub(crate) every: Option<String>,
}

/// The unit in which times are shown.
#[derive(Clone, Debug, Default, Arguments)]
pub(crate) struct TimeScale {
    /// Show times in s, min, h or d
    #[arg(long, value_name = "UNIT", hide_possible_values = true)]
    #[arg(value_parser = one_of(&TimeUnit::ALL, TimeUnit::symbol))]
    pub(crate) time_unit: Option<TimeUnit>,
}

/// How a result is printed, of a verb that writes no files unless it is asked to.
#[derive(Debug, Arguments)]
pub(crate) struct Printed {
    /// Print a table, csv or json
    #[arg(long, value_name = "FORMAT", default_value = "table", hide_possible_values = true)]
    #[arg(value_parser = one_of(&Format::ALL, Format::key))]
    pub(crate) format: Format,
    #[command(flatten)]
    _no_files: NoFiles,
}

/// Accepted for scripts that pass it to every verb.
#[derive(Debug, Arguments)]
pub(crate) struct NoFiles {
    #[arg(long = "no-files", id = "no_files", hide = true)]
    _no_files: bool,
}

/// The scale in which temperatures are shown.
#[derive(Debug, Default, Arguments)]
pub(crate) struct Scale {
    /// Show temperatures in degC, K, degF or degR
    #[arg(long, value_name = "UNIT")]
    pub(crate) temperature_unit: Option<String>,
}

/// What is shown of columns, and how.
#[derive(Debug, Arguments)]
pub(crate) struct Shown {
    /// Print a table, csv or json
    #[arg(long, value_name = "FORMAT", default_value = "table", hide_possible_values = true)]
    #[arg(value_parser = one_of(&Format::ALL, Format::key))]
    pub(crate) format: Format,
    /// Keep columns like '*.T'; may be repeated
    #[arg(long, value_name = "PATTERN")]
    pub(crate) select: Vec<String>,
    #[command(flatten)]
    pub(crate) scale: Scale,
}

/// A choice of a library by its name there, so that the names are in one place.
pub(crate) fn one_of<T: Copy + Send + Sync + 'static>(
    all: &'static [T],
    key: fn(T) -> &'static str,
) -> impl TypedValueParser<Value = T> {
    let found = move |text: String| all.iter().copied().find(|choice| key(*choice) == text);
    PossibleValuesParser::new(all.iter().map(|choice| key(*choice)))
        .try_map(move |text| found(text).ok_or("this is not one of the choices"))
}
