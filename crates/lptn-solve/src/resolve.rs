//! Cuts an interval until the points of every part resolve the curves between them.
//!
//! Halvings go to the worst part first. Halvings for peaks that may hide have a separate budget.
//! The remaining doubt is reported.

use crate::cuts::{Levels, cuts};
use crate::interval::{At, Interval};
use crate::stop_reason::StopReason;

/// Parts into which bends may cut one interval.
const MOST_CUTS: usize = 4096;

/// A part of an interval that is as short as this share of it is not halved any more: a jump there
/// is known to rounding.
const SHORTEST: f64 = 1e-13;

/// So is one as short as this share of the time.
const ROUNDED: f64 = 4.0 * f64::EPSILON;

/// A part of an interval, and a flag that its points resolve the curves between them.
pub(crate) struct Resolved {
    pub(crate) interval: Interval,
    pub(crate) told: bool,
    /// True if halvings came to an end before it was so short that it is known to rounding.
    pub(crate) open: bool,
}

/// Judgement of a part of an interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Judged {
    /// Error of the curves between its points, over the allowed one; 0 if it is smaller. It may be
    /// rounding, which no halving removes.
    pub(crate) wanting: f64,
    /// Possible hidden features between them, by the form of the curves: halving ends that.
    pub(crate) hides: f64,
}

impl Judged {
    /// Its points resolve everything.
    const TOLD: Self = Self { wanting: 0.0, hides: 0.0 };
}

/// Parts that are halved because something may hide in them.
const MOST_HIDING: usize = 2000;

/// The parts of an interval in the order of time. It is cut at bends of curves. Parts in which
/// something may hide are halved, then those that `judge` finds wanting, the worst first, as often
/// as `halvings` allows.
pub(crate) fn resolve(
    whole: Interval,
    levels: Levels<'_>,
    mut halvings: usize,
    (at, judge): (&mut At<'_>, &mut dyn FnMut(&Interval) -> Judged),
) -> Result<Vec<Resolved>, StopReason> {
    // a jump at the end of a short step is known to the rounding of the time
    let rounding = ROUNDED * whole.from.abs().max(whole.to.abs());
    let shortest = (SHORTEST * (whole.to - whole.from)).max(rounding);
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
        // next to values found since then it may be negligible
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

#[cfg(test)]
mod tests {
    #![allow(
        clippy::unwrap_used,
        clippy::float_cmp,
        reason = "a test that cannot go on has failed; numbers that are given"
    )]

    use super::*;
    use crate::interval::POINTS;

    const WANTING: Judged = Judged { wanting: 1.0, hides: 0.0 };

    /// The ends of a part, and the flags `told` and `open`.
    type Part = ((f64, f64), [bool; 2]);

    /// The parts of an interval with arbitrary curves: their ends, the flags `told` and `open` of
    /// each, and the number of evaluations.
    fn parts(
        (ends, halvings): ((f64, f64), usize),
        (levels, curve): (&[f64], &mut dyn FnMut(f64) -> f64),
        mut judge: impl FnMut(&Interval) -> Judged,
    ) -> (Vec<Part>, usize) {
        let mut looks = 0;
        let mut at = |time: f64| {
            looks += 1;
            Ok(vec![curve(time)])
        };
        let values = [at(ends.0).unwrap(), at(ends.1).unwrap()];
        let whole = Interval::new(ends, values, &mut at).unwrap();
        let of = [levels.to_vec()];
        let levels = Levels { count: 0, of: &of, roundings: &[] };
        let parts = resolve(whole, levels, halvings, (&mut at, &mut judge)).unwrap();
        let last = parts.windows(2).all(|pair| pair[0].interval.to == pair[1].interval.from);
        assert!(
            last && parts[0].interval.from == ends.0
                && parts[parts.len() - 1].interval.to == ends.1
        );
        let seen =
            |part: Resolved| ((part.interval.from, part.interval.to), [part.told, part.open]);
        (parts.into_iter().map(seen).collect(), looks)
    }

    #[test]
    fn what_its_points_tell_is_one_part() {
        let (found, looks) = parts(((0.0, 8.0), 9), (&[], &mut |t| t), |_| Judged::TOLD);
        assert_eq!((found, looks), (vec![((0.0, 8.0), [true, false])], POINTS));
    }

    #[test]
    fn the_most_wanting_part_is_halved_as_often_as_is_allowed() {
        // a part that begins at 0 wants most
        let first =
            |interval: &Interval| Judged { wanting: 1.0 / (1.0 + interval.from), hides: 0.0 };
        for (halvings, ends) in [(0, vec![8.0]), (1, vec![4.0, 8.0]), (3, vec![1.0, 2.0, 4.0, 8.0])]
        {
            let (found, looks) = parts(((0.0, 8.0), halvings), (&[], &mut |t| t), first);
            assert_eq!(found.iter().map(|part| part.0.1).collect::<Vec<_>>(), ends);
            assert!(found.iter().all(|part| part.1 == [false, true]));
            assert_eq!(looks, POINTS + 10 * halvings);
        }
    }

    /// 2^-44 is the first power of one half below 1e-13.
    #[test]
    fn a_jump_is_closed_in_until_it_is_known_to_rounding() {
        for (from, to) in [(0.0, 1.0), (0.0, 1e3), (5.0, 6.0)] {
            let at = from + (to - from) / 3.0;
            let holds = |part: &Interval| part.from <= at && at < part.to;
            let judge = |part: &Interval| if holds(part) { WANTING } else { Judged::TOLD };
            let (found, _) = parts(((from, to), 1000), (&[], &mut |t| t), judge);
            let left: Vec<_> = found.iter().filter(|part| !part.1[0]).collect();
            assert_eq!((found.len(), left.len()), (45, 1), "{from} {to}");
            assert!(!left[0].1[1] && left[0].0.0 <= at && at < left[0].0.1);
        }
    }

    /// It uses none of the halvings, and ends after its own 2000.
    #[test]
    fn parts_in_which_something_may_hide_are_halved_until_nothing_does() {
        let hides = |least: f64| {
            move |part: &Interval| match part.to - part.from > least {
                true => Judged { wanting: 0.0, hides: 2.0 },
                false => Judged::TOLD,
            }
        };
        let (found, _) = parts(((0.0, 8.0), 0), (&[], &mut |t| t), hides(1.5));
        assert_eq!(
            found,
            (0..8).map(|k| ((f64::from(k), f64::from(k + 1)), [true, false])).collect::<Vec<_>>()
        );
        let (found, looks) = parts(((0.0, 8.0), 0), (&[], &mut |t| t), hides(0.0));
        assert_eq!((found.len(), looks), (2001, POINTS + 10 * 2000));
        assert!(found.iter().any(|part| part.1 == [false, true]));
        let (found, _) = parts(((0.0, 8.0), 7), (&[], &mut |t| t), hides(0.0));
        assert_eq!(found.len(), 2008);
    }

    #[test]
    fn what_is_nothing_beside_what_was_seen_meanwhile_is_told() {
        let mut asked = 0;
        let (found, looks) = parts(((0.0, 8.0), 5), (&[], &mut |t| t), |_| {
            asked += 1;
            if asked == 1 { WANTING } else { Judged::TOLD }
        });
        assert_eq!((found, looks), (vec![((0.0, 8.0), [true, false])], POINTS));
    }

    #[test]
    fn an_interval_is_cut_where_a_level_is_passed() {
        let (found, _) = parts(((0.0, 8.0), 0), (&[3.0, 6.5], &mut |t| t), |_| Judged::TOLD);
        let ends: Vec<f64> = found.iter().map(|part| part.0.1).collect();
        assert!(ends.iter().zip([3.0, 6.5, 8.0]).all(|(a, b)| (a - b).abs() < 1e-12), "{ends:?}");
    }

    /// Noise passes a level in every part of a part.
    #[test]
    fn cuts_come_to_an_end() {
        let mut state = 1_u32;
        let mut noise = |_: f64| {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            if state >> 31 == 0 { -1.0 } else { 1.0 }
        };
        let (found, _) = parts(((0.0, 8.0), 0), (&[0.0], &mut noise), |_| Judged::TOLD);
        assert!(found.len() > 4096 && found.len() < 4096 + POINTS, "{}", found.len());
    }
}
