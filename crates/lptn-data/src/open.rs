//! The header of a file in any dialect.

use crate::decimal::decimal;
use crate::diagnostic::Diagnostic;
use crate::dialect::{Dialect, detect, is_value, known};
use crate::form::plain_header;
use crate::head::{Asked, Head, row};
use crate::hints::Codes;
use crate::options::CsvOptions;
use crate::reader::Reader;
use crate::spelling::is_unit;
use crate::text::CsvText;

/// Number of rows that show whether a file has lptn's own form. A logger's description of its
/// channels takes as many lines.
const PROBE: usize = 400;

/// The header of a text; `example` is an example of a header.
pub(crate) fn open(
    text: &CsvText,
    options: &CsvOptions,
    (codes, example): (&'static Codes, &str),
) -> Result<Head, Diagnostic> {
    let plain = plain_header(text, (codes, example));
    let own = |head: &Head| known(&text.text).is_none() && is_plain(head, text);
    if plain.as_ref().is_ok_and(own) && options.decimal.is_none() {
        return plain.and_then(|head| head.with_units(options));
    }
    let mut head = match detect(&text.text) {
        Some(found) if found != Dialect::PLAIN => foreign_header(text, found, codes),
        _ => plain.map_err(|problem| match problem.code == codes.separator {
            true => problem.help(
                "below the header belong rows of numbers with the same sign between their columns",
            ),
            false => problem,
        })?,
    };
    (head.dialect.decimal, head.doubtful) = decimal(&head, text, options)?;
    head.with_units(options)
}

/// True if the first rows have the form of the header: no more or fewer cells, no units, no commas
/// in quotes, and no other separators in a single column.
fn is_plain(head: &Head, text: &CsvText) -> bool {
    let mut rows = Reader::rows(&text.text, &Dialect::PLAIN).take(PROBE).peekable();
    let fits = |cells: &csv::StringRecord| {
        let others: &[char] = if cells.len() == 1 { &[',', ';', '\t', '|'] } else { &[','] };
        cells.len() == head.columns.len() && !cells.iter().any(|cell| cell.contains(others))
    };
    let units = rows.peek().is_some_and(|cells| {
        let bare = || cells.iter().map(str::trim);
        head.columns.iter().all(|header| header.unit.is_none())
            && bare().any(is_unit)
            && !bare().any(is_value)
    });
    !units && rows.all(|cells| fits(&cells))
}

fn foreign_header(text: &CsvText, dialect: Dialect, codes: &'static Codes) -> Head {
    let mut reader = Reader::header(&text.text, &dialect);
    let names = reader.next().unwrap_or_default();
    let mut head = Head::new(text.file, &row(names, &text.text), codes);
    dialect.seconds.into_iter().for_each(|name| head.in_seconds(name));
    if let Some(units) = &dialect.units {
        let cells = Reader::at(&text.text, units.start, dialect.separator).next();
        head.take_units(&cells.unwrap_or_default());
    }
    head.dialect = dialect;
    head
}

impl Head {
    /// The header with the units that were given for its columns.
    fn with_units(mut self, options: &CsvOptions) -> Result<Self, Diagnostic> {
        self.picolog();
        if self.codes().of_record {
            self.split_units();
        }
        for (name, unit) in &options.units {
            let index = self.find(name, &Asked::default())?;
            self.columns[index].unit = Some(unit.clone());
        }
        Ok(self)
    }
}
