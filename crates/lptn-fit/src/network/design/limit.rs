//! Limits of the errors if the runs of a design never end.

use crate::network::design::error::DesignError;
use crate::network::design::information::Information;
use crate::network::design::sensitive::{DesignObserver, row_of};
use crate::network::design::space::Space;
use crate::network::task::{MeasuredColumn, MeasuredRun};

/// Factor on the length of the runs that are evaluated.
const LONGER: f64 = 100.0;

/// Number of rows after the end of a run; each represents those up to the next.
const ROWS: usize = 2000;

/// An error that is below this part of that after such long runs has no limit but 0.
const NONE: f64 = 0.05;

/// For each unknown the limit of its standard error as the runs of a design last longer and longer,
/// at most its value `now`; 0 if it keeps falling. `base` is the other knowledge.
///
/// After its end a run informs more and more about its final state, and about nothing else. The
/// variance falls to its limit as 1/t, so its values at half the time and at all of it give the
/// limit.
pub(super) fn limits(
    space: &Space<'_>,
    (places, runs): (&[usize], &[(usize, usize)]),
    (base, now, observer): (&Information, &[f64], &DesignObserver<'_>),
) -> Result<Vec<f64>, DesignError> {
    let mut long = [base.clone(), base.clone()];
    for &run in runs {
        let told = longer(space, places, (run, observer))?;
        long.iter_mut().zip(&told).for_each(|(sum, told)| sum.add(told));
    }
    let [half, whole] = long.map(|told| told.errors());
    let limit = |((half, whole), now): ((&f64, &f64), &f64)| {
        if !half.is_finite() {
            return *whole;
        }
        let left = 2.0 * whole * whole - half * half;
        let limit = left.max(0.0).sqrt();
        // with a drift the weights of a short record are not those of a long one
        if limit < NONE * whole { 0.0 } else { limit.min(*now) }
    };
    Ok(half.iter().zip(&whole).zip(now).map(limit).collect())
}

/// Information of a run of some samples that goes on, at half and at all of the evaluated length.
fn longer(
    space: &Space<'_>,
    places: &[usize],
    ((run, samples), observer): ((usize, usize), &DesignObserver<'_>),
) -> Result<[Information; 2], DesignError> {
    let task = space.task;
    let at = task.given() + run;
    let stride = (samples as f64 * LONGER / ROWS as f64).max(1.0);
    let mut fit = task.fit.clone();
    let end = fit.runs[at].settings.start() + task.lasts(samples);
    go_on(&mut fit.runs[at], (end, stride * task.every));
    let measure = task.measure((&fit, at), &|step| observer(run, step))?;
    let unknowns = task.unknowns_of(at);
    let begun = space.exactly(places, (run, samples), observer)?;
    let mut sums = [begun.clone(), begun];
    for &place in places {
        for row in 0..ROWS {
            let x = row_of(&measure, &unknowns, place * ROWS + row);
            let from = usize::from(row >= ROWS / 2);
            sums[from..].iter_mut().for_each(|sum| sum.add_row(&x, stride));
        }
    }
    Ok(sums.map(|sum| space.settled(run, sum)))
}

/// The rows of a record after its end.
fn go_on(run: &mut MeasuredRun, (end, apart): (f64, f64)) {
    run.times = (1..=ROWS).map(|k| end + k as f64 * apart).collect();
    let zeros = |column: &mut MeasuredColumn| column.values = vec![0.0; ROWS];
    run.columns.iter_mut().for_each(zeros);
}
