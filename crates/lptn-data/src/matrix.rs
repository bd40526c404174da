//! A matrix of values as a CSV file: the first row has the arguments along it, the first column
//! those down it. Excel and the exports of motor programs have this form.

use lptn_units::Unit;

use crate::csv_file::{PlacedNumbers, Places};
use crate::decimal::decimal;
use crate::diagnostic::Diagnostic;
use crate::dialect::Dialect;
use crate::file::Span;
use crate::head::{Asked, Head, Row, Wrong, row};
use crate::hints;
use crate::limits::MOST_PROBLEMS;
use crate::options::CsvOptions;
use crate::reader::Reader;
use crate::text::CsvText;

/// A matrix of values with the arguments of its rows and columns, all in SI units.
#[derive(Debug)]
pub struct CsvMatrix {
    /// The numbers of the first column, below the corner.
    pub down: PlacedNumbers,
    /// The numbers of the first row, right of the corner.
    pub along: PlacedNumbers,
    /// The values, row after row.
    pub values: PlacedNumbers,
}

impl CsvMatrix {
    /// Reads a matrix; `units` are those of the first column, the first row and the values. The
    /// cell in the corner may contain anything. Rows and columns without any cell at the end are
    /// left out. Cells are separated by semicolons, tabs or commas.
    ///
    /// # Errors
    /// If the file is empty, or its numbers do not show their decimal sign; if a row has more or
    /// fewer cells than the first one; or one for every cell without a number.
    pub fn read(
        text: &CsvText,
        units: [Unit; 3],
        (options, ask): (&CsvOptions, &Asked),
    ) -> Result<Self, Vec<Diagnostic>> {
        let dialect = Dialect { separator: separator(&text.text), ..Dialect::PLAIN };
        let records = Reader::header(&text.text, &dialect);
        let is_filled = |row: &Row| (0..row.cells.len()).any(|i| !row.cell(i).is_empty());
        let rows = records.map(|cells| row(cells, &text.text)).filter(is_filled);
        let mut rows: Vec<Row> = rows.collect();
        let first = if rows.is_empty() { None } else { Some(rows.remove(0)) };
        let Some(first) = first else { return Err(vec![ask.also(empty(text))]) };
        let mut head = Head::new(text.file, &first, hints::NETLIST);
        head.dialect = dialect;
        // all of its cells are one table, with one sign
        let sign = decimal(&head, text, options).map_err(|problem| vec![ask.also(problem)])?;
        head.dialect.decimal = sign.0;
        let last = (0..first.cells.len()).rfind(|i| !first.cell(*i).is_empty()).unwrap_or(0);
        let mut cells = Cells { text, ask, head: &head, columns: last + 1, problems: Vec::new() };
        let [down, along, values] = units;
        let along = cells.of(&[first], (1..last + 1, &along), along.clone());
        if let Some(problem) = rows.iter().find_map(|row| cells.uneven(row)) {
            return Err(vec![problem]);
        }
        let found = Self {
            along,
            down: cells.of(&rows, (0..1, &down), down.clone()),
            values: cells.of(&rows, (1..last + 1, &values), values.clone()),
        };
        if cells.problems.is_empty() { Ok(found) } else { Err(cells.problems) }
    }
}

/// The sign between the cells.
fn separator(text: &str) -> u8 {
    let first = text.lines().find(|line| !line.trim().is_empty() && !line.starts_with('#'));
    let has = |sign: &u8| first.is_some_and(|line| line.bytes().any(|byte| byte == *sign));
    // a comma next to one of these is a decimal sign
    [b';', b'\t'].into_iter().find(has).unwrap_or(b',')
}

fn empty(text: &CsvText) -> Diagnostic {
    Diagnostic::error(hints::NETLIST.empty, format!("{} has no row", text.name))
        .at(Span::new(text.file, 0..0), "the first row belongs here")
        .help("a matrix has arguments in its first row and first column, and values between them")
}

/// The cells of a matrix while they are read.
struct Cells<'t> {
    text: &'t CsvText,
    ask: &'t Asked,
    head: &'t Head,
    columns: usize,
    problems: Vec<Diagnostic>,
}

impl Cells<'_> {
    /// The numbers of some columns, row after row.
    fn of(
        &mut self,
        rows: &[Row],
        (columns, unit): (std::ops::Range<usize>, &Unit),
        given: Unit,
    ) -> PlacedNumbers {
        let (mut numbers, mut places) = (Vec::new(), Vec::new());
        for row in rows {
            for index in columns.clone() {
                match self.head.value(row.cell(index), unit) {
                    Ok(number) => numbers.push(number),
                    Err(wrong) if self.problems.len() < MOST_PROBLEMS => {
                        let problem = self.no_number(row, (index, wrong));
                        self.problems.push(problem);
                    }
                    Err(_) => {}
                }
                places.push(row.place(self.text.file, index));
            }
        }
        let whole = places.first().cloned().unwrap_or_else(|| Span::new(self.text.file, 0..0));
        let (places, ty) = (Places::Items(places), given.ty);
        PlacedNumbers { numbers, ty, places, whole, unit: Some(given) }
    }

    /// Error if a row has other columns than the first one.
    fn uneven(&self, row: &Row) -> Option<Diagnostic> {
        let filled = (0..row.cells.len()).rfind(|i| !row.cell(*i).is_empty());
        let found = filled.map_or(0, |last| last + 1);
        let code = match found {
            found if found > self.columns => hints::NETLIST.extra_value,
            _ if row.cells.len() < self.columns => hints::NETLIST.short_row,
            _ => return None,
        };
        let message = format!("this row has {found} cells, the first row {}", self.columns);
        let problem = Diagnostic::error(code, message).at(row.whole(self.text.file), "");
        Some(self.ask.also(problem).help(
            "every row has its argument and one value for each number of the first row; the corner \
             is a cell too, which may be empty",
        ))
    }

    fn no_number(&self, row: &Row, (index, wrong): (usize, Wrong)) -> Diagnostic {
        let cell = row.cell(index);
        let codes = hints::NETLIST;
        let (code, message) = match wrong {
            Wrong::Missing => {
                (codes.missing_value, format!("cell {} of this row is empty", index + 1))
            }
            Wrong::NotFinite => {
                (codes.not_finite, format!("cell {} is `{cell}`, not a finite number", index + 1))
            }
            Wrong::Text | Wrong::Moment => {
                (codes.not_a_number, format!("cell {} is `{cell}`, not a number", index + 1))
            }
            Wrong::Cold => ("units::below_absolute_zero", format!("{cell} is below absolute zero")),
        };
        let help = match wrong {
            Wrong::Missing => "fill it in, or leave its row or column out".to_owned(),
            Wrong::Cold => "0 K is -273.15 degC".to_owned(),
            _ => "a cell contains one number; units are in the netlist: `value = \"loss [W]\"`"
                .to_owned(),
        };
        let problem = Diagnostic::error(code, message).at(row.place(self.text.file, index), "");
        self.ask.also(problem).help(help)
    }
}

#[cfg(test)]
mod tests {
    use super::{Asked, CsvMatrix, CsvOptions, CsvText, Unit};
    use crate::file::Files;

    /// Two speeds down, three torques along, with a byte order mark, an empty row and empty cells
    /// at the end, as spreadsheets write them.
    #[test]
    fn arguments_are_in_the_first_row_and_column() {
        let text =
            "\u{feff}rpm \\ N m,1,2.5,10,\r\n1000,5,6,7,\r\n# half\r\n3000,8,9,10,\r\n,,,,\r\n";
        let mut files = Files::new();
        let text = CsvText::of(&mut files, "a.csv".to_owned(), text.as_bytes()).unwrap();
        let units = ["rpm", "N m", "kW"].map(|unit| Unit::parse(unit).unwrap());
        let found =
            CsvMatrix::read(&text, units, (&CsvOptions::default(), &Asked::default())).unwrap();
        let rpm = std::f64::consts::PI / 30.0;
        let [first, second] = [found.down.numbers[0], found.down.numbers[1]];
        assert!((first - 1000.0 * rpm).abs() < 1e-9 && (second - 3000.0 * rpm).abs() < 1e-9);
        assert_eq!(found.along.numbers, [1.0, 2.5, 10.0]);
        assert_eq!(found.values.numbers, [5e3, 6e3, 7e3, 8e3, 9e3, 1e4]);
        assert_eq!(files.line_column(&found.values.place(4)), (4, 8));
    }

    /// As a spreadsheet with decimal commas writes it.
    #[test]
    fn cells_may_be_separated_by_semicolons() {
        let mut files = Files::new();
        let bytes = "rpm;1;2,5\n1000;5,5;6\n3000;8;9,25\n".as_bytes();
        let text = CsvText::of(&mut files, "a.csv".to_owned(), bytes).unwrap();
        let units = ["rpm", "N m", "W"].map(|unit| Unit::parse(unit).unwrap());
        let read = CsvMatrix::read(&text, units, (&CsvOptions::default(), &Asked::default()));
        let found = read.unwrap();
        assert_eq!(found.along.numbers, [1.0, 2.5]);
        assert_eq!(found.values.numbers, [5.5, 6.0, 8.0, 9.25]);
    }
}
