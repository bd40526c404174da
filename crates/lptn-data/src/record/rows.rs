//! The rows of a record, one after the other.

use crate::clock::Clock;
use crate::diagnostic::Diagnostic;
use crate::dialect::Maker;
use crate::form::plain_header;
use crate::head::{Asked, CsvColumn, Head, Row, Wrong, number, row};
use crate::hints;
use crate::open::open;
use crate::reader::position;
use crate::record::cells::{Cells, Counted, is_gap};
use crate::record::columns::{Choice, choose};
use crate::record::times::Order;
use crate::record::{Extent, Record, RecordColumn, RecordQuery};
use crate::text::CsvText;

/// An example of a header.
const EXAMPLE: &str = "t [s],ring [degC]";

/// A record that is being read.
struct Work<'t> {
    text: &'t CsvText,
    time: CsvColumn,
    clock: Option<Clock>,
    cells: Cells,
    record: Record,
    order: Order<'t>,
    /// The first and the last time that are read.
    window: (f64, f64),
    /// Rows without a time.
    timeless: Counted,
}

/// The numbers of a record, in SI units.
pub(crate) fn read(
    text: &CsvText,
    query: &RecordQuery,
    extent: Extent,
) -> Result<Record, Vec<Diagnostic>> {
    let head = match extent {
        Extent::Whole => open(text, &query.csv, (hints::RECORD, EXAMPLE)),
        Extent::Part => plain_header(text, (hints::RECORD, EXAMPLE)),
    };
    let head = head.map_err(|problem| vec![problem])?;
    let mut rows = head.reader(&text.text).peekable();
    let choice = choose((&head, text), rows.peek(), (query, extent))?;
    let note = head.note(text, told((&head, &choice), rows.peek(), query));
    let Choice { time, clock, columns, skipped } = choice;
    let mut work = Work::new(text, Cells::new(head, columns), (time, clock));
    work.record.warnings.extend(note);
    work.record.unitless = skipped;
    work.window = (query.from.unwrap_or(f64::NEG_INFINITY), query.to.unwrap_or(f64::INFINITY));
    while let Some(cells) = rows.next() {
        work.row(cells, rows.peek().is_none());
    }
    work.finish(extent)
}

/// Words about the times and the columns of a logger's file.
fn told(
    (head, choice): (&Head, &Choice),
    first: Option<&csv::StringRecord>,
    query: &RecordQuery,
) -> Vec<String> {
    let zero = choice.clock.as_ref().zip(first);
    let zero = zero.map(|(clock, first)| format!("0 s at {}", clock.zero_words(first, &query.csv)));
    let unit = |name: &str| {
        let header = head.columns.iter().find(|header| header.name == name);
        header.and_then(|header| header.unit.as_deref())
    };
    let (mut bare, mut unknown) = (Vec::new(), Vec::new());
    for name in &choice.skipped {
        match unit(name) {
            None => bare.push(format!("`{name}`")),
            Some(unit) => unknown.push(format!("`{name} [{unit}]`")),
        }
    }
    let left_out = |(names, why): (Vec<String>, &str)| {
        (!names.is_empty()).then(|| format!("without the columns {}, {why}", names.join(", ")))
    };
    let both = [(bare, "which have no unit"), (unknown, "whose units are unknown")];
    zero.into_iter().chain(both.into_iter().filter_map(left_out)).collect()
}

impl<'t> Work<'t> {
    fn new(text: &'t CsvText, cells: Cells, (time, clock): (CsvColumn, Option<Clock>)) -> Self {
        let comments = text.text.lines().filter_map(|line| line.strip_prefix('#'));
        let record = Record {
            file: text.file,
            time: Vec::new(),
            time_name: cells.head.columns[time.index].name.clone(),
            columns: Vec::new(),
            comments: comments.map(|comment| comment.trim().to_owned()).collect(),
            warnings: Vec::new(),
            unitless: Vec::new(),
            bytes: Vec::new(),
        };
        let order = Order::new(&text.text, &time.unit, clock.is_some());
        let window = (f64::NEG_INFINITY, f64::INFINITY);
        Self { text, time, clock, cells, record, order, window, timeless: Counted::default() }
    }

    fn row(&mut self, cells: csv::StringRecord, last: bool) {
        let at = position(&cells);
        let row = row(cells, &self.text.text);
        if !self.has_its_cells(&row, last) {
            return;
        }
        let time = match &mut self.clock {
            Some(clock) => clock.time(|index| row.cell(index)),
            None => number(row.cell(self.time.index), self.cells.head.dialect.decimal)
                .map(|time| self.time.unit.to_si(time)),
        };
        let time = match time {
            Ok(time) => time,
            Err(wrong) => {
                let problem = self.no_time(&row, wrong);
                self.timeless.add(|| problem);
                return;
            }
        };
        let place = row.whole(self.record.file);
        let change = self.clock.as_ref().and_then(|c| c.change(&self.cells.head, || place.clone()));
        let accepted = self.order.accepts(time, place);
        self.record.warnings.extend(change.filter(|_| accepted));
        if accepted && (self.window.0..=self.window.1).contains(&time) {
            self.record.time.push(time);
            self.record.bytes.push(at);
            self.cells.push(&row);
        }
    }

    /// True if a row has as many cells as the header. The last one may break off if the logger was
    /// switched off.
    fn has_its_cells(&mut self, row: &Row, last: bool) -> bool {
        let (cells, columns) = (row.cells.len(), self.cells.head.columns.len());
        if last && cells < self.cells.head.least() {
            let message = format!("this row has {cells} of {columns} values: it is left out");
            let warning = Diagnostic::warning("record::broken_off", message)
                .at(row.whole(self.record.file), "the file breaks off here");
            self.record.warnings.push(warning);
            return false;
        }
        self.cells.is_whole(row, "10.2,,45.1")
    }

    /// The error of a row without a valid time.
    fn no_time(&self, row: &Row, wrong: Wrong) -> Diagnostic {
        let index = self.time.index;
        if is_gap(row.cell(index), wrong) {
            return Diagnostic::error("record::row_without_time", "this row has no time")
                .at(row.place(self.record.file, index), "")
                .help(match self.cells.head.dialect.maker {
                    Some(Maker::LabView) => {
                        "`X_Columns No` leaves the times out: save the file with one X column"
                    }
                    _ => "remove the row: its time is not known",
                });
        }
        let problem = self.cells.head.no_number(row, (index, wrong), &Asked::default());
        match row.cell(index).chars().any(|c| c.is_ascii_digit()) {
            true => problem,
            false => problem.help("remove the row, or put `#` before it: every row has its time"),
        }
    }

    fn finish(self, extent: Extent) -> Result<Record, Vec<Diagnostic>> {
        let (mut problems, columns, head) = self.cells.finish();
        let mut record = Record { columns, ..self.record };
        problems.extend(self.timeless.told("cell of this column"));
        let range = self.order.range();
        let (reversed, warning) = self.order.told();
        problems.extend(reversed);
        record.warnings.extend(warning);
        if extent == Extent::Part {
            return if problems.is_empty() { Ok(record) } else { Err(problems) };
        }
        if problems.is_empty() && record.time.is_empty() {
            problems.push(match range {
                Some((from, to)) => outside(&head, (&from, &to)),
                None => Diagnostic::error("record::no_rows", "the record has a header and no rows")
                    .at(head.place.clone(), "nothing below it")
                    .help("below the header belong rows of numbers: `0,25.5`"),
            });
        }
        if problems.is_empty() {
            let all_gaps = |column: &&RecordColumn| column.gaps == column.values.len();
            problems.extend(record.columns.iter().filter(all_gaps).map(no_values));
        }
        if problems.is_empty() { Ok(record) } else { Err(problems) }
    }
}

/// The error that the window has no row.
fn outside(head: &Head, (from, to): (&str, &str)) -> Diagnostic {
    let message = format!("no row lies in the window of time: the record goes from {from} to {to}");
    Diagnostic::wrong(
        "record::window",
        message,
        &head.place,
        format!("times are those of the record: from {from} to {to}"),
    )
}

fn no_values(column: &RecordColumn) -> Diagnostic {
    let message = format!("column `{}` has no value at all", column.name);
    Diagnostic::error("record::no_values", message)
        .at(column.span.clone(), "only gaps below")
        .help("remove the column, or name those that are to be read")
}
