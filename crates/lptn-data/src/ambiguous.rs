//! Numbers of a file with two readings.

use crate::diagnostic::Diagnostic;
use crate::file::Span;
use crate::hints::Codes;

/// A number whose sign is a decimal one or parts thousands.
#[derive(Clone, Debug)]
pub(crate) struct Ambiguous {
    cell: String,
    place: Span,
}

impl Ambiguous {
    pub(crate) fn new(cell: &str, place: Span) -> Self {
        Self { cell: cell.to_owned(), place }
    }

    /// True if this is its sign.
    pub(crate) fn has(&self, sign: char) -> bool {
        self.cell.contains(sign)
    }

    /// The number with a decimal sign, and with thousands.
    fn readings(&self) -> [String; 2] {
        [self.cell.replace(',', "."), self.cell.replace([',', '.'], "")]
    }

    /// The error about a number that nothing decides.
    pub(crate) fn undecided(&self, codes: &Codes) -> Diagnostic {
        let (cell, [decimal, whole]) = (&self.cell, self.readings());
        let message =
            format!("`{cell}` is {decimal} or {whole}: no number of the file shows which");
        let (sign, other) = if cell.contains(',') { (',', '.') } else { ('.', ',') };
        Diagnostic::error(codes.undecided, message).at(self.place.clone(), "").help(format!(
            "write `decimal = \"{sign}\"` next to `csv` (a command: `--decimal {sign}`) for \
             {decimal}, `decimal = \"{other}\"` for {whole}"
        ))
    }

    /// The warning about a number that only other columns decide.
    pub(crate) fn doubt(&self, codes: &Codes) -> Diagnostic {
        let (cell, [decimal, whole]) = (&self.cell, self.readings());
        let sign = if cell.contains(',') { '.' } else { ',' };
        let message = format!(
            "`{cell}` is read as {whole}, by the decimal signs of other columns: no number of its \
             own column shows whether it is {decimal}"
        );
        Diagnostic::warning(codes.undecided, message).at(self.place.clone(), "").help(format!(
            "write `decimal = \"{sign}\"` next to `csv` (a command: `--decimal {sign}`) if \
             {whole} is right; else write {decimal} with the sign of the other columns"
        ))
    }
}
