//! Solves the candidates, several at a time, and passes on their rows in order.

use std::ops::{ControlFlow, Range};

use lptn_netlist::{Diagnostic, SweepOver};
use lptn_solve::{Proceed, available_threads, in_order};
use lptn_study::sweep::{Candidate, LinearSweep};

use super::asked::SweepAsked;
use super::kept::{KeptRows, RowForm};
use super::page::{Rows, SweepAnswer};
use super::row::Row;
use super::tally::Tally;
use crate::exit::Exit;
use crate::failure::Failure;
use crate::listener::Listener;

/// Rows that a thread solves at a time: of small linear networks, and of steady states.
/// Those of other runs are passed on one by one.
const LINEAR: u64 = 1024;
const STEADY: u64 = 16;

/// Some rows in order.
struct Chunk<R> {
    rows: R,
    tally: Tally,
    /// True if an interruption ended it before its last row.
    interrupted: bool,
}

impl SweepAsked {
    /// Solves all cases on this number of threads, or on all, and keeps their rows in memory.
    ///
    /// # Errors
    /// An interruption.
    pub fn in_memory(
        self,
        threads: Option<usize>,
        listener: &dyn Listener,
    ) -> Result<SweepAnswer, Failure> {
        let (mut tally, mut kept) = (self.tally(), KeptRows::default());
        let mut sink = |rows| {
            kept.append(rows);
            Ok(())
        };
        let from = (self.range.start, threads.unwrap_or_else(available_threads));
        if self.solve(from, (&mut tally, &mut sink), listener)? {
            let message = format!("interrupted after {} candidates", tally.rows);
            let problem = Diagnostic::error("run::interrupted", message);
            return Err(Failure::new(Exit::Interrupted, problem));
        }
        Ok(SweepAnswer { asked: self, tally, rows: Rows::Kept(kept) })
    }

    /// Solves the cases from `from` on and passes their rows to `sink`, many at a time, in order.
    /// True if an interruption ended it early.
    ///
    /// # Errors
    /// The first error of `sink`.
    pub fn solve<R: RowForm>(
        &self,
        (from, threads): (u64, usize),
        (tally, sink): (&mut Tally, &mut dyn FnMut(R) -> Result<(), Failure>),
        listener: &dyn Listener,
    ) -> Result<bool, Failure> {
        let (to, size) = (self.range.end, self.size());
        let before = from - self.range.start;
        let all = self.range.end - self.range.start;
        let (mut outcome, mut interrupted) = (Ok(()), false);
        let empty = tally.part();
        let chunk = |number: u64| {
            let first = from + number * size;
            self.chunk::<R>(first..to.min(first + size), empty.clone(), listener)
        };
        in_order(0..(to - from).div_ceil(size), threads, chunk, |chunk| {
            outcome = sink(chunk.rows);
            interrupted = chunk.interrupted;
            tally.append(chunk.tally);
            listener.rate((tally.rows, all, "candidates"), before);
            match outcome.is_err() || interrupted {
                true => ControlFlow::Break(()),
                false => ControlFlow::Continue(()),
            }
        });
        outcome.map(|()| interrupted)
    }

    fn size(&self) -> u64 {
        match self.study().over {
            _ if LinearSweep::new(&self.task).is_some() => LINEAR,
            SweepOver::Steady => STEADY,
            SweepOver::Run | SweepOver::Periodic => 1,
        }
    }

    fn chunk<R: RowForm>(
        &self,
        cases: Range<u64>,
        tally: Tally,
        listener: &dyn Listener,
    ) -> Chunk<R> {
        let mut chunk = Chunk { rows: R::default(), tally, interrupted: false };
        let shape = self.shape();
        let mut linear = LinearSweep::new(&self.task);
        let (mut candidate, mut row) = (Candidate::default(), Row::default());
        for case in cases {
            if listener.proceed() == Proceed::Interrupt {
                chunk.interrupted = true;
                break;
            }
            let solved = linear.as_mut().is_some_and(|linear| linear.solve(case, &mut candidate));
            if !solved {
                let Some(found) = self.task.candidate(case, &|| listener.proceed()) else {
                    chunk.interrupted = true;
                    break;
                };
                candidate = found;
            }
            self.row(case, &candidate, &mut row);
            chunk.rows.take(&row, shape);
            chunk.tally.row(&row);
        }
        chunk
    }

    /// A candidate in the units that are shown.
    fn row(&self, case: u64, candidate: &Candidate, row: &mut Row) {
        row.case = case;
        row.limits.clear();
        row.worst.clear();
        let mut margins = Vec::new();
        if self.is_judged() && candidate.failed.is_none() {
            let judged = self.task.limits().judge(&candidate.limits);
            row.limits.push_str(judged.standing);
            row.worst.push_str(judged.worst);
            margins = judged.margins;
        }
        margins.resize(self.task.limits().types().len(), f64::NAN);
        let si = candidate.values.iter().chain(&candidate.reports).chain(&margins);
        row.numbers.clear();
        row.numbers.extend(self.columns.iter().zip(si).map(|(c, si)| c.unit.from_si(*si)));
        row.outside = candidate.outside as u64;
        row.failed.clear();
        row.failed.push_str(candidate.failed.unwrap_or_default());
    }
}
