//! Solves the candidates, several at a time, and hands on their rows in order.

use std::ops::{ControlFlow, Range};
use std::time::Instant;

use lptn_netlist::SweepOver;
use lptn_report::CsvLines;
use lptn_solve::{Proceed, in_order};
use lptn_study::sweep::{Candidate, LinearSweep};

use super::asked::Asked;
use super::row::Row;
use super::tally::Tally;
use crate::console::Console;
use crate::interrupt::Interrupt;
use crate::progress::ProgressLine;
use lptn_answer::failure::Failure;

/// Rows that a thread solves at a time: of small linear networks, and of steady states. Those of
/// other runs are handed on one by one.
const LINEAR: u64 = 1024;
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
    match asked.study().over {
        _ if LinearSweep::new(&asked.task).is_some() => LINEAR,
        SweepOver::Steady => STEADY,
        SweepOver::Run | SweepOver::Periodic => 1,
    }
}

impl Asked<'_> {
    fn chunk(&self, cases: Range<u64>, tally: Tally, interrupt: &Interrupt) -> Chunk {
        let mut chunk = Chunk { text: Vec::new(), tally, interrupted: false };
        let mut lines = CsvLines::new();
        let mut linear = LinearSweep::new(&self.task);
        let (mut candidate, mut row) = (Candidate::default(), Row::default());
        for case in cases {
            if interrupt.control() == Proceed::Interrupt {
                chunk.interrupted = true;
                break;
            }
            let solved = linear.as_mut().is_some_and(|linear| linear.solve(case, &mut candidate));
            if !solved {
                let Some(found) = self.task.candidate(case, &|| interrupt.control()) else {
                    chunk.interrupted = true;
                    break;
                };
                candidate = found;
            }
            self.row(case, &candidate, &mut row);
            self.write(&row, &mut lines);
            chunk.tally.row(&row);
        }
        chunk.text = lines.into_bytes();
        chunk
    }

    /// A candidate in the units that are shown.
    fn row(&self, case: u64, candidate: &Candidate, row: &mut Row) {
        let si = candidate.values.iter().chain(&candidate.reports);
        row.case = case;
        row.numbers.clear();
        row.numbers.extend(self.columns.iter().zip(si).map(|(c, si)| c.unit.from_si(*si)));
        row.outside = candidate.outside as u64;
        row.failed.clear();
        row.failed.push_str(candidate.failed.unwrap_or_default());
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
