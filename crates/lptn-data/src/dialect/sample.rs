//! The first lines of a file, cut into cells.

use std::ops::Range;

use crate::gap::is_gap_word;
use crate::moment::Moment;
use crate::numeral::{Decimal, foreign};

/// Number of lines in which the header is looked for.
const MOST_LINES: usize = 400;

/// The lines that are neither empty nor comments, up to [`MOST_LINES`].
pub(super) fn lines(text: &str) -> Vec<Range<usize>> {
    let start = if text.starts_with('\u{feff}') { '\u{feff}'.len_utf8() } else { 0 };
    let mut at = start;
    let mut lines = Vec::new();
    for line in text[start..].split_inclusive('\n') {
        let bare = line.trim_end_matches(['\n', '\r']);
        if !bare.trim().is_empty() && !bare.starts_with('#') {
            lines.push(at..at + bare.len());
        }
        at += line.len();
        if lines.len() == MOST_LINES {
            break;
        }
    }
    lines
}

/// The cells of a line, without quotes and blanks around.
pub(super) fn cells(line: &str, separator: u8) -> Vec<&str> {
    let (mut cells, mut start, mut quoted) = (Vec::new(), 0, false);
    let bytes = line.as_bytes();
    for (at, byte) in bytes.iter().enumerate() {
        match *byte {
            b'"' => quoted = !quoted,
            byte if byte == separator && !quoted => {
                cells.push(bare(&line[start..at]));
                start = at + 1;
            }
            _ => {}
        }
    }
    cells.push(bare(&line[start..]));
    cells
}

fn bare(cell: &str) -> &str {
    cell.trim().trim_matches('"').trim()
}

/// True for a number of either decimal sign, a date or a clock time.
pub(crate) fn is_value(cell: &str) -> bool {
    let number = cell.parse::<f64>().is_ok()
        || foreign(cell, Decimal::Comma).is_some()
        || foreign(cell, Decimal::PointOnly).is_some();
    number || Moment::of(cell).is_some()
}

/// True for a cell in which a value was not measured.
pub(super) fn is_hole(cell: &str) -> bool {
    cell.is_empty() || is_gap_word(cell)
}
