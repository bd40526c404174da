//! Cuts of curves that are closed forms.
#![allow(clippy::float_cmp, reason = "numbers that are given")]

use super::*;
use crate::interval::NODES;

/// The times at which curves over (0, 10) are cut at some levels each, and how often they were
/// evaluated for that.
fn cuts_of<const N: usize>(
    curves: impl Fn(f64) -> [f64; N],
    (levels, ends): ([&[f64]; N], (f64, f64)),
) -> (Vec<f64>, usize) {
    rounded_cuts(curves, (levels, ends), &[])
}

/// The same for curves with these roundings.
fn rounded_cuts<const N: usize>(
    curves: impl Fn(f64) -> [f64; N],
    (levels, (from, to)): ([&[f64]; N], (f64, f64)),
    roundings: &[f64],
) -> (Vec<f64>, usize) {
    let mut calls = 0;
    let mut at = |time: f64| {
        calls += 1;
        Ok([0.0].into_iter().chain(curves(time)).collect())
    };
    let ends = [at(from).unwrap(), at(to).unwrap()];
    let interval = Interval::new((from, to), ends, &mut at).unwrap();
    let of = levels.map(<[f64]>::to_vec);
    let found = cuts(&interval, Levels { count: 1, of: &of, roundings }, &mut at).unwrap();
    found.iter().for_each(|(time, values)| {
        assert_eq!(values[1..], curves(*time), "the values are those of {time}");
    });
    (found.into_iter().map(|(time, _)| time).collect(), calls - POINTS)
}

/// Those of one curve.
fn cut(curve: impl Fn(f64) -> f64, levels: &[f64]) -> (Vec<f64>, usize) {
    cuts_of(|time| [curve(time)], ([levels], (0.0, 10.0)))
}

fn near(found: &[f64], expected: &[f64]) {
    assert_eq!(found.len(), expected.len(), "{found:?} for {expected:?}");
    found.iter().zip(expected).for_each(|(a, b)| assert!((a - b).abs() < 1e-12, "{a} for {b}"));
}

/// If the points resolve the curve, the guess is the time: one evaluation on each side of it.
#[test]
fn each_passage_of_each_level_is_found_in_two_looks() {
    for sign in [1.0, -1.0] {
        let line = |t: f64| sign * (2.0 * t - 7.0);
        let (found, looks) = cut(line, &[sign * 1.0, sign * 6.0]);
        near(&found, &[4.0, 6.5]);
        assert!(looks <= 6, "{looks}");
        let parabola = |t: f64| sign * (t - 4.0) * (t - 4.0);
        let (found, looks) = cut(parabola, &[sign * 4.0]);
        near(&found, &[2.0, 6.0]);
        assert!(looks <= 6, "{looks}");
    }
}

#[test]
fn levels_out_of_reach_cost_nothing() {
    assert_eq!(cut(|t| t, &[-11.0, 21.0]), (vec![], 0));
    assert_eq!(cut(|_| 3.0, &[3.0]), (vec![], 0));
    near(&cut(|t| t, &[-0.5, 10.5]).0, &[]);
}

/// A top that no point has passed, between two of them.
#[test]
fn a_top_between_the_points_is_looked_at() {
    for sign in [1.0, -1.0] {
        let top = |t: f64| sign * (9.0 - (t - 3.6) * (t - 3.6));
        near(&cut(top, &[sign * 8.99]).0, &[3.5, 3.7]);
        near(&cut(top, &[sign * (9.0 - 1e-4)]).0, &[3.59, 3.61]);
    }
}

/// An end at a level was cut there already.
#[test]
fn an_end_at_a_level_is_no_cut() {
    for sign in [1.0, -1.0] {
        near(&cut(|t| sign * t, &[0.0, sign * 10.0]).0, &[]);
        near(&cut(|t| sign * t * (t - 6.0), &[0.0]).0, &[6.0]);
        near(&cut(|t| sign * (t - 10.0) * (t - 3.0), &[0.0]).0, &[3.0]);
    }
}

/// A curve that its points do not resolve is closed in by secants and halvings.
#[test]
fn a_steep_passage_is_closed_in() {
    for at in [0.7, 3.0, 8.8] {
        let (found, looks) = cut(|t| ((t - at) * 40.0).tanh() + 0.5, &[0.0]);
        near(&found, &[at - 0.5_f64.atanh() / 40.0]);
        assert!(looks < 60, "{looks}");
        let (found, looks) = cut(|t| if t < at { -1.0 } else { 2.0 }, &[0.0]);
        near(&found, &[at]);
        assert!(looks < 120, "{looks}");
    }
}

/// Levels within a part in 1e9 of the curve's range from an end were passed before or will be
/// passed after it.
#[test]
fn an_end_stands_at_a_level_to_a_part_in_a_thousand_million() {
    for scale in [1e-6, 1.0, 1e6] {
        for offset in [0.0, 300.0] {
            let line = |t: f64| scale * (t + offset);
            let levels = |[a, b]: [f64; 2]| [scale * (offset + a), scale * (offset + b)];
            assert_eq!(cut(line, &levels([5e-9, 10.0 - 5e-9])).0, [0.0; 0], "{scale}");
            near(&cut(line, &levels([2e-7, 10.0 - 2e-7])).0, &[2e-7, 10.0 - 2e-7]);
            near(&cut(line, &levels([0.2, 9.8])).0, &[0.2, 9.8]);
        }
    }
}

/// Cuts nearer than 1e-12 of the interval to an end or to each other are not separate.
#[test]
fn cuts_that_rounding_cannot_tell_apart_are_one() {
    let jump = |at: f64| cut(move |t| if t < at { -1.0 } else { 1.0 }, &[0.0]).0;
    for near_end in [6e-12, 10.0 - 6e-12] {
        assert_eq!(jump(near_end), [0.0; 0], "{near_end}");
    }
    for inside in [3e-11, 10.0 - 3e-11] {
        near(&jump(inside), &[inside]);
    }
    let both = |apart: f64, ends: (f64, f64)| {
        let middle = 0.37 * ends.0 + 0.63 * ends.1;
        let curves = |t: f64| [t - middle, t - middle - apart];
        cuts_of(curves, ([&[0.0], &[0.0]], ends)).0.len()
    };
    assert_eq!([4e-12, 3e-11, -3e-11].map(|apart| both(apart, (0.0, 10.0))), [1, 2, 2]);
    // far from 0 two times are one if they differ by 1e-9 of the interval
    let far = (1e9, 1e9 + 1e4);
    assert_eq!([4e-6, 3e-5].map(|apart| both(apart, far)), [1, 2]);
}

#[test]
fn cuts_of_several_quantities_come_in_the_order_of_time() {
    let curves = |t: f64| [t, 20.0 - t, 3.0 * t];
    let levels: [&[f64]; 3] = [&[1.0, 9.0], &[13.0], &[6.0, 12.0]];
    near(&cuts_of(curves, (levels, (0.0, 10.0))).0, &[1.0, 2.0, 4.0, 7.0, 9.0]);
}

#[test]
fn a_level_that_is_touched_from_below_is_not_passed() {
    assert_eq!(cut(|t| 7.0 - (t - 5.0) * (t - 5.0), &[7.0]).0, [0.0; 0]);
}

/// The top is 9 at 3.6 s and the highest point 7.33 at 2.31 s: levels are searched up to half of
/// the difference above it.
#[test]
fn a_top_is_looked_at_as_far_as_it_may_reach() {
    let highest = 9.0 - (3.6 - 5.0 * (1.0 + NODES[2])) * (3.6 - 5.0 * (1.0 + NODES[2]));
    for sign in [1.0, -1.0] {
        let looks = |share: f64| {
            let level = 9.0 + share * (9.0 - highest);
            cut(|t| sign * (9.0 - (t - 3.6) * (t - 3.6)), &[sign * level])
        };
        assert_eq!(looks(0.4), (vec![], 1));
        assert_eq!(looks(0.6), (vec![], 0));
    }
}

/// The times at which a curve is evaluated to find where it passes a level.
fn passed(
    curve: impl Fn(f64) -> f64,
    (level, [from, to], guess): (f64, [f64; 2], f64),
    enough: f64,
) -> (f64, Vec<f64>) {
    let mut looks = Vec::new();
    let mut at = |time: f64| {
        looks.push(time);
        Ok(vec![f64::NAN, curve(time)])
    };
    let gap = [(from, curve(from)), (to, curve(to))];
    let (time, values) = passing(&mut at, (1, level), (gap, guess), enough).unwrap();
    assert_eq!(values[1], curve(time), "the values are those of {time}");
    (time, looks)
}

/// On a line the first secant is exact: one evaluation there, and one after it.
#[test]
fn a_line_is_passed_at_its_first_secant() {
    let enough = 1.0 / 64.0;
    for sign in [1.0, -1.0] {
        for level in [0.0, 8.0] {
            let line = |t: f64| level + sign * (2.0 * t - 8.0);
            let from = |guess: f64| passed(line, (level, [2.0, 6.0], guess), enough);
            assert_eq!(from(3.0), (4.0 + enough / 2.0, vec![3.0, 4.0, 4.0 + enough / 2.0]));
            assert_eq!(from(4.0), (4.0 + enough / 2.0, vec![4.0, 4.0 + enough / 2.0]));
            // a guess after it is closed in from its other side
            assert_eq!(from(5.0).1[..2], [5.0, 4.0]);
            // a guess outside the gap is not used
            assert_eq!([from(7.0).1[0], from(1.0).1[0]], [4.0, 4.0]);
            assert_eq!([from(2.0).1[0], from(6.0).1[0]], [2.0 + enough / 2.0, 6.0 - enough / 2.0]);
        }
    }
}

#[test]
fn a_gap_that_ends_at_the_level_or_is_short_enough_is_its_end() {
    assert_eq!(passed(|t| t - 6.0, (0.0, [2.0, 6.0], 4.0), 0.0), (6.0, vec![6.0]));
    assert_eq!(passed(|t| t - 4.0, (0.0, [3.5, 4.5], 4.0), 1.0), (4.5, vec![4.5]));
    // rounding ends it if nothing else does
    let (time, looks) = passed(|t| t - 1e6 - 0.3, (0.0, [1e6, 1e6 + 1.0], 1e6 + 0.5), 0.0);
    assert!((time - 1e6 - 0.3).abs() < 1e-9 && looks.len() <= 4, "{looks:?}");
}

/// A curve over time.
type Curve<'a> = &'a dyn Fn(f64) -> f64;

/// An interval that secants close in from one side only is halved. These curves use only sums,
/// products and quotients, so that the evaluations are the same on every machine.
#[test]
fn curves_that_deceive_secants_are_closed_in() {
    let curves: [(Curve<'_>, f64, usize); 8] = [
        (&|t| if t < 3.0 { -1.0 } else { 1e6 }, 3.0, 85),
        (&|t| if t < 3.0 { -1e6 } else { 1.0 }, 3.0, 82),
        (&|t| (t - 1.0) * (t - 1.0) * (t - 1.0), 1.0, 71),
        (&|t| (t - 8.5) * (t - 8.5) * (t - 8.5) * (t - 8.5) * (t - 8.5), 8.5, 80),
        (&|t| 1.0 / 7.0 - 1.0 / (1e-3 + t), 7.0 - 1e-3, 5),
        (&|t| t * t * t * t * t * t * t * t - 1.0, 1.0, 15),
        (&|t| if t < 6.0 { (t - 6.0) * 1e-3 } else { (t - 6.0) * 1e3 }, 6.0, 91),
        (&|t| (t - 0.5) / (1.0 + t * t), 0.5, 10),
    ];
    for (k, (curve, exact, measured)) in curves.into_iter().enumerate() {
        for sign in [1.0, -1.0] {
            let (time, looks) = passed(|t| sign * curve(t), (0.0, [0.0, 10.0], 4.0), 1e-9);
            assert!(time >= exact - 1e-13 && time <= exact + 1e-9, "{k}: {time} for {exact}");
            assert_eq!(looks.len(), measured, "{k}");
        }
    }
}

/// Noise of 1e-13 around a level is no passage; a line through that level is one, also where it ends
/// in noise.
#[test]
fn rounding_passes_no_level() {
    let noise = |t: f64| 1e-13 * (1e7 * t).sin();
    let of = |slope: f64, roundings: &[f64]| {
        rounded_cuts(|t| [slope * (t - 4.0) + noise(t)], ([&[0.0]], (0.0, 10.0)), roundings)
    };
    assert!(of(0.0, &[]).0.len() > 2);
    assert_eq!(of(0.0, &[1e-12]), (vec![], 0));
    near(&of(1.0, &[1e-12]).0, &[4.0]);
    let from_level = rounded_cuts(|t| [t + noise(t + 1.0)], ([&[0.0]], (0.0, 10.0)), &[1e-12]);
    assert!(from_level.0.is_empty());
}
