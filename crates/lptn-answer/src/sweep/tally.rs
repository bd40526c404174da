//! Summary of all rows, however many there are.

use std::collections::BTreeMap;

use super::front::Front;
use super::row::Row;

/// Rows that are kept for a table or a picture, at most.
pub(super) const MOST_POINTS: u64 = 2000;

/// The least and the largest value of a report, each with its row.
#[derive(Clone, Debug, Default)]
pub(super) struct Span {
    pub(super) least: Option<Row>,
    pub(super) largest: Option<Row>,
}

/// Number of rows of a kind, and the first of them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Count {
    pub(super) count: u64,
    pub(super) first: u64,
}

impl Count {
    fn add(&mut self, count: u64, first: u64) {
        if self.count == 0 {
            self.first = first;
        }
        self.count += count;
    }
}

/// Summary of the rows up to now.
#[derive(Clone, Debug)]
pub struct Tally {
    axes: usize,
    /// One row out of this many is kept.
    stride: u64,
    /// Rows up to now.
    pub rows: u64,
    pub(super) failed: BTreeMap<String, Count>,
    pub(super) outside: Count,
    /// Number of rows by the word about their limits.
    pub(super) limits: BTreeMap<String, u64>,
    pub(super) spans: Vec<Span>,
    pub(super) points: Vec<Row>,
    pub(super) front: Front,
}

impl Tally {
    /// An empty summary for these axes and reports, with a front of two reports if wanted.
    pub(super) fn new(
        (axes, reports): (usize, usize),
        front: Option<[usize; 2]>,
        cases: u64,
    ) -> Self {
        Self {
            axes,
            stride: cases.div_ceil(MOST_POINTS).max(1),
            rows: 0,
            failed: BTreeMap::new(),
            outside: Count::default(),
            limits: BTreeMap::new(),
            spans: vec![Span::default(); reports],
            points: Vec::new(),
            front: Front::new(front.map(|places| places.map(|place| axes + place))),
        }
    }

    /// Takes in the next row.
    pub fn row(&mut self, row: &Row) {
        self.rows += 1;
        if row.case.is_multiple_of(self.stride) {
            self.points.push(row.clone());
        }
        if !row.failed.is_empty() {
            self.failed.entry(row.failed.clone()).or_default().add(1, row.case);
            return;
        }
        if row.outside > 0 {
            self.outside.add(1, row.case);
        }
        if !row.limits.is_empty() {
            *self.limits.entry(row.limits.clone()).or_default() += 1;
        }
        if row.keeps() {
            self.front.add(row);
        }
        let reports = row.numbers.get(self.axes..).unwrap_or_default();
        for (place, (span, value)) in self.spans.iter_mut().zip(reports).enumerate() {
            let at = self.axes + place;
            for (known, sign) in [(&mut span.least, -1.0), (&mut span.largest, 1.0)] {
                match known {
                    Some(known) if sign * value <= sign * known.numbers[at] => {}
                    Some(known) => known.clone_from(row),
                    None => *known = Some(row.clone()),
                }
            }
        }
    }

    /// Adds the summary of the rows that follow.
    pub(super) fn append(&mut self, later: Self) {
        self.rows += later.rows;
        self.points.extend(later.points);
        self.front.append(&later.front);
        for (code, count) in later.failed {
            self.failed.entry(code).or_default().add(count.count, count.first);
        }
        if later.outside.count > 0 {
            self.outside.add(later.outside.count, later.outside.first);
        }
        for (word, count) in later.limits {
            *self.limits.entry(word).or_default() += count;
        }
        let axes = self.axes;
        for (place, (span, new)) in self.spans.iter_mut().zip(later.spans).enumerate() {
            let value = |row: &Row| row.numbers[axes + place];
            let better = |known: &Option<Row>, row: &Row, sign: f64| {
                known.as_ref().is_none_or(|known| sign * value(row) > sign * value(known))
            };
            if let Some(row) = new.least.filter(|row| better(&span.least, row, -1.0)) {
                span.least = Some(row);
            }
            if let Some(row) = new.largest.filter(|row| better(&span.largest, row, 1.0)) {
                span.largest = Some(row);
            }
        }
    }

    /// An empty one, for a part of the rows.
    pub(super) fn part(&self) -> Self {
        Self {
            rows: 0,
            failed: BTreeMap::new(),
            outside: Count::default(),
            limits: BTreeMap::new(),
            spans: vec![Span::default(); self.spans.len()],
            points: Vec::new(),
            front: self.front.part(),
            ..*self
        }
    }

    /// Number of rows with this word about their limits.
    pub(super) fn of_limits(&self, word: &str) -> u64 {
        self.limits.get(word).copied().unwrap_or(0)
    }

    /// Number of failed rows.
    pub fn lost(&self) -> u64 {
        self.failed.values().map(|count| count.count).sum()
    }
}
