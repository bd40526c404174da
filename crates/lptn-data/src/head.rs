//! The header of a CSV file and the cells below it: columns by name, numbers with their units,
//! places, and errors.

use lptn_units::{Dimension, Type, Unit, suggest};

use crate::diagnostic::Diagnostic;
use crate::file::{FileId, Span};
use crate::hints::{Codes, other_brackets, text_help};
use crate::words::nearest;

/// The reader of a column.
#[derive(Clone, Debug, Default)]
pub struct Asked {
    /// "`csv` of table `loss`"; empty for a file that is read as a whole.
    pub words: String,
    /// The place where that is written.
    pub span: Option<Span>,
}

impl Asked {
    /// Adds the place that names the file or the column.
    pub fn also(&self, problem: Diagnostic) -> Diagnostic {
        problem.also(self.span.clone(), "read here")
    }

    /// The beginning of a sentence.
    fn subject(&self) -> String {
        if self.words.is_empty() { String::new() } else { format!("{}: ", self.words) }
    }
}

/// The columns of a CSV file.
#[derive(Debug)]
pub(crate) struct Head {
    file: FileId,
    codes: &'static Codes,
    pub(crate) columns: Vec<Header>,
    pub(crate) place: Span,
}

/// A column of numbers of a CSV file.
#[derive(Debug)]
pub struct CsvColumn {
    /// Its position.
    pub index: usize,
    /// Its unit.
    pub unit: Unit,
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
    /// True if the line has no quotes, so that the place of each cell can be counted.
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

/// The byte at which the reader started to look for a record.
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
        // the reader skips a byte order mark at the beginning, and only there
        start = '\u{feff}'.len_utf8();
    }
    // the reader notes where it started to look for a record, not where the record is
    let ends = ['\r', '\n'];
    let mut rest = text.get(start..).unwrap_or_default();
    while rest.starts_with(ends) || rest.starts_with('#') {
        // a comment goes on to the line feed, an empty line to either
        let end = if rest.starts_with('#') { rest.find('\n') } else { Some(0) };
        start += end.map_or(rest.len(), |end| end + 1);
        rest = text.get(start..).unwrap_or_default();
    }
    start..start + rest.find(ends).unwrap_or(rest.len())
}

impl Row {
    pub(crate) fn cell(&self, index: usize) -> &str {
        self.cells.get(index).unwrap_or_default().trim()
    }

    /// The place of a cell, or of its line if the cell has no known place.
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
    /// The header that a record contains.
    pub(crate) fn new(file: FileId, head: &Row, codes: &'static Codes) -> Self {
        let columns = (0..head.cells.len()).map(|i| head.header(file, i)).collect();
        Self { file, codes, columns, place: Span::new(file, head.place.clone()) }
    }

    /// The text with this header.
    pub(crate) fn file(&self) -> FileId {
        self.file
    }

    /// The column of this name, if there is one.
    pub(crate) fn optional(&self, name: &str, ask: &Asked) -> Result<Option<usize>, Diagnostic> {
        let mut found = (0..self.columns.len()).filter(|&i| self.columns[i].name == name);
        match (found.next(), found.next()) {
            (Some(first), Some(second)) => Err(self.two_columns(first, second, ask)),
            (first, _) => Ok(first),
        }
    }

    /// The column of this name.
    pub(crate) fn find(&self, name: &str, ask: &Asked) -> Result<usize, Diagnostic> {
        self.optional(name, ask)?.ok_or_else(|| self.no_column(name, ask))
    }

    /// The column of numbers of this name and type.
    pub(crate) fn numbers(
        &self,
        name: &str,
        ty: Option<Type>,
        ask: &Asked,
    ) -> Result<CsvColumn, Diagnostic> {
        self.column(self.find(name, ask)?, ty, ask)
    }

    /// A column with its unit, of type `wanted` if that is known. In a record `K` alone is an
    /// absolute temperature: a sensor does not measure a difference.
    pub(crate) fn column(
        &self,
        index: usize,
        wanted: Option<Type>,
        ask: &Asked,
    ) -> Result<CsvColumn, Diagnostic> {
        let header = &self.columns[index];
        let at = |problem: Diagnostic| ask.also(problem.at(header.place.clone(), ""));
        if self.codes.of_record && header.unit.is_none() {
            return Err(at(no_unit(header, wanted)));
        }
        let text = header.unit.as_deref().filter(|unit| *unit != "-").unwrap_or("1");
        let unit = Unit::parse(text).map_err(|error| {
            let message = format!("the unit of column `{}`: {error}", header.name);
            at(Diagnostic::error(error.code(), message)).help(error.help())
        })?;
        let kelvin = self.codes.of_record && unit.ty == Type::of(Dimension::TEMPERATURE);
        let ty = if kelvin && wanted.is_none() { Type::ABSOLUTE_TEMPERATURE } else { unit.ty };
        let unit = fit(Unit { ty, ..unit }, wanted)
            .map_err(|types| at(self.other_unit(header, types, ask)))?;
        Ok(CsvColumn { index, unit })
    }

    fn other_unit(
        &self,
        header: &Header,
        (wanted, found): (Type, Type),
        ask: &Asked,
    ) -> Diagnostic {
        let (name, due) = (&header.name, wanted.with_article());
        let (is, help) = match header.unit {
            None => ("has no unit".to_owned(), "give the column its unit in the header"),
            Some(_) => (
                format!("is {}", found.with_article()),
                "name another column, or correct the unit in the header",
            ),
        };
        let message = match ask.words.as_str() {
            "" => format!("column `{name}` {is}, but {due} is needed"),
            words => format!("{words} must be {due}, but column `{name}` {is}"),
        };
        let help = format!("{help}, for example `{name} [{}]`", wanted.usual_unit());
        Diagnostic::error(self.codes.unit, message).help(help)
    }

    /// The error that there is no such column.
    fn no_column(&self, name: &str, ask: &Asked) -> Diagnostic {
        let message = format!("{}there is no column `{name}`", ask.subject());
        let problem = Diagnostic::error(self.codes.no_column, message);
        let problem = match &ask.span {
            Some(span) if ask.words.is_empty() => {
                problem.at(span.clone(), "").also(self.place.clone(), "the columns")
            }
            _ => ask.also(problem.at(self.place.clone(), "the columns")),
        };
        if let Some(header) = self.columns.iter().find(|header| header.written == name) {
            return problem.help(format!("name it without the unit: `{}`", header.name));
        }
        let names = || self.columns.iter().map(|header| header.name.as_str());
        if let Some((bare, unit)) =
            names().filter_map(other_brackets).find(|(bare, _)| *bare == name)
        {
            return problem.help(format!("write its unit in square brackets: `{bare} [{unit}]`"));
        }
        let near = suggest(name, names());
        problem.help(nearest(name, near.into_iter().chain(names()).take(12), "its columns are"))
    }

    pub(crate) fn two_columns(&self, first: usize, second: usize, ask: &Asked) -> Diagnostic {
        let name = &self.columns[first].name;
        let message = format!("{}two columns are named `{name}`", ask.subject());
        let problem = Diagnostic::error(self.codes.two_columns, message)
            .at(self.columns[second].place.clone(), "named again")
            .also(self.columns[first].place.clone(), "first named here");
        ask.also(problem).help(format!("rename one of them, for example `{name}_2`"))
    }

    /// The error of a row with a value after the last column: a decimal comma splits every number
    /// in two.
    pub(crate) fn extra(&self, row: &Row, ask: &Asked) -> Option<Diagnostic> {
        let columns = self.columns.len();
        let index = (columns..row.cells.len()).find(|&i| !row.cell(i).is_empty())?;
        let message =
            format!("this row has {} values, the header names {columns} columns", row.cells.len());
        let problem = Diagnostic::error(self.codes.extra_value, message)
            .at(row.place(self.file, index), "belongs to no column")
            .also(self.place.clone(), "the header");
        Some(ask.also(problem).help(extra_help(row)))
    }

    /// The error of a row with fewer cells than the header; `example` has an empty cell.
    pub(crate) fn short(&self, row: &Row, (ask, example): (&Asked, &str)) -> Diagnostic {
        let (cells, columns) = (row.cells.len(), self.columns.len());
        let message = format!("this row has {cells} of {columns} values");
        let problem = Diagnostic::error(self.codes.short_row, message)
            .at(row.whole(self.file), "")
            .also(self.place.clone(), "the header");
        ask.also(problem)
            .help(format!("a missing value is an empty cell between commas: `{example}`"))
    }

    /// The error of a cell without a number.
    pub(crate) fn no_number(
        &self,
        row: &Row,
        (index, wrong): (usize, Wrong),
        ask: &Asked,
    ) -> Diagnostic {
        let (header, cell, codes) = (&self.columns[index], row.cell(index), self.codes);
        let (name, unit) = (&header.name, header.unit.as_deref().unwrap_or_default());
        let holds = |what: &str| format!("column `{name}` contains `{cell}`, which is {what}");
        let digits = cell.chars().any(|c| c.is_ascii_digit());
        let (code, message) = match wrong {
            Wrong::Missing => {
                (codes.missing_value, format!("column `{name}` has no value in this row"))
            }
            Wrong::NotFinite => (codes.not_finite, holds("not a finite number")),
            Wrong::Text => (codes.not_a_number, holds("not a number")),
            Wrong::Cold => (
                "units::below_absolute_zero",
                format!("column `{name}` goes below absolute zero: {cell} {unit}"),
            ),
        };
        let help = match wrong {
            Wrong::Missing => "fill it in, or leave the row out".to_owned(),
            Wrong::Cold if codes.of_record => {
                "0 K is -273.15 degC; leave the cell empty if the sensor had no contact".to_owned()
            }
            Wrong::Cold => "0 K is -273.15 degC".to_owned(),
            Wrong::Text if digits || !codes.of_record => text_help(name, cell),
            _ if codes.of_record => "leave the cell empty if nothing was measured".to_owned(),
            _ => "leave the row out: an unknown value is not a point of a curve".to_owned(),
        };
        ask.also(Diagnostic::error(code, message).at(row.place(self.file, index), "")).help(help)
    }
}

fn no_unit(header: &Header, wanted: Option<Type>) -> Diagnostic {
    let name = &header.name;
    let problem = Diagnostic::error("record::no_unit", format!("column `{name}` has no unit"));
    if let Some((bare, unit)) = other_brackets(name) {
        return problem.help(format!("write its unit in square brackets: `{bare} [{unit}]`"));
    }
    let unit = wanted.unwrap_or(Type::ABSOLUTE_TEMPERATURE).usual_unit();
    let help = format!("give it in the header: `{name} [{unit}]`");
    problem.help(if wanted.is_some() {
        help
    } else {
        format!("{help}; a plain number is `{name} [-]`")
    })
}

/// The reason why a cell has no number.
#[derive(Clone, Copy)]
pub enum Wrong {
    /// It is empty.
    Missing,
    /// It contains other text.
    Text,
    /// It contains `inf` or `nan`.
    NotFinite,
    /// It contains a temperature below absolute zero.
    Cold,
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

/// The number in a cell of a column with this unit, in SI units.
pub(crate) fn value(cell: &str, unit: &Unit) -> Result<f64, Wrong> {
    let value = unit.to_si(number(cell)?);
    if unit.ty.absolute && value < 0.0 { Err(Wrong::Cold) } else { Ok(value) }
}

/// Help for a row with more values than the header has columns: a decimal comma makes every number
/// two.
fn extra_help(row: &Row) -> &'static str {
    let whole = |i: usize| {
        let cell = row.cell(i).trim_start_matches(['+', '-']);
        !cell.is_empty() && cell.chars().all(|c| c.is_ascii_digit())
    };
    let halves = (1..row.cells.len()).any(|i| whole(i - 1) && whole(i));
    match halves {
        true => "write decimal points, not commas: `25.5`; with a comma every number is two",
        false => "name every column in the header",
    }
}

/// Fits a unit to the type `wanted`: `K` alone is absolute if an absolute temperature is wanted.
///
/// # Errors
/// Both types, the wanted one first.
pub fn fit(unit: Unit, wanted: Option<Type>) -> Result<Unit, (Type, Type)> {
    let Some(wanted) = wanted else { return Ok(unit) };
    let kelvin = wanted.absolute && unit.ty == Type::of(Dimension::TEMPERATURE);
    if kelvin || unit.ty.conforms_to(wanted) {
        Ok(Unit { ty: wanted, ..unit })
    } else {
        Err((wanted, unit.ty))
    }
}
