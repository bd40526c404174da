//! A CSV file that is read row by row and not stored: files with millions of rows.

use lptn_units::Type;

use crate::diagnostic::Diagnostic;
use crate::file::Span;
use crate::head::{Asked, CsvColumn, Head, Row, Wrong, row};
use crate::hints;
use crate::open::open;
use crate::options::CsvOptions;
use crate::reader::{Reader, position};
use crate::text::CsvText;
use crate::words::nearest;

/// Distance of the rows whose places are kept; the others are counted from these.
const STRIDE: usize = 256;

/// A CSV file, at one of its rows.
pub struct CsvRows<'s> {
    /// The columns.
    head: Head,
    /// The reader that names the file.
    pub asked: Asked,
    /// True if the row has as many cells as the header, so that each is in its column.
    pub sound: bool,
    /// Number of problems found in its cells.
    pub problems: usize,
    text: &'s CsvText,
    reader: Reader<'s>,
    record: csv::StringRecord,
    rows: usize,
    marks: Vec<usize>,
    skipped: Vec<usize>,
}

impl<'s> CsvRows<'s> {
    /// A file, before its first row; `example` is an example of a header.
    ///
    /// # Errors
    /// The error of its form.
    pub fn open(
        text: &'s CsvText,
        (asked, options): (Asked, &CsvOptions),
        example: &str,
    ) -> Result<Self, Diagnostic> {
        let head = open(text, options, (hints::NETLIST, example));
        let mut head = head.map_err(|problem| asked.also(problem))?;
        head.split_units();
        let (reader, record) = (head.reader(&text.text), csv::StringRecord::new());
        let (marks, skipped) = (Vec::new(), Vec::new());
        Ok(Self {
            head,
            asked,
            sound: true,
            problems: 0,
            text,
            reader,
            record,
            rows: 0,
            marks,
            skipped,
        })
    }

    /// Goes to the next row; false at the end.
    pub fn step(&mut self) -> bool {
        if !self.reader.read(&mut self.record) {
            return false;
        }
        if self.rows.is_multiple_of(STRIDE) {
            self.marks.push(position(&self.record));
        }
        self.rows += 1;
        let (cells, columns) = (self.record.len(), self.head.columns.len());
        self.sound = cells >= columns && (columns..cells).all(|index| self.cell(index).is_empty());
        true
    }

    /// Skips the row: it does not become an element.
    pub fn skip(&mut self) {
        self.skipped.push(self.rows - 1 - self.skipped.len());
    }

    /// The text of a cell without blanks around it.
    pub fn cell(&self, index: usize) -> &str {
        self.record.get(index).unwrap_or_default().trim()
    }

    /// The row, for diagnostics.
    fn row(&self) -> Row {
        row(self.record.clone(), &self.text.text)
    }

    /// The place of a cell of the row.
    pub fn place(&self, index: usize) -> Span {
        self.row().place(self.head.file(), index)
    }

    /// The note about a file that is not in lptn's own form.
    pub fn note(&self) -> Option<Diagnostic> {
        self.head.note(self.text, Vec::new())
    }

    /// True if there is a column of this name.
    pub fn has(&self, name: &str) -> bool {
        self.head.columns.iter().any(|column| column.name == name)
    }

    /// The name of the row's element, if it has one.
    pub fn name(&self, column: Option<usize>) -> Option<&str> {
        column.map(|index| self.cell(index)).filter(|name| !name.is_empty())
    }

    /// The number of the row below the header, from 1.
    pub fn count(&self) -> u32 {
        u32::try_from(self.rows).unwrap_or(u32::MAX)
    }

    /// The way back from the elements to their rows.
    pub fn marks(self) -> Marks {
        let count = self.rows - self.skipped.len();
        let separator = self.head.dialect.separator;
        Marks {
            text: self.text.clone(),
            count,
            separator,
            marks: self.marks,
            skipped: self.skipped,
        }
    }

    /// The position of a required column.
    ///
    /// # Errors
    /// If it is missing or there twice.
    pub fn required(&self, name: &str) -> Result<usize, Diagnostic> {
        self.head.find(name, &self.asked)
    }

    /// The position of an optional column.
    ///
    /// # Errors
    /// If it is there twice.
    pub fn optional(&self, name: &str) -> Result<Option<usize>, Diagnostic> {
        self.head.optional(name, &self.asked)
    }

    /// A required column of numbers of this type.
    ///
    /// # Errors
    /// If it is missing, is there twice, or has another unit.
    pub fn numbers(&self, name: &str, ty: Type) -> Result<CsvColumn, Diagnostic> {
        self.head.numbers(name, Some(ty), &self.asked)
    }

    /// The place of a column's header.
    pub fn header(&self, index: usize) -> Span {
        self.head.columns[index].place.clone()
    }

    /// The number in a cell, in SI units.
    ///
    /// # Errors
    /// The reason why there is none.
    pub fn number(&self, column: &CsvColumn) -> Result<f64, Wrong> {
        self.head.value(self.cell(column.index), &column.unit)
    }

    /// An error for every column that is not one of these.
    pub fn unknown_columns(&self, known: &[&str]) -> Vec<Diagnostic> {
        let unknown =
            self.head.columns.iter().filter(|column| !known.contains(&column.name.as_str()));
        let told = unknown.map(|column| {
            let message = format!("{} have no column `{}`", self.asked.words, column.name);
            let problem = Diagnostic::error("netlist::csv_unknown_column", message);
            self.asked.also(problem.at(column.place.clone(), "unknown column")).help(nearest(
                &column.name,
                known.iter().copied(),
                "the columns are",
            ))
        });
        told.collect()
    }

    /// The error of a cell without a usable number.
    pub fn no_number(&self, index: usize, wrong: Wrong) -> Diagnostic {
        let problem = self.head.no_number(&self.row(), (index, wrong), &self.asked);
        match wrong {
            Wrong::Missing => problem.help("fill it in, or remove the row"),
            Wrong::NotFinite => problem.help("write a number, or remove the row"),
            Wrong::Text | Wrong::Cold | Wrong::Moment => problem,
        }
    }

    /// The error of an empty cell that needs a name.
    pub fn no_name(&self, index: usize) -> Diagnostic {
        let message = format!("column `{}` has no name in this row", self.head.columns[index].name);
        let problem =
            Diagnostic::error(hints::NETLIST.missing_value, message).at(self.place(index), "");
        self.asked.also(problem).help("fill it in, or remove the row")
    }

    /// The error of a row with more or fewer cells than the header.
    pub fn wrong_length(&self) -> Diagnostic {
        let row = self.row();
        let extra = self.head.extra(&row, &self.asked);
        extra.unwrap_or_else(|| self.head.short(&row, (&self.asked, "n1,,20")))
    }
}

/// Finds the rows of a file that is not stored.
#[derive(Clone, Debug)]
pub struct Marks {
    /// Number of elements from the rows.
    pub count: usize,
    text: CsvText,
    separator: u8,
    /// The bytes of the rows 0, [`STRIDE`], 2 [`STRIDE`] and so on.
    marks: Vec<usize>,
    /// Number of elements before each skipped row.
    skipped: Vec<usize>,
}

impl Marks {
    /// The place of an element's cell; `None` if the cell is empty.
    pub fn cell(&self, element: usize, column: usize) -> Option<Span> {
        let row = self.row(element)?;
        (!row.cell(column).is_empty()).then(|| row.place(self.text.file, column))
    }

    /// The place of an element's row.
    pub fn line(&self, element: usize) -> Option<Span> {
        Some(self.row(element)?.whole(self.text.file))
    }

    fn row(&self, element: usize) -> Option<Row> {
        let number = element + self.skipped.partition_point(|before| *before <= element);
        // with the line end before it: a reader skips a byte order mark at its beginning
        let mark = self.marks.get(number / STRIDE)?.saturating_sub(1);
        let cells = Reader::at(&self.text.text, mark, self.separator).nth(number % STRIDE)?;
        Some(row(cells, &self.text.text))
    }
}
