//! Solves the candidates, several at a time, and hands on their rows in order.

use std::ops::{ControlFlow, Range};
use std::time::Instant;

use lptn_netlist::SweepOver;
use lptn_report::CsvLines;
use lptn_solve::{Proceed, in_order};
use lptn_study::sweep::Candidate;

use super::asked::Asked;
use super::tally::{Row, Tally};
use crate::console::Console;
use crate::failure::Failure;
use crate::interrupt::Interrupt;
use crate::progress::ProgressLine;

/// Rows that a thread solves at a time: those of runs are handed on one by one.
const STEADY: u64 = 16;

/// Some rows in order.
struct Chunk {
    text: Vec<u8>,
    tally: Tally,
    /// Whether Ctrl-C ended it before its last row.
    interrupted: bool,
}

/// Takes the text of rows, in order.
pub(crate) type Sink<'a> = dyn FnMut(&[u8]) -> Result<(), Failure> + 'a;

/// Solves the cases from `from` on; whether Ctrl-C ended it early.
pub(crate) fn solve(
    asked: &Asked<'_>,
    (from, threads): (u64, usize),
    (tally, sink): (&mut Tally, &mut Sink<'_>),
    console: &Console,
) -> Result<bool, Failure> {
    let interrupt = Interrupt::listen();
    let mut line = ProgressLine::new(console.quiet);
    let (to, size) = (asked.range.end, size(asked));
    let before = from - asked.range.start;
    let all = asked.range.end - asked.range.start;
    let begun = Instant::now();
    let (mut outcome, mut interrupted) = (Ok(()), false);
    let empty = tally.part();
    let chunk = |number: u64| {
        let first = from + number * size;
        asked.chunk(first..to.min(first + size), empty.clone(), &interrupt)
    };
    in_order(0..(to - from).div_ceil(size), threads, chunk, |chunk| {
        outcome = sink(&chunk.text);
        interrupted = chunk.interrupted;
        tally.append(chunk.tally);
        line.update_count((tally.rows, all, "candidates"), (before, begun));
        match outcome.is_err() || interrupted {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        }
    });
    line.clear();
    outcome.map(|()| interrupted)
}

fn size(asked: &Asked<'_>) -> u64 {
    if asked.study().over == SweepOver::Steady { STEADY } else { 1 }
}

impl Asked<'_> {
    fn chunk(&self, cases: Range<u64>, tally: Tally, interrupt: &Interrupt) -> Chunk {
        let mut chunk = Chunk { text: Vec::new(), tally, interrupted: false };
        let mut lines = CsvLines::new();
        for case in cases {
            let solved = match interrupt.control() {
                Proceed::Continue => self.task.candidate(case, &|| interrupt.control()),
                Proceed::Interrupt => None,
            };
            let Some(candidate) = solved else {
                chunk.interrupted = true;
                break;
            };
            let row = self.row(case, &candidate);
            self.write(&row, &mut lines);
            chunk.tally.row(&row);
        }
        chunk.text = lines.into_bytes();
        chunk
    }

    /// A candidate in the units that are shown.
    fn row(&self, case: u64, candidate: &Candidate) -> Row {
        let si = candidate.values.iter().chain(&candidate.reports);
        Row {
            case,
            numbers: self.columns.iter().zip(si).map(|(c, si)| c.unit.from_si(*si)).collect(),
            outside: candidate.outside as u64,
            failed: candidate.failed.unwrap_or_default().to_owned(),
        }
    }

    fn write(&self, row: &Row, lines: &mut CsvLines) {
        lines.whole(row.case + 1);
        for number in &row.numbers {
            match number.is_finite() {
                true => lines.number(*number),
                false => lines.word(""),
            }
        }
        match (self.ranged, row.failed.is_empty()) {
            (true, true) => lines.whole(row.outside),
            (true, false) => lines.word(""),
            (false, _) => {}
        }
        lines.word(&row.failed);
        lines.end();
    }
}
