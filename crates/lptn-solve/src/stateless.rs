//! A run of a network whose nodes are all massless: it has no state, so nothing is integrated.

use lptn_integrate::Statistics;

use crate::balance::Books;
use crate::error::{StopReason, TransientError};
use crate::quadrature::GAUSS;
use crate::recorder::Recorder;
use crate::solution::{RunStatus, Solution};
use crate::times::Segment;

/// Evaluates every row; the ledger integrates between rows by the Gauss rule.
pub(crate) fn solve(
    mut recorder: Recorder<'_>,
    segments: &[Segment],
    books: &Books,
) -> Result<Solution, TransientError> {
    let system = recorder.system();
    let mut integrals = vec![0.0; books.integrals(system)];
    let stored = vec![0.0; system.network().nodes().len()];
    let (outcome, end) = match rows(&mut recorder, segments, (books, &mut integrals)) {
        Ok(()) => (None, RunStatus::Reached),
        Err((time, reason)) => (Some((time, reason)), RunStatus::Failed(time)),
    };
    let last = match end {
        RunStatus::Failed(time) => time,
        _ => recorder.span().1,
    };
    let closed = books.close(system, recorder.at_state((last, &[])), &integrals, (stored, 0.0));
    let solution = recorder.into_solution(closed, (Statistics::default(), Vec::new()), end);
    match outcome {
        None => Ok(solution),
        Some((time, reason)) => {
            Err(TransientError::Stopped { time, reason, partial: Box::new(solution) })
        }
    }
}

fn rows(
    recorder: &mut Recorder<'_>,
    segments: &[Segment],
    (books, integrals): (&Books, &mut [f64]),
) -> Result<(), (f64, StopReason)> {
    let times = recorder.rows().to_vec();
    if recorder.system().network().has_events() {
        return Err((times[0], StopReason::NothingSwitches));
    }
    let last = times.len() - 1;
    let mut row = 0;
    for (i, &segment) in segments.iter().enumerate() {
        recorder.enter(segment, None);
        recorder.start(&[], &[]).map_err(|e| (segment.from, e))?;
        row += usize::from(times[row].to_bits() == segment.from.to_bits());
        let mut from = segment.from;
        while row <= last && (times[row] < segment.to || (i + 1 == segments.len() && row == last)) {
            interval(recorder, (from, times[row]), (books, integrals)).map_err(|e| (from, e))?;
            from = times[row];
            recorder.push_without_state(from).map_err(|e| (from, e))?;
            row += 1;
        }
        if from < segment.to {
            interval(recorder, (from, segment.to), (books, integrals)).map_err(|e| (from, e))?;
        }
    }
    Ok(())
}

fn interval(
    recorder: &mut Recorder<'_>,
    (from, to): (f64, f64),
    (books, integrals): (&Books, &mut [f64]),
) -> Result<(), StopReason> {
    recorder.look_without_state(from, to)?;
    let system = recorder.system();
    let mut q = vec![0.0; integrals.len()];
    let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
    for (x, weight) in GAUSS {
        let work = recorder.at(middle + half * x)?;
        let mut unknowns = vec![0.0; system.unknowns().len()];
        system.unknown_temperatures(system.node_temperatures(work), &mut unknowns);
        books.integrands(system, work, &unknowns, &mut q).map_err(StopReason::Input)?;
        integrals.iter_mut().zip(&q).for_each(|(sum, q)| *sum += half * weight * q);
    }
    Ok(())
}
