//! Ways between solutions of one massless node whose balance is a closed form.
#![allow(
    clippy::unwrap_used,
    clippy::float_cmp,
    reason = "a test that cannot go on has failed; numbers that are given"
)]

use lptn_assembly::ThermalSystem;

use super::*;
use crate::scripted::{bodies, workspace};

/// A massless node with 2 W/K to air, 2 W/K to a body at 300 K and a heat. Checks the way from one
/// temperature in K to another.
fn stays(heat: &str, (start, end): (f64, f64)) -> Result<(), NewtonError> {
    let network = bodies(&[(100.0, "1 [W]"), (0.0, heat)], Some("2 [W/K]"));
    let system = ThermalSystem::assemble(&network).unwrap();
    let mut newton = Newton::new(&system, vec![1])?;
    newton.stays(&mut workspace(&system), &[300.0, start], &[300.0, end])
}

fn folds(heat: &str, way: (f64, f64)) -> bool {
    match stays(heat, way) {
        Ok(()) => false,
        Err(NewtonError::Fold { unknown }) => {
            assert_eq!(unknown, 1);
            true
        }
        Err(_) => panic!("{heat}: neither stays nor folds"),
    }
}

/// Keeps a massless node among the unknowns: constant conductances alone are reduced.
const OWN: &str = "1 [W/K] * (T - absolute(300 [K]))";

/// Its slope at 340 K is its height over its width.
fn step(height: f64, width: f64) -> String {
    format!("{height:?} [W] * tanh((T - absolute(340 [K])) / {width:?} [K])")
}

/// Nothing rests where the heat rises by more than 4 W/K.
#[test]
fn a_way_over_temperatures_at_which_nothing_rests_leads_to_another_branch() {
    for way in [(310.0, 370.0), (370.0, 310.0), (300.0, 341.0), (339.0, 350.0)] {
        assert!(folds(&step(10.0, 2.0), way), "{way:?}");
        assert!(!folds(&step(7.0, 2.0), way), "{way:?}");
    }
    for way in [(300.0, 336.0), (345.0, 400.0), (400.0, 345.0)] {
        assert!(!folds(&step(10.0, 2.0), way), "{way:?}");
    }
    // at a place
    assert!(folds(&step(10.0, 2.0), (340.0, 340.0)));
    assert!(!folds(&step(10.0, 2.0), (330.0, 330.0)));
}

/// Far narrower than a sixteenth of the way, wherever it is.
#[test]
fn a_narrow_stretch_at_which_nothing_rests_is_not_stepped_over() {
    for width in [1.0, 0.1, 0.01] {
        for from in [300.0, 302.3, 309.0] {
            for to in [350.0, 361.7] {
                assert!(folds(&step(20.0, width), (from, to)), "{width} {from} {to}");
                assert!(folds(&step(20.0, width), (to, from)), "{width} {from} {to}");
            }
        }
    }
}

/// Two points a share of the way apart, between which the heat left over changes by `change`; the
/// slopes predict 10 W.
#[test]
fn balances_bend_if_slopes_mispredict_by_more_than_a_fiftieth() {
    let bends = |share: f64, change: f64, slopes: [f64; 2]| {
        let before = Place { share: 0.25, left: vec![3.0, -1.0], slope: vec![slopes[0], 0.0] };
        let next = Place {
            share: 0.25 + share,
            left: vec![3.0 + change, -1.0],
            slope: vec![slopes[1], 0.0],
        };
        before.bends(&next)
    };
    for sign in [1.0, -1.0] {
        assert!(!bends(0.5, sign * 10.19, [sign * 30.0, sign * 10.0]));
        assert!(bends(0.5, sign * 10.21, [sign * 30.0, sign * 10.0]));
        assert!(bends(0.5, sign * 9.79, [sign * 30.0, sign * 10.0]));
        assert!(!bends(0.5, sign * 9.81, [sign * 10.0, sign * 30.0]));
        assert!(bends(0.5, -sign * 10.0, [sign * 10.0, sign * 30.0]));
    }
    assert!(!bends(0.5, 0.0, [0.0, 0.0]) && bends(0.5, 1e-9, [0.0, 0.0]));
    // with several balances the largest counts
    let place = |left: [f64; 2]| Place {
        share: left[0] / 100.0,
        left: left.to_vec(),
        slope: vec![100.0, 1.0],
    };
    assert!(!place([0.0, 0.0]).bends(&place([100.0, 2.9])));
    assert!(place([0.0, 0.0]).bends(&place([100.0, 3.1])));
}

#[test]
fn a_place_on_a_way_is_a_share_of_it_and_so_many_kelvin_further() {
    let network = bodies(&[(0.0, OWN), (0.0, OWN), (1.0, OWN)], Some("2 [W/K]"));
    let system = ThermalSystem::assemble(&network).unwrap();
    // the state comes first among the unknowns
    let newton = Newton::new(&system, vec![1, 2]).unwrap_or_else(|_| panic!("no balances"));
    let (start, end) = ([300.0, 310.0, 320.0], [301.0, 314.0, 318.0]);
    let way = Way { start: &start, end: &end, length: 4.0, left: 0 };
    assert_eq!(newton.on(&way, 0.25, 0.0), [301.0, 311.0, 319.5]);
    assert_eq!(newton.on(&way, 0.5, 1.0), [301.0, 313.0, 318.5]);
    assert_eq!(newton.on(&way, 1.0, -2.0), [301.0, 312.0, 319.0]);
    let none = Way { start: &start, end: &start, length: 0.0, left: 0 };
    assert_eq!(newton.on(&none, 1.0, 0.5), [300.0, 310.5, 320.5]);
}

/// Heat left over at a point, and its slope along the way: a heat of 40 W, and 4 - 1 W/K lost from
/// 300 K on.
#[test]
fn a_place_has_the_heat_left_over_and_its_slope() {
    let network = bodies(
        &[(100.0, "1 [W]"), (0.0, "40 [W] + 1 [W/K] * (T - absolute(300 [K]))")],
        Some("2 [W/K]"),
    );
    let system = ThermalSystem::assemble(&network).unwrap();
    let mut newton = Newton::new(&system, vec![1]).unwrap_or_else(|_| panic!("no balances"));
    let mut work = workspace(&system);
    let (start, end) = ([300.0, 304.0], [300.0, 324.0]);
    let way = Way { start: &start, end: &end, length: 20.0, left: 0 };
    let _ = newton.linearize(&mut work, &start);
    let place = newton.place(&mut work, &way, 0.5).unwrap_or_else(|_| panic!("no place"));
    assert!((place.left[0] - (40.0 - 3.0 * 14.0)).abs() < 1e-9, "{:?}", place.left);
    assert!((place.slope[0] + 60.0).abs() < 1e-9, "{:?}", place.slope);
}

/// The corner lies a third of a kelvin after a point, so that it is at a third or two thirds of
/// every stretch around it: twenty halvings of 1 K come to less than 1e-6 K.
#[test]
fn a_corner_is_closed_in_to_what_is_rounding() {
    let heat = "1 [W/K] * max(T - absolute(305 [K]) - 1 [K] / 3, 0 [K])";
    let network = bodies(&[(100.0, "1 [W]"), (0.0, heat)], Some("2 [W/K]"));
    let system = ThermalSystem::assemble(&network).unwrap();
    let mut newton = Newton::new(&system, vec![1]).unwrap_or_else(|_| panic!("no balances"));
    let left = |newton: &mut Newton<'_>, [from, to]: [f64; 2], left: usize| {
        let (start, end) = ([300.0, from], [300.0, to]);
        let mut way = Way { start: &start, end: &end, length: (to - from).abs(), left };
        let found = newton.rests_along(&mut workspace(&system), &mut way);
        assert!(found.is_ok());
        way.left
    };
    assert_eq!(left(&mut newton, [300.0, 316.0], MORE), MORE - 20);
    assert_eq!(left(&mut newton, [316.0, 300.0], MORE), MORE - 20);
    assert_eq!(left(&mut newton, [296.0, 328.0], MORE), MORE - 21);
    // as many as are left, and none if nothing bends
    assert_eq!(left(&mut newton, [300.0, 316.0], 7), 0);
    assert_eq!(left(&mut newton, [310.0, 326.0], MORE), MORE);
}

/// A point is refused if nothing rests within 1e-6 K to either side, and a narrower stretch is
/// rounding.
#[test]
fn a_place_is_refused_unless_something_rests_on_both_sides_of_it() {
    let above = "9 [W/K] * max(T - absolute(340 [K]), 0 [K])";
    let below = "9 [W/K] * min(T - absolute(340 [K]), 0 [K])";
    for (heat, sign) in [(above, 1.0), (below, -1.0)] {
        for beside in [5e-7, 2e-6] {
            assert!(folds(heat, (340.0 + sign * beside, 340.0 + sign * beside)), "{heat}");
            assert!(!folds(heat, (340.0 - sign * beside, 340.0 - sign * beside)), "{heat}");
        }
    }
    assert!(!folds(&step(1e-6, 1e-7), (340.0, 340.0)));
    assert!(folds(&step(1e-4, 1e-5), (340.0, 340.0)));
}
