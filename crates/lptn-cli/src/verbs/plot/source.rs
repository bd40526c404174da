//! What is drawn: a run, what a run has written, or a record.

use std::path::{Path, PathBuf};

use lptn_netlist::{Diagnostic, Files, Record, RecordColumn, RecordQuery, read_record};
use lptn_plot::Figure;
use lptn_plot::figure::{Look, Moment};
use lptn_report::{Format, panels};
use lptn_solve::{Table, name_matches};
use lptn_units::Unit;

use super::PlotArgs;
use crate::console::Console;
use crate::files::names::{EVENTS, MANIFEST, RESULT};
use crate::input::Load as _;
use crate::options::{Scale, Shown, TimeScale};
use crate::verbs::run::{self, RunArgs};
use lptn_answer::exit::Exit;
use lptn_answer::failure::Failure;
use lptn_answer::input::{self, Input, quoted};
use lptn_answer::run::figure;

/// One of the things that are drawn over each other.
pub(super) struct Source {
    /// What it is called beside others.
    pub(super) name: String,
    /// Where it comes from: two of one name are told apart by it.
    pub(super) path: PathBuf,
    /// Whether it was measured.
    pub(super) measured: bool,
    pub(super) figure: Figure,
}

impl Source {
    /// Reads a record or results, or runs a netlist, which has an exit code.
    pub(super) fn of(
        path: &Path,
        args: &PlotArgs,
        console: &Console,
    ) -> Result<(Self, Exit), Failure> {
        if path.is_dir() {
            return Ok((Self::of_folder(path, args, console)?, Exit::Done));
        }
        if is_record(path) {
            let table = columns(path, args, console)?;
            let mut figure = drawn(&table, &stem(path));
            let curves = figure.panels.iter_mut().flat_map(|panel| &mut panel.curves);
            curves.for_each(|curve| curve.look = Look::Dots);
            let source = Self { name: stem(path), path: path.into(), measured: true, figure };
            return Ok((source, Exit::Done));
        }
        Self::of_netlist(path, args, console)
    }

    fn of_netlist(
        path: &Path,
        args: &PlotArgs,
        console: &Console,
    ) -> Result<(Self, Exit), Failure> {
        let source = crate::options::Source {
            set: args.set.clone(),
            ..crate::options::Source::of(path.into())
        };
        let scale = Scale { temperature_unit: args.scale.temperature_unit.clone() };
        let shown = Shown { format: Format::Csv, select: args.select.clone(), scale };
        let args = RunArgs {
            source,
            times: args.times.clone(),
            shown,
            time_scale: TimeScale::default(),
            balance: None,
            tolerance: None,
            output: None,
            at: Vec::new(),
            no_files: true,
            uncertainty: run::uncertainty::UncertaintyArgs::default(),
        };
        let mut input = Input::load(&args.source)?;
        input.set_run_times(&args.times)?;
        let (outcome, _) = run::answer(&args, input, console)?;
        run::messages::beside(&outcome, None, console);
        let exit = run::messages::conclude(&outcome, false, console);
        Ok((
            Self {
                name: outcome.task.input.text.stem.clone(),
                path: path.into(),
                measured: false,
                figure: outcome.figure(),
            },
            exit,
        ))
    }

    fn of_folder(path: &Path, args: &PlotArgs, console: &Console) -> Result<Self, Failure> {
        let figure = selected(path, args, console)?;
        Ok(Self { name: stem(path), path: path.into(), measured: false, figure })
    }
}

/// The columns of results over time, as their run wrote them.
pub(crate) fn of_folder(path: &Path, console: &Console) -> Result<Figure, Failure> {
    selected(path, &PlotArgs::default(), console)
}

fn selected(path: &Path, args: &PlotArgs, console: &Console) -> Result<Figure, Failure> {
    let result = path.join(RESULT);
    if !result.is_file() {
        return Err(no_result(path));
    }
    as_it_was_written(path, &result, console);
    let mut figure = drawn(&columns(&result, args, console)?, &stem(path));
    let moments = events(&path.join(EVENTS));
    figure.panels.iter_mut().for_each(|panel| panel.moments.clone_from(&moments));
    Ok(figure)
}

fn is_record(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("csv"))
}

/// Whether a path is neither results nor a record.
pub(super) fn is_netlist(path: &Path) -> bool {
    !path.is_dir() && !is_record(path)
}

fn no_result(path: &Path) -> Failure {
    let message = format!("there is no {RESULT} in the folder {}", path.display());
    let problem = Diagnostic::error("plot::no_result", message);
    let help = match path.extension().is_some_and(|ending| ending == "toml") {
        true => {
            format!("this is a netlist: lptn run {} --report", quoted(&path.display().to_string()))
        }
        false => "`lptn run FILE` writes one into out/NAME".to_owned(),
    };
    Failure::new(Exit::Input, problem.help(help))
}

/// Warns where results are not those that their manifest speaks of: one that was cut off reads as
/// another.
fn as_it_was_written(folder: &Path, result: &Path, console: &Console) {
    let manifest = std::fs::read_to_string(folder.join(MANIFEST)).unwrap_or_default();
    let manifest: serde_json::Value = serde_json::from_str(&manifest).unwrap_or_default();
    let files = manifest["results"].as_array().map_or(&[][..], Vec::as_slice);
    let written = files.iter().find(|file| file["name"] == RESULT).map(|file| &file["sha256"]);
    let found = std::fs::read(result).map(|bytes| lptn_study::sha256(&bytes)).ok();
    let message = match (written, found) {
        (Some(written), Some(found)) if written.as_str() == Some(found.as_str()) => return,
        (Some(_), _) => format!("{} is not the file that its run has written", result.display()),
        (None, _) => format!("no {MANIFEST} says whether {} is whole", result.display()),
    };
    let problem = Diagnostic::warning("plot::not_as_written", message);
    console.warn(&Files::new(), &[problem.help("`lptn run FILE` writes it again")]);
}

fn stem(path: &Path) -> String {
    path.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default()
}

fn drawn(table: &Table, title: &str) -> Figure {
    let (panels, left_out) = panels(table);
    let note = match left_out {
        0 => String::new(),
        _ => format!("{left_out} lower curves are not shown; --select chooses"),
    };
    Figure { title: title.into(), note, panels }
}

/// The columns of a CSV file that were asked for, over its times.
fn columns(path: &Path, args: &PlotArgs, console: &Console) -> Result<Table, Failure> {
    let scale = args.scale.temperature_unit.as_deref();
    let scale = scale.map(|scale| input::scale_of("--temperature-unit", scale)).transpose()?;
    let text = input::read(path)?;
    let of_run = path.file_name().is_some_and(|name| name == RESULT);
    let query = RecordQuery { of_run, ..RecordQuery::default() };
    let (record, files) = read_record(Path::new(&text.name), &text.bytes, &query)?;
    // our own results need no doubts
    if !of_run {
        console.warn(&files, &record.warnings);
    }
    let wanted = |column: &&RecordColumn| {
        args.select.is_empty()
            || args.select.iter().any(|pattern| name_matches(pattern, &column.name))
    };
    let chosen: Vec<&RecordColumn> = record.columns.iter().filter(wanted).collect();
    if chosen.is_empty() {
        return Err(no_column(&text.name, &record));
    }
    let rows: Vec<usize> = (0..record.time.len()).collect();
    let mut table = Table::of(&rows);
    table.column("time", "s", |row| record.time[*row]);
    for column in chosen {
        let scale = scale.as_ref().filter(|_| column.unit.ty.absolute);
        let unit = scale.unwrap_or(&column.unit);
        table.column(&column.name, &unit.text, |row| shown(column.values[*row], unit));
    }
    Ok(table.done())
}

fn shown(value: f64, unit: &Unit) -> f64 {
    if value.is_finite() { unit.from_si(value) } else { f64::NAN }
}

fn no_column(name: &str, record: &Record) -> Failure {
    let names: Vec<&str> = record.columns.iter().map(|column| column.name.as_str()).collect();
    let problem = Diagnostic::error("select::no_match", format!("no column of {name} is selected"));
    Failure::new(Exit::Input, problem.help(format!("it has {}", names.join(", "))))
}

/// What a run has written of its events; nothing where that cannot be read, since a picture does
/// not depend on it.
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
