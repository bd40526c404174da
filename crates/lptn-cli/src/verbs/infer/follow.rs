//! `lptn infer --follow`: rows come from stdin, and each is answered at once.

use std::io::{BufRead as _, Write as _, stdin};

use lptn_fit::infer::{Followed, Follower, InferTask, Row};
use lptn_netlist::{CsvText, Diagnostic, Files, InferStudy, RecordQuery, read_text};
use lptn_report::write_csv;
use lptn_solve::Table;
use lptn_units::Unit;

use super::{failed, unit_of};
use crate::console::Console;
use crate::exit::Exit;
use crate::failure::Failure;
use crate::input::Input;
use crate::words::difference;

/// What the record is called.
const STDIN: &str = "<stdin>";

/// Follows the record to its end.
pub(super) fn follow(
    (input, study): (&Input, &InferStudy),
    console: &Console,
) -> Result<Exit, Failure> {
    let task =
        InferTask::of(&input.netlist, study).map_err(|error| failed(input, study, &error))?;
    let units: Vec<Unit> = task.sought.iter().map(|sought| unit_of(input, sought)).collect();
    let names: Vec<String> = task.sought.iter().map(|sought| sought.name.clone()).collect();
    let columns: Vec<String> = task.run.columns.iter().map(|column| column.name.clone()).collect();
    let mut follower = Follower::new(task).map_err(|error| failed(input, study, &error))?;
    let shown = Shown { input, names, units, columns };
    let mut rows = Rows::new(study);
    let mut head = true;
    for line in stdin().lock().lines() {
        let line = line.map_err(|error| Failure::cannot_read(STDIN, &error, None))?;
        let Some(row) = rows.take(&line)? else { continue };
        let answers = follower.row(row).map_err(|error| failed(input, study, &error))?;
        if !answers.is_empty() {
            let text = shown.text(&answers, std::mem::take(&mut head));
            if !console.stream(|out| out.write_all(text.as_bytes()))? {
                return Ok(Exit::Done);
            }
        }
    }
    match rows.last {
        None => {
            let problem = Diagnostic::error("record::no_rows", "stdin has no rows of a record");
            let help = "send a header with units and rows, for example `tail -n +1 -f bench.csv | \
                        lptn infer FILE NAME --follow`";
            Err(Failure::new(Exit::Input, problem.help(help)))
        }
        Some(_) => Ok(Exit::Done),
    }
}

/// Lines of a record.
struct Rows {
    query: RecordQuery,
    /// How many columns are observed; the others are signals.
    observed: usize,
    header: Option<String>,
    line: usize,
    /// The time of the last row in s.
    last: Option<f64>,
}

impl Rows {
    fn new(study: &InferStudy) -> Self {
        let (query, observed) = (study.reads.query(), study.reads.observed.len());
        Self { query, observed, header: None, line: 0, last: None }
    }

    /// The row that a line holds; none for the header, comments and empty lines.
    fn take(&mut self, line: &str) -> Result<Option<Row>, Failure> {
        self.line += 1;
        if line.trim().is_empty() || line.trim_start().starts_with('#') {
            return Ok(None);
        }
        let Some(header) = &self.header else {
            self.header = Some(line.to_owned());
            return Ok(None);
        };
        let mut files = Files::new();
        let name = format!("{STDIN}, the header and line {}", self.line);
        let text = CsvText::of(&mut files, name, format!("{header}\n{line}\n").as_bytes());
        let record =
            text.map_err(|problem| vec![problem]).and_then(|text| read_text(&text, &self.query));
        let record = record.map_err(|problems| Failure {
            exit: Exit::Input,
            files,
            diagnostics: problems,
        })?;
        let time = record.time[0];
        if self.last.is_some_and(|last| time <= last) {
            let message = format!("{STDIN}, line {}: the time does not rise", self.line);
            let problem = Diagnostic::error("record::time_reversed", message);
            return Err(Failure::new(Exit::Input, problem.help("send each row once, in order")));
        }
        self.last = Some(time);
        let all: Vec<f64> = record.columns.iter().map(|column| column.values[0]).collect();
        let (values, signals) = all.split_at(self.observed);
        Ok(Some(Row { time, values: values.to_vec(), signals: signals.to_vec() }))
    }
}

/// How answers are shown.
struct Shown<'a> {
    input: &'a Input,
    names: Vec<String>,
    units: Vec<Unit>,
    columns: Vec<String>,
}

impl Shown<'_> {
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
        for (i, name) in self.columns.iter().enumerate() {
            table.column(format!("{name}.surprise"), "1", |row| row.surprises[i]);
        }
        table.done()
    }
}
