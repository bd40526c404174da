//! A run of a network whose nodes are all massless: it has no state, so nothing is integrated.

use lptn_integrate::Statistics;
use lptn_network::Bends;

use crate::balance::Books;
use crate::driving::parts_of;
use crate::error::TransientError;
use crate::quadrature::Quadrature;
use crate::recorder::Recorder;
use crate::solution::{RunStatus, Solution};
use crate::stop_reason::StopReason;
use crate::times::Segment;

/// Evaluates every part of the inputs and every row; the results between rows, and the ledger, do
/// not depend on the rows.
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
    let closed =
        books.close(system, recorder.at_state((last, &[])), &integrals, (stored, (0.0, 0.0)));
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
    books: (&Books, &mut [f64]),
) -> Result<(), (f64, StopReason)> {
    let times = recorder.rows().to_vec();
    if recorder.system().network().has_events() {
        return Err((times[0], StopReason::NothingSwitches));
    }
    let (books, integrals) = books;
    let mut sums = Quadrature::new(vec![0; integrals.len()]);
    let mut row = 0;
    for (segment, parts) in segments.iter().zip(parts_of(recorder.system(), segments)) {
        recorder.enter(*segment, None);
        recorder.start(&[], &[]).map_err(|e| (segment.from, e))?;
        row += usize::from(times[row].to_bits() == segment.from.to_bits());
        sums.jump();
        for (from, to) in parts {
            recorder.look_without_state(from, to).map_err(|e| (from, e))?;
            integrate(recorder, (from, to), (books, &mut sums)).map_err(|e| (from, e))?;
            // a row at the end of a segment is left to the next one
            while times.get(row).is_some_and(|time| *time < to || is_end(&times, row, to)) {
                recorder.push_without_state(times[row]).map_err(|e| (times[row], e))?;
                row += 1;
            }
        }
    }
    integrals.copy_from_slice(&sums.integral);
    Ok(())
}

/// True if a row is the last of all and at the end of the part that ends at `to`.
fn is_end(times: &[f64], row: usize, to: f64) -> bool {
    row + 1 == times.len() && times[row] <= to
}

/// Adds the running integrals of the ledger and balance over a part of a segment.
fn integrate(
    recorder: &mut Recorder<'_>,
    (from, to): (f64, f64),
    (books, sums): (&Books, &mut Quadrature),
) -> Result<(), StopReason> {
    let system = recorder.system();
    let middle = from.midpoint(to);
    let mut at = |time: f64| {
        let work = recorder.at(time, middle)?;
        let mut unknowns = vec![0.0; system.unknowns().len()];
        system.unknown_temperatures(system.node_temperatures(work), &mut unknowns);
        let mut q = vec![0.0; books.integrals(system)];
        books.integrands(system, work, &unknowns, &mut q).map_err(StopReason::Input)?;
        Ok(q)
    };
    sums.step((from, to), ((&Bends::default(), &[]), &mut at), &mut |_, _| {})
}
