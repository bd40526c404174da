//! Cuts an interval until the points of every part tell what curves do between them.

use crate::cuts::cuts;
use crate::error::StopReason;
use crate::interval::Interval;

/// Evaluates all curves at a time: those that are asked for, then the quantities that tell where
/// they bend.
pub(crate) type At<'a> = dyn FnMut(f64) -> Result<Vec<f64>, StopReason> + 'a;

/// Parts into which bends may cut one interval.
const MOST_CUTS: usize = 4096;

/// A part of an interval that is as short as this share of it is not halved any more: what jumps
/// there is known to rounding.
const SHORTEST: f64 = 1e-13;

/// Where curves bend: when a quantity behind the first `count` ones passes one of its levels.
#[derive(Clone, Copy)]
pub(crate) struct Levels<'a> {
    /// How many curves are asked for.
    pub(crate) count: usize,
    /// For each of the others its levels, rising.
    pub(crate) of: &'a [Vec<f64>],
}

/// A part of an interval, and whether its points tell what curves are between them.
pub(crate) struct Resolved {
    pub(crate) interval: Interval,
    pub(crate) told: bool,
    /// Whether halvings came to an end before it was so short that it is known to rounding.
    pub(crate) open: bool,
}

/// The parts of an interval in the order of time. It is cut where curves bend; parts that `judge`
/// finds wanting (0 for one that its points tell, else how far they are from that) are halved, the
/// worst first, as often as `halvings` allows.
pub(crate) fn resolve(
    whole: Interval,
    levels: Levels<'_>,
    mut halvings: usize,
    (at, judge): (&mut At<'_>, &mut dyn FnMut(&Interval) -> f64),
) -> Result<Vec<Resolved>, StopReason> {
    let shortest = SHORTEST * (whole.to - whole.from);
    let (mut fresh, mut open, mut done) = (vec![whole], Vec::new(), Vec::new());
    let mut cut = 0;
    loop {
        while let Some(interval) = fresh.pop() {
            let found = if cut < MOST_CUTS { cuts(&interval, levels, at)? } else { Vec::new() };
            if !found.is_empty() {
                cut += found.len();
                fresh.extend(interval.cut(found, at)?);
                continue;
            }
            match judge(&interval) {
                0.0 => done.push(Resolved { interval, told: true, open: false }),
                _ if interval.to - interval.from <= shortest => {
                    done.push(Resolved { interval, told: false, open: false });
                }
                wanting => open.push((wanting, interval)),
            }
        }
        let worst = open.iter().enumerate().max_by(|(_, a), (_, b)| a.0.total_cmp(&b.0));
        let Some(worst) = worst.map(|(place, _)| place).filter(|_| halvings > 0) else { break };
        halvings -= 1;
        fresh.extend(open.swap_remove(worst).1.halves(at)?);
    }
    let left = open.into_iter().map(|(_, interval)| interval);
    done.extend(left.map(|interval| Resolved { interval, told: false, open: true }));
    done.sort_by(|a, b| a.interval.from.total_cmp(&b.interval.from));
    Ok(done)
}
