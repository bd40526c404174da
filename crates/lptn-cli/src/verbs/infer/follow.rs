//! `lptn infer --follow`: rows come from stdin, and each is answered at once.

use std::io::{BufRead as _, Write as _, stdin};

use lptn_fit::infer::{Followed, Follower, InferTask, Row, Unexpected};
use lptn_netlist::{Diagnostic, Files, InferStudy, RecordLine, RecordLines, RecordRow};
use lptn_report::{Format, significant, write_csv};
use lptn_solve::Table;
use lptn_units::Unit;

use super::{InferArgs, failed, unit_of};
use crate::console::Console;
use lptn_answer::exit::Exit;
use lptn_answer::failure::Failure;
use lptn_answer::input::Input;
use lptn_answer::words::difference;

/// What the record is called.
const STDIN: &str = "<stdin>";

/// Says at once what rows that come cannot be given as.
pub(super) fn possible(args: &InferArgs, console: &Console) -> Result<(), Failure> {
    let asked = match args.printed.format {
        Format::Json => "--format json",
        _ if console.plot.is_some() => "--plot",
        _ if console.reports() => "--report",
        _ => return Ok(()),
    };
    let message = format!("{asked} shows a whole record, and --follow answers rows as they come");
    let problem = Diagnostic::error("infer::follow_output", message);
    let help = "leave one of the two out: --follow prints csv, a line for each row";
    Err(Failure::new(Exit::Input, problem.help(help)))
}

/// Whether a warning about the netlist counts: nothing is read of the rows of the record that it
/// names.
pub(super) fn counts(study: &InferStudy, warning: &Diagnostic) -> bool {
    let file = study.reads.records.first().map(|own| own.record.file);
    warning.place().map(|place| place.file) != file
}

/// Follows the record to its end.
pub(super) fn follow(
    (input, study): (&Input, &InferStudy),
    console: &Console,
) -> Result<Exit, Failure> {
    let mut task =
        InferTask::of(&input.netlist, study).map_err(|error| failed(input, study, &error))?;
    STDIN.clone_into(&mut task.run.name);
    let units: Vec<Unit> = task.sought.iter().map(|sought| unit_of(input, sought)).collect();
    let names: Vec<String> = task.sought.iter().map(|sought| sought.name.clone()).collect();
    let columns = task.run.columns.iter().map(|own| (own.name.clone(), own.ty.absolute)).collect();
    let mut follower = Follower::new(task).map_err(|error| failed(input, study, &error))?;
    if study.reads.drop_outliers {
        follower = follower.dropping();
    }
    let drops = study.reads.drop_outliers;
    let shown = Shown { input, names, units, columns, drops };
    let (mut lines, mut head) = (RecordLines::new(STDIN, study.reads.query()), true);
    let mut stdin = stdin().lock();
    loop {
        let mut line = Vec::new();
        let read = stdin.read_until(b'\n', &mut line);
        if read.map_err(|error| Failure::cannot_read(STDIN, &error, None))? == 0 {
            break;
        }
        let RecordLine { row, warnings: (files, warnings) } = lines.take(&line)?;
        console.warn(&files, &warnings);
        let Some(row) = row else { continue };
        let (own, at) = (of_study(study, &row), row.line);
        let answers = follower.row(own).map_err(|error| failed(input, study, &error))?;
        console.warn(&Files::new(), &shown.unexpected(&answers, at));
        if !answers.is_empty() {
            let text = shown.text(&answers, std::mem::take(&mut head));
            if !console.stream(|out| out.write_all(text.as_bytes()))? {
                return Ok(Exit::Done);
            }
        }
    }
    ended((input, study), (lines, follower), console)
}

/// What is to be said where no more rows come.
fn ended(
    (input, study): (&Input, &InferStudy),
    (lines, follower): (RecordLines, Follower),
    console: &Console,
) -> Result<Exit, Failure> {
    let rows = lines.rows();
    let (files, warnings) = lines.end()?;
    console.warn(&files, &warnings);
    if rows == 0 {
        let problem = Diagnostic::error("record::no_rows", "stdin has no rows of a record");
        let help = "send a header with units and rows, for example `tail -n +1 -f bench.csv | lptn \
                    infer FILE NAME --follow`";
        return Err(Failure::new(Exit::Input, problem.help(help)));
    }
    follower.end().map_err(|error| failed(input, study, &error))?;
    Ok(Exit::Done)
}

/// A row as columns that are compared, and signals.
fn of_study(study: &InferStudy, row: &RecordRow) -> Row {
    let (values, signals) = row.values.split_at(study.reads.observed.len());
    Row { time: row.time, values: values.to_vec(), signals: signals.to_vec() }
}

/// How answers are shown.
struct Shown<'a> {
    input: &'a Input,
    names: Vec<String>,
    units: Vec<Unit>,
    /// The name of each column, and whether it measures a temperature and no difference of some.
    columns: Vec<(String, bool)>,
    /// Whether readings may be left out.
    drops: bool,
}

impl Shown<'_> {
    /// Warnings of readings that nobody would expect; where there is one row it stands in this line.
    fn unexpected(&self, answers: &[Followed], line: usize) -> Vec<Diagnostic> {
        let told = |row: &Followed, own: &Unexpected| {
            // the first in a row tells of all that are taken in
            let say = own.left_out || own.in_a_row == 1 || own.in_a_row == 4 && self.drops;
            let line = if answers.len() == 1 { format!(", line {line}") } else { String::new() };
            say.then(|| self.warning(row.time, own, &line))
        };
        let all = answers.iter().flat_map(|row| row.unexpected.iter().map(move |own| (row, own)));
        all.filter_map(|(row, own)| told(row, own)).collect()
    }

    fn warning(&self, time: f64, own: &Unexpected, line: &str) -> Diagnostic {
        let (name, absolute) = &self.columns[own.column];
        let unit = &self.input.netlist.temperature_unit;
        let (value, unit) = match absolute {
            true => (unit.from_si(own.value), unit.text.as_str()),
            false => (own.value / unit.scale, difference(unit)),
        };
        let message = format!(
            "{STDIN}{line}: column `{name}` reads {} {unit} at {} s, {} standard deviations from what \
             was expected: it is {}",
            significant(value, 6),
            significant(time, 6),
            significant(own.surprise.abs(), 2),
            if own.left_out { "left out" } else { "taken in" },
        );
        let warning = Diagnostic::warning("infer::unexpected", message);
        match (own.left_out, self.drops) {
            (true, _) => warning,
            (false, true) => warning.help(
                "what comes three times in a row, or in the first rows, is believed: look whether the \
                 instrument is sound, or what happened",
            ),
            (false, false) => warning.help(
                "a broken wire, or a digit lost? `outliers = \"drop\"` leaves out up to three such \
                 readings in a row",
            ),
        }
    }

    /// Rows as text, with their header before the first.
    fn text(&self, answers: &[Followed], head: bool) -> String {
        let mut bytes = Vec::new();
        // memory takes everything
        write_csv(&self.table(answers), &mut bytes).unwrap_or_default();
        let text = String::from_utf8_lossy(&bytes);
        match text.split_once('\n') {
            Some((_, rows)) if !head => rows.to_owned(),
            _ => text.into_owned(),
        }
    }

    fn table(&self, answers: &[Followed]) -> Table {
        let mut table = Table::of(answers);
        table.column("time", "s", |row| row.time);
        for (j, (name, unit)) in self.names.iter().zip(&self.units).enumerate() {
            let text = &unit.text;
            table.column(name.clone(), text, |row| unit.from_si(row.courses[j].value));
            let low = |row: &Followed| unit.from_si(row.courses[j].ends.0);
            table.column(format!("{name}.low"), text, low);
            let high = |row: &Followed| unit.from_si(row.courses[j].ends.1);
            table.column(format!("{name}.high"), text, high);
        }
        let unit = &self.input.netlist.temperature_unit;
        for (i, node) in self.input.netlist.network.nodes().iter().enumerate() {
            let name = &node.name;
            table.column(format!("{name}.T"), &unit.text, |row| unit.from_si(row.nodes[i].value));
            let deviation = |row: &Followed| row.nodes[i].deviation / unit.scale;
            table.column(format!("{name}.T.sd"), difference(unit), deviation);
        }
        for (i, (name, _)) in self.columns.iter().enumerate() {
            table.column(format!("{name}.surprise"), "1", |row| row.surprises[i]);
        }
        table.done()
    }
}
