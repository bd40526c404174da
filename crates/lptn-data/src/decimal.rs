//! The decimal sign of a file, as its numbers show it.

use crate::ambiguous::Ambiguous;
use crate::diagnostic::Diagnostic;
use crate::file::Span;
use crate::head::{Head, row};
use crate::numeral::{Decimal, Shows, shows};
use crate::options::CsvOptions;
use crate::text::CsvText;

/// Number of rows in which decimal signs are counted.
const COUNTED: usize = 200;

/// The decimal sign: as given, else that of the numbers. If only other columns decide on a number,
/// it is returned with the sign.
///
/// # Errors
/// If a number is ambiguous and no other one decides.
pub(crate) fn decimal(
    head: &Head,
    text: &CsvText,
    options: &CsvOptions,
) -> Result<(Decimal, Option<Ambiguous>), Diagnostic> {
    if let Some(decimal) = options.decimal.or(head.dialect.stated) {
        return Ok((decimal, None));
    }
    let mut columns: Vec<Signs> = Vec::new();
    for (n, cells) in head.reader(&text.text).enumerate() {
        if n >= COUNTED && is_decided(&columns) {
            break;
        }
        columns.resize_with(columns.len().max(cells.len()), Signs::default);
        for (index, (cell, signs)) in cells.iter().zip(&mut columns).enumerate() {
            let place = || row(cells.clone(), &text.text).place(head.file(), index);
            signs.count(cell.trim(), place);
        }
    }
    let found = sign(&columns, head.dialect.separator);
    let first = columns.iter().find_map(|signs| signs.either.as_ref());
    match (found, first) {
        (Some(sign), _) => Ok((sign, columns.into_iter().find_map(|signs| signs.open(sign)))),
        (None, Some(first)) => Err(first.undecided(head.codes())),
        (None, None) => Ok((Decimal::Point, None)),
    }
}

/// The signs in the numbers of a column.
#[derive(Default)]
struct Signs {
    points: usize,
    commas: usize,
    /// Whole numbers of three digits, as there are below numbers with thousands.
    hundreds: usize,
    either: Option<Ambiguous>,
}

impl Signs {
    fn count(&mut self, cell: &str, place: impl FnOnce() -> Span) {
        match shows(cell) {
            Shows::Nothing => {
                let digits = cell.trim_start_matches(['+', '-']);
                let three = digits.len() == 3 && digits.bytes().all(|b| b.is_ascii_digit());
                self.hundreds += usize::from(three && !digits.starts_with('0'));
            }
            Shows::APoint | Shows::Only(Decimal::PointOnly) => self.points += 1,
            Shows::Only(_) => self.commas += 1,
            Shows::Either if self.either.is_none() => {
                self.either = Some(Ambiguous::new(cell, place()));
            }
            Shows::Either => {}
        }
    }

    /// A number with thousands by this decimal sign, if no number of the column confirms that.
    fn open(self, sign: Decimal) -> Option<Ambiguous> {
        let (own, group) = match sign {
            Decimal::Comma => (self.commas, '.'),
            Decimal::PointOnly => (self.points, ','),
            // no number may have thousands
            Decimal::Point => return None,
        };
        self.either.filter(|one| own + self.hundreds == 0 && one.has(group))
    }

    fn shows_one(&self) -> bool {
        self.points + self.commas > 0
    }
}

/// True if more rows could not change the answer.
fn is_decided(columns: &[Signs]) -> bool {
    let is_open =
        |signs: &Signs| signs.either.is_some() && !signs.shows_one() && signs.hundreds == 0;
    columns.iter().any(Signs::shows_one) && !columns.iter().any(is_open)
}

/// The sign that most numbers have.
fn sign(columns: &[Signs], separator: u8) -> Option<Decimal> {
    let points: usize = columns.iter().map(|signs| signs.points).sum();
    let commas: usize = columns.iter().map(|signs| signs.commas).sum();
    if separator == b',' {
        // quoted names such as "1,2" are not numbers with commas
        return Some(if points == 0 && commas > 0 { Decimal::Comma } else { Decimal::Point });
    }
    match (commas > points, points > 0) {
        (true, _) => Some(Decimal::Comma),
        (false, true) => Some(Decimal::PointOnly),
        (false, false) => None,
    }
}
