//! Columns of numbers that are read row by row.

use crate::diagnostic::Diagnostic;
use crate::gap::is_gap_word;
use crate::head::{Asked, CsvColumn, Head, Row, Wrong};
use crate::record::RecordColumn;

/// The first problem of a kind, and the number of such problems.
#[derive(Default)]
pub(crate) struct Counted {
    first: Option<Diagnostic>,
    count: usize,
}

impl Counted {
    pub(crate) fn add(&mut self, problem: impl FnOnce() -> Diagnostic) {
        self.first.get_or_insert_with(problem);
        self.count += 1;
    }

    pub(crate) fn told(self, what: &str) -> Option<Diagnostic> {
        let more = self.count.saturating_sub(1);
        self.first.map(|first| match more {
            0 => first,
            1 => first.note(format!("and one more {what}")),
            _ => first.note(
                format!("and {more} more {what}")
                    .replacen("cell", "cells", 1)
                    .replacen("row", "rows", 1),
            ),
        })
    }
}

/// The columns up to now, with the problems of their cells.
pub(crate) struct Cells {
    pub(crate) head: Head,
    pub(crate) columns: Vec<RecordColumn>,
    chosen: Vec<CsvColumn>,
    /// Problems of the cells by column.
    wrong: Vec<Counted>,
    lengths: Counted,
}

impl Cells {
    pub(crate) fn new(head: Head, chosen: Vec<CsvColumn>) -> Self {
        let column = |chosen: &CsvColumn| RecordColumn {
            name: head.columns[chosen.index].name.clone(),
            unit: chosen.unit.clone(),
            values: Vec::new(),
            gaps: 0,
            saturation: None,
            span: head.columns[chosen.index].place.clone(),
        };
        let columns = chosen.iter().map(column).collect();
        let wrong = chosen.iter().map(|_| Counted::default()).collect();
        Self { head, columns, chosen, wrong, lengths: Counted::default() }
    }

    /// True if a row has as many cells as the header; `example` is a row with an empty cell.
    pub(crate) fn is_whole(&mut self, row: &Row, example: &str) -> bool {
        let (head, nobody) = (&self.head, Asked::default());
        if let Some(extra) = head.extra(row, &nobody) {
            self.lengths.add(|| extra);
        } else if row.cells.len() < head.least() {
            self.lengths.add(|| head.short(row, (&nobody, example)));
        } else {
            return true;
        }
        false
    }

    /// Adds the values of a row in SI units: NaN for a gap or a wrong cell.
    pub(crate) fn push(&mut self, row: &Row) {
        for (i, CsvColumn { index, unit }) in self.chosen.iter().enumerate() {
            let value = self.head.value(row.cell(*index), unit).unwrap_or_else(|wrong| {
                if !is_gap(row.cell(*index), wrong) {
                    self.wrong[i]
                        .add(|| self.head.no_number(row, (*index, wrong), &Asked::default()));
                }
                f64::NAN
            });
            self.columns[i].gaps += usize::from(value.is_nan());
            self.columns[i].values.push(value);
        }
    }

    /// The problems of the rows, the columns, and the header.
    pub(crate) fn finish(self) -> (Vec<Diagnostic>, Vec<RecordColumn>, Head) {
        let wrong = self.wrong.into_iter().filter_map(|wrong| wrong.told("cell of this column"));
        (self.lengths.told("row").into_iter().chain(wrong).collect(), self.columns, self.head)
    }
}

/// True if nothing was measured.
pub(crate) fn is_gap(cell: &str, wrong: Wrong) -> bool {
    match wrong {
        Wrong::Missing => true,
        Wrong::Cold | Wrong::Moment => false,
        Wrong::Text | Wrong::NotFinite => is_gap_word(cell),
    }
}
