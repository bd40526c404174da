//! The things that are drawn: a run, the results of a run, a record.

use std::path::{Path, PathBuf};

use lptn_netlist::{CsvOptions, Diagnostic, Files, Record, RecordColumn, RecordQuery, read_record};
use lptn_plot::Figure;
use lptn_plot::figure::{Look, Moment};
use lptn_report::{panels, proven_caption};
use lptn_solve::{Table, name_matches};
use lptn_units::{Dimension, Type, Unit};

use crate::exit::Exit;
use crate::failure::Failure;
use crate::fit::step::units_missing;
use crate::input::{self, Given, RESULT, quoted};
use crate::run::{RunAnswer, figure};

/// The files of events and of the manifest among the results of a run.
const EVENTS: &str = "events.csv";
const MANIFEST: &str = "manifest.json";

/// Note on results in a folder, which have no rows at jumps.
const STRAIGHT: &str = "straight between rows";

/// The columns that are drawn.
#[derive(Clone, Debug, Default)]
pub struct Columns {
    /// Patterns, such as `*.T`; empty for all.
    pub select: Vec<String>,
    /// The unit of temperatures; `None` for that of the file.
    pub temperature_unit: Option<String>,
    /// True if large families of results are bands.
    pub families: bool,
    /// Statements about the form of CSV files.
    pub csv: CsvOptions,
}

/// One of the things that are drawn over each other.
#[derive(Clone, Debug)]
pub struct Source {
    /// Its name next to others.
    pub name: String,
    /// Its file or folder, which distinguishes two of one name.
    pub path: PathBuf,
    /// True if it was measured.
    pub measured: bool,
    /// Its curves.
    pub figure: Figure,
    /// Doubts, with the files that their places are in.
    pub doubts: (Files, Vec<Diagnostic>),
}

impl Source {
    /// A CSV file of measured columns.
    ///
    /// # Errors
    /// A file that cannot be read, and columns that it does not have.
    pub fn of_record(path: &Path, wanted: &Columns) -> Result<Self, Failure> {
        let (table, doubts) = wanted.of(path)?;
        let mut figure = drawn(&table, &stem(path), false);
        let curves = figure.panels.iter_mut().flat_map(|panel| &mut panel.curves);
        curves.for_each(|curve| curve.look = Look::Dots);
        Ok(Self { name: stem(path), path: path.into(), measured: true, figure, doubts })
    }

    /// The results of a run, as they were written into a folder.
    ///
    /// # Errors
    /// A folder without results, and columns that they do not have.
    pub fn of_folder(path: &Path, wanted: &Columns) -> Result<Self, Failure> {
        let result = path.join(RESULT);
        if !result.is_file() {
            return Err(no_result(path));
        }
        let (table, _) = wanted.of(&result)?;
        let mut figure = drawn(&table, &stem(path), wanted.families && wanted.select.is_empty());
        let notes = [STRAIGHT, &figure.note].map(str::to_owned);
        figure.note =
            notes.into_iter().filter(|note| !note.is_empty()).collect::<Vec<_>>().join("; ");
        let moments = events(&path.join(EVENTS));
        figure.panels.iter_mut().for_each(|panel| panel.moments.clone_from(&moments));
        let doubts = (Files::new(), not_as_written(path, &result).into_iter().collect());
        Ok(Self { name: stem(path), path: path.into(), measured: false, figure, doubts })
    }

    /// A run of a netlist; its doubts are those of the answer. `families` is true if large
    /// families may be bands.
    pub fn of_run(path: &Path, answer: &RunAnswer, families: bool) -> Self {
        Self {
            name: answer.task.input.text.stem.clone(),
            path: path.into(),
            measured: false,
            figure: answer.drawn(families && answer.folds()),
            doubts: (Files::new(), Vec::new()),
        }
    }
}

/// True if a path is a record: a CSV file.
pub fn is_record(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("csv"))
}

/// True if a path is neither results nor a record.
pub fn is_netlist(path: &Path) -> bool {
    !path.is_dir() && !is_record(path)
}

fn no_result(path: &Path) -> Failure {
    let message = format!("there is no {RESULT} in the folder {}", path.display());
    let help = match path.extension().is_some_and(|ending| ending == "toml") {
        true => {
            format!("this is a netlist: lptn run {} --report", quoted(&path.display().to_string()))
        }
        false => "`lptn run FILE` writes one into out/NAME".to_owned(),
    };
    Failure::refused("plot::no_result", message, help)
}

/// Warning that results differ from their manifest: a file that was cut off reads as another.
fn not_as_written(folder: &Path, result: &Path) -> Option<Diagnostic> {
    let manifest = std::fs::read_to_string(folder.join(MANIFEST)).unwrap_or_default();
    let manifest: serde_json::Value = serde_json::from_str(&manifest).unwrap_or_default();
    let files = manifest["results"].as_array().map_or(&[][..], Vec::as_slice);
    let written = files.iter().find(|file| file["name"] == RESULT).map(|file| &file["sha256"]);
    let found = std::fs::read(result).map(|bytes| lptn_study::sha256(&bytes)).ok();
    let message = match (written, found) {
        (Some(written), Some(found)) if written.as_str() == Some(found.as_str()) => return None,
        (Some(_), _) => format!("{} is not the file that its run has written", result.display()),
        (None, _) => format!("no {MANIFEST} says whether {} is whole", result.display()),
    };
    let doubt = Diagnostic::warning("plot::not_as_written", message);
    Some(doubt.help("`lptn run FILE` writes it again"))
}

fn stem(path: &Path) -> String {
    path.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default()
}

fn drawn(table: &Table, title: &str, fold: bool) -> Figure {
    let (panels, left_out) = panels(table, fold);
    let lower =
        (left_out > 0).then(|| format!("{left_out} lower curves are not shown; --select chooses"));
    let notes: Vec<String> = lower.into_iter().chain(proven_caption(table)).collect();
    Figure { title: title.into(), note: notes.join("; "), panels }
}

impl Columns {
    /// The columns of a CSV file over its times, with doubts in it.
    fn of(&self, path: &Path) -> Result<(Table, (Files, Vec<Diagnostic>)), Failure> {
        let scale = self.temperature_unit.as_deref();
        let scale = scale.map(|scale| input::scale_of("--temperature-unit", scale)).transpose()?;
        let text = input::read(path)?;
        let of_run = path.file_name().is_some_and(|name| name == RESULT);
        let (record, files) = self.read(&text, of_run)?;
        let wanted = |column: &&RecordColumn| {
            self.select.is_empty() || self.select.iter().any(|pattern| fits(pattern, column))
        };
        let chosen: Vec<&RecordColumn> = record.columns.iter().filter(wanted).collect();
        if chosen.is_empty() {
            return Err(no_column(&text.name, record, files));
        }
        let rows: Vec<usize> = (0..record.time.len()).collect();
        let mut table = Table::of(&rows);
        table.column("time", "s", |row| record.time[*row]);
        for column in chosen {
            let dimension = column.unit.ty.dimension;
            let asked = scale.as_ref().filter(|_| dimension == Dimension::TEMPERATURE);
            let asked = asked.map(|scale| match is_point(column) {
                true => scale.clone(),
                false => scale.shown(Type::of(dimension)),
            });
            // a header in `°C` and a run in `degC` have one scale
            let usual = || is_point(column).then(|| input::scale(&column.unit)).flatten();
            let unit = &asked.or_else(usual).unwrap_or_else(|| column.unit.clone());
            table.column(name_of(column, unit), &unit.text, |row| shown(column.values[*row], unit));
        }
        // our own results need no doubts
        let doubts = if of_run { Vec::new() } else { record.warnings };
        Ok((table.done(), (files, doubts)))
    }

    fn read(&self, text: &Given, of_run: bool) -> Result<(Record, Files), Failure> {
        let query = RecordQuery { of_run, csv: self.csv.clone(), ..RecordQuery::default() };
        Ok(read_record(Path::new(&text.name), &text.bytes, &query)?)
    }

    /// For each pattern, true if it matches a column of a record or of the results in a folder.
    ///
    /// # Errors
    /// A file that cannot be read.
    pub fn matching(&self, path: &Path) -> Result<Vec<bool>, Failure> {
        let of_run = path.is_dir();
        let file = if of_run { path.join(RESULT) } else { path.to_owned() };
        if of_run && !file.is_file() {
            return Err(no_result(path));
        }
        let (record, _) = self.read(&input::read(&file)?, of_run)?;
        let found = |pattern: &String| record.columns.iter().any(|column| fits(pattern, column));
        Ok(self.select.iter().map(found).collect())
    }
}

/// True for a point on the temperature scale. Proven errors are differences.
fn is_point(column: &RecordColumn) -> bool {
    column.unit.ty.absolute && !column.name.ends_with(".bound")
}

/// The name of a column in a table. `K` alone is a difference there, except in those of a node.
fn name_of(column: &RecordColumn, unit: &Unit) -> String {
    let name = &column.name;
    let bare = is_point(column) && unit.text == "K" && !name.ends_with(".T");
    if bare { format!("{name}.T") } else { name.clone() }
}

/// True if a pattern matches a column. A measured `ring` is the `ring.T` of a run, and a column
/// comes with its proven errors.
fn fits(pattern: &str, column: &RecordColumn) -> bool {
    let name = column.name.strip_suffix(".bound").unwrap_or(&column.name);
    name_matches(pattern, &column.name)
        || name_matches(pattern, name)
        || (is_point(column) && name_matches(pattern, &format!("{name}.T")))
}

fn shown(value: f64, unit: &Unit) -> f64 {
    if value.is_finite() { unit.from_si(value) } else { f64::NAN }
}

fn no_column(name: &str, record: Record, files: Files) -> Failure {
    let names: Vec<&str> = record.columns.iter().map(|column| column.name.as_str()).collect();
    if !names.is_empty() {
        let message = format!("no column of {name} is selected");
        return Failure::refused(
            "select::no_match",
            message,
            format!("it has {}", names.join(", ")),
        );
    }
    let message = format!("{name} has no column of numbers with a unit");
    let problem = Diagnostic::error("select::no_match", message);
    let problem = problem.help(match units_missing(&record) {
        Some(help) => help,
        None => "give each column its unit in the header: `ring [degC]`".to_owned(),
    });
    // the note on the form of the file names the columns without a unit
    let diagnostics = record.warnings.into_iter().chain([problem]).collect();
    Failure { exit: Exit::Input, files, diagnostics }
}

/// The events that a run has written; a picture does not depend on them.
/// There are none if they cannot be read or are too many.
fn events(path: &Path) -> Vec<Moment> {
    let Ok(text) = std::fs::read_to_string(path) else { return Vec::new() };
    let rows: Vec<Vec<&str>> = text.lines().skip(1).map(|line| line.split(',').collect()).collect();
    let moment = |row: &Vec<&str>| {
        let [time, kind, name, _, after] = row[..] else { return None };
        let what = figure::what(kind, after != "0");
        Some(Moment { name: format!("{name} {what}"), at: time.parse().ok()? })
    };
    let moments: Vec<Moment> = rows.iter().filter_map(moment).collect();
    if moments.len() > figure::MOST_EVENTS { Vec::new() } else { moments }
}
