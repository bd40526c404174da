//! Points of curves: numbers with their places, from a list or a column of a CSV file.

use std::sync::Arc;

use lptn_units::{Type, Unit, format_short};

use crate::clock::{Clock, TIME};
use crate::diagnostic::Diagnostic;
use crate::file::Span;
use crate::head::{Asked, CsvColumn, Head, Row, row};
use crate::hints;
use crate::limits::MOST_PROBLEMS;
use crate::open::open;
use crate::options::CsvOptions;
use crate::record::outliers::{outliers, told};
use crate::text::CsvText;

/// An example of a header.
const EXAMPLE: &str = "t [s],speed [rpm]";

/// Numbers in SI units, with the place of each.
#[derive(Clone, Debug)]
pub struct PlacedNumbers {
    /// The numbers.
    pub numbers: Vec<f64>,
    /// Their type.
    pub ty: Type,
    /// The place of each number.
    pub places: Places,
    /// The list, or the header of the column.
    pub whole: Span,
    /// The unit in which they are given; if there are several, that of the first.
    pub unit: Option<Unit>,
}

/// The places of the numbers of a curve.
#[derive(Clone, Debug)]
pub enum Places {
    /// Each item of a list.
    Items(Vec<Span>),
    /// The rows of a file, one for each number, and the position of the column. A file may have
    /// millions of rows, and only the places of errors are needed.
    Column(Arc<CsvFile>, usize),
}

impl PlacedNumbers {
    /// The place of a number.
    pub fn place(&self, index: usize) -> Span {
        let place = match &self.places {
            Places::Items(places) => places.get(index).cloned(),
            Places::Column(file, column) => file.place(index, *column),
        };
        place.unwrap_or_else(|| self.whole.clone())
    }

    fn outliers(&self) -> Vec<usize> {
        outliers(&self.numbers, self.ty.absolute)
    }

    /// The first number that is far outside of those around it, as in a record, with the text on
    /// it.
    pub fn outlying(&self) -> Option<(usize, String)> {
        let (unit, outliers) = (self.unit.as_ref()?, self.outliers());
        let shown =
            |i: usize| format!("{} {}", format_short(unit.from_si(self.numbers[i])), unit.text);
        Some((*outliers.first()?, told((&outliers, self.numbers.len()), "", shown)?))
    }
}

/// A CSV file: a header, and rows of cells. Only the text is stored, and each column reads it
/// again: stored cells would take twenty times the memory of the file.
#[derive(Debug)]
pub struct CsvFile {
    head: Head,
    text: CsvText,
    options: CsvOptions,
}

/// Number of wrong cells at which reading stops; of millions the rest would be alike.
const MOST_WRONG: usize = 20 * MOST_PROBLEMS;

impl CsvFile {
    /// The file, if its header is valid and no row is longer.
    ///
    /// # Errors
    /// The error of its form; `asked` is the place that names the file.
    pub fn open(text: &CsvText, asked: &Span, options: &CsvOptions) -> Result<Self, Diagnostic> {
        let head = open(text, options, (hints::NETLIST, EXAMPLE));
        let head = head.map_err(|problem| problem.also(asked.clone(), "read here"))?;
        let file = Self { head, text: text.clone(), options: options.clone() };
        match file.too_long(&Asked { words: String::new(), span: Some(asked.clone()) }) {
            Some(problem) => Err(problem),
            None => Ok(file),
        }
    }

    /// Visits the cells of the rows in order, until the visitor returns a result.
    fn visit<T>(&self, mut visit: impl FnMut(&csv::StringRecord) -> Option<T>) -> Option<T> {
        let (mut reader, mut cells) = (self.head.reader(&self.text.text), csv::StringRecord::new());
        while reader.read(&mut cells) {
            if let Some(found) = visit(&cells) {
                return Some(found);
            }
        }
        None
    }

    /// The record as a row with its place.
    fn row(&self, cells: &csv::StringRecord) -> Row {
        row(cells.clone(), &self.text.text)
    }

    /// The place of a cell, or of its line; rows are counted from 0.
    pub fn place(&self, index: usize, column: usize) -> Option<Span> {
        let mut left = index;
        self.visit(|cells| match left.checked_sub(1) {
            None => Some(self.row(cells).place(self.head.file(), column)),
            Some(fewer) => {
                left = fewer;
                None
            }
        })
    }

    /// The error of the first row with a value after the last column.
    fn too_long(&self, asked: &Asked) -> Option<Diagnostic> {
        let columns = self.head.columns.len();
        self.visit(|cells| {
            let longer = cells.len() > columns;
            longer.then(|| self.head.extra(&self.row(cells), asked)).flatten()
        })
    }

    /// The numbers of the column `name`, in SI units, and of type `wanted` if that is known.
    ///
    /// # Errors
    /// If there is no such column or its unit is another; or one for every cell without a number.
    pub fn column(
        self: &Arc<Self>,
        name: &str,
        wanted: Option<Type>,
        ask: &Asked,
    ) -> Result<PlacedNumbers, Vec<Diagnostic>> {
        let mut found = self.columns(&[(name, wanted, ask)]);
        found.pop().unwrap_or_else(|| Err(Vec::new()))
    }

    /// Several columns, in one pass over the file.
    pub fn columns<'a>(
        self: &Arc<Self>,
        asked: &[(&str, Option<Type>, &'a Asked)],
    ) -> Vec<Result<PlacedNumbers, Vec<Diagnostic>>> {
        let reading = |(name, wanted, ask): &(&str, Option<Type>, &'a Asked)| {
            let column = self.head.numbers(name, *wanted, ask).map_err(|problem| vec![problem]);
            Reading { column, clock: None, ask, numbers: Vec::new(), problems: Vec::new() }
        };
        self.read(asked.iter().map(reading).collect())
    }

    /// The times of the column `name` in s: numbers with a unit, or dates and clock times.
    ///
    /// # Errors
    /// As those of a column of numbers; and if the dates can be read in two ways, or `start` does
    /// not suit them.
    pub fn times(
        self: &Arc<Self>,
        name: &str,
        ask: &Asked,
    ) -> Result<PlacedNumbers, Vec<Diagnostic>> {
        let (column, clock) = self.time_column(name, ask).map_err(|problem| vec![problem])?;
        let (numbers, problems) = (Vec::new(), Vec::new());
        let mut found =
            self.read(vec![Reading { column: Ok(column), clock, ask, numbers, problems }]);
        found.pop().unwrap_or_else(|| Err(Vec::new()))
    }

    fn read(
        self: &Arc<Self>,
        mut columns: Vec<Reading<'_>>,
    ) -> Vec<Result<PlacedNumbers, Vec<Diagnostic>>> {
        self.visit(|cells| {
            columns.iter_mut().for_each(|reading| reading.take(self, cells));
            let wrong: usize = columns.iter().map(|reading| reading.problems.len()).sum();
            (wrong >= MOST_WRONG).then_some(())
        });
        columns.into_iter().map(|reading| reading.done(self)).collect()
    }

    /// The column of times of this name, and its clock if it contains dates or clock times.
    fn time_column(
        &self,
        name: &str,
        ask: &Asked,
    ) -> Result<(CsvColumn, Option<Clock>), Diagnostic> {
        let head = &self.head;
        let first = head.reader(&self.text.text).next().unwrap_or_default();
        let index = head.find(name, ask)?;
        let clock = Clock::of((head, &self.text), (index, &first), &self.options);
        if let Some(clock) = clock.map_err(|problem| ask.also(problem))? {
            return Ok((clock.column(), Some(clock)));
        }
        match Clock::unused(head, index, &self.options) {
            Some(problem) => Err(ask.also(problem)),
            None => Ok((head.numbers(name, Some(TIME), ask)?, None)),
        }
    }

    /// The note about a file that is not in lptn's own form; `time` is the column of its times. A
    /// warning if a number has two readings, or a clock is set forward.
    pub fn note(&self, time: Option<&str>) -> Option<Diagnostic> {
        let ask = Asked::default();
        let column = time.map(|name| self.time_column(name, &ask));
        let mut clock = column.and_then(Result::ok).and_then(|(_, clock)| clock);
        let zero = clock.as_ref().map(|clock| {
            let first = self.head.reader(&self.text.text).next().unwrap_or_default();
            format!("0 s at {}", clock.zero_words(&first, &self.options))
        });
        let note = self.head.note(&self.text, zero.into_iter().collect());
        match clock.as_mut().and_then(|clock| self.change(clock)) {
            Some(change) => Some(note.into_iter().fold(change, |all, note| all.note(note.message))),
            None => note,
        }
    }

    /// The warning about a clock that is set forward.
    fn change(&self, clock: &mut Clock) -> Option<Diagnostic> {
        self.visit(|cells| {
            clock.time(|index| cells.get(index).unwrap_or_default().trim()).ok()?;
            clock.change(&self.head, || self.row(cells).whole(self.head.file()))
        })
    }

    /// The names of its columns, each with its place.
    pub fn names(&self) -> impl Iterator<Item = (&str, &Span)> {
        self.head.columns.iter().map(|column| (column.name.as_str(), &column.place))
    }

    /// The words of a column of names, all present and different.
    ///
    /// # Errors
    /// If there is no such column or no row; or one for every cell that is empty or a repetition.
    pub fn words(&self, name: &str, ask: &Asked) -> Result<Vec<String>, Vec<Diagnostic>> {
        let index = self.head.find(name, ask).map_err(|problem| vec![problem])?;
        let (mut words, mut problems): (Vec<String>, Vec<Diagnostic>) = (Vec::new(), Vec::new());
        self.visit(|cells| {
            let row = self.row(cells);
            let word = row.cell(index).to_owned();
            let place = || row.place(self.head.file(), index);
            if word.is_empty() {
                let message = format!("column `{name}` has no name in this row");
                let problem = Diagnostic::error("netlist::csv_missing_value", message);
                problems.push(problem.at(place(), "").help("fill it in, or leave the row out"));
            } else if words.contains(&word) {
                let message = format!("column `{name}` has `{word}` twice");
                let problem = Diagnostic::error("netlist::csv_twice", message).at(place(), "again");
                problems.push(problem.help("give each row its own name"));
            }
            words.push(word);
            (problems.len() >= MOST_WRONG).then_some(())
        });
        if words.is_empty() {
            let problem =
                Diagnostic::error("netlist::csv_no_rows", "the file has a header and no rows");
            let problem = problem.at(self.head.place.clone(), "nothing below it");
            problems.push(problem.help("write one part a row below the header"));
        }
        let problems: Vec<_> = problems.into_iter().map(|problem| ask.also(problem)).collect();
        if problems.is_empty() { Ok(words) } else { Err(problems) }
    }

    /// The place of the header.
    pub fn header(&self) -> &Span {
        &self.head.place
    }
}

/// A column while it is read.
struct Reading<'a> {
    column: Result<CsvColumn, Vec<Diagnostic>>,
    clock: Option<Clock>,
    ask: &'a Asked,
    numbers: Vec<f64>,
    problems: Vec<Diagnostic>,
}

impl Reading<'_> {
    /// Adds its cell of a row.
    fn take(&mut self, file: &CsvFile, cells: &csv::StringRecord) {
        let Ok(CsvColumn { index, unit }) = &self.column else { return };
        let value = match &mut self.clock {
            Some(clock) => clock.time(|index| cells.get(index).unwrap_or_default().trim()),
            None => file.head.value(cells.get(*index).unwrap_or_default().trim(), unit),
        };
        match value {
            Ok(number) => self.numbers.push(number),
            Err(wrong) => {
                self.problems.push(file.head.no_number(
                    &file.row(cells),
                    (*index, wrong),
                    self.ask,
                ));
            }
        }
    }

    fn done(self, file: &Arc<CsvFile>) -> Result<PlacedNumbers, Vec<Diagnostic>> {
        let CsvColumn { index, unit } = self.column?;
        if !self.problems.is_empty() {
            return Err(self.problems);
        }
        let places = Places::Column(Arc::clone(file), index);
        let whole = file.head.columns[index].place.clone();
        Ok(PlacedNumbers { numbers: self.numbers, ty: unit.ty, places, whole, unit: Some(unit) })
    }
}

#[cfg(test)]
mod tests {
    use super::{CsvFile, CsvOptions, CsvText, Span};
    use crate::file::Files;

    #[test]
    fn cells_are_found_where_they_stand() {
        let text = "\u{feff}# cycle\r\n\r\nt [s], speed [rpm]\r\n\r\n0, 10\r\n# more\r\n 1 \
            ,20\r\n\"2\",30\n3,40";
        let mut files = Files::new();
        let text = CsvText::of(&mut files, "a.csv".to_owned(), text.as_bytes()).unwrap();
        let file =
            CsvFile::open(&text, &Span::new(text.file, 0..0), &CsvOptions::default()).unwrap();
        assert_eq!(files.line_column(&file.head.place), (3, 1));
        assert_eq!(files.at(&file.head.columns[1].place), "speed [rpm]");
        let places: Vec<_> = (0..).map_while(|row| file.place(row, 1)).collect();
        let rows: Vec<(usize, &str)> =
            places.iter().map(|place| (files.line_column(place).0, files.at(place))).collect();
        let expected = [(5, "10"), (7, "20"), (8, "\"2\",30"), (9, "40")];
        assert_eq!(rows, expected);
    }

    #[test]
    fn a_comment_goes_on_to_the_line_feed() {
        let mut files = Files::new();
        let text = "# made by\rsome, logger\nt [s],speed [rpm]\n0,10";
        let text = CsvText::of(&mut files, "a.csv".to_owned(), text.as_bytes()).unwrap();
        let file =
            CsvFile::open(&text, &Span::new(text.file, 0..0), &CsvOptions::default()).unwrap();
        assert_eq!(files.at(&file.head.columns[1].place), "speed [rpm]");
        assert_eq!(file.place(0, 1).map(|place| files.at(&place).to_owned()), Some("10".into()));
    }
}
