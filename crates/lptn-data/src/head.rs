//! The header of a CSV file and the cells below it: columns by name, numbers with their units,
//! places, and errors.

use lptn_units::{Dimension, Type, Unit};

use crate::ambiguous::Ambiguous;
use crate::diagnostic::{Diagnostic, Severity};
use crate::dialect::{Dialect, Maker, bracketless};
use crate::file::{FileId, Span};
use crate::gap::{OVERLOAD, is_overload};
use crate::hints::Codes;
use crate::numeral::{Decimal, foreign};
use crate::reader::{Reader, line, position};
use crate::spelling;
use crate::text::CsvText;

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
    pub(crate) fn subject(&self) -> String {
        if self.words.is_empty() { String::new() } else { format!("{}: ", self.words) }
    }
}

/// The columns of a CSV file.
#[derive(Debug)]
pub(crate) struct Head {
    pub(crate) file: FileId,
    pub(crate) codes: &'static Codes,
    pub(crate) columns: Vec<Header>,
    pub(crate) place: Span,
    pub(crate) dialect: Dialect,
    /// A number that only the decimal sign of other columns decides.
    pub(crate) doubtful: Option<Ambiguous>,
}

/// Ends of the names of columns of PicoLog 6.
const PICOLOG: [&str; 4] = [" Last", " Ave.", " Min.", " Max."];

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
    /// True if the unit is in a separate line.
    pub(crate) below: bool,
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

/// A record of `text`, with its place.
pub(crate) fn row(cells: csv::StringRecord, text: &str) -> Row {
    let place = line(text, position(&cells));
    let plain = !text.get(place.clone()).unwrap_or_default().contains('"');
    Row { cells, place, plain }
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
        Header { written, name, unit, place: self.place(file, index), below: false }
    }
}

impl Head {
    /// The header that a record contains.
    pub(crate) fn new(file: FileId, head: &Row, codes: &'static Codes) -> Self {
        let columns = (0..head.cells.len()).map(|i| head.header(file, i)).collect();
        let place = Span::new(file, head.place.clone());
        Self { file, codes, columns, place, dialect: Dialect::PLAIN, doubtful: None }
    }

    /// Gives columns without a unit those of a line of units.
    pub(crate) fn take_units(&mut self, units: &csv::StringRecord) {
        for (header, cell) in self.columns.iter_mut().zip(units) {
            let unit = bracketless(cell.trim());
            if header.unit.is_none() && !unit.is_empty() {
                (header.unit, header.below) = (Some(unit.to_owned()), true);
            }
        }
    }

    /// Gives the columns of this name the unit of a line of units, seconds.
    pub(crate) fn in_seconds(&mut self, name: &str) {
        for header in self.columns.iter_mut().filter(|header| header.name == name) {
            (header.unit, header.below) = (Some("s".to_owned()), true);
        }
    }

    /// Takes the units of PicoLog, in whose names `C` is never coulomb: `ring Ave. (C)`. Its first
    /// column, of the times, has no name.
    pub(crate) fn picolog(&mut self) {
        if self.columns.first().is_none_or(|first| !first.written.is_empty()) {
            return;
        }
        for header in self.columns.iter_mut().filter(|header| header.unit.is_none()) {
            let name = header.written.strip_suffix("(C)").map(str::trim_end);
            if let Some(name) = name.filter(|name| PICOLOG.iter().any(|end| name.ends_with(end))) {
                (header.name, header.unit) = (name.to_owned(), Some("degC".to_owned()));
                self.dialect.maker = Some(Maker::PicoLog);
            }
        }
    }

    /// The fewest cells of a whole row.
    pub(crate) fn least(&self) -> usize {
        let remark = self.columns.last().zip(self.dialect.remark);
        self.columns.len() - usize::from(remark.is_some_and(|(last, name)| last.name == name))
    }

    /// Takes the units of `ring (°C)` and `ring/°C` from the names without another unit.
    pub(crate) fn split_units(&mut self) {
        for header in self.columns.iter_mut().filter(|header| header.unit.is_none()) {
            if let Some((name, unit)) = spelling::apart(&header.written) {
                (header.name, header.unit) = (name.to_owned(), Some(unit.to_owned()));
            }
        }
    }

    /// The reader, before the first row.
    pub(crate) fn reader<'t>(&self, text: &'t str) -> Reader<'t> {
        Reader::rows(text, &self.dialect)
    }

    /// The number in a cell of a column, in SI units.
    pub(crate) fn value(&self, cell: &str, unit: &Unit) -> Result<f64, Wrong> {
        value(cell, unit, self.dialect.decimal)
    }

    /// The codes of its problems.
    pub(crate) fn codes(&self) -> &'static Codes {
        self.codes
    }

    /// The note about a file that is not in lptn's own form; `more` says more of it. A warning if
    /// a number of it has two readings.
    pub(crate) fn note(&self, text: &CsvText, more: Vec<String>) -> Option<Diagnostic> {
        let mut words = self.dialect.told(text);
        words.extend(more);
        let message = format!("{} is read with {}", text.name, words.join(", "));
        if let Some(doubtful) = &self.doubtful {
            return Some(doubtful.doubt(self.codes).note(message));
        }
        let note = Diagnostic {
            severity: Severity::Note,
            ..Diagnostic::error(self.codes.read_as, message)
        };
        (!words.is_empty()).then(|| note.at(self.place.clone(), "the header"))
    }

    /// The text with this header.
    pub(crate) fn file(&self) -> FileId {
        self.file
    }

    /// The column of this name, if there is one.
    pub(crate) fn optional(&self, name: &str, ask: &Asked) -> Result<Option<usize>, Diagnostic> {
        Ok(self.named(name, ask)?.map(|(index, _)| index))
    }

    /// The column of this name and its unit. The name of `ring (degC)` is the whole header or, if
    /// no header is so named, `ring`.
    fn named(&self, name: &str, ask: &Asked) -> Result<Option<(usize, Option<&str>)>, Diagnostic> {
        let whole = |i: &usize| self.columns[*i].name == name;
        let mut found = (0..self.columns.len()).filter(whole);
        match (found.next(), found.next()) {
            (Some(first), Some(second)) => return Err(self.two_columns(first, second, ask)),
            (Some(first), _) => return Ok(Some((first, self.columns[first].unit.as_deref()))),
            _ => {}
        }
        let apart = |i: usize| {
            let header = &self.columns[i];
            let split = spelling::apart(&header.written).filter(|_| header.unit.is_none());
            split.filter(|(bare, _)| *bare == name).map(|(_, unit)| (i, Some(unit)))
        };
        let mut found = (0..self.columns.len()).filter_map(apart);
        match (found.next(), found.next()) {
            (Some(first), Some(second)) => Err(self.two_columns(first.0, second.0, ask)),
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
        let found = self.named(name, ask)?;
        let (index, unit) = found.ok_or_else(|| self.no_column(name, ask))?;
        self.column_in((index, unit), ty, ask)
    }

    /// A column with its unit, of type `wanted` if that is known. In a record `K` alone is an
    /// absolute temperature: a sensor does not measure a difference.
    pub(crate) fn column(
        &self,
        index: usize,
        wanted: Option<Type>,
        ask: &Asked,
    ) -> Result<CsvColumn, Diagnostic> {
        self.column_in((index, self.columns[index].unit.as_deref()), wanted, ask)
    }

    fn column_in(
        &self,
        (index, unit): (usize, Option<&str>),
        wanted: Option<Type>,
        ask: &Asked,
    ) -> Result<CsvColumn, Diagnostic> {
        let header = &self.columns[index];
        let at = |problem: Diagnostic| ask.also(problem.at(header.place.clone(), ""));
        if self.codes.of_record && unit.is_none() {
            return Err(at(self.no_unit(header, wanted)));
        }
        let text = unit.filter(|unit| *unit != "-").unwrap_or("1");
        if text == "C" && wanted.map_or(self.codes.of_record, |wanted| wanted.absolute) {
            return Err(at(self.coulomb(header)));
        }
        let unit = spelling::unit(text).map_err(|error| {
            let message = format!("the unit of column `{}`: {error}", header.name);
            at(Diagnostic::error(error.code(), message)).help(error.help())
        })?;
        let kelvin = self.codes.of_record && unit.ty == Type::of(Dimension::TEMPERATURE);
        let ty = if kelvin && wanted.is_none() { Type::ABSOLUTE_TEMPERATURE } else { unit.ty };
        let unit = fit(Unit { ty, ..unit }, wanted)
            .map_err(|types| at(self.other_unit(header, types, ask)))?;
        Ok(CsvColumn { index, unit })
    }
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
    /// It contains no date or clock time in the form of the column.
    Moment,
}

/// A key of TOML, in quotes if it needs them.
pub(crate) fn quoted(name: &str) -> String {
    let bare = |c: char| c.is_ascii_alphanumeric() || "_-".contains(c);
    if !name.is_empty() && name.chars().all(bare) { name.to_owned() } else { format!("{name:?}") }
}

/// The number in a cell.
#[inline]
pub(crate) fn number(cell: &str, decimal: Decimal) -> Result<f64, Wrong> {
    match cell.parse::<f64>() {
        _ if cell.is_empty() => Err(Wrong::Missing),
        // in a file with decimal commas `1.234` is 1234, and `20.7` is not a number
        Ok(_) if decimal == Decimal::Comma && cell.contains('.') => {
            foreign(cell, decimal).ok_or(Wrong::Text)
        }
        Ok(number) if number.abs() < OVERLOAD => Ok(number + 0.0), // -0 is 0
        Ok(number) if number.is_finite() && !is_overload(number) => Ok(number),
        Ok(_) => Err(Wrong::NotFinite),
        Err(_) => foreign(cell, decimal).ok_or(Wrong::Text),
    }
}

/// The number in a cell of a column with this unit, in SI units.
#[inline]
pub(crate) fn value(cell: &str, unit: &Unit, decimal: Decimal) -> Result<f64, Wrong> {
    let value = unit.to_si(number(cell, decimal)?);
    if unit.ty.absolute && value < 0.0 { Err(Wrong::Cold) } else { Ok(value) }
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
