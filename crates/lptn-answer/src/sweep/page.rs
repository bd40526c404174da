//! A sweep as a page.

use std::io;
use std::path::PathBuf;

use lptn_netlist::{Diagnostic, Files, Functional, SweepMethod, SweepOver};
use lptn_plot::Figure;
use lptn_report::{
    Json, Page, Piece, Report, Section, Standing, Text, TextTable, plain, significant,
};
use lptn_study::standing::{BROKEN, KEPT, NOT_JUDGED, WARNING};
use serde_json::{Map, Value, json};

use super::asked::{Column, JUDGED, SweepAsked};
use super::kept::KeptRows;
use super::lines::{Lines, json_row, read_row};
use super::row::Row;
use super::tally::{Count, Tally};
use crate::about::{self, Known};
use crate::answer::Answer;
use crate::exit::Exit;
use crate::words::{MOST_NODES, count, some_of, spaced};

/// Digits of a value that is shown.
const DIGITS: usize = 5;

/// Most parameters that are shown; the file has all.
const MOST_AXES: usize = 12;

/// Most candidates that are listed one by one.
const FEW: u64 = 20;

/// Place of the rows.
#[derive(Debug)]
pub enum Rows {
    /// In a file.
    In(PathBuf),
    /// In memory.
    Kept(KeptRows),
}

/// A sweep that is done.
#[derive(Debug)]
pub struct SweepAnswer {
    /// The question.
    pub asked: SweepAsked,
    /// Extremes, failures and the front.
    pub tally: Tally,
    /// Place of the rows.
    pub rows: Rows,
}

impl Answer for SweepAnswer {
    fn files(&self) -> &Files {
        &self.asked.input.netlist.files
    }

    fn doubts(&self) -> Vec<Diagnostic> {
        self.asked.input.netlist.warnings.clone()
    }

    fn exit(&self) -> Exit {
        let lost = self.tally.rows > 0 && self.tally.lost() == self.tally.rows;
        if lost { Exit::Failed } else { Exit::Done }
    }
}

impl SweepAnswer {
    pub(super) fn axes(&self) -> &[Column] {
        &self.asked.columns[..self.asked.axes()]
    }

    pub(super) fn reports(&self) -> &[Column] {
        &self.asked.columns[self.asked.axes()..][..self.asked.reports()]
    }

    /// The sweep in one sentence.
    fn sentence(&self) -> String {
        let study = self.asked.study();
        let names: Vec<&str> = self.axes().iter().map(|axis| axis.name.as_str()).collect();
        let what = match names.len() {
            0..=MOST_AXES => names.join(", "),
            many => format!("{many} parameters"),
        };
        let how = match study.method {
            SweepMethod::Grid => "on a grid of",
            SweepMethod::List => "of lists of",
            SweepMethod::Csv => "of a file, with",
            SweepMethod::LatinHypercube => "of a Latin hypercube over",
            SweepMethod::Sobol => "of a Sobol sequence over",
        };
        let over = match study.over {
            SweepOver::Steady => "in steady state",
            SweepOver::Run => "over the run",
            SweepOver::Periodic => "over the periodic steady state",
        };
        let part = self.asked.shard.map_or(String::new(), |shard| format!(", part {shard}"));
        let rows = usize::try_from(self.tally.rows).unwrap_or(usize::MAX);
        format!("sweep {}: {} {how} {what}, {over}{part}", study.name, count(rows, "candidate"))
    }

    /// The least and the largest value of each report.
    fn extremes(&self) -> TextTable {
        let mut rows: Vec<(usize, &str, &Row)> = Vec::new();
        for (place, span) in self.tally.spans.iter().enumerate() {
            let at = self.axes().len() + place;
            let (Some(least), Some(largest)) = (&span.least, &span.largest) else { continue };
            if least.numbers[at] < largest.numbers[at] {
                rows.extend([(place, "least", least), (place, "largest", largest)]);
            } else {
                rows.push((place, "always", least));
            }
        }
        let (reports, axes) = (self.reports(), self.axes());
        let value = |column: &Column, number: f64| {
            format!("{}{}", significant(number, DIGITS), spaced(&column.unit.text))
        };
        let mut table = TextTable::of(&rows)
            .left("report", |(place, _, _)| plain(&reports[*place].name))
            .left("", |(_, which, _)| (*which).to_owned())
            .right("", |(place, _, row)| value(&reports[*place], row.numbers[axes.len() + place]))
            .right("case", |(_, _, row)| (row.case + 1).to_string());
        for (axis, column) in axes.iter().enumerate().take(MOST_AXES) {
            table = table
                .right(plain(&column.name), move |(_, _, row)| value(column, row.numbers[axis]))
                .optional();
        }
        table.into()
    }

    /// The candidates that none betters in both reports of a front, some of many evenly.
    fn front(&self) -> TextTable {
        let rows = self.tally.front.some(MOST_NODES);
        let (axes, columns) = (self.axes().len(), &self.asked.columns);
        let number = |row: &Row, place: usize| significant(row.numbers[place], DIGITS);
        let [first, second] = self.tally.front.places().unwrap_or_default();
        let mut table = TextTable::of(&rows).right("front", |row| (row.case + 1).to_string());
        for place in [first, second] {
            table = table.right(plain(&columns[place].header()), move |row| number(row, place));
        }
        for (place, axis) in columns.iter().enumerate().take(axes.min(MOST_AXES)) {
            let title = plain(&axis.header());
            table = table.right(title, move |row| number(row, place)).optional();
        }
        table.into()
    }

    /// Every candidate, if there are few.
    fn list(&self) -> TextTable {
        let rows = &self.tally.points;
        let number = |row: &Row, place: usize| match row.numbers[place] {
            number if number.is_finite() => significant(number, DIGITS),
            _ => "-".to_owned(),
        };
        let mut table = TextTable::of(rows).right("case", |row| (row.case + 1).to_string());
        let axes = self.axes().len();
        for (place, column) in self.asked.columns.iter().enumerate() {
            if (MOST_AXES..axes).contains(&place) {
                continue;
            }
            table = table.right(plain(&column.header()), move |row| number(row, place));
        }
        if self.asked.is_judged() {
            let [limits, worst] = JUDGED;
            let failed = |row: &Row| !row.failed.is_empty();
            let word = move |row: &Row, word: &str| if failed(row) { "-" } else { word }.to_owned();
            table = table
                .left(worst, move |row| word(row, &plain(&row.worst)))
                .left(limits, move |row| word(row, &row.limits))
                .judged(|row| match row.limits.as_str() {
                    BROKEN => Standing::Fails,
                    WARNING | NOT_JUDGED => Standing::Open,
                    _ => Standing::Holds,
                });
        }
        table = match self.tally.failed.is_empty() {
            true => table,
            false => table.left("", |row| row.failed.clone()).judged(|row| {
                if row.failed.is_empty() { Standing::Holds } else { Standing::Fails }
            }),
        };
        table.into()
    }

    fn notes(&self) -> Vec<String> {
        let mut notes = Vec::new();
        for (code, Count { count: n, first }) in &self.tally.failed {
            notes.push(format!(
                "{} failed with {code}, the first is case {}: `lptn explain {code}`",
                candidates(*n),
                first + 1
            ));
        }
        notes.extend(self.on_limits());
        let Count { count: n, first } = self.tally.outside;
        if n > 0 {
            notes.push(format!(
                "in {} a law was outside its valid range, the first is case {}",
                candidates(n),
                first + 1
            ));
        }
        if let Some(life) =
            self.asked.study().reports.iter().find(|r| r.functional() == Functional::Life)
        {
            notes.push(format!(
                "`{}` assumes that the computed time history repeats without end",
                life.name
            ));
        }
        notes
    }

    /// The number of candidates that keep their limits, and those that are not on the front.
    fn on_limits(&self) -> Option<String> {
        let of = |word| self.tally.of_limits(word);
        let (kept, broken, open) = (of(KEPT) + of(WARNING), of(BROKEN), of(NOT_JUDGED));
        let all = kept + broken + open;
        let front = match self.tally.front.places() {
            Some(_) => ": the front is of those",
            None => "",
        };
        let open = match open {
            0 => String::new(),
            open => format!(", {open} could not be judged"),
        };
        let keep = if kept == 1 { "keeps" } else { "keep" };
        let breaks = if broken == 1 { "breaks" } else { "break" };
        let note = format!(
            "{kept} of {} {keep} all limits of severity \"error\", {broken} {breaks} \
             one{open}{front}",
            candidates(all)
        );
        (all > 0).then_some(note)
    }

    fn span(&self, row: Option<&Row>, place: usize) -> Value {
        let axes = self.axes();
        row.map_or(Value::Null, |row| {
            let column = &self.reports()[place];
            json!({
                "value": row.numbers[axes.len() + place],
                "unit": column.unit_text(),
                "case": row.case + 1,
            })
        })
    }

    fn write_rows(&self, json: &mut Json<'_>) -> io::Result<()> {
        let shape = self.asked.shape();
        let damaged = || io::Error::new(io::ErrorKind::InvalidData, "a row is damaged");
        let row = |line: &[u8]| {
            read_row(line, shape).map(|row| json_row(&row, shape)).ok_or_else(damaged)
        };
        match &self.rows {
            Rows::Kept(kept) => {
                json.texts("rows", kept.rows().map(|row| Ok(json_row(&row, shape))))
            }
            Rows::In(path) => {
                let mut lines = Lines::open(path).map_err(|_| io::ErrorKind::NotFound)?;
                let skipped = self.asked.heading();
                let next = || loop {
                    match lines.next_line() {
                        Ok(Some(line)) if line == skipped => {}
                        Ok(Some(line)) => break Some(row(&line)),
                        Ok(None) => break None,
                        Err(_) => break Some(Err(damaged())),
                    }
                };
                json.texts("rows", std::iter::from_fn(next))
            }
        }
    }
}

fn candidates(n: u64) -> String {
    count(usize::try_from(n).unwrap_or(usize::MAX), "candidate")
}

impl Page for SweepAnswer {
    fn text(&self) -> Text {
        let mut text = Text::titled(self.asked.input.title());
        text.sentence("", &self.sentence());
        if self.tally.rows <= FEW {
            text.section().table(self.list());
        }
        if self.tally.rows > 1 && self.tally.lost() < self.tally.rows {
            text.section().table(self.extremes());
        }
        some_of(&mut text, self.front(), (self.tally.front.rows().len(), "JSON has all"));
        text.section().notes(self.notes());
        text
    }

    /// The rows that are in memory; those of a file are there already.
    fn rows(&self) -> lptn_report::Rows<'_> {
        lptn_report::Rows::Columns(match &self.rows {
            Rows::Kept(kept) => kept.columns(&self.asked),
            Rows::In(_) => Vec::new(),
        })
    }

    fn json(&self, json: &mut Json<'_>) -> io::Result<()> {
        let study = self.asked.study();
        self.asked.input.head(json, &[])?;
        json.member("sweep", &self.asked.record())?;
        let failed: Map<String, Value> =
            self.tally.failed.iter().map(|(code, of)| (code.clone(), json!(of.count))).collect();
        json.member("failed", &failed)?;
        json.optional("limits", self.asked.is_judged().then_some(&self.tally.limits))?;
        let spans = study.reports.iter().zip(&self.tally.spans).enumerate();
        let spans: Map<String, Value> = spans
            .map(|(place, (report, span))| {
                let least = self.span(span.least.as_ref(), place);
                let largest = self.span(span.largest.as_ref(), place);
                (report.name.clone(), json!({ "least": least, "largest": largest }))
            })
            .collect();
        json.member("extremes", &spans)?;
        if self.tally.front.places().is_some() {
            let cases = self.tally.front.rows().iter().map(|row| row.case + 1);
            json.member("front", &cases.collect::<Vec<u64>>())?;
        }
        json.member("columns", &self.columns())?;
        self.write_rows(json)
    }

    fn figures(&self) -> Vec<Figure> {
        vec![self.figure()]
    }

    fn more(&self) -> Report {
        let parallel = self.parallel().map(|figure| Section::of("", Piece::Figure(figure)));
        let answer = parallel.into_iter().collect();
        Report { answer, ..about::about(&self.asked.input, Known::default()) }
    }
}

impl SweepAnswer {
    fn columns(&self) -> Vec<Value> {
        let one = |(name, unit): (&str, Option<&str>)| json!({ "name": name, "unit": unit });
        self.asked.declared().into_iter().map(one).collect()
    }
}
