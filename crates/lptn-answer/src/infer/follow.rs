//! Rows of a record that arrive one by one and are answered at once.

use std::sync::Arc;

use lptn_fit::infer::{Followed, Follower, Row, Unexpected};
use lptn_netlist::{Diagnostic, Files, InferStudy, RecordLine, RecordLines, RecordRow};
use lptn_report::{significant, write_csv};
use lptn_solve::Table;
use lptn_units::Unit;

use super::{failed, task, unit_of};
use crate::failure::Failure;
use crate::input::Input;
use crate::listener::Listener;
use crate::words::difference;

/// Name of the record.
const STDIN: &str = "<stdin>";

/// True if a warning counts: rows of the record that the netlist names are not read.
pub(super) fn counts(study: &InferStudy, warning: &Diagnostic) -> bool {
    let file = study.reads.records.first().map(|own| own.record.file);
    warning.place().map(|place| place.file) != file
}

/// A record that is followed.
#[derive(Debug)]
pub struct Following {
    study: InferStudy,
    lines: RecordLines,
    follower: Follower,
    shown: Shown,
    /// True if nothing was answered yet.
    first: bool,
}

/// Rows that were answered.
#[derive(Debug)]
pub struct FollowedRows {
    /// Each row with its estimates, their bands, temperatures and surprises.
    pub table: Table,
    /// True if they are the first.
    pub first: bool,
}

impl FollowedRows {
    /// Lines of CSV, with their header before the first.
    pub fn csv(&self) -> String {
        let mut bytes = Vec::new();
        // memory takes everything
        write_csv(&self.table, &mut bytes).unwrap_or_default();
        let text = String::from_utf8_lossy(&bytes);
        match text.split_once('\n') {
            Some((_, rows)) if !self.first => rows.to_owned(),
            _ => text.into_owned(),
        }
    }
}

impl Following {
    pub(super) fn new(input: Arc<Input>, study: InferStudy) -> Result<Self, Failure> {
        let mut task = task(&input, &study)?;
        STDIN.clone_into(&mut task.run.name);
        let units: Vec<Unit> =
            task.estimated.iter().map(|estimated| unit_of(&input, estimated)).collect();
        let names: Vec<String> =
            task.estimated.iter().map(|estimated| estimated.name.clone()).collect();
        let columns = task.run.columns.iter();
        let columns = columns.map(|own| (own.name.clone(), own.ty.absolute)).collect();
        let follower = Follower::new(task).map_err(|error| failed(&input, &study, &error))?;
        let drops = study.reads.drop_outliers;
        let follower = if drops { follower.dropping() } else { follower };
        let shown = Shown { input, names, units, columns, drops };
        let lines = RecordLines::new(STDIN, study.reads.query());
        Ok(Self { study, lines, follower, shown, first: true })
    }

    /// Takes the next line of the record, with or without its line break.
    /// `None` if it answers no row.
    ///
    /// # Errors
    /// A line that cannot be read, and a run that fails.
    pub fn line(
        &mut self,
        line: &[u8],
        listener: &dyn Listener,
    ) -> Result<Option<FollowedRows>, Failure> {
        let RecordLine { row, warnings: (files, warnings) } = self.lines.take(line)?;
        listener.warn(&files, &warnings);
        let Some(row) = row else { return Ok(None) };
        let (own, at) = (of_study(&self.study, &row), row.line);
        let answers = self.follower.row(own);
        let answers = answers.map_err(|error| failed(&self.shown.input, &self.study, &error))?;
        listener.warn(&Files::new(), &self.shown.unexpected(&answers, at));
        if answers.is_empty() {
            return Ok(None);
        }
        let first = std::mem::take(&mut self.first);
        Ok(Some(FollowedRows { table: self.shown.table(&answers), first }))
    }

    /// Ends the record when no more rows come.
    ///
    /// # Errors
    /// A record without rows, a last line that cannot be read, and too few rows for an answer.
    pub fn end(self, listener: &dyn Listener) -> Result<(), Failure> {
        let Self { study, lines, follower, shown, .. } = self;
        let rows = lines.rows();
        let (files, warnings) = lines.end()?;
        listener.warn(&files, &warnings);
        if rows == 0 {
            let help = "send a header with units and rows, for example `tail -n +1 -f bench.csv | \
                        lptn infer FILE NAME --follow`";
            return Err(Failure::refused("record::no_rows", "stdin has no rows of a record", help));
        }
        follower.end().map_err(|error| failed(&shown.input, &study, &error))
    }
}

/// A row as columns that are compared, and signals.
fn of_study(study: &InferStudy, row: &RecordRow) -> Row {
    let (values, signals) = row.values.split_at(study.reads.observed.len());
    Row { time: row.time, values: values.to_vec(), signals: signals.to_vec() }
}

/// Names and units of answers.
#[derive(Debug)]
struct Shown {
    input: Arc<Input>,
    names: Vec<String>,
    units: Vec<Unit>,
    /// The name of each column, and true if it measures a temperature, not a difference.
    columns: Vec<(String, bool)>,
    /// True if readings may be left out.
    drops: bool,
}

impl Shown {
    /// Warnings of unexpected readings. If there is one row, its line is named.
    fn unexpected(&self, answers: &[Followed], line: usize) -> Vec<Diagnostic> {
        let told = |row: &Followed, own: &Unexpected| {
            // the first in a row reports for all that are accepted
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
            "{STDIN}{line}: column `{name}` reads {} {unit} at {} s, {} standard deviations from \
             its prediction: it is {}",
            significant(value, 6),
            significant(time, 6),
            significant(own.surprise.abs(), 2),
            if own.left_out { "left out" } else { "taken in" },
        );
        let warning = Diagnostic::warning("infer::unexpected", message);
        match (own.left_out, self.drops) {
            (true, _) => warning,
            (false, true) => warning.help(
                "a reading that comes three times in a row, or in the first rows, is accepted: \
                 check the instrument, or find the cause",
            ),
            (false, false) => warning.help(
                "a broken wire, or a digit lost? `outliers = \"drop\"` leaves out up to three such \
                 readings in a row",
            ),
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
