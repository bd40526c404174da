//! What errors fall to if the runs of a design last for ever.

use crate::network::design::error::DesignError;
use crate::network::design::information::Information;
use crate::network::design::sensitive::{DesignObserver, row_of};
use crate::network::design::space::Space;
use crate::network::task::{MeasuredColumn, MeasuredRun};

/// So many times as long runs are looked at.
const LONGER: f64 = 100.0;

/// Rows behind the end of a run that are looked at; each stands for those up to the next.
const ROWS: usize = 2000;

/// An error that is below this part of what so long runs leave has no limit but 0.
const NONE: f64 = 0.05;

/// For each unknown the limit of its standard error as the runs of a design last longer and
/// longer, at most what they tell now; 0 where it falls on and on. `base` is what is known besides.
///
/// Behind its end a run tells more and more of what it then stays at, and no more of anything else:
/// the variance falls to its limit as 1/t, so those of half the time and of all of it tell that.
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

/// What a run of so many samples tells if it goes on, half as long and as long as is looked at.
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

/// The rows of a record behind its end.
fn go_on(run: &mut MeasuredRun, (end, apart): (f64, f64)) {
    run.times = (1..=ROWS).map(|k| end + k as f64 * apart).collect();
    let zeros = |column: &mut MeasuredColumn| column.values = vec![0.0; ROWS];
    run.columns.iter_mut().for_each(zeros);
}
