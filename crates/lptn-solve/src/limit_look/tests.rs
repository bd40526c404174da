//! Limits over steps of margins that are closed forms of the time.
#![allow(
    clippy::unwrap_used,
    clippy::float_cmp,
    reason = "a test that cannot go on has failed; numbers that are given"
)]

use lptn_network::Bends;

use super::*;
use crate::interval::POINTS;
use crate::limit_seen::tests::unseen;

/// Results of margins in some steps, and their number of evaluations in addition to the points of
/// each step.
fn look<const N: usize>(
    steps: &[(f64, f64)],
    margins: impl Fn(f64) -> [f64; N],
    sizes: [f64; N],
) -> (LimitLook, usize) {
    let mut look = LimitLook::new(vec![unseen(); N], Bends::default());
    look.sizes = sizes.to_vec();
    let mut calls = 0;
    let mut at = |time: f64| {
        calls += 1;
        Ok(margins(time).to_vec())
    };
    for &ends in steps {
        let values = [at(ends.0).unwrap(), at(ends.1).unwrap()];
        let step = Interval::new(ends, values, &mut at).unwrap();
        look.step(step, &mut at).unwrap();
    }
    (look, calls - POINTS * steps.len())
}

const TWO: [(f64, f64); 2] = [(0.0, 10.0), (11.0, 21.0)];

/// One limit over one step from 0 to 10 s: its least margin, the time of it, the time when it is
/// broken, and the evaluations.
fn one(margin: impl Fn(f64) -> f64) -> (f64, f64, Option<f64>, usize) {
    let (look, looks) = look(&TWO[..1], |time| [margin(time)], [10.0]);
    let seen = look.seen[0];
    assert!(seen.open == 0.0, "{seen:?}");
    (seen.margin, seen.worst_at, seen.broken_at, looks)
}

fn near(found: f64, expected: f64) {
    assert!((found - expected).abs() < 1e-12, "{found} for {expected}");
}

/// A valley between the points is found at the top of the first parabola.
#[test]
fn a_valley_is_found_in_one_look() {
    for (at, depth) in [(3.6, 1.0), (7.7, 0.25), (0.3, 2.0)] {
        let (margin, worst, broken, looks) = one(|t| depth + (t - at) * (t - at));
        near(margin, depth);
        near(worst, at);
        assert_eq!((broken, looks), (None, 1));
    }
    assert_eq!(one(|t| 1.0 + t), (1.0, 0.0, None, 0));
    assert_eq!(one(|t| 11.0 - t), (1.0, 10.0, None, 0));
}

#[test]
fn a_limit_is_broken_when_its_margin_first_passes_zero() {
    let (margin, worst, broken, looks) = one(|t| 7.0 - 2.0 * t);
    assert_eq!((margin, worst), (-13.0, 10.0));
    near(broken.unwrap(), 3.5);
    assert!(looks <= 2, "{looks}");
    // between the points, and above zero again
    let (margin, worst, broken, looks) = one(|t| (t - 3.6) * (t - 3.6) - 1.0 / 16.0);
    near(margin, -1.0 / 16.0);
    near(worst, 3.6);
    near(broken.unwrap(), 3.35);
    assert_eq!(looks, 25);
    // a margin of zero is kept
    assert_eq!(one(|t| (t - 5.0) * (t - 5.0)).2, None);
    assert_eq!(one(|t| t).2, None);
    assert_eq!(one(|t| t - 1e-9).2, Some(0.0));
}

/// Two valleys: the first below zero breaks the limit, the deeper one is the worst.
#[test]
fn the_first_of_two_valleys_breaks_and_the_deeper_one_is_the_worst() {
    let two = |t: f64| {
        let x = (t - 5.0) / 5.0;
        5.0 * ((x * x - 0.25) * (x * x - 0.25) + 0.02 * (x + 0.5) - 0.03)
    };
    // at the zeros of 4 x^3 - x + 0.02 = 0 by Newton's method
    let least = |mut x: f64| {
        (0..50).for_each(|_| x -= (4.0 * x * x * x - x + 0.02) / (12.0 * x * x - 1.0));
        5.0 + 5.0 * x
    };
    let (margin, worst, broken, _) = one(two);
    assert!((worst - least(-0.5)).abs() < 1e-4 && (margin - two(least(-0.5))).abs() < 1e-10);
    assert!(two(broken.unwrap()).abs() < 1e-10 && broken.unwrap() < worst);
    let turned = |t: f64| two(10.0 - t);
    let (margin, worst, broken, _) = one(turned);
    assert!((worst - 10.0 + least(-0.5)).abs() < 1e-4 && (margin - two(least(-0.5))).abs() < 1e-10);
    let first = broken.unwrap();
    assert!(turned(first).abs() < 1e-10 && first < 5.0 && turned(first - 1e-3) > 0.0, "{first}");
}

/// A part that was lower before, or is far from the least, is not evaluated.
#[test]
fn what_cannot_count_costs_no_look() {
    let valley = |t: f64| [if t <= 10.0 { 1.0 + t } else { 2.5 + (t - 13.6) * (t - 13.6) }];
    let (found, looks) = look(&TWO, valley, [10.0]);
    assert_eq!((found.seen[0].margin, looks), (1.0, 0));
    // a valley that no point shows to be below the least up to now
    let valley = |t: f64| [if t <= 10.0 { 1.0 + t } else { 0.5 + (t - 13.6) * (t - 13.6) }];
    let (found, looks) = look(&TWO, valley, [10.0]);
    near(found.seen[0].margin, 0.5);
    assert_eq!(looks, 1);
    // below zero for the first time, though not lower than before is impossible: broken already
    let broken = |t: f64| [if t <= 10.0 { -t } else { (t - 13.6) * (t - 13.6) - 1.0 }];
    let (found, looks) = look(&TWO, broken, [10.0]);
    assert_eq!((found.seen[0].margin, found.seen[0].worst_at), (-10.0, 10.0));
    assert_eq!(looks, 1, "the passage at the start");
}

/// Above the least up to now, the jump of an unbroken limit is ignored.
#[test]
fn a_jump_that_cannot_count_is_ignored() {
    let jump = |t: f64| if t < 3.3 { 4.0 } else { 9.0 };
    let margins = |t: f64| [if t <= 10.0 { 0.0 } else { 1.0 + jump(t - 10.0) }];
    let (found, looks) = look(&TWO, margins, [10.0]);
    assert_eq!((found.seen[0].margin, looks), (0.0, 0));
}

/// Noise of a part in 1e13 of the sides is rounding, and not resolved.
#[test]
fn rounding_of_what_is_compared_is_not_looked_into() {
    let noise = |t: f64| if (1e6 * t).sin() > 0.0 { 1.0 } else { -1.0 };
    let looks = |share: f64, size: f64, base: f64| {
        let margins = |t: f64| [base + share * size * noise(t)];
        look(&TWO[..1], margins, [size]).1
    };
    for size in [1e-3, 1.0, 1e3] {
        // on one side of zero: a passage through zero is closed in whatever its size
        assert_eq!(looks(1e-13, size, size), 0, "{size}");
        assert!(looks(1e-7, size, size) > 100, "{size}");
        assert!(looks(1e-12, size, size) <= 4, "{size}: the edge");
    }
}

/// Noise that no halving resolves leaves the margin open by the range of its values, if that may
/// count.
#[test]
fn noise_leaves_a_margin_open_by_what_was_seen_of_it() {
    let mut state = 1_u32;
    let mut noise = || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(state) / f64::from(u32::MAX)
    };
    let mut look = LimitLook::new(vec![unseen(); 3], Bends::default());
    look.sizes = vec![10.0; 3];
    look.seen[1].margin = -100.0;
    look.seen[1].broken_at = Some(0.0);
    let mut at = |_: f64| Ok(vec![2.0 + noise(), 2.0 + noise(), 2.0 + 1e-6 * noise()]);
    let values = [at(0.0).unwrap(), at(1.0).unwrap()];
    let step = Interval::new((0.0, 1.0), values, &mut at).unwrap();
    look.step(step, &mut at).unwrap();
    let [first, second, third] = [0, 1, 2].map(|i| look.seen[i].open);
    assert!(first > 0.5 && first <= 1.0, "{first}");
    assert_eq!((second, third), (0.0, 0.0));
}

#[test]
fn what_is_left_open_is_the_range_of_the_margins_or_all_where_something_hides() {
    let open = |margins: &[f64], (size, hides): (f64, Option<f64>), seen: LimitSeen| {
        let mut seen = seen;
        seen.leave_open(margins, (size, hides));
        seen.open
    };
    let held = LimitSeen { margin: 1.0, ..unseen() };
    near(open(&[2.0, 5.0, 3.0], (10.0, None), unseen()), 3.0);
    near(open(&[2.0, 5.0, 3.0], (10.0, Some(10.0)), unseen()), 10.0);
    near(open(&[2.0, 5.0, 3.0], (10.0, None), LimitSeen { open: 4.0, ..unseen() }), 4.0);
    // 4 - (5 - 4) does not come below 1, 2.9 - 2.1 does
    assert!(open(&[4.0, 5.0], (10.0, None), held) == 0.0);
    near(open(&[2.9, 5.0], (10.0, None), held), 2.1);
    near(open(&[4.0, 5.0], (10.0, Some(10.0)), held), 10.0);
    // a change of a part in 1e6 of the sides is rounding
    assert!(open(&[2.0, 2.0 + 9e-6], (10.0, None), unseen()) == 0.0);
    near(open(&[2.0, 2.0 + 1.1e-5], (10.0, None), unseen()), 1.1e-5);
    assert!(open(&[2.0, 2.0 + 9e-4], (1e3, None), unseen()) == 0.0);
}

/// No curve that its points resolve leaves their range by as much again.
#[test]
fn a_margin_counts_if_it_may_be_the_least_or_the_first_below_zero() {
    let seen = |margin: f64, broken_at| LimitSeen { margin, broken_at, ..unseen() };
    // reaches down to 3
    let values = [6.0, 5.0, 7.0];
    assert!(counts(&seen(3.1, None), &values) && !counts(&seen(3.0, None), &values));
    // reaches down to -0.5 or to 0
    let low = [2.0, 1.0, 2.5];
    assert!(counts(&seen(-2.0, None), &low));
    assert!(!counts(&seen(-2.0, Some(1.0)), &low));
    assert!(!counts(&seen(-2.0, None), &[2.0, 1.0]));
    assert!(counts(&seen(-0.4, Some(1.0)), &low));
}

#[test]
fn a_valley_is_promising_if_it_is_deeper_than_all_or_the_first_below_zero() {
    let points = |depth: f64, at: f64| {
        [0.0, 1.0, 2.0, 3.0, 4.0].map(|t: f64| (t, depth + (t - at) * (t - at)))
    };
    let held = |margin: f64, broken_at| LimitSeen { margin, broken_at, ..unseen() };
    near(valley(&points(1.0, 1.4), &unseen(), 0.0).unwrap(), 1.4);
    assert_eq!(valley(&points(1.0, 1.4), &held(0.9, None), 0.0), None);
    assert_eq!(valley(&points(1.0, 1.4), &held(1.1, None), 0.2), None);
    near(valley(&points(1.0, 1.4), &held(1.1, None), 0.05).unwrap(), 1.4);
    // a point is known already
    assert_eq!(valley(&points(1.0, 2.0), &unseen(), 0.0), None);
    // the first below zero, by less than rounding
    near(valley(&points(-0.1, 1.4), &unseen(), 1.0).unwrap(), 1.4);
    assert_eq!(valley(&points(-0.1, 1.4), &held(0.0, Some(0.0)), 1.0), None);
    assert_eq!(valley(&points(-0.1, 1.4), &held(-0.05, None), 1.0), None);
    assert_eq!(valley(&points(0.0, 1.4), &unseen(), 1.0), None);
    // the deeper of two
    let two = |t: f64| (t - 1.4) * (t - 1.4) * (t - 4.5) * (t - 4.5) + 0.1 * t;
    let points: Vec<Point> = (0..13).map(|k| f64::from(k) * 0.5).map(|t| (t, two(t))).collect();
    assert!((valley(&points, &unseen(), 0.0).unwrap() - 1.4).abs() < 0.1);
}

/// An interval over which one curve is 2 but for its first inner point, where it is higher.
fn bumped(ends: (f64, f64), by: f64) -> Interval {
    let mut values: [Vec<f64>; POINTS] = std::array::from_fn(|_| vec![2.0]);
    values[1][0] += by;
    Interval { from: ends.0, to: ends.1, values }
}

/// The Gauss rule gives the first inner point its weight, the other rule none; a part in 1e10 of
/// the integral of the absolute value is allowed, or one in 1e12 of the size of the sides.
#[test]
fn what_is_wanting_is_the_difference_of_both_rules_over_what_is_allowed() {
    let weight = crate::interval::GAUSS[0].1;
    let wanting = |ends: (f64, f64), by: f64, size: f64| {
        let mut look = LimitLook::new(vec![unseen()], Bends::default());
        look.sizes = vec![size];
        look.wanting(&bumped(ends, by))
    };
    for ends in [(0.0, 10.0), (1000.0, 1010.0), (-7.0, 3.0)] {
        for by in [0.1, 1e-6, -1e-6] {
            let absolute = 20.0 + 5.0 * weight * by;
            let exact = 5.0 * weight * by.abs() / (1e-10 * absolute);
            let found = wanting(ends, by, 2.0);
            assert!((found / exact - 1.0).abs() < 1e-6, "{ends:?} {by}: {found} {exact}");
            let exact = 5.0 * weight * by.abs() / (1e-12 * 1e4 * 10.0);
            let found = wanting(ends, by, 1e4);
            assert!((found / exact - 1.0).abs() < 1e-6, "{ends:?} {by}: {found} {exact}");
        }
        assert!(wanting(ends, 1e-10, 2.0) == 0.0 && wanting(ends, 1e-6, 1e8) == 0.0);
    }
}

/// A limit that is far from counting wants nothing.
#[test]
fn what_cannot_count_wants_nothing() {
    let wanting = |seen: LimitSeen| {
        let mut look = LimitLook::new(vec![seen], Bends::default());
        look.sizes = vec![2.0];
        look.wanting(&bumped((0.0, 10.0), 0.1))
    };
    let broken = LimitSeen { margin: -5.0, broken_at: Some(0.0), ..unseen() };
    assert!(wanting(broken) == 0.0);
    assert!(wanting(unseen()) > 0.0);
}

/// A valley that is deeper than the points by less than a part in 1e12 of the sides is rounding.
#[test]
fn a_valley_within_the_rounding_of_what_is_compared_is_not_looked_for() {
    let looks = |size: f64| look(&TWO[..1], |t| [1.0 + 1e-8 * (t - 3.6) * (t - 3.6)], [size]).1;
    assert_eq!([looks(1.0), looks(1e3), looks(1e6)], [1, 1, 0]);
}
