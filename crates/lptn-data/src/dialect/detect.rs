//! The dialect that the first lines of a file show.

use std::ops::Range;

use crate::dialect::sample::{cells, is_hole, is_value, lines};
use crate::dialect::{Dialect, known};
use crate::spelling::is_unit;

/// The signs that may part columns, the most likely first.
const SEPARATORS: [u8; 4] = [b';', b'\t', b',', b'|'];

/// Greatest number of lines between the header and the first row: units, kinds of values.
const BELOW: usize = 3;

/// The first lines, cut by one separator.
struct Sheet<'t> {
    lines: &'t [Range<usize>],
    cells: Vec<Vec<&'t str>>,
    /// The columns that contain values in the last of these lines.
    columns: Vec<usize>,
    /// The number of cells of these lines.
    width: usize,
    separator: u8,
    /// The share of values among their cells.
    score: f64,
}

/// The dialect of a text; `None` if its first lines show no header above rows of values.
pub(crate) fn detect(text: &str) -> Option<Dialect> {
    known(text).or_else(|| shown(text))
}

/// The dialect that the rows show.
fn shown(text: &str) -> Option<Dialect> {
    let lines = lines(text);
    let sheets = SEPARATORS.iter().filter_map(|separator| Sheet::of(text, &lines, *separator));
    let mut sheets: Vec<Sheet<'_>> = sheets.collect();
    // of `a;air;1,5`, cut by commas, more of the cells are numbers
    sheets.sort_by(|a, b| b.score.total_cmp(&a.score));
    sheets.iter().find_map(Sheet::dialect)
}

impl<'t> Sheet<'t> {
    /// The lines cut by this separator; `None` if the last of them are not rows of it.
    fn of(text: &'t str, lines: &'t [Range<usize>], separator: u8) -> Option<Self> {
        let cells: Vec<Vec<&str>> =
            lines.iter().map(|line| cells(&text[line.clone()], separator)).collect();
        let tail = &cells[cells.len() - cells.len().min((cells.len() / 3).max(3))..];
        let count = |width: usize| tail.iter().filter(|cells| cells.len() == width).count();
        let width = tail.iter().map(Vec::len).filter(|width| *width > 1);
        let width = width.max_by_key(|width| (count(*width), *width))?;
        let rows: Vec<&Vec<&str>> = tail.iter().filter(|cells| cells.len() == width).collect();
        let values = |column: usize| rows.iter().filter(|row| is_value(row[column])).count();
        let holes = |column: usize| rows.iter().filter(|row| is_hole(row[column])).count();
        // values in more than half of the rows; of two lines, one may be the header
        let most = rows.len().saturating_sub(usize::from(rows.len() == 2));
        let columns: Vec<usize> =
            (0..width).filter(|&c| values(c) > 0 && 2 * (values(c) + holes(c)) > most).collect();
        // a header among these lines says nothing about the separator
        let rows = rows.iter().filter(|row| row.iter().any(|cell| is_value(cell)));
        let cells_of = || rows.clone().flat_map(|row| row.iter()).filter(|cell| !is_hole(cell));
        let (filled, found) = (cells_of().count(), cells_of().filter(|c| is_value(c)).count());
        let score = found as f64 / filled.max(1) as f64;
        let sheet = Self { lines, cells, columns, width, separator, score };
        (!sheet.columns.is_empty()).then_some(sheet)
    }

    /// True for a row of values: no column of values has a word.
    fn is_row(&self, line: usize) -> bool {
        let cell = |column: usize| self.cells[line].get(column).copied().unwrap_or_default();
        let sound = self.columns.iter().all(|&c| is_value(cell(c)) || is_hole(cell(c)));
        let values = self.columns.iter().filter(|&&column| is_value(cell(column))).count();
        sound && values > 0 && self.cells[line].len() >= self.width.min(2)
    }

    /// True for a row without any value, such as that of a massless node among capacities.
    fn is_blank(&self, line: usize) -> bool {
        let row = &self.cells[line];
        row.len() == self.width && self.columns.iter().all(|&column| is_hole(row[column]))
    }

    /// True for a line with values in half of the columns, of which some may be wrong.
    fn is_nearly_row(&self, line: usize) -> bool {
        let row = &self.cells[line];
        let values = self.columns.iter().filter(|&&c| row.get(c).is_some_and(|v| is_value(v)));
        row.len() == self.width && 2 * values.count() >= self.columns.len()
    }

    /// True for a line with a name above every column of values. The first may have none: Excel and
    /// pandas write the numbers or times of rows so.
    fn names(&self, line: usize) -> bool {
        let row = &self.cells[line];
        let name = |column: &usize| {
            let nameless = *column == 0 && row.len() == self.width;
            row.get(*column).is_some_and(|c| (nameless || !c.is_empty()) && !is_value(c))
        };
        self.columns.iter().all(name) && self.columns.iter().any(|column| !row[*column].is_empty())
    }

    /// True for a line with units below a line of names.
    fn units(&self, line: usize) -> bool {
        let row = &self.cells[line];
        let unit = |column: &usize| row.get(*column).is_some_and(|cell| is_unit(bracketless(cell)));
        let value = |column: &usize| row.get(*column).is_some_and(|cell| is_value(cell));
        let columns = &self.columns;
        columns.iter().any(unit) && !columns.iter().any(value) && line > 0 && self.heads(line - 1)
    }

    /// True for a line with a name above every column of values; the numbers of channels are names,
    /// too, but not all of them.
    fn heads(&self, line: usize) -> bool {
        let row = &self.cells[line];
        let cell = |column: &usize| row.get(*column).copied().unwrap_or_default();
        self.columns.iter().all(|column| !cell(column).is_empty())
            && self.columns.iter().any(|column| !is_value(cell(column)))
    }

    fn dialect(&self) -> Option<Dialect> {
        let last = self.cells.len();
        let below = |line: usize| line == last || self.is_row(line) || self.is_blank(line);
        let mut first = (0..last).find(|line| self.is_row(*line) && below(line + 1))?;
        while first > 0 && (self.is_nearly_row(first - 1) || self.is_blank(first - 1)) {
            first -= 1;
        }
        let near = || (first.saturating_sub(BELOW)..first).rev();
        let units = near().find(|line| self.units(*line));
        let header = match units {
            Some(units) => units - 1,
            None => near().find(|line| self.names(*line))?,
        };
        // without a line of units, nothing is left out below the header
        let rows = units.map(|_| self.lines[first].start);
        if units.is_none() && header + 1 != first {
            return None;
        }
        Some(Dialect {
            separator: self.separator,
            start: if header == 0 { 0 } else { self.lines[header].start },
            titles: header,
            units: units.map(|line| self.lines[line].clone()),
            rows,
            ..Dialect::PLAIN
        })
    }
}

/// A unit without the brackets around it.
pub(crate) fn bracketless(cell: &str) -> &str {
    let inside = |open, close| cell.strip_prefix(open)?.strip_suffix(close);
    inside('[', ']').or_else(|| inside('(', ')')).unwrap_or(cell).trim()
}
