//! Cuts an interval until the points of every part tell what curves do between them.
//!
//! Halvings go to the worst part first. Halvings for peaks that may hide have a separate budget.
//! The remaining doubt is reported.

use crate::cuts::{Levels, cuts};
use crate::interval::{At, Interval};
use crate::stop_reason::StopReason;

/// Parts into which bends may cut one interval.
const MOST_CUTS: usize = 4096;

/// A part of an interval that is as short as this share of it is not halved any more: what jumps
/// there is known to rounding.
const SHORTEST: f64 = 1e-13;

/// A part of an interval, and whether its points tell what curves are between them.
pub(crate) struct Resolved {
    pub(crate) interval: Interval,
    pub(crate) told: bool,
    /// Whether halvings came to an end before it was so short that it is known to rounding.
    pub(crate) open: bool,
}

/// How a part of an interval is judged.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Judged {
    /// How far its points are from telling what curves are between them, over what is allowed; 0
    /// where they are not. That may be rounding, which no halving mends.
    pub(crate) wanting: f64,
    /// How much may hide between them, by the form of the curves: halving ends that.
    pub(crate) hides: f64,
}

impl Judged {
    /// Its points tell all.
    const TOLD: Self = Self { wanting: 0.0, hides: 0.0 };
}

/// Parts that are halved because something may hide in them.
const MOST_HIDING: usize = 2000;

/// The parts of an interval in the order of time. It is cut where curves bend; parts in which
/// something may hide are halved, then those that `judge` finds wanting, the worst first, as often
/// as `halvings` allows.
pub(crate) fn resolve(
    whole: Interval,
    levels: Levels<'_>,
    mut halvings: usize,
    (at, judge): (&mut At<'_>, &mut dyn FnMut(&Interval) -> Judged),
) -> Result<Vec<Resolved>, StopReason> {
    let shortest = SHORTEST * (whole.to - whole.from);
    let (mut fresh, mut open, mut done) = (vec![whole], Vec::new(), Vec::new());
    let (mut cut, mut hiding) = (0, MOST_HIDING);
    loop {
        while let Some(interval) = fresh.pop() {
            let found = if cut < MOST_CUTS { cuts(&interval, levels, at)? } else { Vec::new() };
            if !found.is_empty() {
                cut += found.len();
                fresh.extend(interval.cut(found, at)?);
                continue;
            }
            let Judged { wanting, hides } = judge(&interval);
            if interval.to - interval.from <= shortest || (wanting == 0.0 && hides == 0.0) {
                let told = wanting == 0.0;
                done.push(Resolved { interval, told, open: false });
            } else if hides > 0.0 && hiding > 0 {
                hiding -= 1;
                fresh.extend(interval.halves(at)?);
            } else {
                open.push((wanting.max(hides), interval));
            }
        }
        let worst = open.iter().enumerate().max_by(|(_, a), (_, b)| a.0.total_cmp(&b.0));
        let Some(worst) = worst.map(|(place, _)| place).filter(|_| halvings > 0) else { break };
        let (_, interval) = open.swap_remove(worst);
        // beside what was seen meanwhile it may be nothing
        if judge(&interval) == Judged::TOLD {
            done.push(Resolved { interval, told: true, open: false });
            continue;
        }
        halvings -= 1;
        fresh.extend(interval.halves(at)?);
    }
    let left = open.into_iter().map(|(_, interval)| interval);
    done.extend(left.map(|interval| Resolved { interval, told: false, open: true }));
    done.sort_by(|a, b| a.interval.from.total_cmp(&b.interval.from));
    Ok(done)
}
