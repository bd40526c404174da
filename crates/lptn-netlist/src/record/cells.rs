//! The rows of a record, one after the other.

use crate::csv_form::{self, extra_help, text_help};
use crate::csv_head::{Head, Row, Wrong, number, position, reader, row};
use crate::diagnostic::Diagnostic;
use crate::file::{FileId, Span};
use crate::record::columns::{Chosen, choose};
use crate::record::times::Order;
use crate::record::{Counted, Record, RecordColumn, RecordQuery};

/// A header as it could be.
const EXAMPLE: &str = "t [s],ring [degC]";

/// Words for a value that was not measured.
const GAPS: [&str; 5] = ["nan", "na", "n/a", "null", "none"];

/// A record that is being read.
struct Work<'t> {
    text: &'t str,
    head: Head,
    time: Chosen,
    chosen: Vec<Chosen>,
    record: Record,
    order: Order<'t>,
    /// The first and the last time that are read.
    window: (f64, f64),
    /// By column, the times last.
    wrong: Vec<Counted>,
    lengths: Counted,
}

/// The numbers of a record, in SI units.
pub(crate) fn read(
    file: FileId,
    (name, text): (&str, &str),
    query: &RecordQuery,
) -> Result<Record, Vec<Diagnostic>> {
    let mut reader = reader(text);
    let mut rows = reader.records().filter_map(Result::ok).peekable();
    let Some(head) = rows.next() else { return Err(vec![empty(file, name)]) };
    let head = Head::new(file, &row(head, text));
    if let Some(problem) = csv_form::check(&head, (name, text), (csv_form::RECORD, EXAMPLE)) {
        return Err(vec![problem]);
    }
    let (time, chosen) = choose(&head, rows.peek(), query)?;
    let mut work = Work::new((file, text), head, time, chosen);
    work.window = (query.from.unwrap_or(f64::NEG_INFINITY), query.to.unwrap_or(f64::INFINITY));
    while let Some(cells) = rows.next() {
        work.row(cells, rows.peek().is_none());
    }
    work.finish()
}

fn empty(file: FileId, name: &str) -> Diagnostic {
    Diagnostic::error("record::empty", format!("{name} is empty"))
        .at(Span::new(file, 0..0), "the header belongs here")
        .help(format!("begin it with the names of the columns and their units: `{EXAMPLE}`"))
}

impl<'t> Work<'t> {
    fn new((file, text): (FileId, &'t str), head: Head, time: Chosen, chosen: Vec<Chosen>) -> Self {
        let column = |chosen: &Chosen| {
            let header = &head.columns[chosen.index];
            RecordColumn {
                name: header.name.clone(),
                unit: chosen.unit.clone(),
                values: Vec::new(),
                gaps: 0,
                saturation: None,
                span: header.place.clone(),
            }
        };
        let comments = text.lines().filter_map(|line| line.strip_prefix('#'));
        let record = Record {
            file,
            time: Vec::new(),
            time_name: head.columns[time.index].name.clone(),
            columns: chosen.iter().map(column).collect(),
            comments: comments.map(|comment| comment.trim().to_owned()).collect(),
            warnings: Vec::new(),
            bytes: Vec::new(),
        };
        let wrong = (0..=chosen.len()).map(|_| Counted::default()).collect();
        let order = Order::new(text, &time.unit);
        let window = (f64::NEG_INFINITY, f64::INFINITY);
        Self { text, head, time, chosen, record, order, window, wrong, lengths: Counted::default() }
    }

    fn row(&mut self, cells: csv::StringRecord, last: bool) {
        let at = position(&cells);
        let row = row(cells, self.text);
        if !self.has_its_cells(&row, last) {
            return;
        }
        let time = match number(row.cell(self.time.index)) {
            Ok(time) => self.time.unit.to_si(time),
            Err(wrong) => {
                let problem = self.no_time(&row, wrong);
                self.wrong[self.chosen.len()].add(|| problem);
                return;
            }
        };
        if !self.order.accepts(time, row.whole(self.record.file)) {
            return;
        }
        if !(self.window.0..=self.window.1).contains(&time) {
            return;
        }
        self.record.time.push(time);
        self.record.bytes.push(at);
        for i in 0..self.chosen.len() {
            let value = self.value(i, &row);
            let column = &mut self.record.columns[i];
            column.gaps += usize::from(value.is_nan());
            column.values.push(value);
        }
    }

    /// The value of a column in SI units; NaN for a gap, and in place of what is wrong.
    fn value(&mut self, i: usize, row: &Row) -> f64 {
        let Chosen { index, unit } = &self.chosen[i];
        let cell = row.cell(*index);
        let wrong = match number(cell) {
            Ok(number) => {
                let value = unit.to_si(number);
                if !unit.ty.absolute || value >= 0.0 {
                    return value;
                }
                None
            }
            Err(Wrong::Missing) => return f64::NAN,
            Err(_) if is_gap(cell) => return f64::NAN,
            Err(wrong) => Some(wrong),
        };
        let (head, unit) = (&self.head, unit.text.as_str());
        self.wrong[i].add(|| match wrong {
            None => cold(head, row, (*index, unit)),
            Some(wrong) => no_number(head, row, (*index, wrong)),
        });
        f64::NAN
    }

    /// Whether a row has as many cells as the header. The last one may break off: the logger was switched off.
    fn has_its_cells(&mut self, row: &Row, last: bool) -> bool {
        let (cells, columns) = (row.cells.len(), self.head.columns.len());
        let file = self.record.file;
        if let Some(extra) = (columns..cells).find(|&index| !row.cell(index).is_empty()) {
            self.lengths.add(|| extra_value(&self.head, row, extra));
            return false;
        }
        if cells >= columns {
            return true;
        }
        let message = format!("this row has {cells} of {columns} values");
        if last {
            let warning = Diagnostic::warning("record::broken_off", format!("{message}: it is left out"))
                .at(row.whole(file), "the file breaks off here");
            self.record.warnings.push(warning);
            return false;
        }
        self.lengths.add(|| {
            Diagnostic::error("record::short_row", message)
                .at(row.whole(file), "")
                .also(self.head.place.clone(), "the header")
                .help("what was not measured is an empty cell between commas: `10.2,,45.1`")
        });
        false
    }

    /// A row whose time is no number.
    fn no_time(&self, row: &Row, wrong: Wrong) -> Diagnostic {
        let index = self.time.index;
        let cell = row.cell(index);
        if matches!(wrong, Wrong::Missing) || is_gap(cell) {
            return Diagnostic::error("record::row_without_time", "this row has no time")
                .at(row.place(self.record.file, index), "")
                .help("remove the row: when it was measured cannot be told");
        }
        no_number(&self.head, row, (index, wrong))
    }

    fn finish(mut self) -> Result<Record, Vec<Diagnostic>> {
        let mut problems: Vec<Diagnostic> = Vec::new();
        problems.extend(self.lengths.told("row"));
        problems.extend(self.wrong.into_iter().filter_map(|wrong| wrong.told("cell of this column")));
        let range = self.order.range();
        let (reversed, warning) = self.order.told();
        problems.extend(reversed);
        self.record.warnings.extend(warning);
        if problems.is_empty() && self.record.time.is_empty() {
            if let Some((from, to)) = range {
                problems.push(outside(&self.head, (&from, &to)));
                return Err(problems);
            }
            let problem = Diagnostic::error("record::no_rows", "the record has a header and no rows");
            problems.push(
                problem
                    .at(self.head.place.clone(), "nothing stands below")
                    .help("below the header belong rows of numbers: `0,25.5`"),
            );
        }
        if problems.is_empty() {
            let all_gaps = |column: &&RecordColumn| column.gaps == column.values.len();
            problems.extend(self.record.columns.iter().filter(all_gaps).map(no_values));
        }
        if problems.is_empty() { Ok(self.record) } else { Err(problems) }
    }
}

/// That the window holds no row.
fn outside(head: &Head, (from, to): (&str, &str)) -> Diagnostic {
    let message = format!("no row lies in the window of time: the record goes from {from} to {to}");
    Diagnostic::error("record::window", message)
        .at(head.place.clone(), "")
        .help(format!("times are those of the record: from {from} to {to}"))
}

fn no_values(column: &RecordColumn) -> Diagnostic {
    let message = format!("column `{}` holds no value at all", column.name);
    Diagnostic::error("record::no_values", message)
        .at(column.span.clone(), "only gaps below")
        .help("remove the column, or name those that are to be read")
}

pub(crate) fn is_gap(cell: &str) -> bool {
    let word = cell.trim_start_matches(['+', '-']).trim_start_matches('#');
    (!cell.is_empty() && cell.chars().all(|c| "-–—.".contains(c)))
        || GAPS.iter().any(|gap| gap.eq_ignore_ascii_case(word))
}

pub(crate) fn extra_value(head: &Head, row: &Row, index: usize) -> Diagnostic {
    let columns = head.columns.len();
    let message = format!("this row has {} values, the header names {columns} columns", row.cells.len());
    Diagnostic::error("record::extra_value", message)
        .at(row.place(head.file(), index), "belongs to no column")
        .also(head.place.clone(), "the header")
        .help(extra_help(row))
}

pub(crate) fn no_number(head: &Head, row: &Row, (index, wrong): (usize, Wrong)) -> Diagnostic {
    let (name, cell) = (&head.columns[index].name, row.cell(index));
    let (code, what) = match wrong {
        Wrong::NotFinite => ("record::not_finite", "no finite number"),
        _ => ("record::not_a_number", "no number"),
    };
    let problem = Diagnostic::error(code, format!("column `{name}` holds `{cell}`, which is {what}"))
        .at(row.place(head.file(), index), "");
    let plain = cell.chars().any(|c| c.is_ascii_digit());
    match plain && !matches!(wrong, Wrong::NotFinite) {
        true => problem.help(text_help(name, cell)),
        false => problem.help("leave the cell empty where nothing was measured"),
    }
}

pub(crate) fn cold(head: &Head, row: &Row, (index, unit): (usize, &str)) -> Diagnostic {
    let name = &head.columns[index].name;
    let message = format!("column `{name}` goes below absolute zero: {} {unit}", row.cell(index));
    Diagnostic::error("units::below_absolute_zero", message)
        .at(row.place(head.file(), index), "")
        .help("0 K is -273.15 degC; leave the cell empty where the sensor had no contact")
}
