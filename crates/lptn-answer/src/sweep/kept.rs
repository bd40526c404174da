//! Rows of a sweep in memory, column by column.

use std::borrow::Cow;

use lptn_report::{Cells, CsvLines, RowColumn};

use super::asked::SweepAsked;
use super::row::{Row, RowShape};

/// A form that takes the rows of a part of a sweep, in order.
pub trait RowForm: Default + Send {
    /// Takes the next row.
    fn take(&mut self, row: &Row, shape: RowShape);
}

/// No row is needed.
impl RowForm for () {
    fn take(&mut self, _: &Row, _: RowShape) {}
}

/// The text of a CSV file.
impl RowForm for CsvLines {
    fn take(&mut self, row: &Row, shape: RowShape) {
        self.whole(row.case + 1);
        for number in &row.numbers {
            match number.is_finite() {
                true => self.number(*number),
                false => self.word(""),
            }
        }
        if shape.judged {
            self.word(&row.limits);
            self.word(&row.worst);
        }
        match (shape.ranged, row.failed.is_empty()) {
            (true, true) => self.whole(row.outside),
            (true, false) => self.word(""),
            (false, _) => {}
        }
        self.word(&row.failed);
        self.end();
    }
}

/// The rows, column by column.
#[derive(Clone, Debug, Default)]
pub struct KeptRows {
    /// Counted from 1.
    cases: Vec<f64>,
    /// As [`Row::numbers`]; NaN for unknown and infinite values.
    numbers: Vec<Vec<f64>>,
    limits: Vec<String>,
    worst: Vec<String>,
    /// NaN for those that failed.
    outside: Vec<f64>,
    failed: Vec<String>,
}

impl RowForm for KeptRows {
    fn take(&mut self, row: &Row, shape: RowShape) {
        self.cases.push((row.case + 1) as f64);
        self.numbers.resize(row.numbers.len(), Vec::new());
        for (column, number) in self.numbers.iter_mut().zip(&row.numbers) {
            column.push(if number.is_finite() { *number } else { f64::NAN });
        }
        if shape.judged {
            self.limits.push(row.limits.clone());
            self.worst.push(row.worst.clone());
        }
        if shape.ranged {
            let known = row.failed.is_empty();
            self.outside.push(if known { row.outside as f64 } else { f64::NAN });
        }
        self.failed.push(row.failed.clone());
    }
}

impl KeptRows {
    /// Adds the rows that follow.
    pub fn append(&mut self, mut later: Self) {
        self.cases.append(&mut later.cases);
        self.numbers.resize(later.numbers.len(), Vec::new());
        for (column, more) in self.numbers.iter_mut().zip(&mut later.numbers) {
            column.append(more);
        }
        self.limits.append(&mut later.limits);
        self.worst.append(&mut later.worst);
        self.outside.append(&mut later.outside);
        self.failed.append(&mut later.failed);
    }

    /// The rows one by one.
    pub(super) fn rows(&self) -> impl Iterator<Item = Row> + '_ {
        let word = |words: &[String], row: usize| words.get(row).cloned().unwrap_or_default();
        (0..self.cases.len()).map(move |row| Row {
            case: self.cases[row] as u64 - 1,
            numbers: self.numbers.iter().map(|column| column[row]).collect(),
            limits: word(&self.limits, row),
            worst: word(&self.worst, row),
            // NaN becomes 0
            outside: self.outside.get(row).map_or(0, |outside| *outside as u64),
            failed: word(&self.failed, row),
        })
    }

    /// The columns, in the order of the file.
    pub(super) fn columns<'s>(&'s self, asked: &SweepAsked) -> Vec<RowColumn<'s>> {
        let shape = asked.shape();
        // before the first row, each column is empty
        let numbers = (0..asked.columns.len())
            .map(|place| Cells::Numbers(self.numbers.get(place).map_or(Cow::default(), Cow::from)));
        let words = |words: &'s [String]| Cells::Words(words.into());
        let mut cells = vec![Cells::Counts((&self.cases).into())];
        cells.extend(numbers);
        if shape.judged {
            cells.extend([words(&self.limits), words(&self.worst)]);
        }
        cells.extend(shape.ranged.then(|| Cells::Counts((&self.outside).into())));
        cells.push(words(&self.failed));
        let named = asked.declared().into_iter().zip(cells);
        let column = |((name, unit), cells): ((&str, Option<&str>), Cells<'s>)| RowColumn {
            name: name.to_owned(),
            unit: unit.map(str::to_owned),
            cells,
        };
        named.map(column).collect()
    }
}
