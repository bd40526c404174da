//! The header of a CSV file and the cells below it: columns by name, numbers with their units, places, and what is
//! wrong with them.

use lptn_units::{Type, Unit, suggest};

use crate::csv_form::{extra_help, other_brackets, text_help};
use crate::diagnostic::Diagnostic;
use crate::file::{FileId, Span};
use crate::points::fit;
use crate::value::Place;

/// The columns of a CSV file.
#[derive(Debug)]
pub(crate) struct Head {
    file: FileId,
    pub(crate) columns: Vec<Header>,
    pub(crate) place: Span,
}

/// The name of a column, `name [unit]`.
#[derive(Debug)]
pub(crate) struct Header {
    pub(crate) written: String,
    pub(crate) name: String,
    pub(crate) unit: Option<String>,
    pub(crate) place: Span,
}

/// A line of cells.
#[derive(Debug)]
pub(crate) struct Row {
    pub(crate) cells: csv::StringRecord,
    /// The bytes of the line.
    place: std::ops::Range<usize>,
    /// Whether the line holds no quotes, so that the place of each cell can be counted.
    plain: bool,
}

/// Reads records; lines that are empty or begin with `#` are left out.
pub(crate) fn reader(text: &str) -> csv::Reader<&[u8]> {
    csv::ReaderBuilder::new()
        .has_headers(false)
        .flexible(true)
        .comment(Some(b'#'))
        .from_reader(text.as_bytes())
}

/// The byte at which the reader began to look for a record.
pub(crate) fn position(cells: &csv::StringRecord) -> usize {
    cells.position().map_or(0, |position| usize::try_from(position.byte()).unwrap_or(0))
}

/// A record of `text`, with its place.
pub(crate) fn row(cells: csv::StringRecord, text: &str) -> Row {
    let place = line(text, position(&cells));
    let plain = !text.get(place.clone()).unwrap_or_default().contains('"');
    Row { cells, place, plain }
}

/// The line of the record that the reader looked for from this byte on.
pub(crate) fn line(text: &str, from: usize) -> std::ops::Range<usize> {
    let mut start = from.min(text.len());
    if start == 0 && text.starts_with('\u{feff}') {
        start = '\u{feff}'.len_utf8(); // the reader leaves out a mark at the beginning, and only there
    }
    // the reader notes where it looked for a record, not where it found one
    let ends = ['\r', '\n'];
    let mut rest = text.get(start..).unwrap_or_default();
    while rest.starts_with(ends) || rest.starts_with('#') {
        start += rest.find(ends).map_or(rest.len(), |end| end + 1);
        rest = text.get(start..).unwrap_or_default();
    }
    start..start + rest.find(ends).unwrap_or(rest.len())
}

impl Row {
    pub(crate) fn cell(&self, index: usize) -> &str {
        self.cells.get(index).unwrap_or_default().trim()
    }

    /// The place of a cell, or of the line where it cannot be told.
    pub(crate) fn place(&self, file: FileId, index: usize) -> Span {
        let cell = self.cells.get(index).filter(|cell| self.plain && !cell.trim().is_empty());
        let Some(cell) = cell else { return Span::new(file, self.place.clone()) };
        let before: usize = self.cells.iter().take(index).map(|cell| cell.len() + 1).sum();
        let start = self.place.start + before + (cell.len() - cell.trim_start().len());
        Span::new(file, start..start + cell.trim().len())
    }

    /// The place of the line.
    pub(crate) fn whole(&self, file: FileId) -> Span {
        Span::new(file, self.place.clone())
    }

    fn header(&self, file: FileId, index: usize) -> Header {
        let written = self.cell(index).to_owned();
        let split = written.strip_suffix(']').and_then(|text| text.rsplit_once('['));
        let (name, unit) = match split {
            Some((name, unit)) => (name.trim().to_owned(), Some(unit.trim().to_owned())),
            None => (written.clone(), None),
        };
        Header { written, name, unit, place: self.place(file, index) }
    }
}

impl Head {
    /// The header that a record is.
    pub(crate) fn new(file: FileId, head: &Row) -> Self {
        let columns = (0..head.cells.len()).map(|i| head.header(file, i)).collect();
        Self { file, columns, place: Span::new(file, head.place.clone()) }
    }

    /// The text that it is the header of.
    pub(crate) fn file(&self) -> FileId {
        self.file
    }

    /// The column of this name, if there is one.
    pub(crate) fn optional(&self, name: &str, ask: Place<'_>) -> Result<Option<usize>, Diagnostic> {
        let mut found = (0..self.columns.len()).filter(|&i| self.columns[i].name == name);
        match (found.next(), found.next()) {
            (Some(first), Some(second)) => Err(self.two_columns(name, (first, second), ask)),
            (first, _) => Ok(first),
        }
    }

    /// The column of this name.
    pub(crate) fn find(&self, name: &str, ask: Place<'_>) -> Result<usize, Diagnostic> {
        self.optional(name, ask)?.ok_or_else(|| self.no_column(name, ask))
    }

    /// Why a row has a value behind the last column: with a decimal comma every number falls into two.
    pub(crate) fn extra(&self, row: &Row, asked: &Span) -> Option<Diagnostic> {
        let columns = self.columns.len();
        let index = (columns..row.cells.len()).find(|&i| !row.cell(i).is_empty())?;
        let message = format!("this row has {} values, the header names {columns} columns", row.cells.len());
        let problem = Diagnostic::error("netlist::csv_extra_value", message)
            .at(row.place(self.file, index), "belongs to no column")
            .also(self.place.clone(), "the header")
            .also(asked.clone(), "read here")
            .help(extra_help(row));
        Some(problem)
    }

    /// The unit of a column, which is of type `wanted` where that is known.
    pub(crate) fn unit(
        &self,
        index: usize,
        wanted: Option<Type>,
        ask: Place<'_>,
    ) -> Result<Unit, Diagnostic> {
        let header = &self.columns[index];
        let text = header.unit.as_deref().filter(|unit| *unit != "-").unwrap_or("1");
        let at = |problem: Diagnostic| {
            problem.at(header.place.clone(), "").also(ask.raw.span.clone(), "read here")
        };
        let unit = Unit::parse(text).map_err(|error| {
            let message = format!("the unit of column `{}`: {error}", header.name);
            let problem = at(Diagnostic::error(error.code(), message));
            match error.help() {
                Some(help) => problem.help(help),
                None => problem,
            }
        })?;
        fit(unit, wanted).map_err(|(wanted, found)| {
            let (is, help) = match header.unit {
                None => ("has no unit".to_owned(), "give the column its unit in the header"),
                Some(_) => (
                    format!("is {}", found.with_article()),
                    "name another column, or correct the unit in the header",
                ),
            };
            let message = format!(
                "{} must be {}, but column `{}` {is}",
                ask.words(),
                wanted.with_article(),
                header.name
            );
            let example = format!("`{} [{}]`", header.name, wanted.usual_unit());
            at(Diagnostic::error("netlist::csv_unit", message)).help(format!("{help}, for example {example}"))
        })
    }

    /// That there is no such column.
    pub(crate) fn no_column(&self, name: &str, ask: Place<'_>) -> Diagnostic {
        let message = format!("{}: there is no column `{name}`", ask.words());
        let problem = Diagnostic::error("netlist::csv_column", message)
            .at(self.place.clone(), "the columns")
            .also(ask.raw.span.clone(), "read here");
        let names = || self.columns.iter().map(|header| header.name.as_str());
        let other_form = names().find_map(|other| other_brackets(other).filter(|(bare, _)| *bare == name));
        match (other_form, suggest(name, names())) {
            (Some((_, unit)), _) => {
                problem.help(format!("write its unit in square brackets: `{name} [{unit}]`"))
            }
            (None, Some(near)) => problem.help(format!("did you mean `{near}`?")),
            (None, None) => {
                let names: Vec<&str> = names().take(12).collect();
                problem.help(format!("its columns are {}", crate::vocabulary::list(&names)))
            }
        }
    }

    fn two_columns(&self, name: &str, (first, second): (usize, usize), ask: Place<'_>) -> Diagnostic {
        Diagnostic::error(
            "netlist::csv_two_columns",
            format!("{}: two columns are named `{name}`", ask.words()),
        )
        .at(self.columns[second].place.clone(), "named again")
        .also(self.columns[first].place.clone(), "first named here")
        .also(ask.raw.span.clone(), "read here")
        .help(format!("rename one of them, for example `{name}_2`"))
    }

    /// A cell that holds no number.
    pub(crate) fn no_number(&self, row: &Row, index: usize, (wrong, ask): (Wrong, Place<'_>)) -> Diagnostic {
        let (name, cell) = (&self.columns[index].name, row.cell(index));
        let (code, message, help) = match wrong {
            Wrong::Missing => (
                "netlist::csv_missing_value",
                format!("column `{name}` has no value in this row"),
                "fill it in, or leave the row out".to_owned(),
            ),
            Wrong::NotFinite => (
                "netlist::csv_not_finite",
                format!("column `{name}` holds `{cell}`, which is no finite number"),
                "leave the row out: what is not known is no point of a curve".to_owned(),
            ),
            Wrong::Text => (
                "netlist::csv_not_a_number",
                format!("column `{name}` holds `{cell}`, which is no number"),
                text_help(name, cell),
            ),
        };
        Diagnostic::error(code, message)
            .at(row.place(self.file, index), "")
            .also(ask.raw.span.clone(), "read here")
            .help(help)
    }

    /// A temperature below absolute zero.
    pub(crate) fn cold(&self, row: &Row, index: usize, ask: Place<'_>) -> Diagnostic {
        let message = format!("column `{}` goes below absolute zero", self.columns[index].name);
        Diagnostic::error("units::below_absolute_zero", message)
            .at(row.place(self.file, index), "")
            .also(ask.raw.span.clone(), "read here")
            .help("0 K is -273.15 degC")
    }
}

/// Why a cell holds no number.
#[derive(Clone, Copy)]
pub(crate) enum Wrong {
    Missing,
    Text,
    NotFinite,
}

/// The number in a cell.
pub(crate) fn number(cell: &str) -> Result<f64, Wrong> {
    match cell.parse::<f64>() {
        _ if cell.is_empty() => Err(Wrong::Missing),
        Ok(number) if number.is_finite() => Ok(number + 0.0), // -0 is 0
        Ok(_) => Err(Wrong::NotFinite),
        Err(_) => Err(Wrong::Text),
    }
}
