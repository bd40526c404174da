//! Moments of known quantities: how close, and after how many evaluations.
#![allow(clippy::float_cmp, reason = "numbers that are given")]

use super::*;

/// The moment between 0 and 8 s at which a quantity becomes positive, and its evaluations.
fn moment(of: impl Fn(f64) -> f64, enough: f64) -> (f64, usize) {
    let ends = [0.0, 8.0].map(|time| (time, of(time)));
    let straight = Bracket::straight(ends).next;
    let mut bracket = Bracket::new(ends, straight, enough);
    let (mut found, mut looks) = (8.0, 0);
    while let Some(time) = bracket.next() {
        assert!(time > bracket.times[0] && time < bracket.times[1], "{time} is outside");
        looks += 1;
        if bracket.put(time, of(time)) {
            found = time;
        }
        assert!(of(bracket.times[0]) <= 0.0 && of(bracket.times[1]) > 0.0);
    }
    (found, looks)
}

/// A halving of 8 s to the rounding of a second takes 54 evaluations. A jump, which deceives
/// secants, takes three times as many.
#[test]
fn moments_are_closed_in_to_rounding() {
    type Row<'a> = (&'a dyn Fn(f64) -> f64, f64, usize);
    let rows: [Row<'_>; 7] = [
        (&|t| t - 3.0, 3.0, 3),
        (&|t| 1e-3 * (t - 0.7), 0.7, 6),
        (&|t| t * t - 2.0, 2.0_f64.sqrt(), 26),
        (&|t| (t - 5.0).powi(3), 5.0, 110),
        (&|t| 1.0 - (-(t - 0.01)).exp(), 0.01, 26),
        (&|t| if t > 6.1 { 1.0 } else { -1e-9 }, 6.1, 160),
        (&|t| if t > 0.3 { 1e-12 } else { -1.0 }, 0.3, 160),
    ];
    for (row, (of, exact, most)) in rows.into_iter().enumerate() {
        let (found, looks) = moment(of, 0.0);
        assert!((found - exact).abs() < 1e-15 * exact.max(1.0), "{row}: {found}");
        assert!(looks <= most, "{row}: {looks} looks");
    }
}

/// A temperature near 310 K has steps of 5.7e-14 K: its distance to a threshold is zero for a while.
#[test]
fn a_zero_by_rounding_is_left_in_growing_steps() {
    let over = |t: f64| (310.0 + (t - 0.7)) - 310.0;
    let (found, looks) = moment(over, 0.0);
    assert!(found > 0.7 && found < 0.7 + 1e-13, "{found}");
    assert!(looks <= 16, "{looks} looks");
    // zero for seconds
    let (found, looks) = moment(|t| (t - 5.0).max(0.0), 0.0);
    assert!(found > 5.0 && found < 5.0 + 1e-14 && looks <= 110, "{found} after {looks}");
}

#[test]
fn no_closer_than_what_is_enough() {
    let (found, looks) = moment(|t| t * t - 2.0, 0.01);
    assert!(
        found > 2.0_f64.sqrt() && found < 2.0_f64.sqrt() + 0.01 && looks <= 14,
        "{found} {looks}"
    );
    assert!(Bracket::new([(1.0, -1.0), (1.005, 1.0)], 1.0, 0.01).next().is_none());
    // a quantity that is zero at the end has its moment there
    assert!(Bracket::new([(1.0, -1.0), (2.0, 0.0)], 1.5, 0.0).next().is_none());
}

/// A quantity that is not a number, or that jumps at every evaluation, ends.
#[test]
fn what_makes_no_sense_ends() {
    for of in [|_: f64| f64::NAN, |t: f64| (1e9 * t).sin(), |_| f64::INFINITY] {
        let mut bracket = Bracket::straight([(0.0, -1.0), (8.0, 1.0)]);
        let mut looks = 0;
        while let Some(time) = bracket.next() {
            bracket.put(time, of(time));
            looks += 1;
        }
        assert!(looks <= MOST_LOOKS && bracket.times[0] <= bracket.times[1]);
    }
}
